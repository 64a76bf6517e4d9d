"""A small stress run, a few cases against the independent integrator, and tests that both detect errors."""

import importlib.util
import json
import os
import re
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import stress
import stress_cases
from stress_checks import faults_of
from stress_in_memory import in_processes, package_run
from support import PROGRAM

SEED, CASES, JUDGED = 2015, 60, 6
PACKAGE = os.environ.get("POUNDING_PACKAGE")
WITHOUT_SCIPY = importlib.util.find_spec("scipy") is None

#: Two free bodies that meet at 1 m/s.
MEETING = {
    "family": "free",
    "structures": [
        {"name": "b0", "kind": "body", "mass": 1e5, "velocity": 1.0},
        {"name": "b1", "kind": "body", "mass": 2e5, "velocity": 0.0},
    ],
    "links": [
        {"left": "b0", "right": "b1", "gap": 0.01, "law": "hertz_damped", "stiffness": 2.75e9, "restitution": 0.65}
    ],
    "ground": None,
    "duration": 0.5,
    "tolerance": 1e-5,
}


def run_of(case):
    with tempfile.TemporaryDirectory() as folder:
        run, message = stress.program_run(PROGRAM, case, folder)
    if message:
        raise AssertionError(message)
    return run


class RandomRows(unittest.TestCase):
    def test_end_close_their_energy_and_let_nobody_through(self):
        for number in range(CASES):
            with self.subTest(number=number):
                outcome = stress.examine((PROGRAM, SEED, number, None))
                self.assertEqual(outcome["faults"], [], outcome["text"])

    def test_rub_while_their_members_yield(self):
        for number in range(8):
            with self.subTest(number=number):
                outcome = stress.examine((PROGRAM, SEED, number, "rubbing"))
                self.assertEqual(outcome["faults"], [], outcome["text"])

    def test_cover_every_law_and_every_kind_of_contact(self):
        cases = [stress_cases.case_of(SEED, number) for number in range(2000)]
        self.assertEqual({l["law"] for case in cases for l in case["links"]}, set(stress_cases.LAWS))
        self.assertEqual({case["family"] for case in cases}, {family.__name__ for family in stress_cases.FAMILIES})
        masses = [[s["mass"] for s in case["structures"] if s["kind"] in ("body", "oscillator")] for case in cases]
        masses = [m for m in masses if m]
        self.assertGreater(max(max(m) / min(m) for m in masses), 500)
        for laws in (stress_cases.LINEAR, stress_cases.HERTZ):
            stiffness = [l["stiffness"] for case in cases for l in case["links"] if l["law"] in laws]
            self.assertGreater(max(stiffness) / min(stiffness), 5e5)


def die(_):
    os.kill(os.getpid(), signal.SIGKILL)


class InMemory(unittest.TestCase):
    @unittest.skipUnless(PACKAGE, "the Python package is not built")
    def test_gives_what_the_program_gives(self):
        numbers = range(8)
        inside = {
            outcome["number"]: outcome
            for outcome in in_processes(stress.examine, [(PACKAGE, SEED, number, None) for number in numbers], 1)
        }
        for number in numbers:
            outside = stress.examine((PROGRAM, SEED, number, None))
            for key in ("faults", "impacts", "steps", "imbalance"):
                self.assertEqual(inside[number][key], outside[key], key)

    def test_names_the_cases_of_a_process_that_dies(self):
        with self.assertRaisesRegex(SystemExit, r"died in one of these: \[7, 8\]"):
            list(in_processes(die, [7, 8], 1))


class FoundBefore(unittest.TestCase):
    """Cases that failed in the past, each in a file that describes the fault."""

    def test_go_well(self):
        files = sorted((Path(__file__).parent / "found").glob("*.yaml"))
        self.assertTrue(files)
        for path in files:
            with self.subTest(file=path.name), tempfile.TemporaryDirectory() as folder:
                results = Path(folder) / "out.h5"
                done = subprocess.run(
                    [PROGRAM, "run", path, "-o", results, "--json"], capture_output=True, text=True, timeout=120
                )
                self.assertEqual(done.returncode, 0, done.stderr)
                error = json.loads(done.stdout)["energy"]["error"]
                tolerance = float(re.search(r"tolerance: ([\d.e-]+)", path.read_text())[1])
                self.assertLess(error, tolerance)
                with h5py.File(results) as file:
                    rows = file["impacts"][()]
                    speed = np.max(np.abs(rows["v_approach"]))
                    ended = rows[~np.isnan(rows["t_end"])]
                    self.assertGreaterEqual(np.min(ended["v_separation"], initial=0), -10 * tolerance * speed)
                    for name, link in file["links"].items():
                        if link.attrs["law"] != "kelvin_voigt":  # which pulls as published
                            self.assertGreaterEqual(np.min(link["force"][()], initial=0), 0, name)


#: A light body between two heavy ones that close: it rests in a soft contact that damps it, and bounces on the other
#: side without loss. A separate integrator counts 771 bounces in 40 ms and 8,072 in 50 ms; speeds decrease by a factor
#: of ten every 10 ms.
BOUNCING = {
    "family": "together",
    "structures": [
        {"name": "b0", "kind": "body", "mass": 449409.15861101897, "velocity": 0.2672587213342907},
        {"name": "b1", "kind": "body", "mass": 1116.0869832154517, "velocity": 0.13362936066714534},
        {"name": "b2", "kind": "body", "mass": 10671.19861185025, "velocity": 0.0},
        {"name": "b3", "kind": "body", "mass": 262202.33240461245, "velocity": -0.13362936066714534},
        {"name": "b4", "kind": "body", "mass": 177386.47709842987, "velocity": -0.2672587213342907},
    ],
    "links": [
        {
            "left": "b0",
            "right": "b1",
            "gap": 0.0010004076397688794,
            "law": "viscous_hertz",
            "stiffness": 331049340319.2768,
            "restitution": 0.65,
            "formula": "exact",
        },
        {"left": "b1", "right": "b2", "gap": 0.001, "law": "stereomechanical", "restitution": 1.0},
        {
            "left": "b2",
            "right": "b3",
            "gap": 0.0010009508480790972,
            "law": "kelvin_voigt_no_tension",
            "stiffness": 85092861.38801846,
            "restitution": 0.5,
            "formula": "anagnostopoulos",
        },
        {
            "left": "b3",
            "right": "b4",
            "gap": 0.001,
            "law": "kelvin_voigt",
            "stiffness": 1465709247.4039702,
            "restitution": 0.95,
        },
    ],
    "ground": None,
    "duration": 1.6897612941828948,
    "tolerance": 1e-05,
}


class Located(unittest.TestCase):
    """Events missed by the length of the step that contains them."""

    def impacts_of(self, name, link):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [PROGRAM, "run", Path(__file__).parent / "found" / name, "-q", "-o", Path(folder) / "out.h5"],
                capture_output=True,
                text=True,
                timeout=120,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(Path(folder) / "out.h5") as file:
                rows = file["impacts"][()]
        return rows[rows["link"] == link]

    def test_is_a_spring_that_presses_again_before_the_separation(self):
        self.assertAlmostEqual(self.impacts_of("presses_again.yaml", b"b2-b3")[0]["restitution"], 0.05, delta=1e-4)

    def test_is_a_touch_just_behind_the_start(self):
        rows = self.impacts_of("touch_at_the_start.yaml", b"b1-b2")
        self.assertGreater(np.min(rows["t_end"] - rows["t_start"]), 1e-6)
        self.assertAlmostEqual(rows[0]["t_start"] / (3.676074854011164e-09 / (2 * 0.4628824804193815)), 1, delta=1e-12)


class BouncesWithoutEnd(unittest.TestCase):
    """A rigid contact without loss between bodies that are pressed together."""

    def setUp(self):
        self.addCleanup(setattr, stress, "SECONDS", stress.SECONDS)
        stress.SECONDS = 6

    def test_are_as_many_as_they_are(self):
        run = run_of(BOUNCING | {"duration": 0.04, "tolerance": 1e-7})
        # a bounce faster by a fraction makes the next ones faster as well
        self.assertAlmostEqual(len(run.rows[1]), 771, delta=4)
        self.assertEqual(list(faults_of(run)), [])

    def test_are_judged_up_to_some_thousands(self):
        case = BOUNCING | {"duration": 0.1}
        runs = [run_of(case)]
        if PACKAGE:
            with tempfile.TemporaryDirectory() as folder:
                runs.append(package_run(PACKAGE, case, folder, stress.SECONDS)[0])
        for run in runs:
            self.assertLess(run.case["duration"], 0.06)
            self.assertGreater(run.impacts, 1000)
            self.assertEqual(list(faults_of(run)), [])

    def test_excuse_no_other_run_that_takes_too_long(self):
        touches = np.linspace(0, 1, 3000)
        self.assertAlmostEqual(stress_cases.bounces_of(BOUNCING, touches)["duration"], 2 / 3, delta=1e-3)
        self.assertIsNone(stress_cases.bounces_of(BOUNCING, touches[:1000]))
        losing = [l | {"restitution": 0.95} for l in BOUNCING["links"]]
        self.assertIsNone(stress_cases.bounces_of(BOUNCING | {"links": losing}, touches))
        stress.SECONDS = 1e-3
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(stress.program_run(PROGRAM, MEETING, folder), (None, "it took more than 0.001 s"))

    def test_are_told(self):
        with tempfile.TemporaryDirectory() as folder:
            model = Path(folder) / "model.yaml"
            model.write_text(stress_cases.input_file(BOUNCING | {"duration": 0.052}))
            done = subprocess.run([PROGRAM, "run", model, "-q"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"pounding: warning: link b1-b2: 1\d{4} impacts; .* restitution 1 .*0\.95")


class TheChecks(unittest.TestCase):
    def setUp(self):
        self.run_ = run_of(MEETING)
        self.row, self.history = self.run_.rows[0][0], self.run_.histories[0]

    def finds(self, words):
        self.assertIn(words, "\n".join(faults_of(self.run_)))

    def test_accept_what_is_right(self):
        self.assertEqual(list(faults_of(self.run_)), [])

    def test_find_a_run_that_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            run, message = stress.program_run(PROGRAM, MEETING | {"tolerance": -1}, folder)
        self.assertIsNone(run)
        self.assertIn("exit code 2", message)

    def test_find_an_energy_that_does_not_close(self):
        self.run_.imbalance = 1.1e-4
        self.finds("the energies do not close")

    def test_find_an_impact_that_ends_before_it_begins(self):
        self.run_.rows[0]["t_end"] = self.row["t_start"] - 1e-9
        self.finds("ends before it begins")

    def test_find_a_missed_restitution(self):
        self.run_.rows[0]["restitution"] = 0.651
        self.finds("instead of 0.65")

    def test_find_a_penetration_beyond_the_approach(self):
        self.run_.rows[0]["peak_penetration"] *= 1.5
        self.finds("the approach brought")

    def test_find_a_pull(self):
        self.history["force"][np.argmax(self.history["force"])] *= -1
        self.finds("it pulls")

    def test_find_an_impulse_that_pulls(self):
        self.run_.rows[0]["impulse"] = -2e-9 * self.run_.reduced_mass(self.run_.case["links"][0]) * self.run_.speed
        self.finds("pulls,")

    def test_accept_a_spring_that_follows_the_rounding_of_a_rigid_rest(self):
        """Bodies at rest on each other drift for two seconds: a parallel spring of 1.9e10 N/m pulls with 3e-6 N s due
        to ten round-offs of 0.4 m."""
        case = stress_cases.case_of(44, 33021)
        self.assertEqual(
            [l["law"] for l in case["links"]], ["stereomechanical", "jankowski", "modified_linear_viscoelastic"]
        )
        run = run_of(case)
        self.assertLess(run.rows[2]["impulse"][-1], 0)
        self.assertEqual(list(faults_of(run)), [])

    def test_find_an_overlap_without_an_impact(self):
        self.history["penetration"][0] = 1e-6
        self.finds("outside every impact")

    def test_find_a_lost_impulse(self):
        self.run_.rows[0]["impulse"] *= 0.99
        self.finds("where its links give")

    def test_find_bodies_that_stick(self):
        self.run_.rows[0]["t_end"] = np.nan
        self.finds("across an opening")


@unittest.skipIf(WITHOUT_SCIPY, "scipy is not installed")
class TheIndependentIntegrator(unittest.TestCase):
    def test_agrees_on_random_rows(self):
        judged = number = 0
        while judged < JUDGED:
            _, verdict, text, message = stress.compare_one((PROGRAM, SEED, number))
            number += 1
            if verdict is None and message is None:
                continue  # too long for a test
            judged += 1
            with self.subTest(number=number - 1):
                self.assertIsNone(message, text)
                self.assertNotEqual(verdict.agreed, "no", f"{verdict.why}\n{text}")

    def test_gives_the_published_two_oscillators(self):
        """First impact of two oscillators by hertz_damped: DOP853 confirmed by fixed-step Runge-Kutta at 2e-7 s."""
        from judging import row_of

        oscillators = [
            {"name": "a", "kind": "oscillator", "mass": 1e5, "period": 0.8, "damping": 0.05, "velocity": 0.0},
            {"name": "b", "kind": "oscillator", "mass": 1.5e5, "period": 0.4, "damping": 0.05, "velocity": 0.0},
        ]
        link = {"left": "a", "right": "b", "gap": 0.02, "law": "hertz_damped", "stiffness": 2.75e9, "restitution": 0.65}
        row = row_of(
            {
                "structures": oscillators,
                "links": [link],
                "duration": 3.0,
                "ground": {"kind": "harmonic", "amplitude": 3.0, "period": 0.6, "duration": 3.0},
            }
        )
        row.run(3.0)
        impacts = row.links[0].impacts
        self.assertEqual(len(impacts), 5)
        self.assertAlmostEqual(impacts[0].start, 0.548291, delta=1e-6)
        self.assertAlmostEqual(impacts[0].approach, 0.987919, delta=1e-6)
        self.assertAlmostEqual(impacts[0].peak / 4556463.9, 1, delta=1e-6)
        self.assertAlmostEqual(impacts[0].separation, 0.595075, delta=1e-6)

    def test_gives_the_asked_restitution_by_every_exact_formula(self):
        from independent import Law, free_restitution

        for law in (*stress_cases.LINEAR, *stress_cases.HERTZ):
            if law in ("linear_spring", "hertz"):
                continue
            with self.subTest(law=law):
                found = free_restitution(Law(law, {"restitution": 0.65, "depth": 2e-3}), 2.75e9, 6e4, 0.8)
                self.assertAlmostEqual(found, 0.65, delta=1e-8)

    def test_notices_another_damping_mass_stiffness_and_gap(self):
        from judging import judge

        case = MEETING | {"tolerance": stress.FINE}
        rows = run_of(case).rows
        self.assertEqual(judge(case, rows).agreed, "whole")
        for structure, link in (({}, {"restitution": 0.6501}), ({"mass": 1.001e5}, {}), ({}, {"stiffness": 2.7503e9})):
            other = case | {
                "links": [case["links"][0] | link],
                "structures": [case["structures"][0] | structure, case["structures"][1]],
            }
            with self.subTest(structure=structure, link=link):
                self.assertEqual(judge(other, rows).agreed, "no")
        missed = case | {"links": [case["links"][0] | {"gap": 1.0}]}
        self.assertEqual(judge(missed, rows).agreed, "no")


if __name__ == "__main__":
    unittest.main()
