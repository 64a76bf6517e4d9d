"""Faults on purpose: the n-th call that writes a file or asks for memory fails, or the n-th step is the moment of a
signal. Whatever n is, a run has one of three endings: the right bits and exit code 0, an earlier whole file after a
kill, or an error with exit code 2 or 3 and a whole file of this run or of an earlier one. Only where a library gets no
memory it may end the process by a crash or in a way of its own, which costs no file either. A slice of all n;
POUNDING_ALL_FAULTS=1 takes every one, POUNDING_ALL_FAULTS=7 every seventh allocation and every one of the others."""

import errno
import itertools
import os
import select
import signal
import subprocess
import unittest
from collections import Counter
from types import SimpleNamespace

import h5py
from support import OSCILLATORS, PROGRAM, ProgramTest, is_sealed

SHIM = os.environ["POUNDING_FAULTS"]
#: One of so many allocations fails, each time another one; 0 for a slice.
EVERY = int(os.environ.get("POUNDING_ALL_FAULTS", "0"))
ALL = EVERY > 0
#: How often such faults ended a run with this exit code, or less than zero by this signal, and with the earlier file
#: replaced or not.
ENDINGS = Counter()
#: PETSc crashes fewer times than this in a run in which each of its allocations fails.
MOST_CRASHES_OF_PETSC = 6
#: Written often, so that there are many calls.
MODEL = OSCILLATORS.replace(
    "analysis: {duration: 3.0}",
    "analysis: {duration: 3.0, tolerance: 1e-7}\ncompare: no_pounding\ncheckpoint: {every_simulated: 0.2 s}",
)
#: For faults at calls that are many however short a run is.
SMALL = OSCILLATORS.replace(
    "analysis: {duration: 3.0}", "analysis: {duration: 0.6}\ncheckpoint: {every_simulated: 0.2 s}"
)
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU)


def tearDownModule():
    if ALL:
        for (test, call, code, replaced), count in sorted(ENDINGS.items()):
            print(f"{test}, {call}: exit code {code}, file {'replaced' if replaced else 'as before'}: {count} runs")


def contents(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda place, item: found.update({place: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None
        )
        # A pushover has its status in its summary.
        return file.attrs.get("status", "done"), {
            place: value for place, value in found.items() if "wall" not in place and "summary" not in place
        }


class Served:
    """A command of the program that is loaded once and runs in a child for each fault: a third of the time of new
    processes."""

    #: [s]
    PATIENCE = 60

    def __init__(self, folder, *words, program=PROGRAM):
        self.messages = folder / "messages"
        settings = {
            "LD_PRELOAD": SHIM,
            "POUNDING_FAULT_SERVES": str(self.messages),
            "POUNDING_FAULT_COUNT": str(folder / "count"),
        }
        self.process = subprocess.Popen(
            [program, *words],
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
            env={**os.environ, **settings},
        )

    def run(self, call, number, kind):
        print(call, number, kind, file=self.process.stdin, flush=True)
        if not select.select([self.process.stdout], [], [], self.PATIENCE)[0]:
            os.killpg(self.process.pid, signal.SIGKILL)
            raise AssertionError(f"{call} {number} {kind}: it took more than {self.PATIENCE} s")
        status = int(self.process.stdout.readline())
        return SimpleNamespace(returncode=os.waitstatus_to_exitcode(status), stderr=self.messages.read_text())

    def close(self):
        self.process.communicate()


class FaultTest(ProgramTest):
    MODEL = MODEL
    #: The verb and its words but for -o.
    WORDS = ("run", "model.yaml", "-q")
    #: One of so many allocations fails where all are asked for.
    MANY = 1

    def setUp(self):
        super().setUp()
        self.write(self.MODEL)
        self.path = self.folder / "out.h5"
        self.assertEqual(self.pounding(*self.WORDS, "-o", "right.h5").returncode, 0)
        _, self.right = contents(self.folder / "right.h5")
        self.write(OSCILLATORS, "earlier.yaml")
        self.assertEqual(self.pounding("run", "earlier.yaml", "-q", "-o", "out.h5").returncode, 0)
        self.before = self.path.read_bytes()
        self.served = self.serves(*self.WORDS, "-o", "out.h5")

    def serves(self, *words):
        served = Served(self.folder, *words)
        self.addCleanup(served.close)
        return served

    def run_with(self, call, number, kind):
        done = self.served.run(call, number, kind)
        if number:
            ENDINGS[type(self).__name__, call, done.returncode, self.path.read_bytes() != self.before] += 1
        return done

    def count(self, call):
        """How many such calls a run makes."""
        done = self.run_with(call, 0, 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        return int((self.folder / "count").read_text())

    def numbers(self, count):
        """All of them, or the first, the last, and some between."""
        if ALL or count <= 6:
            return range(1, count + 1)
        return sorted({1, 2, 3, count // 3, 2 * count // 3, count})

    def check_ending(self, done, killed=False):
        """Whole file of the earlier run, of this one on its way, or of its end; nothing beside it."""
        self.assertTrue(is_sealed(self.path))
        if killed:
            self.assertEqual(done.returncode, -signal.SIGKILL)
        elif done.returncode == 0:
            status, found = contents(self.path)
            self.assertEqual(status, "done")
            self.assertEqual(found.keys(), self.right.keys())
            self.assertEqual([place for place in found if found[place] != self.right[place]], [])
        else:
            self.check_message(done)
        if self.path.read_bytes() != self.before and not ALL:
            checked = self.pounding("spectrum", "out.h5", "--floor", "left.1")
            self.assertNotIn("damaged", checked.stderr)
        leftovers = [path.name for path in self.folder.iterdir() if path.name.endswith(".tmp")]
        self.assertEqual(leftovers if not killed else leftovers[1:], [])

    def check_message(self, done):
        self.assertIn(done.returncode, (2, 3), done.stderr)
        self.assertRegex(done.stderr, r"(?m)^pounding: ")

    def each(self, call, *kinds):
        for kind in kinds:
            count = self.count(call)
            self.assertGreater(count, 0)
            for number in self.numbers(count):
                with self.subTest(call=call, kind=kind, number=number, of=count):
                    self.path.write_bytes(self.before)
                    done = self.run_with(call, number, kind)
                    self.check_ending(done, killed=kind == "kill")

    def some(self, call, least, count, look):
        """Each number of an allocation from the second on, or so many of them; `look` sees every ending."""
        numbers = self.count(call)
        self.assertGreater(numbers, least)
        self.in_children(call, 2, look, EVERY * self.MANY or max(1, numbers // count))

    def in_children(self, call, first, look, stride=1):
        """Each number of such a call from the first on, or one of so many, in children of one run, which takes some
        milliseconds for each; `look` sees every ending."""
        self.path.write_bytes(self.before)
        settings = {
            "LD_PRELOAD": SHIM,
            "POUNDING_FAULT_CALL": call,
            "POUNDING_FAULT_AT": str(first),
            "POUNDING_FAULT_LAST": "1000000000",
            "POUNDING_FAULT_STRIDE": str(stride),
            "POUNDING_FAULT_KIND": "each",
        }
        run = subprocess.run(
            [PROGRAM, *self.WORDS, "-o", "out.h5"],
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            env=os.environ | settings,
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        last = self.path.stat().st_ino
        self.check_ending(run)
        endings = (self.folder / "endings").read_text(errors="replace").rstrip("\n").split("\n")
        self.assertGreater(len(endings), 0)
        for ending in endings:
            number, status, inode, written, messages = ending.split("\t")
            done = SimpleNamespace(
                returncode=os.waitstatus_to_exitcode(int(status)), stderr=messages.replace("\1", "\n")
            )
            ENDINGS[type(self).__name__, call, done.returncode, written != "-"] += 1
            with self.subTest(call=call, number=number):
                look(done)
                self.assertIn(done.returncode, (0, 3), done.stderr)
                if done.returncode == 0 and written == "-":
                    self.assertEqual(int(inode), last, "it left the file of another state than the last")
                elif written != "-":
                    (self.folder / written).replace(self.path)
                    self.check_ending(done)
                else:
                    self.check_message(done)

    def tells(self, done):
        if done.returncode != 0:
            self.assertIn("memory", done.stderr)

    def costs_no_file(self, done):
        """A library that crashes where it gets no memory may end the process by a signal; what counts is the file."""
        # PETSc tells of signals while it starts, and ends its process by this code.
        if done.returncode < 0 or (done.returncode == 59 and "Caught signal" in done.stderr):
            self.crashes += 1
            done.returncode, done.stderr = 3, "pounding: "

    def ends_itself(self, done):
        """MPI ends a process that gets no memory by exit codes of its own, if it does not crash."""
        if done.returncode != 0:
            done.returncode, done.stderr = 3, "pounding: "

    def signals_end_runs_that_go_on(self, least):
        """Signals at each step, or at some; a run has more than `least` of them. One that looks for signals seldom
        enough may be done before it has seen one."""
        count = self.count("step")
        self.assertGreater(count, least)
        steps = range(1, count + 1) if ALL else (1, count // 3, 2 * count // 3, count)
        stopped, resumed = 0, self.serves("run", "--resume", "out.h5", "-q")
        for number, step in zip(itertools.cycle(SIGNALS), steps):
            with self.subTest(signal=number, step=step, of=count):
                self.path.write_bytes(self.before)
                done = self.run_with("step", step, f"-{int(number)}")
                self.check_ending(done)
                if done.returncode == 0:
                    continue
                stopped += 1
                self.assertEqual(done.returncode, 3)
                self.assertIn("stopped by the user", done.stderr)
                again = resumed.run("none", 0, 0)
                self.assertEqual(again.returncode, 0, again.stderr)
                _, found = contents(self.path)
                self.assertEqual([place for place in self.right if found.get(place) != self.right[place]], [])
        self.assertGreater(stopped, 0)


class Faults(FaultTest):
    def test_writes_that_fail(self):
        self.each("write", errno.ENOSPC, errno.EIO, errno.EFBIG)

    def test_writes_that_are_cut(self):
        self.each("write", "short")

    def test_writes_that_are_interrupted(self):
        self.each("write", errno.EINTR)

    def test_files_that_do_not_reach_the_disk(self):
        self.each("fsync", errno.EIO)

    def test_files_that_cannot_be_opened_or_renamed(self):
        self.each("open", errno.EMFILE, errno.EIO)
        self.each("rename", errno.EIO)
        self.each("ftruncate", errno.EIO)

    def test_kills_while_it_writes(self):
        for call in ("open", "write", "fsync", "rename"):
            self.each(call, "kill")

    def test_signals_while_it_writes(self):
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU):
            self.each("fsync", f"-{int(number)}")


class LacksOfMemory:
    """Each call of malloc in a run of the model of a class, by the libraries that make it."""

    def test_of_the_program_itself(self):
        self.some("own_memory", 5000, 40, self.tells)

    def test_of_petsc(self):
        """PETSc 3.18 crashes at some allocations: where the first part of an object got no memory, and at its very
        first one."""
        self.crashes = 0
        self.some("petsc_memory", 100, 10, self.costs_no_file)
        self.assertLess(self.crashes, MOST_CRASHES_OF_PETSC)

    def test_of_hdf5_costs_no_file(self):
        """HDF5 1.10 frees blocks twice after an allocation that failed."""
        self.crashes = 0
        self.some("hdf5_memory", 1000, 20, self.costs_no_file)

    def test_of_other_libraries_costs_no_file(self):
        self.some("other_memory", 1000, 20, self.ends_itself)


class LackOfMemory(LacksOfMemory, FaultTest):
    MODEL = SMALL


class SignalsAtSteps(FaultTest):
    MODEL = MODEL.replace("compare: no_pounding\n", "")

    def test_end_runs_that_go_on_to_the_same_bits(self):
        self.signals_end_runs_that_go_on(100)


class Resumed(FaultTest):
    def test_after_a_kill_at_a_write_to_the_same_bits(self):
        count = self.count("rename")
        for number in self.numbers(count):
            with self.subTest(number=number, of=count):
                self.path.write_bytes(self.before)
                self.run_with("rename", number, "kill")
                if self.path.read_bytes() == self.before:
                    continue
                status, _ = contents(self.path)
                self.assertEqual(status, "running")
                again = self.pounding("run", "--resume", "out.h5", "-q")
                self.assertEqual(again.returncode, 0, again.stderr)
                _, found = contents(self.path)
                self.assertEqual([place for place in self.right if found.get(place) != self.right[place]], [])


if __name__ == "__main__":
    unittest.main()
