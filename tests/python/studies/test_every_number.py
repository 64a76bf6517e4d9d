"""Every number of the schema as a factor, compared with a model edited by hand. The models are those of the input
tests, one per key."""

import collections
import copy
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding.errors import InputError
from pounding._studies.factors import is_integer, put
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan

NUMBER = re.compile(r"([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*([^0-9].*)?")
#: Values of these keys are names, even if they look like numbers.
NAMES = ("name", "channel", "record", "title", "node", "structure", "accept")
KEEP = ["displacement", "acceleration"]
WITHOUT_FLOORS = ["impacts", "penetration", "energy_lost"]


def numbers(part, keys=()):
    """Locations and texts of all numbers of a model."""
    if isinstance(part, (dict, list)):
        for key, value in part.items() if isinstance(part, dict) else enumerate(part):
            if key not in NAMES:
                yield from numbers(value, (*keys, key))
    elif isinstance(part, str) and NUMBER.fullmatch(part):
        yield keys, part


def changed(text):
    """Another value near it."""
    number, unit = NUMBER.fullmatch(text).groups()
    if is_integer(text):
        return str(int(number) + 1)
    value = repr(float(number) * 1.02 or 0.02)
    return f"{value} {unit}" if unit else value


class EveryNumber(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        subprocess.run([os.environ["POUNDING_MINIMAL_MODELS"], f"{folder.name}/"], check=True)

    def plan(self, parts, engine="solver", **words):
        model = pounding.Model.from_yaml(yaml_text.emit(parts))
        model._file = str(self.folder / "model.yaml")
        has_floors = any(one.floors for one in core.layout(model._source()).structures)
        return make_plan(
            model,
            {"keep": KEEP if has_floors else WITHOUT_FLOORS, "stop_after": "100 %", "engine": engine, **words},
            self.folder,
        )

    def row(self, plan):
        study = run_plan(plan, None, workers=0)
        return [float(study[column][0]) for column in plan.template.kept.columns], [
            reason.partition("row:")[0] for reason in study.failed.values()
        ]

    def fate(self, parts, keys, text, base):
        """Compares the row of a factor with that of a model edited by hand; returns both outcomes."""
        other, by_hand, path = changed(text), copy.deepcopy(parts), ".".join(map(str, keys))
        put(by_hand, keys, other)
        words = {"factors": {"f": {"of": path, "list": [other]}}}
        try:
            hand = self.plan(by_hand)
        except InputError:
            with self.assertRaises(InputError, msg=f"{path}: {other}"):
                self.plan(parts, **words)
            return "refused"
        plan = self.plan(parts, **words)
        self.assertEqual(
            core.check(core.Source(plan.yaml(0), "row"))[1], core.check(core.Source(hand.yaml(0), "row"))[1]
        )
        values, failed = self.row(hand)
        found, reasons = self.row(plan)
        np.testing.assert_array_equal(found, values, err_msg=f"{path}: {text} -> {other}")
        self.assertEqual(reasons, failed)
        np.testing.assert_allclose(
            self.row(self.plan(parts, "auto", **words))[0], values, rtol=5e-3, err_msg=f"{path}: engines"
        )
        return (
            "failed" if failed else "same numbers" if np.array_equal(values, base, equal_nan=True) else "other numbers"
        )

    def test_every_number(self):
        seen, fates = set(), collections.Counter()
        for file in sorted(self.folder.glob("*.yaml")):
            section, word, _ = file.name.rsplit(".", 2)
            parts = core.parse(core.Source(file.read_text(), str(file)))
            base = None
            for keys, text in numbers(parts):
                if word not in keys or (section, word, *keys[keys.index(word) :]) in seen:
                    continue
                seen.add((section, word, *keys[keys.index(word) :]))
                with self.subTest(file.name, keys=keys):
                    if base is None:
                        base, _ = self.row(self.plan(parts))
                    fates[self.fate(parts, keys, text, base)] += 1
        catalogue = json.loads(
            subprocess.run([os.environ["POUNDING_PROGRAM"], "words", "--json"], capture_output=True, check=True).stdout
        )
        # A key whose example is a name, such as `face: auto`, has a separate test.
        words = {
            (section["name"], word["key"])
            for section in catalogue
            if "study" not in section["place"] and not section["place"].startswith("records")
            for word in section["keys"]
            if word["kind"] in ("quantity", "integer") and word["example"] != "auto"
        }
        self.assertEqual(sorted(words - {place[:2] for place in seen}), [])
        self.assertGreater(fates["other numbers"], 200, fates)
        # Values at a bound of their range, such as a factor of 1, and numbers that depend on others.
        self.assertLess(fates["refused"] + fates["failed"], 0.05 * fates.total(), fates)

    def test_a_face(self):
        frame = "frame: {material: {E: 30 GPa}, grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, floor_mass: 50 t}"
        parts = core.parse(
            core.Source(
                f"""
ground_motion: {{synthetic: {{seed: 1, duration: 2 s, pga: 0.4 g, soil: firm}}}}
structures:
  left: {{{frame}}}, damping: 5 %}}
  right: {{{frame.replace("50 t", "90 t")}, origin: [6.41 m, 0]}}, damping: 5 %, face: 0.4 m}}
links: [{{between: [left, right], floors: all, law: hertz, stiffness: 1e9}}]
analysis: {{tolerance: 1e-3}}
""",
                "faces.yaml",
            )
        )
        base, _ = self.row(self.plan(parts))
        self.assertEqual(self.fate(parts, ("structures", "right", "face"), "0.4 m", base), "other numbers")


if __name__ == "__main__":
    unittest.main()
