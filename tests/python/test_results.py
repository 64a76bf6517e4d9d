"""The results file read with h5py and numpy only."""

import os
import random
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np
from messages import assert_mentions

WRITER = os.environ["POUNDING_RESULTS_WRITER"]


class ResultsFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.path = Path(cls.directory.name) / "towers.h5"
        subprocess.run([WRITER, "towers", cls.path], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def setUp(self):
        self.file = h5py.File(self.path)
        self.addCleanup(self.file.close)

    def test_attributes_are_text(self):
        attributes = dict(self.file.attrs)
        self.assertEqual(set(attributes), {"program", "version", "created", "title", "command", "status"})
        self.assertEqual(attributes["title"], "Two towers of six storeys, 40 mm apart")
        self.assertEqual(attributes["status"], "done")

    def test_every_dataset_says_what_it_is(self):
        units = {}

        def collect(name, item):
            if isinstance(item, h5py.Dataset) and (not item.is_scale or name == "time" or name.endswith("/time")):
                self.assertTrue(item.attrs["long_name"], name)
                units[name] = item.attrs["units"] if name != "impacts" else None

        self.file.visititems(collect)
        energies = ("input", "kinetic", "strain", "damping", "hysteretic", "impact", "error")
        expected = {
            "time": "s",
            "summary": "text",
            "impacts": None,
            "ground/time": "s",
            "ground/acceleration": "m/s^2",
            "energy/time": "s",
            "input/model.yaml": "text",
            "input/resolved.yaml": "text",
            **{f"energy/{name}": "J" for name in energies},
            **{f"solver/{name}": "1" for name in ("steps", "rejected", "events", "iterations")},
            **{f"solver/{name}": "s" for name in ("wall_seconds", "wall_setup", "wall_solve", "wall_output")},
        }
        for name in ("slender", "stiff"):
            motion = {
                "displacement": "m",
                "velocity": "m/s",
                "acceleration": "m/s^2",
                "drift": "m",
                "storey_shear": "N",
                "base_shear": "N",
            }
            expected |= {f"structures/{name}/{key}": unit for key, unit in motion.items()}
            del motion["velocity"]
            expected |= {f"envelopes/structures/{name}/{key}": unit for key, unit in motion.items()}
            expected |= {f"envelopes/structures/{name}/{key}_time": "s" for key in motion}
        for i in range(1, 7):
            series = {"time": "s", "penetration": "m", "velocity": "m/s", "force": "N", "energy": "J"}
            expected |= {f"links/slender.{i}-stiff.{i}/{key}": unit for key, unit in series.items()}
        self.assertEqual(units, expected)

    def test_shapes_are_time_by_floor_by_direction(self):
        samples = self.file["time"].size
        self.assertEqual(samples, 1601)
        for name in ("slender", "stiff"):
            structure = self.file["structures"][name]
            for motion in ("displacement", "velocity", "acceleration"):
                self.assertEqual(structure[motion].shape, (samples, 6, 1))
                self.assertEqual(list(structure[motion].attrs["floors"]), list("123456"))
                self.assertEqual(list(structure[motion].attrs["directions"]), ["x"])
                self.assertIsNotNone(structure[motion].chunks)
            for storey in ("drift", "storey_shear"):
                self.assertEqual(structure[storey].shape, (samples, 6))
        self.assertEqual(self.file["ground/acceleration"].shape, (samples,))

    def test_values_are_consistent(self):
        u = self.file["structures/stiff/displacement"][:, :, 0]
        drift = self.file["structures/stiff/drift"][:]
        self.assertGreater(np.abs(u).max(), 1e-3)
        np.testing.assert_allclose(np.cumsum(drift, axis=1), u, atol=1e-15)
        energy = {name: self.file["energy"][name][:] for name in self.file["energy"]}
        parts = sum(energy[name] for name in ("kinetic", "strain", "damping", "hysteretic", "impact", "error"))
        np.testing.assert_allclose(parts, energy["input"], atol=1e-9 * np.abs(energy["input"]).max())

    def test_order_is_that_of_the_input(self):
        self.assertEqual(list(self.file["structures"]), ["slender", "stiff"])
        self.assertEqual(list(self.file["links"]), [f"slender.{i}-stiff.{i}" for i in range(1, 7)])

    def test_impacts_are_a_structured_array(self):
        impacts = self.file["impacts"][:]
        self.assertEqual(
            impacts.dtype.names,
            (
                "link",
                "t_start",
                "t_end",
                "t_release",
                "v_approach",
                "v_separation",
                "restitution",
                "peak_force",
                "t_peak",
                "peak_penetration",
                "impulse",
                "energy_lost",
                "energy_stored",
            ),
        )
        self.assertEqual(len(self.file["impacts"].attrs["units"]), len(impacts.dtype.names))
        self.assertGreater(len(impacts), 3)
        self.assertTrue(np.all(impacts["t_start"] < impacts["t_peak"]))
        self.assertTrue(np.all(impacts["t_peak"] < impacts["t_end"]))
        np.testing.assert_array_equal(impacts["restitution"], impacts["v_separation"] / impacts["v_approach"])
        for impact in impacts:
            link = self.file["links"][impact["link"].decode()]
            inside = (link["time"][:] >= impact["t_start"]) & (link["time"][:] <= impact["t_end"])
            self.assertLess(abs(link["force"][:][inside].max() / impact["peak_force"] - 1), 0.2)

    def test_links_say_what_they_join(self):
        link = self.file["links/slender.6-stiff.6"]
        self.assertEqual((link.attrs["left"], link.attrs["left_floor"]), ("slender", 6))
        self.assertEqual((link.attrs["right"], link.attrs["right_floor"]), ("stiff", 6))
        self.assertEqual((link.attrs["gap"], link.attrs["gap_units"]), (0.04, "m"))
        self.assertEqual({link[name].shape for name in link}, {link["time"].shape})

    def test_texts_are_read_as_str(self):
        assert_mentions(self.file["input/model.yaml"].asstr()[()], ["title", "40 mm"])
        self.assertEqual(self.file["summary"].asstr()[()], '{"status": "done"}')


class KilledRun(unittest.TestCase):
    @staticmethod
    def state(path):
        """Marks of the file that change with every write."""
        status = path.stat()
        return status.st_ino, status.st_mtime_ns, status.st_size

    def test_file_is_complete_after_a_kill_at_any_moment(self):
        chance = random.Random(1940)
        seen, kills = set(), 0
        with tempfile.TemporaryDirectory() as directory:
            path = Path(directory) / "run.h5"
            subprocess.run([WRITER, "running", path], check=True)
            # On a loaded machine many kills may hit the same one of the two files that the writer alternates.
            while kills < 40 or (seen != {"running", "done"} and kills < 400):
                kills += 1
                writer = subprocess.Popen([WRITER, "forever", path])
                # The sample takes a moment to compute; kills before the first write would prove nothing.
                before = self.state(path)
                deadline = time.monotonic() + 20
                while self.state(path) == before:
                    self.assertLess(time.monotonic(), deadline, "the writer has not written")
                    time.sleep(0.002)
                time.sleep(chance.uniform(0, 0.03))
                writer.send_signal(signal.SIGKILL)
                writer.wait()
                with h5py.File(path) as file:
                    status = file.attrs["status"]
                    self.assertIn(status, ("running", "done"))
                    self.assertEqual(file["structures/left/displacement"].shape, (file["time"].size, 1, 1))
                    self.assertTrue(np.isfinite(file["energy/error"][:]).all())
                    seen.add(status)
            leftovers = [entry.name for entry in Path(directory).iterdir() if entry != path]
            self.assertLessEqual(len(leftovers), 1, "each run removes the leftovers of the killed one before it")
        self.assertEqual(seen, {"running", "done"})


if __name__ == "__main__":
    unittest.main()
