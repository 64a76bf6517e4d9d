"""Locations of results: invalid names, links and folders, files of other programs, other runs; and signals."""

import os
import resource
import signal
import subprocess
import time
import unittest

import h5py
from support import LONG, OSCILLATORS, PROGRAM, ProgramTest, bits
from messages import assert_mentions


class Place(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(OSCILLATORS)

    def done(self, *words):
        done = self.pounding("run", *words, "-q")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def status(self, name="out.h5"):
        with h5py.File(self.folder / name) as file:
            return file.attrs["status"]

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def start(self, *words, **more):
        self.write(LONG)
        path = self.folder / "out.h5"
        before = path.stat().st_ino if path.exists() else 0
        run = subprocess.Popen(
            [PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5", *words],
            cwd=self.folder,
            stderr=subprocess.PIPE,
            text=True,
            **more,
        )
        self.addCleanup(lambda: (run.kill(), run.wait(), run.stderr.close()))
        deadline = time.monotonic() + 30
        while (not path.exists() or path.stat().st_ino == before) and time.monotonic() < deadline:
            self.assertIsNone(run.poll())
            time.sleep(0.002)
        return run


class Names(Place):
    def test_that_are_empty_are_refused(self):
        self.done("model.yaml", "-o", "out.h5")
        for words in (
            ["run", "model.yaml", "-q", "-o", ""],
            ["run", "--resume", ""],
            ["run", "model.yaml", "--picture", ""],
            ["plot", "out.h5", "-o", ""],
            ["export", "out.h5", "-o", ""],
            ["animate", "out.h5", "-o", ""],
            ["modes", "model.yaml", "-o", ""],
            ["spectrum", "out.h5", "--floor", "left.1", "--csv", ""],
            ["reproduce", "-o", ""],
        ):
            with self.subTest(words):
                self.refused(2, [], *words)
        self.assertEqual(self.names(), ["model.yaml", "out.h5"])

    def test_of_folders_are_refused(self):
        (self.folder / "taken").mkdir()
        self.refused(2, ["-o", "taken/results.h5"], "run", "model.yaml", "-q", "-o", "taken")
        (self.folder / "link").symlink_to("taken")
        self.refused(2, "link", "run", "model.yaml", "-q", "-o", "link")

    @unittest.skipIf(os.geteuid() == 0, "for root every folder can be written")
    def test_in_folders_that_cannot_be_written_are_refused(self):
        (self.folder / "taken").mkdir(mode=0o555)
        self.refused(2, "taken/out.h5", "run", "model.yaml", "-q", "-o", "taken/out.h5")

    def test_of_symbolic_links_stay_links(self):
        (self.folder / "data").mkdir()
        (self.folder / "out.h5").symlink_to("data/real.h5")
        self.done("model.yaml", "-o", "out.h5")
        self.assertTrue((self.folder / "out.h5").is_symlink())
        self.assertEqual(self.status("data/real.h5"), "done")
        (self.folder / "circle.h5").symlink_to("circle.h5")
        self.refused(2, "circle.h5", "run", "model.yaml", "-q", "-o", "circle.h5")


class OthersData(Place):
    def test_is_not_replaced(self):
        path = self.folder / "data.h5"
        with h5py.File(path, "w") as file:
            file["measured"] = [1.0, 2.0]
        before = path.read_bytes()
        self.refused(2, "data.h5", "run", "model.yaml", "-q", "-o", "data.h5")
        self.assertEqual(path.read_bytes(), before)

    def test_beside_an_export_is_not_replaced(self):
        self.done("model.yaml", "-o", "out.h5")
        path = self.folder / "view.data.h5"
        with h5py.File(path, "w") as file:
            file["measured"] = [1.0, 2.0]
        before = path.read_bytes()
        self.refused(2, "view.data.h5", "export", "out.h5", "-o", "view.xdmf")
        self.assertEqual(path.read_bytes(), before)
        self.assertEqual(self.pounding("export", "out.h5", "-o", "mine.xdmf").returncode, 0)
        self.assertEqual(
            self.pounding("export", "out.h5", "-o", "mine.xdmf").returncode, 0, "an earlier export is replaced"
        )

    def test_damaged_results_are_ours_and_are_replaced(self):
        self.done("model.yaml", "-o", "out.h5")
        path = self.folder / "out.h5"
        path.write_bytes(path.read_bytes()[:4000])
        self.done("model.yaml", "-o", "out.h5")
        self.assertEqual(self.status(), "done")


class TwoRuns(Place):
    def test_of_one_output_are_one_run(self):
        first = self.start()
        self.refused(2, "out.h5", "run", "model.yaml", "-q", "-o", "out.h5")
        self.refused(2, "out.h5", "run", "-q", "--resume", "out.h5")
        (self.folder / "link.h5").symlink_to("out.h5")
        self.refused(2, "link.h5", "run", "model.yaml", "-q", "-o", "link.h5")
        first.send_signal(signal.SIGTERM)
        _, errors = first.communicate(timeout=30)
        self.assertEqual(first.returncode, 3, errors)
        assert_mentions(errors, ["pounding run", "--resume", "out.h5"])
        assert_mentions(self.status(), "failed")
        self.write(OSCILLATORS)
        self.done("model.yaml", "-o", "out.h5")

    def test_after_a_kill_the_place_is_free(self):
        first = self.start()
        first.kill()
        first.wait()
        self.write(OSCILLATORS)
        self.done("model.yaml", "-o", "out.h5")
        self.assertEqual(self.names(), ["model.yaml", "out.h5"])


class Signals(Place):
    def stopped(self, run):
        _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 3, errors)
        assert_mentions(errors, ["pounding run", "--resume", "out.h5"])
        assert_mentions(self.status(), "failed")

    def test_of_a_terminal_that_closes_keep_the_last_state(self):
        run = self.start(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))
        run.send_signal(signal.SIGHUP)
        self.stopped(run)

    def test_that_nohup_ignores_stay_ignored(self):
        run = self.start(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        run.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(run.poll())
        run.send_signal(signal.SIGTERM)
        self.stopped(run)

    def test_of_a_limit_on_processor_time_keep_the_last_state(self):
        self.stopped(self.start(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 20))))

    def test_of_a_limit_on_the_size_of_files_leave_nothing_behind(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python ignores it, and children inherit that
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        done = subprocess.run(
            [PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"],
            cwd=self.folder,
            capture_output=True,
            text=True,
            preexec_fn=limit,
            timeout=60,
        )
        self.assertEqual(done.returncode, 2, done.stderr)
        assert_mentions(done.stderr, "out.h5")
        self.assertEqual(self.names(), ["model.yaml"])


class FirstOfTwoParts(Place):
    """A comparing run, interrupted in the run without links."""

    #: Enough steps for a cut in the first part.
    MODEL = OSCILLATORS + "compare: no_pounding\n"

    def contents(self, name):
        found = {}
        with h5py.File(self.folder / name) as file:
            file.visititems(
                lambda place, item: found.update({place: item[()]}) if isinstance(item, h5py.Dataset) else None
            )
        return {place: bits(value) for place, value in found.items() if "wall" not in place and "summary" not in place}

    def test_goes_on_to_the_same_bits(self):
        self.write(self.MODEL)
        self.done("model.yaml", "-o", "whole.h5")
        cut = self.pounding("run", "model.yaml", "-q", "-o", "out.h5", "-pounding_ts_max_steps", "20")
        self.assertEqual(cut.returncode, 3, cut.stderr)
        assert_mentions(cut.stderr, ["pounding run", "--resume", "out.h5"])
        assert_mentions(self.status(), "failed")
        with h5py.File(self.folder / "out.h5") as file:
            self.assertGreater(file["no_pounding/time"][-1], 0)
        again = self.pounding("run", "--resume", "out.h5", "-q", "-pounding_ts_max_steps", "40")
        self.assertEqual(again.returncode, 3, again.stderr)
        self.done("--resume", "out.h5")
        self.assertEqual(self.contents("whole.h5"), self.contents("out.h5"))

    def test_goes_on_after_a_kill(self):
        model = LONG.replace("500", "60") + "compare: no_pounding\ncheckpoint: {every: 0.05 s}\n"
        self.write(model)
        run = subprocess.Popen([PROGRAM, "run", "model.yaml", "-q", "-o", "out.h5"], cwd=self.folder)
        path = self.folder / "out.h5"
        while not self.reached(path) and run.poll() is None:
            time.sleep(0.005)
        run.kill()
        run.communicate()
        with h5py.File(path) as file:
            self.assertEqual(file.attrs["status"], "running")
            self.assertIn("no_pounding/checkpoint", file)
            self.assertNotIn("checkpoint", file)
        before = self.reached(path)
        self.assertGreater(before, 0)
        cut = self.pounding("run", "--resume", "out.h5", "-q", "-o", "other.h5", "-pounding_ts_max_steps", "1")
        self.assertEqual(cut.returncode, 3, cut.stderr)
        self.assertGreaterEqual(self.reached(self.folder / "other.h5"), before)

    @staticmethod
    def reached(path):
        if not path.exists():
            return 0
        with h5py.File(path) as file:
            return (
                file["no_pounding/time"][-1]
                if "no_pounding/checkpoint" in file and file["no_pounding/time"].size
                else 0
            )


if __name__ == "__main__":
    unittest.main()
