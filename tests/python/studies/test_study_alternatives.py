"""Factors that replace whole maps of the model, and factors for the gap of drawn frames."""

import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding.errors import InputError
from messages import raises
from study_samples import pair

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
LAWS = {
    "of": "links.0",
    "alternatives": {
        "lin": {"law": "linear_spring", "stiffness": "93.5 MN/m"},
        "her": {"law": "hertz", "stiffness": "2.75e9"},
    },
}


def isolated(kind):
    """A shear building on isolators next to a wall."""
    building = {
        "shear_building": {"storeys": 3, "mass": "300 t", "stiffness": ["500 MN/m", "400 MN/m"], "isolator": kind},
        "damping": "2 %",
    }
    return pair(
        structures={"wall": {"wall": {}}, "house": building},
        links=[
            {
                "between": ["wall", "house.1"],
                "gap": "5 mm",
                "law": "kelvin_voigt",
                "stiffness": "500 MN/m",
                "restitution": "0.6",
            }
        ],
    )


LRB = {"lead_rubber": {"strength": "300 kN", "yield_displacement": "10 mm", "post_yield_stiffness": "10 MN/m"}}
FPS = {"friction_pendulum": {"radius": "2 m", "friction": "6 %"}}


class Alternatives(unittest.TestCase):
    def test_each_row_is_the_run_of_its_model(self):
        made = pounding.study(
            isolated(LRB),
            {"kind": {"of": "structures.house.shear_building.isolator", "alternatives": {"LRB": LRB, "FPS": FPS}}},
            keep=["displacement.house"],
            workers=0,
        )
        for row, kind in enumerate((LRB, FPS)):
            run = pounding.run(isolated(kind))
            self.assertEqual(
                made["displacement.house"][row], max(run.summary["structures"]["house"]["peak_displacement"])
            )
        self.assertNotEqual(*made["displacement.house"])

    def test_a_law_keeps_the_other_keys_of_its_link(self):
        made = pounding.study(pair(), {"law": LAWS}, keep=["force"], workers=0)
        for row, law in enumerate(("linear_spring", "hertz")):
            self.assertIn(f"law: {law}", made.model_of(row))
            self.assertIn("gap: 1 mm", made.model_of(row))
            self.assertNotIn("restitution", made.model_of(row))
        np.testing.assert_array_equal(made.choose(law="her"), [False, True])

    def test_both_engines_and_chunks_give_the_same_rows(self):
        factors = {"law": LAWS, "period": {"of": "structures.right.oscillator.period", "list": ["0.3 s", "0.5 s"]}}
        one = pounding.study(pair(), factors, keep=["force"], workers=0)
        two = pounding.study(pair(), factors, keep=["force"], workers=0, chunk=1)
        self.assertEqual(one["force"].tobytes(), two["force"].tobytes())
        self.assertEqual(len(set(one["force"].tolist())), 4)

    def test_refusals(self):
        for factors, facts in (
            ({"law": {"of": "links.0.gap", "alternatives": {"a": {"x": 1}}}}, ["links.0.gap", "list"]),
            ({"law": {"of": "links.0", "alternatives": {"a": "hertz"}}}, ["alternatives.a", "map"]),
            ({"law": LAWS, "gap": {"of": "links.*.gap", "list": ["1 mm"]}}, ["links.0.gap", "links.0", "law"]),
        ):
            with self.subTest(facts=facts), raises(InputError, facts):
                pounding.study(pair(), factors, workers=0)


class Gaps(unittest.TestCase):
    """Frames of lesson 17, whose gap of 50 mm follows from their drawing."""

    @classmethod
    def setUpClass(cls):
        cls.model = pounding.Model.from_file(EXAMPLES / "17_uneven_pair/model.yaml")
        cls.model.ground_motion = {"synthetic": {"seed": 7, "duration": "2 s", "pga": "0.35 g", "soil": "firm"}}

    def test_the_drawn_gap_gives_the_run_of_the_model(self):
        made = pounding.sweep(self.model, {"gaps.tower-annex": ["50 mm", "80 mm"]}, keep=["displacement.tower"])
        self.assertEqual(made.factors, ["gap"])
        run = pounding.run(self.model)
        np.testing.assert_allclose(
            made["displacement.tower"][0], max(run.summary["structures"]["tower"]["peak_displacement"]), rtol=1e-9
        )
        for row, origin in enumerate((18.05, 18.08)):
            moved = pounding.Model._from_text(made.model_of(row), "row")
            self.assertAlmostEqual(float(moved.structures["annex"]["frame"]["origin"][0]), origin, places=12)

    def test_the_left_frame_moves_to_the_left_if_the_right_one_is_linked_to_a_third(self):
        model = self.model.copy()
        third = {
            **model.structures["annex"],
            "frame": {**model.structures["annex"]["frame"], "origin": ["30.2 m", "0 m"]},
        }
        model.structures = {**model.structures, "third": third}
        model.links = [*model.links, {**model.links[0], "between": ["annex", "third"]}]
        made = pounding.sweep(model, {"gaps.tower-annex": ["60 mm"]}, keep=["displacement.tower"])
        moved = pounding.Model._from_text(made.model_of(0), "row")
        self.assertAlmostEqual(float(moved.structures["tower"]["frame"]["origin"][0]), -0.01, places=12)

    def test_refusals(self):
        with raises(InputError, ["towr-annex", "tower-annex"]):
            pounding.sweep(self.model, {"gaps.towr-annex": ["50 mm"]})
        with raises(InputError, ["links.*.gap"]):
            pounding.sweep(pair(), {"gaps.left-right": ["50 mm"]})
        with raises(InputError, ["structures.tower.frame.grid.bay_width"]):
            pounding.sweep(
                self.model, {"gaps.tower-annex": ["50 mm"], "structures.tower.frame.grid.bay_width": ["6 m", "7 m"]}
            )


if __name__ == "__main__":
    unittest.main()
