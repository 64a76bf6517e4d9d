"""A storey drift above analysis.collapse_drift ends the run, with status done."""

import json
import unittest

import h5py
import numpy as np

from support import ProgramTest
from messages import assert_mentions

#: A pulse that pushes a two-storey building far beyond its capacity.
MODEL = """\
ground_motion: {harmonic: {amplitude: 6.0, period: 2.0, duration: 2.0}}
structures:
  left:
    shear_building: {storeys: 2, mass: 200 t, stiffness: 60 MN/m, height: 3 m, yield_force: [0.9 MN, 2 MN], hardening: 0.02}
    damping: 5 %
  right: {oscillator: {mass: 100 t, period: 0.4, damping: 5 %}}
analysis: {duration: 4.0, tolerance: 1e-5, output_step: 1 ms}
"""
LIMIT = 0.02


def limited(limit=LIMIT):
    return MODEL.replace("analysis: {", f"analysis: {{collapse_drift: {100 * limit} %, ")


class Collapse(ProgramTest):
    def run_model(self, model, *words):
        self.write(model)
        return self.pounding("run", "model.yaml", "-o", "out.h5", *words)

    def test_ends_the_run_as_done_where_the_drift_is_reached(self):
        self.run_model(MODEL, "-q")
        with h5py.File(self.folder / "out.h5") as file:
            time, drift = file["time"][:], np.abs(file["structures/left/drift"][:, :])
        first = time[np.argmax(drift.max(axis=1) > LIMIT * 3)]
        self.assertTrue(0.2 < first < 2.0, "the pulse must push it that far")
        done = self.run_model(limited(), "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        status = json.loads(done.stdout)["status"]
        assert_mentions(status, ["done", "1", "2", "collapse_drift", "2 %"])
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(file.attrs["status"], status)
            end, drift = file["energy/time"][-1], np.abs(file["structures/left/drift"][:]).max()
        # The run ends with the step in which the drift was reached.
        self.assertTrue(first - 1.1e-3 <= end < first + 0.02, (first, end))
        self.assertLess(drift, 1.05 * LIMIT * 3)

    def test_is_told_in_the_report_and_not_resumed(self):
        done = self.run_model(limited())
        self.assertEqual(done.returncode, 0)
        assert_mentions(done.stdout, "collapse")
        again = self.pounding("run", "--resume", "out.h5")
        self.assertEqual(again.returncode, 2)
        assert_mentions(again.stderr, "out.h5")

    def test_of_the_run_without_links_is_told_too(self):
        # A stiff neighbour limits the drift: only the run without links collapses.
        neighbour = """\
  guard: {oscillator: {mass: 2000 t, period: 0.2, damping: 5 %}}
  rest: {oscillator: {mass: 2000 t, period: 0.2, damping: 5 %}}
links:
  - {between: [left.1, guard], gap: 10 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6}
  - {between: [rest, left.1], gap: 10 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6}
compare: no_pounding
analysis"""
        kept = limited().replace("  right: {oscillator: {mass: 100 t, period: 0.4, damping: 5 %}}\nanalysis", neighbour)
        done = self.run_model(kept)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        assert_mentions(done.stdout, ["collapse", "left", "1"])
        summary = json.loads(self.run_model(kept, "--json").stdout)
        self.assertEqual(summary["status"], "done")
        assert_mentions(summary["no_pounding"]["status"], ["done", "collapse"])
        # Its peaks are those of its first part, and no gap is enough.
        self.assertEqual(set(summary["no_pounding"]["amplification"]["left"]), {None})
        self.assertEqual([one["enough"] for one in summary["no_pounding"]["separations"]], [None, None])

    def test_heads_the_picture_of_the_run(self):
        self.run_model(limited(), "-q")
        self.assertEqual(self.pounding("plot", "out.h5", "-o", "out.svg").returncode, 0)
        words = (self.folder / "out.svg").read_text()
        assert_mentions(words, "collapse")

    def test_does_not_come_where_the_limit_is_not_reached(self):
        done = self.run_model(limited(0.9), "--json")
        self.assertEqual(json.loads(done.stdout)["status"], "done")

    def test_needs_heights(self):
        for model, words in (
            (limited().replace("height: 3 m, ", ""), ["height: 3 m", "collapse_drift"]),
            (limited().replace("height: 3 m, yield_force: [0.9 MN, 2 MN], hardening: 0.02", ""), ()),
            (limited(-0.1), "collapse_drift"),
        ):
            model = model.replace("60 MN/m, }", "60 MN/m}")
            done = self.run_model(model)
            self.assertEqual(done.returncode, 2, done.stdout)
            assert_mentions(done.stderr, words)


if __name__ == "__main__":
    unittest.main()
