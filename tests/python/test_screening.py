"""Screening of lessons without a run, against limits computed by hand."""

import os
import unittest
from pathlib import Path
from unittest import mock

import pounding
from pounding._native import core
from pounding.errors import InputError
from pounding._screening import screen, table_of
from messages import assert_mentions, raises

EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
NARROW = "gap below the width per storey"
COUNTS = "pounding counts: gap and a further condition"


def screened(lesson, seismicity="high", file="model.yaml"):
    return screen(EXAMPLES / lesson / file, seismicity)


def check(pair, rule, criterion):
    """Value, limit and verdict of a criterion."""
    [one] = [one for one in pair["checks"] if one["rule"].startswith(rule) and one["criterion"].startswith(criterion)]
    return one["value"], one["limit"], one["verdict"]


class Lessons(unittest.TestCase):
    def near(self, found, value, limit, verdict):
        self.assertAlmostEqual(found[0], value, places=9)
        self.assertAlmostEqual(found[1], limit, places=9)
        self.assertEqual(found[2], verdict)

    def test_offset_floors_of_lesson_17(self):
        [pair] = screened("17_uneven_pair")["pairs"]
        # Seven storeys of 25 m next to ten; the roof at 25 m is 1.3 m above the floor at 23.7 m.
        self.near(check(pair, "FEMA", NARROW), 0.05, 7 * 1.5 * 0.0254, "critical")
        self.near(check(pair, "FEMA", "floors"), 1.3, 0.6096, "critical")
        self.assertEqual(check(pair, "FEMA", "storeys taller"), (3, 2, "critical"))
        self.assertEqual(check(pair, "FEMA", COUNTS)[2], "critical")
        self.near(check(pair, "ASCE", "gap"), 0.05, 0.015 * 25, "critical")
        self.near(check(pair, "NZSEE", "gap / height"), 0.05 / 25, 0.01, "critical")
        self.near(check(pair, "NZSEE", "floors"), 1.3, 0.2 * 3.2, "critical")
        self.assertEqual(check(pair, "NZSEE", "factor D1")[0], 0.4)
        self.assertEqual(check(pair, "NZSEE", "factor D2")[0], 0.7)
        self.assertEqual(check(pair, "Cole", "floors hit columns")[2], "critical")
        self.near(check(pair, "Cole", "height ratio"), 33.3 / 25, 1.25, "critical")
        assert_mentions(pair["summary"], ["tower-annex", "50 mm", "267 mm", "375 mm"])

    def test_limits_follow_the_seismicity(self):
        widths = {"low": 0.5, "moderate": 0.5, "moderately_high": 1.0, "high": 1.5, "very_high": 2.0}
        fractions = {"low": 0.0025, "moderate": 0.005, "moderately_high": 0.015, "high": 0.015, "very_high": 0.015}
        for one in widths:
            [pair] = screened("17_uneven_pair", one)["pairs"]
            self.assertAlmostEqual(check(pair, "FEMA", NARROW)[1], 7 * widths[one] * 0.0254)
            self.assertAlmostEqual(check(pair, "ASCE", "gap")[1], 25 * fractions[one])
        # 0.25 % of 25 m are 62.5 mm, more than the gap.
        self.assertEqual(check(screened("17_uneven_pair", "low")["pairs"][0], "ASCE", "gap")[2], "critical")

    def test_aligned_floors_of_lesson_20(self):
        [pair] = screened("20_hinge_frames", "low", "elastic.yaml")["pairs"]
        # Six storeys of 18 m next to eight: 76.2 mm and 45 mm at low seismicity.
        self.near(check(pair, "FEMA", NARROW), 0.02, 0.0762, "critical")
        self.near(check(pair, "FEMA", "floors"), 0, 0.6096, "passes")
        self.assertEqual(check(pair, "FEMA", "storeys taller"), (2, 2, "critical"))
        self.near(check(pair, "ASCE", "gap"), 0.02, 0.045, "critical")
        self.assertEqual([check(pair, "NZSEE", f"factor D{i}")[0] for i in (1, 2)], [0.7, 0.7])
        self.assertEqual(check(pair, "Cole", "floors hit columns")[2], "passes")

    def test_floors_against_columns_of_lesson_9(self):
        [pair] = screened("09_floor_to_column")["pairs"]
        # Floors at 3, 6, 9, 12 m and 4, 8, 12 m: 6 m is 2 m from 4 and 8 m.
        self.near(check(pair, "FEMA", "floors"), 2, 0.6096, "critical")
        self.assertEqual(check(pair, "Cole", "floors hit columns")[2], "critical")
        self.near(check(pair, "ASCE", "gap"), 0.02, 0.18, "critical")

    def test_ends_of_the_row_of_lesson_10(self):
        pairs = screened("10_row_of_five")["pairs"]
        self.assertEqual([check(pair, "FEMA", "end of a row")[0] for pair in pairs], ["first", "none", "none", "fifth"])
        # first-second: aligned, one storey apart; only the end of the row counts.
        self.assertEqual([check(pairs[0], "FEMA", one)[2] for one in ("floors", "storeys taller")], ["passes"] * 2)
        self.assertEqual(check(pairs[0], "FEMA", COUNTS)[2], "critical")

    def test_the_corner_of_lesson_25_ends_no_row(self):
        pairs = screened("25_city_block")["pairs"]
        self.assertEqual([(pair["left"], pair["right"]) for pair in pairs], [("corner", "south1"), ("corner", "west1")])
        for pair, storeys in zip(pairs, (6, 7)):
            # One row along x and one along y, each of two buildings.
            self.assertEqual(check(pair, "FEMA", "end of a row")[2], "passes")
            self.near(check(pair, "FEMA", NARROW), 0.03, storeys * 0.0381, "critical")
            self.near(check(pair, "ASCE", "gap"), 0.03, 0.015 * 3.2 * storeys, "critical")
            self.near(check(pair, "Cole", "mass ratio"), 2.25, 1.5, "critical")

    def test_a_wide_gap_passes(self):
        model = pounding.Model.from_file(EXAMPLES / "20_hinge_frames/elastic.yaml")
        model.links[0]["gap"] = "400 mm"
        model.structures["right"]["frame"]["origin"] = ["18.4 m", "0 m"]
        [pair] = screen(model)["pairs"]
        # 6 storeys: 228.6 mm; 18 m: 270 mm and 180 mm.
        self.assertEqual([check(pair, "FEMA", COUNTS)[2], check(pair, "ASCE", "gap")[2]], ["passes"] * 2)
        self.assertEqual([check(pair, "NZSEE", f"factor D{i}")[0] for i in (1, 2)], [1.0, 1.0])


class Everything(unittest.TestCase):
    def test_without_elevations_verdicts_are_unknown(self):
        [pair] = screened("02_two_oscillators")["pairs"]
        self.assertEqual({check(pair, one, "gap")[2] for one in ("ASCE",)}, {"unknown"})
        self.assertEqual(check(pair, "FEMA", COUNTS)[2], "unknown")
        assert_mentions(pair["summary"], "unknown")

    def test_nothing_is_run(self):
        with mock.patch.object(core, "run", side_effect=AssertionError):
            screened("25_city_block")

    def test_every_output_is_marked(self):
        found = screened("17_uneven_pair")
        self.assertEqual(found["mark"], "check the edition")
        assert_mentions(table_of(found), ["check the edition", "not assessed", "FEMA P-154"])

    def test_walls_and_wrong_input(self):
        found = screened("05_moat_wall")
        self.assertEqual((found["pairs"], len(found["not_screened"])), ([], 2))
        with raises(InputError, ["seismicity", "very_high"]):
            screened("17_uneven_pair", "huge")
        model = pounding.Model.from_file(EXAMPLES / "17_uneven_pair/model.yaml")
        model.links = []
        with raises(InputError, "link"):
            screen(model)


if __name__ == "__main__":
    unittest.main()
