"""National Building Code of Canada."""

from pounding._codes.rule import Example, Factor, Rule, Statistic

RULE = Rule(
    name="NBCC 2020",
    clause="4.1.8.14",
    region="Canada",
    combination="srss",
    factor=Factor(("Rd", "Ro"), ("importance",)),
    statistic=Statistic(None, 1, "the clause states no statistic; the largest is on the safe side"),
    verified=False,
    source="the clause of the Ontario Building Code, with the same number and combination, was read at "
    "buildingcode.online/707.html; the factor on deflections (4.1.8.13) and this edition were not",
    example=Example(
        left=0.020,
        right=0.015,
        displacements="reduced",
        inputs={"Rd": 4.0, "Ro": 1.7, "importance": 1.0},
        expected={"offset": 0.170, "aligned": 0.170, "line": 0.238},
        source="by hand: 6.8 x 20 mm and 6.8 x 15 mm are 136 and 102 mm; their SRSS is 170 mm, their sum 238 mm",
    ),
    notes=("the clause has no rule for a property line; the own displacement is used",),
)
