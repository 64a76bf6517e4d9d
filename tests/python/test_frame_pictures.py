"""Pictures of models and profiles: their content, and no warnings from matplotlib."""

import io
import os
import subprocess
import tempfile
import unittest
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.collections import PolyCollection

import frame_samples
from pounding.animation import animate, frame_times
from pounding._pictures import figures
from pounding._pictures.geometry import outline
from pounding._pictures.model_picture import model_figure
from pounding._pictures.plan_map import contacts
from pounding._pictures.profiles import profiles_figure
from pounding._pictures.run_picture import standard_figure
from pounding._runs import read
from pounding._pictures.scene import Scene
from pounding._pictures.style import BadRequest, structure_colour
from messages import raises

WRITER = os.environ["POUNDING_RESULTS_WRITER"]


def titles(figure):
    return [axes.get_title(loc="left") for axes in figure.axes]


class FramePictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        warnings.simplefilter("error")
        cls.directory = tempfile.TemporaryDirectory()
        place = Path(cls.directory.name)
        frame_samples.write(place / "plane.h5", 2, wall=True)
        frame_samples.write(place / "space.h5", 3)
        frame_samples.write(place / "compared.h5", 2, compare=True)
        frame_samples.write(place / "beside.h5", 3, compare=True)
        frame_samples.write(place / "rigid.h5", 3, compare=True, rigid=True)
        for kind in ("towers", "row"):
            subprocess.run([WRITER, kind, place / f"{kind}.h5"], check=True)
        cls.runs = {
            kind: read(place / f"{kind}.h5")
            for kind in ("plane", "space", "compared", "beside", "rigid", "towers", "row")
        }

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()
        warnings.resetwarnings()

    def test_every_picture_of_every_run_is_drawn(self):
        for kind, run in self.runs.items():
            for draw in (model_figure, profiles_figure, standard_figure):
                with self.subTest(f"{draw.__name__} {kind}"):
                    picture = io.BytesIO()
                    draw(run).savefig(picture, dpi=40)
                    self.assertGreater(picture.tell(), 3000)

    def test_model_in_space_is_seen_from_all_sides(self):
        self.assertEqual(
            titles(model_figure(self.runs["space"])),
            ["(a) View", "(b) Plan", "(c) Elevation along x", "(d) Elevation along y"],
        )
        self.assertEqual(len(model_figure(self.runs["plane"]).axes), 1)

    def test_map_in_plan_shows_drifts_and_the_hardest_impact(self):
        run = self.runs["beside"]
        figure = figures.figure(run, "plan")
        self.assertEqual(titles(figure)[:2], ["(a) With its neighbours", "(b) Each alone"])
        # A roof's motion scaled by the height: every storey drifts by a fifth, or a third, of it.
        expected = [
            100
            * frame_samples.BETWEEN_OUTPUTS
            * np.abs(frame_samples.sway(name)["x"]).max()
            / (storeys * frame_samples.STOREY)
            for name, storeys in (("tall", 5), ("low", 3))
        ]
        for axes, part in zip(figure.axes, (1.0, frame_samples.WITHOUT_LINKS)):
            numbers = [text.get_text() for text in axes.texts if text.get_text()[0].isdigit()]
            self.assertEqual(numbers, [f"{part * value:.2f}" for value in expected])
            corners = [patch.get_xy() for patch in axes.patches]
            np.testing.assert_allclose([corners[0].min(axis=0), corners[0].max(axis=0)], [[0, 0], [10, 4]])
            np.testing.assert_allclose([corners[1].min(axis=0), corners[1].max(axis=0)], [[10.025, 0], [20.025, 4]])
        self.assertEqual(len(figures.figure(run, "plan", compare=False).axes), 3)
        [contact] = contacts(run)
        self.assertAlmostEqual(contact.strength, run.impacts["peak_force"].max())
        self.assertEqual(contact.impacts, run.impacts.size)
        self.assertGreater(contact.impacts, 0)
        np.testing.assert_allclose(contact.ends[:, 1], [0, 4])

    def test_map_in_plan_fits_a_column_and_asks_for_frames_in_space(self):
        picture = io.BytesIO()
        figures.figure(self.runs["beside"], "plan", "", (3.3, 4.5)).savefig(picture, dpi=60)
        self.assertGreater(picture.tell(), 3000)
        for kind in ("plane", "towers"):
            with raises(BadRequest, "--picture"):
                figures.figure(self.runs[kind], "plan")
        with raises(BadRequest):
            figures.figure(self.runs["space"], "plan", compare=True)

    def test_links_that_were_never_hit_stay_grey(self):
        run = replace(self.runs["beside"], impacts=self.runs["beside"].impacts[:0])
        axes = figures.figure(run, "plan").axes[0]
        self.assertEqual([line.get_color() for line in axes.lines], ["0.45"])

    def test_outline_is_convex(self):
        points = np.array([[0, 0], [4, 0], [2, 0], [4, 3], [0, 3], [2, 1], [4, 3]])
        np.testing.assert_allclose(outline(points), [[0, 0], [4, 0], [4, 3], [0, 3]])
        self.assertEqual(len(outline(np.array([[0, 0], [0, 0], [0, 2]]))), 2)

    def test_many_structures_are_drawn_from_behind_and_without_a_legend(self):
        run = self.runs["space"]
        many = {}
        for i in range(14):
            one = run.structures["low"]
            geometry = replace(one.geometry, nodes=one.geometry.nodes + [25.0 * (i % 7), 25.0 * (i // 7), 0])
            many[f"n{i}"] = replace(one, name=f"n{i}", geometry=geometry)
        run = replace(run, structures=many, links={}, impacts=run.impacts[:0], envelopes={})
        figure = model_figure(run)
        axes = figure.axes[0]
        bodies = [
            each
            for each in axes.collections
            if isinstance(each, PolyCollection) and each.get_facecolor().tolist() == [[1, 1, 1, 1]]
        ]
        self.assertEqual(len(bodies), 14)
        lines = {lines.get_label(): lines.get_zorder() for lines in axes.collections if lines.get_label() in many}
        self.assertGreater(lines["n6"], lines["n0"])  # the camera is at large x and small y
        self.assertGreater(lines["n0"], lines["n7"])
        self.assertEqual(len(axes.texts), 0)
        film = animate(run, frame_times(run, 3))
        self.assertEqual(film.figure.legends, [])
        self.assertEqual(len(list(film.pictures())), 3)

    def test_every_member_and_link_is_drawn_in_place(self):
        run = self.runs["plane"]
        axes = model_figure(run).axes[0]
        lines = {
            lines.get_label(): lines.get_segments() for lines in axes.collections if hasattr(lines, "get_segments")
        }
        tall = run.structures["tall"].geometry
        np.testing.assert_allclose(lines["tall"], tall.nodes[:, [0, 2]][tall.members])
        marks = next(c for c in axes.collections if len(c.get_offsets()) == 4)
        np.testing.assert_allclose(sorted(marks.get_offsets()[:, 1]), [3.2, 6.4, 9.6, 9.6])

    def test_mark_of_a_wall_on_the_left_is_at_the_wall_where_the_frame_meets_it(self):
        run = self.runs["plane"]
        link = replace(
            run.links["low.3-wall"],
            name="wall-tall",
            left="wall",
            right="tall",
            left_floor=0,
            right_floor=0,
            position=np.zeros(3),
        )
        run = replace(
            run, links={link.name: link}, structures={name: run.structures[name] for name in ("wall", "tall")}
        )
        np.testing.assert_allclose(Scene(run).faces["wall-tall"], [-0.1, 0, 0])
        np.testing.assert_allclose(Scene(run, 3).faces["wall-tall"], [-0.3, 0, 0])

    def test_floors_are_labelled_outside_the_walls(self):
        axes = model_figure(self.runs["plane"]).axes[0]
        wall = next(lines.get_segments()[0][0, 0] for lines in axes.collections if lines.get_label() == "wall")
        labels = [text for text in axes.texts if text.get_text() == "3"]
        self.assertEqual([float(label.xy[0]) for label in labels], [0, wall])

    def test_five_structures_have_five_colours(self):
        self.assertEqual(len({structure_colour(number) for number in range(5)}), 5)

    def test_fastest_impact_lies_inside_the_axes(self):
        run = self.runs["plane"]
        axes = next(a for a in standard_figure(run).axes if "Restitution" in a.get_title(loc="left"))
        self.assertGreater(axes.get_xlim()[1], 1.04 * run.impacts["v_approach"].max())

    def test_legend_states_the_gaps(self):
        legend = model_figure(self.runs["plane"]).legends[0]
        self.assertEqual(
            [text.get_text() for text in legend.get_texts()], ["3 links, gap 25 mm", "low.3-wall, gap 100 mm"]
        )

    def test_unknown_heights_have_no_scale(self):
        axes = model_figure(self.runs["towers"]).axes[0]
        self.assertEqual((list(axes.get_xticks()), list(axes.get_yticks())), ([], []))
        self.assertEqual(axes.get_ylabel(), "Heights are not in the file")

    def test_profiles_hold_the_extremes_that_the_run_has_tracked(self):
        run = self.runs["space"]
        figure = profiles_figure(run)
        self.assertEqual(titles(figure)[4:6], ["(e) Displacement along y", "(f) Storey drift along y"])
        tracked = run.envelopes["tall"]
        low, high = figure.axes[4].lines[:2]
        np.testing.assert_allclose(low.get_xdata(), [0, *1e3 * tracked.displacement.min[:, 1]])
        self.assertGreater(high.get_xdata().max(), 1.09e3 * run.structures["tall"].along["y"].displacement.max())
        np.testing.assert_allclose(high.get_ydata(), [0, 3.2, 6.4, 9.6, 12.8, 16])
        high = figure.axes[5].lines[1]
        np.testing.assert_allclose(high.get_xdata()[::2], 100 * tracked.drift.max[:, 1] / 3.2)
        self.assertIn("[kN]", figure.axes[6].get_xlabel())
        high = figure.axes[6].lines[1]
        np.testing.assert_allclose(high.get_xdata()[::2], 1e-3 * tracked.storey_shear.max[:, 1])
        np.testing.assert_allclose(figure.axes[7].lines[0].get_xdata(), tracked.acceleration.min[:, 1])

    def test_profiles_without_heights_count_floors(self):
        run = self.runs["towers"]
        figure = profiles_figure(run)
        self.assertEqual(figure.axes[0].get_ylabel(), "Floor")
        self.assertEqual(figure.axes[1].get_xlabel(), "Storey drift [mm]")
        np.testing.assert_allclose(
            figure.axes[1].lines[1].get_xdata()[::2], 1e3 * run.envelopes["slender"].drift.max[:, 0]
        )

    def test_profiles_show_the_run_without_links_dashed(self):
        run = self.runs["compared"]
        figure = profiles_figure(run)
        dashed = [line for line in figure.axes[0].lines if line.get_linestyle() == "--"]
        np.testing.assert_allclose(dashed[1].get_xdata()[1:], 0.7e3 * run.envelopes["tall"].displacement.max[:, 0])
        self.assertEqual([text.get_text() for text in figure.legends[0].get_texts()], ["tall", "low", "without links"])
        self.assertEqual(
            [line for line in profiles_figure(run, compare=False).axes[0].lines if line.get_linestyle() == "--"], []
        )
        with raises(BadRequest, "compare: no_pounding"):
            profiles_figure(self.runs["plane"], compare=True)

    def test_other_pictures_show_the_run_without_links_where_asked(self):
        run = self.runs["compared"]
        for picture, panel in (("displacement", 0), ("gap", 0), ("energy", 0), ("run", 1)):
            with self.subTest(picture):

                def dashed(**options):
                    lines = run.plot(picture, **options).axes[panel].lines
                    return [line for line in lines if str(line.get_label()).endswith("without links")]

                self.assertEqual(dashed(), [])
                [line] = dashed(compare=True)
                self.assertEqual(line.get_linestyle(), "--")
        opening = [line for line in run.plot("gap", compare=True).axes[0].lines if line.get_label() == "without links"][
            0
        ]
        link = run.links["tall.1-low.1"]
        apart = run.no_pounding.structures
        np.testing.assert_allclose(
            opening.get_ydata(), 1e3 * (link.gap - apart["tall"].displacement[:, 0] + apart["low"].displacement[:, 0])
        )
        with raises(BadRequest):
            run.plot("force", compare=True)

    def test_panels_and_legends_of_profiles_lie_inside_a_narrow_picture(self):
        for size in ((3.3, 4.4), (7.5, 4.3)):
            with self.subTest(size):
                figure = profiles_figure(self.runs["compared"], title="", size=size)
                figure.canvas.draw()
                width, height = figure.bbox.width, figure.bbox.height
                for box in [figure.legends[0].get_window_extent(), *(axes.get_tightbbox() for axes in figure.axes)]:
                    self.assertGreaterEqual(min(box.x0, box.y0), -1)
                    self.assertLessEqual(box.x1, width + 1)
                    self.assertLessEqual(box.y1, height + 1)

    def test_profiles_of_an_old_file_say_what_to_do(self):
        with raises(BadRequest, "2"):
            profiles_figure(replace(self.runs["plane"], envelopes={}))

    def test_profiles_of_nothing_are_refused(self):
        run = self.runs["plane"]
        run = type(run)(**{**run.__dict__, "structures": {"wall": run.structures["wall"]}, "links": {}})
        with self.assertRaises(BadRequest):
            profiles_figure(run)

    def corner(self):
        """The run with rigid floors and a third frame that links along y join to the tall one."""
        run = self.runs["rigid"]
        north = replace(run.structures["low"], name="north")
        links = {
            name: replace(link, name=f"tall-north {name}", right="north", gap=0.04, direction=np.array([0, 1.0, 0]))
            for name, link in run.links.items()
        }
        without = run.no_pounding
        return replace(
            run,
            structures={**run.structures, "north": north},
            links={**run.links, **{one.name: one for one in links.values()}},
            envelopes={**run.envelopes, "north": run.envelopes["low"]},
            no_pounding=replace(
                without,
                structures={**without.structures, "north": replace(without.structures["low"], name="north")},
                envelopes={**without.envelopes, "north": without.envelopes["low"]},
            ),
        )

    def test_in_space_each_direction_has_a_panel(self):
        run = self.corner()
        for figure in (standard_figure(run), run.plot("displacement")):
            along = {
                axes.get_title(loc="left").split()[-1]: axes
                for axes in figure.axes
                if "Displacements along" in axes.get_title(loc="left")
            }
            self.assertEqual(list(along), ["x", "y"])
            at_rest = {
                axis: {line.get_label(): line.get_ydata()[0] for line in axes.lines if "floor" in str(line.get_label())}
                for axis, axes in along.items()
            }
            # The neighbour along y has no gap along x.
            self.assertEqual(
                at_rest["x"], {"tall, floor 3": 0, "low, floor 3": 25, "north, floor 3 (no link along x)": 0}
            )
            self.assertEqual(
                at_rest["y"], {"tall, floor 3": 0, "low, floor 3 (no link along y)": 0, "north, floor 3": 40}
            )
        north = next(line for line in along["y"].lines if line.get_label() == "north, floor 3")
        np.testing.assert_allclose(north.get_ydata(), 40 + 1e3 * run.structures["north"].along["y"].displacement[:, 2])

    def test_a_link_against_an_axis_has_its_neighbour_on_the_other_side(self):
        run = self.runs["rigid"]
        links = {
            name: replace(
                link,
                left="low",
                right="tall",
                left_floor=link.right_floor,
                right_floor=link.left_floor,
                direction=-link.direction,
            )
            for name, link in run.links.items()
        }
        turned, given = (replace(run, links=each).plot("displacement").axes[0] for each in (links, run.links))
        lines = [{line.get_label(): line.get_ydata() for line in axes.lines} for axes in (turned, given)]
        for name in ("tall, floor 3", "low, floor 3"):
            np.testing.assert_allclose(
                lines[0][name] - lines[0]["tall, floor 3"][0], lines[1][name] - lines[1]["tall, floor 3"][0]
            )

    def test_rotations_have_a_panel_and_a_picture(self):
        run = self.runs["rigid"]
        axes = next(a for a in standard_figure(run, compare=True).axes if "Rotation" in a.get_title(loc="left"))
        lines = {line.get_label(): line for line in axes.lines}
        np.testing.assert_allclose(lines["tall, floor 5"].get_ydata(), 1e3 * frame_samples.sway("tall")["rz"])
        np.testing.assert_allclose(lines["without links"].get_ydata(), 0.7e3 * frame_samples.sway("tall")["rz"])
        self.assertEqual(len(axes.lines), 4)
        self.assertEqual(len(run.plot("rotation", compare=True).axes[0].lines), 4)
        self.assertFalse(any("Rotation" in title for title in titles(standard_figure(self.runs["space"]))))
        with raises(BadRequest):
            self.runs["space"].plot("rotation")

    def test_profiles_of_rigid_floors_show_rotations_and_edges(self):
        run = self.runs["rigid"]
        figure = profiles_figure(run, compare=False)
        self.assertEqual(titles(figure)[8:11], ["(i) Rotation", "(j) Edges along x", "(k) Edges along y"])
        tracked = run.envelopes["tall"]
        np.testing.assert_allclose(figure.axes[8].lines[1].get_xdata()[1:], 1e3 * tracked.displacement.max[:, 2])
        np.testing.assert_allclose(
            figure.axes[10].lines[0].get_xdata()[1:], 1e3 * tracked.edge_displacement.min[:, 2:].min(axis=1)
        )
        self.assertFalse(figure.axes[11].get_visible())
        for size in ((3.3, 9), (7.5, 8)):
            profiles_figure(run, title="", size=size).draw_without_rendering()

    def test_the_ground_is_drawn_along_every_axis(self):
        axes = standard_figure(self.runs["rigid"]).axes[0]
        self.assertEqual([line.get_label() for line in axes.lines], ["along x", "along y"])
        np.testing.assert_array_equal(axes.lines[1].get_ydata(), np.sin(3 * np.pi * frame_samples.TIME))

    def test_comparisons_keep_every_structure(self):
        run = self.corner()
        for axes in standard_figure(run, compare=True).axes[1:3]:
            self.assertEqual(
                sum(line.get_linestyle() == "--" and line.get_linewidth() == 0.8 for line in axes.lines),
                3,
                axes.get_title(loc="left"),
            )
        self.assertEqual(
            len([line for line in run.plot("gap", compare=True).axes[0].lines if line.get_linewidth() == 0.8]), 12
        )
        # Between floors the run without links is interpolated over the height.
        run = self.runs["compared"]
        link = replace(run.links["tall.3-low.3"], right_floor=0, right_end="8 m up", position=np.array([10.0, 0, 8.0]))
        axes = replace(run, links={link.name: link}).plot("displacement", compare=True).axes[0]
        dashed = [line.get_ydata() for line in axes.lines if line.get_linewidth() == 0.8]
        self.assertEqual(len(dashed), 2)
        low = run.no_pounding.structures["low"].displacement
        np.testing.assert_allclose(dashed[1], 25 + 0.5e3 * (low[:, 1] + low[:, 2]))

    def test_up_to_six_structures_are_drawn_and_compared(self):
        run = self.runs["compared"]

        def widened(one):
            return {f"n{i}": replace(one.structures["low"], name=f"n{i}") for i in range(6)}

        links = {
            f"l{i}": replace(run.links["tall.3-low.3"], name=f"l{i}", left=f"n{i}", right=f"n{i + 1}") for i in range(5)
        }
        run = replace(
            run,
            structures=widened(run),
            links=links,
            no_pounding=replace(run.no_pounding, structures=widened(run.no_pounding)),
        )
        axes = run.plot("displacement", compare=True).axes[0]
        self.assertEqual(sum(line.get_linewidth() == 0.8 for line in axes.lines), 6)
        self.assertEqual(len({line.get_color() for line in axes.lines}), 6)

    def test_displacements_are_those_along_the_links(self):
        run = self.runs["space"]
        for link in run.links.values():
            link.direction[:] = [0, 1, 0]
        self.addCleanup(lambda: [link.direction.__setitem__(slice(None), [1, 0, 0]) for link in run.links.values()])
        axes = next(a for a in standard_figure(run).axes if "Displacements along y" in a.get_title(loc="left"))
        line = next(line for line in axes.lines if line.get_label() == "tall, floor 3")
        np.testing.assert_allclose(line.get_ydata(), 1e3 * run.structures["tall"].along["y"].displacement[:, 2])


if __name__ == "__main__":
    unittest.main()
