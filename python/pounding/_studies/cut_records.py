"""Records that last longer than the rows of a study, and are cut by analysis.duration."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies.batches import side_by_side
from pounding._studies.places import Places
from pounding._studies.reading import quantity
from pounding._studies.sampling import Points
from pounding._studies.template import Template

#: Maximum fraction of the Arias intensity cut without a warning, as for a single run.
MAX_CUT = 0.05
#: Maximum number of points of the factors whose durations are compared.
LOOKED_AT = 100_000
#: Maximum number of motions of the model that are checked.
MAX_MOTIONS = 100
#: End of the warning of a model whose duration cuts its record.
_OF_DURATION = "accept: [duration])"


def with_cuts(of_model: Sequence[str], of_first: Sequence[str], cuts: Sequence[str]) -> list[str]:
    """Warnings of the model, with the one about cut records replaced by that for all rows of the study."""
    return [doubt for doubt in of_model if not doubt.endswith(_OF_DURATION)] + list(
        cuts or [doubt for doubt in of_first if doubt.endswith(_OF_DURATION)]
    )


def cut_records(template: Template, points: Points, last_arrival: float, files: Mapping[str, bytes]) -> list[str]:
    """A warning with the number of records that lose more than MAX_CUT of their Arias intensity in any row.

    Empty if there are none, or if the model accepts the warning. A motion reaches the last support at `last_arrival`
    [s]; `files` contains the contents of the records. Raises InputError for an unreadable motion."""
    columns = points.columns(np.unique(np.linspace(0, points.count - 1, min(points.count, LOOKED_AT)).astype(np.int64)))
    values = side_by_side([columns[factor.name] for factor in points.factors], 1)
    durations = _durations(template, values)
    duration = float(durations.min())
    if not duration or "duration" in (template.model.get("accept") or []):
        return []
    cut, worst, needed = 0, 0.0, 0.0
    for number, motion in enumerate(template.motions):
        if 0 < motion.duration <= duration - last_arrival:
            continue
        # Records replace the motion of the model.
        points_of = [int(durations.argmin())] if motion.words else _different_motions(template, values, durations)
        losses = []
        for point in points_of:
            ground = template.case(values[point].tolist(), number, 1.0).get("ground_motion")
            if ground is not None:
                row = core.RowMotion(yaml_text.emit({"ground_motion": ground}), template.place, files)
                losses.append((*row.arias_after(float(durations[point]) - last_arrival), float(durations[point])))
        if losses and max(losses)[0] > MAX_CUT:
            lost, t95, duration = max(losses)
            cut, worst, needed = cut + 1, max(worst, lost), max(needed, t95 + last_arrival)
    if not cut:
        return []
    count = len(template.motions)
    return [
        f"analysis: the duration of {duration:.4g} s cuts {cut} of {count} record{'s' if count > 1 else ''}, by more than {100 * MAX_CUT:g} % of the Arias "
        f"intensity and up to {100 * worst:.0f} %; type a duration of at least {math.ceil(10 * needed) / 10:.6g} s, or leave it out, and each row lasts as "
        "long as its record (to suppress this warning: accept: [duration] in the model)"
    ]


def _durations(template: Template, values: np.ndarray) -> np.ndarray:
    """[point] analysis.duration [s] for the values of [point, factor]; 0 if rows last as long as their motions."""
    analysis = template.model.get("analysis") or {}
    places = Places(template.model, template.factors)
    if ("analysis", "duration") in places.keys:
        return np.asarray(places.numbers(values)[:, places.keys.index(("analysis", "duration"))], dtype=float)
    return np.full(
        len(values), quantity(analysis["duration"], "analysis.duration")[0] if "duration" in analysis else 0.0
    )


def _different_motions(template: Template, values: np.ndarray, durations: np.ndarray) -> list[int]:
    """Points with different ground motions or durations, at most MAX_MOTIONS."""
    moving = [
        j
        for j, factor in enumerate(template.factors)
        if any(path.split(".")[0] in ("ground_motion", "*") for path in factor.of)
    ]
    _, first = np.unique(np.column_stack([durations, values[:, moving]]), axis=0, return_index=True)
    return [int(point) for point in first[np.unique(np.linspace(0, len(first) - 1, MAX_MOTIONS).astype(int))]]
