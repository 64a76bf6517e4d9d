"""`mpirun -n 2 pounding run`: the answers of one process, one message per fault, and no process that waits for another
one forever."""

import json
import os
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

import h5py
import numpy as np
from support import LAUNCHER, MASTS, OSCILLATORS, PROGRAM, SURROUNDINGS, UNSOLVABLE, ProgramTest, is_sealed
from messages import assert_mentions

SPARSE = ("-pounding_ts_pounding_base", "sparse")
#: Longest wait [s]; a run that hangs fails its test.
PATIENCE = 300  # [s]; a loaded machine takes ten times as long
#: Tolerance, relative to the largest value of a quantity.
ROUNDING = 1e-9
#: Quantities that amplify round-off: accelerations of single nodes by the squares of the highest frequencies. At a
#: maximum of a force its slope is zero, so that round-off moves its time by the square root.
AMPLIFIED, AMPLIFIED_ROUNDING = ("nodes/acceleration", "/t_peak"), 1e-7
#: A force below this fraction of the largest one of its kind may be round-off, whose extremes have no defined time.
MEANT = 1e-5

SHORT = OSCILLATORS.replace("duration: 3.0}", "duration: 1.2}").replace(
    "{duration: 1.2}", "{duration: 1.2, output_step: 10 ms}"
)
#: A force instead of ground motion, and a short one on the left oscillator only.
PUSHED = """\
structures:
  left: {oscillator: {mass: 100 t, period: 0.8 s, damping: 5 %}, forces: [{harmonic: {amplitude: 300 kN, period: 0.6 s, duration: 3 s}},
         {pulse: {shape: half_sine, amplitude: 20 MN, duration: 2 ms, start: 0.1 s}}]}
  right: {oscillator: {mass: 150 t, period: 0.4 s, damping: 5 %}}
links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]
analysis: {duration: 1.2, output_step: 10 ms}
"""
ENDLESS = OSCILLATORS.replace("duration: 3.0}", "duration: 100000}").replace(
    "{duration: 100000}", "{duration: 100000, output_step: 10 s}"
)

#: Reduced frames; every process computes the reduction.
REDUCED = """\
ground_motion: {harmonic: {amplitude: 4, period: 0.7, duration: 2}}
structures:
  left: &tower
    frame:
      dimension: 3
      material: {E: 30 GPa}
      grid: {storeys: 6, bays: [2, 1], storey_height: 3.2, bay_width: 6, columns: {rectangle: [0.5, 0.5]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 60 t,
             rigid_floors: false}
      report: {nodes: [6.2.0], members: all}
    damping: 5 %
  right:
    frame:
      dimension: 3
      origin: [12.002, 0]
      material: {E: 30 GPa}
      grid: {storeys: 6, bays: [2, 1], storey_height: 3.2, bay_width: 6, columns: {rectangle: [0.6, 0.6]}, beams: {rectangle: [0.3, 0.6]}, floor_mass: 60 t,
             rigid_floors: false}
    damping: 5 %
links:
  - {between: [left, right], floors: all, points: 2, gap: 2 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6}
analysis: {duration: 1, output_step: 5 ms, tolerance: 0.01, reduction: {links: 2, ground: 8}}
"""


#: Plane frames, the left one with `inside`.
REDUCED_PLANE = """\
ground_motion: {{harmonic: {{amplitude: 6, period: 1, duration: 2}}}}
structures:
  left:
    frame: {{material: {{E: 30 GPa}}, grid: {{storeys: 16, bays: 3, storey_height: 3.2, bay_width: 6, columns: {{rectangle: [0.6, 0.6]}}, beams: {{rectangle: [0.3, 0.6]}},
             floor_mass: 120 t}}{inside}}}
    damping: 5 %
  right:
    frame: {{origin: [18.001], material: {{E: 30 GPa}}, grid: {{storeys: 16, bays: 3, storey_height: 3.2, bay_width: 6, columns: {{rectangle: [0.6, 0.6]}},
             beams: {{rectangle: [0.3, 0.6]}}, floor_mass: 60 t}}}}
    damping: 5 %
links:
  - {{between: [left.16, right.16], gap: 1 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}}
  - {{between: [left.12, right.12], gap: 1 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}}
{devices}
analysis: {{duration: 2.5, output_step: 5 ms, tolerance: 0.03, reduction: {{links: 6, ground: 10}}}}
accept: [tolerance]
"""


def frames(storeys=9, bays="[4, 3]", duration=0.1):
    """A tall frame that hits a low one, under a wave that reaches their feet one after the other, with friction and
    gravity. Nine storeys on twenty columns have 540 degrees of freedom with mass: too many for the modal base."""
    return f"""\
ground_motion:
  components: {{x: {{harmonic: {{amplitude: 3.0, period: 0.2, duration: 1}}}}, y: {{harmonic: {{amplitude: 2.0, period: 0.3, duration: 1}}}}}}
  wave: {{velocity: 300 m/s, direction: x}}
structures:
  tall:
    frame: &frame
      dimension: 3
      material: {{E: 30 GPa, density: 2500 kg/m^3}}
      grid: {{storeys: {storeys}, bays: {bays}, storey_height: 3 m, bay_width: 5 m, rigid_floors: false, floor_mass: 60 t,
             columns: {{rectangle: [0.5 m, 0.5 m]}}, beams: {{rectangle: [0.3 m, 0.5 m]}}}}
      gravity: true
    damping: 5 %
    initial_velocity: 1 m/s
  low:
    frame:
      dimension: 3
      origin: [{5 * int(bays[1]) + 0.005}, 0]
      material: {{E: 30 GPa, density: 2500 kg/m^3}}
      grid: {{storeys: 2, bays: {bays}, storey_height: 3 m, bay_width: 5 m, rigid_floors: false, floor_mass: 60 t,
             columns: {{rectangle: [0.5 m, 0.5 m]}}, beams: {{rectangle: [0.3 m, 0.5 m]}}}}
      gravity: true
    damping: 5 %
links:
  - {{between: [tall, low], floors: level, points: 2, gap: 5 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6, friction: 0.3}}
analysis: {{duration: {duration}, output_step: 5 ms}}
"""


def numbers(path):
    """Every numeric dataset and every number of the summary, except wall-clock times and the checkpoint."""
    found = {}

    def look(name, item):
        if not isinstance(item, h5py.Dataset) or re.search("wall|checkpoint", name):
            return
        for field in item.dtype.names or [None]:
            values = item[field] if field else item[()]
            if np.asarray(values).dtype.kind in "iuf":
                found[f"{name}/{field}" if field else name] = values

    def peaks(name, value):
        if isinstance(value, (dict, list)):
            for key, part in value.items() if isinstance(value, dict) else enumerate(value):
                peaks(f"{name}/{key}", part)
        elif isinstance(value, (int, float)):
            found[name] = np.float64(value)

    with h5py.File(path) as file:
        file.visititems(look)
        summary = json.loads(file["summary"][()])
    del summary["solver"], summary["energy"]["error"]
    peaks("summary", summary)
    return found


def words_of(processes, *words):
    launcher = [LAUNCHER, "-n", str(processes)] if processes > 1 else []
    return [*launcher, PROGRAM, *map(str, words)]


@unittest.skipUnless(LAUNCHER, "mpiexec is missing")
class Processes(ProgramTest):
    def on(self, processes, *words, **more):
        return subprocess.run(
            words_of(processes, *words),
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            env=SURROUNDINGS,
            **({"stdin": subprocess.DEVNULL} | more),
        )

    def done(self, processes, *words):
        result = self.on(processes, "run", *words, "-q")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def messages(self, result):
        """Messages of the program, without those of the launcher."""
        return [line for line in result.stderr.splitlines() if line.startswith("pounding: ")]


class Answers(Processes):
    def agree(self, text, processes, *options, base):
        self.write(text)
        self.done(1, "model.yaml", "-o", "one.h5", *options)
        one = numbers(self.folder / "one.h5")
        self.assertGreater(
            max(np.max(v) for n, v in one.items() if re.fullmatch("links/.*/force", n)), 1e3, "nothing hits"
        )
        for count in processes:
            with self.subTest(processes=count):
                view = self.on(count, "run", "model.yaml", "-o", "several.h5", *options, "-pounding_ts_view")
                self.assertEqual((view.returncode, view.stderr), (0, ""))
                self.assertIn(base[count], view.stdout)
                self.same(one, numbers(self.folder / "several.h5"))

    def same(self, one, several):
        self.assertEqual(list(one), list(several))
        for name, wanted in one.items():
            # Solver work and error estimates differ.
            if name.startswith("solver/") or name == "energy/error" or wanted.size == 0:
                continue
            if "/envelope/" in name:  # numbers of /envelopes, compared relative to the largest of each kind
                continue
            if name.startswith("envelopes/") and name.endswith("_time"):
                self.same_instants(one[name.removesuffix("_time")], wanted, several[name], name)
                continue
            self.assertEqual(wanted.shape, several[name].shape, name)
            # Not a number if an impact has not ended.
            scale = np.max(np.abs(wanted), initial=0, where=~np.isnan(wanted))
            tolerance = AMPLIFIED_ROUNDING if name.endswith(AMPLIFIED) else ROUNDING
            np.testing.assert_allclose(several[name], wanted, rtol=0, atol=tolerance * scale, err_msg=name)

    def same_instants(self, values, wanted, several, name):
        meant = np.abs(values) > MEANT * np.abs(values).max()
        np.testing.assert_allclose(
            several[meant], wanted[meant], rtol=0, atol=AMPLIFIED_ROUNDING * wanted.max(initial=0), err_msg=name
        )

    def test_of_a_small_model_are_those_of_one(self):
        self.agree(SHORT, [2], *SPARSE, base={2: "2 unknowns on 2 processes, each with whole structures"})

    def test_under_forces_are_those_of_one(self):
        self.agree(PUSHED, [2], *SPARSE, base={2: "2 unknowns on 2 processes, each with whole structures"})

    def test_of_frames_too_big_for_modes_are_those_of_one(self):
        self.agree(frames(), [2], base={2: "on 2 processes, each with whole structures"})

    def test_of_frames_that_turn_are_those_of_one(self):
        self.agree(MASTS, [2], *SPARSE, base={2: "on 2 processes, each with whole structures"})


class AnswersOfReducedStructures(Processes):
    def test_have_the_same_bits_on_any_number_of_processes(self):
        self.agree(REDUCED.replace("{links: 2, ground: 8}", "{links: 2, ground: 8, check: true}"))

    def test_with_hinges_have_the_same_bits_on_any_number_of_processes(self):
        self.agree(
            REDUCED_PLANE.format(
                inside=", hinges: {columns: {at: feet, yield_moment: 150 kN m, hardening: 3 %}}", devices=""
            )
        )

    def test_with_devices_have_the_same_bits_on_any_number_of_processes(self):
        self.agree(
            REDUCED_PLANE.format(
                inside=", devices: {brace: {between: ['0.0', '1.1'], bilinear: {stiffness: 200 MN/m, yield_force: 300 kN, hardening: 0.02}}}",
                devices="devices: {top: {between: [left.12, right.12], damper: {coefficient: 400 kN (s/m)^0.35, exponent: 0.35, stiffness: 60 MN/m}}}",
            )
        )

    def test_on_isolators_have_the_same_bits_on_any_number_of_processes(self):
        self.agree(
            REDUCED_PLANE.format(
                inside=", masses: {0.0: 60 t, 0.1: 60 t, 0.2: 60 t, 0.3: 60 t}, supports: {feet: {isolator: {lead_rubber: {strength: 60 kN, yield_displacement: 10 mm, "
                "post_yield_stiffness: 1.5 MN/m}}}}",
                devices="",
            )
        )

    def agree(self, text):
        self.write(text)
        self.done(1, "model.yaml", "-o", "1.h5")
        one = numbers(self.folder / "1.h5")
        self.assertGreater(
            max(np.max(v) for n, v in one.items() if re.fullmatch("links/.*/force", n)), 1e5, "nothing hits"
        )
        self.assertGreater(one["solver/reduction/left/error_force"], 0)
        for processes in 2, 4:
            self.done(processes, "model.yaml", "-o", f"{processes}.h5")
            several = numbers(self.folder / f"{processes}.h5")
            self.assertEqual(list(one), list(several))
            for name, values in one.items():
                np.testing.assert_array_equal(several[name], values, err_msg=f"{name} on {processes} processes")


class AnswersOfMore(Answers):
    """More processes than structures share one factorization. Slow if there are fewer cores than processes."""

    test_of_a_small_model_are_those_of_one = None
    test_under_forces_are_those_of_one = None
    test_of_frames_too_big_for_modes_are_those_of_one = None
    test_of_frames_that_turn_are_those_of_one = None

    def test_than_structures_are_those_of_one(self):
        self.agree(
            frames(2, "[1, 1]", 0.02),
            [3, 4],
            *SPARSE,
            base={3: "on 3 processes, one factor for all, mumps", 4: "on 4 processes, one factor for all, mumps"},
        )


class Voice(Processes):
    def test_is_one(self):
        self.write(SHORT)
        alone, together = (self.on(n, "run", "model.yaml", *SPARSE) for n in (1, 2))
        self.assertEqual((together.returncode, together.stderr), (0, ""))
        without_clock = [re.sub(r"[\d.]+ s$", "", r.stdout, flags=re.M) for r in (alone, together)]
        self.assertEqual(*without_clock)

    def test_tells_one_object(self):
        self.write(SHORT)
        together = self.on(2, "run", "model.yaml", "--json", *SPARSE)
        self.assertEqual(json.loads(together.stdout)["status"], "done")

    def test_shows_view_and_monitor_once(self):
        self.write(SHORT)
        shown = self.on(2, "run", "model.yaml", "-q", *SPARSE, "-pounding_ts_view", "-pounding_ts_monitor")
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        self.assertEqual(shown.stdout.count("TS Object:"), 1)
        # Newer versions of PETSc print the prefix of the options.
        steps = re.findall(r"^(\d+) TS (?:\(pounding_\) )?dt", shown.stdout, re.M)
        self.assertEqual(steps, [str(i) for i in range(len(steps))])
        self.assertGreater(len(steps), 100)

    def test_refuses_wrong_input_once(self):
        self.write(OSCILLATORS.replace("jankowski", "jankowsky"))
        wrong = self.on(2, "run", "model.yaml")
        self.assertEqual((wrong.returncode, wrong.stdout, len(self.messages(wrong))), (2, "", 1), wrong.stderr)
        assert_mentions(wrong.stderr, "jankowski")

    def test_refuses_more_processes_than_unknowns(self):
        self.write(OSCILLATORS)
        wrong = self.on(3, "run", "model.yaml", "-q", *SPARSE)
        self.assertEqual((wrong.returncode, len(self.messages(wrong))), (2, 1))
        assert_mentions(wrong.stderr, ["2", "3", "mpirun -n 2"])

    def test_names_a_package_that_petsc_has_not_got_once(self):
        self.write(frames(storeys=2))
        for count, words in ((1, ["-pounding_lev_pc_factor_mat_solver_type cholmod"]), (3, ["3", "MUMPS"])):
            wrong = self.on(
                count, "run", "model.yaml", "-q", *SPARSE, "-pounding_lev_pc_factor_mat_solver_type", "strumpack"
            )
            self.assertEqual((wrong.returncode, len(self.messages(wrong))), (2, 1))
            assert_mentions(wrong.stderr, ["PETSc", "strumpack", *words])

    def test_tells_of_a_failing_solve_once_with_the_results_kept(self):
        self.write(UNSOLVABLE)
        failed = self.on(2, "run", "model.yaml", "-q", "-o", "out.h5", *SPARSE)
        self.assertEqual((failed.returncode, len(self.messages(failed))), (3, 1), failed.stderr)
        with h5py.File(self.folder / "out.h5") as file:
            assert_mentions(file.attrs["status"], "failed")


class Alone(Processes):
    """Commands that do not benefit from several processes, and would print and write everything twice."""

    def test_are_refused(self):
        self.write(OSCILLATORS)
        for words in (
            ["check", "model.yaml"],
            ["modes", "model.yaml"],
            ["laws"],
            ["record", "info", "none"],
            ["plot", "out.h5"],
            ["calibrate", "--law", "hertz_damped", "--restitution", "0.5", "--m1", "1", "--m2", "1", "--velocity", "1"],
            ["reproduce", "--only", "laws"],
        ):
            with self.subTest(words[0]):
                wrong = self.on(2, *words)
                self.assertEqual(
                    (wrong.returncode, wrong.stdout, self.messages(wrong)),
                    (
                        2,
                        "",
                        [
                            f"pounding: pounding {words[0]} runs in one process, but 2 were started; type it "
                            "without mpirun"
                        ],
                    ),
                )
        self.assertEqual(sorted(each.name for each in self.folder.iterdir()), ["model.yaml"])

    def test_are_fine_on_one_process_of_a_launcher_and_help_on_all(self):
        one = subprocess.run(
            [LAUNCHER, "-n", "1", PROGRAM, "laws"], capture_output=True, text=True, env=SURROUNDINGS, timeout=PATIENCE
        )
        self.assertEqual((one.returncode, one.stderr), (0, ""))
        helped = self.on(2, "laws", "--help")
        self.assertEqual((helped.returncode, helped.stdout.count("Usage")), (0, 1), helped.stderr)


class Ends(Processes):
    def test_at_a_place_that_cannot_be_written(self):
        self.write(ENDLESS)
        wrong = self.on(2, "run", "model.yaml", "-o", "none/out.h5", *SPARSE)
        self.assertEqual((wrong.returncode, len(self.messages(wrong))), (2, 1), wrong.stderr)
        self.assertIn("none", wrong.stderr)

    def test_at_a_place_that_is_lost_meanwhile(self):
        self.write(ENDLESS + "checkpoint: {every: 0.01 s}\n")
        (self.folder / "place").mkdir()
        run = subprocess.Popen(
            words_of(2, "run", "model.yaml", "-q", "-o", "place/out.h5", *SPARSE),
            cwd=self.folder,
            env=SURROUNDINGS,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(run.kill)
        while not (self.folder / "place/out.h5").exists():
            time.sleep(0.002)
        (self.folder / "place").rename(self.folder / "lost")
        _, errors = run.communicate(timeout=PATIENCE)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("place/out.h5", errors)

    def test_when_one_process_is_killed(self):
        self.write(ENDLESS + "checkpoint: {every: 0.01 s}\n")
        run = subprocess.Popen(
            words_of(2, "run", "model.yaml", "-q", "-o", "out.h5", *SPARSE),
            cwd=self.folder,
            env=SURROUNDINGS,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.addCleanup(run.kill)
        while not (self.folder / "out.h5").exists():
            time.sleep(0.002)
        ranks = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        os.kill(int(ranks[-1]), signal.SIGKILL)
        self.assertNotEqual(run.wait(PATIENCE), 0)
        self.assertTrue(is_sealed(self.folder / "out.h5"))

    def test_when_one_process_fails_alone(self):
        """The launcher gives its standard input to the first process only."""
        self.write(SHORT)
        with open(self.folder / "model.yaml") as model:
            alone = self.on(2, "run", "/dev/stdin", "-q", stdin=model)
        self.assertEqual(alone.returncode, 2, alone.stderr)
        assert_mentions(alone.stderr, ["pounding", "2"])

    def test_when_processes_read_different_models(self):
        for number in (0, 1):
            (self.folder / str(number)).mkdir()
            self.write(SHORT.replace("20 mm", f"2{number} mm"), f"{number}/model.yaml")
        words = [LAUNCHER]
        for number in (0, 1):
            words += [":"] * number + [
                "-n",
                "1",
                "-wdir",
                str(self.folder / str(number)),
                PROGRAM,
                "run",
                "model.yaml",
                "-q",
            ]
        differ = subprocess.run(words, env=SURROUNDINGS, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual((differ.returncode, len(self.messages(differ))), (2, 1), differ.stderr)
        self.assertRegex(self.messages(differ)[0], "model.yaml: .*different models")

    def test_when_processes_read_different_records(self):
        """Oscillators would respond to the record of the first process, and frames would wait for each other."""
        for model, record in (
            (SHORT, "harmonic: {amplitude: 3.0, period: 0.6, duration: 1.2}"),
            (frames(), "components: {x: {harmonic: {amplitude: 3.0, period: 0.2, duration: 1}}"),
        ):
            self.assertIn(record, model)
            own = "record: record.txt, units: m/s^2"
            text = model.replace(record, own if record.startswith("harmonic") else f"components: {{x: {{{own}}}")
            for number in (0, 1):
                (self.folder / str(number)).mkdir(exist_ok=True)
                self.write(text, f"{number}/model.yaml")
                self.write(f"0 0\n0.1 {3 + 1e-9 * number}\n1 0\n", f"{number}/record.txt")
            words = [LAUNCHER]
            for number in (0, 1):
                words += [":"] * number + [
                    "-n",
                    "1",
                    "-wdir",
                    str(self.folder / str(number)),
                    PROGRAM,
                    "run",
                    "model.yaml",
                    "-q",
                ]
            with self.subTest(record=record):
                differ = subprocess.run(words, env=SURROUNDINGS, capture_output=True, text=True, timeout=PATIENCE)
                errors = [line for line in self.messages(differ) if not line.startswith("pounding: warning: ")]
                self.assertEqual((differ.returncode, len(errors)), (2, 1), differ.stderr)
                assert_mentions(errors[0], ["model.yaml:"])


class Stopped(Processes):
    #: Long enough to receive a signal.
    MODEL = OSCILLATORS.replace("duration: 3.0}", "duration: 1000}").replace(
        "{duration: 1000}", "{duration: 1000, output_step: 1 s}"
    )

    def stop(self, number, *words):
        """Sends the launcher a stop signal once the run has begun to step."""
        path = self.folder / "out.h5"
        path.unlink(missing_ok=True)
        run = subprocess.Popen(
            words_of(2, "run", *words, "-q"),
            cwd=self.folder,
            env=SURROUNDINGS,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(run.kill)
        while not path.exists() or self.reached(path) == 0:
            self.assertIsNone(run.poll(), "the run ended before it was stopped")
            time.sleep(0.002)
        run.send_signal(number)
        _, errors = run.communicate(timeout=PATIENCE)
        self.assertNotEqual(run.returncode, 0)
        return errors

    def reached(self, path):
        with h5py.File(path) as file:
            return file["time"][-1]

    def test_by_a_signal_goes_on_to_the_same_bits(self):
        self.write(self.MODEL + "checkpoint: {every: 0.05 s}\n")
        self.done(2, "model.yaml", "-o", "whole.h5", *SPARSE)
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                # On a loaded machine a run may end before the signal arrives.
                for _ in range(5):
                    self.stop(number, "model.yaml", "-o", "out.h5", *SPARSE)
                    with h5py.File(self.folder / "out.h5") as file:
                        status = file.attrs["status"]
                    if status != "done":
                        break
                assert_mentions(status, "failed")
                self.done(2, "--resume", "out.h5")
                whole, resumed = (numbers(self.folder / name) for name in ("whole.h5", "out.h5"))
                self.assertEqual(list(whole), list(resumed))
                for name, values in whole.items():
                    self.assertEqual(values.tobytes(), resumed[name].tobytes(), name)

    def test_by_a_limit_is_refused_on_another_number_of_processes(self):
        self.write(OSCILLATORS)
        for count, other, typed in (
            (2, 1, "mpirun -n 2 pounding run --resume out.h5"),
            (1, 2, "pounding run --resume out.h5"),
        ):
            cut = self.on(count, "run", "model.yaml", "-q", "-o", "out.h5", "-pounding_ts_max_steps", 200, *SPARSE)
            self.assertEqual(cut.returncode, 3, cut.stderr)
            assert_mentions(cut.stderr, f"{typed}")
            before = (self.folder / "out.h5").read_bytes()
            refused = self.on(other, "run", "--resume", "out.h5", "-q")
            self.assertEqual((refused.returncode, len(self.messages(refused))), (2, 1), refused.stderr)
            assert_mentions(refused.stderr, f"{typed}")
            self.assertEqual((self.folder / "out.h5").read_bytes(), before)


class StoppedBetweenLongSteps(Processes):
    def test_within_the_second_that_the_launcher_grants(self):
        """Some milliseconds per step, so that a few hundred steps take longer than that."""
        self.write(frames(20, "[5, 5]", 10))
        path = self.folder / "out.h5"
        run = subprocess.Popen(
            words_of(2, "run", "model.yaml", "-q", "-o", "out.h5"),
            cwd=self.folder,
            env=SURROUNDINGS,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(run.kill)
        while not path.exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        time.sleep(5)
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=PATIENCE)
        with h5py.File(path) as file:
            assert_mentions(file.attrs["status"], "failed")


if __name__ == "__main__":
    unittest.main()
