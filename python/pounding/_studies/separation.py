"""`pounding separation`: the required gap of a model under its records, compared with the rules of codes."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _yaml_text as yaml_text
from pounding._adjacent import SAME_ELEVATION, Building, Neighbours, Site, read_site
from pounding._arguments import takes
from pounding._codes import BRIDGES, chosen
from pounding._codes.evaluate import Conditions, Level, Side, evaluate, factor_for_alignment
from pounding._codes.rule import Rule
from pounding._native import core
from pounding._studies import reading
from pounding._studies.gaps import GapCurve, records_for_band
from pounding._studies.percentiles import finite
from pounding._studies.plan import Plan, plan_of, read_given
from pounding._studies.study import records_folder, run_plan
from pounding._studies.study_table import Study
from pounding.errors import ImplausibleWarning, InputError, SolverError
from pounding.models import check

#: Keys of `study:` that a separation uses; `keep` and `without_links` add columns that are not printed.
_USED = (
    "seed",
    "factors",
    "sampling",
    "records",
    "intensity",
    "engine",
    "stop_after",
    "keep",
    "without_links",
    "separation",
)
_GAPS = ("required_gap", "gap_abs", "gap_srss", "gap_ddc")
#: Columns of every link.
_OF_LINKS = ("required_gap", "end_left", "end_right")
#: Percentages of records for which a gap is always reported.
_PERCENT = (50.0, 84.0)


@dataclass(frozen=True)
class Request:
    """What a separation reports besides the required gaps."""

    keys: Mapping[str, Any]  #: of `study.separation`, in SI
    percent: tuple[float, ...] = ()  #: further quantiles of the required gap [%]
    probability: tuple[float, ...] = ()  #: target probabilities of contact [%]

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The chosen codes."""
        given = self.keys.get("codes", ())
        return chosen([given] if isinstance(given, str) else list(given))

    def inputs(self, structure: str) -> dict[str, Any]:
        """Inputs of the codes for one structure."""
        general = dict(self.keys.get("behaviour") or {})
        own = (self.keys.get("structures") or {}).get(structure) or {}
        return {**general, **own, "steel": bool(general.get("steel") or own.get("steel"))}


def read_separation(
    path: str | PathLike[str],
    records: Sequence[str | PathLike[str]] | None = None,
    given_keys: Mapping[str, Any] | None = None,
    percent: Sequence[float] = (),
    probability: Sequence[float] = (),
) -> tuple[Plan, Request]:
    """The plan of a separation from the file of a model or study, and what it reports.

    `records` replace those of the file, `given_keys` keys of its `study.separation`. Raises InputError, also for keys
    that a separation does not use."""
    given = read_given(path)
    if not given.model.links:
        check(given.model)
        raise InputError(
            f"{path}: a separation needs at least one link, for the floors that can touch; its law is not used"
        )
    one = dict(given.keys or {})
    for key in one:
        if key not in _USED:
            raise InputError(
                f"{path}: study.{key}: a separation does not use it; leave it out, or type pounding study {path}"
            )
    request = _request(path, dict(one.pop("separation", None) or {}), given_keys or {}, percent, probability)
    keep = one.get("keep") or []
    used: dict[str, Any] = {"stop_after": "100 %", **one}
    if records:
        used["records"] = {"files": [fspath(Path(one).resolve()) for one in records]}
    kept = [*([keep] if isinstance(keep, str) else keep), *_GAPS]
    plan = plan_of(replace(given, keys={**used, "keep": kept}), records_folder(Path(Path(path).name)))
    plan = _with_ends(plan)
    _require_structures(path, request, plan)
    _require_one_gap(path, plan)
    return plan, request


def _with_ends(plan: Plan) -> Plan:
    """The plan with the columns of every link."""
    of_links = [f"{quantity}.{link.name}" for link in _site(plan).links for quantity in _OF_LINKS]
    kept = plan.template.kept
    columns = tuple(dict.fromkeys((*kept.columns, *of_links)))
    return replace(plan, template=replace(plan.template, kept=replace(kept, columns=columns)))


def _request(
    path: str | PathLike[str],
    own: dict[str, Any],
    given: Mapping[str, Any],
    percent: Sequence[float],
    probability: Sequence[float],
) -> Request:
    behaviour = {**(own.get("behaviour") or {}), **(given.get("behaviour") or {})}
    structures = {
        name: {**((own.get("structures") or {}).get(name) or {}), **((given.get("structures") or {}).get(name) or {})}
        for name in {**(own.get("structures") or {}), **(given.get("structures") or {})}
    }
    merged = {**own, **{key: value for key, value in given.items() if value is not None}}
    merged |= {"behaviour": behaviour} if behaviour else {}
    merged |= {"structures": structures} if structures else {}
    try:
        keys = reading.read_study(yaml_text.plain({"separation": merged})).get("separation", {})
        request = Request(keys, tuple(percent), tuple(probability))
        _ = request.rules
    except InputError as error:
        raise InputError(f"{path}: study.separation: {error}") from None
    return request


def _require_structures(path: str | PathLike[str], request: Request, plan: Plan) -> None:
    known = [str(name) for name in plan.template.model["structures"]]
    for name in request.keys.get("structures") or {}:
        if name not in known:
            raise InputError(
                f'{path}: study.separation.structures: unknown structure "{name}".{reading.did_you_mean(name, known)} '
                f"Known: {', '.join(known)}"
            )


def _require_one_gap(path: str | PathLike[str], plan: Plan) -> None:
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


def _percentages(name: str, value: Any) -> tuple[float, ...]:
    """Percentages as numbers or texts such as "95 %", one or several."""
    return tuple(
        percentage(name, one) for one in ([value] if isinstance(value, (str, int, float)) or value is None else value)
    )


def percentage(name: str, value: Any) -> float:
    """A percentage between 0 and 100 from a text such as "95 %" or 0.95. Raises InputError."""
    try:
        found = 100 * float(core.quantity(str(value), ""))
    except InputError:
        found = math.nan
    if not 0 < found < 100:
        raise InputError(f'{name}: takes a percentage above 0 % and below 100 %, such as "95 %"; {value} was read')
    return found


def _mapping(name: str, value: Any) -> dict[str, Any]:
    """A map of keys."""
    return dict(arguments.mapping(name, value))


@takes(
    model=arguments.file,
    records=arguments.optional(arguments.files),
    workers=arguments.optional(arguments.whole(0)),
    quantile=arguments.optional(_percentages),
    probability=arguments.optional(_percentages),
    keys=arguments.optional(_mapping),
)
def separation(
    model: str | PathLike[str],
    records: Sequence[str | PathLike[str]] | None = None,
    workers: int | None = None,
    *,
    quantile: Any = None,
    probability: Any = None,
    keys: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Required gap of every record, gaps by rules, and gaps by codes at every level [m].

    Parameters
    ----------
    model : str or os.PathLike
        File of a model or study.
    records : sequence, optional
        Files of records instead of those of the file.
    workers : int, optional
        Number of processes; 0 runs in this process.
    quantile : str, float or sequence, optional
        Further quantiles of the required gap ("95 %").
    probability : str, float or sequence, optional
        Target probabilities of contact ("10 %"), for which to compute the gap.
    keys : mapping, optional
        Keys that replace those of `study.separation`, such as {"property": "line"}.

    Returns
    -------
    dict of str to object
        A gap is None if structures collapse without links, when no gap is sufficient, or if an input of a code is
        missing.

    Raises
    ------
    InputError
        The plan is wrong.
    SolverError
        A record fails.

    Warns
    -----
    ImplausibleWarning
        A value is implausible.

    Examples
    --------
    >>> pounding.separation("model.yaml", workers=0)["percentiles"]  # doctest: +SKIP
    """
    plan, request = read_separation(model, records, keys, quantile or (), probability or ())
    for doubt in plan.warnings:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
    return run_separation(plan, request, workers)


def run_separation(plan: Plan, request: Request, workers: int | None = None) -> dict[str, Any]:
    """Same as `separation`, for a plan."""
    done = run_plan(plan, None, workers=0 if plan.count < 4 and workers is None else workers, progress=None)
    if done.failed:
        raise SolverError(next(iter(done.failed.values())))
    return _found(done, _site(plan), request)


def _site(plan: Plan) -> Site:
    """Structures and links of the model of the first row."""
    files = {**plan.template.files, **plan.files_of(np.array([0]))}
    return read_site(core.Source(plan.yaml(0), plan.template.place, files))


def _found(done: Study, site: Site, request: Request) -> dict[str, Any]:
    names = [str(done.records["name"][record]) for record in done["record"]]
    if done["point"].max() > 0:
        names = [f"{name}, sample {point}" for name, point in zip(names, done["point"])]
    per_record = [
        {"record": name, "required": finite(need), "abs": finite(a), "srss": finite(s), "ddc": finite(d)}
        for name, need, a, s, d in zip(names, done["required_gap"], done["gap_abs"], done["gap_srss"], done["gap_ddc"])
    ]
    curve = done.gaps()
    aligned = [_is_aligned(pair, request) for pair in site.pairs]
    return {
        "records": per_record,
        "required": {f"{one:g} %": _quantile(curve, one) for one in (*_PERCENT, *request.percent)},
        "contact": {f"{one:g} %": _quantile(curve, 100 - one) for one in request.probability},
        "mean": {rule: finite(np.mean(done[f"gap_{rule}"])) for rule in ("abs", "srss", "ddc")},
        "floors_align": all(one is True for one in aligned),
        "property": request.keys.get("property", "same"),
        "displacements": request.keys.get("displacements", "nonlinear"),
        "levels": [_level(done, link) for link in site.links],
        "codes": [_of_code(rule, done, site, request) for rule in request.rules],
        "collapsed": [name for name, need in zip(names, done["required_gap"]) if np.isinf(need)],
        "bridges": BRIDGES,
        "warnings": list(done.warnings),
    }


def _quantile(curve: GapCurve, percent: float) -> dict[str, Any]:
    """A quantile of the required gap with its 90 % band, and the number of records that a finite band needs."""
    gap, low, high = (finite(value) for value in curve.percentile(percent))
    return {"gap": gap, "low": low, "high": high, "records_for_band": records_for_band(percent)}


def _level(done: Study, link: Any) -> dict[str, Any]:
    ends = {side: done[f"end_{side}.{link.name}"] for side in ("left", "right")}
    required = done[f"required_gap.{link.name}"]
    return {
        "link": link.name,
        "height": link.elevation,
        "gap": link.gap,
        "required": finite(required.max()),
        **{f"{side}_mean": finite(np.mean(values)) for side, values in ends.items()},
        **{f"{side}_largest": finite(values.max()) for side, values in ends.items()},
    }


def _is_aligned(pair: Neighbours, request: Request) -> bool | None:
    """True if the floors of a pair are at equal elevations; None if that is unknown."""
    if given := request.keys.get("floors"):
        return bool(given == "aligned")
    return None if pair.offset is None else pair.offset <= SAME_ELEVATION


def _of_code(rule: Rule, done: Study, site: Site, request: Request) -> dict[str, Any]:
    count = len(np.unique(done["record"]))
    uses_mean = rule.statistic.mean_from is not None and count >= rule.statistic.mean_from
    doubts = []
    if rule.combination and count < rule.statistic.least:
        doubts.append(f"{count} of at least {rule.statistic.least} records")
    pairs = [_of_pair(rule, pair, done, request, uses_mean) for pair in site.pairs]
    gaps = [pair["gap"] for pair in pairs]
    applied = f"{'mean' if uses_mean else 'largest'} of {count}" if rule.combination else "heights"
    return {
        "code": rule.name,
        "clause": rule.clause,
        "verified": rule.verified,
        "mark": rule.mark,
        "source": rule.source,
        "statistic": applied,
        "statistic_of_code": f"{rule.statistic.text} ({rule.statistic.source})",
        "gap": None if None in gaps else max(gaps, default=None),
        "pairs": pairs,
        "warnings": doubts,
        "notes": list(rule.notes),
    }


def _of_pair(rule: Rule, pair: Neighbours, done: Study, request: Request, uses_mean: bool) -> dict[str, Any]:
    aligned = _is_aligned(pair, request)
    conditions = Conditions(
        aligned is True,
        bool(request.keys.get("similar")),
        str(request.keys.get("property", "same")),
        str(request.keys.get("displacements", "nonlinear")),
    )
    statistic = np.mean if uses_mean else np.max
    levels = []
    for link in pair.links:
        left, right = (float(statistic(done[f"end_{side}.{link.name}"])) for side in ("left", "right"))
        if link.left.structure != pair.left.name:
            left, right = right, left
        levels.append(Level(link.name, left, right, link.elevation))
    sides = _side(pair.left, request), _side(pair.right, request)
    found = evaluate(rule, *sides, levels, conditions)
    has_walls = pair.left.rigid or pair.right.rigid
    assumed = aligned is None and rule.aligned != rule.offset and conditions.property == "same" and not has_walls
    if found["missing"] in reading.EXAMPLES["behaviour"]:
        found["missing"] = _typed(_missing_inputs(rule, sides, levels, conditions), sides)
    elif found["missing"] and not found["missing"].startswith("the code"):
        found["missing"] = f"needs {found['missing']}"
    return {
        **found,
        "aligned": aligned,
        "factor": factor_for_alignment(rule, conditions) if conditions.property == "same" else 1.0,
        "available": pair.gap,
        "note": "elevations of the floors unknown, taken as offset; type floors: aligned if they align"
        if assumed
        else "",
    }


def _missing_inputs(rule: Rule, sides: tuple[Side, Side], levels: list[Level], conditions: Conditions) -> list[str]:
    """All inputs that a rule lacks, by evaluating it with examples in their place."""
    missing: list[str] = []
    texts = {"zone": "III", "system": "frame", "intensity": 8}
    while True:
        examples = {key: texts.get(key, 1.0) for key in missing}
        left, right = (replace(side, inputs={**examples, **side.inputs}) for side in sides)
        key = evaluate(rule, left, right, levels, conditions)["missing"]
        if key not in reading.EXAMPLES["behaviour"]:
            return missing
        missing.append(key)


def _typed(missing: Sequence[str], sides: Sequence[Side]) -> str:
    """The options to type for missing inputs, of one structure if the other has them."""
    examples = reading.EXAMPLES["behaviour"]
    lacking = {key: [side.name for side in sides if side.inputs.get(key) is None] for key in missing}
    names = {key: f"{ones[0]}.{key}" if len(ones) == 1 else key for key, ones in lacking.items()}
    options = " ".join(f"--set {names[key]}={examples[key].replace(' ', '')}" for key in missing)
    return f"type {options}, or {', '.join(missing)} in study.separation.behaviour"


def _side(one: Building, request: Request) -> Side:
    return Side(one.name, request.inputs(one.name), one.height, one.storeys, one.rigid)
