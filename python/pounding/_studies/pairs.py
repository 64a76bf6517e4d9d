"""Columns of rows of the kernel, and its fastest path: two oscillators and one link as columns."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pounding._native import core
from pounding._studies import reading
from pounding._studies.factors import at, put
from pounding._studies.quantities import OF_GAPS, OF_LINKS, OF_STRUCTURES, SUMS
from pounding._studies.structure_values import split, without_suffix
from pounding._studies.template import Prepared
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


OSCILLATOR = ("mass", "period", "damping")
LINK = ("between", "gap", "law", "name", "formula")
#: A gap too large to close [m].
FAR = 1e9


Keys = tuple[str | int, ...]


class Pairs:
    """Columns of pairs with one set of labels: constants of the model, and the indices of varied values."""

    def __init__(
        self,
        names: Sequence[str],
        link: Mapping[str, Any],
        pairs: Mapping[str, Keys],
        parameters: Mapping[str, Keys],
        constants: Mapping[Keys, float],
        places: Mapping[Keys, int],
        duration: float,
        tolerance: float,
    ) -> None:
        self.names = names  #: of the structures, the left one first
        self.law, self.formula = str(link["law"]), str(link.get("formula", ""))
        self.link = str(link.get("name", "-".join(names)))
        self._pairs, self._parameters, self._constants, self._places = pairs, parameters, constants, places
        self._duration, self._tolerance = duration, step_error(tolerance)

    @classmethod
    def of(cls, prepared: Prepared, texts: Sequence[str], row: core.LinearRow) -> Pairs | None:
        """The pairs of a template with these texts for its varied values; None if the model is not such a pair.

        `row` is a model with these texts. The answer holds for all rows: no value of a column changes it."""
        model = copy.deepcopy(prepared.template.model)
        for keys, text in zip(prepared.places.keys, texts):
            put(model, keys, text)
        names = _names_of_pair(model)
        if names is None:
            return None
        link = model["links"][0]
        pairs: dict[str, Keys] = {"gap": ("links", 0, "gap")}
        pairs |= {
            f"{word}_{side}": ("structures", name, *_home(model["structures"][name], word), word)
            for side, name in zip(("left", "right"), names)
            for word in OSCILLATOR
        }
        entry = next(one for one in core.catalogue() if one["name"] == link["law"])
        known = ("restitution", "impact_velocity", *(one[0] for one in entry["parameters"]))
        parameters: dict[str, Keys] = {word: ("links", 0, word) for word in link if word in known}
        columns = {*pairs.values(), *parameters.values()}
        places = {keys: i for i, keys in enumerate(prepared.places.keys)}
        if not set(link) <= {*known, *LINK} or not set(places) <= columns | {
            ("links", 0, "law"),
            ("links", 0, "formula"),
        }:
            return None
        analysis = model.get("analysis") or {}
        duration = reading.quantity(analysis["duration"], "")[0] if "duration" in analysis else 0.0
        try:
            constants = {keys: reading.quantity(at(model, keys), "")[0] for keys in columns if keys not in places}
        except InputError:
            # A map or a list, such as modal damping.
            return None
        made = cls(names, link, pairs, parameters, constants, places, duration, row.tolerance)
        return made if [name for name, _ in row.links] == [made.link] else None

    def run(self, numbers: np.ndarray, motion: core.RowMotion, accelerations: bool, alone: bool) -> Found:
        """The rows of one motion."""
        count = len(numbers)
        pairs = {name: self._column(keys, numbers) for name, keys in self._pairs.items()}
        parameters = {name: self._column(keys, numbers) for name, keys in self._parameters.items()}
        duration = self._duration or motion.duration
        options: dict[str, Any] = {"duration": duration, "tolerance": self._tolerance, "accelerations": accelerations}
        # At least one column has the length of the number of rows.
        pairs["gap"] = np.broadcast_to(pairs["gap"], count)
        rest = self.law, self.formula, parameters, motion.accelerations, motion.step
        ran = core.study_pairs(pairs, *rest, required_gap=False, **options)
        found = Found(
            dict(ran["reasons"]),
            [self.link],
            self._by_structure(ran, accelerations),
            {quantity: np.asarray(ran[key])[:, None] for quantity, key in OF_KERNEL.items()},
        )
        if alone:
            apart = core.study_pairs({**pairs, "gap": np.full(count, FAR)}, *rest, required_gap=True, **options)
            found.reasons.update(apart["reasons"])
            found.alone = self._by_structure(apart, accelerations)
            left, right = (np.asarray(apart["displacement"])[:, [k]] for k in (0, 1))
            correlation = core.double_difference(
                pairs["period_left"], pairs["damping_left"], pairs["period_right"], pairs["damping_right"]
            )
            found.gaps = separations(
                np.asarray(apart["required_gap"])[:, None], left, right, np.reshape(correlation, (-1, 1))
            )
        return found

    def _column(self, keys: Keys, numbers: np.ndarray) -> Any:
        return np.ascontiguousarray(numbers[:, self._places[keys]]) if keys in self._places else self._constants[keys]

    def _by_structure(self, ran: Mapping[str, Any], accelerations: bool) -> dict[str, dict[str, np.ndarray]]:
        found = {}
        for k, name in enumerate(self.names):
            displacement = np.asarray(ran["displacement"])[:, [k]]
            # The storey of an oscillator is all of it.
            found[name] = {"displacement": displacement, "drift": displacement}
            if accelerations:
                found[name]["acceleration"] = np.asarray(ran["acceleration"])[:, [k]]
        return found


def _names_of_pair(model: Mapping[str, Any]) -> list[str] | None:
    """Names of the two structures of a pair, left first; None for other models."""
    structures, links = model["structures"], model.get("links")
    if not isinstance(links, list) or len(links) != 1 or "devices" in model or len(structures) != 2:
        return None
    names = links[0].get("between")
    if (
        not isinstance(names, list)
        or len(names) != 2
        or set(map(str, names)) != set(structures)
        or not {"gap", "law"} <= set(links[0])
    ):
        return None
    for one in structures.values():
        if not set(one) <= {"oscillator", "damping"} or sorted(
            [*one["oscillator"], *set(one) - {"oscillator"}]
        ) != sorted(OSCILLATOR):
            return None
    return list(names)


def _home(structure: Mapping[str, Any], word: str) -> tuple[str, ...]:
    """Path of a key of an oscillator; damping may be next to the oscillator."""
    return () if word in structure else ("oscillator",)
