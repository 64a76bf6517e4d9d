"""Iranian Standard 2800, fourth edition."""

from pounding._codes.rule import Example, Factor, Proportional, Rule, Statistic

RULE = Rule(
    name="Standard 2800, 4th ed.",
    clause="1.4",
    region="Iran",
    combination="sum",
    factor=Factor(("Cd",)),
    added=Proportional(0.005, (), "0.005 h"),
    storeys_by_height=8,
    statistic=Statistic(None, 1, "not stated where displacements govern; the largest is on the safe side"),
    verified=False,
    source="professional knowledge, also of the clause number",
    example=Example(
        left=0.050,
        right=0.060,
        displacements="nonlinear",
        inputs={},
        expected={"offset": 0.240, "aligned": 0.240, "line": 0.240},
        source="by hand: 0.005 x 24 m = 120 mm from the boundary on each side, for up to 8 storeys",
        height=24.0,
        storeys=8,
    ),
    notes=("important buildings of up to 8 storeys also need the nonlinear displacement",),
)
