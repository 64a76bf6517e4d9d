"""Numbers that the README of a lesson states in HTML comments, with the changes of its model to which they apply.

    <!--
    Expect: `links/left-right/peak_force = 7178400` within 1e-5
    Expect of `other.yaml` with `gap: 40 mm` instead of `gap: 20 mm`: `energy/impact = 41.5` and `links/a/impacts = 2` within 1e-4
    Expect without `wave: {velocity: 500 m/s, direction: x}`: `links/joint/impacts = 0` within 0
    -->

The path before `=` locates the value in the output of `pounding run --json`; the value is in SI units and the tolerance
is relative. A change applies to every occurrence of its text in the model; "without" removes a whole line.
"""

import re
from dataclasses import dataclass

CODE = r"`[^`]+`"
STATEMENT = re.compile(
    rf"Expect(?: of (?P<model>{CODE}))?(?P<changes>(?: (?:with|and) {CODE} instead of {CODE}| without {CODE})*):"
    rf" (?P<numbers>{CODE}(?:(?:,| and) {CODE})*) within (?P<tolerance>\d+(?:\.\d+)?(?:e[+-]?\d+)?)"
)
CHANGE = re.compile(rf"(?P<new>{CODE}) instead of (?P<old>{CODE})|without (?P<line>{CODE})")
#: A lesson in C++ states the line that its program prints.
PRINTED = re.compile(r"[\d. ]+")
#: A figure with its unit in a sentence. Times and % compare two numbers of the same kind.
FIGURE = re.compile(
    r"(?<![\w.])(?P<figure>\d+(?:\.(?P<decimals>\d+))?) (?P<unit>MN|kN|N|kJ|J|m/s\^2|mm|m|%|times|impacts)(?![\w/^])"
)
UNITS = {"MN": 1e6, "kN": 1e3, "N": 1, "kJ": 1e3, "J": 1, "m/s^2": 1, "mm": 1e-3, "m": 1, "times": 1, "impacts": 1}


@dataclass(frozen=True)
class Expectation:
    """One number. `changes` are pairs of texts (old, new); without a new text the line is removed."""

    model: str | None
    changes: tuple[tuple[str, str | None], ...]
    path: str
    value: float
    tolerance: float

    @property
    def kind(self):
        """Numbers of the same kind can be compared: "peak_force"."""
        return next(part for part in reversed(self.path.split("/")) if not part.isdigit() or part == self.path)


def expectations(text):
    """All numbers stated by a README. Raises ValueError for a line that begins with "Expect" and cannot be read."""
    found = []
    for line in re.finditer(r"(?m)^Expect\b", text):
        paragraph = " ".join(text[line.start() :].split("\n\n")[0].split())
        said = STATEMENT.match(paragraph)
        if not said:
            raise ValueError(f"cannot be read: {paragraph}")
        changes = tuple(
            (change["line"][1:-1], None) if change["line"] else (change["old"][1:-1], change["new"][1:-1])
            for change in CHANGE.finditer(said["changes"])
        )
        for number in re.findall(CODE, said["numbers"]):
            path, is_number, value = number[1:-1].partition(" = ")
            if is_number:
                found.append(
                    Expectation(
                        said["model"] and said["model"][1:-1], changes, path, float(value), float(said["tolerance"])
                    )
                )
            elif not PRINTED.fullmatch(path):
                raise ValueError(f"{path}: the value is missing")
    return found


def changed(model, changes):
    """The text of a model with these changes. Raises ValueError if the old text is not in the model."""
    for old, new in changes:
        words = r"(?<![\w.])" + r"\s+".join(map(re.escape, old.split())) + r"(?![\w.])"
        if new is None:
            words, new = rf"(?m)^\s*{words}\s*?\n", ""
        model, count = re.subn(words, lambda _: new, model)
        if not count:
            raise ValueError(f"the model has no `{old}`")
    return model


def questions(text):
    """Exercise and "What if" of a README; empty if there is none."""
    return text.partition("\n## Exercise\n")[2]


def unfounded(text, stated, models):
    """Figures of a text that follow from no stated number, such as "8.1 MN", "13 %" or "5 impacts", and occur in no
    model."""
    given = " ".join([*models, *(new or "" for one in stated for _, new in one.changes)])
    values = [one.value for one in stated]
    ratios = [one.value / other.value for one in stated for other in stated if other.kind == one.kind and other.value]
    text = re.sub(r"(?s)<!--.*?-->", "", text)
    wrong = []
    for said in FIGURE.finditer(" ".join(re.sub(CODE, "", text).split())):
        figure, unit = float(said["figure"]), said["unit"]
        if unit == "%":
            possible = [100 * share for ratio in ratios for share in (ratio, abs(1 - ratio))] + [
                100 * abs(1 - value) for value in values
            ]
        elif unit == "times":
            possible = ratios + values
        else:
            possible = [abs(value) / UNITS[unit] for value in values]  # a text gives the size of a push
        allowed = 0.5 * 10 ** -len(said["decimals"] or "") * (1 + 1e-6)
        if said[0] not in given and not any(abs(value - figure) <= allowed for value in possible):
            wrong.append(said[0])
    return wrong
