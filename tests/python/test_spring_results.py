"""Storeys that yield in the results of a run, as Python reads, prints, tabulates and draws them."""

import importlib.util
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from pounding import results, tables

MODEL = """\
ground_motion: {harmonic: {amplitude: 5.0, period: 0.6, duration: 2.0}}
structures:
  left:  {shear_building: {storeys: 4, mass: 200 t, stiffness: 60 MN/m, yield_force: [0.9 MN, 0.8 MN, 0.6 MN, 0.4 MN]}, damping: 5 %}
  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 300 MN/m, yield_force: 0.8 MN}, damping: 3 %}
  third: {oscillator: {mass: 100 t, period: 0.4, damping: 5 %}}
analysis: {duration: 2.5, output_step: 5 ms}
"""


def results_of(model):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "model.yaml").write_text(model)
        subprocess.run([os.environ["POUNDING_PROGRAM"], "run", "model.yaml", "-q", "-o", "out.h5"], cwd=folder, check=True)
        return results.RunData.from_image((Path(folder) / "out.h5").read_bytes())


class Springs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = results_of(MODEL)
        cls.left = cls.results.structures["left"].springs

    def test_are_read_with_their_histories_and_largest_values(self):
        self.assertEqual(self.left.names, [f"storey {i}" for i in range(1, 5)])
        self.assertEqual(self.left.laws, ["bilinear"] * 4)
        self.assertEqual(self.left.deformation.shape, (self.results.time.size, 4))
        np.testing.assert_allclose(self.left.deformation, self.results.structures["left"].drift, atol=1e-5)
        self.assertTrue((np.abs(self.left.largest["peak_deformation"]) >= np.abs(self.left.deformation).max(axis=0) * (1 - 1e-9)).all())
        self.assertEqual(self.left.number("storey 3"), 2)
        with self.assertRaisesRegex(KeyError, "storey 4"):
            self.left.number("storey 5")
        self.assertIsNone(self.results.structures["third"].springs)

    def test_are_printed_in_three_lines(self):
        lines = str(self.left).splitlines()
        self.assertEqual(len(lines), 3)
        self.assertIn("of 4 parts yielded; largest ductility", lines[1])

    @unittest.skipIf(importlib.util.find_spec("pandas") is None or importlib.util.find_spec("xarray") is None, "needs pandas and xarray")
    def test_are_tables(self):
        frame = tables.to_pandas(self.results)["structures/left/springs"]
        self.assertTrue((frame["force", "storey 2"].to_numpy() == self.left.force[:, 1]).all())
        self.assertEqual(tables.to_xarray(self.results)["structures/left/springs"]["hysteretic"].attrs["units"], "J")

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_are_drawn_as_the_loops_of_the_six_that_lose_most(self):
        from pounding.pictures.spring_loops import loops_figure
        from pounding.pictures.style import BadRequest
        figure = loops_figure(self.results)
        drawn = [axes for axes in figure.axes if axes.axison]
        lost = sorted((-lost, f"{name}, {part}") for name, one in self.results.structures.items() if one.springs is not None
                      for part, lost in zip(one.springs.names, one.springs.largest["hysteretic"]))
        self.assertEqual([axes.get_title(loc="left")[4:] for axes in drawn], [name for _, name in lost[:6]])
        [line] = [line for line in drawn[0].lines if len(line.get_xdata()) == self.results.time.size]
        name, part = lost[0][1].split(", ")
        springs = self.results.structures[name].springs
        np.testing.assert_allclose(line.get_xdata(), 1e3 * springs.deformation[:, springs.number(part)])
        chosen = loops_figure(self.results, parts=[("right", "storey 1")], size=(3.5, 3.0))
        self.assertEqual(chosen.axes[0].get_title(loc="left"), "(a) right, storey 1")
        for wrong, words in ((("other", "storey 1"), "there is left"), (("left", "storey 9"), "storey 4"), (("third", "storey 1"), "elastic")):
            with self.assertRaisesRegex(BadRequest, words):
                loops_figure(self.results, parts=[wrong])

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_show_their_residual_drifts_in_the_run_picture(self):
        from pounding.pictures.run_picture import standard_figure
        [axes] = [axes for axes in standard_figure(self.results).axes if "at the end" in axes.get_title(loc="left")]
        heights = [patch.get_height() for patch in axes.patches]
        summary = self.results.summary["structures"]["left"]
        np.testing.assert_allclose(heights[:4], 1e3 * np.array(summary["peak_drift"]))
        np.testing.assert_allclose(heights[4:8], 1e3 * np.abs(summary["residual_drift"]))


if __name__ == "__main__":
    unittest.main()
