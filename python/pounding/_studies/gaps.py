"""Sufficient gaps: their distribution over records, and estimates by rules from the displacements."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from pounding._arguments import number, one_of, takes, text
from pounding._native import core
from pounding._studies.distributions import stats
from pounding._studies.quantities import bare_limit_warning
from pounding.errors import ImplausibleWarning, InputError

_CONFIDENCE = number(0, 0.999999)


@dataclass(frozen=True)
class GapCurve:
    """Fraction of rows for which a gap is insufficient, over the gap."""

    gap: np.ndarray  #: [row] in ascending order [m]
    rules: dict[str, np.ndarray] = field(default_factory=dict)  #: abs, srss, ddc -> [row] in the order of the rows [m]
    required: np.ndarray = field(default_factory=lambda: np.empty(0))  #: [row] in the order of the rows [m]
    #: number of events; rows of one event at other levels or gaps are not independent
    independent: int = 0

    @classmethod
    def of(cls, required: np.ndarray, rules: Mapping[str, np.ndarray], events: np.ndarray | None = None) -> GapCurve:
        """The curve of some rows.

        Parameters
        ----------
        required : numpy.ndarray
            [row] required gap [m].
        rules : mapping
            [row] gap by each rule [m].
        events : numpy.ndarray, optional
            [row] identifies rows of one event; by default each row is an event.

        Returns
        -------
        GapCurve
            The curve.

        Raises
        ------
        InputError
            No row has a required gap.
        """
        known = ~np.isnan(required)
        if not known.any():
            raise InputError("no row has a required gap; write keep: [required_gap]")
        return cls(
            np.sort(required[known]),
            {name: values[known] for name, values in rules.items()},
            required[known],
            int(known.sum()) if events is None else len(np.unique(events[known])),
        )

    def exceedance(self, gap: float | str) -> float:
        """Fraction of rows that need a larger gap. The required gap of a collapse without links is infinite.

        Parameters
        ----------
        gap : float or str
            The gap [m], or "20 mm".

        Returns
        -------
        float
            The fraction.
        """
        return float(np.mean(self.gap > _metres(gap)))

    @takes(confidence=_CONFIDENCE)
    def band(self, gap: float | str, confidence: float = 0.9) -> tuple[float, float]:
        """Confidence interval of the probability that a gap is insufficient (Clopper and Pearson 1934), with the number of
        events as sample size.

        Parameters
        ----------
        gap : float or str
            The gap [m], or "20 mm".
        confidence : float
            Confidence of the interval.

        Returns
        -------
        tuple of float
            Lower and upper bound.
        """
        return clopper_pearson(
            int((self.gap > _metres(gap)).sum()) * self.independent / len(self.gap), self.independent, confidence
        )

    @takes(percent=number(0, 100), confidence=_CONFIDENCE)
    def percentile(self, percent: float, confidence: float = 0.9) -> tuple[float, float, float]:
        """Gap that is sufficient for a percentage of the rows, with its confidence interval by order statistics.

        Parameters
        ----------
        percent : float
            Percentage of the rows.
        confidence : float
            Confidence of the interval.

        Returns
        -------
        tuple of float
            Gap, lower and upper bound [m]; a bound is infinite if there are too few rows.
        """
        n = self.independent
        tail = (1 - confidence) / 2
        low = _binomial_quantile(tail, n, percent / 100)
        high = _binomial_quantile(1 - tail, n, percent / 100) + 1
        return (
            self._at(percent / 100),
            self._at(low / n) if low >= 1 else 0.0,
            self._at(high / n) if high <= n else math.inf,
        )

    def _at(self, share: float) -> float:
        return float(self.gap[max(1, math.ceil(share * len(self.gap) - 1e-9)) - 1])

    def ratio(self, rule: str) -> np.ndarray:
        """Gap by a rule divided by the required gap; the rule is safe above 1.

        Parameters
        ----------
        rule : str
            "abs", "srss" or "ddc".

        Returns
        -------
        numpy.ndarray
            [row] ratio.
        """
        one_of(self.rules)("rule", rule)
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.rules[rule] / self.required


def _metres(gap: float | str) -> float:
    """A gap [m]. Raises InputError for another unit, NaN and infinity; warns of a bare number that looks like mm."""
    gap = text("gap", gap) if isinstance(gap, str) else number()("gap", gap)
    if doubt := bare_limit_warning("gap", gap, "m"):
        warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
    return core.quantity(gap, "m") if isinstance(gap, str) else gap


def _binomial_quantile(probability: float, count: int, share: float) -> int:
    """Smallest number of successes whose cumulative probability reaches `probability`, as scipy.stats.binom.ppf."""
    if share in (0.0, 1.0):
        return int(count * share)
    total = 0.0
    for k in range(count + 1):
        logarithm = math.lgamma(count + 1) - math.lgamma(k + 1) - math.lgamma(count - k + 1)
        total += math.exp(logarithm + k * math.log(share) + (count - k) * math.log1p(-share))
        if total >= probability:
            return k
    return count


def records_for_band(percent: float, confidence: float = 0.9) -> int:
    """Number of records from which the upper bound of a percentile is finite: the largest of n records is an upper
    bound with the probability 1 - p^n."""
    return math.ceil(math.log((1 - confidence) / 2) / math.log(percent / 100) - 1e-9)


def clopper_pearson(exceeded: float, count: int, confidence: float = 0.9) -> tuple[float, float]:
    """Exact confidence interval of a probability after `exceeded` of `count` trials."""
    tail = (1 - confidence) / 2
    low = 0.0 if exceeded == 0 else float(stats().beta.ppf(tail, exceeded, count - exceeded + 1))
    high = 1.0 if exceeded == count else float(stats().beta.ppf(1 - tail, exceeded + 1, count - exceeded))
    return low, high
