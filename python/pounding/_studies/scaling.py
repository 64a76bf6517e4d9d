"""Scaling of the records of a suite to a target spectrum."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies.files import Files
from pounding._studies.motions import PLAUSIBLE_SCALE, Motion, factor_of, mean_of_horizontal, spectrum_of
from pounding._studies.target_spectra import Target, read_target
from pounding.errors import InputError

#: Number of periods of the range, evenly spaced on a logarithmic scale.
COUNT = 50


@dataclass(frozen=True)
class Scaling:
    """Factors of records and their fit to a target over a range of periods."""

    target: str
    note: str
    method: str
    components: str  #: combination of two horizontal components; empty for one
    periods: tuple[float, ...]  #: [s]
    sa: tuple[float, ...]  #: [period] target, with the factor for SRSS [m/s^2]
    spectra: tuple[tuple[float, ...], ...]  #: [record, period] of the unscaled records [m/s^2]
    factors: tuple[float, ...]  #: [record]
    fraction: float  #: required fraction of the target; 0 for none
    warnings: tuple[str, ...] = ()

    @property
    def mean(self) -> np.ndarray:
        """[period] mean spectrum of the scaled records [m/s^2]."""
        return np.asarray((np.array(self.factors)[:, None] * np.array(self.spectra)).mean(axis=0))

    @property
    def fit(self) -> np.ndarray:
        """[period] mean spectrum divided by the target."""
        return np.asarray(self.mean / np.array(self.sa))

    def scaled(self, motions: Sequence[Motion]) -> list[Motion]:
        """The motions with their factors."""
        return [
            replace(motion, words=motion.scaled(factor), pga=abs(factor) * motion.pga)
            for motion, factor in zip(motions, self.factors)
        ]

    def description(self) -> dict[str, Any]:
        """For the table."""
        names = ("target", "note", "method", "components", "periods", "sa", "factors", "fraction", "warnings")
        return {**{name: getattr(self, name) for name in names}, "spectra": self.spectra}

    @classmethod
    def of(cls, found: Mapping[str, Any]) -> Scaling:
        """The scaling of a table."""
        return cls(**{name: _tuples(value) for name, value in found.items()})


def _tuples(value: Any) -> Any:
    return tuple(map(_tuples, value)) if isinstance(value, list) else value


def scale(
    one: Mapping[str, Any], motions: Sequence[Motion], periods: Sequence[float], folder: Path, files: Files
) -> Scaling:
    """The scaling specified by `scale_to`; `periods` are the first periods of the structures [s]. Raises
    InputError."""
    for motion in motions:
        if not motion.is_record:
            raise InputError(
                "records.scale_to: scales records, and the spectrum of artificial earthquakes is given by their soil; name files, or remove scale_to"
            )
    damping = one["damping"]
    target = read_target(one["spectrum"], damping, folder)
    horizontal = [[axis for axis in motion.parts if axis != "z"] for motion in motions]
    if not all(horizontal):
        raise InputError(
            "records.scale_to: scales horizontal components, and the records are along z only; remove scale_to"
        )
    is_pair = len(horizontal[0]) == 2
    grid = np.geomspace(*_range(one, periods), COUNT)
    components = one.get("components", target.components) if is_pair else ""
    if "components" in one and not is_pair:
        raise InputError(
            "records.scale_to.components: combines two horizontal components, and each record has one; remove it"
        )
    factor = target.srss_factor if components == "srss" else 1.0
    sa = factor * target.sa(grid)
    spectra = np.array([_spectrum(motion, components, grid, damping, files) for motion in motions])
    if not (spectra > 0).all():
        wrong = motions[int(np.flatnonzero(~(spectra > 0).all(axis=1))[0])]
        raise InputError(
            f"records.scale_to: the spectrum of {wrong.name} is zero in the range of periods; leave the record out"
        )
    method = one.get("method", target.method)
    fraction = one.get("fraction", 0.9 if method == "suite" else 0.0)
    own = _own_factors(method, spectra, sa)
    if fraction:
        common = float(np.max(fraction * sa / (own[:, None] * spectra).mean(axis=0)))
        if target.zero_period and method == "suite":
            common = max(common, target.zero_period / float(np.mean([own[i] * m.pga for i, m in enumerate(motions)])))
        own = own * (common if method == "suite" else max(1.0, common))
    return Scaling(
        target.name,
        target.note,
        method,
        components,
        tuple(grid.tolist()),
        tuple(sa.tolist()),
        tuple(map(tuple, spectra.tolist())),
        tuple(own.tolist()),
        fraction,
        tuple(_warnings(motions, own, target)),
    )


def _own_factors(method: str, spectra: np.ndarray, sa: np.ndarray) -> np.ndarray:
    if method == "least_squares":
        return np.asarray((spectra * sa).sum(axis=1) / (spectra**2).sum(axis=1))
    if method == "mean":
        return np.asarray(sa.mean() / spectra.mean(axis=1))
    return np.ones(len(spectra))


def _warnings(motions: Sequence[Motion], factors: np.ndarray, target: Target) -> list[str]:
    found = []
    if len(motions) < target.minimum:
        found.append(f"records: {len(motions)} records, and the code takes at least {target.minimum}. {target.note}")
    far = [
        motion.name for motion, factor in zip(motions, factors) if not 1 / PLAUSIBLE_SCALE <= factor <= PLAUSIBLE_SCALE
    ]
    if far:
        found.append(
            f"records.scale_to: {len(far)} of {len(motions)} records have factors outside 1/{PLAUSIBLE_SCALE:g} to {PLAUSIBLE_SCALE:g}, such as "
            f"{far[0]}; strong scaling changes the character of a record, so take records closer to the target"
        )
    return found


def _range(one: Mapping[str, Any], periods: Sequence[float]) -> tuple[float, float]:
    known = [period for period in periods if np.isfinite(period) and period > 0]
    if not known and not ("from" in one and "to" in one):
        raise InputError("records.scale_to: the structures have no period; type from: 0.2 s, to: 2 s")
    begin = one["from"] if "from" in one else 0.2 * min(known)
    end = one["to"] if "to" in one else 2 * max(known)
    if not begin < end:
        raise InputError(f"records.scale_to: from is {begin:g} s and to is {end:g} s; type a shorter period first")
    return begin, end


def _spectrum(motion: Motion, components: str, periods: np.ndarray, damping: float, files: Files) -> np.ndarray:
    """[period] pseudo-accelerations of an unscaled motion [m/s^2]."""
    parts = {axis: part for axis, part in motion.parts.items() if axis != "z"}
    if components == "rotd100":
        return rotd100([_samples(part, files) for part in parts.values()], periods, damping)
    found = np.array([_of_record(part, periods, damping, files) for part in parts.values()])
    if components == "srss":
        return np.asarray(np.sqrt((found**2).sum(axis=0)))
    return np.asarray([mean_of_horizontal(dict(zip(parts, column))) for column in found.T])


def _of_record(part: Mapping[str, Any], periods: np.ndarray, damping: float, files: Files) -> np.ndarray:
    return abs(factor_of(part)) * spectrum_of(part, periods, damping, files)


def _samples(part: Mapping[str, Any], files: Files) -> tuple[float, np.ndarray]:
    """Step [s] and accelerations [m/s^2]. Raises InputError for an uneven step."""
    name = str(part["record"])
    motion = core.RowMotion(yaml_text.emit({"ground_motion": dict(part)}), "row", {name: files.content(name)})
    if motion.step == 0:
        raise InputError(
            f"records.scale_to.components: rotd100 takes records with an even step from time 0 on, and {Path(name).name} is not one; type srss or "
            "geometric_mean"
        )
    return motion.step, np.asarray(motion.accelerations)


def rotd100(samples: Sequence[tuple[float, np.ndarray]], periods: np.ndarray, damping: float) -> np.ndarray:
    """[period] maximum over all horizontal directions of the pseudo-acceleration of two components [m/s^2]. Components
    with different steps are interpolated to the smaller one."""
    step = min(one for one, _ in samples)
    end = min(one * (len(values) - 1) for one, values in samples)
    times = np.arange(int(round(end / step)) + 1) * step
    ground = np.array([np.interp(times, np.arange(len(values)) * one, values) for one, values in samples])
    # At rest after the end, so that the free vibration of long periods is included.
    ground = np.concatenate([ground, np.zeros((2, int(np.ceil(periods.max() / step))))], axis=1)
    found = []
    for period in periods:
        # At least 60 steps per period resolve its extremes; accelerations are linear in each step.
        fine = int(np.ceil(60 * step / period))
        begin, inside = np.arange(ground.shape[1]), np.arange(fine * (ground.shape[1] - 1) + 1) / fine
        resolved = np.array([np.interp(inside, begin, values) for values in ground])
        # The largest projection over all directions is the length of the displacement.
        moved = oscillator(resolved, step / fine, float(period), damping)
        found.append((2 * np.pi / period) ** 2 * float(np.hypot(*moved).max()))
    return np.array(found)


def oscillator(ground: np.ndarray, step: float, period: float, damping: float) -> np.ndarray:
    """[component, time] relative displacements of an oscillator, exact for accelerations that are linear in each step
    (Nigam and Jennings, 1969)."""
    from scipy.linalg import expm
    from scipy.signal import lfilter

    omega = 2 * np.pi / period
    # State u, v, and the acceleration with its slope: one matrix exponential gives the exact step.
    whole = np.zeros((4, 4))
    whole[0, 1] = whole[2, 3] = 1
    whole[1] = (-(omega**2), -2 * damping * omega, -1, 0)
    exact = expm(whole * step)
    a = exact[:2, :2]
    by_end = exact[:2, 3] / step
    by_begin = exact[:2, 2] - by_end
    # u as a filter of the ground acceleration, by elimination of v.
    trace, determinant = float(np.trace(a)), float(np.linalg.det(a))
    numerator = [
        by_end[0],
        by_begin[0] + a[0, 1] * by_end[1] - a[1, 1] * by_end[0],
        a[0, 1] * by_begin[1] - a[1, 1] * by_begin[0],
    ]
    moved = lfilter(numerator, [1.0, -trace, determinant], ground, axis=1)
    # The filter starts one step before the first sample, in which the acceleration would rise from zero.
    impulse = np.zeros(ground.shape[1])
    impulse[0] = 1
    first = lfilter([by_end[0], a[0, 1] * by_end[1] - a[1, 1] * by_end[0]], [1.0, -trace, determinant], impulse)
    return np.asarray(moved - ground[:, :1] * first)
