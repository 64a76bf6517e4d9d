"""Excessive sizes and costs are refused in advance; running out of memory is reported, and earlier results are kept."""

import os
import resource
import subprocess
import unittest

import h5py
from support import OSCILLATORS, PROGRAM, ProgramTest
from messages import assert_mentions

GRID = """\
structures:
  a:
    frame:
      material: {E: 30 GPa, density: 2500 kg/m^3}
      grid: {storeys: 1000, bays: 1000, storey_height: 3 m, bay_width: 5 m, columns: {rectangle: [0.5 m, 0.5 m]}, beams: {rectangle: [0.3 m, 0.5 m]}}
    damping: 5 %
analysis: {duration: 1}
"""
ROW = """\
structures: {{a: {{oscillator: {{mass: 100 t, period: {period}, damping: 5 %}}}}}}
analysis: {{{analysis}}}
"""


def within(gigabytes):
    """Limits the memory of a new process."""
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 1e9), int(gigabytes * 1e9)))


class Sizes(ProgramTest):
    def test_of_a_grid_are_bounded(self):
        self.refused(
            2, ["model.yaml:5:13", "structures.a.frame.grid", "1000", "1002001", "200000"], "check", self.write(GRID)
        )

    def test_that_the_memory_cannot_hold_are_refused_before_it_is_taken(self):
        path = self.write(GRID.replace("storeys: 1000, bays: 1000", "storeys: 300, bays: 300"))
        done = subprocess.run(
            [PROGRAM, "check", path], cwd=self.folder, capture_output=True, text=True, preexec_fn=within(1.5)
        )
        self.assertEqual(done.returncode, 2, done.stderr)
        assert_mentions(done.stderr, ["2.17 GB", "1.5 GB", "300", "90601"])

    def test_of_a_synthetic_motion_are_bounded(self):
        for words in ("duration: 1e9 s", "duration: 10 s, step: 1e-12", "duration: 1e300 s"):
            text = OSCILLATORS.replace(
                "harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}", f"synthetic: {{seed: 1, pga: 1.0, {words}}}"
            )
            with self.subTest(words=words):
                self.refused(2, "1e+07", "check", self.write(text))

    def test_of_histories_are_bounded_by_the_memory(self):
        storeys = ROW.format(period=0.5, analysis="duration: 90, output_step: 0.01 ms").replace(
            "oscillator: {mass: 100 t, period: 0.5", "shear_building: {storeys: 900, mass: 100 t, stiffness: 1e8"
        )
        self.refused(2, ["324 GB", "9e+06", "4.5e+03"], "check", self.write(storeys))


class Steps(ProgramTest):
    def test_without_hope_are_refused_at_the_start(self):
        hopeless = ROW.format(period="1e-9", analysis="duration: 1e6 s, output_step: 1 s")
        self.refused(
            2,
            ["model.yaml:2:11", "analysis", "analysis: {duration: 0.01 s}", "1e+06 s", "1e-09 s", "1e+16", "100000000"],
            "run",
            self.write(hopeless),
        )

    def test_that_patience_affords_say_what_to_type(self):
        many = ROW.format(period="0.1", analysis="duration: 1e6 s, output_step: 1000 s, most_steps: 50000000")
        self.refused(2, "{most_steps: 200000000}", "run", self.write(many))

    def test_end_at_the_budget_and_go_on(self):
        self.write(OSCILLATORS)
        self.assertEqual(self.pounding("run", "model.yaml", "-o", "whole.h5", "-q").returncode, 0)
        self.write(OSCILLATORS.replace("analysis: {", "analysis: {most_steps: 100, "), "short.yaml")
        cut = self.pounding("run", "short.yaml", "-o", "out.h5", "-q")
        self.assertEqual(cut.returncode, 3, cut.stderr)
        assert_mentions(cut.stderr, ["100", "pounding run", "--resume", "-pounding_ts_max_steps", "h5", "200"])
        on = self.pounding("run", "--resume", "out.h5", "-q", "-pounding_ts_max_steps", "1000000")
        self.assertEqual((on.returncode, on.stderr), (0, ""))
        with h5py.File(self.folder / "whole.h5") as whole, h5py.File(self.folder / "out.h5") as resumed:
            self.assertEqual(whole["impacts"][()].tobytes(), resumed["impacts"][()].tobytes())


class Memory(ProgramTest):
    def test_that_ends_is_told(self):
        """A row of bodies at rest, whose histories grow with every step, in little memory beyond the libraries."""
        text = OSCILLATORS.replace("duration: 3.0}}", "duration: 30000}}").replace(
            "{duration: 3.0}", "{duration: 30000, output_step: 4 ms}"
        )
        self.write(text)
        done = subprocess.run(
            [PROGRAM, "run", "model.yaml", "-q"],
            cwd=self.folder,
            capture_output=True,
            text=True,
            preexec_fn=within(0.75),
        )
        self.assertEqual(done.returncode, 3, done.stderr)
        assert_mentions(done.stderr, "memory")

    def test_for_a_text_is_told(self):
        """A model of nearly 16 MB, which the YAML reader turns into a tree."""
        with open(self.folder / "model.yaml", "w") as file:
            file.write(OSCILLATORS + "accept: [" + "mass," * 900_000 + "mass]\n")
        done = subprocess.run(
            [PROGRAM, "check", "model.yaml"], cwd=self.folder, capture_output=True, text=True, preexec_fn=within(0.75)
        )
        self.assertEqual(done.returncode, 3, done.stderr)
        assert_mentions(done.stderr, "memory")


class Progress(ProgramTest):
    def test_tells_after_a_second_how_long_the_rest_will_take(self):
        text = OSCILLATORS.replace("duration: 3.0}}", "duration: 200000}}").replace(
            "{duration: 3.0}", "{duration: 200000, output_step: 10 s}"
        )
        self.write(text)
        seen, screen = os.openpty()
        run = subprocess.Popen(
            [PROGRAM, "run", "model.yaml"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=screen
        )
        os.close(screen)
        shown = b""
        while b" left" not in shown:
            part = os.read(seen, 4096)
            self.assertTrue(part, shown[-200:])
            shown += part
        run.terminate()
        run.wait()
        os.close(seen)
        self.assertRegex(shown.decode(), r"impacts, [\d.]+ (s|min|h) left")


if __name__ == "__main__":
    unittest.main()
