"""E.030 (2026)."""

from pounding._codes.rule import Example, Factor, Fixed, Largest, Proportional, Rule, Statistic

RULE = Rule(
    name="E.030 (2026)",
    clause="52",
    region="Peru",
    combination="sum",
    factor=Factor(("amplification",)),
    aligned=2 / 3,
    offset=2 / 3,
    minimum=Largest((Proportional(0.02, ("Z", "S"), "0.02 Z S h"), Fixed(0.030, "30 mm"))),
    statistic=Statistic(None, 1, "the article states no statistic; the largest is on the safe side"),
    verified=True,
    source="the text of article 52, or a program with it, was seen in a public source",
    line="half",
    example=Example(
        left=0.060,
        right=0.045,
        displacements="nonlinear",
        inputs={"Z": 0.45, "S": 1.05},
        expected={"offset": 0.1701, "aligned": 0.1701, "line": 0.1701},
        source="by hand: 2/3 (60 mm + 45 mm) = 70 mm; 0.02 x 0.45 x 1.05 x 18 m = 170.1 mm governs; to the property "
        "line half of it on each side",
        height=18.0,
    ),
    notes=(
        "the edition of 2018 has 0.006 h instead of 0.02 Z S h",
        "property line: 2/3 of the own displacement, and at least half of the minimum, for a neighbour with a joint",
    ),
)
