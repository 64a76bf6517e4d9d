"""IS 1893 (Part 1):2016."""

from pounding._codes.rule import Example, Factor, Rule, Statistic

RULE = Rule(
    name="IS 1893-1:2016",
    clause="7.11.3",
    region="India",
    combination="sum",
    factor=Factor(("R",)),
    aligned=0.5,
    only_similar=True,
    statistic=Statistic(None, 1, "the clause states no statistic; the largest is on the safe side"),
    verified=False,
    source="the clause number was seen in a public source, the text is professional knowledge",
    example=Example(
        left=0.010,
        right=0.012,
        displacements="reduced",
        inputs={"R": 5.0},
        right_inputs={"R": 3.0},
        expected={"offset": 0.086, "aligned": 0.086, "similar": 0.043, "line": 0.086},
        source="by hand: 5 x 10 mm + 3 x 12 mm = 86 mm; R/2 for similar units with aligned floors: 43 mm",
    ),
    notes=(
        "R and R/2 apply to displacements under reduced forces; unreduced ones have the factors 1 and 1/2",
        "the clause has no rule for a property line; the own displacement is used",
    ),
)
