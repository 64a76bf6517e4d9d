"""Pictures of mode shapes, from the output of `pounding modes --json` and from frames."""

import copy
import json
import os
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import frame_samples
from pounding import _mode_shapes as mode_shapes
from pounding._pictures.drawing import project
from pounding._pictures.style import BadRequest
from pounding.errors import InputError
from messages import raises

PROGRAM = os.environ["POUNDING_PROGRAM"]
MODEL = """
structures:
  slender: {shear_building: {storeys: 3, mass: 100 t, stiffness: 50 MN/m, damping: 5 %}}
  ball: {body: {mass: 1 t}}
links: []
analysis: {duration: 1}
"""


def mode(period, shape):
    return {"period": period, "damping_ratio": 0.05, "participation": 1.2, "effective_mass": 1e5, "shape": shape}


def example():
    """A plane frame, a space frame, and a structure of three floors."""
    modes = {
        "modes": {"old": [mode(0.5, [0.4, 0.8, 1.0]), mode(0.2, [-1.2, -0.5, 1.0])], "wall": []},
        "geometry": {},
        "node_shapes": {},
        "elevations": {"old": [3.0, 6.0, 10.0]},
    }
    for dimension, name in ((2, "plane"), (3, "space")):
        nodes, members, _, _ = frame_samples.grid(dimension, 3, 0)
        shape = np.zeros_like(nodes)
        shape[:, dimension - 2] = 7 * nodes[:, 2]
        modes["modes"][name] = [mode(1.0, [1.0])]
        modes["geometry"][name] = {"dimension": dimension, "nodes": nodes.tolist(), "members": members.tolist()}
        modes["node_shapes"][name] = [shape.tolist()]
    return modes


def plot(modes):
    return mode_shapes.plot_modes(mode_shapes.read_modes(modes))


class ModeShapes(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("error")
        self.addCleanup(warnings.resetwarnings)

    def test_profile_goes_through_the_amplitudes(self):
        axes = plot(example()).axes[1]
        line = axes.lines[-1]
        np.testing.assert_array_equal(line.get_xdata(), [0, -1.2, -0.5, 1])
        np.testing.assert_array_equal(line.get_ydata(), [0, 3, 6, 10])
        self.assertEqual(axes.get_title(loc="left"), "old, mode 2\nT = 0.2 s, 5 % damping")

    def test_frame_is_deformed_by_its_node_shapes(self):
        modes = example()
        figure = plot(modes)
        for name, view, direction in (("plane", "elevation", 0), ("space", "oblique", 1)):
            axes = next(a for a in figure.axes if a.get_title(loc="left").startswith(f"{name}, mode 1"))
            nodes, members = np.array(modes["geometry"][name]["nodes"]), np.array(modes["geometry"][name]["members"])
            rest, moved = (lines.get_segments() for lines in axes.collections)
            np.testing.assert_allclose(rest, project(nodes, view)[members])
            displaced = nodes.copy()
            displaced[:, direction] += (
                mode_shapes.DRAWN_SIZE * np.ptp(nodes, axis=0).max() * nodes[:, 2] / nodes[:, 2].max()
            )
            np.testing.assert_allclose(moved, project(displaced, view)[members])

    def test_shapes_that_do_not_fit_are_refused(self):
        modes = example()
        short, missing = copy.deepcopy(modes), copy.deepcopy(modes)
        short["node_shapes"]["plane"][0].pop()
        missing["node_shapes"]["plane"] = []
        for wrong, words in (
            (short, ["plane", "node_shapes", "11", "3", "12"]),
            (missing, ["plane", "node_shapes"]),
            ({"wall": []}, ()),
        ):
            with raises(BadRequest, words):
                plot(wrong)

    def test_what_the_program_prints_is_drawn(self):
        with tempfile.TemporaryDirectory() as directory:
            model, modes, picture = (Path(directory) / name for name in ("model.yaml", "modes.json", "modes.png"))
            model.write_text(MODEL)
            done = subprocess.run([PROGRAM, "modes", "--json", model], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            modes.write_text(done.stdout)
            self.assertEqual(mode_shapes.main([str(modes), "-o", str(picture)]), 0)
            self.assertEqual(picture.read_bytes()[1:4], b"PNG")
            figure = plot(json.loads(done.stdout))
            self.assertTrue(figure.axes[3].get_title(loc="left").startswith("ball, mode 1\nno period"))

    def test_other_files_are_refused(self):
        with tempfile.NamedTemporaryFile("w") as file:
            file.write("no json")
            file.flush()
            with raises(InputError, file.name):
                mode_shapes.main([file.name, "-o", "x.png"])


if __name__ == "__main__":
    unittest.main()
