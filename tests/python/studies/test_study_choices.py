"""Choices among the rows of a study: values of factors, percentiles, one fragility per value, and tables as text."""

import contextlib
import csv
import io
import json
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding.errors import InputError
from pounding._studies import command
from pounding._studies.percentiles import order_statistic
from messages import assert_mentions, raises
from study_samples import WORDS, pair

FACTORS = {
    "ratio": {
        "of": "structures.right.oscillator.period",
        "times": "structures.left.oscillator.period",
        "list": [0.4, 0.8],
    },
    "gap": {"of": "links.*.gap", "list": ["1 mm", "3 mm", "9 mm"]},
}


class Choices(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.table = str(Path(folder.name) / "s.h5")
        cls.study = pounding.study(pair(), FACTORS, **WORDS, without_links=True, workers=0, output=cls.table)
        plain = {key: value for key, value in WORDS.items() if key != "intensity"}
        cls.plain = pounding.study(pair(), FACTORS, **plain, workers=0)

    def told(self, *words, code=0):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            self.assertEqual(command.main(["study", *words]), code, out.getvalue())
        return out.getvalue()

    def test_values_of_factors_have_units(self):
        expected = np.isclose(self.study["gap"], 3e-3)
        for value in ("3 mm", "3mm", "0.3 cm", 3e-3):
            np.testing.assert_array_equal(self.study.choose(gap=value), expected)
        with raises(InputError, ["gap"]):
            self.study.choose(gap="3 s")

    def test_show_prints_a_table_of_the_chosen_rows(self):
        told = self.told("show", self.table, "--where", "gap=3mm", "--percentile", "84", "--percentile", "90%")
        assert_mentions(told, ["12 finished rows", "gap=3mm", "ratio", "84 %", "90 %"])
        values = self.study["displacement.left"][self.study.choose(gap="3 mm")]
        line = next(line for line in told.splitlines() if line.startswith("displacement.left [mm]"))
        numbers = [float(cell) for cell in line.split()[2:]]
        expected = [values.min(), values.mean(), order_statistic(values, 84), order_statistic(values, 90), values.max()]
        np.testing.assert_allclose(numbers, 1e3 * np.array(expected), rtol=6e-4)
        self.assertNotIn("16 %", told)

    def test_json_has_the_same_numbers(self):
        found = json.loads(self.told("show", self.table, "--json", "--where", "gap=3mm", "--percentile", "90"))
        values = self.study["force"][self.study.choose(gap="3 mm")]
        self.assertEqual(found["columns"]["force"]["90 %"], order_statistic(values, 90))
        self.assertEqual(found["chosen"], 12)
        self.assertNotIn("16 %", found["columns"]["force"])

    def test_export_has_the_chosen_rows(self):
        path = str(Path(self.table).with_name("s.csv"))
        self.told("export", self.table, "-o", path, "--where", "gap=9mm", "--where", "ratio=0.8")
        with open(path, newline="") as file:
            lines = list(csv.DictReader(file))
        np.testing.assert_allclose([float(line["gap [m]"]) for line in lines], 9e-3)
        self.assertEqual(len(lines), 6)

    def test_wrong_choices(self):
        for words, facts in ((["--where", "gap=4mm"], ["0.003"]), (["--where", "gpa=4mm"], ["gpa", "gap"])):
            assert_mentions(self.told("show", self.table, *words, code=2), facts)
        for words in (["--where", "gap"], ["--percentile", "101"], ["--percentile", "x"]):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                command.main(["study", "show", self.table, *words])
        picture = ["plot", self.table, "--picture", "tornado", "--column", "force", "--percentile", "84"]
        assert_mentions(self.told(*picture, code=2), ["--percentile", "tornado"])

    def test_percentiles_without_an_intensity_pool_all_rows(self):
        found = self.plain.percentiles("force", [50, 90])
        self.assertEqual(found.values.shape, (2, 1))
        self.assertEqual(found.values[1, 0], order_statistic(self.plain["force"], 90))
        self.assertEqual(found.count.tolist(), [len(self.plain)])
        chosen = self.plain.percentiles("force", [50], gap="3 mm")
        self.assertEqual(chosen.values[0, 0], order_statistic(self.plain["force"][self.plain.choose(gap="3 mm")], 50))
        with raises(InputError, ["intensity"]):
            self.plain.plot("ida", "force")

    def test_a_fragility_has_one_curve_per_value_of_a_factor(self):
        axes = self.study.plot("fragility", "force", limit="0.4 MN", by="gap").axes[0]
        assert_mentions([each.get_text() for each in axes.get_legend().texts], ["1 mm", "3 mm", "9 mm"])
        assert_mentions(axes.get_title("left"), ["400 kN", "ratio"])
        points = [line for line in axes.lines if line.get_marker() == "o" and len(line.get_xdata())]
        for line, gap in zip(points, ("1 mm", "3 mm", "9 mm")):
            curve = self.study.fragility("force", "0.4 MN", gap=gap)
            np.testing.assert_array_equal(line.get_ydata(), curve.exceeded / curve.count)
        with raises(InputError, ["gpa", "gap"]):
            self.study.plot("fragility", "force", limit="0.4 MN", by="gpa")

    def test_a_single_list_has_curves_by_default_and_two_are_pooled(self):
        pooled = self.study.plot("fragility", "force", limit="0.4 MN").axes[0]
        assert_mentions(pooled.get_title("left"), ["ratio", "gap"])
        single = self.study.plot("fragility", "force", limit="0.4 MN", ratio=0.8).axes[0]
        assert_mentions([each.get_text() for each in single.get_legend().texts], "9 mm")

    def test_a_map_of_ratios_is_centred_at_1_with_ticks_at_the_levels(self):
        figure = self.study.plot("map", "displacement.left.ratio", across="gap", along="ratio")
        axes = figure.axes[0]
        norm = axes.collections[0].norm
        self.assertAlmostEqual(norm(1.0), 0.5)
        np.testing.assert_allclose(axes.get_xticks(), [1, 3, 9])
        np.testing.assert_allclose(axes.get_yticks(), [0.4, 0.8])
        assert_mentions(figure.axes[1].get_ylabel().replace("\n", " "), ["with / without links", "left", "median"])

    def test_help_names_each_subcommand_and_its_options(self):
        told = self.told("--help")
        assert_mentions(told, ["run", "check", "show", "merge", "plot", "export", "pounding study show --help"])
        out = io.StringIO()
        with self.assertRaises(SystemExit), contextlib.redirect_stdout(out):
            command.main(["study", "run", "--help"])
        assert_mentions(out.getvalue(), ["pounding study run", "--workers"])


if __name__ == "__main__":
    os.environ.setdefault("MPLBACKEND", "agg")
    unittest.main()
