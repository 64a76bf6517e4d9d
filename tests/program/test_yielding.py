"""Yielding storeys as the program reports them: datasets of each part, its sums, a resumed run, processes."""

import json
import subprocess
import unittest

import h5py
import numpy as np

from support import LAUNCHER, PROGRAM, SURROUNDINGS, ProgramTest, bits
from messages import assert_mentions

STIFFNESS, YIELD, HARDENING = (60e6, 50e6), (0.9e6, 0.6e6), 0.05
#: Two yielding buildings that collide.
PAIR = """\
ground_motion: {harmonic: {amplitude: 5.0, period: 0.6, duration: 3.0}}
structures:
  left:
    shear_building: {storeys: 2, mass: 200 t, stiffness: [60 MN/m, 50 MN/m], yield_force: [0.9 MN, 0.6 MN], hardening: 0.05}
    damping: 5 %
  right:
    shear_building: {storeys: 2, mass: 150 t, stiffness: 300 MN/m, yield_force: 20 MN, hardening: 0.05}
    damping: 3 %
links:
  - {between: [left, right], floors: all, gap: 20 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.65}
analysis: {duration: 4.0, tolerance: 1e-5, output_step: 5 ms}
"""
#: A portal frame whose columns yield far beyond the yield point, and one whose beam hardly yields.
PORTAL = """\
    frame:
      material: {E: 30 GPa, poisson: 0.2}
      grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: {rectangle: [0.4 m, 0.6 m]},
             floor_mass: 60 t}
      hinges: {%s}
    damping: 5 %%
"""
FRAMES = (
    "ground_motion: {harmonic: {amplitude: 4.0, period: 0.5, duration: 2.0}}\nstructures:\n"
    "  weak:\n"
    + PORTAL % "columns: {at: both, yield_moment: 80 kN m, hardening: 3 %, ultimate_rotation: 0.0005}"
    + "  strong:\n"
    + PORTAL % "columns: {at: feet, yield_moment: 130 kN m, hardening: 3 %}, beams: {at: both, yield_moment: 5 MN m}"
    + "analysis: {duration: 2.5, output_step: 5 ms}\n"
)


class Yielding(ProgramTest):
    def results(self, model, *words, name="out.h5"):
        self.write(model)
        done = self.pounding("run", "model.yaml", "--json", "-o", name, *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout), self.folder / name

    def springs(self, path, structure="left"):
        with h5py.File(path) as file:
            group = file["structures"][structure]["springs"]
            found = {}
            group.visititems(lambda key, data: found.update({key: data[:]}) if isinstance(data, h5py.Dataset) else None)
            return file["time"][:], found

    def test_follow_drifts_and_shears_of_their_storeys(self):
        _, path = self.results(PAIR)
        _, found = self.springs(path)
        with h5py.File(path) as file:
            drift, shear = (file["structures/left"][key][:] for key in ("drift", "storey_shear"))
        self.assertEqual(found["names"].tolist(), [b"storey 1", b"storey 2"])
        self.assertEqual(found["laws"].tolist(), [b"bilinear", b"bilinear"])
        np.testing.assert_allclose(found["yield_deformation"], np.divide(YIELD, STIFFNESS))
        # The drift is a cubic within a step, the deformation a polynomial of degree five.
        np.testing.assert_allclose(found["deformation"], drift, atol=1e-5 * np.abs(drift).max())
        np.testing.assert_allclose(found["force"], shear, atol=1e-5 * np.abs(shear).max())

    def test_lose_the_area_of_their_loops(self):
        summary, path = self.results(PAIR.replace("output_step: 5 ms", "output_step: 0.2 ms"))
        _, found = self.springs(path)
        d, f, k = found["deformation"], found["force"], np.array(STIFFNESS)
        work = np.cumsum(np.vstack([np.zeros(2), np.diff(d, axis=0) * (f[1:] + f[:-1]) / 2]), axis=0)
        # Kinematic hardening stores a k d^2/2 + (1 - a) k (d - s)^2/2, and f = a k d + (1 - a) k (d - s).
        stretch = (f - HARDENING * k * d) / ((1 - HARDENING) * k)
        stored = k / 2 * (HARDENING * d**2 + (1 - HARDENING) * stretch**2)
        np.testing.assert_allclose(found["hysteretic"], work - stored, atol=2e-3 * work.max())
        self.assertTrue((np.diff(found["hysteretic"], axis=0) >= 0).all())
        np.testing.assert_allclose(found["hysteretic"][-1], found["summary/hysteretic"], rtol=1e-12)
        by = summary["hysteretic_by"]["left"]
        self.assertEqual(list(by), ["storey 1", "storey 2"])
        self.assertAlmostEqual(sum(by.values()) / summary["energy"]["hysteretic"], 1, delta=1e-12)

    def test_tell_peaks_residuals_and_the_first_yield(self):
        summary, path = self.results(PAIR.replace("output_step: 5 ms", "output_step: 0.2 ms"))
        time, found = self.springs(path)
        d, limit = found["deformation"], found["yield_deformation"]
        peaks = np.abs(d).max(axis=0)
        np.testing.assert_allclose(np.abs(found["summary/peak_deformation"]), peaks, rtol=1e-4)
        self.assertTrue((np.abs(found["summary/peak_deformation"]) >= peaks * (1 - 1e-6)).all())
        for i in range(2):
            at = np.interp(found["summary/peak_time"][i], time, d[:, i])
            self.assertAlmostEqual(at / found["summary/peak_deformation"][i], 1, delta=1e-3)
            beyond = int(np.argmax(np.abs(d[:, i]) > limit[i]))
            first = found["summary/first_yield"][i]
            self.assertLess(time[beyond - 1] - 1e-9, first)
            self.assertLess(first, time[beyond] + 1e-9)
        np.testing.assert_allclose(found["summary/ductility"], np.abs(found["summary/peak_deformation"]) / limit)
        np.testing.assert_allclose(found["summary/residual"], d[-1], rtol=1e-9)
        left = summary["structures"]["left"]
        np.testing.assert_allclose(left["residual_drift"], d[-1], rtol=1e-9)
        np.testing.assert_allclose(left["residual_displacement"], np.cumsum(d[-1]), rtol=1e-9)
        self.assertEqual(
            (left["yielding"]["yielded"], [one["state"] for one in left["yielding"]["springs"]]), (2, ["yielded"] * 2)
        )
        most = int(np.argmax(found["summary/ductility"]))
        self.assertEqual(left["yielding"]["largest"]["name"], f"storey {most + 1}")
        self.assertAlmostEqual(left["yielding"]["largest"]["ductility"], found["summary/ductility"][most])

    def test_that_stay_elastic_say_so(self):
        summary, path = self.results(PAIR)
        right = summary["structures"]["right"]["yielding"]
        self.assertEqual((right["yielded"], [one["first_yield"] for one in right["springs"]]), (0, [None, None]))
        _, found = self.springs(path, "right")
        self.assertEqual(found["summary/state"].tolist(), [b"elastic"] * 2)
        self.assertTrue(np.isnan(found["summary/first_yield"]).all() and (found["hysteretic"] == 0).all())

    def test_compare_the_damping_with_the_yield_shear(self):
        # Both modes of a two-storey building have 5 %: C = a M + b K, and a storey carries the forces of all floors
        # above.
        _, path = self.results(PAIR.replace("output_step: 5 ms", "output_step: 0.2 ms"))
        m, k = np.diag([2e5, 2e5]), np.array([[sum(STIFFNESS), -STIFFNESS[1]], [-STIFFNESS[1], STIFFNESS[1]]])
        w = np.sqrt(np.linalg.eigvalsh(k / 2e5))
        c = 0.1 * (w[0] * w[1] * m + k) / w.sum()
        with h5py.File(path) as file:
            v = file["structures/left/velocity"][:, :, 0]
        shears = np.cumsum((v @ c)[:, ::-1], axis=1)[:, ::-1]
        _, found = self.springs(path)
        expected = np.abs(shears).max(axis=0) / np.array(YIELD)
        np.testing.assert_allclose(found["summary/damping_shear"], expected, rtol=1e-4)

    def test_count_cycles_and_the_largest_plastic_deformation(self):
        summary, path = self.results(PAIR.replace("output_step: 5 ms", "output_step: 0.2 ms"))
        _, found = self.springs(path)
        d, f, limit = found["deformation"], found["force"], found["yield_deformation"]
        np.testing.assert_allclose(
            found["summary/peak_plastic"], np.abs(d - f / np.array(STIFFNESS)).max(axis=0), rtol=1e-4
        )
        # A bilinear storey yields once per swing: its slope is that of the hardening.
        for i in range(2):
            signs = np.sign(np.diff(d[:, i]))[np.abs(np.diff(f[:, i])) < 0.5 * STIFFNESS[i] * np.abs(np.diff(d[:, i]))]
            swings = 1 + np.count_nonzero(np.diff(signs))
            self.assertGreater(swings, 4)
            self.assertEqual(found["summary/cycles"][i], swings / 2)
        left = summary["structures"]["left"]["yielding"]["springs"]
        self.assertEqual([one["cycles"] for one in left], found["summary/cycles"].tolist())
        self.assertEqual([one["plastic"] for one in left], found["summary/peak_plastic"].tolist())
        self.assertTrue(np.isnan(found["ultimate_rotation"]).all())
        self.assertNotIn("hinges", summary)
        self.assertGreater(found["summary/cycles"][0], 0)

    def test_what_is_left_is_told_with_the_heights(self):
        with_heights = PAIR.replace("stiffness: [60 MN/m", "height: [3 m, 2.5 m], stiffness: [60 MN/m")
        summary, path = self.results(with_heights)
        left, right = summary["structures"]["left"], summary["structures"]["right"]
        np.testing.assert_allclose(left["residual_drift_ratio"], np.abs(left["residual_drift"]) / [3, 2.5], rtol=1e-14)
        self.assertNotIn("residual_drift_ratio", right)
        drifts = np.abs(left["residual_drift"])
        worst = int(np.argmax(drifts))
        lines = self.pounding("run", "model.yaml").stdout.splitlines()
        assert_mentions(
            lines,
            [
                "left",
                f"{1000.0 * abs(left['residual_displacement'][-1]):.4g}",
                f"{worst + 1}",
                f"{1000.0 * drifts[worst]:.4g}",
                f"{100 * left['residual_drift_ratio'][worst]:.3g}",
            ],
        )

    def test_hinges_are_counted_with_those_beyond_their_ultimate_rotation(self):
        summary, path = self.results(FRAMES)
        hinges = summary["hinges"]
        parts = {
            (name, part["name"]): part
            for name, one in summary["structures"].items()
            for part in one["yielding"]["springs"]
        }
        self.assertEqual((hinges["count"], hinges["yielded"]), (8, 6))
        beyond = [key for key, part in parts.items() if part["state"] == "beyond ultimate"]
        self.assertEqual(
            beyond,
            [
                key
                for key, part in parts.items()
                if part["ultimate_rotation"] and part["plastic"] > part["ultimate_rotation"]
            ],
        )
        self.assertEqual((hinges["beyond_ultimate"], len(beyond)), (4, 4))
        largest = max(parts, key=lambda key: parts[key]["ductility"])
        self.assertEqual((hinges["largest"]["structure"], hinges["largest"]["name"]), largest)
        self.assertEqual(
            (hinges["largest"]["ductility"], hinges["largest"]["rotation"]),
            (parts[largest]["ductility"], parts[largest]["plastic"]),
        )
        _, found = self.springs(path, "weak")
        self.assertEqual(found["ultimate_rotation"].tolist(), [0.0005] * 4)
        lines = self.pounding("run", "model.yaml").stdout.splitlines()
        farthest = max((parts[key]["plastic"], key[1]) for key in beyond)
        self.assertTrue(
            any(
                line.startswith("weak: 4 ") and line.endswith(f"with {1e3 * farthest[0]:.4g} of 0.5 mrad")
                for line in lines
            ),
            lines,
        )

    def test_are_in_the_table(self):
        self.write(PAIR)
        lines = self.pounding("run", "model.yaml").stdout.splitlines()
        head = next(i for i, line in enumerate(lines) if "ductility" in line)
        self.assertIn("damping shear", lines[head])
        rows = [line.split() for line in lines[head + 2 : head + 6]]
        self.assertEqual(
            [row[:3] for row in rows], [[name, "storey", str(i)] for name in ("left", "right") for i in (1, 2)]
        )
        self.assertEqual([row[-2] for row in rows[2:]], ["elastic"] * 2)

    def test_none_where_nothing_can_yield(self):
        elastic = (
            "\n".join(PAIR.splitlines())
            .replace(", yield_force: 20 MN, hardening: 0.05", "")
            .replace(", yield_force: [0.9 MN, 0.6 MN], hardening: 0.05", "")
        )
        summary, path = self.results(elastic)
        self.assertNotIn("hysteretic_by", summary)
        self.assertNotIn("yielding", summary["structures"]["left"])
        with h5py.File(path) as file:
            self.assertNotIn("springs", file["structures/left"])

    def test_isolators_beyond_their_capacity_are_told(self):
        building = lambda capacity: (
            f"""ground_motion: {{harmonic: {{amplitude: 5.0, period: 0.6, duration: 3.0}}}}
structures:
  a: {{shear_building: {{storeys: 2, mass: 200 t, stiffness: 300 MN/m, isolator: {{friction_pendulum: {{radius: 2 m, friction: 6 %}}, capacity: {capacity}}}}}, damping: 2 %}}
analysis: {{duration: 3 s}}
"""
        )
        self.write(building("1 mm"))
        done = self.pounding("run", "model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout + done.stderr, "1 mm")
        self.write(building("2 m"))
        done = self.pounding("run", "model.yaml")
        self.assertEqual((done.returncode, "beyond the capacity" in done.stdout + done.stderr), (0, False))
        self.write(building("0 mm"))
        self.refused(2, "isolator.capacity", "check", "model.yaml")

    def test_resume_to_the_bit(self):
        whole, path = self.results(PAIR)
        self.write(PAIR)
        again = self.resumed(300, "part.h5")
        for summary in (whole, again):
            summary.pop("solver")
        self.assertEqual(again, whole)
        (_, one), (_, other) = self.springs(path), self.springs(self.folder / "part.h5")
        self.assertEqual(one.keys(), other.keys())
        for key in one:
            self.assertEqual(bits(one[key]), bits(other[key]), key)

    @unittest.skipUnless(LAUNCHER, "needs MPI")
    def test_are_alike_on_two_processes(self):
        _, path = self.results(PAIR)
        command = [LAUNCHER, "-n", "2", PROGRAM, "run", "model.yaml", "-q", "-o", "two.h5"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env=SURROUNDINGS, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        (_, one), (_, two) = self.springs(path), self.springs(self.folder / "two.h5")
        for key in ("deformation", "force", "hysteretic", "summary/ductility"):
            np.testing.assert_allclose(two[key], one[key], rtol=1e-9, atol=1e-9 * np.abs(one[key]).max())


if __name__ == "__main__":
    unittest.main()
