"""Target spectra of suites: those of codes, tables and files."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pounding._studies import reading
from pounding.errors import InputError

#: EN 1998-1:2004, tables 3.2 and 3.3: type -> ground type -> S, TB, TC, TD [s].
EN_1998_1 = {
    1: {
        "A": (1.0, 0.15, 0.4, 2.0),
        "B": (1.2, 0.15, 0.5, 2.0),
        "C": (1.15, 0.20, 0.6, 2.0),
        "D": (1.35, 0.20, 0.8, 2.0),
        "E": (1.4, 0.15, 0.5, 2.0),
    },
    2: {
        "A": (1.0, 0.05, 0.25, 1.2),
        "B": (1.35, 0.05, 0.25, 1.2),
        "C": (1.5, 0.10, 0.25, 1.2),
        "D": (1.8, 0.10, 0.30, 1.2),
        "E": (1.6, 0.05, 0.25, 1.2),
    },
}
#: The spectrum of EN 1998-1 ends at this period [s]; annex A continues it.
EN_END = 4.0
_PLACE = "records.scale_to.spectrum"


@dataclass(frozen=True)
class Target:
    """A target spectrum and the rules that belong to it."""

    name: str
    sa: Callable[[np.ndarray], np.ndarray]  #: spectral accelerations at periods [s], [m/s^2]
    method: str  #: default of `method`
    components: str  #: default of `components`
    minimum: int = 1  #: minimum number of records
    note: str = ""  #: rule and edition
    zero_period: float = 0.0  #: minimum of the mean peak acceleration of the suite [m/s^2]
    srss_factor: float = 1.0  #: factor of the target for SRSS spectra of two components


def read_target(one: Mapping[str, Any], damping: float, folder: Path) -> Target:
    """The target of `scale_to.spectrum`, with values in SI. Raises InputError."""
    if "periods" in one and "sa" not in one:
        raise InputError(
            f"{_PLACE}.periods: belongs to sa, as in periods: [0 s, 0.5 s, 2 s], sa: [0.3 g, 0.8 g, 0.2 g]"
        )
    if "en1998_1" in one:
        return _en1998(one["en1998_1"], damping)
    if "asce_7" in one:
        return _asce(one["asce_7"], damping)
    if "file" in one:
        return _file(folder / one["file"])
    if "periods" not in one:
        raise InputError(f"{_PLACE}.sa: needs periods of the same number, as in periods: [0 s, 0.5 s, 2 s]")
    return _table("table", np.array(one["periods"]), np.array(one["sa"]), _PLACE)


def en1998(periods: np.ndarray, ag: float, soil: str, kind: int, damping: float) -> np.ndarray:
    """Horizontal elastic response spectrum Se(T) of EN 1998-1:2004, 3.2.2.2, up to 4 s."""
    s, tb, tc, td = EN_1998_1[kind][soil]
    eta = max(math.sqrt(10 / (5 + 100 * damping)), 0.55)
    t = np.maximum(periods, 1e-12)
    plateau = ag * s * eta * 2.5
    return np.select(
        [periods < tb, periods <= tc, periods <= td],
        [ag * s * (1 + periods / tb * (2.5 * eta - 1)), plateau, plateau * tc / t],
        plateau * tc * td / t**2,
    )


def asce7(periods: np.ndarray, sds: float, sd1: float, tl: float) -> np.ndarray:
    """Design response spectrum of ASCE 7, 11.4.6."""
    t0, ts = 0.2 * sd1 / sds, sd1 / sds
    t = np.maximum(periods, 1e-12)
    return np.select(
        [periods < t0, periods <= ts, periods <= tl], [sds * (0.4 + 0.6 * periods / t0), sds, sd1 / t], sd1 * tl / t**2
    )


def _en1998(one: Mapping[str, Any], damping: float) -> Target:
    ag, soil, kind = one["ag"], one["soil"], one["type"]

    def sa(periods: np.ndarray) -> np.ndarray:
        if periods.max() > EN_END * (1 + 1e-9):
            raise InputError(
                f"records.scale_to: the spectrum of EN 1998-1, 3.2.2.2, ends at {EN_END:g} s, and the range of periods reaches "
                f"{periods.max():.3g} s; type to: {EN_END:g} s, or a table with the spectrum of annex A"
            )
        return en1998(periods, ag, soil, kind, damping)

    return Target(
        f"EN 1998-1 type {kind}, ground {soil}, ag {ag / 9.80665:.3g} g",
        sa,
        "suite",
        "srss",
        3,
        "EN 1998-1:2004, 3.2.3.1.2(4): at least 3 records, mean of the peak accelerations at least ag S, and mean spectrum at "
        "least 90 % between 0.2 T1 and 2 T1. For two components: SRSS at least 1.3 times that, after EN 1998-2, 3.2.3. "
        "Check the edition.",
        ag * EN_1998_1[kind][soil][0],
        1.3,
    )


def _asce(one: Mapping[str, Any], damping: float) -> Target:
    if abs(damping - 0.05) > 1e-9:
        raise InputError(
            f"records.scale_to.damping: the spectrum of ASCE 7 has 5 % of damping; {100 * damping:g} % was read; remove damping"
        )
    sds, sd1, tl = one["SDS"], one["SD1"], one["TL"]
    if sd1 / sds > tl:
        raise InputError(f"{_PLACE}.asce_7.TL: takes a period above SD1/SDS = {sd1 / sds:.3g} s; {tl:g} s was read")
    return Target(
        f"ASCE 7, SDS {sds / 9.80665:.3g} g, SD1 {sd1 / 9.80665:.3g} g, TL {tl:g} s",
        lambda periods: asce7(periods, sds, sd1, tl),
        "suite",
        "rotd100",
        11,
        "ASCE 7-16, 16.2: at least 11 records, mean of the maximum-direction spectra (RotD100) at least 90 % of the target over "
        "the range of periods. Check the edition.",
    )


def _file(path: Path) -> Target:
    """A CSV file whose first line has names and units: period (s),sa (g)."""
    place = f"{_PLACE}.file: {path}"
    try:
        with open(path, newline="", encoding="utf-8") as file:
            lines = [line for line in csv.reader(file) if line]
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not a text"
        raise InputError(f"{place}: {reason}; name a CSV file with the lines period (s),sa (g) and numbers") from None
    if len(lines) < 3 or len(lines[0]) != 2:
        raise InputError(
            f"{place}: takes two columns, a line of names with units, period (s),sa (g), and at least two lines of numbers"
        )
    units = [name.rpartition("(")[2].rstrip(") ") if "(" in name else "" for name in lines[0]]
    factors = []
    for unit, expected, example in zip(units, ("s", "m/s^2"), ("period (s)", "sa (g)")):
        if not unit:
            raise InputError(f'{place}: a column has no unit; write it in the first line, as in "{example}"')
        factor, found = reading.quantity(f"1 {unit}", place)
        reading.require_unit(found, expected, place, f"1 {expected}")
        factors.append(factor)
    try:
        values = np.array([[float(cell) for cell in line] for line in lines[1:]])
        values = values.reshape(len(lines) - 1, 2) * factors
    except ValueError as error:
        raise InputError(f"{place}: {error}; type two numbers in each line") from None
    return _table(path.name, values[:, 0], values[:, 1], place)


def _table(name: str, periods: np.ndarray, sa: np.ndarray, place: str) -> Target:
    if len(periods) != len(sa):
        raise InputError(
            f"{place}: {len(periods)} periods and {len(sa)} values of sa were read; type one value per period"
        )
    if not (np.isfinite(periods).all() and np.isfinite(sa).all() and (np.diff(periods) > 0).all()):
        raise InputError(f"{place}: takes finite numbers with increasing periods")
    if not (sa > 0).all():
        raise InputError(f"{place}: takes positive spectral accelerations; {sa.min():g} m/s^2 was read")

    def at(wanted: np.ndarray) -> np.ndarray:
        if wanted.min() < periods[0] * (1 - 1e-9) or wanted.max() > periods[-1] * (1 + 1e-9):
            raise InputError(
                f"records.scale_to: the table of the spectrum is from {periods[0]:g} s to {periods[-1]:g} s, and the range of periods is "
                f"from {wanted.min():.3g} s to {wanted.max():.3g} s; extend the table, or type from and to"
            )
        return np.asarray(np.interp(wanted, periods, sa))

    return Target(name, at, "least_squares", "geometric_mean")
