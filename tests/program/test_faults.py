"""Faults on purpose: the n-th call that writes a file fails, is cut short, or is the moment of a signal. Whatever n is, a run has one of
three endings: the right bits and exit code 0, an earlier whole file after a kill, or an error with exit code 2 or 3 and a whole file
of this run or of an earlier one. Only where HDF5 gets no memory it may end the process by a crash. A slice of all n; POUNDING_ALL_FAULTS=1 takes every one."""

import errno
import os
import signal
import subprocess
import unittest

import h5py
from support import OSCILLATORS, PROGRAM, ProgramTest

SHIM = os.environ["POUNDING_FAULTS"]
ALL = os.environ.get("POUNDING_ALL_FAULTS") == "1"
#: Written often, so that there are many calls.
MODEL = OSCILLATORS.replace("analysis: {duration: 3.0}", "analysis: {duration: 3.0, tolerance: 1e-7}\ncompare: no_pounding\n"
                            "checkpoint: {every_simulated: 0.2 s}")


def contents(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda place, item: found.update({place: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None)
        return file.attrs["status"], {place: value for place, value in found.items() if "wall" not in place and "summary" not in place}


class FaultTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(MODEL)
        self.path = self.folder / "out.h5"
        self.assertEqual(self.pounding("run", "model.yaml", "-q", "-o", "right.h5").returncode, 0)
        _, self.right = contents(self.folder / "right.h5")
        self.write(OSCILLATORS, "earlier.yaml")
        self.assertEqual(self.pounding("run", "earlier.yaml", "-q", "-o", "out.h5").returncode, 0)
        self.before = self.path.read_bytes()

    def run_with(self, call, number, kind):
        words = {"POUNDING_FAULT_CALL": call, "POUNDING_FAULT_AT": str(number), "POUNDING_FAULT_KIND": str(kind),
                 "POUNDING_FAULT_COUNT": str(self.folder / "count")}
        return subprocess.run([PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=60, env={**os.environ, "LD_PRELOAD": SHIM, **words})

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
        status, found = contents(self.path)
        if killed:
            self.assertEqual(done.returncode, -signal.SIGKILL)
        elif done.returncode == 0:
            self.assertEqual(status, "done")
            self.assertEqual(found.keys(), self.right.keys())
            self.assertEqual([place for place in found if found[place] != self.right[place]], [])
        else:
            self.assertIn(done.returncode, (2, 3), done.stderr)
            self.assertRegex(done.stderr, r"^pounding: ")
        if self.path.read_bytes() != self.before:
            checked = self.pounding("spectrum", "out.h5", "--floor", "left.1")
            self.assertNotIn("damaged", checked.stderr)
        leftovers = [path.name for path in self.folder.iterdir() if path.name.endswith(".tmp")]
        self.assertEqual(leftovers if not killed else leftovers[1:], [])

    def each(self, call, *kinds):
        for kind in kinds:
            count = self.count(call)
            self.assertGreater(count, 1)
            for number in self.numbers(count):
                with self.subTest(call=call, kind=kind, number=number, of=count):
                    self.path.write_bytes(self.before)
                    done = self.run_with(call, number, kind)
                    self.check_ending(done, killed=kind == "kill")


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

    def test_memory_that_hdf5_does_not_get_costs_no_file(self):
        count = self.count("memory")
        self.assertGreater(count, 1000)
        for number in range(1, count + 1, 1 if ALL else max(1, count // 12)):
            with self.subTest(number=number, of=count):
                self.path.write_bytes(self.before)
                done = self.run_with("memory", number, errno.ENOMEM)
                # HDF5 1.10 frees blocks twice after an allocation that failed, and then the process may end by a signal or in a
                # message of HDF5's own. What counts is the file.
                if done.returncode < 0 or done.stderr.startswith("HDF5: infinite loop closing library"):
                    done.returncode, done.stderr = 3, "pounding: "
                self.check_ending(done)


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
