"""The experiments: the numbers on the page, and those that the program computes."""

import csv
import hashlib
import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).parent
BEAMS = HERE / "adjacent_cantilevers"
SPHERE = HERE / "sphere_on_glass"
PAGE = (HERE.parents[1] / "python" / "docs" / "guide" / "experiments.md").read_text()
sys.path.append(str(BEAMS))

#: Frequencies of the same model by another program, and the measured ones [Hz]: adjacent cantilevers.
LISTED = {"left": [30.944, 202.07, 560.66, 1090.5], "right": [28.401, 208.87, 273.86, 588.79, 1124.3]}
MEASURED = {"left": [30.95, 199.04, 556.82, 1085.93], "right": [28.20, 205.54, 277.74, 594.98, 1168.62]}


def rows(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def table(caption):
    """Rows of numbers of the table of the page below a line that contains this text."""
    lines = PAGE[PAGE.index(caption) :].splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith("|"))
    found = []
    for line in lines[begin + 2 :]:
        if not line.startswith("|"):
            break
        found.append([cell.strip() for cell in line.strip("|").split("|")])
    return found


class Beams(unittest.TestCase):
    def test_have_the_listed_frequencies(self):
        command = [os.environ["POUNDING_PROGRAM"], "modes", str(BEAMS / "model.yaml"), "--json"]
        modes = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        printed = table("Frequencies of the beams")
        self.assertEqual(len(printed), 9)
        for name, listed in LISTED.items():
            own = [row for row in printed if row[0] == name]
            for i, expected in enumerate(listed):
                found = 1 / modes[name][i]["period"]
                self.assertLess(abs(found / expected - 1), 1e-3, (name, i))
                self.assertLess(abs(found - float(own[i][2])), 0.006 * 10 ** (found > 1000))
                self.assertEqual([float(own[i][3]), float(own[i][4])], [expected, MEASURED[name][i]])

    def test_have_the_published_prediction(self):
        for name, count in (("prediction_rest.csv", 3 * 3 * 13), ("prediction_stepped.csv", 3 * 13)):
            data = (BEAMS / name).read_bytes()
            self.assertIn(hashlib.sha256(data).hexdigest(), PAGE)
            self.assertEqual(len(rows(BEAMS / name)), count)
        rest, stepped = rows(BEAMS / "prediction_rest.csv"), rows(BEAMS / "prediction_stepped.csv")
        for level, *bands in table("Largest amplitude"):
            cases = ((rest, 0.0005), (rest, 0.001), (rest, 0.003), (stepped, 0.001))
            for (found, damping), printed in zip(cases, bands, strict=True):
                own = [
                    r for r in found if r["base_acceleration_m_s2"] == float(level) and r["damping_ratio"] == damping
                ]
                best = max(own, key=lambda r: r["amplitude_over_gap"])
                text = f"{best['amplitude_over_gap']:.2f} at {best['frequency_over_28.2_Hz']:g}"
                self.assertEqual(printed, text)

    def test_have_computed_points_of_the_prediction(self):
        try:
            import sweep
        except ImportError as error:
            self.skipTest(str(error))
        for level, damping, ratio, allowed in ((0.020, 0.003, 1.0, 1e-3), (0.020, 0.001, 1.01, 0.03)):
            expected = next(
                r
                for r in rows(BEAMS / "prediction_rest.csv")
                if (r["base_acceleration_m_s2"], r["damping_ratio"], r["frequency_over_28.2_Hz"])
                == (level, damping, ratio)
            )["amplitude_over_gap"]
            found = sweep.from_rest(level, ratio, damping)[0]
            self.assertLess(abs(found / expected - 1), allowed)


class Sphere(unittest.TestCase):
    def test_has_the_printed_values(self):
        printed = table("Sphere on glass, measured")
        measured, computed = rows(SPHERE / "measured.csv"), rows(SPHERE / "computed.csv")
        self.assertEqual(len(printed), 13)
        for row, m, c in zip(printed, measured, computed, strict=True):
            expected = (
                f"{m['angle_e_t_deg']:.1f}",
                f"{m['tangential_restitution']:.3f}",
                f"{c['mindlin_tangential']:.3f}",
                f"{-m['spin_rad_s']:.1f}",
                f"{c['mindlin_spin']:.1f}",
                f"{m['rebound_angle_deg']:.1f}",
                f"{c['mindlin_angle']:.1f}",
            )
            self.assertEqual(tuple(row[:7]), expected)
            agrees = (
                abs(c["mindlin_tangential"] - m["tangential_restitution"]) <= 0.03
                and abs(c["mindlin_spin"] / -m["spin_rad_s"] - 1) <= 0.03
            )
            self.assertEqual(row[7], "yes" if agrees else "no")

    def test_states_the_largest_deviations(self):
        """The text below the table names the angles that do not agree."""
        angles = [row[0] for row in table("Sphere on glass, measured") if row[7] == "no"]
        text = re.search(r"do not agree at ([^:]*) degrees", PAGE)
        self.assertEqual(re.findall(r"[\d.]+", text[1]), angles)


if __name__ == "__main__":
    unittest.main()
