"""Suites of records: scaling to code spectra, statistics, bitwise repeatable rows, and the command."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

import pounding
from pounding import _yaml_text as yaml_text
from pounding.errors import ImplausibleWarning, InputError
from pounding._studies.scaling import rotd100
from pounding._studies.suite import Suite
from pounding._studies.suite_data import Statistics
from pounding._studies.target_spectra import asce7, en1998
from messages import assert_mentions, raises
from study_samples import bents, pair, write_records

G = 9.80665
NAMES = [f"r{i}.csv" for i in range(4)]


class Targets(unittest.TestCase):
    """Spectra of codes compared with values of their formulas by hand."""

    def test_en_1998_1(self):
        # Type 1, ground C: S = 1.15, TB = 0.2 s, TC = 0.6 s, TD = 2 s; plateau 2.5 ag S = 0.8625 g for ag = 0.3 g.
        periods = np.array([0.0, 0.1, 0.2, 0.6, 1.2, 2.0, 4.0])
        expected = 0.345 * np.array([1, 1.75, 2.5, 2.5, 1.25, 0.75, 0.1875])
        np.testing.assert_allclose(en1998(periods, 0.3, "C", 1, 0.05), expected, rtol=1e-12)
        # 10 % of damping: eta = sqrt(10/15).
        self.assertAlmostEqual(en1998(np.array([0.5]), 1.0, "A", 1, 0.10)[0], 2.5 * 0.4 / 0.5 * np.sqrt(2 / 3), 12)

    def test_asce_7(self):
        # T0 = 0.12 s, TS = 0.6 s, TL = 8 s.
        periods = np.array([0.0, 0.06, 0.12, 0.6, 1.2, 8.0, 16.0])
        expected = np.array([0.4, 0.7, 1.0, 1.0, 0.5, 0.075, 0.01875])
        np.testing.assert_allclose(asce7(periods, 1.0, 0.6, 8.0), expected, rtol=1e-12)

    def test_rotd100_equals_the_largest_projection_of_an_independent_integration(self):
        step = 0.02
        times = np.arange(0, 4, step)
        x, y = np.sin(7 * times) + 0.3, np.cos(11 * times) * np.exp(-times)
        for period in (0.3, 1.0):
            omega = 2 * np.pi / period

            def rates(t, state):
                ground = np.interp(t, times, x, right=0), np.interp(t, times, y, right=0)
                pull = -np.array(ground) - 2 * 0.05 * omega * state[2:] - omega**2 * state[:2]
                return np.concatenate([state[2:], pull])

            found = solve_ivp(rates, (0, times[-1]), np.zeros(4), rtol=1e-9, atol=1e-12, max_step=step)
            dense = found.y[:2]
            angles = np.radians(np.arange(0, 180, 0.5))
            largest = max(np.abs(dense[0] * np.cos(a) + dense[1] * np.sin(a)).max() for a in angles)
            ours = rotd100([(step, x), (step, y)], np.array([period]), 0.05)[0] / omega**2
            self.assertGreater(ours, largest * (1 - 2e-3))
            # The oscillator vibrates freely after the end of the record.
            self.assertLess(ours, largest * 1.02 if period < 0.5 else largest * 1.3)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        write_records(self.folder, NAMES)
        self.files = [str(self.folder / name) for name in NAMES]

    def file(self, records, model=None, name="suite.yaml"):
        parts = (model or pair(analysis=None, ground_motion=None))._parts()
        text = yaml_text.emit({"records": records, **{key: value for key, value in parts.items() if value}})
        (self.folder / name).write_text(text)
        return str(self.folder / name)

    def run_command(self, *words, code=0):
        program = [os.environ["POUNDING_PROGRAM"], "suite", *words]
        done = subprocess.run(program, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done


class Scaling(Folder):
    target = {"periods": ["0.05 s", "0.5 s", "5 s"], "sa": ["0.9 g", "0.8 g", "0.1 g"]}

    def scaled(self, **more):
        scale = {"spectrum": self.target, "from": "0.1 s", "to": "1 s", **more}
        return pounding.suite(pair(), {"files": self.files}, scale_to=scale, workers=0).scaling

    def test_least_squares_has_no_better_factor(self):
        one = self.scaled()
        self.assertEqual(one.method, "least_squares")
        spectra, target = np.array(one.spectra), np.array(one.sa)
        for factor, spectrum in zip(one.factors, spectra):
            misfit = [((f * spectrum - target) ** 2).sum() for f in (factor, 0.999 * factor, 1.001 * factor)]
            self.assertEqual(min(misfit), misfit[0])

    def test_means_over_the_range_are_equal(self):
        one = self.scaled(method="mean")
        means = np.array(one.factors) * np.array(one.spectra).mean(axis=1)
        np.testing.assert_allclose(means, np.mean(one.sa), rtol=1e-12)

    def test_the_mean_of_a_suite_touches_the_fraction(self):
        one = self.scaled(method="suite", fraction="80 %")
        self.assertAlmostEqual(one.fit.min(), 0.8, places=12)
        self.assertEqual(len(set(one.factors)), 1)

    def test_a_fraction_raises_factors_of_single_records(self):
        without, raised = self.scaled(), self.scaled(fraction="100 %")
        self.assertLess(without.fit.min(), 1)
        self.assertAlmostEqual(raised.fit.min(), 1, places=12)

    def test_spectra_are_those_of_the_records(self):
        one = self.scaled()
        expected = pounding.record_spectrum(self.files[0], 0.05, list(one.periods))
        np.testing.assert_allclose(one.spectra[0], expected.psa, rtol=1e-9)

    def test_rows_have_the_scaled_motion(self):
        made = pounding.suite(
            pair(), {"files": self.files}, scale_to={"spectrum": self.target, "from": "0.1 s", "to": "1 s"}, workers=0
        )
        row = pounding.Model._from_text(made.model_of(1), "row")
        self.assertAlmostEqual(float(row.ground_motion["scale"]), made.scaling.factors[1], places=14)
        run = pounding.run(row)
        self.assertEqual(
            made.floors("left", "displacement")[1, 0], run.summary["structures"]["left"]["peak_displacement"][0]
        )

    def test_en_1998_1_raises_the_zero_period(self):
        scale = {"spectrum": {"en1998_1": {"ag": "0.3 g", "soil": "C"}}, "from": "0.2 s", "to": "1 s"}
        made = pounding.suite(pair(), {"files": self.files}, scale_to=scale, workers=0)
        peaks = made.records["pga"]
        self.assertGreaterEqual(np.mean(peaks), 0.3 * G * 1.15 * (1 - 1e-12))
        self.assertGreaterEqual(made.scaling.fit.min(), 0.9 * (1 - 1e-12))
        assert_mentions(made.scaling.note, ["3.2.3.1.2(4)", "Check the edition"])

    def test_refusals(self):
        for more, facts in (
            ({"to": "6 s"}, ["5 s", "6 s"]),
            ({"from": "2 s", "to": "1 s"}, ["from", "to"]),
            ({"components": "srss"}, ["components"]),
            ({"spectrum": {"sa": ["1 g", "1 g"]}}, ["periods"]),
            (
                {"spectrum": {"asce_7": {"SDS": "1 g", "SD1": "0.6 g", "TL": "8 s"}}, "damping": "2 %"},
                ["ASCE 7", "5 %"],
            ),
            ({"spectrum": {"en1998_1": {"ag": "0.3 g", "soil": "F"}}}, ["soil"]),
            ({"methud": "mean"}, ["methud", "method"]),
        ):
            with self.subTest(more), raises(InputError, facts):
                self.scaled(**more)

    def test_warnings(self):
        scale = {"spectrum": {"asce_7": {"SDS": "1.0", "SD1": "0.6 g", "TL": "8 s"}}, "from": "0.2 s", "to": "1 s"}
        with self.assertWarns(ImplausibleWarning) as caught:
            made = pounding.suite(pair(), {"files": self.files}, scale_to=scale, workers=0)
        self.assertIsNotNone(caught)
        assert_mentions(" ".join(made.warnings), ["SDS", "1.0 g", "11"])


class Runs(Folder):
    def test_statistics_equal_those_of_separate_runs(self):
        made = pounding.suite(pair(compare="no_pounding"), {"files": self.files}, workers=0)
        single = []
        for name in self.files:
            run = pounding.run(
                pair(compare="no_pounding", ground_motion={"record": name}, analysis={"tolerance": "1e-3"})
            )
            single.append(run.summary["structures"]["right"]["peak_displacement"][0])
        values = made.floors("right", "displacement")
        np.testing.assert_array_equal(values[:, 0], single)
        found = made.statistics(values, (16, 84))
        self.assertEqual(found.mean[0], np.mean(single))
        self.assertEqual(found.percentiles[1, 0], sorted(single)[3])
        self.assertEqual(found.percentiles[0, 0], sorted(single)[0])
        self.assertEqual(found.max[0], max(single))
        self.assertTrue(made.has_comparison)

    def test_rows_are_bitwise_the_same_for_any_number_of_processes(self):
        here, there = (pounding.suite(pair(), {"files": self.files}, workers=count) for count in (0, 2))
        for column in here.columns:
            self.assertEqual(here[column].tobytes(), there[column].tobytes(), column)

    def test_two_components_act_together(self):
        model = bents()
        made = pounding.suite(model, {"x": self.files[:2], "z": self.files[2:]}, workers=0)
        self.assertEqual(len(made), 2)
        self.assertIn("components", made.model_of(0))
        self.assertEqual(made.members("left").shape, (2, 3, 3))

    def test_collapsed_and_failed_records_are_counted(self):
        building = {
            "shear_building": {"storeys": 1, "mass": "100 t", "stiffness": "20 MN/m", "height": "3 m"},
            "damping": "5 %",
        }
        model = pair(
            structures={"left": building, "right": {"wall": {}}},
            analysis={"tolerance": "1e-3", "collapse_drift": "0.2 %"},
        )
        write_records(self.folder, ["weak.csv"], peak=0.01)
        made = pounding.suite(model, {"files": [*self.files[:2], str(self.folder / "weak.csv")]}, workers=0)
        self.assertEqual(len(made.collapsed), 2)
        found = made.statistics(made.floors("left", "displacement"))
        self.assertEqual(found.mean[0], np.inf)
        self.assertTrue(np.isfinite(found.percentiles[0, 0]))

    def test_undefined_values_are_left_out_of_statistics(self):
        found = Statistics.of(np.array([[1.0, np.nan], [3.0, np.nan]]), (50,))
        self.assertEqual(found.mean[0], 2.0)
        self.assertTrue(np.isnan(found.mean[1]))


class Command(Folder):
    def test_table_json_and_picture(self):
        file = self.file({"files": "r?.csv"}, pair(ground_motion=None, analysis=None, compare="no_pounding"))
        done = self.run_command(file, "-o", "s.h5", "--plot", "p.png", "--percentile", "84", "-j", "0")
        assert_mentions(done.stdout, ["4 records", "left: displacement [mm]", "84 %", "mean alone"])
        self.assertGreater((self.folder / "p.png").stat().st_size, 10000)
        read = json.loads(self.run_command(file, "-o", "s.h5", "--json", "-j", "0").stdout)
        table = Suite.open(self.folder / "s.h5")
        self.assertEqual(
            read["structures"]["left"]["displacement"]["mean"][0], table.floors("left", "displacement").mean()
        )
        self.assertEqual([one["name"] for one in read["records"]], NAMES)
        self.assertIn("required_gap", read)

    def test_a_model_in_a_small_figure(self):
        made = pounding.suite(bents(), {"files": self.files[:2]}, workers=0)
        self.assertEqual(len(made.profiles(size=(3.3, 2.4)).axes), 2)
        with raises(InputError, ["drft", "drift"]):
            made.profiles(["drft"])

    def test_errors_have_the_line_of_the_file(self):
        file = self.file({"files": "r?.csv", "scale_too": {}})
        done = self.run_command(file, code=2)
        assert_mentions(done.stderr, ["scale_too", "scale_to", f"{file}:"])
        text = (self.folder / "suite.yaml").read_text().replace("scale_too: {}", "").replace("hertz_damped", "herz")
        (self.folder / "suite.yaml").write_text(text)
        line = text[: text.index("herz")].count("\n") + 1
        assert_mentions(self.run_command(file, code=2).stderr, [f"suite.yaml:{line}:", "herz"])

    def test_run_and_suite_name_each_other(self):
        file = self.file({"files": "r?.csv"})
        program = os.environ["POUNDING_PROGRAM"]
        for command in ("run", "check", "modes"):
            done = subprocess.run([program, command, file], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            assert_mentions(done.stderr, ["pounding suite", "suite.yaml:"])
        (self.folder / "model.yaml").write_text(pair().to_yaml())
        assert_mentions(self.run_command("model.yaml", code=2).stderr, ["records", "pounding run"])


if __name__ == "__main__":
    unittest.main()
