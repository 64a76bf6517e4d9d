"""NTC 2018."""

from pounding._codes.rule import GRAVITY, Example, Factor, Proportional, Rule, Statistic

RULE = Rule(
    name="NTC 2018",
    clause="7.2.1",
    region="Italy",
    combination="sum",
    factor=Factor(("mu_d",)),
    minimum=Proportional(0.02 / GRAVITY, ("ag", "S"), "h/100 x 2 ag S/g"),
    statistic=Statistic(7, 3, "7.3.5: mean from 7 groups of records on, otherwise the most unfavourable value"),
    verified=False,
    source="the same rule of NTC 2008, 7.2.2, was read at risponde.promolegno.com; this edition was not",
    example=Example(
        left=0.030,
        right=0.040,
        displacements="nonlinear",
        inputs={"ag": 0.25 * GRAVITY, "S": 1.2},
        expected={"offset": 0.090, "aligned": 0.090, "line": 0.090},
        source="by hand: 30 mm + 40 mm = 70 mm; 15 m / 100 x 2 x 0.25 x 1.2 = 90 mm governs",
        height=15.0,
    ),
    notes=(
        "displacements of the limit state SLV",
        "the minimum is between facing points, also of both sides of a property line",
    ),
)
