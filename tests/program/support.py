"""Runs of the program in a folder of their own."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["POUNDING_PROGRAM"]

#: Two oscillators that hit each other five times in three seconds.
OSCILLATORS = """\
title: Two oscillators
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
links:
  - {between: [left, right], gap: 20 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65}
analysis: {duration: 3.0}
"""
#: The same, for longer than any test waits.
LONG = OSCILLATORS.replace("duration: 3.0}}", "duration: 500}}").replace("{duration: 3.0}", "{duration: 500, tolerance: 1e-9, output_step: 10 ms}")
#: No step resolves a contact as stiff as this.
UNSOLVABLE = """\
structures:
  a: {body: {mass: 100 t}, initial_velocity: 1 m/s}
  b: {body: {mass: 150 t}}
links:
  - {between: [a, b], gap: 10 mm, law: hertz, stiffness: 1e300}
analysis: {duration: 0.2}
"""


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, text, name="model.yaml"):
        (self.folder / name).write_text(text)
        return name

    def pounding(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=60)

    def summary(self, *words):
        done = self.pounding("run", *words, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def refused(self, code, message, *words):
        """Nothing but the message, on standard error, and this exit code."""
        done = self.pounding(*words)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        self.assertIn(message, done.stderr)
        self.assertTrue(done.stderr.startswith("pounding: "), done.stderr)
