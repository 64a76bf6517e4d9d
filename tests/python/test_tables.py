"""Tables and short texts of envelopes and pushovers, floors in all directions, and letters without a font."""

import os
import unittest
import warnings
from pathlib import Path
from unittest import mock

import numpy as np

import pounding
from messages import assert_mentions, raises
from pounding.errors import InputError
from pounding._pictures import style

EXAMPLES = Path(os.environ["POUNDING_EXAMPLES"])


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = pounding.run(EXAMPLES / "11_eccentric_pair" / "model.yaml")

    def test_envelopes_are_tables_and_short_texts(self):
        for name, one in self.run_.envelopes.items():
            table = self.run_.to_pandas()[f"envelopes/{name}"]
            for i, floor in enumerate(one.floors):
                row = table.loc[("displacement", floor, "y")]
                self.assertEqual((row["min"], row["max"]), tuple(one.displacement.values[i, 1]))
                self.assertEqual(row["time_of_max"], one.displacement.times[i, 1, 1])
            forces = table.loc["member_force"]
            self.assertEqual(len(forces), len(one.members) * len(one.components))
            self.assertLess(len(str(one)), 1000)
            self.assertLess(len(repr(one.member_force)), 100)
            assert_mentions(str(one), [name, f"member: {len(one.members)}"])

    def test_floors_in_all_directions(self):
        structure = next(iter(self.run_.structures.values()))
        moved = structure.in_all_directions()
        self.assertEqual(moved.shape, (*structure.displacement.shape, 3))
        np.testing.assert_array_equal(moved[:, :, 0], structure.displacement)
        np.testing.assert_array_equal(moved[:, :, 2], structure.along["rz"].displacement)
        self.assertTrue(np.isnan(structure.in_all_directions("drift")[:, :, 2]).all())
        with raises(InputError, ["speed", "velocity"]):
            structure.in_all_directions("speed")

    def test_pushover_has_tables(self):
        found = pounding.pushover(EXAMPLES / "20_hinge_frames" / "model.yaml", "left", to="1 % roof")
        tables = found.to_pandas()
        np.testing.assert_array_equal(tables["curve"]["base_shear"], found.base_shear)
        np.testing.assert_array_equal(tables["curve"]["floor 8"], found.floor_displacement[:, 7])
        self.assertEqual(len(tables["events"]), len(found.events))
        self.assertEqual(list(tables["parts"].index), found.parts)

    def test_public_names_only(self):
        names = dir(pounding)
        self.assertTrue(set(pounding.__all__) <= set(names))
        for name in ("importlib", "sys", "_HOMES", "annotations", "TYPE_CHECKING"):
            self.assertNotIn(name, names)


class Fonts(unittest.TestCase):
    def test_missing_letters_are_one_warning_with_the_remedy(self):
        with style.picture((2, 2), "\u6771\u4eac") as figure:
            figure.subplots()
        with (
            mock.patch.dict(style.STYLE, {"font.family": ["DejaVu Sans"]}),
            warnings.catch_warnings(record=True) as seen,
        ):
            warnings.simplefilter("always")
            for text in figure.texts:
                text.set_fontfamily("DejaVu Sans")
            figure._suptitle.set_fontfamily("DejaVu Sans")
            figure._repr_png_()
        self.assertEqual(len(seen), 1)
        assert_mentions(str(seen[0].message), ["fonts-noto-cjk", "\u6771"])

    def test_an_installed_font_is_the_fallback(self):
        font = mock.Mock()
        font.name = "IPAGothic"
        with mock.patch.object(style.font_manager.fontManager, "ttflist", [font]):
            self.assertEqual(style._fonts(), ["DejaVu Sans", "IPAGothic"])


if __name__ == "__main__":
    unittest.main()
