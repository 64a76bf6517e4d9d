"""Records cut by analysis.duration: run, study and separation warn with their number."""

import json
import math
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import pounding
from pounding._studies.plan import make_plan, read_plan
from pounding._studies.study import run_plan
from study_samples import pair


def write_record(path, duration, unit="acc (g)", size=0.1):
    """Its intensity arrives uniformly, so that half the duration has half of it."""
    count = int(round(duration / 0.01)) + 1
    path.write_text(
        f"time,{unit}\n" + "".join(f"{0.01 * i:.2f},{size if i % 40 < 20 else -size}\n" for i in range(count))
    )


MODEL = """\
{motion}structures:
  left: {{oscillator: {{mass: 100 t, period: 0.8 s, damping: 5 %}}{left}}}
  right: {{oscillator: {{mass: 150 t, period: 0.4 s, damping: 5 %}}{right}}}
links: [{{between: [left, right], gap: 5 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}}]
analysis: {{{duration}tolerance: 1e-3}}
"""
CUT = r"analysis: the duration of {} s cuts {} of {} records?, by more than 5 % of the Arias intensity and up to {} %"


class Cuts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name, duration in (("a.csv", 1), ("b.csv", 2), ("c.csv", 4)):
            write_record(self.folder / name, duration)

    def write(self, name, motion="", duration="duration: 2 s, ", left="", right="", more=""):
        path = self.folder / name
        path.write_text(
            MODEL.format(
                motion=f"ground_motion: {motion}\n" if motion else "", duration=duration, left=left, right=right
            )
            + more
        )
        return path

    def command(self, *words):
        done = subprocess.run(
            [sys.executable, "-m", "pounding", *map(str, words)],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def warned(self, call):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = call()
        return found, [str(one.message) for one in caught if issubclass(one.category, pounding.ImplausibleWarning)]

    def doubts(self, *words, **options):
        return [text for text in pounding.check(self.write("m.yaml", *words, **options)).warnings]

    def test_a_run_warns(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for motion, expected in (
                ("{record: c.csv}", CUT.format(2, 1, 1, 50)),
                ("{record: c.csv, pga: 2 m/s^2}", CUT.format(2, 1, 1, 50)),
                ("{record: b.csv}", None),
                ("{record: a.csv}", None),
                ("{harmonic: {amplitude: 1, period: 1, duration: 9}}", None),
                ("{synthetic: {seed: 1, duration: 6 s, pga: 0.1 g}}", CUT.format(2, 1, 1, ".*")),
                ("{displacement: {record: d.csv}}", CUT.format(2, 1, 1, ".*")),
            ):
                if "d.csv" in motion:
                    lines = (f"{0.01 * i:.2f},{15 * (1 - math.cos(0.06 * i)):.6f}\n" for i in range(401))
                    (self.folder / "d.csv").write_text("time,disp (mm)\n" + "".join(lines))
                found = self.doubts(motion)
                self.assertEqual(len(found), 1 if expected else 0, (motion, found))
                if expected:
                    self.assertRegex(found[0], "^" + expected)
            self.assertEqual(self.doubts("{record: c.csv}", duration=""), [])
            self.assertEqual(self.doubts("{record: c.csv}", more="accept: [duration]\n"), [])
        run, texts = self.warned(lambda: pounding.run(self.write("m.yaml", "{record: c.csv}")))
        self.assertRegex(texts[0], CUT.format(2, 1, 1, 50))
        self.assertEqual(run.summary["warnings"], texts)

    def test_forces_waves_and_delays_are_cut_too(self):
        write_record(self.folder / "f.csv", 4, "force (kN)", 10)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertRegex(
                self.doubts("{record: b.csv}", right=", forces: [{record: f.csv}]")[0], CUT.format(2, 1, 2, 50)
            )
            self.assertRegex(self.doubts("{record: b.csv}", right=", delay: 0.5 s")[0], CUT.format(2, 1, 1, 25))
            self.assertRegex(
                self.doubts(
                    "{record: c.csv}", left=", ground_motion: {record: b.csv}", right=", ground_motion: {record: c.csv}"
                )[0],
                CUT.format(2, "[12]", "[23]", 50),
            )

    def test_a_study_counts_the_records_that_are_cut(self):
        self.write("m.yaml")
        (self.folder / "study.yaml").write_text(
            "model: m.yaml\nstudy:\n  records: {files: [a.csv, b.csv, c.csv]}\n  keep: [displacement, required_gap]\n"
        )
        expected = (
            CUT.format(2, 1, 3, 50)
            + r"; type a duration of at least 3.8 s, or leave it out, and each row lasts as long as its record"
        )
        for words, place in (
            ("check study.yaml", "stderr"),
            ("study.yaml -j 0", "stderr"),
            ("study.yaml -j 0", "stdout"),
            ("show study.h5", "stdout"),
        ):
            found = getattr(self.command("study", *words.split()), place)
            self.assertRegex(found, expected, words)
            self.assertEqual(found.count("cuts"), 1, (words, found))
        self.assertRegex(
            json.loads(self.command("study", "show", "study.h5", "--json").stdout)["warnings"][0], expected
        )
        study, texts = self.warned(lambda: pounding.study(self.folder / "study.yaml", workers=0, progress=False))
        self.assertRegex("\n".join(texts), expected)
        self.assertEqual((list(study.warnings), len(texts)), (texts, 1))
        self.assertEqual(pounding.Study.open(self.folder / "study.h5").warnings, study.warnings)

    def test_a_separation_warns(self):
        self.write("m.yaml")
        done = self.command("separation", "m.yaml", "--records", "a.csv", "c.csv", "-j", "0", "--json")
        self.assertRegex(done.stderr, "warning: " + CUT.format(2, 1, 2, 50))
        self.assertRegex(json.loads(done.stdout)["warnings"][0], CUT.format(2, 1, 2, 50))
        self.assertEqual(self.command("separation", "m.yaml", "--records", "a.csv", "b.csv", "-j", "0").stderr, "")
        # Without records the model's own motion counts.
        self.write("own.yaml", "{record: c.csv}")
        found = self.command("separation", "own.yaml").stderr
        self.assertRegex(found, CUT.format(2, 1, 1, 50))
        self.assertEqual(found.count("cuts"), 1, found)

    def plan(self, words, **options):
        return make_plan(pounding.Model.from_file(self.write("m.yaml", **options)), words, self.folder)

    def test_the_models_own_motion_counts_only_where_it_runs(self):
        words = {"records": {"files": ["a.csv", "b.csv"]}}
        self.assertEqual(self.plan(words, motion="{record: c.csv}").warnings, ())
        self.assertRegex(
            self.plan({"factors": {"gap": {"of": "links.*.gap", "list": [0.01]}}}, motion="{record: c.csv}").warnings[
                0
            ],
            CUT.format(2, 1, 1, 50),
        )
        # A force of the model acts in every row.
        write_record(self.folder / "f.csv", 4, "force (kN)", 10)
        self.assertRegex(self.plan(words, right=", forces: [{record: f.csv}]").warnings[0], CUT.format(2, 1, 2, 50))
        self.assertEqual(self.plan(words, motion="{record: c.csv}", more="accept: [duration]\n").warnings, ())
        self.assertEqual(self.plan({"records": {"files": ["c.csv"]}}, more="accept: [duration]\n").warnings, ())

    def test_the_shortest_duration_of_the_rows_counts(self):
        factors = {"t": {"of": "analysis.duration", "list": ["4 s", "1 s"]}}
        found = self.plan({"factors": factors, "records": {"files": ["a.csv", "b.csv", "c.csv"]}}).warnings
        self.assertRegex(found[0], CUT.format(1, 2, 3, 75))

    def test_factors_of_the_motion_count(self):
        motion = "{synthetic: {seed: 1, duration: 2 s, pga: 0.1 g, soil: firm}}"
        of = lambda path, *values: {"factors": {"f": {"of": path, "list": list(values)}}}
        self.assertEqual(self.plan(of("ground_motion.synthetic.duration", "1 s", "2 s"), motion=motion).warnings, ())
        self.assertRegex(
            self.plan(of("ground_motion.synthetic.duration", "1 s", "8 s"), motion=motion).warnings[0],
            CUT.format(2, 1, 1, ".*"),
        )
        self.assertRegex(
            self.plan(of("ground_motion.record", "a.csv", "c.csv"), motion="{record: a.csv}").warnings[0],
            CUT.format(2, 1, 1, 50),
        )

    def test_artificial_records_and_late_supports_are_cut(self):
        synthetic = {
            "records": {"synthetic": {"count": 3, "duration": "6 s", "pga": "0.1 g"}},
            "intensity": {"measure": "pga", "levels": ["0.1 g", "0.2 g"]},
        }
        self.assertRegex(self.plan(synthetic).warnings[0], CUT.format(2, 3, 3, ".*"))
        self.assertEqual(
            self.plan({"records": {"synthetic": {"count": 3, "duration": "2 s", "pga": "0.1 g"}}}).warnings, ()
        )
        self.assertRegex(
            self.plan(
                {"records": {"files": ["a.csv", "b.csv"]}}, motion="{record: a.csv}", right=", delay: 1 s"
            ).warnings[0],
            CUT.format(2, 1, 2, 50),
        )

    def test_a_plan_without_a_cut_has_no_warning(self):
        self.assertEqual(self.plan({"records": {"files": ["a.csv", "b.csv", "c.csv"]}}, duration="").warnings, ())
        self.assertEqual(make_plan(pair(), {}, Path()).warnings, ())
        self.write("m.yaml", duration="duration: 9 s, ")
        (self.folder / "study.yaml").write_text("model: m.yaml\nstudy: {records: {files: [a.csv, b.csv, c.csv]}}\n")
        self.assertEqual(read_plan(self.folder / "study.yaml").warnings, ())

    def test_a_warning_changes_no_row(self):
        words = {"records": {"files": ["c.csv"]}, "keep": ["displacement"]}
        cut = run_plan(self.plan(words), None, workers=0)
        accepted = run_plan(self.plan(words, more="accept: [duration]\n"), None, workers=0)
        np.testing.assert_array_equal(cut["displacement.left"], accepted["displacement.left"])


if __name__ == "__main__":
    unittest.main()
