"""`pounding words`: every input key for readers, for programs, and as a schema for editors."""

import json
import os
import subprocess
import unittest
from pathlib import Path

import jsonschema
import yaml

from support import PROGRAM
from messages import assert_mentions

EXAMPLES = os.environ["POUNDING_EXAMPLES"]

PAIR = """
structures:
  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4}, damping: 5 %}
"""
LINK = PAIR + "links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]\n"


def words(*arguments):
    return subprocess.run([PROGRAM, "words", *arguments], capture_output=True, text=True)


class Words(unittest.TestCase):
    def test_a_key_has_all_its_facts(self):
        done = words("gap")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for line in (
            "links[].gap",
            "  takes     a length [m], or a list of them",
            "  example   gap: 20 mm",
            "  since     0.1.0",
        ):
            self.assertIn(line, done.stdout.splitlines())

    def test_a_key_of_several_sections_is_shown_in_each(self):
        printed = words("stiffness").stdout
        for place in (
            "structures.NAME.oscillator.stiffness",
            "structures.NAME.shear_building.stiffness",
            "structures.NAME.frame.springs[].stiffness",
            "links[] with law: hertz_damped.stiffness",
        ):
            self.assertIn(place + "\n", printed)

    def test_a_section_and_a_law_show_their_keys(self):
        assert_mentions(words("synthetic").stdout, ["[rad/s]", "omega_g"])
        assert_mentions(words("kuwabara_kono").stdout, ["[s]", "dissipation_time"])

    def test_an_unknown_word_is_answered_by_the_nearest(self):
        for asked, near in (("gpa", "gap"), ("stiff", "stiffness"), ("Restitution", "restitution")):
            done = words(asked)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            assert_mentions(done.stderr, [f"{asked}", f"{near}"])
        self.assertEqual(words("xyzzy").returncode, 2)
        self.assertEqual(words("--schema", "gap").returncode, 2)
        self.assertEqual(words("--schema", "--json").returncode, 2)

    def test_all_of_them_are_listed(self):
        everything = words().stdout
        for section in json.loads(words("--json").stdout):
            for word in section["keys"]:
                assert_mentions(everything, f"{word['key']}")
        assert_mentions(everything, ["no_pounding", "pounding words law"])
        self.assertEqual([s["place"] for s in json.loads(words("gap", "--json").stdout)], ["links[]"])


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(words("--schema").stdout)
        jsonschema.Draft202012Validator.check_schema(cls.schema)
        cls.validator = jsonschema.Draft202012Validator(cls.schema)

    def faults(self, text):
        return [error.message for error in self.validator.iter_errors(yaml.safe_load(text))]

    def test_every_example_validates(self):
        models = sorted(Path(EXAMPLES).rglob("*.yaml"))
        self.assertGreater(len(models), 14)
        for model in models:
            with self.subTest(model.name, folder=model.parent.name):
                self.assertEqual(self.faults(model.read_text()), [])

    def test_the_example_of_every_word_validates(self):
        definitions = self.schema["$defs"]
        for section in json.loads(words("--json").stdout):
            if "law" in section["place"]:
                continue
            of_section = self.schema if section["name"] == "model" else definitions[section["name"]]
            of_studies = {"study", "model", "records"} if section["name"] == "model" else set()
            self.assertEqual(
                set(of_section["properties"]) - self.of_laws(section) - of_studies,
                {word["key"] for word in section["keys"]},
            )
            for word in section["keys"]:
                with self.subTest(section=section["name"], key=word["key"]):
                    validator = jsonschema.Draft202012Validator(
                        {**of_section["properties"][word["key"]], "$defs": definitions}
                    )
                    found = yaml.safe_load(f"{word['key']}: {word['example']}")
                    self.assertEqual([error.message for error in validator.iter_errors(found.popitem()[1])], [])

    @staticmethod
    def of_laws(section):
        if section["name"] != "links":
            return set()
        laws = [each for each in json.loads(words("--json").stdout) if "law:" in each["place"]]
        return {word["key"] for law in laws for word in law["keys"]} - {word["key"] for word in section["keys"]}

    def test_every_law_validates_with_its_parameters(self):
        for law in json.loads(
            subprocess.run([PROGRAM, "laws", "--json"], capture_output=True, text=True, check=True).stdout
        ):
            given = {p["name"]: p["typical"] for p in law["parameters"] if p["need"] == "required"}
            link = {"between": ["left", "right"], "gap": 0.02, "law": law["name"], **given}
            if law["restitution"]:
                link["restitution"] = 0.65
            model = yaml.safe_load(PAIR) | {"links": [link]}
            with self.subTest(law["name"]):
                self.assertEqual([error.message for error in self.validator.iter_errors(model)], [])
                self.assertFalse(self.validator.is_valid(yaml.safe_load(PAIR) | {"links": [link | {"width": 1}]}))
                for name in given:
                    self.assertFalse(
                        self.validator.is_valid(
                            yaml.safe_load(PAIR) | {"links": [{k: v for k, v in link.items() if k != name}]}
                        )
                    )

    def test_what_may_be_written_in_several_ways_validates(self):
        for text in (
            "gap: 0",
            "gap: 20mm",
            'gap: "+20 mm"',
            "gap: 2e-2",
            "gap: 1.e-2 m",
            "gap: [20 mm, 0.02]",
            "stiffness: 2750 MN/m^1.5",
            "stiffness: 2.75e9 N/m1.5",
            "restitution: 65 %",
            "name: 3",
            "impact_velocity: 0.5 (m/s)",
        ):
            key = text.split(":")[0]
            link = yaml.safe_load(LINK)
            link["links"][0][key] = yaml.safe_load(text)[key]
            with self.subTest(text):
                self.assertEqual([error.message for error in self.validator.iter_errors(link)], [])
                done = subprocess.run(
                    [PROGRAM, "check", "/dev/stdin"],
                    input=yaml.safe_dump(link) + "analysis: {duration: 1}\n",
                    capture_output=True,
                    text=True,
                )
                self.assertIn(done.returncode, (0, 2))
        self.assertEqual(self.faults(PAIR + "  w: {wall: {}}\n  v: {wall: }\n"), [])

    def test_a_study_has_a_model_or_names_one(self):
        study = "study: {factors: {gap: {of: links.*.gap, list: [10 mm, 20 mm]}}, sampling: grid, without_links: yes}\n"
        self.assertEqual(self.faults(LINK + study), [])
        self.assertEqual(self.faults("model: pair.yaml\n" + study), [])
        self.assertNotEqual(self.faults(study), [])
        self.assertNotEqual(self.faults(LINK + study.replace("list", "lists")), [])
        self.assertNotEqual(self.faults(LINK + study.replace("of: links", "sobol: 3, of: links")), [])

    def test_a_suite_has_records_next_to_the_model(self):
        suite = "records: {x: r*.csv, scale_to: {spectrum: {en1998_1: {ag: 0.3 g, soil: C}}, method: mean}}\n"
        self.assertEqual(self.faults(LINK + suite), [])
        self.assertNotEqual(self.faults(suite), [])
        self.assertNotEqual(self.faults(LINK + suite.replace("soil: C", "soil: F")), [])
        self.assertNotEqual(self.faults(LINK + suite.replace("scale_to", "scaled_to")), [])

    def test_what_the_reader_refuses_does_not_validate(self):
        self.assertEqual(self.faults(LINK), [])
        wrong = {
            "an unknown key": LINK + "analyse: 3\n",
            "an unknown key of a link": LINK.replace("gap", "gpa"),
            "a key of another law": LINK.replace("restitution", "dissipation_time: 3 ms, restitution"),
            "a missing law": LINK.replace("law: hertz_damped, ", ""),
            "a missing parameter": LINK.replace("stiffness: 2.75e9, ", ""),
            "no damping": LINK.replace(", restitution: 0.65", ""),
            "damping given twice": LINK.replace("restitution", "damping_factor: 0.8, restitution"),
            "an unknown law": LINK.replace("hertz_damped", "hertz_damp"),
            "a formula of another law": LINK.replace("restitution", "formula: jankowski_2005, restitution"),
            "a negative mass": LINK.replace("100 t", "-100 t"),
            "a negative number": LINK.replace("100 t", "-0.005"),
            "a gap in kN": LINK.replace("20 mm", "20 kN"),
            "a decimal comma": LINK.replace("20 mm", '"1,5 mm"'),
            "text instead of a number": LINK.replace("20 mm", "small"),
            "a restitution above 1": LINK.replace("0.65", "1.2"),
            "three ends": LINK.replace("[left, right]", "[left, right, left]"),
            "one end": LINK.replace("[left, right]", "[left]"),
            "a map instead of a list of links": PAIR + "links: {between: [left, right]}\n",
            "no structures": "title: x\n",
            "two kinds": LINK.replace("left: {", "left: {wall: {}, "),
            "no kind": LINK.replace("structures:", "structures:\n  a: {damping: 5 %}"),
            "an unknown kind": LINK.replace("left: {oscillator", "left: {oscilator"),
            "an oscillator without stiffness": LINK.replace(", period: 0.8", ""),
            "period and stiffness": LINK.replace("period: 0.8", "period: 0.8, stiffness: 1 MN/m"),
            "a fraction of a storey": PAIR + "  a: {shear_building: {storeys: 2.5, mass: 1 t, stiffness: 1 MN/m}}\n",
            "a wall with keys": PAIR + "  a: {wall: {mass: 1}}\n",
            "two motions": LINK + "ground_motion: {pulse: {shape: sine, amplitude: 1, duration: 1}, record: a.at2}\n",
            "an unknown shape": LINK + "ground_motion: {pulse: {shape: cosine, amplitude: 1, duration: 1}}\n",
            "a motion without period": LINK + "ground_motion: {harmonic: {amplitude: 1, duration: 1}}\n",
            "an unknown soil": LINK + "ground_motion: {synthetic: {seed: 1, duration: 10, pga: 1, soil: rock}}\n",
            "a tolerance of 0.5": LINK + "analysis: {tolerance: 0.5}\n",
            "an unknown integrator": LINK + "analysis: {integrator: newmark}\n",
            "a duration of 0": LINK + "analysis: {duration: 0}\n",
            "a duration in m": LINK + "analysis: {duration: 5 m}\n",
            "a yes for a comparison": LINK + "compare: all\n",
            "a frame without nodes": PAIR + "  a: {frame: {material: {E: 30 GPa}}}\n",
            "a section of two shapes": PAIR
            + "  a: {frame: {grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, beams: b, "
            "columns: {circle: 1 m, rectangle: [1 m, 1 m]}}}}\n",
        }
        for fault, text in wrong.items():
            with self.subTest(fault):
                self.assertNotEqual(self.faults(text), [])
                done = subprocess.run([PROGRAM, "check", "/dev/stdin"], input=text, capture_output=True, text=True)
                self.assertEqual(done.returncode, 2, done.stderr)


if __name__ == "__main__":
    unittest.main()
