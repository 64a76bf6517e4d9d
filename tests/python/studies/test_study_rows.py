"""Rows of studies: the numbers of single runs, bitwise identical for any schedule, and failures that affect one row
each."""

import dataclasses
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

import pounding
from pounding._native import core
from pounding._checked_file import NotResults
from pounding.errors import InputError, SolverError
from pounding._studies.batches import DIED, DONE, EXCEEDED, FAILED
from pounding._studies.execution import run_rows
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan
from pounding._studies.table import Table
from study_samples import FACTORS, WORDS, Deadly, pair
from messages import assert_mentions, raises

LESSONS = Path(__file__).resolve().parents[3] / "examples"
#: Number of kills in the long form; the fast form has one.
KILLS = int(os.environ.get("POUNDING_STUDY_KILLS", "2"))


def plan_of(**changes):
    return make_plan(pair(), {"factors": FACTORS, **WORDS, **changes}, Path())


def bits(path):
    """All columns of a table, as bytes."""
    with h5py.File(path) as file:
        return {name: data[:].tobytes() for name, data in file["rows"].items()}


class Rows(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write_study(self, engine="auto"):
        (self.folder / "pair.yaml").write_text(pair().to_yaml())
        words = pounding._yaml_text.plain({"factors": FACTORS, **WORDS, "engine": engine})
        (self.folder / "study.yaml").write_text(pounding._yaml_text.emit({"model": "pair.yaml", "study": words}))
        return self.folder / "study.yaml"

    def command(self, *words, **options):
        return subprocess.run(
            [sys.executable, "-m", "pounding", "study", *map(str, words)],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=300,
            **options,
        )

    def test_a_row_is_a_run_of_its_model(self):
        study = run_plan(
            plan_of(
                engine="solver",
                without_links="yes",
                keep="""
                    displacement acceleration drift force penetration impacts impulse energy_lost
                    required_gap gap_abs gap_srss
                """.split(),
            ),
            None,
            workers=0,
        )
        self.assertEqual((len(study), set(study["status"])), (36, {DONE}))
        self.assertGreater(study["impacts"].sum(), 20)
        for row in (0, 17, 35):
            run = pounding.run(pounding.Model.from_yaml(study.model_of(row)))
            self.assertEqual(study.model_of(row), study.plan.yaml(row))
            link, right = run.summary["links"][0], run.summary["structures"]["right"]
            alone = run.summary["no_pounding"]
            for column, value in (
                ("force", link["peak_force"]),
                ("impacts", link["impacts"]),
                ("impulse", link["impulse"]),
                ("energy_lost", link["energy_lost"]),
                ("displacement.right", right["peak_displacement"][0]),
                ("displacement.right.ratio", alone["amplification"]["right"][0]),
                ("required_gap", alone["separations"][0]["enough"]),
                ("gap_srss", alone["separations"][0]["srss"]),
            ):
                self.assertEqual(study[column][row], value, (row, column))
        # By hand: row 23 is record 1, ratio 0.8, gap 9 mm, level 0.4 g, of 3 x 2 x 3 x 2.
        np.testing.assert_allclose(
            [study[name][23] for name in ("record", "ratio", "gap", "im")], [1, 0.8, 9e-3, 0.4 * 9.80665], rtol=1e-15
        )
        self.assertAlmostEqual(study["scale"][23], 4 / 3, places=15)

    def test_rows_that_share_a_model_have_the_bits_of_one_that_is_read_anew(self):
        def motion(seed, seconds):
            return core.RowMotion(
                f"ground_motion: {{synthetic: {{seed: {seed}, duration: {seconds} s, pga: 0.6 g, soil: firm}}}}\n",
                "row",
            )

        motions = [motion(1, 1.5), motion(2, 1)]
        # Contacts that move their gap, that press from the start and that are rigid; frames; yielding parts; isolators;
        # dampers.
        komodromos = [
            {
                "between": ["left", "right"],
                "gap": "1 mm",
                "law": "komodromos",
                "stiffness": "93.5e6",
                "restitution": "0.65",
            }
        ]
        rigid = [{"between": ["left", "right"], "gap": "1 mm", "law": "stereomechanical", "restitution": "0.65"}]
        texts = [pair(links=komodromos).to_yaml(), pair(links=rigid).to_yaml()]
        # A delay of the ground under one structure, which is read again.
        texts.append(texts[0].replace("{oscillator:", "{delay: 50 ms, oscillator:", 1))
        texts += [
            (LESSONS / name / "model.yaml").read_text()
            for name in ("07_plane_frames", "19_yielding_pair", "21_isolated_moat", "22_dampers_between_neighbours")
        ]
        for text in texts:
            # As texts, so that nan equals itself.
            fresh = [repr(core.RowModel(text, "row", []).run(each)) for each in motions]
            self.assertNotEqual(fresh[0], fresh[1])
            shared = core.RowModel(text, "row", [])
            for i in (0, 1, 0):
                self.assertEqual(repr(shared.run(motions[i])), fresh[i])

    def test_a_row_whose_values_change_is_read_anew(self):
        ground = core.RowMotion(
            "ground_motion: {synthetic: {seed: 1, duration: 0.8 s, pga: 0.3 g, soil: firm}}\n", "row"
        )
        model = core.RowModel(pair().to_yaml(), "row", [["links", "0", "gap"]])
        found = {}
        for gap in ("1 mm", "3 mm", "1 mm", "1 mm", "3 mm"):
            model.put([gap])
            ran = model.run(ground)
            self.assertEqual(ran, found.setdefault(gap, ran))
        self.assertNotEqual(*found.values())

    def test_a_gap_that_is_just_enough_is_the_required_one(self):
        study = run_plan(plan_of(keep=["required_gap"]), None, workers=0)
        for row in (1, 13):
            need = study["required_gap"][row]
            for gap, impacts in ((need * (1 + 1e-4), 0), (need * (1 - 1e-4), 1)):
                model = pounding.Model.from_yaml(study.model_of(row))
                model.links[0]["gap"] = repr(float(gap))
                model.analysis = {**model.analysis, "tolerance": "1e-7"}
                self.assertEqual(min(1, len(pounding.run(model).impacts)), impacts)

    def test_workers_chunks_and_shards_give_the_same_bits(self):
        for engine, number in (("auto", 0), ("solver", 1)):
            plan = plan_of(engine=engine)
            run_plan(plan, self.folder / "one.h5", workers=0, chunk=1)
            expected = bits(self.folder / "one.h5")
            self.assertEqual(set(pounding.Study.open(self.folder / "one.h5")["engine"]), {number})
            for name, options in (
                ("chunks", {"workers": 0, "chunk": 7}),
                ("whole", {"workers": 0, "chunk": 5000}),
                ("soon", {}),
                ("two", {"workers": 2}),
                ("seven", {"workers": 7, "chunk": 2}),
            )[3 * number :]:
                run_plan(plan, self.folder / f"{name}.h5", **options)
                self.assertEqual(bits(self.folder / f"{name}.h5"), expected, name)
                self.assertFalse((self.folder / f"{name}.h5.parts").exists())
            shards = []
            for k in (1, 2, 3):
                shards.append(self.folder / f"shard{k}.h5")
                self.assertEqual((run_plan(plan, shards[-1], workers=0, shard=(k, 3))["status"] == DONE).sum(), 12)
            table = Table(plan, self.folder / "merged.h5")
            for shard in shards:
                table.merge(shard)
            table.write()
            self.assertEqual(bits(self.folder / "merged.h5"), expected)
            for file in self.folder.glob("*.h5"):
                file.unlink()

    def test_an_executor_of_somebody_else_runs_the_rows(self):
        plan = plan_of()
        with ThreadPoolExecutor(2) as threads:
            given = run_plan(plan, None, executor=threads)
        np.testing.assert_array_equal(given.table, run_plan(plan, None, workers=0).table)

    def test_a_killed_study_goes_on_to_the_same_bits(self):
        for engine in ("auto", "solver"):
            self.kill(engine)

    def kill(self, engine):
        study = self.write_study(engine)
        self.assertEqual(self.command(study, "-o", f"whole_{engine}.h5", "-j", "0", "-q").returncode, 0)
        generator = random.Random(1)
        for kill in range(KILLS):
            output = self.folder / f"killed_{engine}_{kill}.h5"
            parts = output.with_name(output.name + ".parts")
            process = subprocess.Popen(
                [
                    sys.executable,
                    "-m",
                    "pounding",
                    "study",
                    str(study),
                    "-o",
                    str(output),
                    "-j",
                    "0",
                    "-q",
                    "--chunk",
                    "2",
                ],
                start_new_session=True,
            )
            # Somewhere among its 18 chunks.
            wanted, end = generator.randrange(1, 17), time.monotonic() + 60
            while len(list(parts.glob("*.npz"))) < wanted and process.poll() is None and time.monotonic() < end:
                time.sleep(0.002)
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            kept = len(list(parts.glob("*.npz")))
            if kept:
                self.assertFalse(output.exists())
            again = self.command(study, "-o", output, "-j", "0", "-q")
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertEqual(bits(output), bits(self.folder / f"whole_{engine}.h5"))

    def test_finished_rows_do_not_run_again(self):
        plan = plan_of()
        table = Table(plan, self.folder / "s.h5")
        run_rows(plan, table, np.arange(20), workers=0, chunk=5)
        table.close()  # otherwise its path is locked
        seen = []
        run_plan(
            plan,
            self.folder / "s.h5",
            workers=0,
            chunk=4,
            progress=lambda done, failed, count: seen.append((done, count)),
        )
        self.assertEqual(seen, [(4, 16), (8, 16), (12, 16), (16, 16)])

    def test_another_plan_is_refused_with_what_is_not_the_same(self):
        run_plan(plan_of(), self.folder / "s.h5", workers=0)
        with raises(InputError):
            run_plan(plan_of(seed=2), self.folder / "s.h5", workers=0)

    def test_a_damaged_table_is_refused(self):
        path = self.folder / "s.h5"
        run_plan(plan_of(), path, workers=0)
        whole = path.read_bytes()
        chance = random.Random(15)
        for _ in range(200):
            changed = bytearray(whole)
            for _ in range(chance.randint(1, 16)):
                changed[chance.randrange(len(whole))] ^= chance.randrange(1, 256)
            path.write_bytes(changed if chance.random() < 0.9 else changed[: chance.randrange(len(whole))])
            if path.read_bytes() != whole:
                with raises(NotResults):
                    pounding.Study.open(path)
        with raises(NotResults):
            run_plan(plan_of(), path, workers=0)
        done = self.command("show", "s.h5")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        assert_mentions(done.stderr, ["pounding", "s.h5"])

    def test_a_table_is_told_from_results_of_a_run(self):
        run_plan(plan_of(), self.folder / "s.h5", workers=0)
        with raises(NotResults, ["pounding study show", "h5"]):
            pounding.read(self.folder / "s.h5")

    def test_a_damaged_chunk_is_refused(self):
        plan = plan_of()
        run_rows(plan, Table(plan, self.folder / "s.h5"), np.arange(20), workers=0, chunk=5)
        parts = self.folder / "s.h5.parts"
        chance = random.Random(15)
        for path in parts.glob("*.*"):
            whole = path.read_bytes()
            for _ in range(20):
                changed = bytearray(whole)
                changed[chance.randrange(len(whole))] ^= 1 << chance.randrange(8)
                path.write_bytes(changed[: chance.randrange(len(whole))] if path.suffix == ".json" else changed)
                with raises(NotResults):
                    Table(plan, self.folder / "s.h5")
            path.write_bytes(whole)
        self.assertEqual(len(Table(plan, self.folder / "s.h5").missing()), 16)

    def test_a_full_disk_loses_nothing_that_was_computed(self):
        study = self.write_study()
        done = self.command(
            study,
            "-o",
            "full.h5",
            "-j",
            "0",
            "-q",
            "--chunk",
            "2",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (12000, 12000)),
        )
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        kept = len(list((self.folder / "full.h5.parts").glob("*.npz")))
        self.assertEqual(kept, 18)
        self.command(study, "-o", "whole.h5", "-j", "0", "-q")
        self.assertEqual(self.command(study, "-o", "full.h5", "-j", "0", "-q").returncode, 0)
        self.assertEqual(bits(self.folder / "full.h5"), bits(self.folder / "whole.h5"))

    def test_a_disk_that_takes_no_chunk_loses_no_chunk_before(self):
        study = self.write_study()

        def little():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))

        self.command(study, "-o", "whole.h5", "-j", "0", "-q")
        begun = subprocess.Popen(
            [sys.executable, "-m", "pounding", "study", str(study), "-o", "s.h5", "-j", "0", "-q", "--chunk", "1"],
            cwd=self.folder,
        )
        parts = self.folder / "s.h5.parts"
        while begun.poll() is None and len(list(parts.glob("*.npz")) if parts.is_dir() else []) < 3:
            time.sleep(0.001)
        begun.kill()
        begun.wait()
        before = {path.name: path.read_bytes() for path in parts.glob("*.npz")}
        full = self.command(study, "-o", "s.h5", "-j", "0", "-q", "--chunk", "1", preexec_fn=little)
        self.assertEqual(full.returncode, 3, full.stderr)
        self.assertNotIn("Traceback", full.stderr)
        for name, content in before.items():
            self.assertEqual((parts / name).read_bytes(), content)
        self.assertEqual(self.command(study, "-o", "s.h5", "-j", "0", "-q").returncode, 0)
        self.assertEqual(bits(self.folder / "s.h5"), bits(self.folder / "whole.h5"))

    def test_a_record_that_vanishes_costs_no_rows(self):
        for engine in ("auto", "solver"):
            place = self.folder / engine
            place.mkdir()
            for i in range(3):
                (place / f"r{i}.csv").write_text(
                    "time,acc (g)\n" + "".join(f"{j * 0.02:.2f},{np.sin(j * (i + 1))}\n" for j in range(30))
                )
            plan = plan_of(records={"files": str(place)}, engine=engine)
            whole = run_plan(plan, None, workers=0)
            (place / "r1.csv").unlink()
            (place / "r2.csv").write_text("nothing to read\n")
            study = run_plan(plan, None, workers=0)
            self.assertEqual((study.failed, whole.failed), ({}, {}))
            np.testing.assert_array_equal(study["force"], whole["force"])

    def test_a_worker_that_dies_costs_its_row(self):
        plan = plan_of(
            records={"synthetic": {"count": 1, "duration": "0.8 s", "pga": "0.3 g"}},
            stop_after="100 %",
            engine="solver",
        )
        whole = run_plan(plan, None, workers=0)
        deadly = dataclasses.replace(plan, template=Deadly(**vars(plan.template)))
        begin = time.monotonic()
        study = run_plan(deadly, None, workers=2, chunk=3)
        dead = np.isclose(study["gap"], Deadly.gap)
        self.assertEqual(set(study["status"][dead]), {DIED})
        self.assertEqual(set(study.failed.values()), {"worker died: signal 6"})
        np.testing.assert_array_equal(study.table[~dead], whole.table[~dead])
        self.assertTrue(np.isnan(study["force"][dead]).all())
        self.assertLess(time.monotonic() - begin, 60 + 10 * dead.sum())

    def test_failures_are_rows_with_reasons(self):
        factors = {"k": {"of": "links.*.stiffness", "list": [2.75e9, 1e300]}}
        study = run_plan(make_plan(pair(), {"factors": factors, "stop_after": "100 %"}, Path()), None, workers=0)
        self.assertEqual(study["status"].tolist(), [DONE, FAILED])
        self.assertEqual(list(study.failed), [1])
        self.assertIn("at time", study.failed[1].replace("at t =", "at time"))
        self.assertEqual(study.choose().tolist(), [True, False])

    def test_a_limit_makes_exceeded_rows(self):
        study = run_plan(plan_of(limits={"force": "1 N"}), None, workers=0)
        np.testing.assert_array_equal(study["status"] == EXCEEDED, study["force"] > 1)
        self.assertEqual(set(study["status"]), {DONE, EXCEEDED})

    def test_too_many_failures_stop_the_study_and_keep_its_rows(self):
        factors = {"k": {"of": "links.*.stiffness", "list": [1e300 * (1 + i) for i in range(40)]}}
        plan = make_plan(pair(), {"factors": factors}, Path())
        with raises(SolverError, ["stop_after", "20", "5 %"]):
            run_plan(plan, self.folder / "s.h5", workers=0, chunk=10)
        self.assertEqual((pounding.Study.open(self.folder / "s.h5")["status"] == FAILED).sum(), 20)

    def test_a_script_without_a_guard_is_told_what_to_write(self):
        (self.folder / "script.py").write_text(
            "import sys\nsys.path.insert(0, %r)\nfrom study_samples import *\n"
            "pounding.study(pair(), FACTORS, workers=1)\n" % str(Path(__file__).parent)
        )
        done = subprocess.run([sys.executable, self.folder / "script.py"], capture_output=True, text=True, timeout=120)
        assert_mentions(done.stderr, 'if __name__ == "__main__":')

    def test_a_sweep_keeps_all_paths_with_one_last_word(self):
        spring = {
            "storeys": 1,
            "mass": "100 t",
            "stiffness": "60 MN/m",
            "height": "3 m",
            "yield_force": "0.9 MN",
            "hardening": "0.02",
        }
        model = pair(
            structures={name: {"shear_building": spring, "damping": "5 %"} for name in ("left", "right", "third")}
        )
        study = pounding.sweep(
            model,
            {f"structures.{name}.shear_building.yield_force": ["0.8 MN", "1 MN"] for name in model.structures},
            keep=["impacts"],
        )
        self.assertEqual((len(study), study.factors), (8, ["yield_force", "yield_force_2", "yield_force_3"]))

    def test_sweep_and_evaluate_are_plain_functions(self):
        study = pounding.sweep(
            pair(), {"links.*.gap": ["1 mm", "3 mm"], "structures.left.oscillator.period": ["0.8 s"]}, keep=["force"]
        )
        self.assertEqual(study.factors, ["gap", "period"])
        np.testing.assert_array_equal(study.evaluate({"gap": 3e-3, "period": 0.8})["force"], study["force"][1:])
        with raises(InputError, "gap"):
            study.evaluate({"gap": 1e-3})
        study = pounding.sweep(pair(), {"links.*.law": ["hertz_damped", "jankowski"]}, keep=["force"])
        np.testing.assert_array_equal(study.evaluate({"law": 1.0})["force"], study["force"][1:])
        for number in (2, 0.5, -1):
            with raises(InputError, "law"):
                study.evaluate({"law": number})

    def test_an_output_is_the_name_of_a_file(self):
        for output in (3, ["s.h5"]):
            with raises(InputError, "output"):
                pounding.study(pair(), workers=0, output=output)

    def test_tables_for_other_programs_hold_all_digits(self):
        study = run_plan(plan_of(), self.folder / "s.h5", workers=0)
        opened = pounding.Study.open(self.folder / "s.h5")
        np.testing.assert_array_equal(opened.table, study.table)
        opened.to_csv(self.folder / "s.csv")
        import pandas

        read = pandas.read_csv(self.folder / "s.csv", float_precision="round_trip")
        np.testing.assert_array_equal(read["force [N]"], study["force"])
        self.assertEqual(set(read["status"]), {"done"})
        grid = opened.to_xarray()
        self.assertEqual(grid["force"].sizes, {"record": 3, "ratio": 2, "gap": 3, "sample": 1, "level": 2})
        self.assertEqual(float(grid["force"].isel(record=1, ratio=1, gap=2, sample=0, level=1)), study["force"][23])
        self.assertEqual(opened.to_pandas().shape, (36, len(study.columns)))

    def test_a_limit_may_have_a_unit(self):
        study = run_plan(plan_of(keep=["force", "impacts"]), None, workers=0)
        middle = float(np.median(study["force"]))
        for typed in (f"{middle / 1e6!r} MN", f"{middle!r}", f"{middle!r} N"):
            np.testing.assert_array_equal(
                study.fragility("force", typed).exceeded, study.fragility("force", middle).exceeded
            )
        self.assertGreater(study.fragility("force", middle).exceeded.sum(), 0)
        self.assertEqual(study.limit_of("impacts", "2"), 2)
        for column, limit, told in (
            ("force", "5 kg", ()),
            ("impacts", "2 N", ()),
            ("force", "much", ()),
            ("forces", "5 MN", "forces"),
        ):
            with raises(InputError, told):
                study.fragility(column, limit)

    def test_pictures_are_drawn_from_the_table(self):
        run_plan(plan_of(keep=["force", "impacts", "required_gap", "gap_srss"]), self.folder / "s.h5", workers=0)
        study = pounding.Study.open(self.folder / "s.h5")
        for picture, column, options in (
            ("fragility", "impacts", {"limit": 0.5}),
            ("ida", "force", {"gap": 1e-3}),
            ("gap", None, {}),
            ("map", "force", {"across": "ratio", "along": "gap"}),
            ("tornado", "force", {}),
        ):
            study.plot(picture, column, **options).savefig(self.folder / f"{picture}.svg")
        # One grey line per record and set of factors, across the levels; forces are drawn in a unit of their magnitude.
        ida = study.plot("ida", "force").axes[0]
        lines = [line for line in ida.lines if line.get_color() == "0.75"]
        self.assertEqual(len(lines), len(np.unique(np.column_stack([study["record"], study["point"]]), axis=0)))
        self.assertEqual({len(line.get_xdata()) for line in lines}, {len(np.unique(study["scale"]))})
        unit = {"force [N]": 1, "force [kN]": 1e3, "force [MN]": 1e6}[ida.get_xlabel()]
        self.assertAlmostEqual(unit * max(max(line.get_xdata()) for line in lines) / study["force"].max(), 1)
        assert_mentions(study.plot("fragility", "force", limit="0.2 MN").axes[0].get_title("left"), "200 kN")
        with raises(InputError):
            study.plot("fragilty", "force")


if __name__ == "__main__":
    unittest.main()
