"""Hysteretic laws along numpy paths."""

import pickle
import unittest

import numpy as np

import pounding
from messages import raises

STEEL = dict(stiffness="10 MN/m", yield_force="150 kN", hardening=0.05)


class Yielding(unittest.TestCase):
    def test_BoucWenIsAHyperbolicTangentOnFirstLoading(self):
        law = pounding.hysteresis["bouc_wen"](**STEEL | {"hardening": 0})
        d = np.linspace(0, 0.1, 50)
        np.testing.assert_allclose(law.follow(d).force, 150e3 * np.tanh(d / 0.015), rtol=0, atol=1e-6)

    def test_EveryLawForgetsWhereAWayIsCut(self):
        for name, kind in pounding.hysteresis.items():
            law = kind(
                **{
                    p.name: p.typical
                    for p in kind.parameters
                    if p.need in ("required", "optional", "or others instead")
                }
            )
            turns = np.array([2.5, -1.2, 0.4, -3.6, 1.0]) * law.yield_deformation
            fine = np.concatenate([np.linspace(a, b, 8)[1:] for a, b in zip([0, *turns[:-1]], turns)])
            coarse, cut = law.follow(turns), law.follow(fine)
            size = np.abs(coarse.force).max()
            np.testing.assert_allclose(cut.force[6::7], coarse.force, rtol=0, atol=1e-11 * size, err_msg=name)
            np.testing.assert_allclose(
                cut.work[6::7], coarse.work, rtol=0, atol=1e-10 * coarse.work.max(), err_msg=name
            )
            is_elastic = name in ("multilinear_elastic", "uplift")
            self.assertEqual(coarse.lost[-1] > 1e-9 * size * law.yield_deformation, not is_elastic, name)

    def test_RowsArePathsOfTheirOwn(self):
        law = pounding.hysteresis["menegotto_pinto"](**STEEL, memory="last")
        paths = 0.015 * np.random.default_rng(3).uniform(-4, 4, (2, 3, 20))
        loop = law.follow(paths)
        self.assertEqual(loop.force.shape, paths.shape)
        for i in range(2):
            for j in range(3):
                np.testing.assert_array_equal(loop.force[i, j], law.follow(paths[i, j]).force)

    def test_WhatIsWrongIsRefused(self):
        with raises(pounding.InputError, ["bouc_wenn", "bouc_wen"]):
            pounding.hysteresis["bouc_wenn"]
        with raises(pounding.InputError, ["yield_force", "-1"]):
            pounding.hysteresis["bilinear"](stiffness=1, yield_force=-1)
        with raises(pounding.InputError):
            pounding.hysteresis["bilinear"](**STEEL).follow([0, np.nan])
        with raises(pounding.InputError, ["lasst", "menegotto_pinto"]):
            pounding.hysteresis["menegotto_pinto"](**STEEL, memory="lasst")

    def test_ALawIsPickled(self):
        law = pounding.hysteresis["menegotto_pinto"](**STEEL, memory="last")
        again = pickle.loads(pickle.dumps(law))
        path = [0.05, -0.02, 0.01]
        np.testing.assert_array_equal(again.follow(path).force, law.follow(path).force)


if __name__ == "__main__":
    unittest.main()
