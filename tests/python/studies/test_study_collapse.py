"""Rows that end by collapse_drift: they exceed every limit, and every reader of a table reports it."""

import contextlib
import io
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import pounding
from pounding.errors import InputError
from pounding._studies import command
from pounding._studies.study_commands import report_of
from pounding._studies.batches import COLLAPSED, DONE, EXCEEDED, STATUSES
from pounding._studies.plan import make_plan
from pounding._studies.quantities import Kept
from pounding._studies.study import run_plan
from pounding._studies.summary import summary
from messages import assert_mentions, raises

#: Two yielding storeys next to a stiff neighbour.
MODEL = {
    "structures": {
        "left": {
            "shear_building": {
                "storeys": 2,
                "mass": "200 t",
                "stiffness": "60 MN/m",
                "height": "3 m",
                "yield_force": ["0.9 MN", "2 MN"],
                "hardening": "0.02",
            },
            "damping": "5 %",
        },
        "right": {"oscillator": {"mass": "100 t", "period": "0.4 s", "damping": "5 %"}},
    },
    "links": [
        {
            "between": ["left.1", "right"],
            "gap": "200 mm",
            "law": "hertz_damped",
            "stiffness": "2.75e9",
            "restitution": "0.65",
        }
    ],
    "analysis": {"collapse_drift": "2 %", "tolerance": "1e-3"},
}
LEVELS = ["0.2 g", "0.4 g", "1 g"]
WORDS = {
    "intensity": {"measure": "pga", "levels": LEVELS},
    "without_links": "yes",
    "keep": ["drift", "acceleration", "force", "impacts", "impulse", "required_gap", "gap_srss", "collapsed"],
}
#: Between stiff neighbours the building survives; without them it collapses.
GUARDED = {
    **MODEL,
    "structures": {
        "left": MODEL["structures"]["left"],
        "guard": {"oscillator": {"mass": "2000 t", "period": "0.2 s", "damping": "5 %"}},
        "rest": {"oscillator": {"mass": "2000 t", "period": "0.2 s", "damping": "5 %"}},
    },
    "links": [
        {
            "between": ["left.1", "guard"],
            "gap": "10 mm",
            "law": "hertz_damped",
            "stiffness": "1e9",
            "restitution": "0.6",
        },
        {
            "between": ["rest", "left.1"],
            "gap": "10 mm",
            "law": "hertz_damped",
            "stiffness": "1e9",
            "restitution": "0.6",
        },
    ],
}


def write_records(folder):
    """Three pulses; the longer ones push further."""
    for number, period in enumerate((0.7, 1.2, 2.0)):
        times = np.arange(0, 2.005, 0.01)
        values = np.where(times <= period, np.sin(2 * np.pi * times / period), 0) * 0.2
        (folder / f"r{number}.csv").write_text(
            "time,acc (g)\n" + "".join(f"{t:.2f},{a:.6f}\n" for t, a in zip(times, values))
        )


class Collapse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "recs").mkdir()
        write_records(cls.folder / "recs")
        cls.plan = make_plan(pounding.Model(**MODEL), {**WORDS, "records": {"files": "recs"}}, cls.folder)
        cls.study = run_plan(cls.plan, cls.folder / "s.h5", workers=0, progress=False)
        cls.fallen = cls.study["status"] == COLLAPSED

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_of(self, model, **words):
        return run_plan(
            make_plan(pounding.Model(**model), {**WORDS, "records": {"files": "recs"}, **words}, self.folder),
            None,
            workers=0,
            progress=False,
        )

    def command(self, *words):
        done = subprocess.run(
            [sys.executable, "-m", "pounding", *map(str, words)],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_their_responses_are_infinite_and_those_of_the_complete_run_are_not(self):
        study, fallen = self.study, self.fallen
        self.assertTrue(1 <= fallen.sum() <= 7, study["status"])
        self.assertEqual(set(study["status"][~fallen]), {DONE})
        for column in ("drift.left", "drift.right", "acceleration.left", "force", "impacts", "impulse"):
            np.testing.assert_array_equal(np.isinf(study[column]), fallen, column)
        # Whether the run without links collapses is reported separately.
        for row in range(len(study)):
            alone = json.loads(json.dumps(pounding.run(pounding.Model.from_yaml(study.model_of(row))).summary))[
                "no_pounding"
            ]
            self.assertEqual(np.isinf(study["drift.left.alone"][row]), alone["status"] != "done", row)
            self.assertEqual(np.isinf(study["required_gap"][row]), alone["status"] != "done", row)
        whole = ~fallen & np.isfinite(study["drift.left.alone"])
        np.testing.assert_array_equal(~np.isnan(study["drift.left.ratio"]), whole)
        np.testing.assert_array_equal(
            study["drift.left.ratio"][whole], study["drift.left"][whole] / study["drift.left.alone"][whole]
        )

    def test_the_reason_says_where_and_when(self):
        self.assertEqual(list(self.study.collapsed), np.flatnonzero(self.fallen).tolist())
        self.assertEqual(self.study.failed, {})
        for why in self.study.collapsed.values():
            assert_mentions(why, ["1", "2"])

    def test_they_exceed_every_limit(self):
        study = self.study
        curve = study.fragility("drift.left", "80 m", bootstrap=0)
        np.testing.assert_array_equal(curve.exceeded, study.fragility("collapsed", bootstrap=0).exceeded)
        np.testing.assert_array_equal(curve.exceeded, [self.fallen[study["im"] == im].sum() for im in curve.im])
        np.testing.assert_array_equal(curve.count, [3, 3, 3])
        limited = self.run_of(MODEL, limits={"drift": "1 km", "force": "1e9 N"})
        np.testing.assert_array_equal(limited["status"], study["status"])
        self.assertNotIn(EXCEEDED, limited["status"])

    def test_a_ratio_leaves_them_out_and_says_so(self):
        curve = self.study.fragility("drift.left.ratio", 0.5, bootstrap=0)
        self.assertEqual(curve.undefined, int(np.isnan(self.study["drift.left.ratio"]).sum()))
        self.assertEqual(curve.count.sum() + curve.undefined, 9)
        found = self.study.percentiles("drift.left.ratio")
        self.assertEqual(found.count.sum(), curve.count.sum())

    def test_percentiles_keep_them(self):
        found = self.study.percentiles("drift.left", (16, 50, 84))
        top = np.sort(self.study["drift.left"][self.study["im"] == found.im[-1]])
        np.testing.assert_array_equal(found.values[:, -1], top[[0, 1, 2]])
        self.assertTrue(np.isinf(found.values[-1, -1]))
        self.assertEqual(found.im_at(1e9, 84), found.im[np.isinf(found.values[-1])][0])

    def test_the_table_keeps_them(self):
        opened = pounding.Study.open(self.folder / "s.h5")
        for column in opened.columns:
            np.testing.assert_array_equal(opened[column], self.study[column], column)
        self.assertEqual((opened.collapsed, opened.failed), (self.study.collapsed, {}))
        assert_mentions(repr(opened), f"{self.fallen.sum()}")
        # They are not run again.
        self.assertEqual(len(pounding._studies.table.Table(self.plan, self.folder / "s.h5").missing()), 0)

    def test_the_report_names_them(self):
        told = self.command("study", "show", "s.h5")
        assert_mentions(told, [f"{9 - self.fallen.sum()}", f"{self.fallen.sum()}"])
        first = int(np.flatnonzero(self.fallen)[0])
        assert_mentions(told, [f"{first}", f"{first}"])
        row = self.command("study", "show", "s.h5", "--row", first)
        assert_mentions(row, "drift.left")
        self.assertIn("# status: collapsed", row)
        self.assertIn("# collapse at t = ", row)

    def test_the_summary_counts_them(self):
        found = json.loads(self.command("study", "show", "s.h5", "--json", "--column", "collapsed"))
        self.assertEqual(found["status"]["collapsed"], int(self.fallen.sum()))
        drift = found["columns"]["drift.left"]
        self.assertEqual(
            (drift["infinite"], drift["max"], drift["mean"], drift["share above 0"]),
            (int(self.fallen.sum()), None, None, 1.0),
        )
        self.assertEqual(
            found["columns"]["drift.left.ratio"]["undefined"], int(np.isnan(self.study["drift.left.ratio"]).sum())
        )
        self.assertEqual(
            list(found["fragility"]["share"].values()),
            [self.fallen[self.study["im"] == im].mean() for im in np.unique(self.study["im"])],
        )
        self.assertNotIn("Infinity", json.dumps(found))

    def test_other_programs_get_them(self):
        import pandas

        self.command("study", "export", "s.h5", "-o", "s.csv")
        read = pandas.read_csv(self.folder / "s.csv")
        np.testing.assert_array_equal(np.isinf(read["drift.left [m]"]), self.fallen)
        np.testing.assert_array_equal(read["status"] == "collapsed", self.fallen)
        self.assertTrue(np.isinf(self.study.to_xarray()["force"]).any())
        self.assertEqual(int((self.study.to_pandas()["status"] == "collapsed").sum()), self.fallen.sum())
        with contextlib.suppress(ImportError):
            self.study.to_parquet(self.folder / "s.parquet")

    def test_pictures_show_them(self):
        for picture, column, options in (
            ("fragility", "drift.left", {"limit": "80 mm"}),
            ("fragility", "collapsed", {}),
            ("ida", "drift.left", {}),
            ("gap", None, {}),
            ("map", "drift.left", {"across": "im", "along": "record"}),
            ("map", "drift.left.ratio", {"across": "im", "along": "record"}),
            ("map", "collapsed", {"across": "im", "along": "record"}),
        ):
            figure = self.study.plot(picture, column, **options)
            figure.savefig(self.folder / f"{picture}.svg")
            if picture == "ida":
                self.assertIn("collapsed", [each.get_text() for each in figure.axes[0].get_legend().texts])
            if (picture, column) == ("map", "drift.left"):
                assert_mentions(figure.axes[1].get_ylabel(), "red")
        self.command("study", "plot", "s.h5", "--picture", "fragility", "--column", "collapsed", "-o", "c.png")

    def test_factors_of_collapsed_rows_may_be_drawn_and_their_indices_are_those_of_collapse(self):
        study = self.run_of(
            MODEL, factors={"strength": {"of": "structures.left.shear_building.hardening", "list": [0.001, 0.3]}}
        )
        self.assertIn(COLLAPSED, study["status"])
        study.plot("tornado", "drift.left").savefig(self.folder / "tornado.svg")
        study.plot("tornado", "drift.right").savefig(self.folder / "tornado.svg")
        study.description["sampling"]["way"] = "saltelli"
        with raises(InputError, "collapsed"):
            study.indices("drift.left")

    def test_rows_that_collapse_without_links_need_an_infinite_gap(self):
        study = self.run_of(GUARDED)
        fallen = np.isinf(study["drift.left.alone"])
        self.assertTrue(fallen.any() and (study["status"][fallen] == DONE).any(), study["status"])
        np.testing.assert_array_equal(np.isinf(study["required_gap"]), fallen)
        np.testing.assert_array_equal(np.isinf(study["gap_srss"]), fallen)
        np.testing.assert_array_equal(np.isnan(study["drift.left.ratio"]), fallen | (study["status"] == COLLAPSED))
        curve = study.gaps()
        self.assertEqual(curve.exceedance("10 km"), fallen.mean())
        self.assertTrue(math.isinf(curve.percentile(100)[0]))
        study.plot("gap").savefig(self.folder / "gap.svg")
        told = report_of(study)
        assert_mentions(told, "gap")

    def test_a_separation_says_for_which_records_no_gap_is_enough(self):
        model = {**GUARDED, "analysis": {**MODEL["analysis"]}}
        (self.folder / "guarded.yaml").write_text(
            pounding._yaml_text.emit(
                pounding._yaml_text.plain({**model, "ground_motion": {"record": "recs/r2.csv", "scale": "5"}})
            )
        )
        strong = []
        for name in ("r0.csv", "r2.csv"):
            text = (self.folder / "recs" / name).read_text().splitlines()
            strong.append(self.folder / f"strong_{name}")
            rows = [line.split(",") for line in text[1:]]
            strong[-1].write_text(
                "time,acc (g)\n" + "".join(f"{t},{(0.1 if name == 'r0.csv' else 5) * float(a)!r}\n" for t, a in rows)
            )
        found = json.loads(self.command("separation", "guarded.yaml", "--json", "--records", *strong, "-j", "0"))
        self.assertEqual(found["collapsed"], ["strong_r2.csv"])
        self.assertEqual([one["required"] is None for one in found["records"]], [False, True])
        self.assertEqual((found["mean"]["srss"], found["required"]["84 %"]["gap"]), (None, None))
        told = self.command("separation", "guarded.yaml", "--records", *strong, "-j", "0")
        assert_mentions(told, ["strong_r2.csv", "1", "2"])
        self.assertNotIn("inf", told)

    def test_evaluate_gives_infinite_columns(self):
        study = self.run_of(
            MODEL, factors={"strength": {"of": "structures.left.shear_building.hardening", "list": [0.02]}}
        )
        np.testing.assert_array_equal(study.evaluate({"strength": 0.02})["drift.left"], study["drift.left"])

    def test_collapse_needs_a_model_that_can(self):
        model = {**MODEL, "analysis": {"tolerance": "1e-3"}}
        study = self.run_of(model, intensity={"measure": "pga", "levels": ["0.1 g"]}, keep=["drift"])
        with raises(InputError, "collapse_drift"):
            study.fragility("collapsed")
        with raises(InputError, "80 mm"):
            study.fragility("drift.left")
        with raises(InputError, "collapsed"):
            make_plan(
                pounding.Model(**MODEL),
                {"factors": {"collapsed": {"of": "links.*.gap", "list": [1]}}, "records": {"files": "recs"}},
                self.folder,
            )

    def test_the_amplification_of_a_run_compares_complete_runs(self):
        row = int(np.flatnonzero(self.fallen)[0])
        run = pounding.run(pounding.Model.from_yaml(self.study.model_of(row)))
        self.assertEqual(run.summary["no_pounding"]["amplification"]["left"], [None, None])
        standing = int(np.flatnonzero(np.isfinite(self.study["drift.left.ratio"]))[0])
        run = pounding.run(pounding.Model.from_yaml(self.study.model_of(standing)))
        self.assertNotIn(None, run.summary["no_pounding"]["amplification"]["left"])

    def test_tables_of_earlier_versions_are_read(self):
        # Version 0.2.0 wrote six status names, no warnings, and the numbers until the collapse.
        old = self.folder / "old.h5"
        image = io.BytesIO()
        from pounding._checked_file import write_study

        with h5py.File(self.folder / "s.h5") as file, h5py.File(image, "w") as copy:
            copy.attrs.update(file.attrs)
            for name in file:
                file.copy(name, copy)
            del copy["study/warnings"]
            copy["rows/status"].attrs["labels"] = list(STATUSES[:6])
            copy["rows/status"][:] = [1, 2, 3, 4, 5, 1, 1, 1, 1]
        write_study(old, image.getvalue())
        with self.assertWarnsRegex(pounding.ImplausibleWarning, "old.h5.*0.2.0"):
            study = pounding.Study.open(old)
        self.assertEqual(study["status"].tolist(), [1, 2, 3, 4, 5, 1, 1, 1, 1])
        with raises(InputError, "2"):
            study.fragility("collapsed")
        self.assertEqual(study.finished.tolist(), [True, True, False, False, False, True, True, True, True])
        with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(command.main(["study", "show", str(old)]), 0)
        self.assertIn("1 worker died", printed.getvalue())
        summary(study)


class OfSummaries(unittest.TestCase):
    def test_a_collapse_is_that_of_the_run_of_the_column(self):
        one = {"peak_displacement": [0.1], "peak_drift": [0.1], "peak_acceleration": [1.0]}
        kept = Kept(("drift.a", "drift.a.alone", "drift.a.ratio", "required_gap"))
        fates = {"done": (0.1, 0.1, 1.0, 0.02), "done: collapse": (math.inf, 0.1, math.nan, 0.02)}
        for status, expected in fates.items():
            summary = {
                "status": status,
                "structures": {"a": one},
                "links": [],
                "no_pounding": {"status": "done", "structures": {"a": one}, "separations": [{"enough": 0.02}]},
            }
            np.testing.assert_array_equal(kept.of(summary), expected)
        summary["no_pounding"]["status"] = "done: collapse at t = 1 s"
        summary["status"] = "done"
        np.testing.assert_array_equal(kept.of(summary), (0.1, math.inf, math.nan, math.inf))


if __name__ == "__main__":
    unittest.main()
