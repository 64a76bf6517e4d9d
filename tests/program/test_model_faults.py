"""As test_faults, for frames with hinges, storeys that yield, reduced frames, pushovers and studies. A study has its
own three endings: the right rows and exit code 0; a kill; or exit code 2 or 3 with a message. After the last two the
same command goes on to the right rows."""

import errno
import os
import shutil
import signal
import subprocess
import sys
import unittest
from unittest import mock

import h5py
import test_faults
from small_models import FEW_COORDINATES, FEW_HINGES, FEW_ROWS, PUSH, RUNS, STUDY
from test_faults import FaultTest, LacksOfMemory, Served

tearDownModule = test_faults.tearDownModule
#: pybind11 ends a process fewer times than this where each allocation of a study fails once, as it registers an object
#: or forgets one.
MOST_CRASHES_OF_PYBIND11 = 16
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
        self.some("petsc_memory", 50, 2, self.costs_no_file)
        self.assertLess(self.crashes, test_faults.MOST_CRASHES_OF_PETSC)

    def test_lack_of_memory_for_hdf5_costs_no_file(self):
        self.crashes = 0
        self.some("hdf5_memory", 1000, 2, self.costs_no_file)

    def test_signals_at_steps(self):
        self.signals_end_runs_that_go_on(self.STEPS)


class Hinges(FaultsOfRuns, FaultTest):
    MODEL = RUNS["hinges"] + CHECKPOINTS
    MANY = 20  #: Every one in LackOfMemoryWithHinges.

    def test_lack_of_memory_for_the_program_itself(self):
        """More numbers than elsewhere: the sizes of many matrices follow the hinges that yield (core/renew.hpp)."""
        self.some("own_memory", 5000, 20, self.tells)


@unittest.skipUnless(test_faults.ALL, "alike to hinges")
class Storeys(FaultsOfRuns, FaultTest):
    MODEL = RUNS["storeys"] + CHECKPOINTS


class LackOfMemoryWithHinges(LacksOfMemory, FaultTest):
    MODEL = FEW_HINGES + CHECKPOINTS


class LackOfMemoryWhereReduced(LacksOfMemory, FaultTest):
    MODEL = FEW_COORDINATES + CHECKPOINTS


class EndsOfRuns(FaultTest):
    """Each allocation while the summary and the file are made: a library of JSON uses an object that it could not
    make."""

    MODEL = RUNS["storeys"] + CHECKPOINTS

    def test_lack_of_memory(self):
        self.in_children("own_memory", self.count("own_memory") - 2500, self.tells)


class Reduced(FaultsOfRuns, FaultTest):
    MODEL = RUNS["reduced"] + CHECKPOINTS
    MANY = 200  #: Every one in LackOfMemoryWhereReduced.


class Pushover(FaultsOfRuns, FaultTest):
    MODEL = RUNS["hinges"]
    WORDS = ("pushover", "model.yaml", *PUSH)
    test_signals_at_steps = None


@unittest.skipUnless(os.environ.get("POUNDING_PACKAGE"), "needs the compiled part of the Python package")
class Study(FaultTest):
    """Rows by the kernel, some by the solver, too; in one process, which the faults can reach."""

    MODEL = STUDY
    COMMAND = ("-m", "pounding", "study", "study.yaml", "-q", "-j", "0", "--chunk", "3", "-o", "out.h5")

    def setUp(self):
        super(FaultTest, self).setUp()
        self.write(self.MODEL, "study.yaml")
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

    def rows(self, path=None):
        with h5py.File(path or self.path) as file:
            return {
                name: data[()].tobytes()
                for group in ("rows", "check")
                for name, data in file[group].items()
                if data.dtype.kind != "O"
            }

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

    def counts(self):
        """How many allocations there are until the package is loaded, and in all."""
        self.assertEqual(self.python("-c", "import pounding.studies.command").run("own_memory", 0, 0).returncode, 0)
        loaded = int((self.folder / "count").read_text())
        self.start_again()
        count = self.count("own_memory")
        self.assertGreater(count, loaded + 500)
        return loaded, count

    def test_writes(self):
        self.all("write", errno.ENOSPC, "short", "kill")
        self.all("open", errno.EMFILE, "kill")
        self.all("rename", errno.EIO, "kill")
        self.all("fsync", errno.EIO)

    def test_lack_of_memory_for_the_kernel(self):
        """Few, with the command again after each of them: StudyLacksMemory takes more."""
        loaded, count = self.counts()
        for number in range(loaded + 1, count + 1, (count - loaded) // 3):
            with self.subTest(number=number, of=count):
                self.fails("own_memory", number, errno.ENOMEM)


@unittest.skipUnless(os.environ.get("POUNDING_PACKAGE"), "needs the compiled part of the Python package")
class StudyLacksMemory(Study):
    """The kernel and the solver, in children of one interpreter."""

    MODEL = FEW_ROWS
    COMMAND = ("-m", "pounding", "study", "study.yaml", "-q", "-j", "0", "--chunk", "1", "-o", "out.h5")
    #: Folders of children that are kept at a time.
    AT_ONCE = 1000
    test_writes = None

    def state(self, folder):
        """Tells apart what a command finds that goes on in a folder."""
        parts = (
            sorted(path.name for path in (folder / "out.h5.parts").iterdir())
            if (folder / "out.h5.parts").exists()
            else None
        )
        return str(parts), (folder / "out.h5").exists() and str(self.rows(folder / "out.h5"))

    def in_children(self, first, last, stride):
        run = self.folder / "run"
        shutil.rmtree(run, ignore_errors=True)
        run.mkdir()
        shutil.copy(self.folder / "study.yaml", run)
        settings = {
            "LD_PRELOAD": test_faults.SHIM,
            "POUNDING_FAULT_CALL": "own_memory",
            "POUNDING_FAULT_AT": str(first),
            "POUNDING_FAULT_LAST": str(last),
            "POUNDING_FAULT_STRIDE": str(stride),
            "POUNDING_FAULT_KIND": "each",
            "POUNDING_FAULT_APART": "1",
            "PYTHONPATH": os.environ["POUNDING_PACKAGE"],
        }
        done = subprocess.run(
            [sys.executable, *self.COMMAND],
            cwd=run,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            env=os.environ | settings,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.rows(run / "out.h5"), self.right)
        for ending in (run / "endings").read_text(errors="replace").rstrip("\n").split("\n"):
            number, status, _, _, messages = ending.split("\t")
            with self.subTest(number=number):
                self.check_child(self.folder / f"apart_{number}", os.waitstatus_to_exitcode(int(status)), messages)
            shutil.rmtree(self.folder / f"apart_{number}")

    def check_child(self, folder, code, messages):
        test_faults.ENDINGS["Study", "own_memory", code, (folder / "out.h5").exists()] += 1
        if code == -signal.SIGABRT:
            self.crashes += 1
        elif code != 0:
            self.assertEqual(code, 3, messages)
            self.assertRegex(messages, r"\Apounding: .*memory")
            self.assertNotIn("Traceback", messages)
        if code != 0:
            if self.state(folder) in self.seen:
                return
            self.seen.add(self.state(folder))
            again = subprocess.run(
                [sys.executable, *self.COMMAND],
                cwd=folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                env=os.environ | {"PYTHONPATH": os.environ["POUNDING_PACKAGE"]},
            )
            self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertEqual(self.rows(folder / "out.h5"), self.right)

    def test_lack_of_memory_for_the_kernel(self):
        """All behind the loading of the package, in which C++ ends a process that gets no memory."""
        loaded, count = self.counts()
        self.seen, self.crashes = set(), 0
        stride = test_faults.EVERY or (count - loaded) // 20
        for first in range(loaded + 1, count + 1, self.AT_ONCE * stride):
            self.in_children(first, first + self.AT_ONCE * stride - 1, stride)
        self.assertLess(self.crashes, MOST_CRASHES_OF_PYBIND11)


if __name__ == "__main__":
    unittest.main()
