"""NSR-10."""

import math

from pounding._codes.rule import ByStoreys, Example, Factor, Rule, Statistic

RULE = Rule(
    name="NSR-10",
    clause="A.6.5",
    region="Colombia",
    combination="sum",
    factor=Factor(("R",)),
    statistic=Statistic(None, 1, "the clause states no statistic; the largest is on the safe side"),
    verified=True,
    source="the text of A.6.5, or a program with it, was seen in a public source",
    line="width",
    line_minimum=ByStoreys(
        ((2, 0.0, 0.0), (3, 0.0, 0.01), (math.inf, 0.02, 0.03)),
        "1 and 2 storeys 0; 3 storeys 0 if floors align, otherwise 1 % of h; more storeys 2 % of h if floors align, "
        "otherwise 3 %",
    ),
    example=Example(
        left=0.060,
        right=0.045,
        displacements="nonlinear",
        inputs={},
        expected={"offset": 0.105, "aligned": 0.105, "line": 0.450},
        source="by hand: 60 mm + 45 mm = 105 mm on one property; a neighbour of 5 storeys and 15 m without aligned "
        "floors: 3 % of 15 m = 450 mm",
        height=15.0,
        storeys=5,
    ),
    notes=("property line: width to an existing neighbour; without a neighbour 1 % of h to the line",),
)
