"""EN 1998-1:2004."""

from pounding._codes.rule import Example, Factor, Rule, Statistic

RULE = Rule(
    name="EN 1998-1:2004",
    clause="4.4.2.7",
    region="Europe",
    combination="srss",
    factor=Factor(("q",)),
    aligned=0.7,
    statistic=Statistic(7, 3, "4.3.3.4.3: mean from 7 records on, otherwise the most unfavourable value"),
    verified=False,
    source="professional knowledge; national annexes may differ",
    example=Example(
        left=0.020,
        right=0.015,
        displacements="reduced",
        inputs={"q": 3.0},
        expected={"offset": 0.075, "aligned": 0.0525, "line": 0.105},
        source="by hand: 3 x 20 mm and 3 x 15 mm are 60 and 45 mm; their SRSS is 75 mm, 0.7 of it 52.5 mm; their sum "
        "is 105 mm",
    ),
    notes=(
        "d = q d_e belongs to displacements from the design spectrum; elastic and nonlinear histories are not "
        "multiplied by q",
        "the factor 0.7 is not applied to setbacks from a property line",
    ),
)
