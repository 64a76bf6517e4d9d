"""A process of `mpirun -n 2 pounding run` is killed at its n-th message. Whatever n is, the launcher ends all processes
soon with the signal's exit code, and the results file is the earlier one or a whole one of this run, which goes on to
the right bits. A slice of all n; POUNDING_ALL_FAULTS=1 takes every one. How many messages there are depends on the
clock, by which a run looks for signals."""

import os
import signal
import subprocess
import unittest

from support import OSCILLATORS, ProgramTest
from test_faults import contents
from test_processes import LAUNCHER, SURROUNDINGS, words_of

SHIM = os.environ["POUNDING_MESSAGES"]
ALL = os.environ.get("POUNDING_ALL_FAULTS") == "1"
#: The launcher gives the other processes a second; the rest is for a loaded machine.
PATIENCE = 60


class KilledAtAMessage(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(
            OSCILLATORS.replace(
                "analysis: {duration: 3.0}", "analysis: {duration: 0.7}\ncheckpoint: {every_simulated: 0.02 s}"
            )
        )
        self.write(OSCILLATORS.replace("analysis: {duration: 3.0}", "analysis: {duration: 0.1}"), "earlier.yaml")
        self.path = self.folder / "out.h5"
        self.assertEqual(self.pounding("run", "earlier.yaml", "-q", "-o", "out.h5").returncode, 0)
        self.before = self.path.read_bytes()

    def run_with(self, rank, number):
        words = {
            "POUNDING_FAULT_RANK": str(rank),
            "POUNDING_FAULT_AT": str(number),
            "POUNDING_FAULT_SIGNAL": str(int(signal.SIGKILL)),
            "POUNDING_FAULT_COUNT": str(self.folder / "count"),
        }
        launcher, *rest = words_of(2, "run", "model.yaml", "-q", "-o", "out.h5")
        return subprocess.run(
            [launcher, "-x", f"LD_PRELOAD={SHIM}", *rest],
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            env=SURROUNDINGS | words,
        )

    def goes_on(self, right):
        again = subprocess.run(
            words_of(2, "run", "--resume", "out.h5", "-q"),
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            env=SURROUNDINGS,
        )
        self.assertEqual(again.returncode, 0, again.stderr)
        status, found = contents(self.path)
        self.assertEqual((status, [place for place in right if found.get(place) != right[place]]), ("done", []))

    def test_leaves_a_whole_file(self):
        whole = self.run_with(0, 0)
        self.assertEqual((whole.returncode, whole.stderr), (0, ""))
        count = int((self.folder / "count").read_text())
        self.assertGreater(count, 20)
        _, right = contents(self.path)
        begun = 0
        for rank, number in (
            [(rank, n) for n in range(1, count + 1) for rank in (0, 1)]
            if ALL
            else ((0, 1), (1, count // 2), (0, count - 3))
        ):
            with self.subTest(rank=rank, number=number, of=count):
                self.path.write_bytes(self.before)
                done = self.run_with(rank, number)
                self.assertIn(done.returncode, (0, 128 + signal.SIGKILL), done.stderr)
                if done.returncode != 0 and self.path.read_bytes() == self.before:
                    continue
                begun += 1
                status, found = contents(self.path)
                if status == "done":
                    self.assertEqual([place for place in right if found.get(place) != right[place]], [])
                else:
                    self.assertEqual((done.returncode, status), (128 + signal.SIGKILL, "running"))
                    self.goes_on(right)
        self.assertGreater(begun, 0)


if __name__ == "__main__":
    unittest.main()
