"""Checks of a plan whose sections do not fit together."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from pounding._studies.factors import Factor, find
from pounding._studies.motions import Intensity, Motion
from pounding._studies.quantities import COLLAPSED_COLUMN, UNITS
from pounding.errors import InputError


def require_one_ground(parts: Mapping[str, Any]) -> None:
    """Raises InputError if a structure or support has its own motion, which records and levels do not change."""

    def find(part: Any, place: str) -> None:
        for key, value in part.items() if isinstance(part, Mapping) else ():
            if key == "ground_motion":
                raise InputError(
                    f"{place}.ground_motion: is the same in every row, regardless of records and levels; remove it, or the records and "
                    "the intensity of the study"
                )
            find(value, f"{place}.{key}")

    for name, structure in (parts.get("structures") or {}).items():
        find(structure, f"structures.{name}")


def require_kept(factors: Mapping[str, Mapping[str, Any]]) -> None:
    """Raises InputError for a factor of the ground motion of the model if records replace it."""
    for name, one in factors.items():
        paths = one.get("of", [])
        for path in [paths] if isinstance(paths, str) else paths:
            first, _, rest = path.partition(".")
            if first == "ground_motion" and rest.partition(".")[0] != "wave":
                raise InputError(
                    f"study.factors.{name}.of: the records replace the ground motion of the model; vary intensity instead of {path}"
                )


def require_own_strength(factors: Sequence[Factor], parts: Mapping[str, Any], intensity: Intensity | None) -> None:
    """Raises InputError for a factor that sets the strength of the ground motion if the study has an intensity."""
    strength = ("ground_motion", "synthetic", "pga")
    for factor in factors if intensity else ():
        if any(keys == strength for path in factor.of for keys in find(parts, path, "")):
            raise InputError(
                f"study.factors.{factor.name}.of: intensity sets or measures ground_motion.synthetic.pga; type its values as levels, or leave "
                "intensity out"
            )


def require_free_names(factors: list[Factor]) -> None:
    """Raises InputError if the name of a factor is that of another column of the table."""
    taken = (*UNITS, COLLAPSED_COLUMN, "point", "record", "scale", "im", "status", "engine")
    for factor in factors:
        if factor.name in taken:
            raise InputError(
                f"study.factors.{factor.name}: the table already has a column of this name; rename the factor, for example to {factor.name}_factor"
            )


def require_scales(motions: Sequence[Motion], intensity: Intensity | None) -> None:
    """Raises InputError if no finite factor scales a motion to a level."""
    levels = intensity.levels if intensity else ()
    for motion in motions if levels else ():
        if (
            not motion.intensity > 0
            or not math.isfinite(max(levels) / motion.intensity)
            or min(levels) / motion.intensity == 0
        ):
            raise InputError(
                f"study.intensity: {motion.name} has the intensity {motion.intensity:g} m/s^2, which cannot be scaled to "
                f"{min(levels):g} to {max(levels):g} m/s^2; type other levels, another measure or period, or leave the motion out"
            )
