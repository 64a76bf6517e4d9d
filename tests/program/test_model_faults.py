"""As test_faults, for frames with hinges, storeys that yield, reduced frames, pushovers and studies. A study has its own three endings: the right
rows and exit code 0; a kill; or exit code 2 or 3 with a message. After the last two the same command goes on to the right rows."""

import errno
import os
import shutil
import signal
import sys
import unittest
from unittest import mock

import h5py
import test_faults
from small_models import PUSH, RUNS, STUDY
from test_faults import FaultTest, Served

tearDownModule = test_faults.tearDownModule
CHECKPOINTS = "checkpoint: {every_simulated: 0.1 s}\n"


class FaultsOfRuns:
    """Every kind of fault, in a run of the model of a class."""

    STEPS = 50  #: that it has at least

    def test_writes(self):
        self.each("write", errno.ENOSPC, "short", errno.EINTR)
        self.each("fsync", errno.EIO)
        self.each("open", errno.EMFILE)
        self.each("rename", errno.EIO, "kill")
        self.each("ftruncate", errno.EIO)

    def test_lack_of_memory_for_the_program_itself(self):
        self.some("own_memory", 5000, 3, self.tells)

    def test_lack_of_memory_for_petsc(self):
        self.crashes = 0
        self.some("petsc_memory", 100, 2, self.costs_no_file)
        self.assertLess(self.crashes, 6)

    def test_lack_of_memory_for_hdf5_costs_no_file(self):
        self.crashes = 0
        self.some("hdf5_memory", 1000, 2, self.costs_no_file)

    def test_signals_at_steps(self):
        self.signals_end_runs_that_go_on(self.STEPS)


class Hinges(FaultsOfRuns, FaultTest):
    MODEL = RUNS["hinges"] + CHECKPOINTS

    def test_lack_of_memory_for_the_program_itself(self):
        """More numbers than elsewhere: the sizes of many matrices follow the hinges that yield (core/renew.hpp)."""
        self.some("own_memory", 5000, 20, self.tells)


@unittest.skipUnless(test_faults.ALL, "alike to hinges")
class Storeys(FaultsOfRuns, FaultTest):
    MODEL = RUNS["storeys"] + CHECKPOINTS


class EndsOfRuns(FaultTest):
    """Each allocation while the summary and the file are made: a library of JSON uses an object that it could not make."""

    MODEL = RUNS["storeys"] + CHECKPOINTS

    def test_lack_of_memory(self):
        self.in_children("own_memory", self.count("own_memory") - 2500, self.tells)


class Reduced(FaultsOfRuns, FaultTest):
    MODEL = RUNS["reduced"] + CHECKPOINTS


class Pushover(FaultsOfRuns, FaultTest):
    MODEL = RUNS["hinges"]
    WORDS = ("pushover", "model.yaml", *PUSH)
    test_signals_at_steps = None


@unittest.skipUnless(os.environ.get("POUNDING_PACKAGE"), "needs the compiled part of the Python package")
class Study(FaultTest):
    """Rows by the kernel, some by the solver, too; in one process, which the faults can reach."""

    COMMAND = ("-m", "pounding", "study", "study.yaml", "-q", "-j", "0", "--chunk", "3", "-o", "out.h5")

    def setUp(self):
        super(FaultTest, self).setUp()
        self.write(STUDY, "study.yaml")
        self.path = self.folder / "out.h5"
        self.served, self.again = self.python(*self.COMMAND), self.python(*self.COMMAND)
        self.start_again()
        self.assertEqual(self.run_with("none", 0, 0).returncode, 0)
        self.right = self.rows()

    def python(self, *words):
        with mock.patch.dict(os.environ, {"PYTHONPATH": os.environ["POUNDING_PACKAGE"]}):
            served = Served(self.folder, *words, program=sys.executable)
        self.addCleanup(served.close)
        return served

    def start_again(self):
        self.path.unlink(missing_ok=True)
        shutil.rmtree(self.folder / "out.h5.parts", ignore_errors=True)

    def rows(self):
        with h5py.File(self.path) as file:
            return {name: data[()].tobytes() for group in ("rows", "check") for name, data in file[group].items() if data.dtype.kind != "O"}

    def fails(self, call, number, kind):
        self.start_again()
        done = self.served.run(call, number, kind)
        test_faults.ENDINGS["Study", call, done.returncode, self.path.exists()] += 1
        if kind == "kill":
            self.assertEqual(done.returncode, -signal.SIGKILL)
        elif done.returncode != 0:
            self.assertIn(done.returncode, (2, 3), done.stderr)
            self.assertRegex(done.stderr, r"\Apounding: ")
            self.assertNotIn("Traceback", done.stderr)
        if done.returncode != 0:
            again = self.again.run("none", 0, 0)
            self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertEqual(self.rows(), self.right)

    def all(self, call, *kinds):
        self.start_again()
        count = self.count(call)
        self.assertGreater(count, 1)
        for kind in kinds:
            for number in self.numbers(count):
                with self.subTest(call=call, kind=kind, number=number, of=count):
                    self.fails(call, number, kind)

    def numbers(self, count):
        return super().numbers(count) if test_faults.ALL else sorted({1, count // 2, count})

    def run_with(self, call, number, kind):
        return self.served.run(call, number, kind)

    def test_writes(self):
        self.all("write", errno.ENOSPC, "short", "kill")
        self.all("open", errno.EMFILE, "kill")
        self.all("rename", errno.EIO, "kill")
        self.all("fsync", errno.EIO)

    def test_lack_of_memory_for_the_kernel(self):
        """But for what is asked for while the package is loaded, where C++ ends a process that gets no memory."""
        self.assertEqual(self.python("-c", "import pounding.studies.command").run("own_memory", 0, 0).returncode, 0)
        loaded = int((self.folder / "count").read_text())
        self.start_again()
        count = self.count("own_memory")
        self.assertGreater(count, loaded + 500)
        for number in range(loaded + 1, count + 1, test_faults.EVERY or (count - loaded) // 3):
            with self.subTest(number=number, of=count):
                self.fails("own_memory", number, errno.ENOMEM)


if __name__ == "__main__":
    unittest.main()
