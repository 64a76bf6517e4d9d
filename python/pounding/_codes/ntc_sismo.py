"""NTC-Sismo of Mexico City."""

from pounding._codes.rule import ByZone, Example, Factor, Fixed, Rule, Statistic

RULE = Rule(
    name="NTC-Sismo 2004",
    clause="1.10",
    region="Mexico City",
    combination="sum",
    factor=Factor(("Q",)),
    aligned=0.5,
    only_similar=True,
    added=ByZone({"I": 0.001, "II": 0.003, "III": 0.006}, "0.001, 0.003, 0.006 h in zones I, II, III"),
    line_minimum=Fixed(0.050, "50 mm"),
    statistic=Statistic(None, 1, "the section states no statistic; the largest is on the safe side"),
    verified=True,
    source="the text of section 1.10 was read at es.scribd.com/document/671909992; the factor Q is professional "
    "knowledge, and later editions may differ",
    example=Example(
        left=0.030,
        right=0.040,
        displacements="reduced",
        inputs={"Q": 2.0, "zone": "III"},
        expected={"offset": 0.380, "aligned": 0.380, "similar": 0.190, "line": 0.380},
        source="by hand: 2 x 30 mm + 0.006 x 20 m = 180 mm and 2 x 40 mm + 120 mm = 200 mm, together 380 mm; half for "
        "equal height and structure with aligned floors",
        height=20.0,
    ),
)
