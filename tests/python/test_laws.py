"""Laws on arrays: bitwise identical to the C++ laws, closed forms, shapes, and refusals."""

import copy
import json
import os
import pickle
import subprocess
import unittest

import numpy as np

import pounding
from messages import assert_mentions, raises

PROGRAM = os.environ["POUNDING_PROGRAM"]
MASS = 6e4


def printed(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def typical(name, **more):
    """The law with the typical values of its table and a restitution of 0.65."""
    kind = pounding.laws[name]
    given = {p.name: p.typical for p in kind.parameters if p.need in ("required", "optional")}
    if kind.takes_restitution:
        given["restitution"] = 0.65
    if kind.takes_reduced_mass:
        given["reduced_mass"] = MASS
    return kind(**{**given, **more})


def with_force_history():
    return [name for name, kind in pounding.laws.items() if not kind.instantaneous]


class Copies(unittest.TestCase):
    def test_of_every_law_have_the_same_bits(self):
        penetration, rate = np.random.default_rng(2).uniform([0, -1], [1e-2, 1], (100, 2)).T
        for name in with_force_history():
            law = typical(name)
            for copied in (pickle.loads(pickle.dumps(law)), copy.copy(law), copy.deepcopy(law)):
                self.assertEqual(repr(copied), repr(law))
                np.testing.assert_array_equal(
                    copied.force(penetration, rate, 0.5), law.force(penetration, rate, 0.5), name
                )
        self.assertIs(pickle.loads(pickle.dumps(pounding.laws)), pounding.laws)


class Forces(unittest.TestCase):
    def test_jankowski_is_its_formula_to_the_last_bit(self):
        law = pounding.laws["jankowski"](stiffness=2.75e9, damping_ratio=0.35, reduced_mass=MASS)
        penetration, rate = np.random.default_rng(1).uniform([-1e-3, -1], [1e-2, 1], (1000, 2)).T
        depth = np.maximum(penetration, 0)
        dashpot = 2 * 0.35 * np.sqrt(2.75e9 * MASS) * np.sqrt(np.sqrt(depth)) * rate
        expected = 2.75e9 * (depth * np.sqrt(depth)) + np.where(rate > 0, dashpot, 0)
        np.testing.assert_array_equal(law.force(penetration, rate), expected)

    def test_slopes_of_damped_hertz_are_its_derivatives(self):
        k, a, v, d, rate = 2e9, 0.4, 0.5, 3e-3, 0.2
        law = pounding.laws["hertz_damped"](stiffness=k, damping_factor=a)
        answer = law.respond(d, rate, approach_velocity=v)
        self.assertAlmostEqual(answer.force / (k * d**1.5 * (1 + a * rate / v)), 1, delta=1e-14)
        self.assertAlmostEqual(answer.by_penetration / (1.5 * k * d**0.5 * (1 + a * rate / v)), 1, delta=1e-14)
        self.assertAlmostEqual(answer.by_rate / (k * d**1.5 * a / v), 1, delta=1e-14)

    def test_arrays_are_their_elements(self):
        penetration, rate = np.array([[-1e-3], [0.0], [2e-3], [5e-3]]), np.array([-0.3, 0.0, 0.4])
        velocity = np.array([0.3, 0.5, 0.5])
        for name in with_force_history():
            with self.subTest(name):
                law = typical(name)
                answer = law.respond(penetration, rate, velocity)
                self.assertEqual([values.shape for values in answer], [(4, 3)] * 3)
                np.testing.assert_array_equal(law.force(penetration, rate, velocity), answer.force)
                for i, j in np.ndindex(4, 3):
                    one = law.respond(penetration[i, 0], rate[j], velocity[j])
                    self.assertEqual([values[i, j] for values in answer], list(one))

    def test_any_layout_and_type_of_array_will_do(self):
        law = typical("hertz")
        penetration = np.linspace(0, 1e-2, 24).reshape(4, 6)
        straight = law.force(penetration, 0.1)
        np.testing.assert_array_equal(law.force(penetration.T, 0.1), straight.T)
        np.testing.assert_array_equal(law.force(penetration[::2, ::-1], 0.1), straight[::2, ::-1])
        np.testing.assert_array_equal(law.force([0, 1], np.float32(0)), law.force(np.array([0.0, 1.0]), 0.0))
        self.assertEqual(law.force(np.empty((0, 3)), 0.0).shape, (0, 3))
        self.assertEqual(law.force(1e-3, 0.0).shape, ())

    def test_open_gap_gives_nothing_and_nan_stays_nan(self):
        for name in with_force_history():
            law = typical(name)
            self.assertEqual(law.respond(-1e-3, 0.5, 0.5), (0, 0, 0), name)
            self.assertTrue(np.isnan(law.respond([np.nan, 1e-3], [0.5, np.nan], 0.5)).all(), name)

    def test_approach_velocity_is_asked_for_where_it_matters(self):
        for name in with_force_history():
            kind = pounding.laws[name]
            direct = [p for p in kind.parameters if p.need == "instead of restitution"]
            laws = [typical(name)] if kind.takes_restitution or not direct else []
            laws += [typical(name, restitution=None, **{p.name: p.typical}) for p in direct]
            if kind.takes_impact_velocity:
                laws.append(typical(name, impact_velocity=0.4))
            for law in laws:
                with self.subTest(law=law):
                    slow, fast = (law.force(2e-3, 0.1, velocity) for velocity in (0.2, 0.9))
                    if slow == fast:
                        self.assertEqual(law.force(2e-3, 0.1), slow)
                    else:
                        with raises(pounding.InputError, [f"{name}", "approach_velocity"]):
                            law.force(2e-3, 0.1)

    def test_only_a_law_with_memory_depends_on_the_order(self):
        time = np.linspace(0, np.pi, 400)
        penetration, rate = 1e-2 * np.sin(time), 1e-2 * np.cos(time)
        for name in with_force_history():
            law = typical(name)
            in_order = law.force(penetration, rate, 0.5, in_order=True)
            alone = law.force(penetration, rate, 0.5)
            if name not in ("bilinear_hertz", "elastoplastic", "backfill", "elastic_plastic_gap"):
                np.testing.assert_array_equal(in_order, alone, name)
                continue
            self.assertAlmostEqual(
                np.trapezoid(alone, penetration) / np.trapezoid(alone[:200], penetration[:200]), 0, delta=1e-3
            )
            self.assertGreater(np.trapezoid(in_order, penetration), 0.1 * np.trapezoid(alone[:200], penetration[:200]))

    def test_mass_may_follow_later(self):
        whole = pounding.laws["jankowski"](stiffness=2.75e9, restitution=0.65, reduced_mass=MASS)
        without = pounding.laws["jankowski"](stiffness=2.75e9, restitution=0.65)
        self.assertEqual(without.force(1e-3, 0.3, reduced_mass="60 t"), whole.force(1e-3, 0.3))
        self.assertEqual(without.free_impact(0.5, MASS), whole.free_impact(0.5))
        with raises(pounding.InputError, ["reduced_mass", "jankowski"]):
            without.force(1e-3, 0.3)

    def test_no_mass_is_asked_for_where_none_is_needed(self):
        kelvin = pounding.laws["kelvin_voigt"](stiffness="100 MN/m", damping_coefficient="200 kN s/m")
        self.assertAlmostEqual(kelvin.force(1e-3, 0.3), 1e8 * 1e-3 + 2e5 * 0.3, delta=1e-9)
        self.assertNotIn("damping_ratio", kelvin.describe())
        bilinear = pounding.laws["bilinear_hertz"](
            initial_stiffness="400 MN/m", secondary_stiffness="100 MN/m", yield_penetration="1 mm"
        )
        self.assertAlmostEqual(bilinear.force(3e-3, 0.0), 4e8 * 1e-3 + 1e8 * 2e-3, delta=1e-6)
        self.assertEqual(list(bilinear.describe()), ["initial_stiffness", "secondary_stiffness", "yield_penetration"])
        with raises(pounding.InputError, "initial_stiffness"):
            pounding.laws["bilinear_hertz"](
                initial_stiffness=4e8, secondary_stiffness=1e8, yield_penetration=1e-3, stiffness=1e9
            )

    def test_crushing_is_remembered_in_order(self):
        law = pounding.laws["elastoplastic"](stiffness=1e8, exponent=1, restitution=0.5)
        penetration = np.array([2e-3, 5e-3, 4.5e-3, 3.75e-3, 3e-3, 5e-3, 6e-3])
        expected = np.array([2e5, 5e5, 3e5, 0, 0, 5e5, 6e5])
        np.testing.assert_allclose(law.force(penetration, 0.0, in_order=True), expected, atol=1e-6)


class FreeImpacts(unittest.TestCase):
    def test_elastic_impact_is_its_closed_form(self):
        k, speeds = 2.75e9, np.array([[0.1, 0.5], [1.0, 2.0]])
        impact = pounding.laws["hertz"](stiffness=k).free_impact(speeds, "60 t")
        depth = (2.5 * MASS * speeds**2 / (2 * k)) ** 0.4
        np.testing.assert_allclose(impact.peak_penetration, depth, rtol=1e-14)
        np.testing.assert_allclose(impact.peak_force, k * depth**1.5, rtol=1e-14)
        np.testing.assert_array_equal(impact.restitution, np.ones((2, 2)))
        self.assertIn("duration", impact.closed_form)

    def test_exact_formula_gives_what_is_asked(self):
        for name, kind in pounding.laws.items():
            if kind.takes_restitution:
                self.assertAlmostEqual(typical(name).free_impact(0.5, MASS).restitution, 0.65, delta=1e-9, msg=name)


class SameAsTheProgram(unittest.TestCase):
    def test_calibrate_is_the_command(self):
        words = {
            "restitution": ("0.5", 0.5),
            "m1": ("100 t", 1e5),
            "m2": ("150 t", "150 t"),
            "velocity": ("0.4", "0.4 m/s"),
        }
        for name, kind in pounding.laws.items():
            taken = {word: pair for word, pair in words.items() if word != "restitution" or kind.takes_restitution}
            command = [f"--{word}={pair[0]}" for word, pair in taken.items()]
            expected = printed("calibrate", f"--law={name}", "--json", *command)
            if kind.instantaneous:
                expected["formulas"][0]["peak_force"] = np.inf  # JSON has no infinity
            self.assertEqual(
                pounding.calibrate(name, **{word: pair[1] for word, pair in taken.items()}), expected, name
            )

    def test_law_is_calibrated_as_the_command_does(self):
        rows = printed("calibrate", "--law=hertz_damped", "--restitution=0.5", "--m1=60 t", "--velocity=0.4", "--json")[
            "formulas"
        ]
        for row in rows:
            law = pounding.laws["hertz_damped"](stiffness=2.75e9, restitution=0.5, formula=row["formula"])
            described = law.describe(0.4)
            self.assertEqual(described["damping_factor"], (row["damping_factor"], ""))
            self.assertEqual(law.free_impact(0.4, 6e4).restitution, row["restitution"])

    def test_tables_are_those_of_the_command(self):
        listed = printed("laws", "--json")
        self.assertEqual(list(pounding.laws), [law["name"] for law in listed])
        for law in listed:
            kind = pounding.laws[law["name"]]
            self.assertEqual([f.name for f in kind.formulas], [f["name"] for f in law["formulas"]])
            own = {p.name: (p.unit, p.typical) for p in kind.parameters}
            shown = {p["name"]: (p["unit"], p["typical"]) for p in law["parameters"] if p["name"] in own}
            self.assertEqual(own, shown)
            self.assertIn(kind.shape, str(kind))


class Refusals(unittest.TestCase):
    def refused(self, facts, call, *arguments, **named):
        with self.assertRaises(pounding.InputError) as caught:
            call(*arguments, **named)
        assert_mentions(str(caught.exception), facts)
        self.assertIsInstance(caught.exception, ValueError)

    def test_names_are_suggested(self):
        self.refused(["jankowsky", "jankowski"], pounding.laws.__getitem__, "jankowsky")
        self.refused(["JankowskiImpact", "jankowski"], pounding.laws.__getitem__, "JankowskiImpact")
        self.refused(["lankarani", "lankarani_nikravesh", "law: hertz_damped"], pounding.laws.__getitem__, "lankarani")
        self.refused(["HERTZ", "hertz"], pounding.laws.__getitem__, "HERTZ")
        self.refused(["stifness", "stiffness", "hertz"], pounding.laws["hertz"], stifness=1)
        self.refused(
            ["ye2009", "ye_2009", "hertz_damped"],
            pounding.laws["hertz_damped"],
            stiffness=1e9,
            restitution=0.5,
            formula="ye2009",
        )
        self.assertNotIn("jankowsky", pounding.laws)

    def test_units_are_read_and_checked(self):
        same = [pounding.laws["hertz"](stiffness=k).force(1e-3, 0.0) for k in (2.75e9, "2.75e9", "2750 MN/m^1.5")]
        self.assertEqual(len(set(same)), 1)
        self.refused(["stiffness", "2.75e9 N/m^1.5", "20 mm"], pounding.laws["hertz"], stiffness="20 mm")
        linear = pounding.laws["hertz"](stiffness="93500 kN/m", exponent=1)
        self.assertEqual(linear.force(1e-3, 0.0), 93500.0)

    def test_wrong_values_say_what_is_allowed(self):
        self.refused(["1.2", "restitution"], pounding.laws["hertz_damped"], stiffness=1e9, restitution=1.2)
        self.refused(["approach_velocity", "-1"], typical("hertz_damped").force, 0, 0, -1)
        self.refused("stereomechanical", pounding.laws["stereomechanical"](restitution=0.5).force, 0, 0)
        self.refused("0.65", pounding.calibrate, "jankowski", m1=1e5)


if __name__ == "__main__":
    unittest.main()
