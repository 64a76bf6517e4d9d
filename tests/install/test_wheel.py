"""The installed package, and the purpose of its extras."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from importlib.metadata import version
from pathlib import Path

import pounding
from pounding._opensees import link_process

MODEL = Path(os.environ["POUNDING_EXAMPLES"]) / "02_two_oscillators/model.yaml"


class Wheel(unittest.TestCase):
    def test_is_what_is_imported(self):
        self.assertTrue(Path(pounding.__file__).is_relative_to(sys.prefix), pounding.__file__)
        self.assertEqual(version("pounding"), pounding.__version__)

    def test_brings_the_schema_for_editors(self):
        schema = json.loads(Path(pounding.__file__).with_name("model.schema.json").read_text())
        self.assertIn("structures", schema["properties"])

    def test_brings_the_laws_for_opensees(self):
        with self.assertRaisesRegex(ValueError, 'Did you mean "hertz"'):
            link_process.Law("hertzz", "exact", {})


class Command(unittest.TestCase):
    def pounding(self, *words, folder=None):
        done = subprocess.run(
            [Path(sys.executable).with_name("pounding"), *words], cwd=folder, capture_output=True, text=True
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_is_the_program(self):
        self.assertEqual(self.pounding("--version"), f"pounding {pounding.__version__}\n")

    def test_runs_and_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            printed = self.pounding("run", MODEL, "--plot", folder=folder)
            self.assertTrue(printed.endswith("\nresults      model.h5\npicture      model.png\n"), printed)
            self.assertEqual(
                self.pounding("export", "model.h5", folder=folder),
                "export       model.xdmf\nexport       model.data.h5\n",
            )
            self.assertEqual(len(pounding.read(Path(folder) / "model.h5").impacts), 5)


class Extras(unittest.TestCase):
    def test_draw(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "force.png"
            pounding.run(MODEL, tolerance=1e-3).plot("force").savefig(picture)
            self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_fill_tables(self):
        results = pounding.run(MODEL, tolerance=1e-3)
        self.assertEqual(len(results.to_pandas()["impacts"]), 5)
        self.assertEqual(results.to_xarray()["impacts"].sizes, {"impact": 5})

    def test_bring_records(self):
        self.assertGreater(Path(pounding.record("elcentro")).stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
