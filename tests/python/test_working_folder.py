"""`python3 -m pounding` imports no module of the working folder."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import pounding

PACKAGE = Path(pounding.__file__).parents[1]
MODEL = """\
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 1.0}}
structures:
  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}
links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]
analysis: {duration: 1.0, output_step: 5 ms}
"""
STUDY = MODEL + "study:\n  factors: {gap: {of: links.*.gap, list: [10 mm, 20 mm]}}\n  engine: solver\n"
#: Python itself imports some others before the package, which cannot exclude them.
MODULES = ("numpy", "h5py", "matplotlib", "yaml", "scipy", "argparse", "multiprocessing", "tempfile")


class WorkingFolder(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = Path(made.name)
        for name in MODULES:
            (self.folder / f"{name}.py").write_text(f"open({str(self.folder / 'imported')!r}, 'a').write({name!r})\n")
        (self.folder / "model.yaml").write_text(MODEL)
        (self.folder / "study.yaml").write_text(STUDY)

    def done(self, *words, path=str(PACKAGE), **environment):
        variables = (
            {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
            | {"PYTHONPATH": path}
            | environment
        )
        return subprocess.run(
            [sys.executable, "-m", *words], cwd=self.folder, env=variables, capture_output=True, text=True, timeout=120
        )

    def test_holds_no_module_of_a_command(self):
        for path in (str(PACKAGE), f":{PACKAGE}", f"{PACKAGE}:.", f"{PACKAGE}:{self.folder}"):
            for words in (
                ("pounding", "run", "model.yaml", "-q", "-o", "out.h5"),
                ("pounding", "plot", "out.h5"),
                ("pounding._plots", "out.h5"),
                ("pounding", "study", "study.yaml", "-j", "1", "-q"),
                ("pounding", "separation", "model.yaml", "-j", "1"),
            ):
                with self.subTest(words=words, path=path):
                    done = self.done(*words, path=path)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertFalse((self.folder / "imported").exists(), done.stderr)
                    (self.folder / "study.h5").unlink(missing_ok=True)

    def test_is_a_path_of_modules_for_scripts_as_ever(self):
        (self.folder / "script.py").write_text("import pounding, mine\nprint(mine.number)\n")
        (self.folder / "mine.py").write_text("number = 7\n")
        done = subprocess.run(
            [sys.executable, "script.py"],
            cwd=self.folder,
            env=os.environ | {"PYTHONPATH": str(PACKAGE)},
            capture_output=True,
            text=True,
            timeout=120,
        )
        self.assertEqual((done.stdout, done.returncode), ("7\n", 0), done.stderr)

    def test_may_hold_the_package_itself(self):
        done = subprocess.run(
            [sys.executable, "-m", "pounding", "laws"],
            cwd=PACKAGE,
            capture_output=True,
            text=True,
            timeout=120,
            env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"},
        )
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
