"""Largest openings of links, in tables of studies and in results."""

import unittest
from pathlib import Path

import pounding
from pounding.errors import InputError
from pounding._studies.batches import DONE
from pounding._studies.plan import make_plan
from pounding._studies.study import run_plan
from messages import raises


def model(gap="20 mm", **changed):
    parts = dict(
        structures={
            "a": {"oscillator": {"mass": "100 t", "period": "0.8 s", "damping": "5 %"}},
            "b": {"oscillator": {"mass": "150 t", "period": "0.4 s", "damping": "5 %"}},
            "c": {"oscillator": {"mass": "150 t", "period": "0.6 s", "damping": "5 %"}},
        },
        links=[
            {"between": pair, "name": name, "gap": gap, "seat": "30 mm", "law": "linear_spring", "stiffness": "1e9"}
            for name, pair in (("west", ["a", "b"]), ("east", ["b", "c"]))
        ],
        ground_motion={"synthetic": {"seed": 1, "duration": "3 s", "pga": "0.3 g", "soil": "firm"}},
        analysis={"tolerance": 1e-5},
    )
    return pounding.Model(**{**parts, **changed})


def plan_of(of, **words):
    return make_plan(of, {"factors": {"gap": {"of": "links.*.gap", "list": ["20 mm", "60 mm"]}}, **words}, Path())


class Openings(unittest.TestCase):
    def test_are_kept_as_single_runs_report_them(self):
        plan = plan_of(model(), keep=["opening", "opening.east"], limits={"opening": "30 mm"})
        self.assertEqual(plan.template.kept.units(), {"opening": "m", "opening.east": "m"})
        study = run_plan(plan, None, workers=1)
        self.assertEqual(study.failed, {})
        for row, gap in enumerate(("20 mm", "60 mm")):
            links = {one["name"]: one for one in pounding.run(model(gap)).summary["links"]}
            self.assertEqual(study["opening"][row], max(one["largest_opening"] for one in links.values()))
            self.assertEqual(study["opening.east"][row], links["east"]["largest_opening"])
            self.assertGreater(study["opening"][row], 0.03)
        self.assertNotIn(DONE, study["status"])

    def test_are_in_the_results(self):
        run = pounding.run(model())
        for name, link in run.links.items():
            with self.subTest(name):
                [one] = [one for one in run.summary["links"] if one["name"] == name]
                self.assertEqual(
                    (link.largest_opening, link.t_opening, link.seat, link.unseated),
                    (one["largest_opening"], one["t_opening"], one["seat"], one["unseated"]),
                )
                # Samples of an open link are the output times; the largest opening may lie between two of them.
                sampled = -(link.penetration + link.gap).min()
                self.assertGreaterEqual(link.largest_opening, sampled)
                self.assertLess(link.largest_opening, 1.01 * sampled)

    def test_of_a_model_without_links_are_refused(self):
        for word in ("opening", "opening.west"):
            with self.subTest(word), raises(InputError, "link"):
                make_plan(
                    model(links=[]),
                    {"factors": {"mass": {"of": "structures.a.oscillator.mass", "list": ["60 t"]}}, "keep": [word]},
                    Path(),
                )
        with raises(InputError, ["north", "west"]):
            plan_of(model(), keep=["opening.north"])


if __name__ == "__main__":
    unittest.main()
