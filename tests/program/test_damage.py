"""A short run of damage.py: no reader accepts a damaged results file, crashes or hangs."""

import unittest

import damage


class Damage(unittest.TestCase):
    def test_is_refused_by_every_reader(self):
        fates = damage.survey(count=240, seed=2015, verbs=12)
        kinds = {kind for kind, *_ in fates}
        self.assertEqual(len(kinds), 11 + damage.WITH_STUDIES)
        for kind in kinds:
            self.assertGreater(fates[kind, "read", "refused"], 10, kind)
        self.assertEqual(sum(fates[kind, "run", "refused"] for kind in kinds), 12)
        self.assertEqual([found for found in fates if found[-1] != "refused"], [])


if __name__ == "__main__":
    unittest.main()
