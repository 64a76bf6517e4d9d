"""The lessons in C++, built against the installed package, print the numbers that their READMEs state."""

import os
import re
import subprocess
import unittest
from pathlib import Path

BUILT = Path(os.environ["POUNDING_HOSTS"]).parent
EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
EXPECT = re.compile(r"^Expect: `(?P<numbers>[^`]+)` within (?P<tolerance>[\d.e+-]*\d)", re.MULTILINE)


@unittest.skipUnless(BUILT.is_dir(), "the lessons are not built")
class LessonsInCpp(unittest.TestCase):
    def test_every_lesson_prints_its_numbers(self):
        lessons = sorted(path.parent for path in EXAMPLES.glob("[0-9]*/CMakeLists.txt"))
        self.assertEqual([lesson.name for lesson in lessons], ["15_your_own_law", "16_model_in_cpp"])
        for lesson in lessons:
            with self.subTest(lesson.name):
                program = BUILT / lesson.name / lesson.name.split("_", 1)[1]
                printed = subprocess.run(
                    [program], capture_output=True, text=True, check=True, timeout=60
                ).stdout.split()
                said = EXPECT.search((lesson / "README.md").read_text())
                expected = said["numbers"].split()
                self.assertEqual(len(printed), len(expected))
                for number, right in zip(printed, expected):
                    self.assertAlmostEqual(float(number) / float(right), 1, delta=float(said["tolerance"]))


if __name__ == "__main__":
    unittest.main()
