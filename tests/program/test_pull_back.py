"""Pull-back tests: structures released from a displacement beyond yield."""

import json
import math
import unittest

import h5py
import numpy as np

from support import ProgramTest

MASS, STIFFNESS, YIELD, HARDENING = 100e3, 15.8e6, 150e3, 0.05
BILINEAR = f"mass: 100 t, stiffness: {STIFFNESS}, yield_force: {YIELD}, hardening: {HARDENING}"


class PullBack(ProgramTest):
    def results(self, model, name="out.h5"):
        self.write(model)
        done = self.pounding("run", "model.yaml", "--json", "-o", name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout), self.folder / name

    def displacement(self, path):
        with h5py.File(path) as file:
            return file["time"][:], file["structures/a/displacement"][:, 0, 0]

    def released(self, by, damping="0", duration=4, spring=BILINEAR):
        return (
            f"structures: {{a: {{oscillator: {{{spring}}}, damping: {damping}, initial_displacement: {by}}}}}\n"
            f"analysis: {{duration: {duration}, tolerance: 1e-8, output_step: 10 ms}}\n"
        )

    def test_a_bilinear_oscillator_has_the_closed_form_of_its_unloading(self):
        # Unloading from d along k is elastic over 2 Fy: for d < 3 dy without hardening it never yields again, and the
        # oscillator vibrates about the plastic deformation with the amplitude dy.
        dy = YIELD / STIFFNESS
        spring = f"mass: 100 t, stiffness: {STIFFNESS}, yield_force: {YIELD}, hardening: 0"
        for ductility in (1.5, 3.0, -4.0):
            with self.subTest(ductility=ductility):
                d, sign = ductility * dy, math.copysign(1, ductility)
                summary, path = self.results(self.released(d, spring=spring))
                t, u = self.displacement(path)
                w = math.sqrt(STIFFNESS / MASS)
                exact = (d - sign * dy) + sign * dy * np.cos(w * t)
                np.testing.assert_allclose(u, exact, rtol=0, atol=2e-7 * dy)
                energy = summary["energy"]
                plastic = YIELD * (abs(d) - dy)
                self.assertAlmostEqual(energy["input"] / (0.5 * YIELD * dy + plastic), 1, delta=1e-12)
                self.assertAlmostEqual(energy["hysteretic"] / plastic, 1, delta=1e-9)
                self.assertLess(energy["error"], 1e-6)

    def test_a_hardening_oscillator_moves_as_an_independent_integrator_has_it(self):
        # Runge-Kutta steps of 50 us; the slip follows by return mapping after each step.
        k, a, h = STIFFNESS, HARDENING, 5e-5
        dy, c = YIELD / k, 2 * 0.02 * math.sqrt(k * MASS)
        for ductility in (2.0, 8.0, -6.0):
            with self.subTest(ductility=ductility):
                u, v = ductility * dy, 0.0
                slip = u - math.copysign(dy, u)
                found, lost = [u], (1 - a) * YIELD * abs(slip)

                def acceleration(u, v):
                    return -(a * k * u + (1 - a) * k * min(max(u - slip, -dy), dy) + c * v) / MASS

                for i in range(1, 80001):
                    k1 = acceleration(u, v)
                    k2 = acceleration(u + 0.5 * h * v, v + 0.5 * h * k1)
                    k3 = acceleration(u + 0.5 * h * v + 0.25 * h * h * k1, v + 0.5 * h * k2)
                    k4 = acceleration(u + h * v + 0.5 * h * h * k2, v + h * k3)
                    u, v = u + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
                    moved = min(max(slip, u - dy), u + dy)
                    lost += (1 - a) * YIELD * abs(moved - slip)
                    slip = moved
                    if i % 200 == 0:
                        found.append(u)
                summary, path = self.results(self.released(ductility * dy, damping="2 %"))
                _, moved = self.displacement(path)
                self.assertLess(np.abs(moved - found).max() / abs(found[0]), 2e-6)
                self.assertAlmostEqual(summary["energy"]["hysteretic"] / lost, 1, delta=1e-5)
                self.assertLess(summary["energy"]["error"], 1e-6)

    def test_a_storey_may_yield_in_a_building(self):
        model = (
            "structures: {a: {shear_building: {storeys: 2, mass: 50 t, stiffness: 40 MN/m, yield_force: 200 kN},"
            " damping: 3 %, initial_displacement: [4 mm, 20 mm]}}\n"
            "analysis: {duration: 1, tolerance: 1e-7, output_step: 10 ms}\n"
        )
        summary, _ = self.results(model)
        # Storey 1 stays elastic at 4 mm; storey 2 yields at 5 mm and is deformed by 16 mm.
        strain = 0.5 * 40e6 * 0.004**2 + 0.5 * 200e3 * 0.005
        self.assertAlmostEqual(summary["energy"]["input"] / (strain + 200e3 * 0.011), 1, delta=1e-12)
        self.assertLess(summary["energy"]["error"], 1e-5)

    def test_a_portal_is_held_in_equilibrium_with_its_yielded_hinges(self):
        # A cantilever of length L, held at the top: M = Fy at the foot beyond yield, so the force at the top is M/L and
        # the elastic part of the displacement is M L^2/(3 E I).
        length, young, inertia, moment = 3.0, 30e9, 0.4**4 / 12, 100e3
        model = f"""\
structures:
  a:
    frame:
      material: {{E: 30 GPa}}
      nodes: {{a: [0, 0], b: [0, {length}]}}
      members: {{c: {{between: [a, b], section: {{rectangle: [0.4, 0.4], shear: false}}}}}}
      supports: {{a: fixed}}
      masses: {{b: 10 t}}
      floors: [{{nodes: [b]}}]
      hinges: {{c: {{at: start, yield_moment: {moment}, hardening: 0}}}}
    damping: 0
    initial_displacement: 50 mm
analysis: {{duration: 0.5, tolerance: 1e-7, output_step: 1 ms}}
"""
        summary, path = self.results(model)
        elastic = moment * length**2 / (3 * young * inertia)
        plastic = (0.05 - elastic) / length
        energy = summary["energy"]
        self.assertAlmostEqual(
            energy["input"], 0.5 * moment / length * elastic + moment * plastic, delta=2e-6 * energy["input"]
        )
        self.assertLess(energy["error"], 1e-5)
        t, u = self.displacement(path)
        self.assertAlmostEqual(u[0], 0.05, delta=1e-12)
        w = math.sqrt(3 * young * inertia / length**3 / 10e3)
        np.testing.assert_allclose(u, 0.05 - elastic + elastic * np.cos(w * t), atol=1e-5 * 0.05)


if __name__ == "__main__":
    unittest.main()
