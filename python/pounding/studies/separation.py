"""`pounding separation`: the required gap of a model under its records, compared with the rules of codes."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np

from pounding import arguments
from pounding.arguments import takes
from pounding.errors import ImplausibleWarning, InputError, SolverError
from pounding.models import check
from pounding.studies.percentiles import finite
from pounding.studies.plan import Plan, plan_of, read_given
from pounding.studies.reading import shortened
from pounding.studies.study import Study, records_folder, run_plan

#: Rule, clause, combination of the peak displacements (abs: sum, srss: root of the sum of squares), and factors on it
#: for floors that are not aligned and for aligned ones. Displacements are those of the model under the records, without
#: a behaviour factor.
CODES = (
    ("ASCE 7-16 and 7-22", "12.12.3", "srss", 1.0, 1.0),
    ("Eurocode 8 (EN 1998-1)", "4.4.2.7", "srss", 1.0, 0.7),
    ("IS 1893-1", "7.11.3", "abs", 1.0, 0.5),
    ("NZS 1170.5, inside a site", "-", "abs", 1.0, 1.0),
)


#: Keys of `study:` that a separation uses; the last two add columns that are not printed.
_USED = ("seed", "factors", "sampling", "records", "intensity", "engine", "stop_after", "keep", "without_links")
_GAPS = ("required_gap", "gap_abs", "gap_srss", "gap_ddc")


def read_separation(path: str | PathLike[str], records: Sequence[str | PathLike[str]] | None = None) -> Plan:
    """The plan of a separation from the file of a model or study; `records` replace those of the file. Raises
    InputError, also for keys that a separation does not use."""
    given = read_given(path)
    if not given.model.links:
        check(given.model)
        raise InputError(
            f"{path}: a separation needs at least one link, for the floors that can touch; its law is not used"
        )
    one = dict(given.keys or {})
    for word in one:
        if word not in _USED:
            raise InputError(
                f"{path}: study.{word}: a separation does not use it; leave it out, or type pounding study {path}"
            )
    keep = one.get("keep") or []
    used: dict[str, Any] = {
        "stop_after": "100 %",
        **one,
        "keep": [*([keep] if isinstance(keep, str) else keep), *_GAPS],
    }
    if records:
        used["records"] = {"files": [fspath(Path(one).resolve()) for one in records]}
    plan = plan_of(replace(given, keys=used), records_folder(Path(Path(path).name)))
    varied = [factor.name for factor in plan.points.factors if factor.values is not None and len(factor.values) > 1]
    if varied:
        raise InputError(
            f"{path}: study.factors.{varied[0]}: a separation has one gap, and this list or range would mix several; leave one value, or type "
            f"pounding study {path} with keep: [required_gap]"
        )
    if len(plan.levels) > 1:
        raise InputError(
            f"{path}: study.intensity.levels: a separation has one gap, and {len(plan.levels)} levels would mix; leave one level, or type "
            f"pounding study {path} with keep: [required_gap]"
        )
    return plan


@takes(
    model=arguments.file, records=arguments.optional(arguments.files), workers=arguments.optional(arguments.whole(0))
)
def separation(
    model: str | PathLike[str], records: Sequence[str | PathLike[str]] | None = None, workers: int | None = None
) -> dict[str, Any]:
    """Required gap of every record, gaps by rules, and gaps by codes from the mean over the records [m].

    A gap is None, without a mean, if structures collapse without links, when no gap is sufficient. Raises InputError,
    and SolverError if a record fails; emits the warnings of the plan (ImplausibleWarning)."""
    plan = read_separation(model, records)
    for doubt in plan.warnings:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
    return run_separation(plan, workers)


def run_separation(plan: Plan, workers: int | None = None) -> dict[str, Any]:
    """Same as `separation`, for a plan."""
    done = run_plan(plan, None, workers=0 if plan.count < 4 and workers is None else workers, progress=None)
    if done.failed:
        raise SolverError(next(iter(done.failed.values())))
    return _found(done, _floors_align(plan.template.model["links"]))


def _floors_align(links: Sequence[Mapping[str, Any]]) -> bool:
    return all(str(link.get("floors", "")) == "all" for link in links)


def _found(done: Study, align: bool) -> dict[str, Any]:
    names = [str(done.records["name"][record]) for record in done["record"]]
    if done["point"].max() > 0:
        names = [f"{name}, sample {point}" for name, point in zip(names, done["point"])]
    per_record = [
        {"record": name, "required": finite(need), "abs": finite(a), "srss": finite(s), "ddc": finite(d)}
        for name, need, a, s, d in zip(names, done["required_gap"], done["gap_abs"], done["gap_srss"], done["gap_ddc"])
    ]
    mean = {rule: finite(np.mean(done[f"gap_{rule}"])) for rule in ("abs", "srss", "ddc")}
    curve = done.gaps()
    needed = {
        f"{percent} %": dict(zip(("gap", "low", "high"), (finite(value) for value in curve.percentile(percent))))
        for percent in (50, 84)
    }
    codes = [
        {
            "code": code,
            "clause": clause,
            "gap": None if (gap := mean[rule]) is None else gap * (aligned if align else apart),
        }
        for code, clause, rule, apart, aligned in CODES
    ]
    collapsed = [name for name, need in zip(names, done["required_gap"]) if np.isinf(need)]
    return {
        "records": per_record,
        "required": needed,
        "mean": mean,
        "floors_align": align,
        "codes": codes,
        "collapsed": collapsed,
        "warnings": list(done.warnings),
    }


def table_of(found: Mapping[str, Any]) -> str:
    """The table to print, in mm."""

    def mm(value: float | None) -> str:
        return f"{'-':>9}" if value is None else f"{1e3 * value:9.1f}"

    # The number of a sample ends its name.
    width = min(60, max(28, *(len(one["record"]) for one in found["records"])))
    lines = [f"{'record':<{width}} needed (mm)       ABS      SRSS       DDC"]
    lines += [
        f"{one['record'][:width]:<{width}}   {mm(one['required'])} {mm(one['abs'])} {mm(one['srss'])} {mm(one['ddc'])}"
        for one in found["records"]
    ]
    lines.append(
        f"{'mean of the rules':<{width}}   {'':>9} {mm(found['mean']['abs'])} {mm(found['mean']['srss'])} {mm(found['mean']['ddc'])}"
    )
    for percent, one in found["required"].items():
        lines.append(
            f"{f'enough for {percent} of records':<{width}}   {mm(one['gap'])}   (90 % band {mm(one['low']).strip()} to {mm(one['high']).strip()})"
        )
    lines.append(
        f"\n{'rule of a code, from the mean':<36} {'clause':<9} gap (mm)"
        + ("; floors align" if found["floors_align"] else "")
    )
    lines += [f"{one['code']:<36} {one['clause']:<9} {mm(one['gap'])}" for one in found["codes"]]
    if found["collapsed"]:
        lines.append(
            f"Without links {len(found['collapsed'])} of {len(found['records'])} records cause a collapse ({shortened(found['collapsed'])}): no gap is "
            "enough for them, and the rules have no mean."
        )
    return "\n".join(
        [
            *lines,
            "Displacements are those of the model, without a behaviour factor. Read the clause before you design by it.",
        ]
    )
