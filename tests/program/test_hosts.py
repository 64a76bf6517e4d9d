"""The programs of examples/hosts converge to the answers of `pounding run` with decreasing steps.

The position of a touch within a step is random, and so is some of the error: errors are root mean squares over several
step lengths, and over quarters of these lengths. Jankowski's dashpot d^(1/4) d' limits the order to 5/4: the error in
impulse of a step with a touch scales with this power of its length. The converged answer is the program's at a
tolerance of 1e-8.
"""

import json
import math
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

HOSTS = Path(os.environ["POUNDING_HOSTS"])
EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
PROGRAM = os.environ["POUNDING_PROGRAM"]
EXPECT = re.compile(r"^Expect: `(?P<answer>[^`]+)` within (?P<tolerance>\S+) at (?P<steps>\d+) steps", re.MULTILINE)
STEPS = [20000, 23000, 26500, 30500, 35000]
FEW_STEPS = [5000, 5700, 6500, 7300, 8300]


def converged(law):
    """Peak displacements [m], peak force [N], and the number of impacts."""
    text = (EXAMPLES / "02_two_oscillators/model.yaml").read_text()
    text = text.replace("law: jankowski", f"law: {law}").replace("1e-6", "1e-8")
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / "model.yaml"
        model.write_text(text)
        done = subprocess.run(
            [PROGRAM, "run", str(model), "--json"], capture_output=True, text=True, check=True, timeout=60
        )
    summary = json.loads(done.stdout)
    peaks = [summary["structures"][name]["peak_displacement"][0] for name in ("left", "right")]
    return peaks + [summary["links"][0]["peak_force"]], summary["links"][0]["impacts"]


def answer(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True, timeout=60)
    *peaks, impacts = done.stdout.split()
    return [float(each) for each in peaks], int(impacts)


@unittest.skipUnless(HOSTS.is_dir(), "the hosts are not built")
class Hosts(unittest.TestCase):
    def errors(self, command, law, lengths):
        """The README of the program states its output."""
        expected, impacts = converged(law)
        squares = []
        for factor in (1, 4):
            parts = []
            for steps in lengths:
                peaks, count = answer(*command(factor * steps))
                self.assertEqual(count, impacts)
                parts += [(peak / right - 1) ** 2 for peak, right in zip(peaks, expected)]
            squares.append(math.sqrt(sum(parts) / len(parts)))
        return squares

    def expect(self, folder, order, command, law="jankowski", finest=1e-4, lengths=STEPS):
        program = HOSTS / folder
        if not program.exists():
            self.skipTest(f"{program} is not built")
        if law == "jankowski":
            self.check_page(folder, lambda steps: command(program, steps))
        coarse, fine = self.errors(lambda steps: command(program, steps), law, lengths)
        self.assertAlmostEqual(math.log(coarse / fine, 4), order, delta=0.3)
        self.assertLess(fine, finest)

    def check_page(self, folder, command):
        """The README next to the program quotes its output."""
        said = EXPECT.search((EXAMPLES / "hosts" / folder).with_name("README.md").read_text())
        *peaks, impacts = map(float, said["answer"].split())
        printed, count = answer(*command(said["steps"]))
        self.assertEqual(count, impacts)
        for number, right in zip(printed, peaks):
            self.assertAlmostEqual(number / right, 1, delta=float(said["tolerance"]))

    def test_central_differences(self):
        self.expect("central_difference/central_difference", 1.25, lambda program, steps: (program, steps))

    def test_c(self):
        self.expect("c/two_oscillators_in_c", 1.25, lambda program, steps: (program, steps))

    # The remaining error is that of the peak force, read at the ends of steps.
    def test_c_with_a_law_without_corners(self):
        self.expect(
            "c/two_oscillators_in_c", 2, lambda program, steps: (program, steps, "hertz_damped"), law="hertz_damped"
        )

    # The implicit codes start an impact at the end of its first step.
    def test_fortran(self):
        self.expect("fortran/two_oscillators_in_fortran", 1.25, lambda program, steps: (program, steps), finest=1e-3)

    def test_petsc_alpha2(self):
        self.expect(
            "petsc_alpha2/petsc_alpha2",
            1.25,
            lambda program, steps: (program, "-steps", steps),
            finest=1e-3,
            lengths=FEW_STEPS,
        )

    def test_user_element(self):
        self.expect("user_element/user_element", 1.25, lambda program, steps: (program, steps), finest=1e-3)

    def test_user_element_with_numerical_damping(self):
        self.expect("user_element/user_element", 1.25, lambda program, steps: (program, steps, -0.05), finest=1e-3)


if __name__ == "__main__":
    unittest.main()
