"""States of contacts that step in time, against the whole histories of `Law.force(in_order=True)` and free impacts."""

import copy
import unittest

import numpy as np

import pounding
from messages import raises
from pounding.errors import InputError

MASS, SPEED = 6e4, 0.5


def law_of(name):
    kind = pounding.laws[name]
    given = {p.name: p.typical for p in kind.parameters if p.need == "required"}
    if kind.takes_restitution:
        given["restitution"] = 0.65
    if kind.takes_reduced_mass:
        given["reduced_mass"] = MASS
    return kind(**given)


def bounce(law, steps=4000):
    """A free impact of a body at SPEED by the trapezoidal rule: (separation speed, peak force)."""
    state, peak = law.start(), 0.0
    step = 3 * law.free_impact(SPEED, reduced_mass=MASS).duration / steps
    d, v = 0.0, SPEED
    state.touch(SPEED)
    for _ in range(steps):
        f0 = state.respond(d, v)[0]
        mid = state.respond(d + 0.5 * step * v, v - 0.5 * step * f0 / MASS)[0]
        d, v = d + step * (v - 0.5 * step * f0 / MASS), v - step * mid / MASS
        state.accept(d, v)
        peak = max(peak, state.respond(d, v)[0])
        if not state.touching:
            break
    return -v, peak


class States(unittest.TestCase):
    def test_steps_reproduce_free_impacts(self):
        for name in ("hertz_damped", "jankowski", "kelvin_voigt_no_tension", "bilinear_hertz"):
            with self.subTest(name):
                law = law_of(name)
                speed, peak = bounce(law)
                exact = law.free_impact(SPEED, reduced_mass=MASS)
                self.assertAlmostEqual(speed / SPEED, float(exact.restitution), delta=2e-3)
                self.assertAlmostEqual(peak / float(exact.peak_force), 1, delta=2e-3)

    def test_states_in_order_are_those_of_the_law(self):
        law = law_of("bilinear_hertz")
        depths = np.concatenate([np.linspace(1e-4, 8e-3, 40), np.linspace(8e-3, 1e-4, 40)])
        rates = np.concatenate([np.full(40, SPEED), np.full(40, -0.3)])
        expected = law.respond(depths, rates, SPEED, in_order=True)
        state = law.start()
        state.touch(SPEED)
        for i, (d, v) in enumerate(zip(depths, rates)):
            before = state.respond(d, v)
            self.assertEqual(before, state.respond(d, v))  # changes nothing
            np.testing.assert_allclose(before, [one[i] for one in expected], rtol=1e-12)
            state.accept(d, v)
        self.assertEqual(state.largest_penetration, depths.max())

    def test_accept_finds_touch_and_separation(self):
        state = law_of("hertz_damped").start()
        state.accept(-1e-3, 0.4)
        self.assertFalse(state.touching)
        self.assertEqual(state.respond(1e-3, 0.4), (0, 0, 0))
        state.accept(1e-5, 0.4)
        self.assertTrue(state.touching)
        self.assertEqual(state.closing_speed, 0.4)
        self.assertGreater(state.respond(1e-3, 0.4)[0], 0)
        state.accept(-1e-5, -0.3)
        self.assertFalse(state.touching)

    def test_copies_undo_steps(self):
        state = law_of("elastoplastic").start()
        state.touch(0.5)
        state.accept(2e-2, 0.4)
        for kept in (state.copy(), copy.copy(state), copy.deepcopy(state)):
            before = kept.respond(1.5e-2, -0.1)
            state.accept(5e-2, 0.2)
            self.assertEqual(kept.respond(1.5e-2, -0.1), before)
            self.assertNotEqual(state.respond(1.5e-2, -0.1), before)
            self.assertEqual(kept.largest_penetration, 2e-2)

    def test_indentation_remains(self):
        state = law_of("elastoplastic").start()
        state.touch(1.0)
        state.accept(5e-2, 0.1)
        state.separate(1e-3)
        self.assertGreater(state.indentation, 0)

    def test_refusals(self):
        state = law_of("hertz_damped").start()
        with raises(InputError, ["touch"]):
            state.separate()
        state.touch(0.1)
        with raises(InputError, ["separate"]):
            state.touch(0.1)
        with raises(InputError, ["penetration"]):
            state.respond("deep", 0.1)
        with raises(InputError, ["stereomechanical"]):
            law_of("stereomechanical").start()
        with raises(InputError, ["reduced_mass"]):
            pounding.laws["jankowski"](stiffness=2.75e9, restitution=0.65).start()


if __name__ == "__main__":
    unittest.main()
