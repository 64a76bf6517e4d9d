"""Bars and dampers in the results of a run, as read, printed and tabulated by Python."""

import importlib.util
import unittest

import numpy as np

from pounding import _tables as tables
from messages import assert_mentions
from test_spring_results import results_of

MODEL = """\
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 1.0}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
devices:
  both ways: {between: [left, right], bar: {stiffness: 5 MN/m}, damper: {coefficient: 200 kN (s/m)^0.5, exponent: 0.5}}
analysis: {duration: 1.0, output_step: 10 ms}
"""


class Devices(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = results_of(MODEL)

    def test_are_read_with_their_histories_and_largest_values(self):
        device = self.results.devices["both ways"]
        self.assertEqual(
            (device.left, device.left_end, device.right, device.right_end), ("left", "floor 1", "right", "floor 1")
        )
        self.assertEqual((device.stiffness, device.coefficient, device.exponent), (5e6, 2e5, 0.5))
        self.assertEqual(device.force.shape, self.results.time.shape)
        least, largest = device.largest["force"]
        self.assertLessEqual(least, device.force.min())
        self.assertGreaterEqual(largest, device.force.max())
        at = np.interp(device.largest["elongation_time"], self.results.time, device.elongation)
        # straight lines between the output times
        np.testing.assert_allclose(at, device.largest["elongation"], rtol=3e-3)
        self.assertGreater(self.results.energy["devices"][-1], 0)

    def test_are_printed(self):
        lines = str(self.results.devices["both ways"]).splitlines()
        assert_mentions(lines[0], ["both ways", "stiffness 5e+06", "coefficient 2e+05", "exponent 0.5"])
        assert_mentions(lines[2], ["elongation (time: 101) [m]"])
        assert_mentions(str(lines), ["largest.force"])

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_have_their_part_of_the_energy_in_the_picture(self):
        from matplotlib.figure import Figure

        from pounding._pictures.histories import draw_energies

        axes = Figure().subplots()
        draw_energies(axes, self.results)
        self.assertIn("dampers between", [text.get_text() for text in axes.get_legend().get_texts()])
        top = max(part.get_paths()[0].vertices[:, 1].max() for part in axes.collections)
        self.assertAlmostEqual(
            top, axes.lines[0].get_ydata().max(), delta=1e-3 * top, msg="the parts add up to the input"
        )

    @unittest.skipIf(
        importlib.util.find_spec("pandas") is None or importlib.util.find_spec("xarray") is None,
        "needs pandas and xarray",
    )
    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_are_drawn_as_loops_with_the_energy_that_they_lose(self):
        from pounding._pictures.spring_loops import loops_figure

        drawn = [axes for axes in loops_figure(self.results).axes if axes.axison]
        lost = sorted(self.results.summary["devices"], key=lambda one: -one["energy_lost"])
        self.assertEqual(
            [axes.get_title(loc="left")[4:].split(",")[0] for axes in drawn], [one["name"] for one in lost]
        )
        for axes, one in zip(drawn, lost):
            device = self.results.devices[one["name"]]
            [line] = [line for line in axes.lines if len(line.get_xdata()) == self.results.time.size]
            np.testing.assert_allclose(line.get_xdata(), 1e3 * device.elongation)
            # The area of the loop is the energy that it dissipated plus the one stored in its bar; straight lines
            # between the output times miss a little.
            area = float(np.sum(0.5 * (device.force[1:] + device.force[:-1]) * np.diff(device.elongation)))
            stored = 0.5 * device.stiffness * device.elongation[-1] ** 2
            self.assertAlmostEqual((area - stored) / one["energy_lost"], 1, delta=0.03)

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_are_dashed_lines_between_their_ends_in_a_report(self):
        from matplotlib.figure import Figure

        from pounding._pictures.model_picture import spread_scene
        from pounding._report.drawings import model_drawing

        figure = Figure()
        model_drawing(figure, (0, 0, 1, 1), self.results)
        [line] = [line for axes in figure.axes for line in axes.lines if line.get_color() == "black"]
        scene = spread_scene(self.results, 0.04)
        ends = [scene.at_rest(name)[-1] for name in ("left", "right")]
        np.testing.assert_allclose(line.get_xydata(), [[x, z] for x, _, z in ends])

    def test_are_tables(self):
        device = self.results.devices["both ways"]
        self.assertTrue((tables.to_pandas(self.results)["devices/both ways"]["force"].to_numpy() == device.force).all())
        self.assertEqual(tables.to_xarray(self.results)["devices/both ways"]["elongation"].attrs["units"], "m")

    def test_are_none_in_a_run_without_them(self):
        without = results_of(
            "".join(line + "\n" for line in MODEL.splitlines() if "devices" not in line and "both ways" not in line)
        )
        self.assertEqual(without.devices, {})
        self.assertNotIn("devices", without.energy)


if __name__ == "__main__":
    unittest.main()
