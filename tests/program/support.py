"""Runs of the program in a folder of their own."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "python"))
from messages import assert_mentions  # noqa: E402

PROGRAM = os.environ["POUNDING_PROGRAM"]
#: The program that starts several processes; None where the program has no MPI.
LAUNCHER = (
    None
    if os.environ.get("POUNDING_WITHOUT_MPI")
    else os.environ.get("POUNDING_MPIEXEC") or shutil.which("mpiexec") or shutil.which("mpirun")
)

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
#: Oscillators that run for longer than any test waits.
LONG = OSCILLATORS.replace("duration: 3.0}}", "duration: 500}}").replace(
    "{duration: 3.0}", "{duration: 500, tolerance: 1e-9, output_step: 10 ms, integrator: generalized_alpha}"
)
_MAST = """\
  {name}:
    frame:
      origin: [{origin}]
      geometry: corotational
      gravity: true
      material: {{E: 10 GPa}}
      sections: {{s: {{area: 2 cm^2, inertia_y: 400 cm^4}}}}
      nodes: {{a: [0, 0], b: [0, 1], c: [0, 2], d: [0, 3], e: [0, 4]}}
      members: {{m1: {{between: [a, b], section: s}}, m2: {{between: [b, c], section: s}}, m3: {{between: [c, d], section: s}},
                m4: {{between: [d, e], section: s}}}}
      supports: {{a: fixed}}
      masses: {{b: 50, c: 50, d: 50, e: 50}}
      floors: [{{nodes: [e]}}]
      report: {{nodes: all, members: all}}
    damping: 1 %
"""
#: A slender mast that is thrown against another one; both turn by half a radian.
MASTS = (
    "structures:\n"
    + _MAST.format(name="mast", origin=0)
    + "    initial_velocity: 6 m/s\n"
    + _MAST.format(name="neighbour", origin=0.4)
    + "links: [{between: [mast, neighbour], gap: 400 mm, law: hertz_damped, stiffness: 1e7, restitution: 0.6}]\n"
    "analysis: {duration: 0.4, tolerance: 1e-5, output_step: 10 ms}\naccept: [mass]\n"
)
#: No step resolves a contact as stiff as this.
UNSOLVABLE = """\
structures:
  a: {body: {mass: 100 t}, initial_velocity: 1 m/s}
  b: {body: {mass: 150 t}}
links:
  - {between: [a, b], gap: 10 mm, law: hertz, stiffness: 1e300}
analysis: {duration: 0.2}
"""


def checksum(content):
    """The beginning of a results file of this content."""
    return f"results of pounding\nsize {len(content):020}\ncrc32 {zlib.crc32(content[512:]):08x}\n".encode()


def seal(path):
    """Gives a results file that a test has changed the checksum of what it holds now."""
    content = path.read_bytes()
    text = checksum(content)
    path.write_bytes(text + content[len(text) :])


def is_sealed(path):
    """Whether a results file is whole."""
    content = path.read_bytes()
    return content.startswith(checksum(content))


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, text, name="model.yaml"):
        (self.folder / name).write_text(text)
        return name

    def pounding(self, *words, **environment):
        return subprocess.run(
            [PROGRAM, *map(str, words)],
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=60,
            env=os.environ | environment,
        )

    def summary(self, *words):
        done = self.pounding("run", *words, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def resumed(self, steps, name):
        """Summary of the run of model.yaml that was cut after so many steps and went on in another process; its results
        file has this name."""
        self.pounding("run", "model.yaml", "-q", "-o", name, "-pounding_ts_max_steps", str(steps))
        done = self.pounding("run", "--resume", name, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def refused(self, code, facts, *words):
        """Nothing but a message that contains the facts, on standard error, and this exit code."""
        done = self.pounding(*words)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        assert_mentions(done.stderr, facts)
        self.assertTrue(done.stderr.startswith("pounding: "), done.stderr)
