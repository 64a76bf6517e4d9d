"""Ground motions of a study: their intensity, and how they are scaled."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from pounding._native import core
from pounding._studies import reading
from pounding._studies.files import Files
from pounding.errors import InputError

#: Maximum scale factor of a record without a warning.
PLAUSIBLE_SCALE = 4.0


@dataclass(frozen=True)
class Motion:
    """A ground motion as listed in the table."""

    name: str
    words: dict[str, Any]  #: `ground_motion` of the row without the wave; empty for the model's own
    event: str  #: motions of one event are not independent samples
    component: str = ""
    points: int = 0
    step: float = 0.0  #: [s]; 0 if it varies
    duration: float = 0.0  #: [s]
    pga: float = float("nan")  #: geometric mean of horizontal components [m/s^2]
    intensity: float = float("nan")  #: by the measure of the study [m/s^2]
    digest: str = ""  #: SHA-256 of the bytes of its files
    warnings: tuple[str, ...] = field(default=(), compare=False)  #: about implausible peaks and steps

    @property
    def parts(self) -> dict[str, dict[str, Any]]:
        """The motion along each axis; without components, along x."""
        return dict(self.words.get("components") or {"x": self.words})

    @property
    def is_record(self) -> bool:
        """True if the motion is read from files."""
        return all("record" in part for part in self.parts.values())

    def scaled(self, scale: float) -> dict[str, Any]:
        """`ground_motion` of the row with all accelerations times `scale`."""
        if "components" in self.words:
            return {"components": {axis: scaled(part, scale) for axis, part in self.parts.items()}}
        return scaled(self.words, scale)


def scaled(part: Mapping[str, Any], scale: float) -> dict[str, Any]:
    """A record or an artificial earthquake with all accelerations times `scale`."""
    if "record" in part:
        return {**part, "scale": repr(float(factor_of(part) * scale))}
    inner = dict(part["synthetic"])
    inner["pga"] = repr(float(reading.quantity(inner["pga"], "ground_motion.synthetic.pga")[0] * scale))
    return {**part, "synthetic": inner}


def factor_of(part: Mapping[str, Any]) -> float:
    """The factor on the values of a file."""
    return reading.quantity(part.get("scale", 1.0), "ground_motion.scale")[0]


def mean_of_horizontal(values: Mapping[str, float]) -> float:
    """Geometric mean of the values along x and y, or the value along z without them."""
    found = [value for axis, value in values.items() if axis != "z"] or list(values.values())
    return found[0] if len(found) == 1 else float(np.prod(found) ** (1 / len(found)))


@dataclass(frozen=True)
class Intensity:
    """Intensity measure: pga, sa (pseudo-acceleration at a period) or avg_sa (geometric mean over a range of
    periods)."""

    measure: str = "pga"
    period: tuple[float, float] = (0.0, 0.0)  #: [s]; both the same for sa
    damping: float = 0.05
    levels: tuple[float, ...] = ()  #: [m/s^2]; empty for unscaled motions

    def of(self, motion: Motion, files: Files) -> float:
        """The intensity of an unscaled motion [m/s^2], the geometric mean of its horizontal components. Raises
        InputError if the motion does not have this measure."""
        if self.measure == "pga":
            return motion.pga
        if not motion.is_record:
            raise InputError(
                f"study.intensity.measure: {self.measure} is defined for records; with artificial earthquakes or the model's own motion "
                "type measure: pga"
            )
        periods = np.geomspace(*self.period, 20) if self.measure == "avg_sa" else np.array(self.period[:1])
        return mean_of_horizontal(
            {
                axis: self._of_record(part, periods, files)
                for axis, part in motion.parts.items()
                if axis != "z" or len(motion.parts) == 1
            }
        )

    def _of_record(self, part: Mapping[str, Any], periods: np.ndarray, files: Files) -> float:
        # The intensity is 0 for a zero record and for periods at which the acceleration underflows.
        with np.errstate(divide="ignore", under="ignore"):
            found = spectrum_of(part, periods, self.damping, files)
            return abs(factor_of(part)) * float(np.exp(np.mean(np.log(found))))


def read_intensity(one: Mapping[str, Any] | None, periods: Sequence[float]) -> Intensity | None:
    """The measure and levels of a study; `periods` are the first periods of the structures [s]. Raises InputError."""
    if one is None:
        return None
    measure = one["measure"]
    for key, of in (("period", "sa"), ("periods", "avg_sa")):
        if key in one and measure != of:
            raise InputError(f"study.intensity.{key}: belongs to measure: {of}, not to {measure}")
    span = (0.0, 0.0)
    if measure == "sa":
        if "period" not in one:
            raise InputError(
                "study.intensity: sa needs its period, as in period: 1 s; for two structures measure: avg_sa serves both"
            )
        span = (one["period"], one["period"])
    elif measure == "avg_sa":
        span = _range(one, periods)
    return Intensity(measure, span, one["damping"], tuple(one.get("levels", ())))


def _range(one: Mapping[str, Any], periods: Sequence[float]) -> tuple[float, float]:
    if "periods" in one:
        shortest, longest = one["periods"]
        if shortest >= longest:
            raise InputError(
                f"study.intensity.periods: takes the shortest and the longest period, as in {reading.EXAMPLES['intensity']['periods']}"
            )
        return shortest, longest
    known = [period for period in periods if np.isfinite(period) and period > 0]
    if not known:
        raise InputError("study.intensity: the structures have no period; type periods: [0.2 s, 2 s]")
    return 0.2 * min(known), 1.5 * max(known)


def spectrum_of(part: Mapping[str, Any], periods: np.ndarray, damping: float, files: Files) -> np.ndarray:
    """[period] pseudo-accelerations of the record of one component, before its factor [m/s^2]."""
    name = str(part["record"])
    _, sd, _ = core.record_spectrum(
        name,
        str(part.get("units", "")),
        str(part.get("channel", "")),
        periods.tolist(),
        damping,
        step_of(part),
        files.content(name),
    )
    return np.asarray((2 * np.pi / periods) ** 2 * np.asarray(sd))


def step_of(part: Mapping[str, Any]) -> float:
    """Time step of a file without times [s]; 0 if it is not given."""
    return reading.quantity(part["step"], "study.records.step")[0] if "step" in part else 0.0


def read_file(name: str, options: Mapping[str, str], files: Files, event: str = "", component: str = "") -> Motion:
    """The motion in a file. Raises InputError if the file is not a record."""
    content = files.content(name)
    points, step, duration, pga, warnings = core.record_measures(
        name, options.get("units", ""), options.get("channel", ""), step_of(options), content
    )
    return Motion(
        Path(name).name,
        {"record": name, **options},
        event or Path(name).stem,
        component,
        points,
        step,
        duration,
        pga,
        digest=hashlib.sha256(content).hexdigest(),
        warnings=tuple(f"record {Path(name).name}: {text}" for text in warnings),
    )


def joined(parts: Mapping[str, Motion]) -> Motion:
    """One motion of several components."""
    every = list(parts.values())
    steps = {motion.step for motion in every}
    return Motion(
        " + ".join(motion.name for motion in every),
        {"components": {axis: motion.words for axis, motion in parts.items()}},
        every[0].event,
        " + ".join(motion.component or axis for axis, motion in parts.items()),
        every[0].points,
        steps.pop() if len(steps) == 1 else 0.0,
        max(motion.duration for motion in every),
        mean_of_horizontal({axis: motion.pga for axis, motion in parts.items()}),
        digest=hashlib.sha256("".join(motion.digest for motion in every).encode()).hexdigest(),
        warnings=tuple(text for motion in every for text in motion.warnings),
    )


def measured(motions: Sequence[Motion], intensity: Intensity | None, files: Files) -> list[Motion]:
    """The motions with their intensities. Raises InputError if levels require motions that cannot be scaled."""
    if intensity is None:
        return list(motions)
    for motion in motions:
        if np.isnan(motion.pga):
            raise InputError(
                "study.intensity: the motion of the model cannot be scaled; name records, as in records: {files: records/*.AT2}, or give the "
                "model an artificial earthquake (synthetic)"
            )
    return [replace(motion, intensity=intensity.of(motion, files)) for motion in motions]


def implausible(motions: Sequence[Motion], accept: Sequence[str]) -> list[str]:
    """Warnings of implausible records, at most five, unless the model accepts them."""
    found = [text for motion in motions for text in motion.warnings] if "record" not in accept else []
    more = [f"{len(found) - 5} more warnings of records"] if len(found) > 5 else []
    return [f"{text} (if intended: accept: [record])" for text in [*found[:5], *more]]


def repeated(motions: Sequence[Motion]) -> list[str]:
    """A warning for records that are named twice and are therefore not independent."""
    counts = Counter(f"{motion.name}: {motion.words}" for motion in motions if motion.is_record)
    again = [text.partition(": ")[0] for text, count in counts.items() if count > 1]
    return (
        [
            f"study.records: {reading.shortened(again)}: named more than once, and counted as independent samples; name each record once"
        ]
        if again
        else []
    )


def scaling_warnings(motions: Sequence[Motion], intensity: Intensity | None) -> list[str]:
    """Warnings for records that are scaled by the model or by the intensity."""
    if intensity is None or not intensity.levels:
        scales = [abs(factor_of(part)) for motion in motions for part in motion.parts.values() if "scale" in part]
        return (
            [
                f"scale or pga of the model's ground_motion applies to the records of the study, which are scaled by {min(scales):.3g} to {max(scales):.3g}; remove it to "
                "use them as recorded, or type levels of an intensity"
            ]
            if scales
            else []
        )
    scales = [
        max(intensity.levels) / motion.intensity * max(abs(factor_of(part)) for part in motion.parts.values())
        for motion in motions
        if motion.digest
    ]
    if not scales or max(scales) <= PLAUSIBLE_SCALE:
        return []
    far = sum(scale > PLAUSIBLE_SCALE for scale in scales)
    return [
        f"{far} of {len(motions)} records are scaled by more than {PLAUSIBLE_SCALE:g} at the highest level, at most by {max(scales):.3g}; strong "
        "recorded motions have other spectral shapes, so curves from scaled ones are biased"
    ]
