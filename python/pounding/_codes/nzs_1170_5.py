"""NZS 1170.5:2004."""

from pounding._codes.rule import Example, Factor, Rule, Statistic

RULE = Rule(
    name="NZS 1170.5:2004",
    clause="7.4",
    region="New Zealand",
    combination="sum",
    factor=Factor(("mu", "drift_modification")),
    statistic=Statistic(None, 3, "6.4: the largest of at least 3 records"),
    verified=False,
    source="professional knowledge",
    example=Example(
        left=0.010,
        right=0.020,
        displacements="reduced",
        inputs={"mu": 4.0, "drift_modification": 1.2},
        expected={"offset": 0.144, "aligned": 0.144, "line": 0.144},
        source="by hand: 4 x 1.2 x 10 mm = 48 mm and 4 x 1.2 x 20 mm = 96 mm, together 144 mm",
    ),
    notes=("displacements of the ultimate limit state, with P-Delta effects",),
)
