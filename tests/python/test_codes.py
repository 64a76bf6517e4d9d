"""Rules of codes: worked examples by hand, factors, minimum widths, and the page of the site."""

import importlib.util
import itertools
import unittest
from pathlib import Path

from pounding._codes import chosen, rules
from pounding._codes.evaluate import Conditions, Level, Side, evaluate
from pounding.errors import InputError
from messages import raises

ROOT = Path(__file__).resolve().parents[2]


def rule(name):
    [found] = chosen([name])
    return found


def gap(code, left, right, height=None, storeys=None, own=None, **conditions):
    """The gap [mm] of displacements [mm]; `own` has inputs of the right structure."""
    inputs = {key: conditions.pop(key) for key in list(conditions) if key not in Conditions.__dataclass_fields__}
    sides = [Side(name, {**inputs, **more}, height, storeys) for name, more in (("left", {}), ("right", own or {}))]
    found = evaluate(rule(code), *sides, [Level("l", left / 1e3, right / 1e3, height)], Conditions(**conditions))
    return None if found["gap"] is None else round(1e3 * found["gap"], 6), found["missing"]


class WorkedExamples(unittest.TestCase):
    def test_every_example_is_recomputed(self):
        for one in rules():
            example = one.example
            self.assertTrue(example.expected)
            for case, expected in example.expected.items():
                with self.subTest(one.name, case=case):
                    conditions = Conditions(
                        case in ("aligned", "similar"),
                        case == "similar",
                        "line" if case == "line" else "same",
                        example.displacements,
                    )
                    left = Side("left", example.inputs, example.height, example.storeys)
                    right = Side("right", {**example.inputs, **example.right_inputs}, example.height, example.storeys)
                    level = Level("l", example.left, example.right, example.height)
                    found = evaluate(one, left, right, [level], conditions)
                    self.assertAlmostEqual(found["gap"], expected, places=12)

    def test_the_published_example_of_tbdy(self):
        # Reduced displacements of 18 and 24 mm, R = 8, I = 1.
        common = {"displacements": "reduced", "R": 8, "importance": 1, "height": 15}
        self.assertEqual(gap("TBDY", 18, 24, aligned=True, **common), (60, ""))
        self.assertEqual(gap("TBDY", 18, 24, **common), (120, ""))

    def test_every_rule_states_its_source_and_mark(self):
        self.assertEqual(len({one.name for one in rules()}), len(rules()))
        for one in rules():
            self.assertTrue(one.clause and one.source and one.statistic.source, one.name)
            self.assertEqual(one.mark, "" if one.verified else "check the edition")


class Factors(unittest.TestCase):
    def test_unreduced_displacements_have_no_factor(self):
        # A factor of 3 on q, R, Cd and so on changes nothing unless displacements are reduced.
        site = {"Z": 0.45, "S": 1.05, "ag": 2.5, "zone": "II", "intensity": 8, "system": "frame"}
        keys = {key for one in rules() if one.factor for key in one.factor.times}
        for one, kind in itertools.product(rules(), ("nonlinear", "elastic", "reduced")):
            found = [
                gap(one.name, 900, 700, 20, 9, displacements=kind, importance=1, **site, **dict.fromkeys(keys, factor))[
                    0
                ]
                for factor in (1, 3)
            ]
            with self.subTest(one.name, kind=kind):
                if kind == "reduced" and one.factor:
                    self.assertGreater(found[1], 2 * found[0])
                else:
                    self.assertEqual(*found)

    def test_each_structure_has_its_own_factor(self):
        # IS 1893: 5 x 10 + 3 x 12 = 86 mm; half only for similar units with aligned floors.
        one = {"displacements": "reduced", "R": 5, "own": {"R": 3}}
        self.assertEqual(gap("IS 1893", 10, 12, **one)[0], 86)
        self.assertEqual(gap("IS 1893", 10, 12, aligned=True, **one)[0], 86)
        self.assertEqual(gap("IS 1893", 10, 12, similar=True, **one)[0], 86)
        self.assertEqual(gap("IS 1893", 10, 12, aligned=True, similar=True, **one)[0], 43)

    def test_a_missing_input_is_named(self):
        self.assertEqual(gap("EN", 10, 12, displacements="reduced"), (None, "q"))
        self.assertEqual(gap("E.030", 10, 12, 20), (None, "Z"))
        self.assertIn("heights", gap("TBDY", 10, 12)[1])
        self.assertIn("property line", gap("GB", 10, 12, property="line")[1])

    def test_an_infinite_displacement_has_no_gap(self):
        self.assertEqual(gap("EN", float("inf"), 12), (None, ""))

    def test_an_unknown_code_is_refused(self):
        with raises(InputError, ["EM 1998", "EN 1998-1:2004"]):
            chosen(["EM 1998"])
        self.assertEqual([one.name for one in chosen(["asce"])], ["ASCE 7-16", "ASCE 7-22"])


class Widths(unittest.TestCase):
    def test_steps_of_tbdy(self):
        for height, expected in ((3, 30), (6, 30), (6.01, 40), (9, 40), (9.01, 50), (30, 110)):
            self.assertEqual(gap("TBDY", 0, 0, height)[0], expected, height)

    def test_widths_of_gb_50011(self):
        def width(height, intensity, system="frame", **more):
            return gap("GB", 0, 0, height, intensity=intensity, system=system, **more)[0]

        self.assertEqual([width(15, 8), width(15.1, 8), width(18, 8), width(18.1, 8)], [100, 120, 120, 140])
        # 45 m: 6, 8, 10 and 15 steps of 20 mm.
        self.assertEqual([width(45, one) for one in (6, 7, 8, 9)], [220, 260, 300, 400])
        self.assertEqual([width(45, 8, one) for one in ("frame", "frame_wall", "wall")], [300, 210, 150])
        self.assertEqual([width(21, 7, "wall"), width(21, 7, "frame", steel=True)], [100, 210])

    def test_widths_of_nsr_10_to_a_neighbour(self):
        line = {"property": "line", "height": 10}
        for storeys, aligned, offset in ((1, 0, 0), (2, 0, 0), (3, 0, 100), (4, 200, 300), (20, 200, 300)):
            self.assertEqual(gap("NSR", 5, 5, storeys=storeys, aligned=True, **line)[0], aligned)
            self.assertEqual(gap("NSR", 5, 5, storeys=storeys, **line)[0], offset)

    def test_a_property_line_needs_the_sum_of_the_setbacks(self):
        self.assertEqual(gap("ASCE 7-16", 30, 40)[0], 50)
        self.assertEqual(gap("ASCE 7-16", 30, 40, property="line")[0], 70)
        # 0.7 of EN 1998-1 is for aligned floors on one property.
        self.assertEqual([gap("EN", 30, 40, aligned=one)[0] for one in (False, True)], [50, 35])
        self.assertEqual(gap("EN", 30, 40, aligned=True, property="line")[0], 70)

    def test_a_wall_has_no_displacement_and_no_storeys(self):
        sides = Side("a", {"zone": "I"}, 20.0, 5), Side("wall", {"zone": "I"}, rigid=True)
        found = evaluate(rule("NTC-Sismo"), *sides, [Level("l", 0.1, 0.0, 20.0)], Conditions())
        self.assertAlmostEqual(found["gap"], 0.1 + 0.001 * 20)

    def test_standard_2800_by_height_up_to_eight_storeys(self):
        self.assertEqual(gap("Standard 2800", 900, 800, 20, 8)[0], 200)
        self.assertEqual(gap("Standard 2800", 900, 800, 20, 9)[0], 1700)


class Page(unittest.TestCase):
    def test_the_page_of_codes_is_that_of_the_data(self):
        spec = importlib.util.spec_from_file_location("code_page", ROOT / "python/docs/code_page.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        self.assertEqual(module.normal(module.page()), module.normal(module.PAGE.read_text()))


if __name__ == "__main__":
    unittest.main()
