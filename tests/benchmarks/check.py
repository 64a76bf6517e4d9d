#!/usr/bin/env python3
"""Tests of the benchmark code: its laws, frame matrices, counting and interpolation.

python3 tests/benchmarks/check.py        # needs numpy and scipy, not OpenSees
"""

import math
import unittest

import numpy as np

import plane_frames
import problem
import towers
from contact import Contact, integrate
from measure import at_error, displacement_error, factor, peak_error, reference, verdict
from reference import oscillators

MASS, SPEED = problem.OSCILLATOR_MASS, 0.5


def free_impact(law):
    """Restitution and peak force [N] of free bodies of reduced mass MASS that close at SPEED."""
    slope = lambda t, y, forces: np.array([y[1], -forces.get(0, 0.0) / MASS])
    kept, peaks, _ = integrate(
        slope, [Contact(law, MASS)], lambda y, link: tuple(y), [-0.005, SPEED], [0.3], [0.0, 0.3], 1e-11, 1e-14, 1e-3
    )
    return -kept[-1][1] / SPEED, peaks[0][0]


class FreeImpact(unittest.TestCase):
    def test_elastic_laws_return_the_speed_and_the_energy(self):
        stored = MASS * SPEED**2 / 2
        e, peak = free_impact("linear_spring")
        self.assertAlmostEqual(e, 1, delta=1e-9)
        self.assertAlmostEqual(peak / math.sqrt(2 * stored * problem.LINEAR_STIFFNESS), 1, delta=1e-9)
        e, peak = free_impact("hertz")
        deepest = (2.5 * stored / problem.HERTZ_STIFFNESS) ** 0.4
        self.assertAlmostEqual(e, 1, delta=1e-7)
        self.assertAlmostEqual(peak / (problem.HERTZ_STIFFNESS * deepest**1.5), 1, delta=1e-7)

    def test_kelvin_voigt_gives_what_is_asked(self):
        self.assertAlmostEqual(free_impact("kelvin_voigt")[0], problem.RESTITUTION, delta=1e-9)

    def test_hertz_damped_obeys_the_closed_form_of_its_factor(self):
        # a (1 + e) = ln[(1 + a)/(1 - a e)], independent of mass, stiffness and speed.
        a, e = problem.ye_factor(), free_impact("hertz_damped")[0]
        self.assertAlmostEqual(a * (1 + e), math.log((1 + a) / (1 - a * e)), delta=1e-7)

    def test_jankowski_obeys_the_linear_oscillator_in_stretched_time(self):
        # With s = d^(5/4) the approach is a linear oscillator of damping ratio z = 2 xi/sqrt(5); the restitution is
        # elastic. The fraction of the kinetic energy stored at maximum penetration is exp(-2 z/sqrt(1 - z^2) acos(z)).
        z = 2 * problem.jankowski_ratio() / math.sqrt(5)
        self.assertAlmostEqual(
            free_impact("jankowski")[0], math.exp(-z / math.sqrt(1 - z * z) * math.acos(z)), delta=1e-7
        )

    def test_bilinear_loses_the_area_of_its_loop(self):
        k1, k2, yielding = problem.bilinear_curve(MASS)
        e, peak = free_impact("bilinear_hertz")
        energy = MASS * SPEED**2 / 2
        left = energy - k1 * yielding**2 / 2
        further = (-k1 * yielding + math.sqrt((k1 * yielding) ** 2 + 2 * k2 * left)) / k2
        self.assertAlmostEqual(peak / (k1 * yielding + k2 * further), 1, delta=1e-9)
        self.assertAlmostEqual(e * e, 1 - (k1 - k2) * yielding * further / energy, delta=1e-9)


class Reference(unittest.TestCase):
    def test_the_stored_numbers_are_those_of_the_command(self):
        for law in ("kelvin_voigt", "hertz_damped", "hertz_damped_pulling"):
            stored = reference("two_oscillators")["laws"][law]
            made = oscillators(law, 1e-9)
            self.assertLess(displacement_error(made["displacement"], stored["displacement"]), 1e-6)
            self.assertLess(peak_error(made["peaks"][0], stored["peaks"][0]), 1e-6)

    def test_the_cut_of_the_pull_can_be_seen_in_the_peaks(self):
        laws = reference("two_oscillators")["laws"]
        self.assertGreater(peak_error(laws["hertz_damped"]["peaks"][0], laws["hertz_damped_pulling"]["peaks"][0]), 1e-3)

    def test_bodies_torn_apart_are_pulled_only_by_the_uncut_law(self):
        for law, sign in (("hertz_damped", 0), ("hertz_damped_pulling", -1)):
            contact = Contact(law, MASS)
            contact.enter("touch", 0.0, SPEED)
            apart = -2 * SPEED / problem.ye_factor()
            if not contact.pulls:
                function, direction, phase = contact.events()[1]
                self.assertGreater(function(1e-3, SPEED), 0)
                self.assertLess(function(1e-3, apart), 0)
                contact.enter(phase, 1e-3, apart)
            self.assertEqual(np.sign(contact.force(1e-3, apart)), sign)


class PlaneFrame(unittest.TestCase):
    def test_a_cantilever_of_one_storey_bends_as_in_the_book(self):
        # No bays: one column, its top free to rotate after condensation, 3 E I/h^3.
        mass, k = plane_frames.frame(1, 0, 1.0)
        expected = 3 * plane_frames.ELASTICITY * plane_frames.COLUMN[1] / plane_frames.HEIGHT**3
        self.assertAlmostEqual(k[0, 0] / expected, 1, delta=1e-9)

    def test_the_pair_has_150_unknowns_with_rotations_and_the_stored_damping(self):
        mass, k, coefficients, faces, tops = plane_frames.pair()
        self.assertEqual(len(mass) * 3 // 2, 150)
        self.assertEqual(len(faces), 6)
        for now, stored in zip(coefficients, reference("plane_frames")["rayleigh"]):
            self.assertAlmostEqual(now / stored, 1, delta=1e-9)


class Towers(unittest.TestCase):
    def test_neighbours_touch_and_close_at_one_speed(self):
        self.assertEqual(len(towers.neighbours(8)), 10)
        for count in (2, 8):
            for a, b, axis in towers.neighbours(count):
                self.assertEqual([b[0] - a[0], b[1] - a[1]], [1 - axis, axis])
                closing = towers.speed(count, a[0]) - towers.speed(count, b[0])
                self.assertAlmostEqual(closing, 0 if axis else towers.SPEED)

    def test_every_tower_is_stiffer_than_its_neighbours_before_it(self):
        for a, b, _ in towers.neighbours(8):
            self.assertGreater(towers.stiffer(*b), towers.stiffer(*a))

    def test_a_pair_has_the_unknowns_of_its_nodes(self):
        # 36 nodes on each of 20 floors: six each, or three each and three of the floor.
        self.assertEqual(towers.unknowns("2 flexible"), 2 * 20 * 36 * 6)
        self.assertEqual(towers.unknowns("2 rigid"), 2 * 20 * (36 * 3 + 3))

    def test_a_quarter_of_the_steps_is_quicker(self):
        self.assertEqual(towers.quarter([9, 1, 5, 7, 3, 8, 2, 6]), 3)


class Reading(unittest.TestCase):
    def test_a_missed_impact_is_a_whole_error(self):
        self.assertEqual(peak_error([1.0], [1.0, 1.0]), 1.0)
        self.assertAlmostEqual(peak_error([1.0, 2.02], [1.0, 2.0]), 0.01)
        self.assertEqual(peak_error([5.0], [0.0]), 1.0)
        self.assertEqual(peak_error([0.0], [0.0]), 0.0)
        self.assertAlmostEqual(displacement_error([[1.0, 2.5]], [[1.0, 2.0]]), 0.25)

    def test_the_time_at_an_error_lies_on_the_line_between_points(self):
        points = [{"error": 1e-2, "seconds": 1.0}, {"error": 1e-4, "seconds": 10.0}]
        self.assertAlmostEqual(at_error(points, 1e-3)["seconds"], math.sqrt(10))
        self.assertEqual(at_error(points, 1e-2), {"seconds": 1.0, "bound": True})
        self.assertIsNone(at_error(points, 1e-5)["seconds"])
        self.assertEqual(at_error(points, 1e-5)["best"], points[1])

    def test_a_curve_that_worsens_counts_from_its_best_point_before(self):
        points = [{"error": 1e-2, "seconds": 1.0}, {"error": 1.0, "seconds": 2.0}, {"error": 1e-4, "seconds": 4.0}]
        self.assertAlmostEqual(at_error(points, 1e-3)["seconds"], 2.0)

    def test_a_bound_proves_only_what_it_bounds(self):
        exact, early, missed = (
            {"seconds": 2.0, "bound": False},
            {"seconds": 2.0, "bound": True},
            {"seconds": None, "best": {"seconds": 9.0}},
        )
        self.assertEqual(factor(exact, exact), (1.0, "1", "="))
        self.assertEqual(factor(missed, exact), (4.5, "more than 4.5", ">"))
        self.assertEqual(factor(early, exact), (1.0, "at most 1", "<"))
        self.assertEqual(factor(exact, missed)[0], None)
        self.assertEqual([verdict(50, sense, 100) for sense in "=><?"], ["no", "open", "no", "open"])
        self.assertEqual([verdict(150, sense, 100) for sense in "=><?"], ["yes", "yes", "open", "open"])


if __name__ == "__main__":
    unittest.main()
