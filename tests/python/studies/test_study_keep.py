"""Kept quantities of storeys, parts and members, and functions of Python, compared with the summary of `pounding run`."""

import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding.errors import InputError
from messages import raises
from study_samples import pair

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def roof(summary):
    """The displacement of the roof and the number of impacts."""
    left = summary["structures"]["left"]
    return {"roof": left["peak_displacement"][-1], "hits": len(summary["impacts"])}


def short(**changes):
    """Two frames with hinges under a short strong motion."""
    model = pounding.Model.from_file(EXAMPLES / "20_hinge_frames/model.yaml")
    model.ground_motion = {"synthetic": {"seed": 3, "duration": "3 s", "pga": "0.6 g", "soil": "firm"}}
    for name, value in changes.items():
        setattr(model, name, value)
    return model


class Quantities(unittest.TestCase):
    """Columns equal the numbers of one run of the same model."""

    @classmethod
    def setUpClass(cls):
        cls.keep = [
            "drift_ratio",
            "drift.left.3",
            "acceleration.right.1",
            "residual_drift.left",
            "residual_drift.left.2",
            "ductility",
            "ductility.left.column 1.0 start",
            "plastic_rotation.left",
            "member_force.left",
            "member_force.left.column 1.0.My",
            "storey_shear.left.1",
            roof,
        ]
        cls.study = pounding.study(short(), keep=cls.keep, without_links=True, workers=0)
        run = pounding.run(short())
        cls.once = run
        cls.left = run.summary["structures"]["left"]

    def test_floors_parts_and_members_equal_the_summary(self):
        one = self.study
        left, envelope = self.left, self.left["envelope"]
        self.assertEqual(one["drift.left.3"][0], left["peak_drift"][2])
        self.assertEqual(one["residual_drift.left"][0], max(map(abs, left["residual_drift"])))
        self.assertEqual(one["residual_drift.left.2"][0], abs(left["residual_drift"][1]))
        springs = {part["name"]: part for part in left["yielding"]["springs"]}
        self.assertEqual(one["ductility.left"][0], max(part["ductility"] for part in springs.values()))
        self.assertEqual(one["ductility.left.column 1.0 start"][0], springs["column 1.0 start"]["ductility"])
        self.assertEqual(one["plastic_rotation.left"][0], max(part["plastic"] for part in springs.values()))
        shear = envelope["storey_shear"]
        self.assertEqual(one["storey_shear.left.1"][0], max(-shear["min"][0], shear["max"][0]))
        member, moments = envelope["members"].index("column 1.0"), [2, 5]
        force = envelope["member_force"]
        both = [abs(force[side][member][j]) for side in ("min", "max") for j in moments]
        self.assertEqual(one["member_force.left.column 1.0.My"][0], max(both))
        every = np.abs([force["min"], force["max"]])[:, :, moments]
        self.assertEqual(one["member_force.left.My"][0], every.max())

    def test_a_drift_ratio_is_the_drift_divided_by_the_height_of_its_storey(self):
        # Storeys of 3 m: grid of lesson 20.
        heights = pounding.Model.from_file(EXAMPLES / "20_hinge_frames/model.yaml").structures["left"]["frame"]["grid"]
        height = float(str(heights["storey_height"]).split()[0])
        self.assertAlmostEqual(self.study["drift_ratio.left"][0], max(self.left["peak_drift"]) / height, places=15)

    def test_a_ratio_compares_with_the_run_without_links(self):
        ratio = self.study["ductility.left"] / self.study["ductility.left.alone"]
        np.testing.assert_array_equal(self.study["ductility.left.ratio"], ratio)
        self.assertGreater(self.study["plastic_rotation.left.alone"][0], 0)

    def test_units_follow_from_quantity_and_component(self):
        units = self.study.units
        for column, unit in (
            ("drift_ratio.left", ""),
            ("residual_drift.left", "m"),
            ("plastic_rotation.left", "rad"),
            ("member_force.left.N", "N"),
            ("member_force.left.My", "N m"),
            ("storey_shear.left.1", "N"),
        ):
            self.assertEqual(units[column], unit, column)

    def test_a_function_returns_numbers_of_the_complete_summary(self):
        self.assertEqual(self.study["roof"][0], self.left["peak_displacement"][-1])
        self.assertEqual(self.study["hits"][0], len(self.once.summary["impacts"]))


class Refusals(unittest.TestCase):
    """Unknown names are refused with similar ones."""

    def test_unknown_floors_parts_and_members(self):
        for word, facts in (
            ("drift.left.9", ["floor", "8"]),
            ("drift.left.0", ["floor", "8"]),
            ("drift.lft.3", ["lft", "left"]),
            ("member_force.left.column 1.9.My", ["column 1.9", "column 1.3"]),
            ("member_force.left.column 1.0.Mz", ["Mz", "My"]),
            ("ductility.left.column 1.0 strat", ["column 1.0 start"]),
            ("drift_ratioo", ["drift_ratio"]),
        ):
            with self.subTest(word), raises(InputError, facts):
                pounding.study(short(), keep=[word], workers=0)

    def test_quantities_that_the_model_does_not_have(self):
        for word, facts in (
            ("ductility", ["yielding", "drift"]),
            ("drift_ratio", ["storey_height"]),
            ("member_force", ["frame"]),
            ("residual_drift", ["yielding"]),
        ):
            with self.subTest(word), raises(InputError, [word, *facts]):
                pounding.study(pair(), keep=[word], workers=0)

    def test_the_kernel_leaves_them_to_the_solver(self):
        building = {
            "shear_building": {"storeys": 2, "mass": "100 t", "stiffness": "100 MN/m", "height": "3 m"},
            "damping": "5 %",
        }
        model = pair(structures={"left": building, "right": pair().structures["right"]})
        model.links[0]["between"] = ["left.1", "right"]
        record = {"synthetic": {"count": 1, "duration": "0.8 s", "pga": "0.3 g"}}
        both = pounding.study(model, records=record, keep=["drift.left.2", "drift_ratio.left.2"], workers=0)
        self.assertEqual(both.engines[both["engine"][0]], "solver")
        np.testing.assert_allclose(both["drift_ratio.left.2"], both["drift.left.2"] / 3, rtol=1e-15)

    def test_a_function_must_return_numbers_and_be_known_to_processes(self):
        with raises(InputError, ["number"]):
            pounding.study(pair(), keep=[lambda summary: "text"], workers=0)
        with raises(InputError, ["workers=0"]):
            pounding.study(pair(), keep=[lambda summary: 1.0], workers=2)

        def one(summary):
            return 1.0

        self.assertEqual(pounding.study(pair(), keep=[one], workers=0)["one"].tolist(), [1.0])

    def test_a_limit_of_a_member_force_names_its_component(self):
        with raises(InputError, ["component"]):
            pounding.study(short(), keep=["drift"], limits={"member_force.left": "5 MN"}, workers=0)


class FloorsInTheKernel(unittest.TestCase):
    """The kernel computes single floors; the solver agrees."""

    def test_both_engines_agree(self):
        building = {
            "shear_building": {"storeys": 3, "mass": "100 t", "stiffness": "100 MN/m", "height": "3 m"},
            "damping": "5 %",
        }
        model = pair(structures={"left": building, "right": pair().structures["right"]})
        model.links[0].update(between=["left.1", "right"], gap="10 mm")
        model.analysis = {}
        with tempfile.TemporaryDirectory() as folder:
            times = np.arange(0, 1.5, 0.01)
            path = os.path.join(folder, "a.csv")
            lines = [f"{t:.2f},{3 * np.sin(9 * t):.8f}" for t in times]
            Path(path).write_text("time,acc (m/s^2)\n" + "\n".join(lines) + "\n")
            keep = ["drift.left.2", "displacement.left.1", "drift.left"]
            made = pounding.study(model, records={"files": path}, keep=keep, workers=0)
        self.assertEqual(made.engines[made["engine"][0]], "kernel")
        by_solver = made.check[0]
        np.testing.assert_allclose([made[column][0] for column in keep], by_solver, rtol=1e-3)
        self.assertGreaterEqual(made["drift.left"][0], made["drift.left.2"][0])


if __name__ == "__main__":
    unittest.main()
