"""Files of studies: replacement of tables, two studies with one table, merges, exports, unsupported arguments, and
workers whose driver has died."""

import contextlib
import csv
import io
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding._ended import exit_code
from pounding.errors import InputError
from pounding._studies.batches import DIED, DONE, FAILED, NOT_RUN, Done
from pounding._studies.command import main
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan
from pounding._studies.table import Table
from study_samples import FACTORS, WORDS, pair
from messages import assert_mentions, raises

#: Rows that run longer than any test waits.
SLOW = """\
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 500}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
links:
  - {between: [left, right], gap: 20 mm, law: jankowski, stiffness: 2.75e9, restitution: 0.65}
analysis: {duration: 500, tolerance: 1e-9, output_step: 10 ms, integrator: generalized_alpha}
study:
  factors: {gap: {of: links.*.gap, list: [10 mm, 20 mm, 30 mm, 40 mm]}}
  engine: solver
"""


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        (self.folder / "pair.yaml").write_text(pair().to_yaml())
        words = pounding._yaml_text.plain({"factors": FACTORS, **WORDS})
        (self.folder / "study.yaml").write_text(pounding._yaml_text.emit({"model": "pair.yaml", "study": words}))

    def study(self, *words, **options):
        return subprocess.run(
            [sys.executable, "-m", "pounding", "study", *map(str, words)],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=120,
            **options,
        )

    def refused(self, told, *words):
        """Output of a command run in this process, which needs no start-up time."""
        said, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(errors):
            code = exit_code(lambda: main(["study", *map(str, words)]))
        self.assertEqual(code, 2, said.getvalue() + errors.getvalue())
        assert_mentions(errors.getvalue(), told)
        self.assertNotIn("Traceback", errors.getvalue())
        self.assertLess(len(errors.getvalue()), 3000)
        return errors.getvalue()

    def start(self, *words, text=SLOW):
        """A study whose rows do not end; returns once its first workers have started."""
        (self.folder / "slow.yaml").write_text(text)
        process = subprocess.Popen(
            [sys.executable, "-m", "pounding", "study", "slow.yaml", "-q", *words],
            cwd=self.folder,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.wait(), process.stderr.close()))
        end = time.monotonic() + 60
        while (
            not (self.folder / "slow.h5.parts/plan.json").exists() and process.poll() is None and time.monotonic() < end
        ):
            time.sleep(0.01)
        self.assertIsNone(process.poll())
        return process


class Names(Files):
    def test_options_of_petsc_are_in_the_table_and_its_plan(self):
        (self.folder / "options").write_text("-pounding_ts_rtol 1e-2\n")
        text = (self.folder / "study.yaml").read_text() + "  engine: solver\n"
        (self.folder / "solver.yaml").write_text(text)
        done = self.study("solver.yaml", "-j", "2", env=os.environ | {"PETSC_OPTIONS": "-options_file options"})
        self.assertEqual(done.returncode, 0, done.stderr)
        assert_mentions(done.stdout, ["-pounding_ts_rtol", "1e-2", "PETSc"])
        done = self.study("show", "solver.h5", "--json")
        self.assertEqual(json.loads(done.stdout)["options"], ["-pounding_ts_rtol 1e-2"])
        self.refused([], "solver.yaml")
        # Options that change no row are not in the plan.
        done = self.study(
            "solver.yaml", "-j", "0", env=os.environ | {"PETSC_OPTIONS": "-pounding_ts_rtol 1e-2 -malloc_debug 0"}
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_shard_is_not_named_after_a_device(self):
        self.refused([], "study.yaml", "-o", "/dev/null", "--shard", "1/2")

    def test_an_empty_name_of_a_picture_is_refused(self):
        self.assertEqual(self.study("study.yaml", "-j", "0", "-q").returncode, 0)
        self.refused([], "plot", "study.h5", "--picture", "tornado", "--column", "force", "-o", "")

    def test_that_a_run_refuses_are_refused_before_the_first_row(self):
        os.mkfifo(self.folder / "fifo.h5")
        (self.folder / "taken").mkdir()
        (self.folder / "device.h5").symlink_to("/dev/null")
        (self.folder / "circle.h5").symlink_to("circle.h5")
        (self.folder / "mine.h5").write_text("measured")
        (self.folder / "hard.h5").hardlink_to(self.folder / "study.yaml")
        for name, told in (
            ("fifo.h5", ()),
            ("device.h5", ()),
            ("/dev/full", ()),
            ("taken", ()),
            (".", ()),
            ("..", ()),
            ("/", ()),
            ("", ()),
            ("circle.h5", ()),
            ("missing/s.h5", "mkdir -p"),
            ("mine.h5", ()),
            ("study.yaml", ()),
            ("hard.h5", ()),
            ("pair.yaml", ()),
            ("new.h5/", ()),
            ("n" * 300 + ".h5", ()),
            ("n" * 252 + ".h5", ()),
        ):
            before = {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
            with self.subTest(name[:20]):
                self.refused(told, "study.yaml", "-o", name)
                self.refused(told, "merge", "study.yaml", "mine.h5", "-o", name)
                self.assertEqual(
                    {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}, before
                )
                self.assertFalse(list(self.folder.glob("*.parts")))

    def test_symbolic_links_stay_links_and_modes_stay(self):
        (self.folder / "data").mkdir()
        (self.folder / "s.h5").symlink_to("data/real.h5")
        for _ in range(2):
            self.assertEqual(self.study("study.yaml", "-o", "s.h5", "-q").returncode, 0)
            self.assertTrue((self.folder / "s.h5").is_symlink())
            real = self.folder / "data/real.h5"
            if not _:
                real.chmod(0o640)
        self.assertEqual(real.stat().st_mode & 0o777, 0o640)
        self.assertEqual(os.listdir(self.folder / "data"), ["real.h5"])

    def test_folders_of_others_stay(self):
        parts = self.folder / "s.h5.parts"
        parts.mkdir()
        (parts / "measured.npz").write_text("mine")
        self.refused("measured.npz", "study.yaml", "-o", "s.h5")
        self.assertEqual((parts / "measured.npz").read_text(), "mine")
        self.assertFalse((self.folder / "s.h5").exists())
        # A foreign file in our folder is kept.
        (parts / "measured.npz").unlink()
        table = Table(make_plan(pair(), {"factors": FACTORS, **WORDS}, Path()), self.folder / "s.h5")
        (parts / "notes.txt").write_text("mine")
        table.write()
        self.assertEqual(os.listdir(parts), ["notes.txt"])
        (self.folder / "t.h5.parts").write_text("a file")
        self.refused([], "study.yaml", "-o", "t.h5")
        self.assertEqual((self.folder / "t.h5.parts").read_text(), "a file")


class TwoStudies(Files):
    def test_of_one_table_are_one_study(self):
        first = self.start("-o", "slow.h5", "-j", "1")
        (self.folder / "link.h5").symlink_to("slow.h5")
        for name in ("slow.h5", "./slow.h5", "link.h5"):
            self.refused([], "study.yaml", "-o", name)
            self.refused([], "merge", "study.yaml", "slow.h5", "-o", name)
        first.send_signal(signal.SIGTERM)
        _, told = first.communicate(timeout=30)
        self.assertEqual(first.returncode, 3)
        assert_mentions(told, ["signal", "finished rows", "same command"])
        self.assertFalse((self.folder / "slow.h5.parts").exists())

    def test_in_one_process_too(self):
        plan = make_plan(pair(), {"factors": FACTORS, **WORDS}, Path())
        table = Table(plan, self.folder / "s.h5")
        with raises(InputError):
            run_plan(plan, self.folder / "s.h5", workers=0)
        table.close()
        self.assertFalse((self.folder / "s.h5.parts").exists(), "the folder is removed")
        self.assertEqual(len(run_plan(plan, self.folder / "s.h5", workers=0)), 36)

    def test_after_a_kill_the_table_is_free(self):
        first = self.start("-o", "slow.h5", "-j", "0")
        first.kill()
        first.wait()
        self.refused([], "study.yaml", "-o", "slow.h5")

    def test_that_begin_together_lose_no_row(self):
        words = [sys.executable, "-m", "pounding", "study", "study.yaml", "-o", "s.h5", "-j", "0", "-q", "--chunk", "1"]
        both = [subprocess.Popen(words, cwd=self.folder, stderr=subprocess.PIPE, text=True) for _ in range(4)]
        codes = [process.communicate(timeout=120) and process.returncode for process in both]
        self.assertLessEqual(set(codes), {0, 2})
        self.assertIn(0, codes)
        self.assertEqual((pounding.Study.open(self.folder / "s.h5")["status"] == DONE).sum(), 36)


class Drivers(Files):
    def workers(self, process):
        return [int(each) for each in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]

    def test_take_their_workers_with_them(self):
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number):
                process = self.start("-o", "slow.h5", "-j", "2")
                end = time.monotonic() + 60
                # and the process that cleans up after them
                while len(self.workers(process)) < 3 and time.monotonic() < end:
                    time.sleep(0.02)
                time.sleep(1)
                workers = self.workers(process)
                process.send_signal(number)
                process.communicate(timeout=30)
                self.assertEqual(process.returncode, -number if number == signal.SIGKILL else 3)
                end = time.monotonic() + 10
                while any(Path(f"/proc/{worker}").exists() for worker in workers) and time.monotonic() < end:
                    time.sleep(0.05)
                self.assertFalse([worker for worker in workers if Path(f"/proc/{worker}").exists()])
                (self.folder / "slow.h5").unlink(missing_ok=True)
                for path in (self.folder / "slow.h5.parts").glob("*"):
                    path.unlink()


class Merges(Files):
    def test_a_complete_row_beats_a_failed_one_and_both_beat_a_dead_worker(self):
        plan = make_plan(pair(), {"factors": FACTORS, **WORDS}, Path())
        whole = run_plan(plan, None, workers=0)
        columns = plan.template.kept.columns
        values = np.column_stack([whole[column] for column in columns])

        def table(name, *fates):
            made = Table(plan, self.folder / name)
            status = np.array([*fates, *[NOT_RUN] * (plan.count - len(fates))], np.int8)
            rows = np.flatnonzero(status != NOT_RUN)
            status = status[rows]
            made.add(
                Done(
                    rows,
                    np.where((status == DONE)[:, None], values[rows], np.nan),
                    status,
                    np.zeros(len(rows), np.int8),
                    np.zeros(len(rows)),
                    {int(row): f"why {name}" for row, fate in zip(rows, status) if fate != DONE},
                )
            )
            made.write()

        table("a.h5", DONE, DIED, FAILED, DONE, DIED)
        table("b.h5", DIED, DONE, DIED, FAILED, FAILED)
        for order in (("a.h5", "b.h5"), ("b.h5", "a.h5")):
            merged = Table(plan)
            for name in order:
                merged.merge(self.folder / name)
            self.assertEqual(merged.status[:5].tolist(), [DONE, DONE, FAILED, DONE, FAILED])
            self.assertEqual(merged.reasons, {2: "why a.h5", 4: "why b.h5"})
            np.testing.assert_array_equal(merged.values[[0, 1, 3]], values[[0, 1, 3]])


class Words(Files):
    def test_that_are_no_counts_are_refused(self):
        for words in (
            ["--chunk", "-3"],
            ["--chunk", "0"],
            ["--chunk", "x"],
            ["-j", "-1"],
            ["-j", "1.5"],
            ["-j", "9" * 5000],
            ["--chunk", "1_0"],
        ):
            self.refused([], "study.yaml", "-o", "s.h5", *words)
        self.refused([], "check", "study.yaml", "-j", "-1")
        plan = make_plan(pair(), {"factors": FACTORS, **WORDS}, Path())
        for options in ({"workers": -1}, {"chunk": -3}, {"chunk": 0}, {"workers": "two"}, {"chunk": 1.5}):
            with raises(InputError):
                run_plan(plan, self.folder / "s.h5", **options)
        self.refused(["workers", "4096"], "study.yaml", "-o", "s.h5", "-j", "1000000")
        self.assertFalse((self.folder / "s.h5").exists())

    def test_that_are_no_studies_are_refused(self):
        for words in (
            ["."],
            ["/"],
            ["check", "."],
            ["show", "."],
            ["missing.yaml"],
            ["check", ""],
            [""],
            ["merge", ".", "a.h5", "-o", "b.h5"],
            ["plot", ".", "--picture", "gap"],
            ["export", ".", "-o", "a.csv"],
            ["show", "/dev/null"],
        ):
            self.refused([], *words)

    def test_a_sweep_without_paths_is_refused(self):
        for factors in ([], None, 3, "links.*.gap", {"links.*.gap": "10 mm"}, {"links.*.gap": 1.0}, {3: [1]}):
            with raises(InputError, "sweep"):
                pounding.sweep(pair(), factors)

    def test_messages_stay_short(self):
        long = "x" * 1_000_000
        for words in (
            f"  factors: {long}",
            f"  factors: {{{long}: {{of: links.*.gap, list: [1 mm]}}}}",
            f"  factors: {{gap: {{of: {long}, list: [1 mm]}}}}",
            f"  keep: [{long}]",
            f"  records: {{files: {long}}}",
            f"  {long}: 1",
            f"  engine: {long}",
            f"  seed: '{long}'",
            "  factors: {gap: {of: links.*.gap, list: [" + "1 mm, " * 100_000 + "1]}}",
        ):
            (self.folder / "long.yaml").write_text(f"model: pair.yaml\nstudy:\n{words}\n")
            self.refused([], "check", "long.yaml")

    def test_a_table_beyond_the_memory_is_refused_with_its_size(self):
        words = {
            "factors": {
                f"f{i}": {"of": path, "from": 1, "to": 2, "count": 1000}
                for i, path in enumerate(("structures.left.oscillator.period", "structures.right.oscillator.period"))
            },
            "keep": ["force"],
            "records": {"synthetic": {"count": 1000, "duration": "0.4 s", "pga": "0.1 g"}},
        }
        (self.folder / "huge.yaml").write_text(
            pounding._yaml_text.emit({"model": "pair.yaml", "study": pounding._yaml_text.plain(words)})
        )
        for verb in ("check", "run"):
            begin = time.monotonic()
            done = self.refused("1000000000", *([verb, "huge.yaml"]))
            self.assertRegex(done, r"\d+(\.\d+)? GB.* \d+ GB")
            self.assertLess(time.monotonic() - begin, 60)
        self.assertFalse(list(self.folder.glob("huge.h5*")))
        told = self.study("check", "study.yaml")
        assert_mentions(told.stdout, "table")


class Exports(Files):
    def test_replace_nothing_but_earlier_ones(self):
        study = run_plan(make_plan(pair(), {"factors": FACTORS, **WORDS}, Path()), self.folder / "s.h5", workers=0)
        (self.folder / "table.csv").write_text("gap (mm)\n1\n")
        (self.folder / "hard.csv").hardlink_to(self.folder / "s.h5")
        (self.folder / "photo.png").write_text("mine")
        before = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        for name, told in (("table.csv", ()), ("hard.csv", "h5")):
            self.refused(told, "export", "s.h5", "-o", name)
            with raises(InputError):
                study.to_csv(self.folder / name)
        self.refused([], "plot", "s.h5", "--picture", "ida", "--column", "force", "-o", "photo.png")
        for path, error in ((self.folder / "study.yaml", ()), (self.folder, ()), ("", ())):
            with raises(InputError, error):
                study.to_csv(path)
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.iterdir()}, before)
        self.assertEqual(self.study("export", "s.h5", "-o", "new.csv").returncode, 0)
        (self.folder / "new.csv").chmod(0o600)
        self.assertEqual(self.study("export", "s.h5", "-o", "new.csv").returncode, 0)
        self.assertEqual((self.folder / "new.csv").stat().st_mode & 0o777, 0o600)

    def test_leave_the_samples_that_a_study_names(self):
        # With the columns of an earlier export, which an export may otherwise replace.
        samples = self.folder / "samples.csv"
        samples.write_text("gap (mm),point,record,scale,im [m/s^2]\n1,0,0,1,1\n3,1,0,1,1\n")
        (self.folder / "sampled.yaml").write_text(
            "model: pair.yaml\nstudy: {factors: {gap: {of: links.*.gap, column: gap}}, sampling: {table: samples.csv}}\n"
        )
        self.assertEqual(self.study("sampled.yaml", "-o", "sampled.h5", "-q").returncode, 0)
        before = samples.read_bytes()
        self.refused([], "export", "sampled.h5", "-o", "samples.csv")
        self.assertEqual(samples.read_bytes(), before)

    def test_of_results_replace_nothing_but_results(self):
        results = pounding.run(pair())
        model = self.folder / "pair.yaml"
        before = model.read_bytes()
        for path in (model, self.folder, "/dev/null"):
            with raises(InputError):
                results.save(path)
            with raises(InputError):
                results.plot("force").savefig(path, format="png")
        self.assertEqual(model.read_bytes(), before)
        saved = self.folder / "saved.h5"
        results.save(saved)
        saved.chmod(0o640)
        pounding.read(saved).save(saved)
        self.assertEqual((saved.stat().st_mode & 0o777, pounding.read(saved).summary), (0o640, results.summary))

    def test_quote_what_a_spreadsheet_would_compute(self):
        study = run_plan(make_plan(pair(), {"factors": FACTORS, **WORDS}, Path()), None, workers=0)
        names = ("=cmd|' /C calc'!A0", "+1+1", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "-5", "plain", "a=b")
        study.records["name"] = list(names)
        study.columns["record"] = np.arange(len(study)) % len(names)
        study.columns["force"] = -study.columns["force"]
        study.to_csv(self.folder / "s.csv")
        with open(self.folder / "s.csv", newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        found = [row[head.index("record")] for row in rows[: len(names)]]
        self.assertEqual(found, [*("'" + name for name in names[:6]), "-5", "plain", "a=b"])
        self.assertTrue(all(float(row[head.index("force [N]")]) <= 0 for row in rows), "numbers stay numbers")


class ExitCodes(Files):
    def test_a_reader_that_has_seen_enough_is_no_error(self):
        run_plan(make_plan(pair(), {"factors": FACTORS, **WORDS}, Path()), self.folder / "s.h5", workers=0)
        for words in ("show s.h5 --row 3", "show s.h5 --json", "check study.yaml", "study.yaml -o s2.h5"):
            done = subprocess.run(
                [
                    "bash",
                    "-c",
                    f'{sys.executable} -m pounding study {words} | head -c 1 >/dev/null; echo "${{PIPESTATUS[0]}}"',
                ],
                cwd=self.folder,
                capture_output=True,
                text=True,
                timeout=60,
            )
            self.assertEqual((done.stdout, done.stderr), ("0\n", ""), words)
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                [sys.executable, "-m", "pounding", "study", "show", "s.h5"],
                cwd=self.folder,
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
            )
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_names_need_not_be_text(self):
        os.rename(self.folder / "study.yaml", os.fsencode(self.folder) + b"/st\xffudy.yaml")
        done = subprocess.run(
            [sys.executable, "-m", "pounding", "study", b"st\xffudy.yaml", "-o", b"s\xff.h5"],
            cwd=self.folder,
            capture_output=True,
            timeout=60,
        )
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertNotIn(b"Traceback", done.stderr)

    def test_a_limit_on_file_sizes_is_three_with_the_rows_kept(self):
        done = self.study(
            "study.yaml",
            "-o",
            "s.h5",
            "-q",
            "-j",
            "0",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (8000, 8000)),
        )
        self.assertEqual(done.returncode, 3, done.stderr)


if __name__ == "__main__":
    unittest.main()
