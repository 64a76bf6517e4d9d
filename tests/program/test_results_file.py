"""The results file of a run, read with h5py and numpy only."""

import json
import os
import unittest

import h5py
import numpy as np
from support import OSCILLATORS, UNSOLVABLE, ProgramTest, bits
from messages import assert_mentions


def datasets(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def without_clock(summary):
    values = json.loads(summary)
    del values["solver"]["wall_seconds"]
    return values


class ResultsFile(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(OSCILLATORS)
        self.printed = self.summary("model.yaml", "-o", "out.h5")
        self.path = self.folder / "out.h5"

    def test_says_units_and_meaning_of_every_dataset(self):
        bare = []

        def look(name, item):
            if isinstance(item, h5py.Dataset) and not {"units", "long_name"} <= set(item.attrs):
                bare.append(name)

        with h5py.File(self.path) as file:
            file.visititems(look)
            self.assertEqual(file.attrs["status"], "done")
            self.assertEqual(file["input/model.yaml"][()].decode(), OSCILLATORS)
            assert_mentions(file["input/resolved.yaml"][()].decode(), "formula")
            self.assertEqual(file["structures/left/displacement"].shape, (len(file["time"]), 1, 1))
        self.assertEqual(bare, [])

    def test_holds_the_summary_that_was_printed(self):
        with h5py.File(self.path) as file:
            kept = file["summary"][()].decode()
        del self.printed["solver"]["wall_seconds"]
        self.assertEqual(without_clock(kept), self.printed)

    def test_impacts_add_up_to_the_summary(self):
        link = self.printed["links"][0]
        with h5py.File(self.path) as file:
            impacts = file["impacts"][()]
        self.assertEqual(len(impacts), link["impacts"])
        self.assertEqual(impacts["peak_force"].max(), link["peak_force"])
        self.assertEqual(impacts["peak_penetration"].max(), link["peak_penetration"])
        self.assertAlmostEqual(impacts["impulse"].sum() / link["impulse"], 1, places=13)
        self.assertAlmostEqual(impacts["energy_lost"].sum() / link["energy_lost"], 1, places=13)
        np.testing.assert_allclose(impacts["restitution"], impacts["v_separation"] / impacts["v_approach"], rtol=1e-14)
        self.assertTrue((impacts["t_start"] < impacts["t_peak"]).all() and (impacts["t_peak"] < impacts["t_end"]).all())

    def test_histories_do_not_exceed_the_peaks(self):
        with h5py.File(self.path) as file:
            for name, peaks in self.printed["structures"].items():
                for quantity in ("displacement", "acceleration"):
                    largest = np.abs(file[f"structures/{name}/{quantity}"][()]).max()
                    self.assertLessEqual(largest, peaks[f"peak_{quantity}"][0] * (1 + 1e-9), (name, quantity))
                    self.assertGreater(largest, 0.5 * peaks[f"peak_{quantity}"][0], (name, quantity))
            force = file["links/left-right/force"][()]
        self.assertLessEqual(force.max(), self.printed["links"][0]["peak_force"] * (1 + 1e-12))
        self.assertGreater(force.max(), 0.999 * self.printed["links"][0]["peak_force"])
        self.assertEqual(force.min(), 0)

    def test_is_the_same_bit_by_bit_when_repeated(self):
        self.summary("model.yaml", "-o", "again.h5")
        first, second = datasets(self.path), datasets(self.folder / "again.h5")
        self.assertEqual(list(first), list(second))
        for name, values in first.items():
            if name == "summary":
                self.assertEqual(without_clock(values), without_clock(second[name]))
            elif "wall" not in name:
                self.assertEqual(bits(values), bits(second[name]), name)


class EarlierFile(ProgramTest):
    """An existing results file is kept if a run cannot start."""

    def setUp(self):
        super().setUp()
        self.summary(self.write(OSCILLATORS, "good.yaml"), "-o", "out.h5")
        self.before = (self.folder / "out.h5").read_bytes()

    def check(self):
        self.assertEqual((self.folder / "out.h5").read_bytes(), self.before)

    def test_survives_a_wrong_input(self):
        self.refused(2, "soft", "run", self.write(OSCILLATORS.replace("jankowski", "soft")), "--json", "-o", "out.h5")
        self.check()

    def test_survives_a_model_that_is_not_there(self):
        self.refused(2, "none.yaml", "run", "none.yaml", "--json", "-o", "out.h5")
        self.check()

    def test_survives_an_unknown_option(self):
        self.refused(2, "--fast", "run", "good.yaml", "--json", "-o", "out.h5", "--fast")
        self.check()

    @unittest.skipIf(os.geteuid() == 0, "for root every file can be written")
    def test_survives_when_it_is_write_protected(self):
        (self.folder / "out.h5").chmod(0o444)
        self.refused(2, "out.h5", "run", "good.yaml", "--json", "-o", "out.h5")
        self.check()

    def test_is_replaced_by_what_a_failed_solve_has_reached(self):
        self.refused(3, [], "run", self.write(UNSOLVABLE), "-q", "-o", "out.h5")
        with h5py.File(self.folder / "out.h5") as file:
            self.assertIn("failed", file.attrs["status"])

    def test_that_is_no_results_file_is_not_overwritten(self):
        (self.folder / "record.csv").write_text("0, 0\n1, 1\n")
        self.refused(2, "record.csv", "run", "good.yaml", "-q", "-o", "record.csv")
        self.refused(2, "good.yaml", "run", "good.yaml", "-q", "-o", "good.yaml")
        self.assertEqual((self.folder / "record.csv").read_text(), "0, 0\n1, 1\n")

    def test_survives_wrong_options_of_a_run_that_compares(self):
        compared = self.write((self.folder / "good.yaml").read_text() + "compare: no_pounding\n", "compared.yaml")
        before = (self.folder / "out.h5").read_bytes()
        self.refused(2, "-pounding_nothing", "run", compared, "-q", "-o", "out.h5", "-pounding_nothing", "1")
        self.assertEqual((self.folder / "out.h5").read_bytes(), before)

    def test_is_not_needed_for_a_place_that_cannot_be_written(self):
        self.refused(2, "mkdir -p", "run", "good.yaml", "--json", "-o", "none/out.h5")
        (self.folder / "taken").mkdir()
        self.refused(2, "taken", "run", "good.yaml", "--json", "-o", "taken")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["good.yaml", "out.h5", "taken"])


if __name__ == "__main__":
    unittest.main()
