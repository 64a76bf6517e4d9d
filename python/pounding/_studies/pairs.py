"""Two oscillators and one link as columns, the fastest path of the kernel."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pounding._native import core
from pounding._studies import reading
from pounding._studies.factors import at, put
from pounding._studies.kernel_columns import OF_KERNEL, Found, separations, step_error
from pounding._studies.prepared import Prepared
from pounding.errors import InputError

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
