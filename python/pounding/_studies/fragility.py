"""Fragility curves P(exceeded | im) = Phi(ln(im/theta)/beta), fitted by maximum likelihood.

The likelihood is binomial, of counts or of single rows (Baker 2015). Standard errors come from the expected
information, as in probit regression. Separated data, in which every exceedance lies above every survival, have no
finite fit; bounds are reported instead."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pounding._arguments import numbers, takes
from pounding._studies.distributions import special
from pounding.errors import InputError


@dataclass(frozen=True)
class Fragility:
    """A fitted curve, or the reason why there is none."""

    theta: float  #: median intensity; NaN without a finite fit
    beta: float  #: dispersion; NaN without a finite fit
    se_log_theta: float  #: standard error of ln theta
    se_beta: float
    im: np.ndarray  #: intensities of the data
    count: np.ndarray  #: trials at each
    exceeded: np.ndarray  #: exceedances at each
    bounds: tuple[float, float] = (np.nan, np.nan)  #: bounds of theta for separated data
    problem: str = ""  #: reason for a missing fit
    boot: np.ndarray | None = None  #: [sample, 2] theta and beta of the bootstrap
    failed: int = 0  #: rows without numbers, excluded from the fit
    undefined: int = 0  #: rows with an undefined quantity, such as a ratio with a collapse, excluded from the fit

    @property
    def is_finite(self) -> bool:
        """True if the fit is finite."""
        return not self.problem

    def probability(self, im: np.ndarray | float) -> np.ndarray:
        """Probability of exceedance.

        Parameters
        ----------
        im : array_like
            Intensities.

        Returns
        -------
        numpy.ndarray
            Probability at each.
        """
        return np.asarray(special().ndtr(np.log(numbers("im", im) / self.theta) / self.beta))

    @takes(im=numbers)
    def band(self, im: np.ndarray | float, percent: tuple[float, float] = (5, 95)) -> np.ndarray:
        """Confidence band of the curve, from bootstrap over events.

        Parameters
        ----------
        im : array_like
            Intensities.
        percent : tuple of float
            Percentages of the lower and the upper curve.

        Returns
        -------
        numpy.ndarray
            [2, im] lower and upper probability.

        Raises
        ------
        InputError
            The curve has no bootstrap.
        """
        if self.boot is None or not len(self.boot):
            raise InputError("no band: the curve has no bootstrap over records")
        x = np.log(np.atleast_1d(np.asarray(im, dtype=float)))
        # theta may be 0 if nearly all rows of a sample exceed: its curve is 1.
        with np.errstate(divide="ignore"):
            curves = special().ndtr((x - np.log(self.boot[:, :1])) / self.boot[:, 1:])
        return np.percentile(curves, percent, axis=0)

    def __str__(self) -> str:
        if not self.is_finite:
            return self.problem
        return (
            f"theta {self.theta:.4g}, beta {self.beta:.4g}; standard errors {self.se_log_theta:.2g} of ln theta, {self.se_beta:.2g} of beta"
            + (f"; {self.failed} failed rows are excluded" if self.failed else "")
            + (f"; {self.undefined} rows with undefined values are excluded" if self.undefined else "")
        )


def fit(
    im: Sequence[float] | np.ndarray, count: Sequence[int] | np.ndarray, exceeded: Sequence[int] | np.ndarray
) -> Fragility:
    """Fits a curve to the exceedances at each intensity.

    Parameters
    ----------
    im : sequence of float
        Intensities.
    count : sequence of int
        Number of trials at each.
    exceeded : sequence of int
        Number of exceedances at each.

    Returns
    -------
    Fragility
        The curve.

    Raises
    ------
    InputError
        The lengths differ, or a count or intensity is impossible.

    Examples
    --------
    >>> curve = pounding.studies.fragility.fit([0.1, 0.2, 0.4, 0.8], [20, 20, 20, 20], [1, 5, 12, 18])
    >>> round(curve.theta, 2)
    0.33
    """
    x, n, k = np.asarray(im, dtype=float), np.asarray(count, dtype=float), np.asarray(exceeded, dtype=float)
    if not x.shape == n.shape == k.shape or x.ndim != 1 or not x.size:
        raise InputError("a fragility takes one count and one number of exceedances for each intensity")
    if (x <= 0).any() or not np.isfinite(x).all() or (k < 0).any() or (k > n).any():
        raise InputError("a fragility takes positive intensities, and at most as many exceedances as trials")
    if found := _problem(x, n, k):
        return _without_fit(x, n, k, *found)
    a, b, covariance = _probit(np.log(x), n, k)
    if not b > 0:
        return _without_fit(x, n, k, _FALLING)
    slope = np.array([[-1 / b, a / b**2], [0, -1 / b**2]])
    errors = np.sqrt(np.diag(slope @ covariance @ slope.T))
    return Fragility(float(np.exp(-a / b)), float(1 / b), float(errors[0]), float(errors[1]), x, n, k)


_FALLING = "exceedances do not grow with the intensity, so no lognormal curve fits: check the intensity measure"


def _without_fit(
    x: np.ndarray, n: np.ndarray, k: np.ndarray, problem: str, bounds: tuple[float, float] = (np.nan, np.nan)
) -> Fragility:
    return Fragility(np.nan, np.nan, np.nan, np.nan, x, n, k, bounds, problem)


def _problem(x: np.ndarray, n: np.ndarray, k: np.ndarray) -> tuple[str, tuple[float, float]] | None:
    """Why the likelihood has no maximum at finite theta and beta > 0, with bounds of theta."""
    if k.sum() == 0:
        return f"no row exceeds up to {x.max():.4g}: theta is above; add higher levels", (float(x.max()), np.inf)
    if k.sum() == n.sum():
        return f"everything is exceeded from {x.min():.4g} on: theta is below; add lower levels", (0.0, float(x.min()))
    if x.min() == x.max():
        return f"all rows have the intensity {x.min():.4g}: one level determines neither theta nor beta; add levels", (
            np.nan,
            np.nan,
        )
    survived, fell = x[k < n].max(), x[k > 0].min()
    if survived == fell:
        return (
            f"the data are separated: all survive below {fell:.4g} and all exceed above it, so beta has no finite estimate; theta is there; add "
            "levels near it, or records"
        ), (float(survived), float(fell))
    if survived < fell:
        return (
            f"the data are separated: all survive up to {survived:.4g} and all exceed from {fell:.4g} on, so beta has no finite estimate; theta is "
            "between the two; add levels there, or records"
        ), (float(survived), float(fell))
    if x[k > 0].max() <= x[k < n].min():
        return _FALLING, (np.nan, np.nan)
    return None


def _probit(z: np.ndarray, n: np.ndarray, k: np.ndarray) -> tuple[float, float, np.ndarray]:
    """Newton's method with the observed information on P = Phi(a + b z), whose likelihood is concave; the covariance
    is from the expected information.

    Bootstrap fits a thousand times; scipy.stats would spend five times the time of the functions on checks of
    arguments."""
    log_cdf = special().log_ndtr
    shift, spread = z.mean(), z.std() or 1.0
    t = (z - shift) / spread
    design = np.column_stack([np.ones_like(t), t])
    q = np.array([special().ndtri(k.sum() / n.sum()), 0.0])

    def likelihood(at: np.ndarray) -> float:
        eta = design @ at
        return float(np.sum(k * log_cdf(eta) + (n - k) * log_cdf(-eta)))

    best = likelihood(q)
    for _ in range(200):
        eta = design @ q
        up, down = np.exp(_log_pdf(eta) - log_cdf(eta)), np.exp(_log_pdf(eta) - log_cdf(-eta))
        gradient = design.T @ (k * up - (n - k) * down)
        weight = k * up * (up + eta) + (n - k) * down * (down - eta)
        step = np.linalg.solve(design.T @ (weight[:, None] * design), gradient)
        # A tenth of the round-off of the likelihood; shorter steps have no effect.
        while (new := likelihood(q + step)) < best - 1e-14 * abs(best) and np.abs(step).max() > 1e-14:
            step = step / 2
        q, best = q + step, max(best, new)
        if np.abs(step).max() < 1e-12 * max(1.0, np.abs(q).max()):
            break
    eta = design @ q
    information = n * np.exp(2 * _log_pdf(eta) - log_cdf(eta) - log_cdf(-eta))
    back = np.array([[1, -shift / spread], [0, 1 / spread]])
    covariance = back @ np.linalg.inv(design.T @ (information[:, None] * design)) @ back.T
    return float(q[0] - q[1] * shift / spread), float(q[1] / spread), covariance


def _log_pdf(x: np.ndarray) -> np.ndarray:
    return -(x**2) / 2 - np.log(np.sqrt(2 * np.pi))


def of_rows(
    im: np.ndarray,
    exceeded: np.ndarray,
    event: np.ndarray,
    *,
    bootstrap: int = 1000,
    seed: int = 1,
    failed: int = 0,
    undefined: int = 0,
) -> Fragility:
    """The curve of single rows, with a band from bootstrap over events with all their rows."""
    found = fit(*_counted(im, exceeded))
    boot = []
    if found.is_finite and bootstrap:
        generator = np.random.default_rng(seed)
        names, which = np.unique(event, return_inverse=True)
        rows = [np.flatnonzero(which == i) for i in range(len(names))]
        for _ in range(bootstrap):
            drawn = np.concatenate([rows[i] for i in generator.integers(0, len(names), len(names))])
            one = fit(*_counted(im[drawn], exceeded[drawn]))
            # A bootstrap sample without a finite fit is a step between its bounds of theta.
            if one.is_finite:
                boot.append((one.theta, one.beta))
    return replace(found, boot=np.array(boot).reshape(-1, 2), failed=failed, undefined=undefined)


def _counted(im: np.ndarray, exceeded: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    levels, which = np.unique(im, return_inverse=True)
    return (
        levels,
        np.bincount(which, minlength=len(levels)),
        np.bincount(which, weights=np.asarray(exceeded, dtype=float), minlength=len(levels)),
    )
