"""Runs of the program in a temporary folder."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1] / "python"))
from messages import assert_mentions  # noqa: E402

PROGRAM = os.environ["POUNDING_PROGRAM"]
#: The program that starts several processes; None if pounding is built without MPI.
LAUNCHER = (
    None
    if os.environ.get("POUNDING_WITHOUT_MPI")
    else os.environ.get("POUNDING_MPIEXEC") or shutil.which("mpiexec") or shutil.which("mpirun")
)

#: Environment of runs on several processes: Open MPI refuses root and oversubscription by default.
SURROUNDINGS = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OPENBLAS_NUM_THREADS": "1",
}

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
#: Oscillators that run longer than any test waits.
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
#: A slender mast thrown against another one; both rotate by half a radian.
MASTS = (
    "structures:\n"
    + _MAST.format(name="mast", origin=0)
    + "    initial_velocity: 6 m/s\n"
    + _MAST.format(name="neighbour", origin=0.4)
    + "links: [{between: [mast, neighbour], gap: 400 mm, law: hertz_damped, stiffness: 1e7, restitution: 0.6}]\n"
    "analysis: {duration: 0.4, tolerance: 1e-5, output_step: 10 ms}\naccept: [mass]\n"
)
#: No step is short enough for this contact stiffness.
UNSOLVABLE = """\
structures:
  a: {body: {mass: 100 t}, initial_velocity: 1 m/s}
  b: {body: {mass: 150 t}}
links:
  - {between: [a, b], gap: 10 mm, law: hertz, stiffness: 1e300}
analysis: {duration: 0.2}
"""


def checksum(content):
    """The header of a results file with this content."""
    return f"results of pounding\nsize {len(content):020}\ncrc32 {zlib.crc32(content[512:]):08x}\n".encode()


def seal(path):
    """Updates the checksum of a results file that a test has changed."""
    content = path.read_bytes()
    text = checksum(content)
    path.write_bytes(text + content[len(text) :])


def is_sealed(path):
    """Whether the checksum of a results file is correct."""
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
        """Summary of the run of model.yaml that was cut after this number of steps and resumed in another process;
        `name` is its results file."""
        self.pounding("run", "model.yaml", "-q", "-o", name, "-pounding_ts_max_steps", str(steps))
        done = self.pounding("run", "--resume", name, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def refused(self, code, facts, *words):
        """Expects this exit code, and only a message with these facts on standard error."""
        done = self.pounding(*words)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
        assert_mentions(done.stderr, facts)
        self.assertTrue(done.stderr.startswith("pounding: "), done.stderr)


def bits(values):
    """Bytes of an array for bitwise comparison; arrays of texts by their values, since their bytes are addresses."""
    values = np.asarray(values)
    return repr(values.tolist()).encode() if values.dtype == object else values.tobytes()
