"""Formulas of the laws on the site."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/docs"))
from formulas import tex  # noqa: E402


class Formulas(unittest.TestCase):
    def test_are_those_of_the_program(self):
        for plain, wanted in {
            "F = k d^n (1 + a d'/v)": r"F = k\,d^{n}\,(1 + a\,d'/v)",
            "c = 2 zeta sqrt(k m)": r"c = 2\,\zeta \,\sqrt{k\,m}",
            "d^((n-1)/2)": "d^{(n-1)/2}",
            "sqrt(k sqrt(d) m)": r"\sqrt{k\,\sqrt{d}\,m}",
            "K1 d_y <= c*": r"K_{1}\,d_{y} \le  c^{*}",
            "v+ = -e v-": "v^{+} = -e\\,v^{-}",
            "root of e(loss) = {e}": r"\text{root of}\ e(\text{loss}) = \{e\}",
        }.items():
            with self.subTest(plain):
                self.assertEqual(tex(plain), wanted)

    def test_a_bracket_that_is_not_closed_is_told(self):
        with self.assertRaisesRegex(ValueError, "not closed"):
            tex("sqrt(2")

    def test_nothing_is_lost_on_the_pages_of_the_laws(self):
        for page in (ROOT / "elements/pounding/laws/pages").glob("*.md"):
            for formula in re.findall(r"(?m)^    (\S.* = .*)$|^\| [^|]* \| `([^`|]* = [^`|]*)` \|", page.read_text()):
                plain = "".join(formula)
                with self.subTest(plain):
                    letters = re.sub(r"\\(text|operatorname|quad|le|ge)\b", "", tex(plain))
                    self.assertEqual(
                        *(sorted(re.findall(r"[A-Za-z\d]", re.sub("<=|>=", "", each))) for each in (letters, plain))
                    )


if __name__ == "__main__":
    unittest.main()
