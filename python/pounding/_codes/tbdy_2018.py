"""TBDY 2018."""

from pounding._codes.rule import Example, Factor, Rule, Statistic, Steps

RULE = Rule(
    name="TBDY 2018",
    clause="4.9.3",
    region="Turkey",
    combination="srss",
    factor=Factor(("R",), ("importance",)),
    aligned=0.25,
    offset=0.5,
    minimum=Steps(0.030, 6.0, 3.0, 0.010, "30 mm up to 6 m, 10 mm more per started 3 m"),
    statistic=Statistic(None, 1, "the clause uses spectral displacements; the largest is on the safe side"),
    verified=True,
    source="the text of 4.9.3, or a program with it, and the worked example were seen in a public source",
    line="unknown",
    example=Example(
        left=0.018,
        right=0.024,
        displacements="reduced",
        inputs={"R": 8.0, "importance": 1.0},
        expected={"aligned": 0.060, "offset": 0.120},
        source="published worked example: reduced displacements of 18 and 24 mm, R = 8, I = 1: 60 mm with aligned "
        "floors, 120 mm otherwise",
        height=15.0,
    ),
    notes=(
        "alpha = 0.25 R/I or 0.5 R/I multiplies reduced displacements; it is 0.25 or 0.5 for unreduced ones",
        "one floor that is not aligned makes 0.5 R/I govern the whole height",
        "property line: the displacement of an unknown neighbour is that of the structure itself, floors not aligned",
    ),
)
