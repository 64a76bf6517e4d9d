"""Distributions of factors, by scipy.stats."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.studies import words
from pounding.studies.scipy_stats import stats

#: Words of a distribution, each with its parameters.
KINDS = {
    "uniform": ("from", "to"),
    "normal": ("mean", "sd", "cov"),
    "lognormal": ("median", "cov", "beta"),
    "triangular": ("from", "mode", "to"),
    "discrete": ("values", "probabilities"),
    "scipy": ("name",),
}
EXAMPLES = {
    "uniform": "{from: 10 mm, to: 40 mm}",
    "normal": "{mean: 5 %, sd: 1 %}",
    "lognormal": "{median: 2.75e9, cov: 0.3}",
    "triangular": "{from: 10 mm, mode: 20 mm, to: 40 mm}",
    "discrete": "{values: [10 mm, 20 mm], probabilities: [0.3, 0.7]}",
    "scipy": "{name: gamma, a: 2, scale: 0.01}",
}


#: Coefficient of variation of a lognormal distribution, at most.
MOST_COV = 1e6


@dataclass(frozen=True)
class Distribution:
    """A kind with its parameters in SI; the values of `discrete` in `values`."""

    kind: str
    parameters: tuple[tuple[str, float], ...] = ()
    values: tuple[float, ...] = ()
    truncate: tuple[float, float] | None = None
    name: str = ""  #: in scipy.stats, for the kind "scipy"

    def ppf(self, probability: np.ndarray) -> np.ndarray:
        """Values that are not exceeded with these probabilities; infinite ones where numbers end."""
        if self.kind == "discrete":
            steps = np.cumsum([value for _, value in self.parameters])
            return np.asarray(self.values)[
                np.minimum(np.searchsorted(steps, probability, side="right"), len(self.values) - 1)
            ]
        with np.errstate(all="ignore"):
            frozen = self._frozen()
            if self.truncate is not None:
                low, high = frozen.cdf(self.truncate)
                probability = low + probability * (high - low)
            return np.asarray(frozen.ppf(probability), dtype=float)

    def _frozen(self) -> Any:
        p = dict(self.parameters)
        if self.kind == "uniform":
            return stats().uniform(p["from"], p["to"] - p["from"])
        if self.kind == "normal":
            return stats().norm(p["mean"], p["sd"])
        if self.kind == "lognormal":
            return stats().lognorm(p["beta"], scale=p["median"])
        if self.kind == "triangular":
            return stats().triang((p["mode"] - p["from"]) / (p["to"] - p["from"]), p["from"], p["to"] - p["from"])
        named: Any = getattr(stats(), self.name)
        return named(**p)


def read_distribution(kind: str, given: Any, truncate: Any, place: str) -> tuple[Distribution, str]:
    """A distribution and the SI unit of its values. Raises InputError."""
    where = f"{place}.{kind}"
    if kind == "scipy":
        return _named(given, truncate, where)
    one = words.only(given, KINDS[kind], where)
    if kind == "discrete":
        return _discrete(one, where)
    pure = [key for key in ("cov", "beta") if key in one]
    sized = [key for key in one if key not in pure]
    if not sized or len(one) != (3 if kind == "triangular" else 2):
        raise InputError(f"{where}: takes {EXAMPLES[kind]}; {', '.join(one) or 'nothing'} was read")
    values, unit = words.quantities([one[key] for key in sized], f"{where}: [{', '.join(sized)}]")
    p = dict(zip(sized, values))
    for key in pure:
        p[key] = words.quantity(one[key], f"{where}.{key}")[0]
    _complete(kind, p, where)
    made = Distribution(kind, tuple(sorted(p.items())), truncate=_bounds(truncate, unit, where))
    _require_values(made, EXAMPLES[kind], where)
    return made, unit


def _require_values(made: Distribution, example: str, place: str) -> None:
    """Raises InputError where values that samples may have are no numbers, or are all the same."""
    least, middle, most = made.ppf(np.array([1e-12, 0.5, 1 - 1e-12]))
    if not np.isfinite([least, middle, most]).all():
        raise InputError(
            f"{place}: has values from {least:g} over {middle:g} to {most:g}, and finite ones are needed; type values as in {example}, or limits "
            "in which it has some, as in truncate: [LOWER, UPPER]"
        )
    if not least < most:
        raise InputError(
            f"{place}: all of its values are {middle:g}; type a wider spread as in {example}, or list: [{middle:g}] for one value"
        )


def _complete(kind: str, p: dict[str, float], place: str) -> None:
    """Turns coefficients of variation into the parameters of scipy, and refuses values that no distribution has."""
    if kind == "normal" and "cov" in p and "mean" in p:
        p["sd"] = abs(p["mean"]) * p.pop("cov")
    if kind == "lognormal" and "cov" in p:
        cov = p.pop("cov")
        if not 0 < cov <= MOST_COV:
            raise InputError(
                f"{place}.cov: takes a positive number of at most {MOST_COV:g}, such as 0.3; {cov:g} was read"
            )
        p["beta"] = math.sqrt(math.log1p(cov**2))
    needed = {
        "uniform": ("from", "to"),
        "normal": ("mean", "sd"),
        "lognormal": ("median", "beta"),
        "triangular": ("from", "mode", "to"),
    }[kind]
    if set(p) != set(needed):
        raise InputError(f"{place}: takes {EXAMPLES[kind]}")
    tests: dict[str, Callable[[], bool]] = {
        "uniform": lambda: p["from"] >= p["to"],
        "normal": lambda: p["sd"] <= 0,
        "lognormal": lambda: min(p["median"], p["beta"]) <= 0,
        "triangular": lambda: not p["from"] <= p["mode"] <= p["to"] or p["from"] == p["to"],
    }
    if tests[kind]():
        raise InputError(
            f"{place}: no such distribution; positive spreads and rising limits as in {EXAMPLES[kind]} are needed"
        )


def _discrete(one: dict[str, Any], place: str) -> tuple[Distribution, str]:
    values, unit = words.quantities(one.get("values"), f"{place}.values")
    shares = [
        words.quantity(share, f"{place}.probabilities")[0]
        for share in one.get("probabilities", [1 / len(values)] * len(values))
    ]
    if len(shares) != len(values) or min(shares) < 0 or abs(sum(shares) - 1) > 1e-9:
        raise InputError(f"{place}.probabilities: takes one a value, not negative, with the sum 1")
    return Distribution("discrete", tuple((str(i), share) for i, share in enumerate(shares)), tuple(values)), unit


def _named(given: Any, truncate: Any, place: str) -> tuple[Distribution, str]:
    name = given.get("name") if isinstance(given, dict) else None
    if not isinstance(getattr(stats(), str(name), None), stats().rv_continuous):
        raise InputError(
            f"{place}: takes the name of a continuous distribution of scipy.stats, as in {EXAMPLES['scipy']}; {name!r} was read"
        )
    p = {key: words.quantity(value, f"{place}.{key}")[0] for key, value in given.items() if key != "name"}
    made = Distribution("scipy", tuple(sorted(p.items())), truncate=_bounds(truncate, "", place), name=str(name))
    try:
        _require_values(made, EXAMPLES["scipy"], place)
    except TypeError as error:
        raise InputError(f"{place}: {error}") from None
    return made, ""


def _bounds(truncate: Any, unit: str, place: str) -> tuple[float, float] | None:
    if truncate is None:
        return None
    bounds, own = words.quantities(truncate, f"{place}: truncate")
    words.same_unit(own, unit, f"{place}: truncate", "20 mm")
    if unit and not own:
        raise InputError(
            f"{place}: truncate takes limits in {unit}, as the values have; bare numbers were read: {truncate}"
        )
    low, high = bounds[0], bounds[-1]
    if len(bounds) != 2 or low >= high:
        raise InputError(f"{place}: truncate takes a lower and an upper limit")
    return low, high
