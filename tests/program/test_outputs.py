"""Output files of the commands: they replace only earlier ones of the same kind, keep the file mode, and end with exit
code 0, 2 or 3."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
from support import OSCILLATORS, PROGRAM, ProgramTest
from messages import assert_mentions

#: 10 s at 0.02 s, as `pounding record` reads it.
RECORD = "time (s),acc (g)\n" + "".join(f"{0.02 * i:.2f},{(-1) ** i * 0.1}\n" for i in range(100))


class Outputs(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.verbs = [
            (["record", "spectrum", "rec.csv"], "--csv", "made.csv"),
            (["record", "spectrum", "rec.csv"], "--picture", "made.png"),
            (["spectrum", "out.h5", "--floor", "left.1"], "--csv", "made.csv"),
            (["plot", "out.h5"], "-o", "made.png"),
            (["animate", "out.h5", "--frames", "3"], "-o", "made.gif"),
            (["export", "out.h5"], "-o", "made.xdmf"),
            (["modes", "model.yaml"], "-o", "made.pdf"),
            (["run", "model.yaml", "-q"], "-o", "made.h5"),
            (["run", "model.yaml", "-q", "-o", "made.h5"], "--picture", "made.png"),
        ]

    def setUp(self):
        super().setUp()
        self.write(
            OSCILLATORS.replace("duration: 3.0}}", "duration: 1.0}}").replace("{duration: 3.0}", "{duration: 1.0}")
        )
        self.write(RECORD, "rec.csv")
        self.assertEqual(self.pounding("run", "model.yaml", "-q", "-o", "out.h5").returncode, 0)

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}

    def test_inputs_stay_under_every_name(self):
        os.link(self.folder / "rec.csv", self.folder / "hard.csv")
        (self.folder / "soft.csv").symlink_to("rec.csv")
        # Models, records and results are inputs, whatever their suffix.
        for given, name in (
            ("rec.csv", "given.png"),
            ("model.yaml", "given.gif"),
            ("out.h5", "given.xdmf"),
            ("model.yaml", "given.pdf"),
        ):
            os.link(self.folder / given, self.folder / name)
        before = self.contents()
        for words, option, made in self.verbs:
            kind = made.rpartition(".")[2]
            targets = {
                "csv": [
                    "rec.csv",
                    "./rec.csv",
                    f"{self.folder}/rec.csv",
                    "hard.csv",
                    "soft.csv",
                    "model.yaml",
                    "out.h5",
                ],
                "h5": ["rec.csv", "model.yaml"],
            }
            for target in targets.get(kind, [f"given.{kind}"]):
                with self.subTest(words=words, target=target):
                    done = self.pounding(*words, option, target)
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    assert_mentions(done.stderr, target)
                    self.assertNotIn("Traceback", done.stderr)
                    after = self.contents()
                    after.pop("made.h5", None)
                    self.assertEqual(after, before)

    def test_an_earlier_file_is_replaced_and_keeps_its_mode(self):
        for words, option, made in self.verbs:
            with self.subTest(words):
                path = self.folder / made
                self.assertEqual(self.pounding(*words, option, made).returncode, 0)
                path.chmod(0o640)
                self.assertEqual(self.pounding(*words, option, made).returncode, 0)
                self.assertEqual(path.stat().st_mode & 0o777, 0o640)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".")])

    def test_what_is_no_file_is_refused_and_does_not_hang(self):
        for words, option, made in self.verbs:
            kind = made.rpartition(".")[2]
            fifo, folder, device = (self.folder / f"{name}.{kind}" for name in ("fifo", "folder", "device"))
            if not fifo.exists():
                os.mkfifo(fifo)
                folder.mkdir()
                device.symlink_to("/dev/null")
            others = (
                (folder, "it is a directory"),
                (device, "not a regular file"),
                (self.folder / "missing" / made, "mkdir -p"),
            )
            # The files of the program and those of Python each have one guard: one command of each is enough.
            for target, told in ((fifo, ()), *(others if words[0] in ("record", "export") else ())):
                with self.subTest(words=words, target=target.name):
                    done = self.pounding(*words, option, target)
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    assert_mentions(done.stderr, told)

    def test_symbolic_links_stay_links(self):
        (self.folder / "data").mkdir()
        for words, option, made in self.verbs:
            link = self.folder / f"link{self.verbs.index((words, option, made))}.{made.rpartition('.')[2]}"
            link.symlink_to(f"data/{link.name}")
            with self.subTest(words):
                self.assertEqual(self.pounding(*words, option, link.name).returncode, 0)
                self.assertTrue(link.is_symlink() and (self.folder / "data" / link.name).is_file())

    def test_frames_of_a_film_replace_nothing_else(self):
        self.write("measured", "film_0002.png")
        done = self.pounding("animate", "out.h5", "--frames", "3", "-o", "film.png")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual((self.folder / "film_0002.png").read_text(), "measured")
        self.assertFalse((self.folder / "film_0001.png").exists())

    def test_a_picture_that_cannot_be_written_is_told_before_the_run(self):
        self.write("measured", "mine.png")
        self.refused(2, "mine.png", "run", "model.yaml", "-q", "-o", "new.h5", "--picture", "mine.png")
        self.assertFalse((self.folder / "new.h5").exists())

    def test_a_reproduction_leaves_folders_of_others_alone(self):
        (self.folder / "mine").mkdir()
        self.write("{}", "mine/report.json")
        self.refused(2, "mine", "reproduce", "-o", "mine", "--only", "table2")
        os.rename(self.folder / "mine/report.json", self.folder / "mine/notes.txt")
        self.refused(2, "mine", "reproduce", "-o", "mine", "--only", "table2")
        self.assertEqual(os.listdir(self.folder / "mine"), ["notes.txt"])


class ExitCodes(ProgramTest):
    def test_a_reader_that_has_seen_enough_is_no_error(self):
        self.write(OSCILLATORS)
        for words in ("words", "laws", "run model.yaml -o out.h5", "check model.yaml", "words --json", "plot out.h5"):
            with self.subTest(words):
                done = subprocess.run(
                    ["bash", "-c", f'{PROGRAM} {words} | head -c 1 >/dev/null; echo "${{PIPESTATUS[0]}}"'],
                    cwd=self.folder,
                    capture_output=True,
                    text=True,
                    timeout=60,
                )
                self.assertEqual((done.stdout, done.stderr), ("0\n", ""))
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(file.attrs["status"], "done", "the run continued")

    def test_a_closed_stream_is_no_part_of_the_results(self):
        self.write(OSCILLATORS)
        done = subprocess.run(
            ["bash", "-c", f"{PROGRAM} run model.yaml -o out.h5 >&- 2>&- <&-"], cwd=self.folder, timeout=60
        )
        self.assertEqual(done.returncode, 2)
        self.assertEqual(self.pounding("export", "out.h5").returncode, 0, "the results are whole")

    def test_of_commands_of_python_are_those_of_the_program(self):
        """Warnings that cannot be printed do not fail the run; a full device for the screen does not affect the
        table."""
        self.write(OSCILLATORS)
        self.assertEqual(self.pounding("run", "model.yaml", "-q", "-o", "out.h5").returncode, 0)
        # The bare limit has a warning.
        self.write(
            OSCILLATORS
            + "study: {factors: {gap: {of: links.*.gap, list: [20 mm]}}, keep: [drift], limits: {drift: 0.004}}\n",
            "study.yaml",
        )
        commands = ["export out.h5"]
        # Studies need the compiled part of the package.
        if list(Path(PROGRAM).resolve().parent.glob("python/pounding/_core*")):
            commands += ["study study.yaml -j 0", "study check study.yaml", "separation model.yaml -j 0"]
        for words in commands:
            for streams, right in (("2>&1 | true", 0), ("2>&-", 0), ("2>/dev/full", 0), (">/dev/full", 2), (">&-", 2)):
                with self.subTest(words=words, streams=streams):
                    (self.folder / "study.h5").unlink(missing_ok=True)
                    done = subprocess.run(
                        ["bash", "-c", f'{PROGRAM} {words} {streams}; exit "${{PIPESTATUS[0]}}"'],
                        cwd=self.folder,
                        capture_output=True,
                        text=True,
                        timeout=60,
                    )
                    self.assertEqual(done.returncode, right, done.stderr)
                    self.assertEqual("the output could not be written" in done.stderr, right == 2, done.stderr)

    def test_what_cannot_be_printed_is_two(self):
        self.write(OSCILLATORS)
        with open("/dev/full", "w") as full:
            for words in (["words"], ["laws"], ["check", "model.yaml"], ["modes", "model.yaml"]):
                done = subprocess.run(
                    [PROGRAM, *words], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60
                )
                self.assertEqual((done.returncode, done.stderr), (2, "pounding: the output could not be written\n"))

    def test_of_modules_of_python_are_those_of_the_program(self):
        self.write(OSCILLATORS)
        self.write("not json", "broken.json")
        for module, words in (
            ("_plots", ["missing.h5"]),
            ("_plots", ["model.yaml"]),
            ("_export", ["model.yaml"]),
            ("animation", ["missing.h5"]),
            ("_mode_shapes", ["broken.json", "-o", "a.png"]),
            ("_spectra", ["broken.json", "-o", "a.png"]),
            ("_pushover_curve", ["broken.json", "-o", "a.png"]),
            ("_reproduce", ["broken.json", "-o", "a.html"]),
            ("_plots", ["--oops"]),
        ):
            with self.subTest(module=module, words=words):
                done = subprocess.run(
                    [os.environ.get("POUNDING_PYTHON", sys.executable), "-m", f"pounding.{module}", *words],
                    cwd=self.folder,
                    capture_output=True,
                    text=True,
                    env=os.environ | {"PYTHONPATH": os.environ["POUNDING_SOURCES"]},
                    timeout=60,
                )
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
