"""The verification book prints the digits that a tolerance resolves, and its check detects differences."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python/docs"))
import verification_book as book

ROW = "| force [N] | 3 | 1.250 ... 7.000 | 1.251 ... 7.001 | 0.005 | 0.20 |"


class Numbers(unittest.TestCase):
    def test_have_the_digits_that_the_tolerance_resolves(self):
        for value, tolerance, shown in (
            (0.65, 1e-6, "0.650000"),
            (12342170.1, 1234, "1.2342e+07"),
            (9154.3, 1.0, "9154"),
            (2.5e-9, 1e-12, "2.500e-09"),
            (-1 / 3, 5e-3, "-0.333"),
            (1e-17, 1e-12, "0"),
            (12, 0, "12"),
            (1e5, 1e-12, "100000.000000000"),
        ):
            self.assertEqual(book.digits(value, tolerance), shown)

    def test_of_many_cases_are_the_least_and_the_greatest(self):
        cases = [(2.0, 2.001, 0.01), (1.0, 1.004, 0.01), (3.0, 2.999, 0.01)]
        self.assertEqual(book.row("x [m]", cases), "| x [m] | 3 | 1.00 ... 3.00 | 1.00 ... 3.00 | 0.01 | 0.40 |")
        self.assertEqual(book.tolerance([(1.0, 1.0, 1e-5), (3.0, 3.0, 3e-5)]), "1e-05 of it")
        self.assertEqual(
            book.row("x [m]", [(0.0, 1e-9, 1e-6), (0.0, -2.5e-8, 1e-6)]), "| x [m] | 2 | 0 | 2.5e-08 | 1e-06 | 0.03 |"
        )
        self.assertEqual(book.tolerance([(0.0, 0.0, 0.0), (3.0, 3.0, 3e-5)]), "1e-05 of it")
        self.assertEqual(book.tolerance([(0.0, 0.0, 1e-5), (3.0, 3.0, 3e-5)]), "1e-05 ... 3e-05")
        self.assertEqual(book.tolerance([(5.0, 5.0, 0.0)]), "equal")


class Check(unittest.TestCase):
    def same(self, a, b):
        return book.differences(f"one\n{a}\nlast\n", f"one\n{b}\nlast\n") == []

    def test_takes_another_obtained_number_and_rounding_of_the_expected_one(self):
        self.assertTrue(self.same(ROW, ROW))
        self.assertTrue(self.same(ROW, ROW.replace("1.251", "1.249").replace("0.20", "0.31")))
        self.assertTrue(self.same(ROW, ROW.replace("1.250", "1.251")))
        forces = "| force [N] | 2 | 0 ... 846861 | 0 ... 846860 | 1e+02 | 0.20 |"
        self.assertTrue(self.same(forces, forces.replace("846861", "846868")))
        self.assertFalse(self.same(forces, forces.replace("846861", "846881")))
        self.assertTrue(
            self.same(
                forces.replace("1e+02", "0.0001 of it"),
                forces.replace("1e+02", "0.0001 of it").replace("846861", "846868"),
            )
        )

    def test_refuses_another_quantity_count_expectation_and_tolerance(self):
        for before, now in (
            ("force", "forces"),
            ("| 3 |", "| 4 |"),
            ("7.000", "7.003"),
            ("1.250 ... 7.000", "7.000"),
            ("0.005", "0.5"),
        ):
            self.assertFalse(self.same(ROW, ROW.replace(before, now, 1)), (before, now))
        self.assertFalse(self.same("**Source:** hand", "**Source:** foot"))
        self.assertNotEqual(book.differences(ROW, f"{ROW}\n{ROW}2"), [])


if __name__ == "__main__":
    unittest.main()
