"""A slice of damage.py: no reader reads a damaged results file, crashes or hangs."""

import unittest

import damage


class Damage(unittest.TestCase):
    def test_is_refused_by_every_reader(self):
        fates = damage.survey(count=100, seed=2015, verbs=6)
        self.assertGreater(fates["read", "refused"], 90)
        self.assertGreater(fates["run", "refused"], 4)
        self.assertEqual({reader: fate for reader, fate in fates if fate != "refused"}, {})


if __name__ == "__main__":
    unittest.main()
