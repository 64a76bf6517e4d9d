"""Engines of studies: columns of the kernel have the meaning of the solver's, the engine is chosen per row, and a
sample runs on both."""

import json
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import h5py
import numpy as np

import pounding
from pounding.errors import InputError
from pounding._studies import kernel_engine
from pounding._studies.table import differences, rows_to_check
from pounding._studies.batches import DONE, EXCEEDED, REFUSED
from pounding._studies.engines import ENGINES, run_batch
from pounding._studies.execution import batch_of
from pounding._studies.factors import at
from pounding._studies.pairs import Pairs
from pounding._studies.template import Places
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan
from study_samples import FACTORS, WORDS, pair
from messages import assert_mentions, raises

KERNEL, SOLVER = 0, 1
ALL = """
    displacement drift acceleration force penetration impacts impulse energy_lost required_gap gap_abs
    gap_srss gap_ddc
""".split()
RECORDS = {"synthetic": {"count": 2, "duration": "6 s", "pga": "0.3 g"}}
TIGHT = {"tolerance": "1e-7"}
BUILDINGS = {
    "left": {
        "shear_building": {
            "storeys": "3",
            "mass": "200 t",
            "stiffness": "300 MN/m",
            "height": "3 m",
            "damping": {"rayleigh": {"ratio": "5 %"}},
        }
    },
    "right": {
        "shear_building": {
            "storeys": "2",
            "mass": "300 t",
            "stiffness": "900 MN/m",
            "height": "3 m",
            "damping": {"modal": {"ratio": "5 %"}},
        }
    },
}
FLOORS = [
    {
        "between": ["left", "right"],
        "floors": "level",
        "gap": "4 mm",
        "law": "hertz_damped",
        "stiffness": "2.75e9",
        "restitution": "0.65",
    }
]


def both(model, factors, **words):
    """A study by the kernel and by the solver."""
    given = {"factors": factors, "records": RECORDS, "without_links": "yes", "keep": ALL, **words}
    return [
        run_plan(make_plan(model, {**given, "engine": engine}, Path()), None, workers=0)
        for engine in ("auto", "solver")
    ]


class Engines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def expect_alike(self, kernel, solver, bound=2e-5, energy=1e-3):
        self.assertEqual((set(kernel["engine"]), set(solver["engine"])), ({KERNEL}, {SOLVER}))
        np.testing.assert_array_equal(kernel["status"], solver["status"])
        self.assertGreater(solver["impacts"].sum(), 10)
        for column in kernel.plan.template.kept.columns:
            apart = differences(kernel[column], solver[column])
            self.assertLess(apart.max(), energy if column == "energy_lost" else bound, column)

    def test_columns_of_pairs_are_those_of_the_solver(self):
        factors = {**FACTORS, "e": {"of": "links.*.restitution", "list": [0.5, 0.9]}}
        kernel, solver = both(pair(analysis=TIGHT), factors, intensity={"measure": "pga", "levels": ["0.2 g", "0.5 g"]})
        self.assertEqual(len(kernel), 2 * 2 * 3 * 2 * 2)
        # Both engines take the motion from one source; a run of the row's own model reads it again.
        for row in (0, 1, 30, 47):
            ran = pounding.run(pounding.Model.from_yaml(kernel.plan.yaml(row))).summary
            self.assertLess(
                differences(kernel["force"][row : row + 1], np.array([ran["links"][0]["peak_force"]])).max(), 2e-5
            )
        self.expect_alike(kernel, solver)

    def test_pairs_go_as_columns_with_the_numbers_of_their_modes(self):
        factors = {
            **FACTORS,
            "e": {"of": "links.*.restitution", "list": [0.5, 0.9]},
            "m": {"of": "structures.left.oscillator.mass", "list": ["50 t", "90 t"]},
            "z": {"of": "structures.right.oscillator.damping", "list": ["2 %", "8 %"]},
        }
        plan = make_plan(pair(), {"factors": factors, "records": RECORDS, "without_links": "yes", "keep": ALL}, Path())
        ready = kernel_engine._ready(plan.template)
        batch = batch_of(plan, np.arange(0, plan.count, 5))
        columns = run_batch(batch).values
        self.assertEqual([type(way) for way in ready._ways.values()], [Pairs])
        ready._ways = dict.fromkeys(ready._ways, "")
        by_modes = run_batch(batch).values
        self.assertFalse((columns == by_modes).all(), "the other method has not run")
        # Modal eigenvalues have round-off.
        self.assertLess(differences(columns, by_modes).max(), 1e-6)

    def test_damping_may_stand_beside_the_oscillator(self):
        beside = {
            name: {
                "oscillator": {word: value for word, value in one["oscillator"].items() if word != "damping"},
                "damping": one["oscillator"]["damping"],
            }
            for name, one in pair().structures.items()
        }
        factors = {**FACTORS, "loss": {"of": "structures.left.damping", "list": ["2 %", "5 %"]}}
        within = {**factors, "loss": {"of": "structures.left.oscillator.damping", "list": ["2 %", "5 %"]}}
        plan = make_plan(pair(structures=beside), {"factors": factors, "records": RECORDS, "keep": ["force"]}, Path())
        ready = kernel_engine._Ready(plan.template)
        batch = batch_of(plan, np.arange(2))
        ready.run((), batch.values, ready.prepared.motion(0, 1.0, batch.files), lambda found, rows: None)
        self.assertEqual([type(way) for way in ready._ways.values()], [Pairs])
        one, other = both(pair(structures=beside), factors)[0], both(pair(), within)[0]
        for column in one.plan.template.kept.columns:
            self.assertEqual(one[column].tobytes(), other[column].tobytes(), column)

    def test_other_models_go_by_their_modes(self):
        links, structures = pair().links, pair().structures
        left = structures["left"]["oscillator"]
        models = {
            "a separate mass": pair(links=[{**links[0], "reduced_mass": "70 t"}]),
            "a speed at the start": pair(
                structures={**structures, "left": {"oscillator": {**left, "initial_velocity": "0.1 m/s"}}}
            ),
            "a stiffness": pair(
                structures={
                    **structures,
                    "left": {"oscillator": {"mass": "100 t", "stiffness": "6 MN/m", "damping": "5 %"}},
                }
            ),
            "damping in words": pair(
                structures={**structures, "left": {"oscillator": {**left, "damping": {"modal": {"ratio": "5 %"}}}}}
            ),
            "one link more": pair(links=[links[0], {**links[0], "name": "second", "gap": "2 mm"}]),
        }
        for name, model in models.items():
            model.analysis = TIGHT
            given = {
                "factors": {"e": {"of": "links.0.restitution", "list": [0.5, 0.9]}},
                "records": RECORDS,
                "keep": ["displacement", "force", "impulse"],
            }
            kernel, solver = (
                run_plan(make_plan(model, {**given, "engine": engine}, Path()), None, workers=0)
                for engine in ("auto", "solver")
            )
            self.assertEqual(set(kernel["engine"]), {KERNEL}, name)
            for column in kernel.plan.template.kept.columns:
                self.assertLess(differences(kernel[column], solver[column]).max(), 2e-5, (name, column))
            self.assertEqual(set(kernel_engine._ready(kernel.plan.template)._ways.values()), {""}, name)

    def test_the_solver_takes_models_that_it_runs_faster(self):
        stiff = {
            name: {"shear_building": {**one["shear_building"], "storeys": "30", "stiffness": "90 GN/m"}}
            for name, one in BUILDINGS.items()
        }
        words = {
            "factors": {"gap": {"of": "links.*.gap", "list": ["2 mm"]}},
            "records": {"synthetic": {"count": 1, "duration": "0.3 s", "pga": "0.3 g"}},
        }
        links = [{**FLOORS[0], "between": ["left.30", "right.30"]}]
        del links[0]["floors"]
        for engine, number in (("auto", SOLVER), ("kernel", KERNEL)):
            plan = make_plan(pair(structures=stiff, links=links), {**words, "engine": engine}, Path())
            self.assertEqual(run_plan(plan, None, workers=0)["engine"].tolist(), [number])
        why = kernel_engine.KernelEngine().why_not(
            batch_of(make_plan(pair(structures=stiff, links=links), words, Path()), np.array([0]))
        )
        assert_mentions(why, "60")

    def test_columns_of_buildings_are_those_of_the_solver(self):
        factors = {
            "gap": {"of": "links.*.gap", "list": ["2 mm", "6 mm"]},
            "k": {"of": "structures.left.shear_building.stiffness", "list": ["250 MN/m", "350 MN/m"]},
        }
        self.expect_alike(
            *both(
                pair(structures=BUILDINGS, links=FLOORS, analysis=TIGHT),
                factors,
                intensity={"measure": "pga", "levels": ["0.5 g"]},
                keep=[*ALL, "force.left.1-right.1"],
            )
        )

    def test_columns_beside_a_wall_are_those_of_the_solver(self):
        model = pair(
            structures={
                "left": {"oscillator": {"mass": "100 t", "period": "0.8 s", "damping": "5 %"}},
                "wall": {"wall": {}},
            },
            links=[
                {
                    "between": ["left", "wall"],
                    "gap": "1 mm",
                    "law": "kelvin_voigt",
                    "stiffness": "93.5e6",
                    "restitution": "0.65",
                }
            ],
            analysis=TIGHT,
        )
        self.expect_alike(*both(model, {"gap": {"of": "links.*.gap", "list": ["2 mm", "6 mm"]}}))

    def test_free_vibration_after_the_record_lasts_as_long_as_the_solvers(self):
        model = pair(
            analysis={**TIGHT, "duration": "6 s"},
            structures={
                "left": {"oscillator": {"mass": "100 t", "period": "4 s", "damping": "1 %"}},
                "right": {"oscillator": {"mass": "150 t", "period": "0.4 s", "damping": "5 %"}},
            },
        )
        factors = {"gap": {"of": "links.*.gap", "list": ["2 mm", "20 mm"]}}
        records = {"synthetic": {"count": 2, "duration": "1 s", "pga": "0.5 g"}}
        kernel, solver = both(model, factors, records=records)
        self.expect_alike(kernel, solver)
        short, _ = both(pair(analysis=TIGHT, structures=model.structures), factors, records=records)
        self.assertGreater(differences(kernel["displacement.left"], short["displacement.left"]).max(), 1e-3)

    def test_the_kernel_leaves_rows_that_it_cannot_give_to_the_solver(self):
        gap = {"gap": {"of": "links.*.gap", "list": ["1 mm"]}}
        yields = {
            **pair().structures,
            "left": {
                "oscillator": {
                    "mass": "100 t",
                    "period": "0.8 s",
                    "damping": "5 %",
                    "yield_force": "100 kN",
                    "hardening": "2 %",
                }
            },
        }
        cases = {
            "rigid impacts": (
                pair(
                    links=[
                        {"between": ["left", "right"], "gap": "1 mm", "law": "stereomechanical", "restitution": "0.65"}
                    ]
                ),
                gap,
                {"keep": ["impulse"]},
            ),
            "yielding": (pair(structures=yields), gap, {}),
            "keys for the solver": (pair(analysis={"integrator": "generalized_alpha"}), gap, {}),
            "a closed form": (
                pair(ground_motion={"harmonic": {"amplitude": "1", "period": "0.5 s", "duration": "1 s"}}),
                gap,
                {"records": None},
            ),
        }
        for name, (model, factors, words) in cases.items():
            given = {"factors": factors, "keep": ["force"], **({"records": RECORDS} | words)}
            study = run_plan(
                make_plan(model, {key: value for key, value in given.items() if value is not None}, Path()),
                None,
                workers=0,
            )
            self.assertEqual((set(study["engine"]), set(study["status"])), ({SOLVER}, {DONE}), name)

    def test_each_row_takes_its_engine_by_itself(self):
        factors = FACTORS
        model = pair(
            links=[
                {
                    "between": ["left", "right"],
                    "gap": "1 mm",
                    "law": "kelvin_voigt",
                    "stiffness": "93.5e6",
                    "restitution": "0.65",
                }
            ]
        )
        plan = make_plan(
            model,
            {"factors": {"law": {"of": "links.*.law", "list": ["kelvin_voigt", "hertz_damped"]}, **factors}, **WORDS},
            Path(),
        )
        study = run_plan(plan, None, workers=0)
        self.assertEqual(set(study["engine"]), {KERNEL})
        for law, name in enumerate(("kelvin_voigt", "hertz_damped")):
            alone = run_plan(
                make_plan(pair(links=[{**model.links[0], "law": name}]), {"factors": factors, **WORDS}, Path()),
                None,
                workers=0,
            )
            self.assertGreater(alone["force"].max(), 0)
            np.testing.assert_array_equal(study["force"][study["law"] == law], alone["force"])

    def test_a_row_that_the_kernel_refuses_has_the_reason_of_the_solver(self):
        wrong = {
            "gap": ("links.*.gap", -0.001),
            "e": ("links.*.restitution", 1.5),
            "zero": ("links.*.restitution", 0.0),
            "period": ("structures.left.oscillator.period", -1.0),
            "mass": ("structures.left.oscillator.mass", 0.0),
            "damping": ("structures.right.oscillator.damping", 1.5),
            "negative": ("structures.right.oscillator.damping", -0.01),
            "k": ("links.*.stiffness", -1.0),
        }
        for name, (path, value) in wrong.items():
            good = at(
                pair()._parts(), ("links", 0, path.split(".")[-1]) if path.startswith("links") else path.split(".")
            )
            factors = {name: {"of": path, "list": [float(words_of(good)), value]}}
            words = {"factors": factors, "records": RECORDS, "stop_after": "100 %"}
            kernel, solver = (
                run_plan(make_plan(pair(), {**words, "engine": engine}, Path()), None, workers=0)
                for engine in ("auto", "solver")
            )
            self.assertEqual(kernel["status"].tolist(), [DONE, REFUSED] * 2, name)
            np.testing.assert_array_equal(kernel["status"], solver["status"], name)
            self.assertEqual(kernel.failed, solver.failed, name)

    def test_the_way_of_a_row_does_not_depend_on_others(self):
        factors = {"gap": {"of": "links.*.gap", "list": [1e-3, -1.0, 2e-3]}}
        plan = make_plan(pair(), {"factors": factors, "records": RECORDS, "stop_after": "100 %"}, Path())
        found = {}

        def run(*rows):
            found[rows] = run_batch(batch_of(plan, np.array(rows)))

        # Each thread prepares the study for itself; in the second one a refused row comes first.
        for rows in ((0, 1, 2), (1, 2), (2,)):
            thread = threading.Thread(target=run, args=rows)
            thread.start()
            thread.join()
        self.assertEqual(found[0, 1, 2].status.tolist(), [DONE, REFUSED, DONE])
        for rows in ((1, 2), (2,)):
            np.testing.assert_array_equal(found[rows].values, found[0, 1, 2].values[list(rows)])
            np.testing.assert_array_equal(found[rows].engine, found[0, 1, 2].engine[list(rows)])

    def test_engine_of_a_study_is_a_word(self):
        words = {"factors": FACTORS, **WORDS}
        with raises(InputError, ["engine", "kernal", "kernel"]):
            make_plan(pair(), {**words, "engine": "kernal"}, Path())
        links = [{"between": ["left", "right"], "gap": "1 mm", "law": "stereomechanical", "restitution": "0.65"}]
        study = run_plan(
            make_plan(
                pair(links=links), {**words, "keep": ["impulse"], "engine": "kernel", "stop_after": "100 %"}, Path()
            ),
            None,
            workers=0,
        )
        self.assertEqual(set(study["status"]), {REFUSED})
        assert_mentions(study.failed[0], "engine")

    def test_limits_of_rows_of_the_kernel(self):
        words = {"factors": FACTORS, **WORDS, "limits": {"force": "1 N", "displacement": "1 m"}}
        study = run_plan(make_plan(pair(), words, Path()), None, workers=0)
        self.assertEqual(set(study["engine"]), {KERNEL})
        np.testing.assert_array_equal(study["status"] == EXCEEDED, study["force"] > 1)
        self.assertEqual(set(study["status"]), {DONE, EXCEEDED})

    def test_a_sample_runs_on_both_engines_and_is_kept(self):
        self.assertEqual(rows_to_check(36).tolist(), [0, 17, 35])
        self.assertEqual((len(rows_to_check(2)), len(rows_to_check(6540000))), (2, 6540))
        plan = make_plan(pair(), {"factors": FACTORS, **WORDS}, Path())
        study = run_plan(plan, self.folder / "s.h5", workers=0)
        solver = run_plan(make_plan(pair(), {"factors": FACTORS, **WORDS, "engine": "solver"}, Path()), None, workers=0)
        self.assertEqual((sorted(study.check), solver.check), ([0, 17, 35], {}))
        columns = plan.template.kept.columns
        for row in study.check:
            np.testing.assert_array_equal(study.check[row], [solver[column][row] for column in columns])
        with h5py.File(self.folder / "s.h5") as file:
            apart = file["check/difference"][:]
            np.testing.assert_array_equal(
                apart,
                differences(
                    np.array([[study[column][row] for column in columns] for row in (0, 17, 35)]),
                    file["check/solver"][:],
                ),
            )
        # Half a second at 1e-3: equal to the tolerance, not bitwise.
        self.assertLess(apart.max(), 1e-2)
        self.assertEqual(sorted(pounding.Study.open(self.folder / "s.h5").check), [0, 17, 35])

    def test_the_report_says_what_ran_where(self):
        (self.folder / "pair.yaml").write_text(pair().to_yaml())
        words = pounding._yaml_text.plain({"factors": FACTORS, **WORDS})
        (self.folder / "study.yaml").write_text(pounding._yaml_text.emit({"model": "pair.yaml", "study": words}))

        def command(*words):
            done = subprocess.run(
                [sys.executable, "-m", "pounding", "study", *words],
                cwd=self.folder,
                capture_output=True,
                text=True,
                timeout=300,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout

        checked = command("check", "study.yaml")
        assert_mentions(checked, ["20", "36", "3"])
        ran = command("study.yaml", "-j", "0")
        assert_mentions(ran, ["36", "3"])
        self.assertEqual(command("show", "study.h5").splitlines()[:2], ran.splitlines()[:2])

    def test_rows_of_the_kernel_run_in_scripts_as_they_stand(self):
        (self.folder / "script.py").write_text(
            "import sys\nsys.path.insert(0, %r)\nfrom study_samples import *\n"
            "print(pounding.study(pair(), FACTORS, progress=False)['force'].tolist())\n" % str(Path(__file__).parent)
        )
        done = subprocess.run([sys.executable, self.folder / "script.py"], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout), pounding.study(pair(), FACTORS, workers=0)["force"].tolist())

    def test_threads_run_what_the_kernel_takes_and_processes_the_rest(self):
        factors = {"gap": {"of": "links.*.gap", "list": [1e-3, -1.0, 2e-3, 3e-3, -2.0, 4e-3]}}
        plan = make_plan(pair(), {"factors": factors, "records": RECORDS, "stop_after": "100 %"}, Path())
        seen = []
        found = run_plan(
            plan, self.folder / "s.h5", chunk=2, progress=lambda done, failed, count: seen.append((done, count))
        )
        self.assertEqual(found["engine"].tolist(), [KERNEL, SOLVER, KERNEL, KERNEL, SOLVER, KERNEL] * 2)
        self.assertEqual([done for done, _ in seen], sorted(done for done, _ in seen))
        self.assertEqual((seen[-1], {count for _, count in seen}), ((12, 12), {12}))
        here = run_plan(plan, None, workers=0)
        for name, values in here.columns.items():
            np.testing.assert_array_equal(found[name], values, err_msg=name)
        self.assertEqual((found.failed, sorted(found.check)), (here.failed, sorted(here.check)))

    def test_places_write_what_the_model_of_a_row_holds(self):
        model = pair()._parts()
        plan = make_plan(
            pair(),
            {
                "factors": {
                    "p": {"of": "structures.left.oscillator.period", "list": ["0.5 s", "1.1 s"]},
                    **FACTORS,
                    "law": {"of": "links.*.law", "list": ["hertz_damped", "lankarani_nikravesh"]},
                },
                **WORDS,
            },
            Path(),
        )
        places = Places(model, plan.template.factors)
        batch = batch_of(plan, np.arange(plan.count))
        for values, numbers in zip(batch.values, places.numbers(batch.values)):
            whole = plan.template.case(values.tolist(), 0, 1.0)
            self.assertEqual([at(whole, keys) for keys in places.keys], places.texts(numbers))

    def test_a_plan_of_another_kernel_is_refused(self):
        plan = make_plan(pair(), {"factors": FACTORS, **WORDS}, Path())
        self.assertEqual(plan.description()["kernel"], pounding._core.kernel_version)
        self.assertEqual([engine.name for engine in ENGINES], ["kernel", "solver"])

    def test_a_batch_may_hold_rows_of_both_engines(self):
        times = {"even": 0.02 * np.arange(200), "uneven": 0.02 * np.arange(200) + 1e-3 * (np.arange(200) % 2)}
        for name, t in times.items():
            lines = "".join(f"{a!r},{b!r}\n" for a, b in zip(t.tolist(), (3 * np.sin(9 * t)).tolist()))
            (self.folder / f"{name}.csv").write_text("time [s],acceleration [m/s2]\n" + lines)
        factors = {"gap": {"of": "links.*.gap", "list": ["1 mm", "-1 mm", "2 mm"]}}
        words = {
            "factors": factors,
            "records": {"files": [str(self.folder / f"{name}.csv") for name in times]},
            "stop_after": "100 %",
        }
        plan = make_plan(pair(), words, Path())
        done = run_batch(batch_of(plan, np.arange(plan.count)))
        self.assertEqual(done.status.tolist(), [DONE, REFUSED, DONE] * 2)
        self.assertEqual(done.engine.tolist(), [KERNEL, SOLVER, KERNEL, SOLVER, SOLVER, SOLVER])
        self.assertEqual(sorted(done.reasons), [1, 4])
        alone = [run_batch(batch_of(plan, np.array([row]))).values[0] for row in range(6)]
        np.testing.assert_array_equal(done.values, alone)


def words_of(text):
    from pounding._studies.reading import quantity

    return quantity(text, "")[0]


if __name__ == "__main__":
    unittest.main()
