"""Two oscillators and one link as columns: what the kernel runs fastest."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pounding._native import core
from pounding.errors import InputError
from pounding.studies import words
from pounding.studies.factors import put
from pounding.studies.kernel_columns import OF_KERNEL, Found, separations, step_error
from pounding.studies.prepared import Prepared

OSCILLATOR = ("mass", "period", "damping")
LINK = ("between", "gap", "law", "name", "formula")
#: A gap that no structure closes [m].
FAR = 1e9


class Pairs:
    """Columns of the pairs of one study and one set of labels: constants of the model, and numbers of places."""

    def __init__(self, model: Mapping[str, Any], places: Mapping[tuple[str | int, ...], int], tolerance: float) -> None:
        """Raises KeyError, TypeError, ValueError and InputError for a model that is no such pair."""
        self._places = places
        link = model["links"][0]
        left, right = self.names = [str(name) for name in link["between"]]
        if set(model["structures"]) != {left, right} or len(model["links"]) != 1 or "devices" in model:
            raise ValueError
        self._pairs: dict[str, tuple[tuple[str | int, ...], Any]] = {"gap": (("links", 0, "gap"), link["gap"])}
        for side, name in (("left", left), ("right", right)):
            structure = model["structures"][name]
            if set(structure) != {"oscillator"} or set(structure["oscillator"]) != set(OSCILLATOR):
                raise ValueError
            for word in OSCILLATOR:
                self._pairs[f"{word}_{side}"] = (("structures", name, "oscillator", word), structure["oscillator"][word])
        self.law, self.formula = str(link["law"]), str(link.get("formula", ""))
        entry = next(one for one in core.catalogue() if one["name"] == self.law)
        known = {"restitution", "impact_velocity", *(one["name"] for one in entry["parameters"])}
        self._parameters: dict[str, tuple[tuple[str | int, ...], Any]] = {}
        for word in link:
            if word in known:
                self._parameters[word] = (("links", 0, word), link[word])
            elif word not in LINK:
                raise ValueError
        self.link = str(link.get("name", f"{left}-{right}"))
        self._constants = {keys: words.quantity(value, "")[0] for keys, value in (*self._pairs.values(), *self._parameters.values()) if keys not in places}
        analysis = model.get("analysis") or {}
        self._duration = words.quantity(analysis["duration"], "")[0] if "duration" in analysis else 0.0
        self._tolerance = step_error(tolerance)
        mine = {keys for keys, _ in (*self._pairs.values(), *self._parameters.values())}
        if not set(places) <= mine | {("links", 0, "law"), ("links", 0, "formula")}:
            raise ValueError

    @classmethod
    def of(cls, prepared: Prepared, texts: Sequence[str], row: core.LinearRow) -> Pairs | None:
        """The pairs of a template, with these texts in its places; None for other models, which go by their modes. `row` is such a model: what it
        says holds for all rows, since no value of a column makes a linear pair another one."""
        model = copy.deepcopy(prepared.template.model)
        for keys, text in zip(prepared.places.keys, texts):
            put(model, keys, text)
        try:
            made = cls(model, {keys: i for i, keys in enumerate(prepared.places.keys)}, row.tolerance)
        except (InputError, KeyError, TypeError, ValueError, IndexError, StopIteration, AttributeError):
            return None
        return made if [name for name, _ in row.links] == [made.link] else None

    def run(self, numbers: np.ndarray, motion: core.RowMotion, accelerations: bool, alone: bool) -> Found:
        """The rows of one motion."""
        count = len(numbers)
        pairs = {name: self._column(keys, numbers) for name, (keys, _) in self._pairs.items()}
        parameters = {name: self._column(keys, numbers) for name, (keys, _) in self._parameters.items()}
        duration = self._duration or motion.duration
        record = motion.accelerations
        options = {"duration": duration, "tolerance": self._tolerance, "accelerations": accelerations}
        # One row at least stands in a column, for the number of rows.
        pairs["gap"] = np.broadcast_to(pairs["gap"], count)
        ran = core.study_pairs(pairs, self.law, self.formula, parameters, record, motion.step, required_gap=False, **options)
        found = Found(dict(ran["reasons"]), [self.link], self._by_structure(ran, accelerations),
                      {quantity: np.asarray(ran[key])[:, None] for quantity, key in OF_KERNEL.items()})
        if alone:
            apart = core.study_pairs({**pairs, "gap": np.full(count, FAR)}, self.law, self.formula, parameters, record, motion.step, required_gap=True, **options)
            found.reasons.update(apart["reasons"])
            found.alone = self._by_structure(apart, accelerations)
            left, right = (np.asarray(apart["displacement"])[:, [k]] for k in (0, 1))
            correlation = core.double_difference(pairs["period_left"], pairs["damping_left"], pairs["period_right"], pairs["damping_right"])
            found.gaps = separations(np.asarray(apart["required_gap"])[:, None], left, right, np.reshape(correlation, (-1, 1)))
        return found

    def _column(self, keys: tuple[str | int, ...], numbers: np.ndarray) -> Any:
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
