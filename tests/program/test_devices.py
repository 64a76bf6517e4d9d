"""Bars and dampers between two structures: closed forms, an independent integration, energies, files, processes."""

import importlib.util
import json
import math
import subprocess
import unittest

import h5py
import numpy as np

from support import LAUNCHER, PROGRAM, SURROUNDINGS, ProgramTest
from messages import assert_mentions

WITHOUT_SCIPY = importlib.util.find_spec("scipy") is None
MASSES, PERIODS = (1e5, 1.5e5), (0.8, 0.4)
STIFFNESSES = [m * (2 * math.pi / t) ** 2 for m, t in zip(MASSES, PERIODS)]
AMPLITUDE, PERIOD = 3.0, 0.6
BAR, DAMPER = 5e6, 2e5
SECOND_ORDER = "integrator: generalized_alpha, spectral_radius: "


def oscillators(
    device, more="", tolerance=1e-7, duration=3, damping="5 %", analysis="", motion=None, velocities=("0", "0")
):
    motion = (
        f"ground_motion: {{harmonic: {{amplitude: {AMPLITUDE}, period: {PERIOD}, duration: 10}}}}"
        if motion is None
        else motion
    )
    return f"""\
{motion}
structures:
  left:  {{oscillator: {{mass: 100 t, period: {PERIODS[0]}, damping: {damping}}}, initial_velocity: {velocities[0]}}}
  right: {{oscillator: {{mass: 150 t, period: {PERIODS[1]}, damping: {damping}}}, initial_velocity: {velocities[1]}}}
devices: {{tie: {{between: [left, right], {device}}}}}
{more}
analysis: {{duration: {duration}, tolerance: {tolerance}, output_step: 10 ms{analysis}}}
"""


def linear(times, bar=0.0, damper=0.0, ratio=0.05, velocities=(0.0, 0.0), amplitude=AMPLITUDE):
    """Displacements and velocities [time, 2] of the coupled oscillators: complex modes for the free vibration plus the
    steady state under a sine."""
    m = np.diag(MASSES)
    join = np.array([[1.0, -1.0], [-1.0, 1.0]])
    k = np.diag(STIFFNESSES) + bar * join
    c = np.diag([2 * ratio * math.sqrt(a * b) for a, b in zip(MASSES, STIFFNESSES)]) + damper * join
    a = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]])
    w = 2 * math.pi / PERIOD
    load = -amplitude * np.array(MASSES)
    steady = np.linalg.solve(k - w**2 * m + 1j * w * c, load)  # of exp(i w t); the sine is its imaginary part
    start = np.concatenate([np.zeros(2), velocities]) - np.concatenate([steady.imag, (1j * w * steady).imag])
    values, vectors = np.linalg.eig(a)
    weights = np.linalg.solve(vectors, start.astype(complex))
    free = (vectors @ (weights[:, None] * np.exp(values[:, None] * times))).real.T
    forced = np.concatenate(
        [
            np.imag(steady[None, :] * np.exp(1j * w * times)[:, None]),
            np.imag(1j * w * steady[None, :] * np.exp(1j * w * times)[:, None]),
        ],
        axis=1,
    )
    return free + forced


class Devices(ProgramTest):
    def results(self, model, *words, name="out.h5"):
        """Summary and results file of a run without warnings."""
        self.write(model)
        done = self.pounding("run", "model.yaml", "--json", "-o", name, *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout), self.folder / name

    def motions(self, path):
        with h5py.File(path) as file:
            u = np.hstack([file["structures"][name]["displacement"][:, :, 0] for name in ("left", "right")])
            v = np.hstack([file["structures"][name]["velocity"][:, :, 0] for name in ("left", "right")])
            return file["time"][:], u, v, file["devices/tie/elongation"][:], file["devices/tie/force"][:]

    def near(self, values, expected, part):
        worst = np.abs(np.asarray(values) - expected).max() / np.abs(expected).max()
        self.assertLess(worst, part)

    def test_couple_oscillators_as_complex_modes_have_them(self):
        for device, bar, damper in (
            (f"bar: {{stiffness: {BAR}}}", BAR, 0.0),
            (f"damper: {{coefficient: {DAMPER}}}", 0.0, DAMPER),
            (f"bar: {{stiffness: {BAR}}}, damper: {{coefficient: {DAMPER}}}", BAR, DAMPER),
        ):
            for scheme, part in (("", 2e-6), (", " + SECOND_ORDER + "1", 1e-5)):
                with self.subTest(device=device, scheme=scheme):
                    summary, path = self.results(oscillators(device, analysis=scheme))
                    t, u, v, elongation, force = self.motions(path)
                    exact = linear(t, bar, damper)
                    self.near(u, exact[:, :2], part)
                    self.near(v, exact[:, 2:], part)
                    stretch, rate = exact[:, 1] - exact[:, 0], exact[:, 3] - exact[:, 2]
                    self.near(elongation, stretch, part)
                    self.near(force, bar * stretch + damper * rate, 2 * part)
                    self.assertLess(summary["energy"]["error"], 1e-5)
                    fine = np.arange(0, 3, 1e-4)
                    exact = linear(fine, bar, damper)
                    pull = bar * (exact[:, 1] - exact[:, 0]) + damper * (exact[:, 3] - exact[:, 2])
                    told = summary["devices"][0]["force"]
                    self.assertAlmostEqual(told["max"] / pull.max(), 1, delta=2e-5)
                    self.assertAlmostEqual(told["min"] / pull.min(), 1, delta=2e-5)
                    self.assertAlmostEqual(told["t_max"], fine[pull.argmax()], delta=1e-3)
                    lost = np.sum(damper * (exact[:, 3] - exact[:, 2]) ** 2) * 1e-4
                    self.assertAlmostEqual(summary["devices"][0]["energy_lost"], lost, delta=1e-3 * max(lost, 1))
                    self.assertEqual(summary["devices"][0]["energy_lost"], summary["energy"]["devices"])

    def test_free_motion_begins_with_the_force_of_the_damper_and_keeps_energy(self):
        model = oscillators(
            f"bar: {{stiffness: {BAR}}}, damper: {{coefficient: {DAMPER}}}",
            motion="",
            damping=0,
            velocities=("0.5 m/s", "-0.2 m/s"),
        )
        summary, path = self.results(model)
        t, u, v, _, force = self.motions(path)
        exact = linear(t, BAR, DAMPER, 0, (0.5, -0.2), 0.0)
        self.near(u, exact[:, :2], 2e-6)
        self.assertAlmostEqual(force[0] / (-0.7 * DAMPER), 1, delta=1e-12)
        energy = summary["energy"]
        self.assertAlmostEqual(energy["input"], 0.5 * (MASSES[0] * 0.25 + MASSES[1] * 0.04), delta=1e-6)
        rest = energy["kinetic"] + energy["strain"] + energy["devices"]
        self.assertAlmostEqual(rest / energy["input"], 1, delta=1e-6)

    def test_a_bar_that_is_stretched_at_the_start_stores_energy(self):
        model = oscillators(f"bar: {{stiffness: {BAR}}}", motion="", damping=0)
        model = model.replace("initial_velocity: 0}", "initial_displacement: 20 mm}", 1)
        summary, _ = self.results(model)
        self.assertAlmostEqual(summary["energy"]["input"] / (0.5 * (STIFFNESSES[0] + BAR) * 4e-4), 1, delta=1e-9)
        self.assertAlmostEqual(summary["devices"][0]["elongation"]["min"], -0.02, delta=1e-3)
        self.assertLess(summary["energy"]["error"], 1e-5)

    def test_a_stiff_bar_makes_the_oscillators_one(self):
        mass, stiffness = sum(MASSES), sum(STIFFNESSES)
        period = 2 * math.pi * math.sqrt(mass / stiffness)
        one = f"""\
ground_motion: {{harmonic: {{amplitude: {AMPLITUDE}, period: {PERIOD}, duration: 10}}}}
structures: {{one: {{oscillator: {{mass: {mass}, period: {period:.15g}}}, damping: 0}}}}
analysis: {{duration: 3, tolerance: 1e-7, output_step: 10 ms}}
"""
        alone, path = self.results(one, name="one.h5")
        with h5py.File(path) as file:
            expected = file["structures/one/displacement"][:, 0, 0]
        for stiffness in (1e10, 1e12, 1e14):
            with self.subTest(stiffness=stiffness):
                part = 3e7 / stiffness + 2e-6  # the bar deforms by force over stiffness; the run has its tolerance
                summary, path = self.results(oscillators(f"bar: {{stiffness: {stiffness}}}", damping=0))
                _, u, _, _, _ = self.motions(path)
                self.near(u[:, 0], expected, part)
                self.near(u[:, 1], expected, part)
                self.assertLess(summary["solver"]["steps"], 20 * alone["solver"]["steps"])

    @unittest.skipIf(WITHOUT_SCIPY, "needs scipy")
    def test_power_dampers_as_the_second_integrator_has_them(self):
        from scipy.integrate import solve_ivp

        for exponent, rounding in ((0.05, 1e-3), (0.1, 1e-3), (0.35, 1e-3), (0.5, 5e-3), (1.5, 1e-3), (2, 1e-3)):
            with self.subTest(exponent=exponent):
                words = f"coefficient: 200 kN (s/m)^{exponent}, exponent: {exponent}, rounding_velocity: {rounding}"
                summary, path = self.results(oscillators(f"damper: {{{words}}}", tolerance=1e-8))
                t, u, _, _, force = self.motions(path)
                w = [math.sqrt(k / m) for k, m in zip(STIFFNESSES, MASSES)]

                def pull(rate):
                    return 2e5 * rate * (rate * rate + rounding**2) ** (0.5 * (exponent - 1))

                def motion(time, x):
                    ground = AMPLITUDE * math.sin(2 * math.pi / PERIOD * time)
                    f = pull(x[3] - x[2])
                    return [
                        x[2],
                        x[3],
                        -ground - w[0] ** 2 * x[0] - 0.1 * w[0] * x[2] + f / MASSES[0],
                        -ground - w[1] ** 2 * x[1] - 0.1 * w[1] * x[3] - f / MASSES[1],
                    ]

                exact = solve_ivp(motion, (0, 3), np.zeros(4), "DOP853", t, rtol=1e-11, atol=1e-13, max_step=1e-3).y.T
                self.near(u, exact[:, :2], 2e-6)
                self.near(force, pull(exact[:, 3] - exact[:, 2]), 2e-5)
                self.assertLess(summary["energy"]["error"], 1e-6)

    @unittest.skipIf(WITHOUT_SCIPY, "needs scipy")
    def test_power_dampers_with_a_brace_as_a_stiff_integrator_has_them(self):
        # The stretch s of the brace is an unknown: ds/dt = v - (k |s|/c)^(1/a) sign s.
        from scipy.integrate import solve_ivp

        brace, w = 4e7, [math.sqrt(k / m) for k, m in zip(STIFFNESSES, MASSES)]
        for exponent in (0.05, 0.1, 0.5, 1.5, 2):
            with self.subTest(exponent=exponent):
                words = f"coefficient: 200 kN (s/m)^{exponent}, exponent: {exponent}, stiffness: {brace}"
                summary, path = self.results(oscillators(f"damper: {{{words}}}", tolerance=1e-8))
                t, u, _, _, force = self.motions(path)

                def motion(time, x):
                    ground = AMPLITUDE * math.sin(2 * math.pi / PERIOD * time)
                    f, slips = brace * x[4], math.copysign((brace * abs(x[4]) / 2e5) ** (1 / exponent), x[4])
                    return [
                        x[2],
                        x[3],
                        -ground - w[0] ** 2 * x[0] - 0.1 * w[0] * x[2] + f / MASSES[0],
                        -ground - w[1] ** 2 * x[1] - 0.1 * w[1] * x[3] - f / MASSES[1],
                        x[3] - x[2] - slips,
                    ]

                exact = solve_ivp(motion, (0, 3), np.zeros(5), "Radau", t, rtol=1e-9, atol=1e-13, max_step=5e-3).y.T
                self.near(u, exact[:, :2], 1e-5)
                self.near(force, brace * exact[:, 4], 1e-4)
                self.assertLess(summary["energy"]["error"], 1e-5)
                # At rest the rate of a square-law dashpot has an infinite slope: about 21,200 steps at this tolerance.
                self.assertLess(summary["solver"]["steps"], 30000)

    def test_keep_the_order_of_the_schemes(self):
        for scheme, order in (("", 4), (", " + SECOND_ORDER + "1", 2), (", " + SECOND_ORDER + "0.8", 2)):
            with self.subTest(scheme=scheme):
                errors = []
                for step in (0.02, 0.01, 0.005):
                    device = f"bar: {{stiffness: {BAR}}}, damper: {{coefficient: {DAMPER}}}"
                    self.write(oscillators(device, analysis=scheme))
                    done = self.pounding(
                        "run",
                        "model.yaml",
                        "-q",
                        "-o",
                        "out.h5",
                        "-pounding_ts_adapt_type",
                        "none",
                        "-pounding_ts_dt",
                        step,
                    )
                    self.assertEqual(done.returncode, 0, done.stderr)
                    t, u, _, _, _ = self.motions(self.folder / "out.h5")
                    errors.append(np.abs(u - linear(t, BAR, DAMPER)[:, :2])[::2].max())
                self.assertGreater(math.log2(errors[0] / errors[2]) / 2, order - 0.35)

    def test_act_beside_a_pounding_link_of_these_floors(self):
        link = "links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]\ncompare: no_pounding"
        summary, path = self.results(oscillators("damper: {coefficient: 20 kN s/m}", more=link, tolerance=1e-5))
        self.assertGreater(summary["links"][0]["impacts"], 0)
        self.assertLess(summary["energy"]["error"], 1e-3)
        with h5py.File(path) as file:
            exact = linear(file["time"][:], 0, 2e4)
            alone = np.hstack(
                [file["no_pounding/structures"][name]["displacement"][:, :, 0] for name in ("left", "right")]
            )
            self.near(alone, exact[:, :2], 2e-4)
            self.assertIn("tie", file["no_pounding/devices"])
        strong, _ = self.results(
            oscillators("damper: {coefficient: 20 MN s/m}", more=link, tolerance=1e-5), name="strong.h5"
        )
        self.assertEqual(strong["links"][0]["impacts"], 0)

    def test_join_a_structure_and_a_wall(self):
        model = f"""\
ground_motion: {{harmonic: {{amplitude: {AMPLITUDE}, period: {PERIOD}, duration: 10}}}}
structures:
  left: {{oscillator: {{mass: 100 t, period: 0.8, damping: 0}}}}
  right: {{wall: {{}}}}
devices: {{tie: {{between: [left, right], bar: {{stiffness: {BAR}}}}}}}
analysis: {{duration: 3, tolerance: 1e-7, output_step: 10 ms}}
"""
        _, path = self.results(model)
        period = 2 * math.pi * math.sqrt(MASSES[0] / (STIFFNESSES[0] + BAR))
        alone = (
            model.replace("period: 0.8", f"period: {period:.15g}").split("devices:")[0]
            + model[model.index("analysis:") :]
        )
        _, other = self.results(alone, name="other.h5")
        with h5py.File(path) as coupled, h5py.File(other) as single:
            u = coupled["structures/left/displacement"][:, 0, 0]
            self.near(u, single["structures/left/displacement"][:, 0, 0], 2e-6)
            self.near(coupled["devices/tie/force"][:], -BAR * u, 1e-6)  # each is interpolated separately within steps
            self.assertNotIn("devices", single)
            self.assertNotIn("devices", single["energy"])

    def test_are_undeformed_by_a_preload(self):
        model = """\
ground_motion: {pulse: {shape: sine, amplitude: 1.0, duration: 1, start: 0.5}}
structures:
  left:  {oscillator: {mass: 100 t, stiffness: 20 MN/m}, damping: 5 %}
  right: {oscillator: {mass: 150 t, stiffness: 50 MN/m}, damping: 5 %}
links: [{between: [left, right], gap: -2 mm, preload: true, law: linear_spring, stiffness: 93.5 MN/m}]
devices: {tie: {between: [left, right], bar: {stiffness: 50 MN/m}}}
analysis: {duration: 2, tolerance: 1e-6, output_step: 10 ms}
"""
        summary, path = self.results(model)
        self.assertLess(summary["energy"]["error"], 1e-5)
        with h5py.File(path) as file:
            still = file["time"][:] < 0.5
            force, u = file["devices/tie/force"][:], file["structures/left/displacement"][:, 0, 0]
            self.assertLess(np.abs(force[still]).max(), 1e-6 * np.abs(force).max())
            self.assertLess(u[0], -1e-4)
            np.testing.assert_allclose(u[still], u[0], rtol=1e-6)

    def test_follow_structures_that_the_ground_moves_at_other_times(self):
        delayed = oscillators(f"bar: {{stiffness: {BAR}}}, damper: {{coefficient: {DAMPER}}}").replace(
            "initial_velocity: 0}", "delay: 0.1 s}", 2
        )
        summary, path = self.results(delayed.replace("delay: 0.1 s}", "delay: 0 s}", 1))
        self.assertLess(summary["energy"]["error"], 1e-5)
        with h5py.File(path) as file:
            t = file["time"][:]
            ground = lambda time: np.where(
                time > 0,
                AMPLITUDE
                * PERIOD
                / (2 * math.pi)
                * (time - PERIOD / (2 * math.pi) * np.sin(2 * math.pi / PERIOD * time)),
                0,
            )
            left, right = (file["structures"][name]["displacement"][:, 0, 0] for name in ("left", "right"))
            self.near(file["devices/tie/elongation"][:], right + ground(t - 0.1) - left - ground(t), 1e-5)

    def frames(
        self,
        device="between: [{structure: low, node: 1.1.1}, {structure: high, node: 2.0.0}], bar: {stiffness: 20 MN/m}",
        other="",
    ):
        frame = (
            "material: {E: 30 GPa}, grid: {storeys: 2, bays: [1, 1], storey_height: 3 m, bay_width: 5 m, rigid_floors: false, "
            "floor_mass: 60 t, columns: {rectangle: [0.5 m, 0.5 m]}, beams: {rectangle: [0.3 m, 0.5 m]}}, gravity: true"
        )
        return f"""\
ground_motion: {{components: {{x: {{harmonic: {{amplitude: 2.0, period: 0.3, duration: 1}}}}, y: {{harmonic: {{amplitude: 1.0, period: 0.4, duration: 1}}}}}}}}
structures:
  low:  {{frame: {{dimension: 3, {frame}}}, damping: 5 %}}
  high: {{frame: {{dimension: 3, origin: [9 m, 6 m], {frame}}}, damping: 5 %}}
devices:
  tie: {{{device}}}
{other}
analysis: {{duration: 1, tolerance: 1e-6, output_step: 10 ms}}
"""

    def test_join_nodes_in_space_along_the_line_between_them(self):
        summary, path = self.results(self.frames())
        self.assertLess(summary["energy"]["error"], 1e-4)
        with h5py.File(path) as file:
            device = file["devices/tie"]
            line = np.array([4.0, 1.0, 3.0])  # from (5, 5, 3) to (9, 6, 6)
            np.testing.assert_allclose(device.attrs["direction"], line / np.linalg.norm(line), rtol=1e-12)
            np.testing.assert_allclose(device["force"][:], 2e7 * device["elongation"][:], rtol=1e-9, atol=1e-6)
            self.assertGreater(np.abs(device["force"][:]).max(), 1e4)
            self.assertEqual(device["force"][0], 0, "gravity leaves it undeformed")
        by_section = self.frames().replace(
            "{stiffness: 20 MN/m}", f"{{E: 200 GPa, area: {2e7 * math.sqrt(26) / 2e11:.15g}}}"
        )
        other, _ = self.results(by_section, name="section.h5")
        self.assertAlmostEqual(
            other["devices"][0]["force"]["max"] / summary["devices"][0]["force"]["max"], 1, delta=1e-9
        )

    def test_balance_mass_and_reactions_of_a_frame(self):
        model = """\
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 10}}
structures:
  left:
    frame:
      material: {E: 30 GPa}
      grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 5 m, rigid_floors: true, floor_mass: 60 t,
             columns: {rectangle: [0.3 m, 0.3 m]}, beams: {rectangle: [0.3 m, 0.5 m]}}
    damping: 0
  right: {wall: {}}
devices: {tie: {between: [left.1, right], bar: {stiffness: 10 MN/m}, damper: {coefficient: 300 kN (s/m)^0.5, exponent: 0.5}}}
analysis: {duration: 2, tolerance: 1e-8, output_step: 10 ms}
"""
        _, path = self.results(model)
        with h5py.File(path) as file:
            acceleration = file["structures/left/acceleration"][:, 0, 0]
            reactions = file["structures/left/reactions/force"][:, :, 0].sum(axis=1)
            force = file["devices/tie/force"][:]
            self.assertGreater(np.abs(force).max(), 0.3 * np.abs(reactions).max())
            self.near(6e4 * acceleration, reactions + force, 1e-4)

    @unittest.skipIf(LAUNCHER is None, "needs mpiexec")
    def test_two_processes_have_the_answer_of_one(self):
        self.write(self.frames())
        answers = []
        for name, start in (("one.h5", []), ("two.h5", [LAUNCHER, "-n", "2"])):
            done = subprocess.run(
                [*start, PROGRAM, "run", "model.yaml", "-q", "-o", name, "-pounding_ts_pounding_base", "sparse"],
                cwd=self.folder,
                capture_output=True,
                text=True,
                env=SURROUNDINGS,
                timeout=300,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(self.folder / name) as file:
                answers.append(
                    {
                        key: file[key][:]
                        for key in (
                            "devices/tie/force",
                            "devices/tie/elongation",
                            "devices/tie/envelope/force",
                            "energy/devices",
                            "structures/high/displacement",
                        )
                    }
                )
        for key, values in answers[0].items():
            np.testing.assert_allclose(
                answers[1][key], values, rtol=0, atol=1e-9 * max(np.abs(values).max(), 1e-30), err_msg=key
            )

    def test_a_run_that_was_cut_goes_on_to_the_same_bits(self):
        link = "links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]"
        words = "bar: {stiffness: 1 MN/m}, damper: {coefficient: 20e3, exponent: 0.5}"
        for scheme in ("", ", " + SECOND_ORDER + "0.8"):
            with self.subTest(scheme=scheme):
                _, whole = self.results(oscillators(words, more=link, tolerance=1e-5, analysis=scheme))
                done = self.pounding("run", "model.yaml", "-q", "-o", "cut.h5", "-pounding_ts_max_steps", 100)
                self.assertEqual(done.returncode, 3, done.stderr)
                done = self.pounding("run", "--resume", "cut.h5", "-q")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                with h5py.File(whole) as one, h5py.File(self.folder / "cut.h5") as other:
                    for place in (
                        "devices/tie/force",
                        "devices/tie/elongation",
                        "devices/tie/envelope/force_time",
                        "energy/devices",
                        "energy/strain",
                        "structures/left/acceleration",
                    ):
                        self.assertEqual(one[place][:].tobytes(), other[place][:].tobytes(), place)

    def test_are_told_before_the_run_with_the_periods_that_bars_make(self):
        self.write(oscillators(f"bar: {{stiffness: {BAR}}}, damper: {{coefficient: 2e5, exponent: 0.35}}"))
        k = np.diag(STIFFNESSES) + BAR * np.array([[1.0, -1.0], [-1.0, 1.0]])
        periods = sorted(2 * math.pi / np.sqrt(np.linalg.eigvals(np.linalg.solve(np.diag(MASSES), k))), reverse=True)
        together = f"joined by bars: left and right together, first periods {periods[0]:.4g} s, {periods[1]:.4g} s"
        told = self.pounding("check", "model.yaml").stdout
        self.assertIn(together, told)
        assert_mentions(told, ["tie", "5 MN/m", "200 kN (s/m)^0.35", "-0.325", "1 mm/s", "left", "right"])
        self.assertIn(together, self.pounding("modes", "model.yaml").stdout)
        self.assertIn("force (kN)", self.pounding("run", "model.yaml").stdout)

    def test_wrong_words_are_refused(self):
        def refused(device, message, name="tie"):
            self.write(oscillators(device).replace("tie:", name + ":"))
            self.refused(2, message, "check", "model.yaml")

        refused("bar: {stiffness: 0}", "devices.tie.bar.stiffness")
        refused("bar: {}", "devices.tie.bar: ")
        refused("bar: {stiffness: 1e6, E: 200 GPa}", "devices.tie.bar.E")
        refused("bar: {E: 200 GPa}", ["area", "devices.tie.bar"])
        refused("bar: {E: 200 GPa, area: 20 cm^2}", "bar")
        refused("damper: {coefficient: -1}", "devices.tie.damper.coefficient")
        refused("damper: {coefficient: 1e5, exponent: 0.01}", "devices.tie.damper.exponent")
        refused(
            "damper: {coefficient: 200 kN s/m, exponent: 0.5}",
            ["200 kN (s/m)^0.5", "200 kN s/m", "devices.tie.damper.coefficient", "1 m/s"],
        )
        refused("damper: {coefficient: 1e5, rounding_velocity: 1 mm/s}", [])
        refused("dampr: {coefficient: 1e5}", "damper")
        self.write(oscillators("").replace(", }}", "}}"))
        self.refused(2, ["bar: {stiffness: 50 MN/m}", "devices.tie"], "check", "model.yaml")
        self.write(oscillators("bar: {stiffness: 1e6}").replace("[left, right]", "[left.2, right]"))
        self.refused(2, "left.2", "check", "model.yaml")
        self.write(oscillators("bar: {stiffness: 1e6}").replace("[left, right]", "[left, left]"))
        self.refused(2, "devices.tie.between", "check", "model.yaml")
        refused("bar: {stiffness: 1e6}", [], name='"a/b"')
        self.write(
            self.frames(
                "between: [{structure: low, node: 0.1.1}, {structure: high, node: 2.0.0}], bar: {stiffness: 20 MN/m}"
            )
        )
        self.refused(2, "0.1.1", "check", "model.yaml")


if __name__ == "__main__":
    unittest.main()
