"""The program and the package on a PETSc without MPI: started as one process of several, they report it and run
nothing."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import PROGRAM
from messages import assert_mentions

MODEL = Path(os.environ["POUNDING_EXAMPLES"]) / "02_two_oscillators/model.yaml"
LAUNCHERS = ({"OMPI_COMM_WORLD_RANK": "0", "OMPI_COMM_WORLD_SIZE": "2"}, {"PMI_RANK": "0", "PMI_SIZE": "2"})


def done(*words, **variables):
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(words, cwd=folder, capture_output=True, text=True, env=os.environ | variables)
        return run.returncode, run.stdout, run.stderr, os.listdir(folder)


class SeveralProcesses(unittest.TestCase):
    def test_are_refused_by_the_program(self):
        for launcher in LAUNCHERS:
            code, printed, told, files = done(PROGRAM, "run", MODEL, "-o", "out.h5", **launcher)
            self.assertEqual((code, printed, files), (2, "", []))
            assert_mentions(told, ["2", "MPI"])

    def test_are_refused_once(self):
        code, printed, told, files = done(PROGRAM, "run", MODEL, OMPI_COMM_WORLD_RANK="1", OMPI_COMM_WORLD_SIZE="2")
        self.assertEqual((code, printed, told, files), (2, "", "", []))

    def test_are_refused_by_the_package(self):
        code, printed, told, files = done(
            sys.executable, "-c", f"import pounding; pounding.run({str(MODEL)!r})", **LAUNCHERS[0]
        )
        self.assertNotEqual(code, 0)
        assert_mentions(told, ["InputError", "MPI"])

    def test_are_fine_where_there_is_one(self):
        code, _, told, _ = done(PROGRAM, "run", MODEL, OMPI_COMM_WORLD_RANK="0", OMPI_COMM_WORLD_SIZE="1")
        self.assertEqual((code, told), (0, ""))


if __name__ == "__main__":
    unittest.main()
