"""Frames placed in rows, links between all neighbours, and the block used in a lesson."""

import copy
import os
import runpy
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding import plan
from messages import assert_mentions, raises

PROGRAM = os.environ["POUNDING_PROGRAM"]
LESSON = Path(os.environ["POUNDING_EXAMPLES"]) / "25_city_block"
BLOCK = runpy.run_path(str(LESSON / "city_block.py"))


def house(bays=(2, 1), width="5 m", storeys=2):
    return {
        "frame": {
            "material": {"E": "30 GPa"},
            "grid": {
                "storeys": storeys,
                "bays": list(bays),
                "storey_height": "3 m",
                "bay_width": width,
                "columns": {"rectangle": [0.4, 0.4]},
                "beams": {"rectangle": [0.3, 0.5]},
                "floor_mass": "60 t",
            },
        },
        "damping": "5 %",
    }


def plane(bays=2):
    words = house(storeys=1)
    words["frame"]["grid"]["bays"] = bays
    return words


def origins(structures):
    return {name: words["frame"]["origin"] for name, words in structures.items()}


class Rows(unittest.TestCase):
    def test_stand_one_after_the_other(self):
        given = {"a": house(), "b": house((3, 1)), "c": house((1, 1), {"x": [4.0], "y": "6 m"})}
        before = copy.deepcopy(given)
        row = plan.row(given, ["30 mm", 0.05], start=("2 m", 1))
        self.assertEqual(origins(row), {"a": [2.0, 1.0], "b": [12.03, 1.0], "c": [27.08, 1.0]})
        self.assertEqual(plan.extent(row), (2.0, 31.08, 1.0, 7.0))
        self.assertEqual((plan.extent(row).width, plan.extent(row).depth), (29.08, 6.0))
        self.assertEqual(given, before)

    def test_stand_along_y_and_in_line_where_x_is_largest(self):
        row = plan.row({"a": house(), "b": house((3, 2))}, 0.03, along="y", start=(20, 0), align="high")
        self.assertEqual(origins(row), {"a": [10.0, 0.0], "b": [5.0, 5.03]})
        self.assertEqual(plan.extent(row), (5.0, 20.0, 0.0, 15.03))

    def test_replace_an_origin_and_keep_its_height(self):
        raised = house()
        raised["frame"]["origin"] = ["7 m", 3, "1.5 m"]
        self.assertEqual(plan.extent({"a": raised}), (7.0, 17.0, 3.0, 8.0))
        self.assertEqual(
            origins(plan.row({"a": raised, "b": house()}, 0.1)), {"a": [0.0, 0.0, "1.5 m"], "b": [10.1, 0.0]}
        )

    def test_of_plane_frames_have_no_depth(self):
        raised = plane(3)
        raised["frame"]["origin"] = [0, "2 m"]  # x and z
        row = plan.row({"a": plane(), "b": raised}, "20 mm")
        self.assertEqual(origins(row), {"a": [0.0], "b": [10.02, "2 m"]})
        self.assertEqual(plan.extent(row), (0.0, 25.02, 0.0, 0.0))

    def test_leave_the_gap_between_faces(self):
        drawn = {"a": {**house(), "face": "0.2 m"}, "b": house(), "c": house()}
        drawn["b"]["frame"]["face"] = 0.25
        self.assertEqual(origins(plan.row(drawn, "30 mm")), {"a": [0.0, 0.0], "b": [10.48, 0.0], "c": [20.76, 0.0]})
        model = pounding.Model(
            plan.row(drawn, "30 mm"),
            [{"between": "neighbours", "law": "hertz", "stiffness": 1e9}],
            analysis={"duration": 1},
        )
        assert_mentions(pounding.check(model).description, ["30 mm", "200 mm", "250 mm"])
        drawn["a"]["face"] = "auto"
        with raises(pounding.InputError, "face"):
            plan.row(drawn, "30 mm")

    def test_take_frames_by_nodes(self):
        mast = {"frame": {"nodes": {"foot": [1, 2, 0], "top": ["1 m", "2.5 m", 9]}}}
        self.assertEqual(plan.extent({"m": mast}), (1.0, 1.0, 2.0, 2.5))
        self.assertEqual(origins(plan.row({"m": mast, "n": mast}, 0.5)), {"m": [-1.0, -2.0], "n": [-0.5, -2.0]})

    def test_say_what_is_wrong(self):
        def refused(text, *given, **more):
            with self.assertRaises(pounding.InputError) as caught:
                plan.row(*given, **more)
            assert_mentions(str(caught.exception), text)

        refused(["along", "z"], {"a": house()}, 0.1, along="z")
        refused(["align", "left"], {"a": house()}, 0.1, align="left")
        refused(["gap", "2"], {"a": house(), "b": house()}, [0.1, 0.2])
        refused("gap", {"a": house(), "b": house()}, "-1 mm")
        refused(["frame", "structures.o"], {"o": {"oscillator": {}}}, 0.1)
        refused("structures.a", {"a": plane()}, 0.1, along="y")
        refused("structures.a.frame", {"a": {"frame": {}}}, 0.1)
        with raises(pounding.InputError):
            plan.extent({})


class Neighbours(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def corner(self, links):
        made = BLOCK["model"](BLOCK["corner"](), "corner")
        made.links, made.compare = links, None
        made.analysis = {"duration": 4.5, "tolerance": "1e-3"}
        return made

    def test_linked_by_a_word_and_by_hand_give_the_same_bits(self):
        law = {"points": 2, "law": "hertz_damped", "stiffness": 1.4e9, "restitution": 0.65}
        found = pounding.run(self.corner([{"between": "neighbours", **law}]))
        by_hand = pounding.run(
            self.corner([{"between": ["corner", other], "floors": "all", **law} for other in ("south1", "west1")])
        )
        self.assertGreater(found.impacts.size, 20)
        self.assertEqual(found.resolved_yaml, by_hand.resolved_yaml)
        np.testing.assert_array_equal(found.impacts, by_hand.impacts)
        for name, structure in by_hand.structures.items():
            for axis, motion in structure.along.items():
                np.testing.assert_array_equal(found.structures[name].along[axis].displacement, motion.displacement)

    def test_of_a_run_that_is_resumed_give_the_same_bits(self):
        model = self.corner(
            [{"between": "neighbours", "points": 2, "law": "hertz_damped", "stiffness": 1.4e9, "restitution": 0.65}]
        )
        file, cut = self.folder / "m.yaml", self.folder / "cut.h5"
        file.write_text(model.to_yaml())
        subprocess.run([PROGRAM, "run", file, "-q", "-o", cut, "-pounding_ts_max_steps", "500"], capture_output=True)
        self.assertNotEqual(pounding.read(cut).status, "done")
        resumed = pounding.resume(cut, options={"ts_max_steps": 100000})
        whole = pounding.run(model)
        self.assertEqual(resumed.status, "done")
        np.testing.assert_array_equal(resumed.impacts, whole.impacts)
        np.testing.assert_array_equal(
            resumed.structures["corner"].displacement, whole.structures["corner"].displacement
        )

    def test_are_printed_by_a_model(self):
        assert_mentions(str(BLOCK["model"](BLOCK["corner"](), "corner")), ["links", "hertz_damped"])


class Lesson(unittest.TestCase):
    def test_model_is_what_its_script_writes(self):
        done = subprocess.run([sys.executable, LESSON / "city_block.py"], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, (LESSON / "model.yaml").read_text())

    def test_block_is_a_ring(self):
        """Every building has two neighbours, the previous and the next one around the courtyard."""
        made = BLOCK["model"](BLOCK["ring"](4, 3), "block", tolerance="1e-3")
        self.assertEqual(len(made.structures), 14)
        names = [
            line.split(":")[0].removeprefix("link ")
            for line in pounding.check(made).description.splitlines()
            if line.startswith("link ")
        ]
        pairs = {frozenset(end.split(".")[0] for end in name.split("#")[0].split("-")) for name in names}
        ring = """
            south_west south1 south2 south_east east1 east2 east3 north_east north2 north1 north_west
            west3 west2 west1
        """.split()
        self.assertEqual(pairs, {frozenset(pair) for pair in zip(ring, ring[1:] + ring[:1])})
        self.assertEqual(set(made.structures), set(ring))


if __name__ == "__main__":
    unittest.main()
