"""GB 50011-2010."""

from pounding._codes.rule import Example, Rule, Statistic, StepsBySystem

RULE = Rule(
    name="GB 50011-2010",
    clause="6.1.4",
    region="China",
    combination="",
    minimum=StepsBySystem(
        width=0.100,
        up_to=15.0,
        steps={6: 5.0, 7: 4.0, 8: 3.0, 9: 2.0},
        increment=0.020,
        fractions={"frame": 1.0, "frame_wall": 0.7, "wall": 0.5},
        minimum=0.100,
        steel=1.5,
        text="100 mm up to 15 m, 20 mm more per started 5, 4, 3, 2 m at intensity 6, 7, 8, 9; frame-wall 70 %, wall "
        "50 %, at least 100 mm; steel 1.5 times",
    ),
    statistic=Statistic(None, 1, "the width does not depend on displacements"),
    verified=True,
    source="the text of 6.1.4, or a program with it, was seen in a public source",
    line="",
    example=Example(
        left=0.0,
        right=0.0,
        displacements="nonlinear",
        inputs={"intensity": 7, "system": "frame"},
        expected={"offset": 0.140, "aligned": 0.140},
        source="by hand: 21 m at intensity 7 are 1.5 steps of 4 m above 15 m; two started steps: 100 mm + 2 x 20 mm",
        height=21.0,
    ),
    notes=(
        "h is the height of the lower structure, the system the one that needs the wider joint",
        "a started step counts as a whole one",
        "the clause has no rule for a property line",
    ),
)
