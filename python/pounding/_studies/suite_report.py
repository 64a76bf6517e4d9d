"""The report of a suite, as text and for scripts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from pounding._studies.batches import STATUSES
from pounding._studies.percentiles import finite
from pounding._studies.scaling import Scaling
from pounding._studies.suite_data import Statistics, SuiteData

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
#: Members with a smaller fraction of the largest mean force of their structure are not ranked, as in a run.
MIN_DEMAND = 0.1


def report(suite: SuiteData, percent: Sequence[float]) -> str:
    """Tables of all floors, and of the members, hinges and links with the largest means."""
    found = numbers(suite, percent)
    lines = [*_counts(found), *_scaling(suite)]
    for name, one in found["structures"].items():
        alone = one.get("without_links")
        for quantity, (title, unit, size) in FLOORS.items():
            if quantity in one:
                # From the top down, as a building is drawn.
                floors, own, other = one["floor"][::-1], _reversed(one[quantity]), alone and _reversed(alone[quantity])
                lines += _block(f"{name}: {title} [{unit}]", floors, own, other, size, len(floors))
        for kind, forces in one.get("member_force", {}).items():
            title = f"{name}: member force {kind} [{'kN m' if kind[:1] in 'MT' else 'kN'}]"
            lines += _block(title, one["members"], forces, alone and alone["member_force"][kind], 1e3)
        for key, quantity, title, size in (
            ("parts", "ductility", "ductility", 1.0),
            ("hinges", "plastic_rotation", "plastic rotation [mrad]", 1e-3),
        ):
            if key in one:
                lines += _block(f"{name}: {title}", one[key], one[quantity], alone and alone[quantity], size)
    for quantity in dict.fromkeys(each for link in suite.layout["links"] for each in link["quantities"]):
        links = {name: one[quantity] for name, one in found["links"].items() if quantity in one}
        unit, size = LINKS[suite.units[f"{quantity}.{next(iter(links))}"]]
        title = f"links: {quantity.replace('_', ' ')}" + (f" [{unit}]" if unit else "")
        lines += _block(title, list(links), _side_by_side(links.values()), None, size)
    if "required_gap" in found:
        lines += _block(
            "required gap [mm]", ["largest of all links"], _side_by_side([found["required_gap"]]), None, 1e-3
        )
    return "\n".join(lines)


def _reversed(found: Mapping[str, Sequence[float]]) -> dict[str, Sequence[float]]:
    return {key: values[::-1] for key, values in found.items()}


def _side_by_side(every: Iterable[Mapping[str, float]]) -> dict[str, list[float]]:
    """Statistics of several values by key."""
    rows = list(every)
    return {key: [one[key] for one in rows] for key in rows[0]}


def _counts(found: Mapping[str, Any]) -> list[str]:
    counts = ", ".join(f"{count} {word}" for word, count in found["status"].items() if count)
    lines = [f"{found['count']} records: {counts}"]
    failed = found["count"] - found["finished"]
    if failed:
        lines.append(f"failed records are in no statistics: {failed} of {found['count']}")
    lines += [f"  {one['name']}: {one['reason']}" for one in found["records"] if "reason" in one][:10]
    if found["status"]["collapsed"]:
        lines.append("collapsed records count as infinite values")
    return lines


def scaling_text(scaling: Scaling) -> list[str]:
    """Target, method, range of periods, and fit of the mean spectrum."""
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
    lowest, highest = (scaling.periods[i] for i in (int(scaling.fit.argmin()), int(scaling.fit.argmax())))
    return [
        f"scaled to {scaling.target}: {method}{combined[scaling.components]}; {scaling.periods[0]:.3g} s to {scaling.periods[-1]:.3g} s",
        f"mean spectrum / target: {scaling.fit.min():.3f} at {lowest:.3g} s to {scaling.fit.max():.3f} at {highest:.3g} s"
        + (f"; at least {scaling.fraction:g} is required" if scaling.fraction else ""),
    ]


def _scaling(suite: SuiteData) -> list[str]:
    scaling = suite.scaling
    if scaling is None:
        return []
    lines = ["", *scaling_text(scaling)]
    width = max(len(str(name)) for name in suite.records["name"])
    misfits = (np.array(scaling.factors)[:, None] * np.array(scaling.spectra)) / np.array(scaling.sa)
    lines += [
        f"  {name!s:<{width}}  factor {factor:6.3f}  spectrum / target {misfit.mean():.2f} ({misfit.min():.2f} to {misfit.max():.2f})"
        for name, factor, misfit in zip(suite.records["name"], scaling.factors, misfits)
    ]
    return [*lines, *([scaling.note] if scaling.note else [])]


def _block(
    title: str,
    names: Sequence[Any],
    found: Mapping[str, Sequence[float]],
    alone: Mapping[str, Sequence[float]] | None,
    size: float,
    shown: int = SHOWN,
) -> list[str]:
    """One table of statistics in units of this size; of more than `shown` names those with the largest means."""
    rows = np.arange(len(names))
    if len(names) > shown:
        rows = np.argsort(-np.nan_to_num(found["mean"], nan=-1.0), kind="stable")[:shown]
        title += f", {shown} largest of {len(names)}"
    columns = [*found.values(), *((alone["mean"], alone["max"]) if alone else ())]
    heads = [*list(found)[:-1], "largest", *(["mean alone", "largest alone"] if alone else [])]
    cells = [["", *heads], *([str(names[i]), *(_cell(column[i] / size) for column in columns)] for i in rows.tolist())]
    widths = [max(map(len, column)) for column in zip(*cells)]
    lines = [
        [f"  {line[0]:<{widths[0]}}", *(f"{cell:>{width}}" for cell, width in zip(line[1:], widths[1:]))]
        for line in cells
    ]
    return ["", title, *map("  ".join, lines)]


def _cell(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.4g}"


def summary(suite: SuiteData, percent: Sequence[float]) -> dict[str, Any]:
    """The numbers of the report in SI, for scripts; null for infinite numbers and for quantities that do not exist."""
    found: dict[str, Any] = _plain(numbers(suite, percent))
    return found


def numbers(suite: SuiteData, percent: Sequence[float]) -> dict[str, Any]:
    """Same as `summary`, with infinite numbers, and NaN for quantities that do not exist."""
    model = suite.description["model"]
    found: dict[str, Any] = {
        "title": model.get("title", ""),
        "project": model.get("project", ""),
        "version": suite.description["version"],
        "sha256": suite.sha256,
        "tolerance": suite.tolerance,
        "count": len(suite),
        "records": _of_records(suite),
        "status": suite.counts,
        "finished": int(suite.finished.sum()),
        "records_with_contact": int((_contacts(suite)[suite.finished] > 0).sum()),
        "structures": {},
        "links": {},
    }
    if suite.scaling:
        described = suite.scaling.description()
        found["scaling"] = {**described, "mean": suite.scaling.mean.tolist(), "fit": suite.scaling.fit.tolist()}
    for name in suite.structures:
        made = _of_structure(suite, name, False, percent)
        if suite.has_comparison:
            made["without_links"] = _of_structure(suite, name, True, percent)
        found["structures"][name] = made
    for link in suite.layout["links"]:
        found["links"][link["name"]] = {
            "gap": suite.link_gaps[link["name"]],
            **{each: _numbers(suite, suite[f"{each}.{link['name']}"], percent) for each in link["quantities"]},
        }
    if _has_forces(suite):
        found["force"] = _numbers(suite, _forces(suite), percent)
    if "required_gap" in suite.columns:
        found["required_gap"] = _numbers(suite, suite["required_gap"], percent)
    found["worst"] = {
        "members": _largest(_members(found["structures"], f"{max(percent):g} %")),
        "hinges": _largest(_parts(found["structures"], f"{max(percent):g} %")),
    }
    if suite.warnings:
        found["warnings"] = list(suite.warnings)
    return found


def _contacts(suite: SuiteData) -> np.ndarray:
    """[record] impacts of all links; zero without links."""
    return np.asarray(suite.of_links("impacts").sum(axis=1)) if suite.links else np.zeros(len(suite))


def _has_forces(suite: SuiteData) -> bool:
    """False if all links are rigid."""
    return any("force" in one["quantities"] for one in suite.layout["links"])


def _forces(suite: SuiteData) -> np.ndarray:
    """[record] largest force of all links [N]; NaN for failed records."""
    forces = suite.of_links("force")
    return np.asarray(np.fmax.reduce(forces, axis=1))


def _of_records(suite: SuiteData) -> list[dict[str, Any]]:
    """Name, factor, peak acceleration, status, and largest responses of each record."""
    forces = _forces(suite) if _has_forces(suite) else None
    contacts, rows = _contacts(suite), []
    for row, status in enumerate(suite["status"].tolist()):
        record = int(suite["record"][row])
        one = {
            "name": suite.records["name"][record],
            "factor": suite.scaling.factors[record] if suite.scaling else None,
            "pga": float(suite.records["pga"][record]),
            "status": STATUSES[status],
            **_reason(suite, row),
        }
        if suite.finished[row]:
            one["impacts"] = float(contacts[row])
            if forces is not None:
                one["force"] = float(forces[row])
            if "required_gap" in suite.columns:
                one["required_gap"] = float(suite["required_gap"][row])
        rows.append(one)
    return rows


def _reason(suite: SuiteData, row: int) -> dict[str, str]:
    return {"reason": suite.reasons[row]} if row in suite.reasons else {}


def _of_structure(suite: SuiteData, name: str, alone: bool, percent: Sequence[float]) -> dict[str, Any]:
    one = suite.structure(name)
    found: dict[str, Any] = {} if alone else {"floor": list(range(1, one["floors"] + 1))}
    for quantity in one["quantities"]:
        found[quantity] = _numbers(suite, suite.floors(name, quantity, alone=alone), percent)
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


def _members(structures: Mapping[str, Any], rank: str) -> Iterator[dict[str, Any]]:
    """Members with their forces, the ratio with and without links, and their demand: the fraction of the largest force
    of the component in the structure."""
    for name, one in structures.items():
        for kind, forces in one.get("member_force", {}).items():
            alone = one["without_links"]["member_force"][kind] if "without_links" in one else None
            typical = _typical([forces], rank)[0]
            top = max((value for value in typical if np.isfinite(value)), default=0.0)
            for i, member in enumerate(one["members"]):
                demand = typical[i] / top if top > 0 else 0.0
                if demand >= MIN_DEMAND:
                    row = {"structure": name, "member": member, "component": kind}
                    yield {**row, **_pair(forces, alone, i, rank), "demand": demand}


def _parts(structures: Mapping[str, Any], rank: str) -> Iterator[dict[str, Any]]:
    """Parts that yield, with their ductility, its ratio with and without links, and the plastic rotation of hinges."""
    for name, one in structures.items():
        alone = one.get("without_links")
        for i, part in enumerate(one.get("parts", ())):
            demand = _typical([one["ductility"]], rank)[0][i]
            row = {"structure": name, "part": part, "demand": demand}
            row |= _pair(one["ductility"], alone and alone["ductility"], i, rank)
            if part in one.get("hinges", ()):
                row["plastic_rotation"] = _at(one["plastic_rotation"], one["hinges"].index(part))
            if demand > 1:
                yield row


def _typical(runs: Sequence[Mapping[str, Any]], rank: str) -> list[Any]:
    """The means of runs, or their percentiles if a mean is infinite, which one collapse suffices for."""
    key = "mean" if all(np.isfinite(one["mean"]).all() for one in runs) else rank
    return [one[key] for one in runs]


def _pair(found: Mapping[str, Any], alone: Mapping[str, Any] | None, i: int, rank: str) -> dict[str, Any]:
    """Statistics of one member or part, with and without links if both exist, and the ratio of their means."""
    if alone is None:
        return {"with": _at(found, i)}
    value, reference = (one[i] for one in _typical([found, alone], rank))
    ratio = value / reference if np.isfinite(value) and reference > 1e-9 * value else np.nan
    return {"with": _at(found, i), "without": _at(alone, i), "ratio": ratio}


def _at(found: Mapping[str, Any], i: int) -> dict[str, float]:
    return {key: values[i] for key, values in found.items()}


def _largest(rows: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those with the largest ratios of means, or with the largest demands if there are no ratios."""
    every = list(rows)
    compared = [row for row in every if np.isfinite(row.get("ratio", np.nan))]
    if compared:
        return sorted(compared, key=lambda row: -row["ratio"])[:SHOWN]
    return sorted(every, key=lambda row: -row["demand"])[:SHOWN]


def _numbers(suite: SuiteData, values: np.ndarray, percent: Sequence[float]) -> dict[str, Any]:
    found: Statistics = suite.statistics(values, percent)
    by_rank = {f"{one:g} %": found.percentiles[i].tolist() for i, one in enumerate(percent)}
    return {"mean": found.mean.tolist(), **by_rank, "max": found.max.tolist()}


def _plain(value: Any) -> Any:
    """The value for JSON."""
    if isinstance(value, Mapping):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return finite(value) if isinstance(value, float) else value
