"""Same file, same gaps: run, study and separation read a file in the same way."""

import tempfile
import unittest
from pathlib import Path

import pounding
from pounding.errors import InputError
from pounding._studies.separation import separation
from pounding._studies.separation_table import table_of
from study_samples import bents, blocks, pair, write_records
from messages import assert_mentions

NAMES = [f"r{i}.csv" for i in range(6)]
SYNTHETIC = "records: {synthetic: {count: 8, duration: 0.8 s, pga: 0.3 g}}"
STUDIES = {
    "the model's motion": (pair(), "{}"),
    "files": (pair(), "records: {files: r*.csv}"),
    "files for a model with a strength": (
        pair(ground_motion={"record": "r0.csv", "pga": "0.6 g"}),
        "records: {files: r*.csv}",
    ),
    "a level of pga": (pair(), "records: {files: r*.csv}\n  intensity: {measure: pga, levels: [0.5 g]}"),
    "a level of sa": (pair(), "records: {files: r*.csv}\n  intensity: {measure: sa, period: 0.8 s, levels: [0.5 g]}"),
    "the model's motion at a level": (pair(), "intensity: {measure: pga, levels: [0.7 g]}"),
    "a seed": (pair(), f"seed: 3\n  {SYNTHETIC}"),
    "another seed": (pair(), f"seed: 4\n  {SYNTHETIC}"),
    "a factor": (
        pair(),
        "factors: {T: {of: structures.left.oscillator.period, list: [1.1 s]}}\n  records: {files: r*.csv}",
    ),
    "samples": (
        pair(),
        "seed: 5\n  factors: {T: {of: structures.left.oscillator.period, uniform: {from: 0.7 s, to: 1 s}}}\n"
        "  sampling: {sobol: 4}\n  records: {files: r*.csv}",
    ),
    "a factor of the motion": (pair(), "factors: {pga: {of: ground_motion.synthetic.pga, list: [0.7 g]}}"),
    "a wave": (bents(record="r0.csv", wave={"velocity": "300 m/s"}), "records: {files: r*.csv}"),
    "components": (
        blocks(components={"x": {"record": "r0.csv"}, "y": {"record": "r1.csv"}}),
        "records: {x: [r0.csv, r2.csv], y: [r1.csv, r3.csv]}",
    ),
    "the solver": (pair(), "engine: solver\n  records: {files: r*.csv}"),
}


def gap_of(model):
    model.compare = "no_pounding"
    return max(one["enough"] for one in pounding.run(model).summary["no_pounding"]["separations"])


class SameFile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        write_records(self.folder, NAMES)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def test_the_table_shows_the_number_of_every_sample(self):
        one = {"required": 0.1, "abs": 0.1, "srss": 0.1, "ddc": 0.1}
        names = [f"RSN1690_NORTH151_SYL090-hor1.AT2, sample {i}" for i in range(2)]
        lines = table_of(
            {
                "records": [{"record": name, **one} for name in names],
                "mean": one,
                "required": {},
                "contact": {},
                "levels": [],
                "codes": [],
                "property": "same",
                "displacements": "nonlinear",
                "bridges": "",
                "collapsed": [],
            }
        )
        for name in names:
            self.assertRegex(lines, f"{name} +100.0 +100.0")

    def test_same_gaps(self):
        gaps = {}
        for name, (model, words) in STUDIES.items():
            inner = "{}" if words == "{}" else f"\n  {words}\n  keep: [required_gap, gap_srss]"
            self.write("model.yaml", model.to_yaml())
            for file in (
                self.write("beside.yaml", f"model: model.yaml\nstudy: {inner}\n"),
                self.write("inside.yaml", f"{model.to_yaml()}study: {inner}\n"),
            ):
                with self.subTest(name, file=file.name):
                    if words == "{}":
                        file.write_text(file.read_text().replace("{}", "{keep: [required_gap, gap_srss]}"))
                    study, found = pounding.study(file, workers=0), separation(file, workers=0)
                    self.assertEqual([one["required"] for one in found["records"]], study["required_gap"].tolist())
                    self.assertEqual([one["srss"] for one in found["records"]], study["gap_srss"].tolist())
                    self.assertEqual(found["required"]["84 %"]["gap"], study.gaps().percentile(84)[0])
                    self.assertGreater(study["required_gap"].min(), 0)
                    for row in (0, len(study) - 1):
                        self.assertAlmostEqual(
                            study["required_gap"][row] / gap_of(pounding.Model.from_yaml(study.model_of(row))),
                            1,
                            delta=2e-3,
                        )
                    gaps.setdefault(name, study["required_gap"]).sort()
        # Every study but the last one, which only names the engine, has its own gaps.
        self.assertEqual(
            len({tuple(values) for name, values in gaps.items() if name != "the solver"}), len(STUDIES) - 1
        )

    def test_a_model_without_a_study(self):
        for model in (pair(), bents(record="r0.csv", wave={"velocity": "300 m/s"})):
            file = self.write("model.yaml", model.to_yaml())
            self.assertAlmostEqual(
                separation(file)["records"][0]["required"] / gap_of(pounding.Model.from_file(file)), 1, delta=2e-3
            )

    def test_records_of_the_command_line_keep_the_rest_of_the_study(self):
        named = self.write(
            "a.yaml",
            f"{pair().to_yaml()}study:\n  records: {{files: r3.csv}}\n  intensity: {{measure: pga, levels: [0.5 g]}}\n",
        )
        every = self.write(
            "b.yaml",
            f"{pair().to_yaml()}study:\n  records: {{files: [r1.csv, r2.csv]}}\n  intensity: {{measure: pga, levels: [0.5 g]}}\n",
        )
        self.assertEqual(separation(named, [self.folder / "r1.csv", self.folder / "r2.csv"]), separation(every))

    def refused(self, said, words, model=None, records=None):
        file = self.write("study.yaml", f"{(model or pair()).to_yaml()}study:\n  {words}\n")
        with self.assertRaises(InputError) as caught:
            separation(file, records)
        assert_mentions(str(caught.exception), said)
        self.assertIn("study.yaml", str(caught.exception))

    def test_what_a_separation_cannot_use_is_an_error(self):
        records = "records: {files: r*.csv}"
        self.refused(["pounding study", "study.limits"], f"{records}\n  limits: {{force: 5 MN}}")
        self.refused(
            "study.factors.gap",
            f"{records}\n  factors: {{gap: {{of: structures.left.oscillator.period, list: [0.7 s, 0.8 s]}}}}",
        )
        self.refused(
            ["study.intensity.levels", "2"], f"{records}\n  intensity: {{measure: pga, levels: [0.1 g, 0.2 g]}}"
        )
        self.refused(["sede", "seed"], "sede: 3")
        self.refused(["displacment", "displacement"], "keep: [displacment]")
        self.refused(
            [],
            "seed: 1",
            blocks(components={"x": {"record": "r0.csv"}, "y": {"record": "r1.csv"}}),
            [self.folder / "r2.csv"],
        )


if __name__ == "__main__":
    unittest.main()
