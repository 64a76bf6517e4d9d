"""Texts that print() and the prompt show for each object: up to three informative lines, and never an array."""

import tempfile
import unittest
from pathlib import Path

import frame_samples
import pounding
from test_models import TWO_OSCILLATORS, two_oscillators


class Printing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = pounding.run(TWO_OSCILLATORS)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "frames.h5"
            frame_samples.write(path, 3)
            cls.frames = pounding.read(path)

    def assert_told(self, thing, *words):
        lines = str(thing).splitlines()
        self.assertIn(len(lines), range(1, 8), str(thing))
        self.assertTrue(all(len(line) < 300 and line.strip() for line in lines), str(thing))
        self.assertEqual(len(repr(thing).splitlines()), 1)
        self.assertNotIn("array(", str(thing) + repr(thing))
        for word in words:
            self.assertIn(word, str(thing))

    def test_results(self):
        self.assert_told(
            self.results,
            "Two oscillators under a harmonic ground motion",
            "done, 0 to 3 s",
            "left (1 floor)",
            "left-right (5 impacts, at most 7.178e+06 N)",
        )
        self.assertEqual(repr(self.results).split()[0], "<pounding.Run")
        self.assertNotIn("still pressed", str(self.results))

    def test_results_with_a_contact_that_still_presses(self):
        model = two_oscillators()
        start = self.results.impacts["t_peak"][0]
        model.analysis = {**model.analysis, "duration": float(start)}
        results = pounding.run(model)
        self.assert_told(results, "left-right (1 impact, at most", "still pressed")
        row, link = results.impacts[0], results.summary["links"][0]
        self.assertTrue(link["presses"])
        self.assertGreater(row["energy_stored"], 0)
        self.assertEqual((link["energy_stored"], link["energy_lost"]), (row["energy_stored"], row["energy_lost"]))
        self.assertIn("kJ stored", results._repr_html_())

    def test_parts_of_results(self):
        structure = next(one for one in self.frames.structures.values() if one.nodes and one.members)
        self.assert_told(
            structure, f"{structure.name}: frame in space, 5 floors", "m high", "along rz", "nodes", "members"
        )
        self.assert_told(structure.along["x"], "displacement (201, 5)", "storey_shear")
        self.assert_told(structure.geometry, "member_names m0, m1, m2, and", "floor_of_node", "at most 16")
        link = self.results.links["left-right"]
        self.assert_told(link, "left-right: jankowski, gap 20 mm, left", "largest force 7.178e+06 N", "to 3 s")

    def test_arrays_have_dimensions_units_and_peaks(self):
        structure = self.results.structures["left"]
        peak = abs(structure.acceleration).max()
        self.assert_told(
            structure.along["x"], f"acceleration {structure.acceleration.shape} [m/s^2], at most {peak:.4g}"
        )
        one = self.results.envelopes["left"]
        self.assertIn(
            f"drift (floor: 1, storey_direction: 1, extreme: 2) [m], at most {one.drift.peak.max():.4g}", str(one)
        )
        self.assertEqual(str(one).splitlines()[0], "name left, floors 1, directions x")

    def test_models_modes_and_films(self):
        self.assert_told(
            two_oscillators(),
            "2 structures, 1 link, ground motion harmonic",
            "left (oscillator)",
            "jankowski, gap 20 mm",
        )
        self.assert_told(pounding.Model({}), "0 structures")
        modes = pounding.modes(TWO_OSCILLATORS)
        self.assert_told(modes, "1 mode of left", "right: T = 0.4 s")
        self.assert_told(modes["left"][0], "period 0.8, damping_ratio 0.05", "participation (1,)")
        self.assert_told(self.results.animate(frames=3), "frames 3")

    def test_laws(self):
        law = pounding.laws["jankowski"](stiffness=2.75e9, restitution=0.65, reduced_mass=6e4)
        self.assert_told(
            law, 'laws["jankowski"](restitution=0.65, reduced_mass=60000.0, stiffness=2750000000.0)', "F = k d^1.5"
        )
        self.assert_told(law.free_impact(0.5), "restitution 0.65", "peak_force")
        self.assert_told(law.free_impact([0.1 * i for i in range(1, 20)]), "peak_force (19,), at most")


if __name__ == "__main__":
    unittest.main()
