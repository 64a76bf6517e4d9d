"""Pictures of every kind of run, and their texts."""

import contextlib
import dataclasses
import io
import os
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import h5py
import numpy as np

from pounding import _export as export
from pounding import _plots as plots
from pounding import animation
from pounding._pictures import figures, style
from pounding._ended import exit_code
from pounding._pictures.run_picture import standard_figure
from pounding._pictures.style import BadRequest
from pounding.results import NotResults
from pounding._runs import read
from messages import assert_mentions, raises

WRITER = os.environ["POUNDING_RESULTS_WRITER"]
KINDS = ("two", "row", "towers", "alone", "quiet", "running", "failed")


def titles(figure):
    return [axes.get_title(loc="left") for axes in figure.axes]


def axes_titled(figure, words):
    return next(axes for axes in figure.axes if words in axes.get_title(loc="left"))


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # A glyph or an option unknown to matplotlib is a fault of the picture.
        warnings.simplefilter("error")
        cls.directory = tempfile.TemporaryDirectory()
        cls.files = {kind: Path(cls.directory.name) / f"{kind}.h5" for kind in KINDS}
        for kind, path in cls.files.items():
            subprocess.run([WRITER, kind, path], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()
        warnings.resetwarnings()

    def figure(self, kind, **options):
        return standard_figure(read(self.files[kind]), **options)

    def test_need_a_matplotlib_that_is_new_enough(self):
        code = "import matplotlib\nmatplotlib.__version_info__ = (3, 6, 3)\nimport pounding._plots"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        assert_mentions(
            done.stderr.splitlines()[-1], ["ImportError", "3", "7", "pip install --upgrade", "-m", "python3"]
        )

    def test_every_kind_of_run_is_drawn(self):
        for kind in KINDS:
            with self.subTest(kind):
                picture = io.BytesIO()
                self.figure(kind).savefig(picture, dpi=50)
                self.assertGreater(picture.tell(), 10000)

    def test_panels_are_those_that_the_run_has(self):
        self.assertEqual(
            titles(self.figure("two")),
            [
                "(a) Ground",
                "(b) Displacements",
                "(c) Opening of the links",
                "(d) Contact forces",
                "(e) Energy",
                "(f) Error of the energy balance",
                "(g) Strongest impact",
                "(h) Restitution of each impact",
            ],
        )
        self.assertEqual(
            titles(self.figure("alone")),
            ["(a) Ground", "(b) Displacements", "(c) Energy", "(d) Error of the energy balance"],
        )

    def test_lines_meet_when_the_structures_touch(self):
        run = read(self.files["two"])
        left, right = [
            line.get_ydata()
            for line in axes_titled(self.figure("two"), "Displacements").lines
            if line.get_label() in ("left", "right")
        ]
        opening = np.interp(run.time, run.links["left.1-right.1"].time, -run.links["left.1-right.1"].penetration)
        np.testing.assert_allclose(right - left, 1e3 * opening, atol=1.0)
        self.assertAlmostEqual(right[0] - left[0], 20)

    def test_a_row_stands_gap_beside_gap(self):
        lines = {line.get_label(): line.get_ydata() for line in axes_titled(self.figure("row"), "Displacements").lines}
        self.assertAlmostEqual(lines["right"][0], 20)
        self.assertAlmostEqual(lines["far right"][0], 50)

    def test_a_wall_stands_still_a_gap_away(self):
        run = read(self.files["two"])
        empty = np.zeros((run.time.size, 0))
        still = dataclasses.replace(run.structures["right"].along["x"], displacement=empty)
        run.structures["right"] = dataclasses.replace(run.structures["right"], floors=[], along={"x": still})
        run.links["left.1-right.1"] = dataclasses.replace(run.links["left.1-right.1"], right_floor=0)
        axes = axes_titled(standard_figure(run), "Displacements")
        lines = {line.get_label(): line.get_ydata() for line in axes.lines}
        np.testing.assert_array_equal(lines["right"], np.full(run.time.size, 20.0))
        assert_mentions(axes.get_legend_handles_labels()[1], "20 mm")

    def test_a_top_above_the_links_is_drawn_too(self):
        run = read(self.files["towers"])
        del run.links["slender.6-stiff.6"]
        run = dataclasses.replace(run, impacts=run.impacts[run.impacts["link"] != "slender.6-stiff.6"])
        axes = axes_titled(standard_figure(run), "Displacements")
        self.assertEqual(
            axes.get_legend_handles_labels()[1],
            ["slender, floor 5", "slender, top", "stiff, floor 5", "stiff, top", "gap, 40 mm at rest"],
        )

    def test_floors_can_be_chosen(self):
        run = read(self.files["towers"])
        axes = axes_titled(self.figure("towers", floors={"stiff": "2"}), "Displacements")
        lines = {line.get_label(): line.get_ydata() for line in axes.lines}
        # The neighbour is shown at the facing floor.
        self.assertEqual(
            axes.get_legend_handles_labels()[1],
            ["slender, floor 2", "slender, top", "stiff, floor 2", "gap, 40 mm at rest"],
        )
        np.testing.assert_allclose(lines["stiff, floor 2"], 40 + 1e3 * run.structures["stiff"].displacement[:, 1])

    def test_a_floor_against_a_column_faces_the_column_at_its_height(self):
        run = read(self.files["towers"])
        last = run.links.pop("slender.6-stiff.6")
        run.links["slender.6-stiff"] = dataclasses.replace(
            last, name="slender.6-stiff", right_floor=0, right_end="17 m up"
        )
        run = dataclasses.replace(run, impacts=run.impacts[run.impacts["link"] != last.name])
        axes = axes_titled(standard_figure(run), "Displacements")
        lines = {line.get_label(): line.get_ydata() for line in axes.lines}
        self.assertEqual(
            axes.get_legend_handles_labels()[1],
            ["slender, floor 6", "stiff, 17 m up", "stiff, top", "gap, 40 mm at rest"],
        )
        opening = -np.interp(run.time, last.time, last.penetration)
        np.testing.assert_allclose(lines["stiff, 17 m up"] - lines["slender, floor 6"], 1e3 * opening, atol=1e-9)

    def test_no_gap_is_shaded_between_places_that_no_link_joins(self):
        run = read(self.files["two"])
        link = run.links["left.1-right.1"]
        run.links["left.1-right.1"] = dataclasses.replace(
            link, left_floor=0, left_end="node a", right_floor=0, right_end="node b"
        )
        axes = axes_titled(standard_figure(run), "Displacements")
        self.assertEqual(axes.get_legend_handles_labels()[1], ["left", "right"])

    def test_restitutions_show_what_was_asked_and_leave_room_for_the_usual_ones(self):
        run = read(self.files["two"])
        text = "links:\n  - name: left.1-right.1\n    parameters:\n      restitution: 0.65  # -\nanalysis:\n  restitution: 7\n"
        run = dataclasses.replace(run, resolved_yaml=text)
        run.impacts["restitution"][0] = 6.3
        axes = axes_titled(standard_figure(run), "Restitution")
        assert_mentions([each.get_text() for each in axes.texts], ["0.65", "1.5", "6.3"])
        self.assertEqual(
            [
                line.get_ydata()[0]
                for line in axes.lines
                if len(set(line.get_ydata())) == 1 and line.get_linestyle() == "--"
            ],
            [0.65],
        )
        self.assertEqual(axes.get_ylim(), (0, 1.5))

    def test_an_impact_that_lasts_has_a_loop(self):
        run = read(self.files["two"])
        strongest = np.argmax(run.impacts["peak_force"])
        for name in ("t_end", "t_release", "v_separation", "restitution"):
            run.impacts[name][strongest] = np.nan
        axes = axes_titled(standard_figure(run), "Strongest")
        self.assertGreater(axes.lines[0].get_xdata().size, 10)
        self.assertIn("still pressed", axes.get_xlabel())

    def test_legends_fit_the_size_that_fits_a_column_of_a_paper(self):
        run = read(self.files["towers"])
        for picture in (*figures.WHOLE, *figures.PANELS):
            for size in ((3.3, 2.4), None):
                # without yielding, rotations, plans or a comparison: other tests draw these
                if picture == "profiles" and size or picture in ("springs", "hinges", "plan", "rotation", "worst"):
                    continue
                figure = figures.figure(run, picture, "", size)
                figure.draw_without_rendering()
                for legend in [*figure.legends, *(axes.get_legend() for axes in figure.axes)]:
                    if legend is not None:
                        box = legend.get_window_extent().transformed(figure.transFigure.inverted())
                        self.assertTrue(
                            box.x0 >= -0.001 and box.x1 <= 1.001 and box.y0 >= -0.001 and box.y1 <= 1.001,
                            (picture, size, box),
                        )

    def test_loops_are_those_of_contacts_if_nothing_yields(self):
        run = read(self.files["two"])
        expected = np.concatenate([line.get_xydata() for line in figures.figure(run, "contact_loops").axes[0].lines])
        with self.assertWarns(DeprecationWarning):
            old = figures.figure(run, "springs")
        for figure in (figures.figure(run, "loops"), old):
            found = np.concatenate([line.get_xydata() for line in figure.axes[0].lines])
            np.testing.assert_array_equal(found, expected)

    def test_a_small_figure_has_the_panels_that_fit(self):
        run = read(self.files["towers"])
        for size, count in (((5, 9), 8), ((5, 6.5), 4), ((5, 4), 2), ((3.3, 2.4), 1)):
            figure = run.plot("run", size=size)
            self.assertEqual((tuple(figure.get_size_inches()), len(figure.axes)), (size, count))
            self.assertIn("Displacements", "".join(titles(figure)))
            self.assertEqual(figure.axes[-1].get_xlabel().split()[0], "Time" if count < 8 else "Closing")

    def test_floors_that_do_not_exist_are_refused(self):
        for floors, facts in (
            ({"stif": "1"}, ["stif", "slender", "stiff"]),
            ({"stiff": "7"}, ["stiff", "7", "1, 2, 3, 4, 5, 6"]),
        ):
            with self.assertRaises(BadRequest) as caught:
                self.figure("towers", floors=floors)
            assert_mentions(str(caught.exception), facts)

    def test_touches_are_marked(self):
        run = read(self.files["two"])
        marks = next(
            line for line in axes_titled(self.figure("two"), "Opening").lines if line.get_label().startswith("touch")
        )
        np.testing.assert_array_equal(marks.get_xdata(), run.impacts["t_start"])

    def test_forces_are_drawn_in_meganewtons(self):
        run = read(self.files["two"])
        axes = axes_titled(self.figure("two"), "Contact forces")
        self.assertIn("[MN]", axes.get_ylabel())
        drawn = max(line.get_ydata().max() for line in axes.lines)
        self.assertAlmostEqual(drawn, 1e-6 * run.links["left.1-right.1"].force.max())

    def test_loop_is_that_of_the_strongest_impact(self):
        run = read(self.files["two"])
        strongest = run.impacts[np.argmax(run.impacts["peak_force"])]
        axes = axes_titled(self.figure("two"), "Strongest")
        assert_mentions(axes.get_xlabel(), f"{strongest['t_start']:.3f}")
        self.assertAlmostEqual(axes.lines[0].get_xdata().max(), 1e3 * strongest["peak_penetration"], delta=0.05)

    def test_many_links_share_one_entry_of_the_legend(self):
        labels = axes_titled(self.figure("towers"), "Contact forces").get_legend_handles_labels()[1]
        self.assertEqual(len(labels), 5)
        assert_mentions(labels, "2")

    def test_run_without_impact_says_how_close_it_was(self):
        words = [text.get_text() for text in axes_titled(self.figure("quiet"), "Contact forces").texts]
        closest = -1e3 * read(self.files["quiet"]).links["left.1-right.1"].penetration.max()
        self.assertEqual(words, [f"No impact; closest approach {closest:.4g} mm"])

    def test_rigid_contacts_show_impulses(self):
        run = read(self.files["two"])
        for link in run.links.values():
            link.force[:] = 0
        run.impacts["peak_force"] = np.nan
        figure = standard_figure(run)
        self.assertIn("(d) Impulses of rigid contacts", titles(figure))
        self.assertEqual(axes_titled(figure, "Strongest").texts[0].get_text(), "Rigid contact: no loop")

    def test_loop_is_not_that_of_a_rigid_impact(self):
        run = read(self.files["two"])
        run.impacts["peak_force"][0] = np.nan
        axes = axes_titled(standard_figure(run), "Strongest")
        self.assertGreater(axes.lines[0].get_xdata().max(), 1)

    def test_unfinished_runs_say_so(self):
        self.assertEqual(self.figure("two").get_suptitle(), "Two oscillators, 20 mm apart")
        assert_mentions(self.figure("running").get_suptitle(), "5 s")
        words = " ".join(self.figure("failed").get_suptitle().split())
        assert_mentions(words, ["failed", "1e-12 s", "6.0 s", "6 s"])

    def test_title_can_be_chosen(self):
        self.assertEqual(self.figure("two", title="50 % of $x$").get_suptitle(), "50 % of $x$")

    def test_unit_suits_the_size(self):
        self.assertEqual(style.engineering(2.4e7, style.FORCE_UNITS), (1e6, "MN"))
        self.assertEqual(style.engineering(4e5, style.FORCE_UNITS), (1e3, "kN"))
        self.assertEqual(style.engineering(0.0, style.FORCE_UNITS), (1.0, "N"))


class CommandLine(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        self.results = self.directory / "run.h5"
        subprocess.run([WRITER, "two", self.results], check=True)

    def run_main(self, *arguments, command=plots):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            code = exit_code(lambda: command.main([str(argument) for argument in arguments]))
        return code, errors.getvalue()

    def test_picture_is_written(self):
        for suffix in ("png", "pdf"):
            picture = self.directory / f"run.{suffix}"
            self.assertEqual(self.run_main(self.results, "-o", picture), (0, ""))
            self.assertGreater(picture.stat().st_size, 10000)

    def test_missing_file_is_named(self):
        missing = self.directory / "none.h5"
        code, message = self.run_main(missing, "-o", "x.png")
        self.assertEqual(code, 2)
        assert_mentions(message, str(missing))

    def test_other_hdf5_file_is_refused(self):
        other = self.directory / "other.h5"
        h5py.File(other, "w").close()
        with self.assertRaises(NotResults):
            read(other)
        with raises(NotResults):
            read(other, checked=False)
        code, text = self.run_main(other, "-o", "x.png")
        self.assertEqual(code, 2)
        self.assertTrue(text.startswith(f"pounding: {other}: has no checksum"), text)
        for command, ending in ((export, "xdmf"), (animation, "gif")):
            with self.subTest(command.__name__):
                done = self.run_main(other, "-o", self.directory / f"x.{ending}", command=command)
                self.assertEqual(done, (2, text))

    def test_unknown_kind_of_picture_is_refused(self):
        code, text = self.run_main(self.results, "-o", self.directory / "run.xyz")
        self.assertEqual(code, 2)
        self.assertIn("cannot write", text)
        self.assertIn("xyz", text)


if __name__ == "__main__":
    unittest.main()
