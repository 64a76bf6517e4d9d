"""`python3 -m pounding demo` and `lessons`, which need a compiled program and the folder of the lessons."""

import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from pounding import _demo as demo
from pounding.errors import InputError
from messages import assert_mentions, raises


def done(*words, folder):
    run = subprocess.run(
        [sys.executable, "-m", "pounding", *words], cwd=folder, capture_output=True, text=True, timeout=120
    )
    return run.returncode, run.stdout, run.stderr


class Demo(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)

    def test_leaves_the_table_and_the_picture(self):
        code, printed, told = done("demo", folder=self.folder)
        self.assertEqual((code, told), (0, ""))
        self.assertIn("left.3-right.3", printed)
        self.assertTrue(printed.endswith("\nresults      demo.h5\npicture      demo.png\n"), printed)
        self.assertEqual(sorted(os.listdir(self.folder)), ["demo.h5", "demo.png"])
        self.assertTrue((self.folder / "demo.png").read_bytes().startswith(b"\x89PNG"))

    def test_needs_no_picture(self):
        told = io.StringIO()
        with mock.patch("importlib.util.find_spec", return_value=None), contextlib.redirect_stderr(told):
            words = demo.demo_words([])
        self.assertNotIn("--plot", words)
        assert_mentions(told.getvalue(), "demo.png")

    def test_has_no_words(self):
        code, _, told = done("demo", "--fast", folder=self.folder)
        self.assertEqual(code, 2)
        assert_mentions(told, "--fast")


class Lessons(unittest.TestCase):
    def test_are_copied_as_models_and_pages(self):
        with tempfile.TemporaryDirectory() as folder:
            code, printed, told = done("lessons", folder=folder)
            self.assertEqual((code, told), (0, ""))
            copied = Path(folder) / "lessons"
            models = sorted(path.parent.name for path in copied.glob("*/model.yaml"))
            self.assertEqual(
                models,
                sorted(
                    path.parent.name
                    for path in demo.lessons().glob("*/model.yaml")
                    if (path.parent / "README.md").is_file()
                ),
            )
            self.assertGreater(len(models), 15)
            assert_mentions(printed, f"{len(models)}")
            self.assertTrue((copied / "02_two_oscillators/README.md").is_file())
            self.assertEqual({path.suffix for path in copied.rglob("*") if path.is_file()}, {".yaml", ".md"})

    def test_do_not_overwrite(self):
        with tempfile.TemporaryDirectory() as folder:
            code, printed, told = done("lessons", ".", folder=folder)
            self.assertEqual((code, printed), (2, ""))
            assert_mentions(told, "pounding")

    def test_are_missed_with_a_reason(self):
        with mock.patch.object(demo, "_PLACES", (Path("/nowhere"),)), raises(InputError, "make portable-wheel"):
            demo.lessons()


if __name__ == "__main__":
    unittest.main()
