"""Records of a study together with the ground motion of its model: the wave, components, strengths, and incompatible
ones."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding
from pounding.errors import InputError
from pounding._studies.plan import make_plan
from pounding._studies.sources import partners
from pounding._studies.study import run_plan
from study_samples import bents, blocks, pair, write_records
from messages import assert_mentions

PAIRS = ["RSN6_A180-hor1.csv", "RSN6_A270-hor2.csv", "RSN77_B164-hor1.csv", "RSN77_B254-hor2.csv", "up1.csv", "up2.csv"]
XY = {"components": {"x": {"record": PAIRS[0]}, "y": {"record": PAIRS[1]}}}
WAVE = {"velocity": "200 m/s"}


class Motions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        write_records(self.folder, PAIRS)

    def plan(self, model, **words):
        model._file = str(self.folder / "model.yaml")
        return make_plan(model, {"keep": ["displacement", "force", "impacts"], **words}, self.folder)

    def study(self, model, **words):
        return run_plan(self.plan(model, **words), None, workers=0)

    def run_of(self, model):
        model._file = str(self.folder / "model.yaml")
        summary = pounding.run(model).summary
        return [max(one["peak_displacement"]) for one in summary["structures"].values()], summary["links"][0]["impacts"]

    def assert_row(self, study, row, model):
        peaks, impacts = self.run_of(model)
        self.assertEqual([study[f"displacement.{name}"][row] for name in model.structures], peaks)
        self.assertEqual(study["impacts"][row], impacts)
        again = self.run_of(pounding.Model.from_yaml(study.model_of(row)))
        self.assertEqual(again, (peaks, impacts))

    def test_the_wave_is_kept(self):
        for engine in ("auto", "solver"):
            study = self.study(bents(record=PAIRS[2], wave=WAVE), records={"files": PAIRS[:2]}, engine=engine)
            for row in (0, 1):
                self.assert_row(study, row, bents(record=PAIRS[row], wave=WAVE))
        still = self.study(bents(record=PAIRS[2]), records={"files": PAIRS[:2]})
        self.assertFalse((still["displacement.right"] == study["displacement.right"]).any())

    def test_a_wave_may_stand_alone_and_be_a_factor(self):
        factors = {"c": {"of": "ground_motion.wave.velocity", "list": ["200 m/s", "400 m/s"]}}
        study = self.study(
            bents(wave=WAVE),
            records={"files": PAIRS[:2]},
            factors=factors,
            intensity={"measure": "pga", "levels": ["0.2 g", "0.5 g"]},
        )
        for row, (record, velocity) in ((1, (0, "200 m/s")), (3, (0, "400 m/s")), (7, (1, "400 m/s"))):
            self.assert_row(study, row, bents(record=PAIRS[record], wave={"velocity": velocity}, pga="0.5 g"))
        self.assertEqual(len(set(study["displacement.right"])), 8)

    def test_pairs_of_records(self):
        for words in (
            {"x": "*-hor1.csv", "y": "*-hor2.csv"},
            {"x": [PAIRS[0], PAIRS[2]], "y": [PAIRS[1], PAIRS[3]]},
            {"files": {"x": "RSN*1.csv", "y": "RSN*2.csv"}},
            {"x": {"files": "*hor1.csv", "units": "m/s^2"}, "y": {"files": "*hor2.csv"}},
        ):
            study = self.study(blocks(**XY), records=words)
            self.assertEqual(
                list(study.records["name"]),
                ["RSN6_A180-hor1.csv + RSN6_A270-hor2.csv", "RSN77_B164-hor1.csv + RSN77_B254-hor2.csv"],
            )
        for row in (0, 1):
            self.assert_row(
                study, row, blocks(components={"x": {"record": PAIRS[2 * row]}, "y": {"record": PAIRS[2 * row + 1]}})
            )
        levels = self.study(blocks(**XY), records=words, intensity={"measure": "pga", "levels": ["0.4 g"]})
        own = [pounding._core.record_measures(str(self.folder / name), "", "")[3] for name in PAIRS[:2]]
        scale = 0.4 * 9.80665 / np.sqrt(own[0] * own[1])
        np.testing.assert_allclose(levels["scale"][0], scale, rtol=1e-14)
        peaks, _ = self.run_of(
            blocks(
                components={
                    axis: {"record": name, "scale": repr(float(levels["scale"][0]))} for axis, name in zip("xy", PAIRS)
                }
            )
        )
        self.assertEqual(levels["displacement.left"][0], peaks[0])

    def test_triples_and_components_along_one_axis(self):
        study = self.study(
            blocks(components={**XY["components"], "z": {"record": "up1.csv"}}),
            records={"x": PAIRS[0], "y": PAIRS[1], "z": "up2.csv"},
        )
        self.assert_row(study, 0, blocks(components={**XY["components"], "z": {"record": "up2.csv"}}))
        study = self.study(blocks(components={"y": {"record": PAIRS[0]}}), records={"files": PAIRS[1]})
        self.assert_row(study, 0, blocks(components={"y": {"record": PAIRS[1]}}))

    def test_partners_by_their_names(self):
        one = lambda *texts: [(text,) for text in texts]
        self.assertEqual(partners(["1x", "2x"], ["1y", "2y"], one("1", "2"), one("1", "2")), [0, 1])
        # RSN1 and RSN10 share their beginning.
        self.assertEqual(partners(["RSN1_a", "RSN10_a"], ["RSN10_b", "RSN1_b"], one("p", "q"), one("r", "s")), [1, 0])
        self.assertIsNone(partners(["a1", "a2"], ["a3", "a4"], one("1", "2"), one("3", "4")))
        self.assertIsNone(partners(["a1", "b1"], ["c3", "d4"], one("1", "2"), one("3", "4")))

    def test_the_strength_of_the_model_is_kept(self):
        for strength in ({"scale": "2"}, {"pga": "0.6 g"}):
            study = self.study(
                pair(ground_motion={"record": PAIRS[0], **strength}), records={"files": PAIRS[:2]}, engine="solver"
            )
            for row in (0, 1):
                self.assert_row(study, row, pair(ground_motion={"record": PAIRS[row], **strength}))
            # A level is the strength itself.
            words = {
                "records": {"files": PAIRS[:2]},
                "intensity": {"measure": "sa", "period": "0.8 s", "levels": ["0.5 g"]},
            }
            with_it, without = (
                self.study(pair(ground_motion={"record": PAIRS[0], **strength}), **words),
                self.study(pair(), **words),
            )
            np.testing.assert_allclose(with_it["displacement.left"], without["displacement.left"], rtol=1e-9)

    def test_records_without_times_need_a_step(self):
        (self.folder / "values.txt").write_text("\n".join(map(str, np.sin(np.arange(80) / 5).tolist())) + "\n")
        study = self.study(
            pair(),
            records={"files": "values.txt", "units": "m/s^2", "step": "0.01 s"},
            intensity={"measure": "sa", "period": "0.5 s"},
        )
        self.assertEqual(study.records["step"][0], 0.01)
        self.assertGreater(study["im"][0], 0)

    def refused(self, said, model, **words):
        with self.assertRaises(InputError) as caught:
            self.plan(model, **words)
        assert_mentions(str(caught.exception), said)

    def test_components_are_channels_of_one_file(self):
        lines = [(self.folder / name).read_text().splitlines()[1:] for name in PAIRS[:2]]
        both = [f"{first},{second.partition(',')[2]}" for first, second in zip(*lines)]
        (self.folder / "both.csv").write_text("\n".join(["time [s],NS [m/s2],EW [m/s2]", *both]) + "\n")
        plan = self.plan(
            blocks(**XY),
            records={"x": {"files": "both.csv", "channel": "NS"}, "y": {"files": "both.csv", "channel": "EW"}},
        )
        parts = plan.template.motions[0].words["components"]
        self.assertEqual([part["channel"] for part in parts.values()], ["NS", "EW"])
        self.refused(
            [],
            blocks(**XY),
            records={"x": {"files": "both.csv", "channel": "NS"}, "y": {"files": "both.csv", "channel": "NS"}},
        )

    def test_a_record_that_is_there_twice_is_told(self):
        plan = self.plan(pair(ground_motion=None), records={"files": ["RSN*", PAIRS[0]]})
        assert_mentions(" ".join(plan.warnings), ["study.records", f"{PAIRS[0]}"])
        self.assertNotIn(
            "more than once", " ".join(self.plan(pair(ground_motion=None), records={"files": PAIRS[:3]}).warnings)
        )

    def test_what_does_not_fit_is_refused(self):
        self.refused([], blocks(**XY), records={"files": PAIRS[:2]})
        self.refused([], blocks(**XY), records={"synthetic": {"count": 2, "duration": "0.8 s", "pga": "0.3 g"}})
        self.refused([], blocks(**XY), records={"x": PAIRS[0]})
        self.refused("2", blocks(**XY), records={"x": PAIRS[:2], "y": PAIRS[2]})
        self.refused([], blocks(**XY), records={"x": "RSN*", "y": "RSN*"})
        self.refused([], blocks(**XY), records={"x": PAIRS[0], "y": PAIRS[1], "z": PAIRS[1]})
        write_records(self.folder, ["c1.csv", "c2.csv", "d3.csv", "d4.csv"])
        self.refused([], blocks(**XY), records={"x": "c*.csv", "y": "d*.csv"})
        self.refused([], blocks(**XY), records={"x": PAIRS[0], "files": PAIRS})
        self.refused(
            ["ground_motion.initial_velocity", "0.1"],
            pair(ground_motion={"record": PAIRS[0], "initial_velocity": "0.1"}),
            records={"files": PAIRS[1]},
        )
        for place, model in (("structures.left.ground_motion", pair()), ("structures.right.ground_motion", pair())):
            name = place.split(".")[1]
            model.structures = {
                **model.structures,
                name: {**model.structures[name], "ground_motion": {"record": PAIRS[0]}},
            }
            self.refused(f"{place}", model, records={"files": PAIRS[1]})
        self.refused(
            "ground_motion.synthetic.pga",
            pair(),
            records={"files": PAIRS[1]},
            factors={"pga": {"of": "ground_motion.synthetic.pga", "list": ["0.1 g"]}},
        )
        self.refused(
            "ground_motion.synthetic.pga",
            pair(),
            intensity={"measure": "pga", "levels": ["0.2 g"]},
            factors={"pga": {"of": "ground_motion.synthetic.pga", "list": ["0.1 g"]}},
        )
        # A plane model does not move along y.
        self.refused([], bents(record=PAIRS[0]), records={"x": PAIRS[0], "y": PAIRS[1]})


if __name__ == "__main__":
    unittest.main()
