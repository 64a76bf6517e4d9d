"""Probability distributions of factors, and the modules of scipy, imported on first use so that workers and pictures do
not load them."""

from __future__ import annotations

import importlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

from pounding._studies import reading
from pounding.errors import InputError

#: Kinds of distributions.
KINDS = ("uniform", "normal", "lognormal", "triangular", "discrete", "scipy")
EXAMPLES = reading.EXAMPLES["factor"]


@dataclass(frozen=True)
class Distribution:
    """A kind of distribution and its parameters in SI; `values` are those of `discrete`."""

    kind: str
    parameters: tuple[tuple[str, float], ...] = ()
    values: tuple[float, ...] = ()
    truncate: tuple[float, float] | None = None
    name: str = ""  #: name in scipy.stats, for the kind "scipy"

    def ppf(self, probability: np.ndarray) -> np.ndarray:
        """Quantiles (percent point function) of these probabilities; infinite beyond the range of floating-point
        numbers."""
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


def read_distribution(kind: str, one: dict[str, Any], truncate: Any, place: str) -> tuple[Distribution, str]:
    """A distribution and the SI unit of its values. Raises InputError."""
    where = f"{place}.{kind}"
    if kind == "scipy":
        return _named(one, truncate, where)
    if kind == "discrete":
        return _discrete(one, where)
    sized = [key for key in one if key not in ("cov", "beta")]
    values, unit = reading.quantities([one[key] for key in sized], f"{where}: [{', '.join(sized)}]")
    p = {**one, **dict(zip(sized, values))}
    _complete(kind, p, where)
    made = Distribution(kind, tuple(sorted(p.items())), truncate=_bounds(truncate, unit, where))
    _require_values(made, EXAMPLES[kind], where)
    return made, unit


def _require_values(made: Distribution, example: str, place: str) -> None:
    """Raises InputError if samples can be infinite or NaN, or if all of them are equal."""
    least, middle, most = made.ppf(np.array([1e-12, 0.5, 1 - 1e-12]))
    if not np.isfinite([least, middle, most]).all():
        raise InputError(
            f"{place}: has values from {least:g} over {middle:g} to {most:g}, which must be finite; type values as in {example}, or limits "
            "in which it has some, as in truncate: [LOWER, UPPER]"
        )
    if not least < most:
        raise InputError(
            f"{place}: all of its values are {middle:g}; type a wider spread as in {example}, or list: [{middle:g}] for one value"
        )


def _complete(kind: str, p: dict[str, float], place: str) -> None:
    """Replaces coefficients of variation by the parameters of scipy.stats. Raises InputError for parameters outside
    the range of the distribution."""
    if kind == "normal" and "cov" in p:
        p["sd"] = abs(p["mean"]) * p.pop("cov")
    if kind == "lognormal" and "cov" in p:
        p["beta"] = math.sqrt(math.log1p(p.pop("cov") ** 2))
    valid = {
        "uniform": lambda: p["from"] < p["to"],
        "normal": lambda: p["sd"] > 0,
        "lognormal": lambda: min(p["median"], p["beta"]) > 0,
        "triangular": lambda: p["from"] <= p["mode"] <= p["to"] and p["from"] < p["to"],
    }
    if not valid[kind]():
        raise InputError(f"{place}: takes positive spreads and rising limits, as in {EXAMPLES[kind]}")


def _discrete(one: dict[str, Any], place: str) -> tuple[Distribution, str]:
    values, unit = reading.quantities(one["values"], f"{place}.values")
    shares = one.get("probabilities", [1 / len(values)] * len(values))
    if len(shares) != len(values) or abs(sum(shares) - 1) > 1e-9:
        raise InputError(
            f"{place}.probabilities: takes one probability per value, {len(values)} in all, with the sum 1; {len(shares)} with "
            f"the sum {sum(shares):g} were read"
        )
    return Distribution("discrete", tuple((str(i), share) for i, share in enumerate(shares)), tuple(values)), unit


def _named(one: Mapping[str, str], truncate: Any, place: str) -> tuple[Distribution, str]:
    name = one.get("name")
    if not isinstance(getattr(stats(), str(name), None), stats().rv_continuous):
        raise InputError(
            f"{place}: takes the name of a continuous distribution of scipy.stats, as in {EXAMPLES['scipy']}; {name!r} was read"
        )
    p = {key: reading.quantity(value, f"{place}.{key}")[0] for key, value in one.items() if key != "name"}
    made = Distribution("scipy", tuple(sorted(p.items())), truncate=_bounds(truncate, "", place), name=str(name))
    try:
        _require_values(made, EXAMPLES["scipy"], place)
    except TypeError as error:
        raise InputError(f"{place}: {error}") from None
    return made, ""


def _bounds(truncate: Sequence[str] | None, unit: str, place: str) -> tuple[float, float] | None:
    if truncate is None:
        return None
    (low, high), own = reading.quantities(truncate, f"{place}: truncate")
    reading.require_unit(own, unit, f"{place}: truncate", "20 mm")
    if unit and not own:
        raise InputError(
            f"{place}: truncate takes limits in {unit}, the unit of the values; bare numbers were read: {truncate}"
        )
    if low >= high:
        raise InputError(f"{place}: truncate takes a lower and an upper limit")
    return low, high


def stats() -> ModuleType:
    """scipy.stats. Raises InputError with the command to install it."""
    return _part("scipy.stats")


def special() -> ModuleType:
    """scipy.special, which imports faster than scipy.stats. Raises InputError with the command to install it."""
    return _part("scipy.special")


def _part(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise InputError(
            "samples, distributions and bands of studies need scipy, which is not installed. Type `python3 -m pip install scipy`, "
            "or `make python-test` in the source directory and set POUNDING_PYTHON to .venv-test/bin/python3"
        ) from error
