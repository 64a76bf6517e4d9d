"""ASCE 7-16."""

from pounding._codes.rule import Example, Factor, Rule, Statistic

RULE = Rule(
    name="ASCE 7-16",
    clause="12.12.3",
    region="United States",
    combination="srss",
    factor=Factor(("Cd",), ("importance",)),
    statistic=Statistic(11, 11, "chapter 16: suites of 11 or more motions"),
    verified=False,
    source="IBC equation 16-64, with the same combination and setback, was read at up.codes (building-separations); "
    "the clause and chapter 16 of this edition were not",
    example=Example(
        left=0.006,
        right=0.008,
        displacements="reduced",
        inputs={"Cd": 5.0, "importance": 1.0},
        expected={"offset": 0.050, "aligned": 0.050, "line": 0.070},
        source="by hand: 5 x 6 mm and 5 x 8 mm are 30 and 40 mm; their SRSS is 50 mm, their sum 70 mm",
    ),
    notes=("displacements include torsion, and accidental torsion where the code requires it",),
)
