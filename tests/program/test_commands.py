"""Exit codes, standard output and standard error, and the output of each command."""

import json
import math
import os
import pty
import subprocess
import unittest

import h5py
from support import LONG, OSCILLATORS, PROGRAM, UNSOLVABLE, ProgramTest
from messages import assert_mentions

SUMMARY_KEYS = ["status", "links", "impacts", "structures", "energy", "solver", "model", "warnings"]
LINK_KEYS = [
    "name",
    "impacts",
    "peak_force",
    "peak_penetration",
    "impulse",
    "energy_lost",
    "energy_stored",
    "presses",
    "largest_opening",
    "t_opening",
    "seat",
    "unseated",
]
STRUCTURE_KEYS = ["peak_displacement", "peak_drift", "peak_acceleration", "envelope"]
ENERGY_KEYS = ["input", "kinetic", "strain", "damping", "hysteretic", "impact", "error"]
SOLVER_KEYS = ["integrator", "tolerance", "duration", "steps", "rejected", "events", "wall_seconds"]


class ExitCodes(ProgramTest):
    def test_zero_for_a_run_that_is_done(self):
        done = self.pounding("run", self.write(OSCILLATORS))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("left-right", done.stdout)

    def test_zero_without_a_word_where_sys_is_missing(self):
        empty = self.folder / "root"
        empty.mkdir()
        done = self.pounding("run", self.write(OSCILLATORS), "-q", HWLOC_FSROOT=str(empty))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_two_for_bad_input(self):
        self.write(OSCILLATORS.replace("jankowski", "jankovski"))
        for command in ("run", "check", "modes"):
            with self.subTest(command=command):
                self.refused(2, ["model.yaml:7:47", "links[0].law", "jankovski", "jankowski"], command, "model.yaml")

    def test_two_for_a_model_that_cannot_be_read(self):
        self.refused(2, "none.yaml", "run", "none.yaml")
        self.refused(2, "YAML", "run", ".")

    def test_two_for_words_that_are_none_of_ours(self):
        self.refused(2, "pounding")
        self.refused(2, "walk", "walk")
        self.refused(2, ["chek", "check"], "chek", "model.yaml")
        self.refused(2, ["Plot", "plot"], "Plot")
        self.refused(2, ["record spectra", "spectrum"], "record", "spectra", "FILE")
        self.refused(2, ["model.yaml", "pounding run"], "model.yaml")
        self.refused(2, "MODEL", "run")
        self.refused(2, "--jsom", "run", self.write(OSCILLATORS), "--jsom")
        self.refused(2, "second.yaml", "check", "model.yaml", "second.yaml")

    def test_two_for_counts_and_factors_that_are_not_positive(self):
        model = self.write(OSCILLATORS)
        for verb, option, value in (
            ("modes", "--count", "0"),
            ("modes", "--count", "x"),
            ("sensitivity", "--factors", "-2"),
        ):
            self.refused(2, [f"{option}", f"{value}"], verb, model, option, value)

    def test_three_for_a_solve_that_fails_with_the_reason_in_the_file(self):
        done = self.pounding("run", self.write(UNSOLVABLE), "--json", "-o", "out.h5")
        self.assertEqual(done.returncode, 3)
        assert_mentions(done.stderr, ["pounding", "0.01 s"])
        assert_mentions(json.loads(done.stdout)["status"], ["failed", "0.01 s"])
        with h5py.File(self.folder / "out.h5") as file:
            assert_mentions(file.attrs["status"], ["failed", "0.01 s"])
            self.assertAlmostEqual(file["time"][-1], 0.01, places=3)

    def test_two_when_the_output_cannot_be_written(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                [PROGRAM, "run", self.write(OSCILLATORS), "--json"],
                cwd=self.folder,
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
                timeout=60,
            )
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1))

    def test_version_and_help(self):
        self.assertRegex(self.pounding("--version").stdout, r"^pounding \d+\.\d+\.\d+\n$")
        for words in (["--help"], ["run", "--help"]):
            done = self.pounding(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("-pounding_ts_rtol", done.stdout)


class Json(ProgramTest):
    def test_is_one_object_with_the_promised_keys(self):
        done = self.pounding("run", self.write(OSCILLATORS), "--json")
        self.assertEqual(done.stdout.count("\n"), 1)
        summary = json.loads(done.stdout)
        self.assertEqual(list(summary), SUMMARY_KEYS)
        self.assertEqual(summary["status"], "done")
        self.assertEqual([list(link) for link in summary["links"]], [LINK_KEYS])
        self.assertEqual(list(summary["structures"]), ["left", "right"])
        for structure in summary["structures"].values():
            self.assertEqual(list(structure), STRUCTURE_KEYS)
            self.assertEqual([len(structure[key]) for key in STRUCTURE_KEYS[:3]], [1, 1, 1])
        self.assertEqual(list(summary["energy"]), ENERGY_KEYS)
        self.assertEqual(list(summary["solver"]), SOLVER_KEYS)

    def test_balances_its_energies(self):
        energy = self.summary(self.write(OSCILLATORS))["energy"]
        parts = sum(energy[key] for key in ("kinetic", "strain", "damping", "hysteretic", "impact"))
        self.assertLess(abs(energy["input"] - parts), 1e-4 * energy["input"])
        self.assertLess(energy["error"], 1e-4)

    def test_names_links_in_the_order_of_the_input(self):
        self.write("""\
structures:
  b: {shear_building: {storeys: 2, mass: 100 t, stiffness: 100 MN/m}, damping: 5 %}
  a: {shear_building: {storeys: 3, mass: 100 t, stiffness: 100 MN/m}, damping: 5 %}
  w: {wall: {}}
links:
  - {between: [a, w], floors: all, gap: 1 m, law: hertz, stiffness: 1e9}
  - {between: [b, a], floors: all, gap: 1 m, law: hertz, stiffness: 1e9}
analysis: {duration: 0.1}
accept: [motion]
""")
        names = [link["name"] for link in self.summary("model.yaml")["links"]]
        self.assertEqual(names, ["a.1-w", "a.2-w", "a.3-w", "b.1-a.1", "b.2-a.2"])

    def test_has_null_where_a_rigid_impact_has_no_force(self):
        self.write(OSCILLATORS.replace("law: jankowski, stiffness: 2.75e9", "law: stereomechanical"))
        link = self.summary("model.yaml")["links"][0]
        self.assertIsNone(link["peak_force"])
        self.assertGreater(link["impacts"], 0)

    def test_compares_with_the_same_structures_apart(self):
        alone = self.summary(self.write(OSCILLATORS[: OSCILLATORS.index("links:")] + "analysis: {duration: 3.0}\n"))
        summary = self.summary(self.write(OSCILLATORS + "compare: no_pounding\n"))
        self.assertEqual(list(summary), SUMMARY_KEYS[:-2] + ["no_pounding", "comparison", "model", "warnings"])
        for name, structure in alone["structures"].items():
            without = summary["no_pounding"]["structures"][name]["peak_displacement"][0]
            self.assertTrue(math.isclose(without, structure["peak_displacement"][0], rel_tol=1e-3))
            self.assertEqual(
                summary["no_pounding"]["amplification"][name],
                [summary["structures"][name]["peak_displacement"][0] / without],
            )

    def test_is_the_same_bit_by_bit_when_repeated(self):
        self.write(OSCILLATORS)
        first, second = self.summary("model.yaml"), self.summary("model.yaml")
        for summary in (first, second):
            del summary["solver"]["wall_seconds"]
        self.assertEqual(json.dumps(first), json.dumps(second))


class Words(ProgramTest):
    def test_quiet_says_nothing(self):
        done = self.pounding("run", self.write(OSCILLATORS), "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_report_says_which_mass_calibrates_the_damping(self):
        assert_mentions(self.pounding("run", self.write(OSCILLATORS)).stdout, "60 t")
        given = OSCILLATORS.replace("restitution: 0.65", "restitution: 0.65, reduced_mass: 50 t")
        assert_mentions(self.pounding("run", self.write(given)).stdout, "50 t")

    def test_progress_is_for_a_terminal_only(self):
        self.write(
            OSCILLATORS.replace("duration: 3.0}\n", "duration: 3.0, tolerance: 1e-8, integrator: generalized_alpha}\n")
        )
        self.assertEqual(self.pounding("run", "model.yaml").stderr, "")
        master, terminal = pty.openpty()
        self.addCleanup(os.close, master)
        done = subprocess.run(
            [PROGRAM, "run", "model.yaml", "--json"],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=terminal,
            timeout=60,
        )
        os.close(terminal)
        shown = os.read(master, 100000).decode()
        self.assertRegex(shown, r"\r\[#+\.*\] \d\.\d\d of 3\.00 s, \d")
        self.assertTrue(shown.endswith("\r\x1b[K"), "the line is cleared in the end")
        json.loads(done.stdout)

    def test_quiet_shows_no_progress_on_a_terminal_either(self):
        self.write(
            OSCILLATORS.replace("duration: 3.0}\n", "duration: 3.0, tolerance: 1e-8, integrator: generalized_alpha}\n")
        )
        master, terminal = pty.openpty()
        self.addCleanup(os.close, master)
        subprocess.run([PROGRAM, "run", "model.yaml", "-q"], cwd=self.folder, stderr=terminal, timeout=60)
        os.set_blocking(master, False)
        self.addCleanup(os.close, terminal)
        self.assertRaises(BlockingIOError, os.read, master, 1)


class Warnings(ProgramTest):
    DOUBTFUL = OSCILLATORS.replace("gap: 20 mm", "gap: 20").replace(
        "duration: 3.0}\n", "duration: 3.0, tolerance: 0.05}\n"
    )
    FACTS = [
        ["link left-right:", "20 m", "2 m", "20 mm", "origins", "accept: [gap]"],
        ["analysis:", "0.05", "5 %", "1e-4", "accept: [tolerance]"],
    ]

    def test_are_told_by_run_and_check(self):
        self.write(self.DOUBTFUL)
        for command in ("run", "check"):
            done = self.pounding(command, "model.yaml", "--json")
            warnings = json.loads(done.stdout)["warnings"]
            self.assertEqual(len(warnings), len(self.FACTS))
            for text, facts in zip(warnings, self.FACTS):
                assert_mentions(text, facts)
            self.assertEqual(done.stderr, "".join(f"pounding: warning: {text}\n" for text in warnings))
            self.assertEqual(self.pounding(command, "model.yaml").stderr, done.stderr)

    def test_are_silenced_by_name(self):
        self.write(self.DOUBTFUL + "accept: [gap]\n")
        [warning] = self.pounding("check", "model.yaml").stderr.splitlines()
        assert_mentions(warning, self.FACTS[1])
        self.write(self.DOUBTFUL + "accept: [gap, tolerance]\n")
        self.assertEqual(self.summary("model.yaml")["warnings"], [])

    def test_structures_have_a_line_each(self):
        for command in ("run", "check"):
            assert_mentions(self.pounding(command, self.write(OSCILLATORS)).stdout, ["100 t", "0.8 s", "left"])


class Check(ProgramTest):
    def test_resolved_prints_yaml_with_every_default(self):
        done = self.pounding("check", self.write(OSCILLATORS), "--resolved")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.splitlines()[0].split(":")[0], "title")
        for line in ("formula: exact", "reduced_mass: 60000", "integrator: esdirk4", "between: [left.1, right.1]"):
            self.assertIn(line, done.stdout)
        self.assertNotIn("integrator: esdirk4", self.pounding("check", "model.yaml").stdout)
        self.refused(2, ["--json", "--resolved"], "check", "model.yaml", "--json", "--resolved")

    def test_says_ok_in_json(self):
        done = self.pounding("check", self.write(LONG), "--json")
        self.assertEqual(
            json.loads(done.stdout), {"status": "ok", "structures": 2, "links": 1, "devices": 0, "warnings": []}
        )

    def test_writes_nothing(self):
        self.pounding("check", self.write(LONG))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["model.yaml"])


class Modes(ProgramTest):
    def test_of_a_shear_building_are_those_of_the_closed_form(self):
        self.write(
            "structures: {a: {shear_building: {storeys: 3, mass: 250 t, stiffness: 220 MN/m}, damping: 5 %}}\n"
            "analysis: {duration: 1}\n"
        )
        modes = json.loads(self.pounding("modes", "model.yaml", "--json").stdout)["a"]
        for j, mode in enumerate(modes, 1):
            w = 2 * math.sqrt(220e6 / 250e3) * math.sin((2 * j - 1) * math.pi / 14)
            self.assertAlmostEqual(mode["period"], 2 * math.pi / w, places=12)
        self.assertAlmostEqual(modes[1]["damping_ratio"], 0.05, places=12)
        self.assertAlmostEqual(sum(mode["effective_mass"] for mode in modes), 750e3, places=4)
        table = self.pounding("modes", "model.yaml").stdout
        self.assertIn(f"{modes[0]['period']:.6f}", table)
        assert_mentions(table, ["100.000 %", "750 t"])


if __name__ == "__main__":
    unittest.main()
