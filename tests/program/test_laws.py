"""The equations printed by `pounding laws` are those used for the damping."""

import json
import math
import re
import unittest

from support import ProgramTest

FUNCTIONS = {"sqrt": math.sqrt, "ln": math.log, "exp": math.exp, "arccos": math.acos}
NAMES = FUNCTIONS | {"pi": math.pi}
TOKEN = re.compile(r"\d+(?:\.\d+)?|[A-Za-z_]+|[-+*/^(){}\[\],=]")
#: Formulas given by a table or an integration.
WITHOUT_EQUATION = {
    ("hertz_damped", "naderpour_2015"),
    ("bilinear_hertz", "exact"),
    ("kuwabara_kono", "exact"),
    ("adams_impact", "exact"),
    ("limited_damper", "exact"),
}
#: Ratio of the number to z, for n = 1.5, if the number is an oscillator's ratio z in stretched time.
OF_STRETCHED_TIME = {"jankowski": math.sqrt(5) / 2, "viscous_hertz": math.sqrt(5)}


def value(text, **names):
    """A printed expression with its products written out: 2 pi e is 2*pi*e, [..] and {..} are brackets."""
    words, before = [], ""
    for token in TOKEN.findall(text.replace("ln^2 e", "(ln(e))^2").replace("-ln e", "-ln(e)")):
        token = {"[": "(", "{": "(", "]": ")", "}": ")", "^": "**"}.get(token, token)
        if words and re.match(r"[\w(]", token) and re.search(r"[\w)]$", before) and before not in FUNCTIONS:
            words.append("*")
        words.append(token)
        before = token
    return eval(" ".join(words), {"__builtins__": {}}, NAMES | names)


class Equations(ProgramTest):
    def numbers(self, law, restitution):
        """The damping number by every formula for it, and its name."""
        words = [
            "calibrate",
            "--law",
            law["name"],
            "--restitution",
            restitution,
            "--m1",
            "100 t",
            "--m2",
            "150 t",
            "--json",
        ]
        rows = json.loads(self.pounding(*words).stdout)["formulas"]
        return {row["formula"]: row for row in rows if "refused" not in row}

    def laws(self):
        return [law for law in json.loads(self.pounding("laws", "--json").stdout) if law["formulas"]]

    def test_are_those_of_the_damping(self):
        seen = 0
        for law in self.laws():
            for e in (0.4, 0.85):
                numbers = self.numbers(law, e)
                for formula in law["formulas"]:
                    if (law["name"], formula["name"]) in WITHOUT_EQUATION:
                        continue
                    with self.subTest(law=law["name"], formula=formula["name"], e=e):
                        row, equation = numbers[formula["name"]], formula["equation"]
                        number = next(
                            row[name]
                            for name in ("damping_factor", "damping_ratio", "loss_ratio", "indentation_ratio")
                            if name in row
                        )
                        self.holds(law["name"], equation, number, e)
                        seen += 1
        self.assertEqual(seen, 2 * 30)

    def holds(self, law, equation, number, e):
        if "root of" not in equation:
            letter, right = equation.split(" = ", 1)
            self.assertAlmostEqual(value(right, e=e, n=1.5) / number, 1, delta=1e-12)
            return
        z = number / OF_STRETCHED_TIME.get(law, 1)
        left, right = equation.split("root of ")[1].split(" = ")
        letters = {"e": e, "a": number, "z": z, "zeta": z}
        if z > 1 and "arccos" in right:  # arccos and root are both imaginary beyond critical damping
            right, letters = (
                right.replace("1-z^2", "z^2-1").replace("1-zeta^2", "zeta^2-1"),
                letters | {"arccos": math.acosh},
            )
        self.assertAlmostEqual(value(left, **letters) / value(right, **letters), 1, delta=1e-10)


if __name__ == "__main__":
    unittest.main()
