"""Pushovers on the command line: printed output, written files, and refusals."""

import json
import unittest

import h5py
import numpy as np
from support import ProgramTest
from messages import assert_mentions

FRAME = """\
title: Hinges in a frame
structures:
  frame:
    frame:
      material: {E: 30 GPa}
      grid: {storeys: 3, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4], shear: false},
             beams: {rectangle: [0.3, 0.5], shear: false}, floor_mass: 40 t}
      hinges:
        beams: {at: both, bilinear: {yield_moment: 180 kN m, spring_hardening: 0.003}}
        columns: {at: feet, bilinear: {yield_moment: 250 kN m, spring_hardening: 0.003}}
    damping: 5 %
  building: {shear_building: {storeys: 2, mass: 100 t, stiffness: 100 MN/m, yield_force: 1 MN, hardening: 0.1, height: 3 m}, damping: 5 %}
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}
analysis: {duration: 1}
"""
#: A frame of one storey that falls when its hinges let it lean.
LEANING = """\
structures:
  frame:
    frame:
      material: {E: 30 GPa}
      geometry: p_delta
      gravity: true
      grid: {storeys: 1, bays: 1, storey_height: 4 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.4, 1.0]},
             floor_mass: 100 t}
      hinges: {columns: {at: both, yield_moment: 200 kN m}}
    damping: 5 %
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}
analysis: {duration: 1}
"""


class Pushover(ProgramTest):
    def test_prints_the_events_in_their_order(self):
        done = self.pounding("pushover", self.write(FRAME), "--structure", "frame", "--to", "250 mm")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        assert_mentions(
            done.stdout,
            [
                "22.2167",
                "154.1540",
                "1.0",
                "4",
                "71.9563",
                "224.0691",
                "3.0",
                "250.0000",
                "281.0893",
                "71.9563 mm",
                "224.0691 kN",
                "1.4535",
                "1.8234",
            ],
        )

    def test_json_and_file_hold_the_same(self):
        words = ("pushover", self.write(FRAME), "--structure", "building", "--cyclic", "1 %, -1 %", "--to", "2 % roof")
        printed = self.pounding(*words, "--json", "-o", "out.h5")
        self.assertEqual((printed.returncode, printed.stderr, printed.stdout.count("\n")), (0, "", 1))
        found = json.loads(printed.stdout)
        np.testing.assert_allclose(found["targets"], [0.06, -0.06, 0.12], rtol=1e-14)
        self.assertEqual(found["status"], "done")
        self.assertIsNone(found["bilinear"])
        with h5py.File(self.folder / "out.h5") as file:
            group = file["pushover"]
            for name, values in found["points"].items():
                np.testing.assert_array_equal(group[name][()], values)
                self.assertIn("units", group[name].attrs)
            self.assertEqual(list(group["parts"].asstr()[()]), ["storey 1", "storey 2"])
            self.assertEqual(group["events/point"].shape, group["events/kind"].shape)
            self.assertEqual(file["input/model.yaml"].asstr()[()], FRAME)

    def test_three_for_a_structure_that_collapses(self):
        done = self.pounding("pushover", self.write(LEANING), "--to", "25 % roof", "-o", "out.h5", "--json")
        self.assertEqual(done.returncode, 3)
        assert_mentions(done.stderr, "model.yaml")
        found = json.loads(done.stdout)
        assert_mentions(found["status"], "collapse")
        # 4 M/h = W u/h: the rectangle of two hinged columns.
        self.assertAlmostEqual(found["points"]["displacement"][-1], 4 * 200e3 / (100e3 * 9.80665), delta=0.02)
        self.assertAlmostEqual(found["points"]["base_shear"][-1], 0, delta=1)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertTrue(file["pushover"].attrs["status"].startswith("collapse: "))

    def test_two_for_words_that_do_not_fit(self):
        self.write(FRAME)
        for message, words in (
            (["--structure", "2"], ("--to", "1 %")),
            (["tower", "--structure"], ("--structure", "tower", "--to", "1 %")),
            (["250 mm", "--to"], ("--structure", "frame", "--to", "250")),
            ("--to", ("--structure", "frame")),
            (["structures.frame", "22.22 mm"], ("--structure", "frame", "--to", "5 mm")),
            (["none.txt", "--load"], ("--structure", "frame", "--to", "1 %", "--load", "none.txt")),
            ((), ("--structure", "frame", "--to", "1 %", "-o", "none/out.h5")),
        ):
            with self.subTest(words=words):
                done = self.pounding("pushover", "model.yaml", *words)
                self.assertEqual(done.returncode, 2, done.stderr)
                if "none/" not in words[-1]:
                    assert_mentions(done.stderr, message)

    def test_results_of_a_run_are_not_taken_from_it(self):
        self.pounding("pushover", self.write(FRAME), "--structure", "frame", "--to", "250 mm", "-o", "out.h5")
        self.assertEqual(self.pounding("run", "--resume", "out.h5").returncode, 2)

    def test_draws_the_curve(self):
        done = self.pounding("pushover", self.write(FRAME), "--structure", "frame", "--to", "250 mm", "--plot")
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout, "model_frame_pushover.png")
        self.assertTrue((self.folder / "model_frame_pushover.png").read_bytes().startswith(b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
