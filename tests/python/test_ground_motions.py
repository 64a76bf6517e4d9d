"""Ground motions in users' files: many layouts compared with numpy's readers, closed forms compared with numpy's
functions."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from messages import assert_mentions

G = 9.80665
STEP = 0.02
NOISE = np.round(np.random.default_rng(7).normal(0, 0.2, 203), 4)


def grounded(motion, duration=4.0, step=STEP):
    """The run of an oscillator next to a wall on this ground, with an output every `step`."""
    return pounding.run(
        pounding.Model(
            ground_motion=motion,
            structures={
                "left": {"oscillator": {"mass": "100 t", "period": 0.8, "damping": "5 %"}},
                "right": {"wall": {}},
            },
            links=[{"between": ["left", "right"], "gap": "1 m", "law": "hertz", "stiffness": 1e9}],
            analysis={"duration": duration, "output_step": step, "tolerance": "1e-3"},
        ),
        progress=False,
    )


class Records(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, text):
        path = self.folder / "record.txt"
        path.write_text(text)
        return path

    def assert_ground(self, expected, words):
        """The ground of a run has these accelerations [m/s^2] at its output times, which are those of the samples."""
        run = grounded({"record": str(self.folder / "record.txt"), **words}, duration=STEP * (len(expected) - 1))
        np.testing.assert_allclose(run.time, STEP * np.arange(len(expected)), atol=1e-12)
        np.testing.assert_allclose(run.ground_acceleration[:-1], expected[:-1], rtol=1e-12, atol=1e-14)

    def test_values_one_and_eight_a_line(self):
        path = self.write("# acc (g)\n" + "\n".join(map(str, NOISE)))
        self.assert_ground(np.loadtxt(path) * G, {"step": "20 ms"})
        lines = [" ".join(f"{value:9.4f}" for value in NOISE[i : i + 8]) for i in range(0, len(NOISE), 8)]
        path = self.write("Nowhere 1999\nunits are (g)\n" + "\n".join(lines) + "\n*** End Data ***\n")
        read = np.array(" ".join(path.read_text().splitlines()[2:-1]).split(), float)
        self.assertEqual(len(read), len(NOISE))
        self.assert_ground(read * G, {"step": STEP})

    def test_columns_and_channels(self):
        times = STEP * np.arange(len(NOISE))
        rows = zip(times, NOISE, NOISE[::-1])
        path = self.write("time (s), NS (cm/s^2), EW (cm/s^2)\n" + "\n".join("%.2f, %.4f, %.4f" % row for row in rows))
        self.assert_ground(np.loadtxt(path, delimiter=",", skiprows=1, usecols=2) / 100, {"channel": 2})
        self.assert_ground(np.loadtxt(path, delimiter=",", skiprows=1, usecols=1) / 100, {"channel": "ns"})

    def test_decimal_commas(self):
        rows = [f"{i * STEP:.2f};{value:.4f}".replace(".", ",") for i, value in enumerate(NOISE)]
        path = self.write("Zeit [s];acceleration[m/s^2]\n" + "\n".join(rows))
        pointed = path.read_text().replace(",", ".").splitlines()
        self.assert_ground(np.loadtxt(pointed, delimiter=";", skiprows=1, usecols=1), {})
        path = self.write("\n".join(rows).replace(";", "\t"))
        self.assert_ground(np.loadtxt(path.read_text().replace(",", ".").splitlines(), usecols=1), {"units": "m/s^2"})

    def test_displacements_give_the_accelerations_of_a_clamped_spline(self):
        times = STEP * np.arange(len(NOISE))
        moved = 100 * np.sin(1.1 * times) ** 2 * np.exp(-0.3 * times)
        self.write("t [s], d [mm]\n" + "\n".join("%.2f, %.17g" % row for row in zip(times, moved)))
        count = len(times)
        matrix, right = np.zeros((count, count)), np.zeros(count)
        matrix[0, :2] = STEP / 3, STEP / 6
        right[0] = (moved[1] - moved[0]) / STEP
        for i in range(1, count - 1):
            matrix[i, i - 1 : i + 2] = STEP / 6, 2 * STEP / 3, STEP / 6
            right[i] = (moved[i + 1] - 2 * moved[i] + moved[i - 1]) / STEP
        matrix[-1, -1] = 1
        expected = np.linalg.solve(matrix, right) / 1000
        run = grounded({"displacement": {"record": str(self.folder / "record.txt")}}, duration=times[-1])
        np.testing.assert_allclose(run.ground_acceleration[:-1], expected[:-1], rtol=1e-9, atol=1e-12)

    def test_wrong_words_are_told(self):
        path = self.write("0.1\n0.2\n0.3\n")
        for words, message in (
            ({}, "step: 0.01 s"),
            ({"step": 0.01}, ["units:", "m/s^2", "cm/s^2"]),
            ({"step": "10 mm"}, ["step", "0.5 s", "10 mm"]),
        ):
            with self.subTest(words), self.assertRaises(pounding.InputError) as caught:
                grounded({"record": str(path), **words})
            assert_mentions(str(caught.exception), message)


class ClosedForms(unittest.TestCase):
    def test_phase_sum_and_displacement(self):
        w, v = 2 * np.pi / 0.6, 2 * np.pi / 0.25
        phase = np.radians(40)
        for motion, expected in (
            (
                {"harmonic": {"amplitude": 3, "period": 0.6, "duration": 5, "phase": "40 deg"}},
                lambda t: 3 * np.sin(w * t + phase),
            ),
            (
                {
                    "sum": [{"amplitude": 3, "period": 0.6}, {"amplitude": "0.1 g", "period": 0.25, "phase": "40 deg"}],
                    "duration": 5,
                    "initial_velocity": "0.1 m/s",
                },
                lambda t: 3 * np.sin(w * t) + 0.1 * G * np.sin(v * t + phase),
            ),
            (
                {"displacement": {"harmonic": {"amplitude": "20 mm", "period": 0.6, "duration": 5, "phase": "40 deg"}}},
                lambda t: -w * w * 0.02 * np.sin(w * t + phase),
            ),
        ):
            with self.subTest(motion):
                run = grounded(motion)
                np.testing.assert_allclose(run.ground_acceleration, expected(run.time), atol=1e-12)

    def test_wrong_words_are_told(self):
        with self.assertRaises(pounding.InputError) as caught:
            grounded({"harmonic": {"amplitude": 3, "period": 0.6, "duration": 5, "phase": 90}})
        assert_mentions(str(caught.exception), ["90 deg", "harmonic.phase", "-360 deg", "5156.62 deg"])


if __name__ == "__main__":
    unittest.main()
