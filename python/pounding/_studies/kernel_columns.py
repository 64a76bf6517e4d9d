"""Results of the kernel, and the columns of a table computed from them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from pounding._studies.quantities import OF_GAPS, OF_LINKS, OF_STRUCTURES, SUMS
from pounding._studies.structure_values import split, without_suffix
from pounding.errors import InputError

#: Error of a step of the kernel as a fraction of the tolerance of the model, since errors of impacts accumulate.
PART_OF_TOLERANCE, LARGEST, SMALLEST = 0.2, 2e-5, 1e-12
#: Quantities of links by their names in the columns of the kernel.
OF_KERNEL = {
    "force": "peak_force",
    "penetration": "peak_penetration",
    **{word: word for word in OF_LINKS if word not in ("force", "penetration")},
}


@dataclass
class Found:
    """Results of rows from the kernel."""

    reasons: dict[int, str]  #: row -> reason of missing numbers
    links: list[str]
    structures: dict[str, dict[str, np.ndarray]]  #: name -> displacement, drift, acceleration: [row, floor]
    contacts: dict[str, np.ndarray]  #: quantity -> [row, link]
    alone: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)  #: as structures, of the run without links
    gaps: dict[str, np.ndarray] = field(default_factory=dict)  #: quantity -> [row, link]


def column_of(column: str, found: Found) -> np.ndarray:
    """[row] a column of the table, equal to that of Kept.of from a summary. Raises InputError for an unknown link."""
    quantity, _, rest = column.partition(".")
    if quantity in OF_STRUCTURES:
        if column.endswith(".ratio"):
            alone = _of_structure(found.alone, quantity, without_suffix(rest))
            with np.errstate(invalid="ignore", divide="ignore"):
                return np.where(
                    alone != 0, _of_structure(found.structures, quantity, without_suffix(rest)) / alone, np.nan
                )
        structures = found.alone if rest.endswith(".alone") else found.structures
        return _of_structure(structures, quantity, without_suffix(rest))
    if quantity in OF_GAPS and not found.links:
        return np.zeros(_rows(found))
    if rest and rest not in found.links:
        raise InputError(f'study.keep: unknown link "{rest}"; known: {", ".join(found.links)}')
    values = (found.gaps if quantity in OF_GAPS else found.contacts)[quantity]
    if rest:
        values = values[:, [i for i, name in enumerate(found.links) if name == rest]]
    if quantity in OF_GAPS:
        return np.maximum(0, values.max(axis=1, initial=0))
    if values.shape[1] == 1:
        return values[:, 0]
    if quantity in SUMS:
        return np.array([math.fsum(row) for row in values])
    return values.max(axis=1, initial=0)


def _of_structure(structures: dict[str, dict[str, np.ndarray]], quantity: str, rest: str) -> np.ndarray:
    name, floor = split(rest, structures)
    values = structures[name][quantity]
    return values[:, int(floor) - 1] if floor else _most(values)


def _most(values: np.ndarray) -> np.ndarray:
    return values.max(axis=1) if values.shape[1] else np.full(len(values), np.nan)


def _rows(found: Found) -> int:
    return len(next(iter(found.contacts.values())))


def separations(
    closing: np.ndarray, left: np.ndarray, right: np.ndarray, correlation: np.ndarray
) -> dict[str, np.ndarray]:
    """Gaps from the run without links, and by rules from the peaks of both ends."""
    squares = left * left + right * right
    return {
        "required_gap": closing,
        "end_left": left,
        "end_right": right,
        "gap_abs": left + right,
        "gap_srss": np.sqrt(squares),
        "gap_ddc": np.sqrt(np.maximum(0, squares - 2 * correlation * left * right)),
    }


def step_error(tolerance: float) -> float:
    """Tolerance of the kernel for the tolerance of a model."""
    return min(LARGEST, max(SMALLEST, PART_OF_TOLERANCE * tolerance))
