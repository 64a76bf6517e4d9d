"""Gaps of 50, 70 and 100 % of a code's rule, on a small scale: pounding occurs if a pair needs more than its gap."""

import importlib.util
import os
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

import pounding

FOLDER = Path(__file__).parents[3] / "examples/gap_of_a_code"


def script(name):
    found = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


class GapsOfACode(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        for file in ("model.yaml", "study.yaml"):
            shutil.copy(FOLDER / file, folder.name)
        os.chdir(folder.name)

    def test_pairs_touch_where_they_need_more_than_their_gap(self):
        script("gaps").main(3)
        text = Path("study.yaml").read_text()
        found = pounding.study("study.yaml", workers=0, progress=False)
        Path("needed.yaml").write_text(
            text.replace("keep: [impacts, force]", "keep: [required_gap, displacement]\n  without_links: yes")
        )
        alone = pounding.study("needed.yaml", workers=0, progress=False)
        self.assertEqual((len(found), set(found["share"])), (25 * 4 * 3 * 3, {0.5, 0.7, 1.0}))
        touch = found["impacts"] > 0
        np.testing.assert_array_equal(touch, alone["required_gap"] > found["gap"])
        often = [touch[found["share"] == share].mean() for share in (0.5, 0.7, 1.0)]
        self.assertTrue(1 > often[0] > often[1] > often[2] > 0, often)
        # The rule by the runs themselves: the spectrum of the script is linear between 200 periods.
        by_pair = {side: alone[f"displacement.{side}.alone"].reshape(25, -1).mean(axis=0) for side in ("left", "right")}
        code = np.hypot(by_pair["left"], by_pair["right"]) * found["share"].reshape(25, -1)[0]
        np.testing.assert_allclose(found["gap"].reshape(25, -1)[0], code, rtol=0.02)

    def test_a_spectrum_above_the_mean_widens_every_gap(self):
        often = script("far_field").not_enough(
            "model.yaml", {"synthetic": {"count": 3, "duration": "5 s", "pga": "0.35 g", "soil": "firm"}}, 16
        )
        self.assertEqual(often.shape, (5, 3))
        self.assertTrue((np.diff(often, axis=0) <= 0).all() and (np.diff(often, axis=1) <= 0).all())
        # 2 x 0.5 and 1 x 1 are the same gap.
        self.assertEqual(often[4, 0], often[0, 2])
        self.assertLess(often[4, 2], often[0, 0])


if __name__ == "__main__":
    unittest.main()
