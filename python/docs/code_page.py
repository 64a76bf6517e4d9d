#!/usr/bin/env python3
"""Writes the tables of rules in the page of codes, python/docs/guide/codes.md, from the data in pounding/codes.

PYTHONPATH=python python3 python/docs/code_page.py --write    # rewrite the page
PYTHONPATH=python python3 python/docs/code_page.py --check    # exit code 1 if it differs
"""

import re
import sys
from pathlib import Path

from pounding._codes import BRIDGES, rules
from pounding._codes.screening import ASCE_41, COLE, FEMA_P154, NZSEE, SEISMICITIES

PAGE = Path(__file__).parent / "guide/codes.md"
COMBINATIONS = {"srss": "SRSS", "sum": "sum", "": "no displacement"}
LINES = {
    "own": "own displacement of each structure",
    "unknown": "the neighbour moves as the structure itself",
    "half": "displacement of each structure, at least half of the minimum",
    "width": "by storeys",
    "": "no rule",
}


def table(head, rows):
    cells = [[str(cell).replace("|", "\\|") for cell in row] for row in [head, ["--"] * len(head), *rows]]
    return "\n".join(f"| {' | '.join(row)} |" for row in cells)


def same_property(rule):
    parts = []
    if rule.combination:
        text = COMBINATIONS[rule.combination]
        parts.append(text if rule.offset == 1 else f"{rule.offset:.3g} {text}")
        if rule.aligned != rule.offset:
            similar = " of similar neighbours" if rule.only_similar else ""
            parts.append(f"{rule.aligned:.3g} {text} if floors{similar} align")
    if rule.added:
        parts.append(
            f"{rule.added.text} instead of the displacement up to {rule.storeys_by_height} storeys"
            if rule.storeys_by_height
            else f"each displacement plus {rule.added.text}"
        )
    if rule.minimum:
        parts.append(("at least " if rule.combination else "") + rule.minimum.text)
    return "; ".join(parts)


def line(rule):
    return (
        LINES[rule.line]
        + (f": {rule.line_minimum.text}" if rule.line == "width" else "")
        + (f", at least {rule.line_minimum.text}" if rule.line_minimum and rule.line == "own" else "")
    )


def blocks():
    """{name: text} of the generated blocks."""
    every = rules()
    gaps = table(
        ("code", "clause", "same property", "property line", "factor of reduced displacements", "text"),
        [
            (
                rule.name,
                rule.clause,
                same_property(rule),
                line(rule),
                rule.factor.text if rule.factor else "-",
                "seen" if rule.verified else rule.mark,
            )
            for rule in every
        ],
    )
    statistics = table(
        ("code", "over ground motions", "from"),
        [(rule.name, rule.statistic.text, rule.statistic.source) for rule in every if rule.combination],
    )
    sources = "\n".join(
        f"- {rule.name}, {rule.region}: {rule.source}."
        + "".join(f" {note[0].upper()}{note[1:]}." for note in rule.notes)
        + f" Example, {rule.example.source}."
        for rule in every
    )
    seismicity = table(
        ("seismicity", FEMA_P154["name"], ASCE_41["name"]),
        [
            (
                one.replace("_", " "),
                f"{1e3 * FEMA_P154['width_per_storey'][one]:.1f} mm per storey",
                f"{100 * ASCE_41['fraction'][one]:g} % of the height",
            )
            for one in SEISMICITIES
        ],
    )
    screening = "\n".join(f"- {one['name']}: {one['source']}." for one in (FEMA_P154, ASCE_41, NZSEE, COLE))
    return {
        "gaps": gaps,
        "statistics": statistics,
        "sources": f"{sources}\n\n{BRIDGES}",
        "screening": f"{seismicity}\n\n{screening}",
    }


def page():
    """The page with its generated blocks."""
    text = PAGE.read_text(encoding="utf-8")
    for name, block in blocks().items():
        text, count = re.subn(
            rf"(?s)(<!-- begin {name} -->).*?(<!-- end {name} -->)",
            lambda found: f"{found[1]}\n\n{block}\n\n{found[2]}",
            text,
        )
        assert count == 1, f"{PAGE}: no block {name}"
    return text


def normal(text):
    """The text without its line breaks, which the formatter moves."""
    return " ".join(text.split())


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        PAGE.write_text(page(), encoding="utf-8")
    elif sys.argv[1:] == ["--check"]:
        if normal(page()) != normal(PAGE.read_text(encoding="utf-8")):
            sys.exit(f"{PAGE} differs; type PYTHONPATH=python python3 {sys.argv[0]} --write, then make format")
    else:
        sys.exit(__doc__)
