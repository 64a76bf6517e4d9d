"""Yielding storeys in the results of a run, as read, printed, tabulated and drawn by Python."""

import dataclasses
import importlib.util
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from pounding import results, _tables as tables
from messages import assert_mentions, raises

MODEL = """\
ground_motion: {harmonic: {amplitude: 5.0, period: 0.6, duration: 2.0}}
structures:
  left:  {shear_building: {storeys: 4, mass: 200 t, stiffness: 60 MN/m, yield_force: [0.9 MN, 0.8 MN, 0.6 MN, 0.4 MN]}, damping: 5 %}
  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 300 MN/m, yield_force: 0.8 MN}, damping: 3 %}
  third: {oscillator: {mass: 100 t, period: 0.4, damping: 5 %}}
analysis: {duration: 2.5, output_step: 5 ms}
"""
#: Two portal frames, 20 mm apart, whose columns yield at both ends.
PORTAL = """\
  {name}:
    frame:
      origin: [{origin} m, 0 m]
      material: {{E: 30 GPa, poisson: 0.2}}
      grid: {{storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {{rectangle: [0.4 m, 0.4 m]}}, beams: {{rectangle: [0.4 m, 0.6 m]}},
             floor_mass: {mass} t}}
      hinges: {{columns: {{at: both, yield_moment: 80 kN m, hardening: 3 %, ultimate_rotation: 0.0005}}}}
    damping: 5 %
"""
FRAMES = (
    "ground_motion: {harmonic: {amplitude: 4.0, period: 0.5, duration: 2.0}}\nstructures:\n"
    + PORTAL.format(name="left", origin=0, mass=90)
    + PORTAL.format(name="right", origin=6.02, mass=30)
    + "links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]\n"
    "analysis: {duration: 2.5, output_step: 5 ms}\n"
)


def results_of(model):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "model.yaml").write_text(model)
        subprocess.run(
            [os.environ["POUNDING_PROGRAM"], "run", "model.yaml", "-q", "-o", "out.h5"], cwd=folder, check=True
        )
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
        self.assertTrue(
            (
                np.abs(self.left.largest["peak_deformation"]) >= np.abs(self.left.deformation).max(axis=0) * (1 - 1e-9)
            ).all()
        )
        self.assertEqual(self.left.number("storey 3"), 2)
        with raises(KeyError, "4"):
            self.left.number("storey 5")
        self.assertIsNone(self.results.structures["third"].springs)

    def test_are_printed(self):
        assert_mentions(str(self.left), ["storey 1", "laws bilinear", "spring: 4) [N/m]", "largest.ductility (4,)"])

    @unittest.skipIf(
        importlib.util.find_spec("pandas") is None or importlib.util.find_spec("xarray") is None,
        "needs pandas and xarray",
    )
    def test_are_tables(self):
        frame = tables.to_pandas(self.results)["structures/left/springs"]
        self.assertTrue((frame["force", "storey 2"].to_numpy() == self.left.force[:, 1]).all())
        self.assertEqual(tables.to_xarray(self.results)["structures/left/springs"]["hysteretic"].attrs["units"], "J")

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_are_drawn_as_the_loops_of_the_six_that_lose_most(self):
        from pounding._pictures.spring_loops import loops_figure
        from pounding._pictures.style import BadRequest

        figure = loops_figure(self.results)
        drawn = [axes for axes in figure.axes if axes.axison]
        lost = sorted(
            (-lost, f"{name}, {part}")
            for name, one in self.results.structures.items()
            if one.springs is not None
            for part, lost in zip(one.springs.names, one.springs.largest["hysteretic"])
        )
        self.assertEqual([axes.get_title(loc="left")[4:] for axes in drawn], [name for _, name in lost[:6]])
        [line] = [line for line in drawn[0].lines if len(line.get_xdata()) == self.results.time.size]
        name, part = lost[0][1].split(", ")
        springs = self.results.structures[name].springs
        np.testing.assert_allclose(line.get_xdata(), 1e3 * springs.deformation[:, springs.number(part)])
        chosen = loops_figure(self.results, parts=[("right", "storey 1")], size=(3.5, 3.0))
        self.assertEqual(chosen.axes[0].get_title(loc="left"), "(a) right, storey 1")
        for wrong, words in ((("other", "storey 1"), ()), (("left", "storey 9"), "4"), (("third", "storey 1"), ())):
            with raises(BadRequest, words):
                loops_figure(self.results, parts=[wrong])

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_show_their_residual_drifts_in_the_run_picture(self):
        from pounding._pictures.run_picture import standard_figure

        [axes] = [axes for axes in standard_figure(self.results).axes if "at the end" in axes.get_title(loc="left")]
        heights = [patch.get_height() for patch in axes.patches]
        summary = self.results.summary["structures"]["left"]
        np.testing.assert_allclose(heights[:4], 1e3 * np.array(summary["peak_drift"]))
        np.testing.assert_allclose(heights[4:8], 1e3 * np.abs(summary["residual_drift"]))

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_are_storeys_of_a_map_coloured_by_ductility(self):
        from matplotlib.colors import to_rgba
        from pounding._pictures.hinge_map import COLOURS, hinges_figure

        figure = hinges_figure(self.results)
        axes, bar = figure.axes
        self.assertEqual(bar.get_ylabel(), "Ductility")
        largest = max(
            one.springs.largest["ductility"].max()
            for one in self.results.structures.values()
            if one.springs is not None
        )
        np.testing.assert_allclose(bar.get_ylim(), (1, largest))
        colours = {to_rgba(line.get_color()) for line in axes.lines}
        for one in self.results.structures.values():
            for ductility, state in (
                zip(one.springs.largest["ductility"], one.springs.states) if one.springs is not None else ()
            ):
                expected = COLOURS((ductility - 1) / (largest - 1)) if state == "yielded" else to_rgba("white")
                self.assertIn(expected, colours)
        numbers = {text.get_text() for text in axes.texts}
        self.assertIn(f"{largest:.3g}", numbers)
        legends_fit(self, figure)
        legends_fit(self, hinges_figure(self.results, size=(3.3, 2.8)))

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
    def test_a_map_needs_something_that_yields(self):
        from pounding._pictures.hinge_map import hinges_figure
        from pounding._pictures.style import BadRequest

        elastic = dataclasses.replace(self.results, structures={"third": self.results.structures["third"]})
        with raises(BadRequest):
            hinges_figure(elastic)


@unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "needs matplotlib")
class HingeMap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = results_of(FRAMES)

    def marks(self):
        from pounding._pictures.hinge_map import APART, _marks, measure_of
        from pounding._pictures.model_picture import spread_scene

        scene = spread_scene(self.results, APART)
        return scene, {(mark.structure, mark.name): mark for mark in _marks(scene, measure_of(self.results))}

    def test_hinges_stand_at_the_ends_of_their_members(self):
        scene, marks = self.marks()
        self.assertEqual(len(marks), 8)
        # The columns are 3 m high, with the circles at 7 % of the height from their ends; the frames begin 0 and 6.02 m
        # from the origin.
        apart = scene.scale * 0.02
        for (structure, name), place in (
            (("left", "column 1.0 start"), (0, 0.21)),
            (("left", "column 1.1 end"), (6, 2.79)),
            (("right", "column 1.0 start"), (6 + apart, 0.21)),
            (("right", "column 1.1 start"), (12 + apart, 0.21)),
        ):
            np.testing.assert_allclose(marks[structure, name].points, [[place[0], 0, place[1]]], atol=1e-9)
        self.assertGreater(apart, 0.5)

    def test_hinges_with_an_ultimate_rotation_are_coloured_by_it(self):
        from pounding._pictures.hinge_map import hinges_figure

        _, marks = self.marks()
        for name, one in self.results.structures.items():
            for i, part in enumerate(one.springs.names):
                self.assertEqual(marks[name, part].value, one.springs.largest["peak_plastic"][i] / 0.0005)
        self.assertIn("beyond ultimate", {mark.state for mark in marks.values()})
        for size in (None, (3.3, 2.8)):
            figure = hinges_figure(self.results, size=size)
            self.assertEqual(figure.axes[1].get_ylabel(), "Plastic rotation over ultimate")
            [legend] = figure.legends
            words = [text.get_text() for text in legend.get_texts()]
            self.assertTrue(
                any(each.startswith("impacts, at most ") for each in words) and "beyond its ultimate rotation" in words,
                words,
            )
            legends_fit(self, figure)

    def test_hinges_without_one_are_coloured_by_plastic_rotation(self):
        from pounding._pictures.hinge_map import hinges_figure

        results = results_of(FRAMES.replace(", ultimate_rotation: 0.0005", ""))
        figure = hinges_figure(results)
        self.assertEqual(figure.axes[1].get_ylabel(), "Plastic rotation (mrad)")
        largest = max(
            one.springs.largest["peak_plastic"].max() for one in results.structures.values() if one.springs is not None
        )
        np.testing.assert_allclose(figure.axes[1].get_ylim(), (0, 1e3 * largest))
        self.assertIn(f"{1e3 * largest:.3g}", {text.get_text() for text in figure.axes[0].texts})

    def test_a_star_tells_how_often_a_link_was_hit(self):
        from pounding._pictures.hinge_map import hinges_figure

        figure = hinges_figure(self.results)
        self.assertIn(str(self.results.impacts.size), [text.get_text() for text in figure.axes[0].texts])


def legends_fit(case, figure):
    figure.draw_without_rendering()
    for legend in figure.legends:
        box = legend.get_window_extent().transformed(figure.transFigure.inverted())
        case.assertTrue(box.x0 >= -0.001 and box.x1 <= 1.001 and box.y0 >= -0.001 and box.y1 <= 1.001, box)


if __name__ == "__main__":
    unittest.main()
