"""The engine of linear structures: the compiled kernel runs thousands of rows per second in modal coordinates.

Two oscillators run as columns. Other models are read and transformed to modal coordinates for each set of factor
values. The choice of engine depends on the row only, so tables are bitwise independent of chunks."""

from __future__ import annotations

import math
from collections.abc import Callable
from time import perf_counter
from typing import Any, cast

import numpy as np

from pounding._native import core
from pounding._studies.batches import DONE, EXCEEDED, Batch, Done, nothing_of, side_by_side
from pounding._studies.factors import at
from pounding._studies.pairs import OF_KERNEL, Found, Pairs, column_of, separations, step_error
from pounding._studies.quantities import Kept
from pounding._studies.template import Last, Template, prepared
from pounding.errors import InputError

#: Keys of `analysis:` that the kernel supports; the others control the solver.
ANALYSIS = ("duration", "tolerance", "output_step")
#: Maximum of modes times max(1, omega h) for the kernel; the solver is faster above. 35 modes of shear buildings (93)
#: take a fifth of the solver's time, 70 modes of two frames (1150) twice that time.
MAX_WORK = 400
#: Number of cached models in modal coordinates; consecutive rows share one at all levels.
KEPT_MODELS = 256


class KernelEngine:
    """Runs rows of linear structures with penalty laws."""

    name = "kernel"

    def takes(self, template: Template) -> bool:
        """False for models with keys that only the solver supports."""
        return not _solver_words(template)

    def why_not(self, batch: Batch) -> str:
        """Why the first row of a batch needs the solver; empty if it does not."""
        return _solver_words(batch.template) or next(iter(self.run(batch.part([0])).reasons.values()), "")

    def run(self, batch: Batch) -> Done:
        """Runs rows with the same motion, scale and labels in one call."""
        done = nothing_of(batch)
        ready = _ready(batch.template)
        groups: dict[tuple[Any, ...], list[int]] = {}
        for i, key in enumerate(
            zip(batch.record.tolist(), batch.scale.tolist(), map(tuple, batch.values[:, ready.labels].tolist()))
        ):
            groups.setdefault(key, []).append(i)
        for (record, scale, labels), members in groups.items():
            begin = perf_counter()
            chosen = np.array(members)
            try:
                motion = ready.prepared.motion(record, scale, batch.files)
                reasons = ready.run(
                    labels,
                    batch.values[chosen],
                    motion,
                    lambda found, rows: self._fill(done, chosen[rows], found, batch.template.kept),
                )
            except (InputError, OSError) as error:
                reasons = dict.fromkeys(range(len(chosen)), str(error))
            done.reasons.update({int(batch.rows[chosen[i]]): why for i, why in reasons.items()})
            done.seconds[chosen] = (perf_counter() - begin) / len(chosen)
        return done

    @staticmethod
    def _fill(done: Done, rows: np.ndarray, found: Found, kept: Kept) -> None:
        ran = np.array([i for i in range(len(rows)) if i not in found.reasons], dtype=np.int64)
        values = side_by_side([column_of(column, found) for column in kept.columns], len(rows))
        if kept.undefined_limits(values[ran]):
            # The solver reports these rows.
            found.reasons.update(
                (i, "a quantity with a limit is undefined") for i in ran.tolist() if kept.undefined_limits(values[[i]])
            )
            ran = np.array([i for i in ran.tolist() if i not in found.reasons], dtype=np.int64)
        done.values[rows[ran]] = values[ran]
        done.status[rows[ran]] = np.where(kept.exceeded(values[ran]), EXCEEDED, DONE)


def _solver_words(template: Template) -> str:
    if column := template.kept.for_solver():
        return f"{column} is for the solver"
    analysis = template.model.get("analysis") or {}
    return next((f"analysis.{word} is for the solver" for word in analysis if word not in ANALYSIS), "")


class _Ready:
    """A template prepared for the kernel."""

    def __init__(self, template: Template) -> None:
        self.prepared = prepared(template)
        self.labels = [j for j, factor in enumerate(template.factors) if factor.labels]
        self._ways: dict[tuple[float, ...], Pairs | str] = {}
        self._models = Last(KEPT_MODELS)
        quantities = {column.split(".")[0] for column in template.kept.columns}
        self.accelerations = "acceleration" in quantities
        self.alone = template.kept.needs_comparison

    def run(
        self,
        labels: tuple[float, ...],
        values: np.ndarray,
        motion: core.RowMotion | None,
        take: Callable[[Found, np.ndarray], None],
    ) -> dict[int, str]:
        """Runs rows of one motion and stores their results; returns the reasons of rows that were not run. Raises
        InputError, OSError."""
        if motion is None or motion.step == 0:
            return dict.fromkeys(range(len(values)), "the kernel takes records with an even step from time 0 on")
        numbers = self.prepared.places.numbers(values)
        key = (*labels, motion.step)
        if key not in self._ways:
            self._ways[key] = self._way(numbers[0], motion)
        way = self._ways[key]
        if isinstance(way, Pairs):
            found = way.run(numbers, motion, self.accelerations, self.alone)
            take(found, np.arange(len(values)))
            return found.reasons
        if way:
            return dict.fromkeys(range(len(values)), way)
        reasons: dict[int, str] = {}
        for i, row in enumerate(numbers):
            try:
                found = self._one(row, motion)
                take(found, np.array([i]))
            except InputError as error:
                reasons[i] = str(error)
            else:
                if found.reasons:
                    reasons[i] = found.reasons[0]
        return reasons

    def _way(self, numbers: np.ndarray, motion: core.RowMotion) -> Pairs | str:
        """How rows with these labels run: as pairs, by modes (""), or why not with the kernel. It follows from the
        model without the values of rows, so it is the same for all of them."""
        template = self.prepared.template
        texts = [
            text if template.factors[j].labels else str(at(template.model, keys))
            for j, keys, text in zip(
                self.prepared.places.factor, self.prepared.places.keys, self.prepared.places.texts(numbers)
            )
        ]
        try:
            self.prepared.put_texts(texts)
            row = self.prepared.linear(motion, False, False)
        except InputError as error:
            return str(error)
        work = row.model.modes * max(1.0, row.fastest * motion.step)
        if work > MAX_WORK and template.engine == "auto":
            return f"it is faster with {row.model.modes} modes up to {row.fastest / (2 * math.pi):.3g} Hz"
        return Pairs.of(self.prepared, texts, row) or ""

    def _one(self, row: np.ndarray, motion: core.RowMotion) -> Found:
        """A model in modal coordinates. The key includes the motion, which may set the duration."""

        def make() -> core.LinearRow:
            self.prepared.put(row)
            return self.prepared.linear(motion, self.accelerations, self.alone)

        return run_modes(
            self._models.get((row.tobytes(), motion.duration), make), motion, self.accelerations, self.alone
        )


def run_modes(row: core.LinearRow, motion: core.RowMotion, accelerations: bool, alone: bool) -> Found:
    """Runs one row of a model in modal coordinates."""
    options: dict[str, Any] = {"duration": row.duration, "tolerance": step_error(row.tolerance)}
    one = np.ones(1)
    ran = core.study_model(row.model, motion.accelerations, motion.step, one, **options)
    links = [name for name, _ in row.links]
    contacts = {quantity: np.asarray(ran[key]).reshape(1, len(links)) for quantity, key in OF_KERNEL.items()}
    structures, _ = _by_structure(row, np.asarray(ran["outputs"]).reshape(1, -1), accelerations)
    found = Found(dict(ran["reasons"]), links, structures, contacts)
    if alone:
        apart = core.study_model(row.alone, motion.accelerations, motion.step, one, **options)
        found.reasons.update(apart["reasons"])
        found.alone, rest = _by_structure(row, np.asarray(apart["outputs"]).reshape(1, -1), accelerations)
        closing, left, right = rest[:, 0::3], rest[:, 1::3], rest[:, 2::3]
        found.gaps = separations(closing, left, right, np.array([correlation for _, correlation in row.links]))
    return found


def _by_structure(
    row: core.LinearRow, outputs: np.ndarray, accelerations: bool
) -> tuple[dict[str, dict[str, np.ndarray]], np.ndarray]:
    found, next_output = {}, 0
    for name, floors, has_storeys in row.structures:
        parts = {}
        for quantity, count in (
            ("displacement", floors),
            ("drift", floors if has_storeys else 0),
            ("acceleration", floors if accelerations else 0),
        ):
            parts[quantity] = outputs[:, next_output : next_output + count]
            next_output += count
        found[name] = parts
    return found, outputs[:, next_output:]


def _ready(template: Template) -> _Ready:
    found = prepared(template)
    if found.kernel is None:
        found.kernel = _Ready(template)
    return cast(_Ready, found.kernel)
