"""Limits of studies: quantities that a model does not have are refused, and bare numbers common in other units give a
warning."""

import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import pounding
from pounding.errors import InputError
from pounding._studies.batches import DONE
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan
from study_samples import WORDS, pair
from messages import assert_mentions, raises

RIGID = {"between": ["left", "right"], "gap": "1 mm", "law": "stereomechanical", "restitution": "0.65"}
BALL = {
    "structures": {"ball": {"body": {"mass": "10 t"}, "initial_velocity": "1 m/s"}, "w": {"wall": {}}},
    "links": [{"between": ["ball", "w"], "gap": "1 mm", "law": "hertz", "stiffness": "2.75e9"}],
    "analysis": {"duration": "0.1 s"},
    "ground_motion": None,
}
ROW = {
    "structures": {
        **pair().structures,
        "third": {"oscillator": {"mass": "150 t", "period": "0.6 s", "damping": "5 %"}},
    },
    "links": [RIGID, {**pair().links[0], "between": ["right", "third"]}],
}


class Undefined(unittest.TestCase):
    def refused(self, text, words, **model):
        with raises(InputError, text):
            make_plan(pair(**model), words, Path())

    def test_a_rigid_link_has_no_force(self):
        instead = "left-right"
        self.refused(["keep", instead], {"keep": ["force"]}, links=[RIGID])
        self.refused(["limits", instead], {"limits": {"force": "5 MN"}}, links=[RIGID])
        self.refused(["keep", instead], {"keep": ["force", "impacts"]}, **ROW)
        self.refused([], {"keep": ["force.left-right"]}, **ROW)
        self.assertIn(
            "force.right-third", make_plan(pair(**ROW), {"keep": ["force.right-third"]}, Path()).template.kept.columns
        )

    def test_the_default_takes_the_impulse_instead(self):
        self.assertEqual(
            make_plan(pair(links=[RIGID]), {}, Path()).template.kept.columns,
            ("displacement.left", "displacement.right", "impulse", "impacts"),
        )
        self.assertIn("force", make_plan(pair(), {}, Path()).template.kept.columns)
        study = run_plan(make_plan(pair(links=[RIGID]), {"limits": {"impulse": "1 N s"}}, Path()), None, workers=0)
        self.assertFalse(np.isnan(study["impulse"]).any())
        self.assertNotIn(DONE, study["status"])

    def test_a_body_has_no_drift(self):
        for words, place in (
            ({"keep": ["drift"]}, "keep"),
            ({"keep": ["drift.ball"]}, "keep"),
            ({"limits": {"drift": "30 mm"}}, "limits"),
        ):
            self.refused(f"{place}", words, **BALL)
        # The others keep their values.
        both = {**pair().structures, "ball": {"body": {"mass": "10 t"}}}
        kept = make_plan(pair(structures=both), {"keep": ["drift", "displacement.ball"]}, Path()).template.kept
        self.assertEqual(kept.columns, ("drift.left", "drift.right", "displacement.ball"))

    def test_a_frame_without_floors_has_no_floor(self):
        frame = {
            "frame": {
                "material": {"E": "30 GPa", "density": "2500 kg/m^3"},
                "sections": {"c": {"circle": "0.4 m"}},
                "nodes": {"a": [0, 0], "b": [0, 3]},
                "members": {"c": {"between": ["a", "b"], "section": "c"}},
                "supports": {"a": "fixed"},
            },
            "damping": "5 %",
        }
        self.refused([], {"keep": ["displacement"]}, structures={"mast": frame}, links=[])

    def test_links_that_are_not_there_have_no_gap(self):
        self.refused("required_gap", {"keep": ["required_gap"]}, links=[])
        self.refused(["left-rigth", "left-right"], {"keep": ["force.left-rigth"]})

    def test_a_correlation_that_is_undefined_stays_so(self):
        # For any order of the links: the first has none, the second has one.
        for links in ([("left", "ball"), ("right", "left")], [("right", "left"), ("left", "ball")]):
            structures = {**pair().structures, "ball": {"body": {"mass": "10 t"}}}
            model = pair(
                structures=structures, links=[{**pair().links[0], "between": list(between)} for between in links]
            )
            for engine in ("solver", "auto"):
                study = run_plan(
                    make_plan(model, {"keep": ["gap_ddc", "gap_srss"], "engine": engine}, Path()), None, workers=0
                )
                self.assertTrue(
                    np.isnan(study["gap_ddc"]).all() and (study["gap_srss"] > 0).all(), (engine, study.table)
                )
                study = run_plan(
                    make_plan(
                        model,
                        {"keep": ["gap_srss"], "limits": {"gap_ddc": "1 mm"}, "engine": engine, "stop_after": "100 %"},
                        Path(),
                    ),
                    None,
                    workers=0,
                )
                self.assertEqual(
                    list(study.failed.values()),
                    ["study.limits: gap_ddc is undefined in this row, so it cannot be compared with its limit"],
                )

    def test_readings_of_earlier_tables_do_not_count_it_as_survival(self):
        study = run_plan(make_plan(pair(), {**WORDS, "keep": ["force"]}, Path()), None, workers=0)
        study.columns["force"] = np.where(np.arange(len(study)) % 2, study["force"], np.nan)
        curve = study.fragility("force", "1 N", bootstrap=0)
        self.assertEqual((curve.count.sum(), curve.undefined), (3, 3))
        self.assertEqual(study.percentiles("force").count.sum(), 3)
        study.columns["force"][:] = np.nan
        for reading in (lambda: study.fragility("force", "1 N"), lambda: study.percentiles("force")):
            with raises(InputError):
                reading()


class Bare(unittest.TestCase):
    def test_readings_doubt_them_too(self):
        study = run_plan(
            make_plan(pair(), {**WORDS, "keep": ["acceleration", "drift", "impacts", "required_gap"]}, Path()),
            None,
            workers=0,
        )
        for call in (
            lambda: study.fragility("acceleration.left", 0.4, bootstrap=0),
            lambda: study.fragility("acceleration.left", "0.4", bootstrap=0),
            lambda: study.gaps().exceedance(20),
        ):
            with self.assertWarnsRegex(pounding.ImplausibleWarning, "(0.4 g|20 mm)"):
                call()
        with self.assertWarnsRegex(pounding.ImplausibleWarning, "0.02.*20 mm"):
            study.fragility("drift.left", "0.02", bootstrap=0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            study.fragility("acceleration.left", "0.4 g", bootstrap=0)
            study.fragility("impacts", 0.5, bootstrap=0)
            study.fragility("drift.left", 0.02, bootstrap=0)
            study.fragility("drift.left", "20 mm", bootstrap=0)
            self.assertEqual(study.gaps().exceedance("20 mm"), study.gaps().exceedance(0.02))

    def test_limits_are_finite(self):
        study = run_plan(make_plan(pair(), {**WORDS, "keep": ["impacts"]}, Path()), None, workers=0)
        for limit in (float("nan"), float("inf"), "nan"):
            with raises(InputError):
                study.fragility("impacts", limit)
        with self.assertRaises(InputError):
            make_plan(pair(), {"limits": {"impacts": float("nan")}}, Path())

    def test_the_command_prints_a_doubt_as_one_line(self):
        from contextlib import redirect_stderr, redirect_stdout
        from io import StringIO

        from pounding._studies import command

        with tempfile.TemporaryDirectory() as folder:
            run_plan(make_plan(pair(), {**WORDS, "keep": ["acceleration"]}, Path()), Path(folder) / "s.h5", workers=0)
            with redirect_stderr(StringIO()) as told, redirect_stdout(StringIO()):
                self.assertEqual(
                    command.main(
                        ["study", "show", f"{folder}/s.h5", "--json", "--column", "acceleration.left", "--limit", "0.4"]
                    ),
                    0,
                )
        assert_mentions(told.getvalue(), ["warning", "acceleration.left", "0.4 g", "m/s^2"])


if __name__ == "__main__":
    unittest.main()
