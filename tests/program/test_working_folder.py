"""Files of the working folder that PETSc, Python and matplotlib would read: a folder with a model may come from
anywhere."""

import json
import os
import subprocess
import unittest
from pathlib import Path

import h5py
from support import OSCILLATORS, PROGRAM, ProgramTest
from messages import assert_mentions

#: Modules imported by the commands or by Python at its start. On import each writes one file.
MODULES = (
    "numpy",
    "h5py",
    "matplotlib",
    "PIL",
    "pounding",
    "yaml",
    "scipy",
    "json",
    "argparse",
    "pathlib",
    "runpy",
    "sitecustomize",
    "usercustomize",
)
STUDY = "study:\n  factors: {gap: {of: links.*.gap, list: [10 mm, 20 mm]}}\n"


class Options(ProgramTest):
    """PETSc reads ~/.petscrc, .petscrc and petscrc by default."""

    def setUp(self):
        super().setUp()
        self.write(OSCILLATORS)
        self.steps = self.summary("model.yaml")["solver"]["steps"]
        self.home = self.folder / "home"
        self.home.mkdir()

    def put(self, options):
        for name in (".petscrc", "petscrc", "home/.petscrc"):
            self.write(options, name)

    def test_of_files_change_no_result(self):
        self.put("-pounding_ts_rtol 1e-1\n-pounding_ts_max_steps 3\n")
        done = self.pounding("run", "model.yaml", "--json", HOME=str(self.home))
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["solver"]
        self.assertEqual(found["steps"], self.steps)
        self.assertNotIn("options", found)

    def test_of_files_load_and_write_nothing(self):
        self.put("-dll_append /nowhere/libnothing.so\n-log_view :mine.txt\n-options_view\n")
        self.write("mine", "mine.txt")
        for words in (("check", "model.yaml"), ("run", "model.yaml"), ("modes", "model.yaml")):
            done = self.pounding(*words, HOME=str(self.home))
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            self.assertNotIn("options_view", done.stdout)
        self.assertEqual((self.folder / "mine.txt").read_text(), "mine")

    def test_of_the_environment_hold_and_are_reported(self):
        options = {"PETSC_OPTIONS": "-pounding_ts_rtol 1e-6 -malloc_debug 0"}
        done = self.pounding("run", "model.yaml", "-o", "out.h5", "-pounding_ts_max_steps", "100000", **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = ["-malloc_debug 0", "-pounding_ts_max_steps 100000", "-pounding_ts_rtol 1e-6"]
        assert_mentions(done.stdout, " ".join(told))
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(file["solver"].attrs["options"], " ".join(told))
            summary = json.loads(file["summary"][()])
        self.assertEqual(summary["solver"]["options"], told)
        self.assertGreater(summary["solver"]["steps"], self.steps)

    def test_without_any_are_not_reported(self):
        done = self.pounding("run", "model.yaml", "-o", "out.h5")
        self.assertNotIn("options", done.stdout)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(file["solver"].attrs["options"], "")

    def test_do_not_follow_another_one_as_its_value(self):
        self.refused(2, "-dll_append", "run", "model.yaml", "-q", "-pounding_ts_view", "-dll_append")


class Modules(ProgramTest):
    """Python puts the working folder first in its module path."""

    def setUp(self):
        super().setUp()
        self.write(OSCILLATORS)
        self.assertEqual(self.pounding("run", "model.yaml", "-q", "-o", "out.h5").returncode, 0)
        self.write(OSCILLATORS + STUDY, "study.yaml")
        for name in MODULES:
            self.write(
                f"open({str(self.folder / 'imported')!r}, 'a').write({name!r})\nraise SystemExit('foreign code')\n",
                f"{name}.py",
            )

    def commands(self):
        yield ("plot", "out.h5", "-o", "picture.png")
        yield ("animate", "out.h5", "-o", "film.gif", "--frames", "2")
        yield ("export", "out.h5", "-o", "out.xdmf")
        yield ("modes", "model.yaml", "-o", "modes.png")
        # Studies need the compiled part of the package.
        if list(Path(PROGRAM).resolve().parent.glob("python/pounding/_core*")):
            yield ("study", "study.yaml", "-o", "table.h5", "-j", "1", "-q")
            yield ("separation", "model.yaml", "-j", "0")

    def test_of_the_working_folder_are_not_imported(self):
        for path in (None, "", ":", "/nowhere:", ".", f":{self.folder}/other", "other"):
            for words in self.commands():
                with self.subTest(words=words, path=path):
                    done = self.pounding(*words, **({} if path is None else {"PYTHONPATH": path}))
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertFalse((self.folder / "imported").exists())
                    (self.folder / "table.h5").unlink(missing_ok=True)
                if path is not None and words[0] == "plot":
                    break

    def test_of_an_absolute_path_that_the_user_names_are_imported(self):
        (self.folder / "mine").mkdir()
        self.write(f"open({str(self.folder / 'asked')!r}, 'w')\n", "mine/sitecustomize.py")
        self.assertEqual(
            self.pounding("plot", "out.h5", "-o", "picture.png", PYTHONPATH=str(self.folder / "mine")).returncode, 0
        )
        self.assertTrue((self.folder / "asked").exists())

    def test_a_python_of_the_working_folder_does_not_run(self):
        fake = self.folder / "python3"
        fake.write_text(f"#!/bin/sh\ntouch {self.folder}/imported\n")
        fake.chmod(0o755)
        for chosen in ("", "python3"):
            self.pounding(
                "plot", "out.h5", "-o", "picture.png", PATH=f":.:{os.environ['PATH']}", POUNDING_PYTHON=chosen
            )
            self.assertFalse((self.folder / "imported").exists())


class Libraries(ProgramTest):
    """An empty entry in the program search path is the working folder."""

    def test_of_the_working_folder_are_not_loaded(self):
        needed = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
        names = [line.split()[0] for line in needed.splitlines() if "=>" in line]
        self.assertGreater(len(names), 5)
        for name in names:
            self.write("no library", name)
        done = self.pounding("--version")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Settings(ProgramTest):
    """matplotlib prefers the matplotlibrc of the working folder to that of the user."""

    def test_of_the_working_folder_draw_nothing(self):
        self.write(OSCILLATORS)
        self.assertEqual(self.pounding("run", "model.yaml", "-q", "-o", "out.h5").returncode, 0)
        commands = {"picture.png": ("plot", "out.h5"), "film.gif": ("animate", "out.h5", "--frames", "2")}
        drawn = {}
        for settings in (
            None,
            "figure.facecolor: red\nbackend: module://evil\nsavefig.facecolor: red\ntext.usetex: True\n",
        ):
            if settings:
                self.write(settings, "matplotlibrc")
                self.write(f"open({str(self.folder / 'imported')!r}, 'a')\n", "evil.py")
            for name, words in commands.items():
                done = self.pounding(*words, "-o", name)
                self.assertEqual(done.returncode, 0, done.stderr)
                content = (self.folder / name).read_bytes()
                self.assertEqual(content, drawn.setdefault(name, content), name)
        self.assertFalse((self.folder / "imported").exists())


if __name__ == "__main__":
    unittest.main()
