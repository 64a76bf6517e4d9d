"""The study kernel from Python: input and output columns, and a reason for each row that cannot run."""

import threading
import unittest

import numpy as np

from pounding import _core
from pounding.errors import InputError
from messages import raises

TIMES = 0.02 * np.arange(501)
GROUND = np.sin(0.3 * TIMES) * (2.5 * np.sin(4.3 * TIMES) + 2 * np.sin(9.1 * TIMES) + np.sin(23 * TIMES))
ROWS = 40


def pairs():
    part = np.linspace(0, 1, ROWS)
    return {
        "mass_left": 1e5,
        "mass_right": 1.5e5,
        "period_left": 0.3 + part,
        "period_right": 1.1 - 0.8 * part**2,
        "damping_left": 0.05,
        "damping_right": 0.05,
        "gap": 0.03 * part,
    }


def run(columns, parameters=None, **options):
    given = parameters or {"stiffness": 2.75e9, "restitution": 0.65}
    return _core.study_pairs(
        columns, options.pop("law", "hertz_damped"), options.pop("formula", ""), given, GROUND, 0.02, **options
    )


class StudyKernel(unittest.TestCase):
    def test_ChunksAndThreadsGiveTheSameBits(self):
        whole = run(pairs(), accelerations=True, required_gap=True)
        self.assertGreater(whole["impacts"].sum(), 50)
        parts = [None] * 4

        def work(k):
            part = slice(10 * k, 10 * k + 10)
            columns = {name: values[part] if np.ndim(values) else values for name, values in pairs().items()}
            parts[k] = run(columns, accelerations=True, required_gap=True)

        threads = [threading.Thread(target=work, args=(k,)) for k in reversed(range(4))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for name, values in whole.items():
            if name != "reasons":
                np.testing.assert_array_equal(np.concatenate([part[name] for part in parts]), values, err_msg=name)

    def test_TheRequiredGapKeepsAThousandPairsApart(self):
        generator = np.random.default_rng(17)
        columns = {
            "mass_left": 1e5,
            "mass_right": 1e5 * 4 ** (generator.random(1000) - 0.5),
            "period_left": 0.2 * 10 ** generator.random(1000),
            "period_right": 0.2 * 10 ** generator.random(1000),
            "damping_left": 0.1 * generator.random(1000),
            "damping_right": 0.05,
            "gap": 0.01,
        }
        need = run(columns, required_gap=True)["required_gap"]
        self.assertEqual(run({**columns, "gap": need * (1 + 1e-6)})["impacts"].max(), 0)
        self.assertGreaterEqual(run({**columns, "gap": need * (1 - 1e-6)})["impacts"].min(), 1)

    def test_AFactorScalesTheRecordAndADampingOfItsOwnARow(self):
        one = run({**pairs(), "factor": 2.0})
        other = _core.study_pairs(
            pairs(), "hertz_damped", "", {"stiffness": 2.75e9, "restitution": 0.65}, 2 * GROUND, 0.02
        )
        np.testing.assert_array_equal(one["peak_force"], other["peak_force"])
        soft = run(pairs(), {"stiffness": 2.75e9, "restitution": np.linspace(0.4, 0.9, ROWS)})
        self.assertEqual(
            soft["peak_force"][12],
            run(
                {k: v[12] if np.ndim(v) else v for k, v in pairs().items()},
                {"stiffness": 2.75e9, "restitution": np.linspace(0.4, 0.9, ROWS)[12]},
            )["peak_force"][0],
        )

    def test_ARowThatIsRefusedHasAReasonAndCostsNoOther(self):
        columns = pairs()
        whole = run(columns)
        columns["gap"] = columns["gap"].copy()
        columns["gap"][7] = -0.01
        found = run(columns)
        self.assertEqual(found["reasons"], {7: "gap must be finite and not negative"})
        self.assertTrue(np.isnan(found["peak_force"][7]))
        np.testing.assert_array_equal(np.delete(found["peak_force"], 7), np.delete(whole["peak_force"], 7))

    def test_WrongColumnsAreRefusedBeforeAnyRow(self):
        for columns, text in (
            ({**pairs(), "gap": np.ones(3)}, ["gap", "3", "40"]),
            ({**pairs(), "mass": 1.0}, "mass"),
            ({k: v for k, v in pairs().items() if k != "gap"}, "gap"),
        ):
            with raises(InputError, text):
                run(columns)
        with raises(InputError, "hertz_damped"):
            run(pairs(), law="hertz_damp")

    def test_AModelRunsForEveryFactorOfTheRecord(self):
        text = """
ground_motion: {harmonic: {amplitude: 1.0, period: 1.0, duration: 1.0}}
structures:
  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
links:
  - {between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}
analysis: {duration: 1.0}
"""
        self.assertEqual(_core.needs_solver(text, "model.yaml"), "")
        model = _core.linear_model(text, "model.yaml", True)
        self.assertEqual((model.modes, model.links, model.outputs), (2, 1, 6))
        factors = np.array([0.5, 1.0, 2.0])
        found = _core.study_model(model, GROUND, 0.02, factors)
        self.assertEqual(found["outputs"].shape, (3, 6))
        expected = run(
            {
                "mass_left": 1e5,
                "mass_right": 1.5e5,
                "period_left": 0.8,
                "period_right": 0.4,
                "damping_left": 0.05,
                "damping_right": 0.05,
                "gap": 0.02,
                "factor": factors,
            },
            accelerations=True,
        )
        # Modes of the model have different round-off from those of the pair.
        left, right = (
            [expected["displacement"][:, k], expected["displacement"][:, k], expected["acceleration"][:, k]]
            for k in (0, 1)
        )
        np.testing.assert_allclose(found["outputs"], np.column_stack([*left, *right]), rtol=1e-6)
        np.testing.assert_allclose(found["peak_force"], expected["peak_force"], rtol=1e-6)
        self.assertIn(
            "solver", self.refusal(text.replace("law: hertz_damped, stiffness: 2.75e9", "law: stereomechanical"))
        )

    def refusal(self, text):
        with self.assertRaises(InputError) as caught:
            _core.linear_model(text, "model.yaml")
        return str(caught.exception)


if __name__ == "__main__":
    unittest.main()
