"""`pounding separation`: statistics of codes, levels, alignment of floors, property lines, quantiles and messages."""

import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding import separation
from pounding.errors import InputError
from pounding._studies import gaps
from pounding._studies.separation_table import table_of
from pounding._studies.study import study
from study_samples import pair
from messages import assert_mentions, raises

BUILDING = {"mass": "100 t", "stiffness": "120 MN/m"}
STRUCTURES = {
    "left": {"shear_building": {"storeys": 3, "height": "3 m", **BUILDING}, "damping": "5 %"},
    "right": {"shear_building": {"storeys": 2, "height": "3 m", **BUILDING}, "damping": "5 %"},
}
LINK = {"between": ["left", "right"], "floors": "all", "gap": "20 mm", "law": "hertz", "stiffness": "1e9"}
OFFSET = {**STRUCTURES, "right": {"shear_building": {"storeys": 2, "height": "3.5 m", **BUILDING}, "damping": "5 %"}}


def records(count):
    return {"records": {"synthetic": {"count": count, "duration": "0.8 s", "pga": "0.3 g"}}}


class Separations(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, structures=None, links=None, **keys):
        model = pair(structures=structures or STRUCTURES, links=links or [LINK])
        text = model.to_yaml() + pounding._yaml_text.emit(pounding._yaml_text.plain({"study": keys or records(3)}))
        (self.folder / "model.yaml").write_text(text)
        return self.folder / "model.yaml"

    def code(self, found, name):
        [one] = [one for one in found["codes"] if one["code"].startswith(name)]
        return one

    def ends(self, **keys):
        """[row] peaks of both ends of both links, from a study."""
        kept = [f"end_{side}.left.{i}-right.{i}" for i in (1, 2) for side in ("left", "right")]
        one = study(self.file(**keys, keep=[*kept, "required_gap.left.2-right.2"]), workers=0)
        return [one[column] for column in kept], one


class Statistics(Separations):
    def test_each_code_takes_its_statistic_structure_by_structure(self):
        for count in (2, 6, 7, 10, 11):
            (_, _, left, right), _ = self.ends(**records(count))
            found = separation(self.file(**records(count)))
            mean = math.hypot(left.mean(), right.mean())
            largest = math.hypot(left.max(), right.max())
            expected = {
                "EN": 0.7 * (mean if count >= 7 else largest),
                "ASCE 7-16": mean if count >= 11 else largest,
                "ASCE 7-22": mean if count >= 11 else largest,
                "NZS": left.max() + right.max(),
                "NBCC": largest,
                "TBDY": max(0.25 * largest, 0.030),
            }
            for name, gap in expected.items():
                with self.subTest(name, count=count):
                    self.assertAlmostEqual(self.code(found, name)["gap"], gap, places=12)
            too_few = {one["code"][:4] for one in found["codes"] if one["warnings"]}
            self.assertEqual(
                too_few, ({"ASCE"} if count < 11 else set()) | ({"EN 1", "NZS ", "NTC "} if count < 3 else set())
            )
            assert_mentions(self.code(found, "ASCE 7-16")["statistic"], str(count))

    def test_displacements_of_ends_are_those_of_the_run_without_links(self):
        values, one = self.ends(**records(2))
        model = pounding.Model.from_yaml(one.model_of(1))
        model.compare = "no_pounding"
        links = pounding.run(model).summary["no_pounding"]["separations"]
        for k, (link, side) in enumerate((link, side) for link in links for side in ("left", "right")):
            self.assertAlmostEqual(values[k][1] / link[side], 1, delta=2e-3)
        self.assertAlmostEqual(links[0]["abs"], links[0]["left"] + links[0]["right"], places=14)
        self.assertAlmostEqual(one["required_gap.left.2-right.2"][1] / links[1]["enough"], 1, delta=2e-3)
        solver = study(self.file(**records(2), engine="solver", keep=["end_left", "end_right"]), workers=0)
        np.testing.assert_allclose(solver["end_left"], np.maximum(values[0], values[2]), rtol=2e-3)

    def test_gaps_are_given_at_every_level(self):
        found = separation(self.file())
        self.assertEqual([one["height"] for one in found["levels"]], [3, 6])
        [one] = self.code(found, "NZS")["pairs"]
        self.assertEqual([level["link"] for level in one["levels"]], ["left.1-right.1", "left.2-right.2"])
        for level, of_link in zip(one["levels"], found["levels"]):
            self.assertAlmostEqual(level["gap"], of_link["left_largest"] + of_link["right_largest"], places=14)
        self.assertEqual(one["gap"], max(level["gap"] for level in one["levels"]))
        self.assertEqual((one["governs"], one["available"]), ("left.2-right.2", 0.02))

    def test_the_numbers_of_lesson_23(self):
        folder = Path(__file__).resolve().parents[3] / "examples/23_gap_that_is_enough"
        found = separation(folder / "study.yaml", keys={"codes": "EN"})
        [one] = found["codes"]
        exceeded = sum(record["required"] > one["gap"] for record in found["records"])
        text = " ".join((folder / "README.md").read_text().split())
        self.assertEqual((exceeded, len(found["records"])), (18, 20))
        self.assertIn("Eighteen of the twenty earthquakes need more", text)


class Conditions(Separations):
    def test_alignment_is_that_of_the_elevations(self):
        aligned = separation(self.file())
        links = [
            {key: value for key, value in {**LINK, "between": [f"left.{i}", f"right.{i}"]}.items() if key != "floors"}
            for i in (1, 2)
        ]
        offset = separation(self.file(OFFSET, links))
        self.assertEqual((aligned["floors_align"], offset["floors_align"]), (True, False))
        factors = [self.code(one, "EN")["pairs"][0]["factor"] for one in (aligned, offset)]
        self.assertEqual(factors, [0.7, 1.0])

    def test_unknown_elevations_count_as_offset_unless_given(self):
        (self.folder / "pair.yaml").write_text(pair().to_yaml())
        unknown = separation(self.folder / "pair.yaml")
        [one] = self.code(unknown, "EN")["pairs"]
        self.assertEqual((one["aligned"], one["factor"]), (None, 1.0))
        assert_mentions(one["note"], "floors: aligned")
        given = separation(self.folder / "pair.yaml", keys={"floors": "aligned"})
        self.assertAlmostEqual(self.code(given, "EN")["gap"], 0.7 * one["gap"])
        assert_mentions(self.code(unknown, "TBDY")["pairs"][0]["missing"], "heights")

    def test_a_property_line_sets_each_structure_back(self):
        found = separation(self.file(**records(7)), keys={"property": "line"})
        top = found["levels"][1]
        [one] = self.code(found, "EN")["pairs"]
        self.assertAlmostEqual(one["setbacks"]["left"], top["left_mean"])
        self.assertAlmostEqual(one["setbacks"]["right"], top["right_mean"])
        self.assertAlmostEqual(one["gap"], top["left_mean"] + top["right_mean"])
        assert_mentions(table_of(found), ["property line", f"left {1e3 * top['left_mean']:.1f}"])

    def test_reduced_displacements_take_the_factor_of_each_structure(self):
        keys = {
            "displacements": "reduced",
            "codes": ["IS", "EN"],
            "behaviour": {"q": 3},
            "structures": {"left": {"R": 5}, "right": {"R": 3}},
        }
        found = separation(self.file(**records(3), separation=keys))
        top = found["levels"][1]
        self.assertAlmostEqual(self.code(found, "IS")["gap"], 5 * top["left_largest"] + 3 * top["right_largest"])
        self.assertAlmostEqual(
            self.code(found, "EN")["gap"], 0.7 * 3 * math.hypot(top["left_largest"], top["right_largest"])
        )
        self.assertEqual(len(found["codes"]), 2)

    def test_a_missing_input_names_what_to_type(self):
        found = separation(self.file(), keys={"displacements": "reduced", "structures": {"left": {"R": 8}}})
        [one] = self.code(found, "E.030")["pairs"]
        self.assertIsNone(one["gap"])
        assert_mentions(one["missing"], ["--set amplification=6", "Z=0.45", "S=1.05", "study.separation.behaviour"])
        assert_mentions(self.code(found, "TBDY")["pairs"][0]["missing"], ["right.R=8", "importance=1"])
        assert_mentions(table_of(found), ["--set q=3"])

    def test_marks_are_in_every_output(self):
        found = separation(self.file())
        lines = table_of(found).splitlines()
        for one in found["codes"]:
            self.assertEqual(one["mark"], "" if one["verified"] else "check the edition")
            [line] = [line for line in lines if line.startswith(one["code"])]
            self.assertEqual("check the edition" in line, not one["verified"])

    def test_wrong_keys_are_errors(self):
        for facts, keys in (
            (["propety", "property"], {"propety": "line"}),
            (["EM 1998", "EN 1998-1:2004"], {"codes": "EM 1998"}),
            (["study.separation.behaviour.q"], {"behaviour": {"q": -3}}),
            (["lefft", "left"], {"structures": {"lefft": {"R": 8}}}),
            (["intensity", "9"], {"behaviour": {"intensity": 12}}),
        ):
            with self.subTest(str(keys)), raises(InputError, facts):
                separation(self.file(**records(2), separation=keys))
        with raises(InputError, ["quantile", "95 %"]):
            separation(self.file(), quantile="105 %")


class Quantiles(Separations):
    def test_bands_and_targets(self):
        found = separation(self.file(**records(20)), quantile=["95 %", 0.5], probability="10 %")
        values = np.sort([one["required"] for one in found["records"]])
        self.assertEqual(found["required"]["95 %"]["gap"], values[18])
        self.assertEqual(found["required"]["95 %"]["high"], None)
        self.assertEqual(found["required"]["95 %"]["records_for_band"], 59)
        self.assertEqual(found["contact"]["10 %"]["gap"], values[17])
        self.assertEqual(np.mean(values > found["contact"]["10 %"]["gap"]), 0.1)
        assert_mentions(table_of(found), ["59", "20", "10 % probability"])

    def test_the_number_of_records_makes_the_band_finite(self):
        for percent, count in ((50, 5), (84, 18), (90, 29), (95, 59), (99, 299)):
            self.assertEqual(gaps.records_for_band(percent), count)
            for n in (count - 1, count):
                curve = gaps.GapCurve.of(np.arange(1.0, n + 1), {})
                self.assertEqual(math.isfinite(curve.percentile(percent)[2]), n >= count, (percent, n))

    def test_binomial_quantiles_are_those_of_scipy(self):
        from scipy.stats import binom

        for n in (1, 7, 20, 333, 5000):
            for share in (0.0, 0.01, 0.5, 0.84, 0.95, 1.0):
                for probability in (0.05, 0.37, 0.95):
                    self.assertEqual(gaps._binomial_quantile(probability, n, share), binom.ppf(probability, n, share))


class Commands(Separations):
    def command(self, *words, **options):
        code = "import sys; from pounding.__main__ import command; sys.exit(command())"
        return subprocess.run(
            [sys.executable, "-c", code, *map(str, words)],
            cwd=self.folder,
            stderr=subprocess.PIPE,
            text=True,
            timeout=120,
            **{"stdout": subprocess.PIPE, **options},
        )

    def test_options_are_the_keys(self):
        words = ["--property", "line", "--code", "E.030", "--set", "Z=0.45", "--set", "S=1.05", "--quantile", "90 %"]
        done = self.command("separation", self.file(), *words, "--json", "-j", "0")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = json.loads(done.stdout)
        keys = {"property": "line", "codes": ["E.030"], "behaviour": {"Z": 0.45, "S": 1.05}}
        self.assertEqual(found, separation(self.file(), quantile="90 %", keys=keys))
        # Peru: half of 0.02 x 0.45 x 1.05 x 6 m from the line, more than two thirds of the displacement.
        self.assertAlmostEqual(found["codes"][0]["pairs"][0]["setbacks"]["left"], 0.01 * 0.45 * 1.05 * 6)

    def test_wrong_options_say_what_to_type(self):
        for words, facts in (
            (["--set", "q"], ["q=3", "left.R=8"]),
            (["--quantile", "0"], ["--quantile", "95 %"]),
            (["--code", "EC9"], ["EC9", "EN 1998-1:2004"]),
        ):
            done = self.command("separation", self.file(), *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            assert_mentions(done.stderr, facts)

    def test_a_closed_pipe_is_no_error(self):
        file = self.file()
        self.command("study", file, "-o", "s.h5", "-q", "-j", "0")
        for words in (
            ["separation", file, "-j", "0"],
            ["screen", file],
            ["study", "show", "s.h5"],
            ["study", "show", "s.h5", "--json"],
            ["study", "show", "s.h5", "--row", "0"],
            ["study", "check", file],
        ):
            reader, writer = os.pipe()
            os.close(reader)
            with self.subTest(str(words)):
                done = self.command(*words, stdout=writer)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
            os.close(writer)

    def test_help_lists_the_options(self):
        done = self.command("separation", "--help")
        assert_mentions(done.stdout, ["--property", "--quantile", "--probability", "--set", "--code"])
        assert_mentions(self.command("screen", "--help").stdout, ["--seismicity", "very_high"])

    def test_without_the_compiled_part_the_message_says_what_to_type(self):
        sources = Path(__file__).resolve().parents[3] / "python"
        done = subprocess.run(
            [sys.executable, "-m", "pounding._studies.command", "separation", "model.yaml"],
            env={**os.environ, "PYTHONPATH": str(sources)},
            capture_output=True,
            text=True,
            timeout=120,
        )
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1))
        assert_mentions(done.stderr, "make")

    def test_scipy_is_not_needed(self):
        code = "import sys; sys.modules['scipy'] = None; from pounding.__main__ import command; sys.exit(command())"
        words = ["separation", self.file(), "--quantile", "95 %", "-j", "0"]
        done = subprocess.run(
            [sys.executable, "-c", code, *map(str, words)], capture_output=True, text=True, timeout=120
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
