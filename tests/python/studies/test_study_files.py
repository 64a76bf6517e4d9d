"""Files of a study: their contents define the plan, independent of the folder and of changes to the files while rows run."""

import json
import math
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import pounding
from pounding._native import core
from pounding.errors import InputError
from pounding._studies.execution import batch_of
from pounding._studies.engines import run_batch
from pounding._studies.plan import read_plan
from pounding._studies.study import run_plan
from pounding._studies.table import Table
from study_samples import pair, write_records
from messages import raises

FORCED = {
    "left": {
        "oscillator": {"mass": "100 t", "period": "0.8 s", "damping": "5 %"},
        "forces": [{"record": "recs/force.csv", "units": "kN"}],
    },
    "right": {"oscillator": {"mass": "150 t", "period": "0.4 s", "damping": "5 %"}},
}
STUDIES = {
    "own.yaml": (pair(ground_motion={"record": "recs/r0.csv"}), "{keep: [displacement, required_gap]}"),
    "force.yaml": (pair(structures=FORCED), "{keep: [displacement], records: {files: [recs/r1.csv, recs/r2.csv]}}"),
    "records.yaml": (
        pair(),
        "{keep: [displacement], records: {files: recs/r*.csv}, intensity: {measure: sa, period: 1 s, levels: [0.2 g, 0.4 g]}}",
    ),
    "labels.yaml": (
        pair(ground_motion={"record": "recs/r0.csv"}),
        "{keep: [displacement], factors: {motion: {of: ground_motion.record, list: [recs/r1.csv, recs/r2.csv]}}}",
    ),
    "table.yaml": (
        pair(),
        "{keep: [displacement], factors: {gap: {of: links.*.gap, column: gap}}, sampling: {table: recs/table.csv}}",
    ),
}


class FilesOfAStudy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name) / "one"
        (self.folder / "recs").mkdir(parents=True)
        write_records(self.folder / "recs", ["r0.csv", "r1.csv", "r2.csv"])
        (self.folder / "recs" / "force.csv").write_text(
            "".join(f"{0.01 * i!r},{300 * math.sin(0.1 * i)!r}\n" for i in range(80))
        )
        (self.folder / "recs" / "table.csv").write_text("gap (mm)\n1\n2\n3\n4\n")
        for name, (model, study) in STUDIES.items():
            (self.folder / f"model_of_{name}").write_text(model.to_yaml())
            (self.folder / name).write_text(f"model: model_of_{name}\nstudy: {study}\n")

    def copied(self, name="two"):
        shutil.copytree(self.folder, self.folder.with_name(name))
        return self.folder.with_name(name)

    def test_the_digest_is_of_contents(self):
        other = self.copied()
        for name in STUDIES:
            plan = read_plan(self.folder / name, self.folder / "store")
            self.assertEqual(plan.digest(), read_plan(other / name, other / "store").digest(), name)
            run_plan(plan, self.folder / "study.h5", workers=0)
            self.assertNotIn(
                str(self.folder).encode(),
                (self.folder / "study.h5").read_bytes() if name != "labels.yaml" else b"",
                name,
            )
            (self.folder / "study.h5").unlink()
        # Changed content under the same name: of the model's own record, of a record of forces, of a record of the
        # study, of a sample.
        for name, file in (
            ("own.yaml", "r0.csv"),
            ("force.yaml", "force.csv"),
            ("records.yaml", "r2.csv"),
            ("labels.yaml", "r2.csv"),
            ("table.yaml", "table.csv"),
        ):
            text = (other / "recs" / file).read_text()
            before = read_plan(other / name).digest()
            (other / "recs" / file).write_text(text[:-1] + "1\n")
            self.assertNotEqual(read_plan(other / name).digest(), before, name)
            (other / "recs" / file).write_text(text)
            self.assertEqual(read_plan(other / name).digest(), before, name)
        # The model's own record is irrelevant if records replace it.
        own = read_plan(self.folder / "own.yaml")
        self.assertEqual(
            [
                len(read_plan(self.folder / name).files.digests(read_plan(self.folder / name).description()))
                for name in STUDIES
            ],
            [1, 3, 3, 3, 0],
        )
        self.assertEqual(len(own.template.files), 1)

    def test_a_copied_folder_resumes_and_merges(self):
        for name in STUDIES:
            plan = read_plan(self.folder / name)
            for k in (1, 2):
                run_plan(plan, self.folder / f"s{k}.h5", workers=0, shard=(k, 2))
            # A killed study: chunks without a table.
            Table(plan, self.folder / "killed.h5").add(run_batch(batch_of(plan, np.arange(1))))
            other = self.copied(f"copy of {name}")
            copy = read_plan(other / name)
            with mock.patch("pounding._studies.engines.run_batch", side_effect=AssertionError("no row is left to run")):
                table = Table(copy, other / "whole.h5")
                for k in (1, 2):
                    table.merge(other / f"s{k}.h5")
                table.write()
                self.assertEqual(len(table.missing()), 0)
            self.assertEqual(len(Table(copy, other / "killed.h5").missing()), copy.count - 1)
            whole = pounding.Study.open(other / "whole.h5")
            here = run_plan(copy, None, workers=0)
            for column, values in here.columns.items():
                np.testing.assert_array_equal(whole[column], values, err_msg=f"{name} {column}")
            # The model of a row is in the copy only.
            shutil.rmtree(self.folder)
            for study in (whole, here):
                run = pounding.run(pounding.Model.from_yaml(study.model_of(copy.count - 1)))
                self.assertAlmostEqual(
                    study["displacement.left"][-1] / max(run.summary["structures"]["left"]["peak_displacement"]),
                    1,
                    delta=1e-3,
                )
            shutil.copytree(other, self.folder)
            for each in self.folder.glob("*.h5*"):
                shutil.rmtree(each) if each.is_dir() else each.unlink()

    def test_another_plan_says_what_differs(self):
        run_plan(read_plan(self.folder / "records.yaml"), self.folder / "s.h5", workers=0)
        text = (self.folder / "recs" / "r1.csv").read_text()
        (self.folder / "recs" / "r1.csv").write_text(text[:-1] + "1\n")
        with raises(InputError):
            run_plan(read_plan(self.folder / "records.yaml"), self.folder / "s.h5", workers=0)

    def test_files_that_change_while_rows_run_have_no_effect(self):
        for name in STUDIES:
            whole = run_plan(read_plan(self.folder / name), None, workers=0)
            plan = read_plan(self.folder / name)
            for file in (self.folder / "recs").iterdir():
                file.rename(file.with_suffix(".away"))
            for workers in (0, 2) if name in ("force.yaml", "labels.yaml") else (0,):
                found = run_plan(plan, None, workers=workers)
                for column, values in whole.columns.items():
                    np.testing.assert_array_equal(found[column], values, err_msg=f"{name} {column}")
            for file in (self.folder / "recs").iterdir():
                file.rename(file.with_suffix(".csv"))

    def test_every_file_is_read_once(self):
        for name in STUDIES:
            with (
                mock.patch.object(core, "read_record", side_effect=core.read_record) as read,
                mock.patch.object(core, "read_file", side_effect=core.read_file) as opened,
            ):
                plan = read_plan(self.folder / name)
                run_plan(plan, None, workers=0)
            for calls in (read, opened):
                names = [call.args[0] for call in calls.call_args_list]
                self.assertEqual(len(names), len(set(names)), name)

    def test_the_description_is_plain(self):
        plan = read_plan(self.folder / "records.yaml")
        self.assertEqual(
            json.loads(json.dumps(plan.description()))["files"],
            {
                str((self.folder / "recs" / f"r{i}.csv").resolve()): motion.digest
                for i, motion in enumerate(plan.template.motions)
            },
        )


if __name__ == "__main__":
    unittest.main()
