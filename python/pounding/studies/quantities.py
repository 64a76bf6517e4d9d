"""Quantities that a row keeps: names and units are those of the summary of a run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.studies import words

#: Quantities of every structure: the largest absolute value over its floors.
OF_STRUCTURES = {"displacement": "m", "drift": "m", "acceleration": "m/s^2"}
#: Of structures with rigid floors in space: their rotation about z, and the displacement of the corners of their plan.
OF_TORSION = {"rotation": "rad", "edge_displacement": "m"}
#: Quantities of all links together, or of one by its name: force.left-right.
OF_LINKS = {"force": "N", "penetration": "m", "impacts": "", "impulse": "N s", "energy_lost": "J"}
#: From the run without links: the gap that is just enough, and by rules; the largest of all links.
OF_GAPS = {"required_gap": "m", "gap_abs": "m", "gap_srss": "m", "gap_ddc": "m"}
UNITS = {**OF_STRUCTURES, **OF_TORSION, **OF_LINKS, **OF_GAPS}
_EXAMPLES = {"rad": "0.005", "m": "30 mm", "m/s^2": "0.5 g", "N": "5 MN", "N s": "200 kN s", "J": "50 kJ", "": "3"}
_KEYS = {"force": "peak_force", "penetration": "peak_penetration", "required_gap": "enough", "gap_abs": "abs", "gap_srss": "srss",
         "gap_ddc": "ddc"}
SUMS = ("impacts", "impulse", "energy_lost")
DEFAULT = ("displacement", "force", "impacts")


@dataclass(frozen=True)
class Kept:
    """The columns that a row fills, and the limits beyond which it counts as exceeded."""

    columns: tuple[str, ...]  #: "displacement.left", "displacement.left.alone", "force", "required_gap"
    limits: tuple[tuple[str, float], ...] = ()

    @property
    def needs_comparison(self) -> bool:
        """Whether the run without links is needed, too."""
        return any(column.split(".")[0] in OF_GAPS or column.endswith((".alone", ".ratio")) for column in self.columns)

    def units(self) -> dict[str, str]:
        """SI units of the columns."""
        return {column: "" if column.endswith(".ratio") else UNITS[column.split(".")[0]] for column in self.columns}

    def of(self, summary: Mapping[str, Any]) -> list[float]:
        """The columns from the summary of a run. A rigid impact has no finite force: NaN."""
        return [_value(column, summary) for column in self.columns]

    def exceeded(self, values: np.ndarray) -> np.ndarray:
        """[row] whether a limit is passed, of [row, column]; a limit of drift holds for every structure."""
        found = np.zeros(len(values), bool)
        for quantity, limit in self.limits:
            for i, column in enumerate(self.columns):
                if column == quantity or column.startswith(quantity + ".") and not column.endswith((".alone", ".ratio")):
                    found |= values[:, i] > limit
        return found


def read_keep(given: Any, without_links: bool, model: Mapping[str, Any], limits: tuple[tuple[str, float], ...]) -> Kept:
    """The columns that `keep:` asks for. Raises InputError."""
    asked = list(DEFAULT) if given is None else [given] if isinstance(given, str) else [str(one) for one in given]
    asked += [quantity for quantity, _ in limits if quantity not in asked]
    structures = [name for name, one in (model.get("structures") or {}).items() if not (isinstance(one, Mapping) and "wall" in one)]
    columns: list[str] = []
    for word in asked:
        quantity, _, name = word.partition(".")
        if quantity not in UNITS:
            raise InputError(f'study.keep: there is no quantity "{word}".{words.meant(quantity, UNITS)} Allowed: {", ".join(UNITS)}')
        if quantity in OF_STRUCTURES or quantity in OF_TORSION:
            if name and name not in structures:
                raise InputError(f'study.keep: {word}: there is no structure "{name}" that moves; there is {", ".join(structures)}')
            found = [name] if name else structures
            if quantity in OF_TORSION:
                found = [each for each in found if _may_turn(model["structures"][each])]
                if not found:
                    raise InputError(f"study.keep: {word}: only frames in space with rigid floors have a {quantity}; leave it out, or keep displacement")
            for each in found:
                columns += [f"{quantity}.{each}"]
                columns += [f"{quantity}.{each}.alone", f"{quantity}.{each}.ratio"] if without_links else []
        elif name and quantity in OF_GAPS:
            raise InputError(f"study.keep: {word}: {quantity} is the largest of all links; leave {name} out")
        else:
            columns.append(word)
    return Kept(tuple(dict.fromkeys(columns)), limits)


def read_limits(given: Any) -> tuple[tuple[str, float], ...]:
    """Limits, as in {drift: 30 mm, force: 2 MN}. Raises InputError."""
    if given is None:
        return ()
    if not isinstance(given, Mapping):
        raise InputError("study.limits: takes a map such as {drift: 30 mm}")
    found = []
    for word, value in given.items():
        quantity = str(word).partition(".")[0]
        if quantity not in UNITS:
            raise InputError(f'study.limits: there is no quantity "{word}".{words.meant(quantity, UNITS)} Allowed: {", ".join(UNITS)}')
        number, unit = words.quantity(value, f"study.limits.{word}")
        if isinstance(value, str) and not unit and "%" in value:
            raise InputError(f"study.limits.{word}: the {quantity} of a summary is in {UNITS[quantity] or 'numbers'}; type a value such as {_EXAMPLES[UNITS[quantity]]} instead of {value}")
        words.same_unit(unit, UNITS[quantity], f"study.limits.{word}", _EXAMPLES[UNITS[quantity]])
        found.append((str(word), number))
    return tuple(found)


def _may_turn(structure: Any) -> bool:
    """False for a structure that surely has no rigid floors in space: no frame, or a grid of bays along x alone or without rigid floors."""
    frame = structure.get("frame") if isinstance(structure, Mapping) else None
    if not isinstance(frame, Mapping) or frame.get("dimension") in (2, "2"):
        return False
    grid = frame.get("grid")
    if isinstance(grid, Mapping) and not frame.get("floors"):
        return isinstance(grid.get("bays"), list) and str(grid.get("rigid_floors", True)).lower() != "false"
    return True


def _value(column: str, summary: Mapping[str, Any]) -> float:
    quantity, _, rest = column.partition(".")
    if quantity in OF_STRUCTURES or quantity in OF_TORSION:
        return _of_structure(quantity, rest, summary)
    if quantity in OF_GAPS:
        found = [_number(one[_KEYS[quantity]]) for one in summary["no_pounding"]["separations"]]
        return max(found, default=0.0)
    links = [one for one in summary["links"] if not rest or one["name"] == rest]
    if rest and not links:
        raise InputError(f'study.keep: there is no link "{rest}"; there is {", ".join(one["name"] for one in summary["links"])}')
    values = [_number(one[_KEYS.get(quantity, quantity)]) for one in links]
    # A sum in the order of the links, by a function whose result depends on no order.
    if quantity in SUMS:
        return math.fsum(values)
    known = [value for value in values if not math.isnan(value)]
    return max(known) if known else math.nan if values else 0.0


def _of_structure(quantity: str, rest: str, summary: Mapping[str, Any]) -> float:
    if rest.endswith(".ratio"):
        alone = _of_structure(quantity, rest.removesuffix(".ratio") + ".alone", summary)
        return _of_structure(quantity, rest.removesuffix(".ratio"), summary) / alone if alone else math.nan
    is_alone = rest.endswith(".alone")
    structures = summary["no_pounding"]["structures"] if is_alone else summary["structures"]
    name = rest.removesuffix(".alone")
    values = structures[name].get("peak_" + quantity, ())
    if quantity in OF_TORSION:
        values = [value for value in map(_number, values) if not math.isnan(value)]
        if not values:
            raise InputError(f"study.keep: {quantity}.{name}: {name} has no rigid floors in space; leave it out, or keep displacement.{name}")
    return max(map(_number, values), default=math.nan)


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)
