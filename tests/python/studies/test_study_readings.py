"""Readings of studies from numbers only, against references computed without this package."""

import importlib.util
import math
import unittest

import numpy as np
from scipy.linalg import solve_continuous_lyapunov
from scipy.stats import binomtest, norm

from pounding.errors import InputError
from pounding._native import core
from pounding._studies import gaps, percentiles
from pounding._studies.fragility import fit, of_rows
from messages import assert_mentions


def cloud():
    generator = np.random.default_rng(5)
    im = np.exp(generator.normal(np.log(0.3), 0.6, 200))
    return im, np.ones(200, int), (generator.random(200) < norm.cdf(np.log(im / 0.35) / 0.45)).astype(int)


class Fragility(unittest.TestCase):
    """References by statsmodels 0.14 (GLM, binomial, probit) and by direct minimisation of the likelihood, which agree
    to 8 digits."""

    def test_counts_and_clouds_give_the_fits_of_statsmodels(self):
        for (im, n, k), theta, beta, errors in (
            (
                ([0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9], [40] * 7, [0, 3, 9, 17, 26, 35, 39]),
                0.41660516,
                0.44904518,
                (0.044342, 0.048116),
            ),
            (([0.15, 0.25, 0.4, 0.6, 0.8], [22, 44, 44, 30, 18], [1, 7, 20, 22, 17]), 0.41627100, 0.52529456, None),
            (cloud(), 0.31865994, 0.38273267, None),
        ):
            found = fit(im, n, k)
            # statsmodels stops about 1e-8 below the maximum likelihood.
            self.assertAlmostEqual(found.theta, theta, delta=5e-8)
            self.assertAlmostEqual(found.beta, beta, delta=5e-8)
            if errors:
                np.testing.assert_allclose([found.se_log_theta, found.se_beta], errors, atol=5e-7)

    def test_separated_data_have_bounds_instead_of_numbers(self):
        found = fit([0.1, 0.2, 0.3, 0.4], [10] * 4, [0, 0, 10, 10])
        self.assertFalse(found.is_finite)
        self.assertEqual(found.bounds, (0.2, 0.3))
        self.assertIn("separated", found.problem)
        self.assertTrue(math.isnan(found.theta))
        # A single row of the other outcome makes the fit finite.
        self.assertTrue(fit([0.1, 0.2, 0.3, 0.4], [10] * 4, [0, 1, 9, 10]).is_finite)

    def test_separated_at_one_level_has_no_finite_fit_either(self):
        found = fit([0.1, 0.2, 0.3], [10] * 3, [0, 4, 10])
        self.assertFalse(found.is_finite)
        self.assertEqual(found.bounds, (0.2, 0.2))
        assert_mentions(found.problem, "0.2")

    def test_one_level_has_no_fit(self):
        assert_mentions(fit([0.2], [10], [8]).problem, "0.2")
        assert_mentions(fit([0.2, 0.2], [10, 10], [8, 3]).problem, "0.2")

    def test_one_class_says_on_which_side_theta_lies(self):
        self.assertEqual(fit([0.1, 0.2, 0.3], [10] * 3, [0, 0, 0]).bounds, (0.3, np.inf))
        self.assertEqual(fit([0.1, 0.2, 0.3], [10] * 3, [10, 10, 10]).bounds, (0, 0.1))

    def test_a_probability_that_falls_is_told(self):
        self.assertIn("do not grow", fit([0.1, 0.2, 0.3, 0.4], [10] * 4, [8, 6, 5, 2]).problem)

    def test_the_band_is_wider_when_rows_of_an_event_are_alike(self):
        im, _, k = cloud()
        alone = of_rows(im, k, np.arange(200).astype(str), bootstrap=300)
        twice = of_rows(np.repeat(im, 4), np.repeat(k, 4), np.repeat(np.arange(200), 4).astype(str), bootstrap=300)
        self.assertAlmostEqual(alone.theta, twice.theta, places=9)
        widths = [float(np.diff(one.band(0.3), axis=0)[0, 0]) for one in (alone, twice)]
        # Copies of a row add no information: with resampling by event the band is unchanged; the standard error of
        # independent rows would halve.
        self.assertAlmostEqual(widths[0], widths[1], delta=0.15 * widths[0])
        self.assertAlmostEqual(twice.se_log_theta, alone.se_log_theta / 2, places=6)
        low, high = alone.band(0.3)
        self.assertTrue(low[0] < alone.probability(0.3) < high[0])

    def test_wrong_counts_are_refused(self):
        for bad in (([0.1], [1], [2]), ([0.0], [1], [1]), ([0.1, 0.2], [1], [1])):
            with self.assertRaises(InputError):
                fit(*bad)


class Percentiles(unittest.TestCase):
    def test_order_statistics_keep_infinite_values(self):
        values = np.array([1.0, 2, 3, np.inf])
        self.assertEqual([percentiles.order_statistic(values, p) for p in (16, 25, 50, 75, 84)], [1, 1, 2, 3, np.inf])
        self.assertTrue(math.isnan(percentiles.order_statistic(np.array([np.nan]), 50)))

    def test_intensity_at_a_value_lies_between_levels(self):
        found = percentiles.at_levels(
            np.repeat([1.0, 2, 4], 3), np.array([1.0, 1, 1, 2, 3, 4, 9, np.inf, np.inf]), (50,)
        )
        np.testing.assert_array_equal(found.values, [[1, 3, np.inf]])
        self.assertEqual([found.im_at(value, 50) for value in (0.5, 2, 3, 100)], [1, 1.5, 2, 4])


class Gaps(unittest.TestCase):
    def test_bands_are_those_of_clopper_and_pearson(self):
        for k, n in ((0, 25), (1, 25), (12, 25), (25, 25)):
            exact = binomtest(k, n).proportion_ci(0.9, method="exact")
            np.testing.assert_allclose(gaps.clopper_pearson(k, n, 0.9), (exact.low, exact.high), atol=1e-12)

    def test_percentiles_have_a_band_that_few_rows_leave_open(self):
        curve = gaps.GapCurve.of(np.arange(1.0, 26), {})
        gap, low, high = curve.percentile(84)
        self.assertEqual((gap, low, high), (21, 18, 25))
        self.assertEqual(gaps.GapCurve.of(np.arange(1.0, 6), {}).percentile(84)[2], math.inf)
        self.assertEqual(curve.exceedance(20.5), 0.2)

    def test_rows_of_one_event_are_no_further_samples(self):
        needs, events = np.arange(1.0, 26), np.arange(25)
        once, often = gaps.GapCurve.of(needs, {}), gaps.GapCurve.of(np.repeat(needs, 12), {}, np.repeat(events, 12))
        for gap in (0, 7.5, 20.5, 30):
            np.testing.assert_allclose(often.band(gap), once.band(gap), atol=1e-12)
            self.assertEqual(often.exceedance(gap), once.exceedance(gap))
        for percent in (16, 50, 84, 99):
            self.assertEqual(often.percentile(percent), once.percentile(percent))

    def test_the_band_of_a_percentile_holds_it_as_often_as_it_says(self):
        generator = np.random.default_rng(3)
        held = [
            low <= norm.ppf(0.84) <= high
            for _, low, high in (
                gaps.GapCurve.of(generator.normal(size=60), {}).percentile(84, 0.9) for _ in range(2000)
            )
        ]
        # Order statistics are conservative: at least 90 %, minus three standard errors of the fraction.
        self.assertGreater(np.mean(held), 0.9 - 3 * math.sqrt(0.09 / 2000))
        self.assertLess(np.mean(held), 0.97)

    def test_the_correlation_of_the_double_difference_is_that_of_white_noise(self):
        # Covariance of two oscillators under white noise by Lyapunov's equation.
        for T1, z1, T2, z2 in (
            (1, 0.05, 0.5, 0.05),
            (1, 0.05, 0.9, 0.05),
            (1, 0.02, 0.95, 0.05),
            (0.3, 0.05, 1.2, 0.02),
        ):
            w1, w2 = 2 * math.pi / T1, 2 * math.pi / T2
            motion = np.array(
                [[0, 1, 0, 0], [-w1 * w1, -2 * z1 * w1, 0, 0], [0, 0, 0, 1], [0, 0, -w2 * w2, -2 * z2 * w2]]
            )
            noise = np.array([[0], [-1], [0], [-1.0]])
            p = solve_continuous_lyapunov(motion, -noise @ noise.T)
            self.assertAlmostEqual(
                core.double_difference(T1, z1, T2, z2), p[0, 2] / math.sqrt(p[0, 0] * p[2, 2]), places=10
            )
        self.assertEqual(core.double_difference(1, 0.05, 1, 0.05), 1)


@unittest.skipUnless(importlib.util.find_spec("SALib"), "SALib is not installed")
class Indices(unittest.TestCase):
    def test_a_linear_model_has_the_indices_of_its_variances(self):
        from pounding._studies.sensitivity import sobol_indices
        from pounding._studies.study_table import Study

        from SALib.sample import sobol
        from pounding._studies.sampling import saltelli_problem

        sample = sobol.sample(saltelli_problem(3), 1024, calc_second_order=False, seed=1)
        values = sample @ [1.0, 2, 3]
        points = np.arange(len(sample))
        study = Study(
            {"point": points, "y": values, "status": np.ones(len(sample), np.int8)},
            {},
            {},
            {},
            {
                "sampling": {"way": "saltelli", "count": len(sample)},
                "factors": [{"name": n, "distribution": {}} for n in "abc"],
            },
            [],
        )
        found = sobol_indices(study, "y")
        np.testing.assert_allclose(found.first, np.array([1, 4, 9]) / 14, atol=0.01)
        np.testing.assert_allclose(found.total, np.array([1, 4, 9]) / 14, atol=0.01)


if __name__ == "__main__":
    unittest.main()
