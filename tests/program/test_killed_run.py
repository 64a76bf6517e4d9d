"""A killed run has a readable results file."""

import random
import signal
import subprocess
import time
import unittest

import h5py
from support import LONG, PROGRAM, ProgramTest
from messages import assert_mentions


class KilledRun(ProgramTest):
    def kill_after(self, seconds):
        path = self.folder / "out.h5"
        run = subprocess.Popen([PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"], cwd=self.folder)
        while not path.exists():
            self.assertIsNone(run.poll(), "the run ended before it wrote anything")
            time.sleep(0.001)
        time.sleep(seconds)
        run.kill()
        self.assertLess(run.wait(), 0, "the run ended before it was killed")
        return path

    def test_leaves_a_file_that_says_running(self):
        self.write(LONG)
        moments = random.Random(2015)
        for _ in range(8):
            path = self.kill_after(moments.uniform(0, 1.3))
            with h5py.File(path) as file:
                self.assertEqual(file.attrs["status"], "running")
                self.assertEqual(file["input/model.yaml"][()].decode(), LONG)
                self.assertEqual(len(file["structures/left/displacement"]), len(file["time"]))
            path.unlink()

    def test_killed_while_it_writes_leaves_the_earlier_file(self):
        self.write(LONG)
        path = self.folder / "out.h5"
        run = subprocess.Popen([PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"], cwd=self.folder)
        deadline = time.monotonic() + 5
        written = False
        while time.monotonic() < deadline and not (written and list(self.folder.glob(".out.h5.tmp"))):
            written = written or path.exists()
        run.kill()
        self.assertLess(run.wait(), 0, "the run ended before it was killed")
        with h5py.File(path) as file:
            self.assertEqual(file.attrs["status"], "running")
            self.assertEqual(len(file["structures/left/displacement"]), len(file["time"]))

    def test_leaves_all_up_to_the_last_flush(self):
        self.write(LONG)
        run = subprocess.Popen([PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"], cwd=self.folder)
        path = self.folder / "out.h5"
        # Updates of the file are atomic: the third one has the results until then. A slow disk separates them.
        seen = set()
        deadline = time.monotonic() + 40
        while len(seen) < 3 and time.monotonic() < deadline:
            if path.exists():
                seen.add(path.stat().st_mtime_ns)
            time.sleep(0.005)
        run.kill()
        self.assertLess(run.wait(), 0, "the run ended before it was killed")
        with h5py.File(path) as file:
            self.assertEqual(file.attrs["status"], "running")
            self.assertGreater(file["time"][-1], 0)
            self.assertEqual(len(file["structures/right/velocity"]), len(file["time"]))
            self.assertGreater(len(file["links/left-right/time"]), 0)


class InterruptedRun(ProgramTest):
    def test_ends_with_what_was_computed_in_the_file(self):
        self.write(LONG)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU):
            run = subprocess.Popen(
                [PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"], cwd=self.folder, stderr=subprocess.PIPE, text=True
            )
            path = self.folder / "out.h5"
            while not path.exists():
                time.sleep(0.001)
            time.sleep(0.3)
            run.send_signal(number)
            _, errors = run.communicate(timeout=10)
            self.assertEqual(run.returncode, 3)
            assert_mentions(errors, "pounding")
            with h5py.File(path) as file:
                assert_mentions(file.attrs["status"], "failed")
                self.assertGreater(file["time"][-1], 0)
            path.unlink()


if __name__ == "__main__":
    unittest.main()
