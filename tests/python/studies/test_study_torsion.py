"""Rotations and edge displacements of rigid floors in space, in tables of studies."""

import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding.errors import InputError
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan
from messages import raises


def corner(name, **grid):
    """A frame in space with a stiff corner, so that it rotates."""
    return {
        "frame": {
            "material": {"E": "30 GPa"},
            "sections": {"C": {"rectangle": ["0.4 m", "0.4 m"]}, "W": {"rectangle": ["0.8 m", "0.8 m"]}},
            "grid": {
                "storeys": 1,
                "bays": [1, 1],
                "storey_height": "3 m",
                "bay_width": "5 m",
                "columns": [["W", "C", "C", "C"]],
                "beams": "C",
                "floor_mass": "60 t",
                **grid,
            },
            "origin": [{"a": 0, "b": "5.01 m"}[name], 0],
        },
        "damping": "5 %",
    }


def model(**second):
    return pounding.Model(
        structures={
            "a": corner("a"),
            "b": corner("b", **second),
            "rod": {"oscillator": {"mass": "100 t", "period": "0.5 s", "damping": "5 %"}},
        },
        links=[{"between": ["a", "b"], "floors": "all", "law": "hertz_damped", "stiffness": "1e9", "restitution": 0.6}],
        ground_motion={"synthetic": {"seed": 1, "duration": "1 s", "pga": "0.3 g", "soil": "firm"}},
        analysis={"tolerance": 1e-3},
    )


def plan_of(of, **words):
    return make_plan(
        of,
        {"factors": {"mass": {"of": "structures.*.frame.grid.floor_mass", "list": ["60 t", "90 t"]}}, **words},
        Path(),
    )


class Torsion(unittest.TestCase):
    def test_is_kept_as_single_runs_report_it(self):
        plan = plan_of(model(), keep=["rotation", "edge_displacement.b", "displacement.b"], limits={"rotation": 0.01})
        self.assertEqual(
            [column for column in plan.template.kept.columns if "alone" not in column and "ratio" not in column],
            ["rotation.a", "rotation.b", "edge_displacement.b", "displacement.b"],
        )
        self.assertEqual(
            (plan.template.kept.units()["rotation.a"], plan.template.kept.units()["edge_displacement.b"]), ("rad", "m")
        )
        study = run_plan(plan, None, workers=1)
        self.assertEqual(study.failed, {})
        for row, mass in enumerate(("60 t", "90 t")):
            one = model(floor_mass=mass)
            one.structures["a"]["frame"]["grid"]["floor_mass"] = mass
            structures = pounding.run(one).summary["structures"]
            for column, key in (
                ("rotation.a", "peak_rotation"),
                ("rotation.b", "peak_rotation"),
                ("edge_displacement.b", "peak_edge_displacement"),
            ):
                self.assertEqual(study[column][row], structures[column[-1]][key][0], column)
            self.assertGreater(study["edge_displacement.b"][row], 1.01 * study["displacement.b"][row])
        self.assertEqual(study.limit_of("rotation.a", "5 mrad"), 0.005)

    def test_of_the_run_without_links_has_ratios(self):
        study = run_plan(plan_of(model(), keep=["rotation.a"], without_links=True), None, workers=1)
        np.testing.assert_allclose(study["rotation.a.ratio"], study["rotation.a"] / study["rotation.a.alone"])

    def test_of_structures_without_rigid_floors_in_space_is_refused(self):
        loose = model(rigid_floors=False)
        self.assertEqual(plan_of(loose, keep=["rotation"]).template.kept.columns, ("rotation.a",))
        for word in ("rotation.b", "edge_displacement.b", "rotation.rod"):
            with self.subTest(word), raises(InputError):
                plan_of(loose, keep=[word])
        with raises(InputError, "c"):
            plan_of(loose, keep=["rotation.c"])


if __name__ == "__main__":
    unittest.main()
