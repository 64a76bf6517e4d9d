"""The report of a suite, as text and for scripts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pounding.studies.batches import STATUSES
from pounding.studies.percentiles import finite
from pounding.studies.suite import Statistics, Suite

GRAVITY = 9.80665  #: [m/s^2]
#: Quantities of floors: title, unit and its size in SI.
FLOORS = {
    "displacement": ("displacement", "mm", 1e-3),
    "drift": ("drift", "mm", 1e-3),
    "drift_ratio": ("drift ratio", "%", 1e-2),
    "acceleration": ("acceleration", "g", GRAVITY),
    "storey_shear": ("storey shear", "kN", 1e3),
    "residual_drift": ("residual drift", "mm", 1e-3),
}
LINKS = {"m": ("mm", 1e-3), "N": ("kN", 1e3), "N s": ("kN s", 1e3), "J": ("kJ", 1e3), "": ("", 1.0)}
#: Number of members, hinges and links in the text.
SHOWN = 5


def report(suite: Suite, percent: Sequence[float]) -> str:
    """Tables of all floors, and of the members, hinges and links with the largest means."""
    lines = [_counts(suite), *_scaling(suite)]
    for name in suite.structures:
        one = suite.structure(name)
        for quantity in one["quantities"]:
            lines += _of_floors(suite, name, quantity, percent)
        lines += _of_members(suite, name, percent)
        for quantity, title, unit in (("ductility", "ductility", ""), ("plastic_rotation", "plastic rotation", "mrad")):
            names = one["parts"] if quantity == "ductility" else one["hinges"]
            if names:
                scale = 1e-3 if unit else 1.0
                lines += _block(
                    f"{name}: {title}{f' [{unit}]' if unit else ''}",
                    names,
                    suite.parts(name, quantity) / scale,
                    suite.parts(name, quantity, alone=True) / scale if suite.has_comparison else None,
                    suite,
                    percent,
                    SHOWN,
                )
    lines += _of_links(suite, percent)
    return "\n".join(lines)


def _counts(suite: Suite) -> str:
    status = suite["status"]
    counts = ", ".join(f"{count} {STATUSES[i]}" for i in range(len(STATUSES)) if (count := int((status == i).sum())))
    lines = [f"{len(suite)} records: {counts}"]
    if suite.failed:
        lines.append(f"failed records are in no statistics: {len(suite.failed)} of {len(suite)}")
    names = suite.records["name"]
    lines += [
        f"  {names[suite['record'][row]]}: {why}" for row, why in [*suite.failed.items(), *suite.collapsed.items()][:10]
    ]
    if suite.collapsed:
        lines.append("collapsed records count as infinite values")
    return "\n".join(lines)


def _scaling(suite: Suite) -> list[str]:
    scaling = suite.scaling
    if scaling is None:
        return []
    method = {
        "suite": "one factor for all records",
        "least_squares": "one factor per record, least squares",
        "mean": "one factor per record, equal means over the range",
    }[scaling.method]
    combined = {
        "": "",
        "srss": ", SRSS of two components",
        "rotd100": ", RotD100 of two components",
        "geometric_mean": ", geometric mean of two components",
    }
    lines = [
        "",
        f"scaled to {scaling.target}: {method}{combined[scaling.components]}; {scaling.periods[0]:.3g} s to {scaling.periods[-1]:.3g} s",
        f"mean spectrum / target: {scaling.fit.min():.3f} at {scaling.periods[int(scaling.fit.argmin())]:.3g} s to {scaling.fit.max():.3f} at "
        f"{scaling.periods[int(scaling.fit.argmax())]:.3g} s"
        + (f"; at least {scaling.fraction:g} is required" if scaling.fraction else ""),
    ]
    width = max(len(str(name)) for name in suite.records["name"])
    misfits = (np.array(scaling.factors)[:, None] * np.array(scaling.spectra)) / np.array(scaling.sa)
    lines += [
        f"  {name!s:<{width}}  factor {factor:6.3f}  spectrum / target {misfit.mean():.2f} ({misfit.min():.2f} to {misfit.max():.2f})"
        for name, factor, misfit in zip(suite.records["name"], scaling.factors, misfits)
    ]
    return [*lines, *([scaling.note] if scaling.note else [])]


def _of_floors(suite: Suite, name: str, quantity: str, percent: Sequence[float]) -> list[str]:
    title, unit, size = FLOORS[quantity]
    floors = [str(i + 1) for i in range(suite.structure(name)["floors"])]
    values = suite.floors(name, quantity) / size
    alone = suite.floors(name, quantity, alone=True) / size if suite.has_comparison else None
    # From the top down, as a building is drawn.
    return _block(
        f"{name}: {title} [{unit}]",
        floors[::-1],
        values[:, ::-1],
        None if alone is None else alone[:, ::-1],
        suite,
        percent,
        len(floors),
    )


def _of_members(suite: Suite, name: str, percent: Sequence[float]) -> list[str]:
    one = suite.structure(name)
    if not one["members"]:
        return []
    values = suite.members(name) / 1e3
    alone = suite.members(name, alone=True) / 1e3 if suite.has_comparison else None
    lines = []
    for j, kind in enumerate(one["components"]):
        unit = "kN m" if kind[:1] in "MT" else "kN"
        lines += _block(
            f"{name}: member force {kind} [{unit}]",
            one["members"],
            values[:, :, j],
            None if alone is None else alone[:, :, j],
            suite,
            percent,
            SHOWN,
        )
    return lines


def _of_links(suite: Suite, percent: Sequence[float]) -> list[str]:
    lines = []
    for quantity in dict.fromkeys(each for link in suite.layout["links"] for each in link["quantities"]):
        names = [link["name"] for link in suite.layout["links"] if quantity in link["quantities"]]
        unit, size = LINKS[suite.units[f"{quantity}.{names[0]}"]]
        values = np.column_stack([suite[f"{quantity}.{name}"] for name in names]) / size
        title = quantity.replace("_", " ") + (f" [{unit}]" if unit else "")
        lines += _block(f"links: {title}", names, values, None, suite, percent, SHOWN)
    if "required_gap" in suite.columns:
        gap = 1e3 * suite["required_gap"][:, None]
        lines += _block("required gap [mm]", ["largest of all links"], gap, None, suite, percent, 1)
    return lines


def _block(
    title: str,
    names: Sequence[str],
    values: np.ndarray,
    alone: np.ndarray | None,
    suite: Suite,
    percent: Sequence[float],
    shown: int,
) -> list[str]:
    """One table; of more than `shown` names those with the largest means."""
    found = suite.statistics(values, percent)
    without = None if alone is None else suite.statistics(alone, percent)
    rows = np.arange(len(names))
    if len(names) > shown:
        rows = np.argsort(-np.nan_to_num(found.mean, nan=-1.0), kind="stable")[:shown]
        title += f", {shown} largest of {len(names)}"
    heads = ["mean", *(f"{one:g} %" for one in percent), "largest"]
    cells = [heads + (["mean alone", "largest alone"] if without is not None else [])]
    for i in rows:
        row = [found.mean[i], *found.percentiles[:, i], found.max[i]]
        row += [without.mean[i], without.max[i]] if without is not None else []
        cells.append([_cell(value) for value in row])
    first = [title, *(names[i] for i in rows.tolist())]
    width = max(len(text) for text in first[1:] or [""])
    columns = [max(len(line[j]) for line in cells) for j in range(len(cells[0]))]
    return [
        "",
        title,
        *(
            f"  {text:<{width}}  " + "  ".join(f"{cell:>{size}}" for cell, size in zip(line, columns))
            for text, line in zip(["", *first[1:]], cells)
        ),
    ]


def _cell(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.4g}"


def summary(suite: Suite, percent: Sequence[float]) -> dict[str, Any]:
    """The numbers of the report in SI, for scripts; null for infinite numbers and for quantities that do not exist."""
    status = suite["status"]
    factors = suite.scaling.factors if suite.scaling else [None] * len(suite)
    found: dict[str, Any] = {
        "records": [
            {"name": name, "factor": factor, "status": STATUSES[status[row]], **_reason(suite, row)}
            for row, (name, factor) in enumerate(zip(suite.records["name"], factors))
        ],
        "status": {word: int((status == i).sum()) for i, word in enumerate(STATUSES)},
        "structures": {},
        "links": {},
    }
    if suite.scaling:
        described = suite.scaling.description()
        found["scaling"] = {**described, "mean": suite.scaling.mean.tolist(), "fit": suite.scaling.fit.tolist()}
    for name in suite.structures:
        runs = [("", False)] + ([("without_links", True)] if suite.has_comparison else [])
        made: dict[str, Any] = {}
        for key, alone in runs:
            numbers = _of_structure(suite, name, alone, percent)
            made |= {key: numbers} if key else numbers
        found["structures"][name] = made
    for link in suite.layout["links"]:
        found["links"][link["name"]] = {
            quantity: _numbers(suite, suite[f"{quantity}.{link['name']}"], percent) for quantity in link["quantities"]
        }
    if "required_gap" in suite.columns:
        found["required_gap"] = _numbers(suite, suite["required_gap"], percent)
    if suite.warnings:
        found["warnings"] = list(suite.warnings)
    return found


def _reason(suite: Suite, row: int) -> dict[str, str]:
    return {"reason": suite.reasons[row]} if row in suite.reasons else {}


def _of_structure(suite: Suite, name: str, alone: bool, percent: Sequence[float]) -> dict[str, Any]:
    one = suite.structure(name)
    found: dict[str, Any] = {
        quantity: _numbers(suite, suite.floors(name, quantity, alone=alone), percent) for quantity in one["quantities"]
    }
    if one["members"]:
        forces = suite.members(name, alone=alone)
        found["members"] = one["members"]
        found["member_force"] = {
            kind: _numbers(suite, forces[:, :, j], percent) for j, kind in enumerate(one["components"])
        }
    for quantity, key in (("ductility", "parts"), ("plastic_rotation", "hinges")):
        if one[key]:
            found[key] = one[key]
            found[quantity] = _numbers(suite, suite.parts(name, quantity, alone=alone), percent)
    return found


def _numbers(suite: Suite, values: np.ndarray, percent: Sequence[float]) -> dict[str, Any]:
    found: Statistics = suite.statistics(values, percent)
    by_rank = {f"{one:g} %": _plain(found.percentiles[i]) for i, one in enumerate(percent)}
    return {"mean": _plain(found.mean), **by_rank, "max": _plain(found.max)}


def _plain(values: np.ndarray) -> Any:
    return finite(float(values)) if values.ndim == 0 else [finite(one) for one in values.tolist()]
