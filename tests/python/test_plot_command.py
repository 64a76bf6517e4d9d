"""`pounding plot` on the command line: the picture, the exit code, and the message if Python cannot help."""

import os
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path
from messages import assert_mentions

PROGRAM = os.environ["POUNDING_PROGRAM"]
WRITER = os.environ["POUNDING_RESULTS_WRITER"]
ADVICE = (
    "Type `make python` in the source directory, or `python3 -m pip install numpy h5py matplotlib`, or set the "
    "environment variable POUNDING_PYTHON to a Python that has them."
)


class PlotCommand(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        # Such a name must not confuse a shell or an option parser.
        self.results = self.directory / "-a run; $HOME.h5"
        subprocess.run([WRITER, "alone", self.results], check=True)

    def plot(self, *arguments, python=None):
        environment = dict(os.environ, **({"POUNDING_PYTHON": str(python)} if python else {}))
        return subprocess.run(
            [PROGRAM, "plot", *map(str, arguments)],
            env=environment,
            cwd=self.directory,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
        )

    def false_python(self, script):
        path = self.directory / "python"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(stat.S_IRWXU)
        return path

    def test_picture_is_written_into_the_current_folder_and_named(self):
        kept, self.directory = self.directory, self.directory / "elsewhere"
        self.directory.mkdir()
        done = self.plot(self.results)
        name = self.results.with_suffix(".png").name
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"picture      {name}\n", ""))
        self.assertEqual((self.directory / name).read_bytes()[1:4], b"PNG")
        self.assertEqual(sorted(path.name for path in kept.iterdir()), [self.results.name, "elsewhere"])

    def test_name_and_kind_can_be_chosen(self):
        done = self.plot(self.results, "-o", "other.svg", "--title", "Chosen")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("<svg", (self.directory / "other.svg").read_text())

    def test_arguments_reach_python_unchanged(self):
        python = self.false_python('printf "%s\\n" "$@" > arguments\n')
        self.assertEqual(
            self.plot("--title", "a 'b' $c", "-o", "x y.png", "--", "-run.h5", python=python).returncode, 0
        )
        self.assertEqual(
            (self.directory / "arguments").read_text().splitlines(),
            ["-m", "pounding._plots", "-o", "x y.png", "--title=a 'b' $c", "--", "-run.h5"],
        )

    def test_other_pictures_have_names_of_their_own(self):
        for kind in ("model", "profiles"):
            done = self.plot(self.results, "--picture", kind)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            picture = self.results.with_name(f"{self.results.stem}-{kind}.png")
            self.assertEqual(picture.read_bytes()[1:4], b"PNG")

    def test_unknown_floor_is_named(self):
        done = self.plot(self.results, "--floors", "left.2")
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, "2")

    def test_missing_results_are_named(self):
        done = self.plot("none.h5")
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, "none.h5")

    def test_an_input_file_is_told_from_results(self):
        (self.directory / "model.yaml").write_text("title: a\n")
        for command in ("plot", "animate", "export"):
            done = subprocess.run(
                [PROGRAM, command, "model.yaml"],
                cwd=self.directory,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
            )
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            assert_mentions(done.stderr, ["pounding run", "-o", "model.yaml", "model.h5"])
        (self.directory / "picture.png").write_bytes(b"PNG")
        assert_mentions(self.plot("picture.png").stderr, "picture.png")

    def test_missing_python_says_what_to_install(self):
        done = self.plot(self.results, python="/no/python")
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, ["/no/python", f"{ADVICE}"])

    def test_missing_package_says_what_to_install(self):
        python = self.false_python(
            "echo Traceback >&2\necho \"ModuleNotFoundError: No module named 'h5py'\" >&2\nexit 1\n"
        )
        done = self.plot(self.results, python=python)
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, [f"{python}", "h5py", f"{ADVICE}"])

    def test_last_line_of_a_traceback_is_reported(self):
        python = self.false_python("echo Traceback >&2\necho 'ValueError: 7' >&2\nexit 1\n")
        done = self.plot(self.results, python=python)
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, "7")

    def test_killed_python_is_an_error(self):
        done = self.plot(self.results, python=self.false_python("kill -9 $$\n"))
        self.assertEqual(done.returncode, 2)
        assert_mentions(done.stderr, "137")


if __name__ == "__main__":
    unittest.main()
