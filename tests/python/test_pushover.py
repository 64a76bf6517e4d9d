"""Pushovers from Python: arrays, messages, files and pictures."""

import contextlib
import copy
import io
import os
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import pounding
from messages import assert_mentions, raises

TOWERS = {
    "old": {
        "shear_building": {
            "storeys": 2,
            "mass": "100 t",
            "stiffness": "100 MN/m",
            "yield_force": "1 MN",
            "hardening": 0.1,
            "height": "3 m",
        },
        "damping": "5 %",
    },
    "stiff": {"oscillator": {"mass": "100 t", "period": 0.2, "damping": "5 %"}},
}


def model():
    return pounding.Model(
        structures=copy.deepcopy(TOWERS),
        ground_motion={"harmonic": {"amplitude": 3, "period": 0.6, "duration": 3}},
        analysis={"duration": 1},
    )


class Pushover(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("error")
        self.addCleanup(warnings.resetwarnings)

    def test_gives_the_curve_of_two_storeys_in_series(self):
        found = pounding.pushover(model(), to="2 % roof")
        # Equal masses, heights 3 and 6 m: the upper storey carries two thirds. The lower one yields at 1 MN, the upper
        # one at 1.5 MN.
        first = 10e-3 + 2 / 3 * 10e-3
        np.testing.assert_allclose(found.displacement[:2], [0, first], rtol=1e-12)
        np.testing.assert_allclose(found.base_shear[1], 1e6, rtol=1e-12)
        np.testing.assert_allclose(found.displacement[2], 10e-3 + 0.5e6 / 10e6 + 10e-3, rtol=1e-12)
        self.assertEqual(found.displacement[-1], 0.12)
        np.testing.assert_allclose(found.floor_displacement[:, 1], found.displacement, rtol=1e-12)
        np.testing.assert_allclose(found.force, found.base_shear[:, None] * [1, 2 / 3], rtol=1e-9, atol=1e-3)
        self.assertEqual([event.parts for event in found.events], [["storey 1"], ["storey 2"]])
        self.assertEqual((found.mechanism, found.status, found.parts), (1, "done", ["storey 1", "storey 2"]))
        assert_mentions(str(found), ["mechanism 1", "overstrength 1.8", "base_shear (4,), at most 1.8e+06"])

    def test_takes_numbers_lists_and_cycles(self):
        same = pounding.pushover(model(), "old", to=0.12, load=[1, 2])
        np.testing.assert_allclose(
            same.base_shear, pounding.pushover(model(), "old", to="120 mm").base_shear, rtol=1e-12
        )
        cycles = pounding.pushover(model(), "old", cyclic=["1 %", -0.06], to=0.12)
        np.testing.assert_allclose(cycles.summary["targets"], [0.06, -0.06, 0.12], rtol=1e-15)
        self.assertIsNone(cycles.bilinear)

    def test_says_what_is_wrong(self):
        for message, arguments in (
            ("structure", {"structure": "odl", "to": 0.1}),
            (["to", "roof"], {}),
            ("structures.stiff", {"structure": "stiff", "to": 0.1}),
            (["load", "3", "2"], {"to": 0.1, "load": [1, 2, 3]}),
        ):
            with self.subTest(arguments=arguments), self.assertRaises(pounding.InputError) as raised:
                pounding.pushover(model(), **arguments)
            assert_mentions(str(raised.exception), message)

    def test_file_gives_the_same_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "out.h5"
            found = pounding.pushover(model(), to="2 %", output=path)
            read = pounding.read_pushover(path)
            for name in ("displacement", "base_shear", "floor_displacement", "deformation", "force"):
                np.testing.assert_array_equal(getattr(read, name), getattr(found, name))
            self.assertEqual((read.events, read.mechanism, read.parts), (found.events, found.mechanism, found.parts))
            with self.assertRaises(pounding.InputError):
                pounding.read(path)
            path.write_bytes(path.read_bytes()[:-1])
            with self.assertRaises(pounding.InputError):
                pounding.read_pushover(path)

    def test_picture_has_curve_events_and_two_lines(self):
        found = pounding.pushover(model(), to="2 %")
        for size in (None, (3.3, 3.2)):
            figure = found.plot(size=size)
            axes = figure.axes[0]
            np.testing.assert_allclose(axes.lines[0].get_xdata(), 1e3 * found.displacement)
            np.testing.assert_allclose(axes.lines[1].get_ydata()[-1], found.bilinear["base_shear"] / 1e6)
            self.assertEqual([text.get_text() for text in axes.texts], ["1", "2"])
            words = [text.get_text() for text in figure.legends[0].get_texts()]
            self.assertEqual(words, ["pushover", "two straight lines", "mechanism", "1  storey 1", "2  storey 2"])
            with tempfile.TemporaryDirectory() as folder:
                figure.savefig(os.path.join(folder, "curve.png"))


class Drawn(unittest.TestCase):
    def test_by_plot_from_its_file(self):
        from pounding import _plots as plots
        from pounding._checked_file import HoldsPushover
        from pounding._pictures.style import BadRequest

        with tempfile.TemporaryDirectory() as folder:
            path, picture = Path(folder) / "curve.h5", Path(folder) / "curve.png"
            pounding.pushover(model(), to="2 % roof", output=path)
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(plots.main([str(path), "-o", str(picture)]), 0)
                self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
            with raises(BadRequest, ["pushover", "--picture"]):
                plots.main([str(path), "-o", str(picture), "--picture", "hinges"])
            with raises(HoldsPushover, "read_pushover"):
                pounding.read(path)


if __name__ == "__main__":
    unittest.main()
