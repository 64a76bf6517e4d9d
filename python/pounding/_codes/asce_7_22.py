"""ASCE 7-22."""

from pounding._codes.rule import Example, Factor, Rule, Statistic

RULE = Rule(
    name="ASCE 7-22",
    clause="12.12.2 or 12.12.3",
    region="United States",
    combination="srss",
    factor=Factor(("Cd",), ("importance",)),
    statistic=Statistic(11, 11, "chapter 16: suites of 11 or more motions"),
    verified=False,
    source="professional knowledge; the edition redefines displacements and renumbers clauses",
    example=Example(
        left=0.004,
        right=0.003,
        displacements="reduced",
        inputs={"Cd": 4.5, "importance": 1.5},
        expected={"offset": 0.015, "aligned": 0.015, "line": 0.021},
        source="by hand: 3 x 4 mm and 3 x 3 mm are 12 and 9 mm; their SRSS is 15 mm, their sum 21 mm",
    ),
    notes=("the displacement of the edition includes the deflection of the diaphragm, which the model must have",),
)
