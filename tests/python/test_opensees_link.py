"""The server for OpenSees' element genericClient, tested through its protocol: force, slopes, impacts, and shutdown.

A free impact of two bodies is integrated here as OpenSees would, and compared with the law's result for two free
bodies.
"""

import json
import math
import os
import socket
import struct
import subprocess
import sys
import unittest

import numpy as np

import pounding
from pounding.opensees import LINK_PROCESS
from pounding._opensees.link_process import time_to_close

SIZE = 8
MASSES = 100e3, 150e3
REDUCED = MASSES[0] * MASSES[1] / sum(MASSES)
#: Restitution 0.6 of a free impact at 1 m/s; the contact lasts about 20 ms.
HERTZ_DAMPED = {"law": "hertz_damped", "formula": "exact", "values": {"stiffness": 2e9, "restitution": 0.6}}
LINEAR = {
    "law": "kelvin_voigt_no_tension",
    "formula": "exact",
    "values": {"stiffness": 1e9, "restitution": 0.6, "reduced_mass": REDUCED},
}
JANKOWSKI = {
    "law": "jankowski",
    "formula": "exact",
    "values": {"stiffness": 2e9, "restitution": 0.6, "reduced_mass": REDUCED},
}
KOMODROMOS = {**LINEAR, "law": "komodromos"}


class Element:
    """The communicating part of GenericClient."""

    def __init__(self, law, gap=0.01):
        self.process = subprocess.Popen(
            [sys.executable, str(LINK_PROCESS)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=dict(os.environ),
        )
        self.first = self.ask(json.dumps({**law, "gap": gap}))

    def connect(self):
        self.connection = socket.create_connection(("127.0.0.1", self.first["port"]))
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.connection.sendall(struct.pack("11i", 2, 2, 2, 0, 1, 0, 0, 0, 2, 0, SIZE))
        return self

    def ask(self, line=""):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def send(self, action, *numbers):
        self.connection.sendall(struct.pack(f"{SIZE}d", action, *numbers, *[0.0] * (SIZE - 1 - len(numbers))))

    def get(self, action):
        self.send(action)
        data = b""
        while len(data) < 8 * SIZE:
            data += self.connection.recv(8 * SIZE - len(data))
        return np.array(struct.unpack(f"{SIZE}d", data)[:4])

    def trial(self, time, u, v, a=(0.0, 0.0)):
        self.send(3, *u, *v, *a, time)

    def keep(self):
        self.send(5)

    def forces(self, v):
        """On both degrees of freedom, as summed by the element."""
        return self.get(10)[:2] + self.get(14).reshape(2, 2) @ v

    def impacts(self):
        self.get(10)
        return self.ask()["impacts"]

    def end(self):
        self.send(99)
        self.connection.close()
        return self.close()

    def close(self):
        self.process.stdin.close()
        lines = self.process.stdout.readlines()
        self.process.stdout.close()
        return self.process.wait(timeout=20), [json.loads(line) for line in lines]


def collide(law, step, speed=1.0, gap=0.01):
    """Newmark with constant average acceleration, Newton with the slopes of the element. The left body starts at this
    speed. Returns the impacts, and the maximum number of iterations per step."""
    element = Element(law, gap).connect()
    u, v, a = np.zeros(2), np.array([speed, 0.0]), np.zeros(2)
    element.trial(0.0, u, v, a)
    mass, most = np.diag(MASSES), 0
    for n in range(1, round(0.08 / step) + 1):
        u0, v0, a0, u = u, v, a, u + step * v
        for iteration in range(1, 20):
            a = 4 / step**2 * (u - u0 - step * v0) - a0
            v = v0 + step / 2 * (a0 + a)
            element.trial(n * step, u, v, a)
            residual = mass @ a + element.forces(v)
            slope = 4 / step**2 * mass + 2 / step * element.get(14).reshape(2, 2) + element.get(13).reshape(2, 2)
            correction = np.linalg.solve(slope, residual)
            u = u - correction
            if np.abs(correction).max() < 1e-13:
                break
        else:
            raise AssertionError("Newton does not converge")
        most = max(most, iteration)
        element.keep()
    status, lines = element.end()
    assert status == 0
    return lines[-1]["impacts"], most


class FreeImpact(unittest.TestCase):
    def errors(self, law, steps, names):
        """Root mean squares over several steps near each of these, relative to the free impact of the law."""
        values = law["values"]
        made = pounding.laws[law["law"]](**{"formula": law["formula"], **values})
        free = made.free_impact(1.0, REDUCED)
        found = []
        for step in steps:
            squares = []
            for factor in (1.0, 0.94, 0.87, 0.81):
                impacts, most = collide(law, factor * step)
                self.assertEqual(len(impacts), 1)
                self.assertLessEqual(most, 5)
                squares.append([(impacts[0][name] / getattr(free, name) - 1) ** 2 for name in names])
            found.append(np.sqrt(np.mean(squares, axis=0)))
        return found

    # The force has no corner at the touch, so that the order is the integrator's.
    def test_a_law_that_begins_smoothly_converges_with_the_second_order(self):
        coarse, fine = self.errors(
            HERTZ_DAMPED, (4e-4, 1e-4), ("restitution", "peak_force", "peak_penetration", "impulse", "energy_lost")
        )
        np.testing.assert_array_less(fine, 3e-4)
        np.testing.assert_array_less(7, coarse / fine)

    # A dashpot whose force jumps at the touch, or scales with d^(1/4), causes an error in the first step.
    def test_laws_whose_dashpot_begins_with_the_touch_converge(self):
        for law, order in ((LINEAR, 1), (JANKOWSKI, 1.25)):
            with self.subTest(law=law["law"]):
                coarse, fine = self.errors(law, (4e-4, 2.5e-5), ("restitution", "impulse"))
                np.testing.assert_array_less(16 ** (order - 0.3), coarse / fine)
                np.testing.assert_array_less(fine, 5e-3)

    def test_komodromos_leaves_its_indentation(self):
        [impact], _ = collide(KOMODROMOS, 2e-5)
        self.assertAlmostEqual(impact["restitution"], 0.6, delta=3e-3)
        element = Element(KOMODROMOS, 0.0).connect()
        element.trial(0.0, (0.0, 0.0), (0.5, 0.0))
        element.keep()
        for time, penetration, rate in ((1e-3, 5e-4, 0.4), (2e-3, 4e-4, -0.6), (3e-3, 0.0, -0.5), (4e-3, 3e-4, 0.5)):
            element.trial(time, (penetration, 0.0), (rate, 0.0))
            element.keep()
        # It separated at 0.4 mm, and does not touch again at 0.3 mm.
        self.assertEqual(len(element.impacts()), 1)
        self.assertGreater(element.impacts()[0]["v_separation"], 0)
        element.end()

    def test_an_elastic_contact_that_still_presses_has_lost_nothing(self):
        element = Element({"law": "hertz", "formula": "", "values": {"stiffness": 2e9}}, 0.0).connect()
        element.trial(0.0, (0.0, 0.0), (0.5, 0.0))
        element.keep()
        for i in range(1, 201):
            element.trial(1e-5 * i, (5e-6 * i, 0.0), (0.5, 0.0))
            element.keep()
        [impact] = element.impacts()
        stored = 2e9 * 1e-3**2.5 / 2.5
        self.assertAlmostEqual(impact["energy_stored"] / stored, 1, delta=1e-4)
        self.assertAlmostEqual(impact["energy_lost"] / stored, 0, delta=1e-3)
        element.end()

    def test_times_are_those_of_free_flight(self):
        impacts, _ = collide(HERTZ_DAMPED, 1e-4)
        free = pounding.laws["hertz_damped"](**HERTZ_DAMPED["values"]).free_impact(1.0, REDUCED)
        self.assertAlmostEqual(impacts[0]["t_start"], 0.01, delta=1e-12)
        self.assertAlmostEqual(impacts[0]["v_approach"], 1.0, delta=1e-12)
        self.assertAlmostEqual(impacts[0]["t_end"] - impacts[0]["t_start"], free.duration, delta=2e-3 * free.duration)


class Answers(unittest.TestCase):
    def setUp(self):
        self.element = Element(HERTZ_DAMPED).connect()
        self.addCleanup(self.element.process.kill)
        self.element.trial(0.0, (0.0, 0.0), (1.0, 0.0))

    def touch(self):
        self.element.trial(0.0101, (0.0101, 0.0), (1.0, 0.0))
        self.element.keep()

    def tearDown(self):
        self.assertEqual(self.element.end()[0], 0)

    def force(self, d, rate):
        self.element.trial(0.011, (0.01 + d, 0.0), (rate, 0.0))
        return self.element.forces(np.array([rate, 0.0]))

    def test_slopes_are_derivatives(self):
        self.touch()
        d, rate = 2e-3, 0.7
        self.force(d, rate)
        k, c = self.element.get(13), self.element.get(14)
        by_d = (self.force(d + 1e-7, rate) - self.force(d - 1e-7, rate)) / 2e-7
        by_rate = (self.force(d, rate + 1e-5) - self.force(d, rate - 1e-5)) / 2e-5
        for slopes, wanted in ((k, by_d), (c, by_rate)):
            np.testing.assert_allclose(
                slopes.reshape(2, 2), [[wanted[0], -wanted[0]], [-wanted[0], wanted[0]]], rtol=1e-6
            )
            self.assertGreater(wanted[0], 0)

    def test_force_pushes_apart_and_is_that_of_the_law(self):
        np.testing.assert_array_equal(self.force(2e-3, 0.7), 0)
        self.touch()
        law = pounding.laws["hertz_damped"](**HERTZ_DAMPED["values"])
        wanted = law.force(2e-3, 0.7, approach_velocity=1.0)
        np.testing.assert_allclose(self.force(2e-3, 0.7), [wanted, -wanted], rtol=1e-12)
        np.testing.assert_array_equal(self.force(-1e-9, 0.7), [0, 0])
        for action in (12, 15):
            np.testing.assert_array_equal(self.element.get(action), 0)

    def test_trial_states_leave_nothing_behind(self):
        self.force(2e-3, 0.7)
        self.assertEqual(self.element.impacts(), [])
        self.touch()
        first = self.force(2e-3, 0.7)
        for d in (5e-3, -1e-3, 1e-2):
            self.force(d, -0.3)
        np.testing.assert_array_equal(self.force(2e-3, 0.7), first)
        self.assertEqual(len(self.element.impacts()), 1)
        self.assertTrue(math.isnan(self.element.impacts()[0]["t_end"]))

    def test_closing_speed_is_that_at_the_touch(self):
        # From 4 mm apart at 1 m/s with 20 m/s^2, and past the touch at the end of the step.
        time, rate, opening, acceleration = 1e-3, 1.0, 4e-3, 20.0
        self.element.trial(time, (0.01 - opening, 0.0), (rate, 0.0), (acceleration, 0.0))
        self.element.keep()
        step = 5e-3
        self.element.trial(
            time + step,
            (0.01 - opening + rate * step + acceleration * step**2 / 2, 0.0),
            (rate + acceleration * step, 0.0),
        )
        self.element.keep()
        [impact] = self.element.impacts()
        at_touch = math.sqrt(rate**2 + 2 * acceleration * opening)
        self.assertAlmostEqual(impact["v_approach"], at_touch, delta=1e-12)
        self.assertAlmostEqual(impact["t_start"], time + (at_touch - rate) / acceleration, delta=1e-12)

    def test_what_is_no_number_is_answered_and_told(self):
        self.assertTrue(np.isnan(self.force(math.nan, 0.7)).all())
        self.assertIn("penetration", self.element.ask()["error"])
        # A rejected step is discarded.
        self.force(-1e-3, 0.7)
        self.element.keep()
        self.element.get(10)
        self.assertEqual(self.element.ask()["error"], "")


class Ends(unittest.TestCase):
    def test_without_an_element(self):
        element = Element(HERTZ_DAMPED)
        self.assertEqual(element.ask(), {"error": "", "connected": False, "impacts": []})
        self.assertEqual(element.close(), (0, []))

    def test_when_the_element_is_lost(self):
        element = Element(HERTZ_DAMPED).connect()
        element.connection.close()
        self.assertEqual(element.close()[0], 0)

    def test_not_before_the_element_does(self):
        element = Element(HERTZ_DAMPED).connect()
        element.process.stdin.close()
        element.trial(0.0, (0.0, 0.0), (1.0, 0.0))
        np.testing.assert_array_equal(element.get(10), 0)
        element.end()

    def test_with_what_the_law_refuses(self):
        element = Element({**HERTZ_DAMPED, "values": {"stiffness": -1.0, "restitution": 0.6}})
        self.assertIn("stiffness", element.first["error"])
        self.assertEqual(element.close(), (2, []))


class TimeToClose(unittest.TestCase):
    def test_is_the_first_root(self):
        for opening, rate, acceleration in (
            (0.1, 1.0, 2.0),
            (0.1, 1.0, -2.0),
            (0.1, -1.0, 3.0),
            (0.1, 1.0, 0.0),
            (0.0, 1.0, 1.0),
        ):
            s = time_to_close(opening, rate, acceleration)
            self.assertAlmostEqual(rate * s + acceleration * s * s / 2, opening, delta=1e-15)
            before = np.linspace(0, s, 50)[:-1]
            self.assertTrue(np.all(rate * before + acceleration * before**2 / 2 <= opening))
        for never in ((0.1, -1.0, 0.0), (0.1, 1.0, -20.0), (0.1, 0.0, -1.0), (0.1, 0.0, 0.0)):
            self.assertEqual(time_to_close(*never), math.inf)
        self.assertEqual(time_to_close(0.0, -1.0, -1.0), 0.0)


if __name__ == "__main__":
    unittest.main()
