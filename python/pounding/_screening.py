"""`pounding screen`: the gaps of a model by rules for existing buildings, without a run."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Any

from pounding import _arguments as arguments
from pounding._adjacent import SAME_ELEVATION, Neighbours, Site, read_site
from pounding._arguments import takes
from pounding._codes.screening import ASCE_41, COLE, FEMA_P154, NOT_ASSESSED, NZSEE, SEISMICITIES
from pounding._studies.plan import read_given
from pounding.errors import InputError
from pounding.models import Model

_MARK = "check the edition"


@takes(seismicity=arguments.one_of(SEISMICITIES))
def screen(model: Model | str | PathLike[str], seismicity: str = "high") -> dict[str, Any]:
    """Screens every pair of neighbours by rules for existing buildings, without a run.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A model, or the name of its file.
    seismicity : str
        "low", "moderate", "moderately_high", "high" or "very_high".

    Returns
    -------
    dict of str to object
        "pairs": for each pair its checks, with value, limit and verdict ("critical", "passes", "unknown" or "not
        assessed"), and a sentence.

    Raises
    ------
    InputError
        The model is wrong or has no links.

    Examples
    --------
    >>> found = pounding.screen("examples/19_yielding_pair/model.yaml")
    >>> sorted(found["pairs"][0])[:3]
    ['checks', 'floor_offset', 'gap']
    """
    given = model if isinstance(model, Model) else read_given(arguments.file("model", model)).model
    site = read_site(given._source())
    if not site.pairs:
        raise InputError(
            f"{given._file or 'model'}: a screening needs at least one link, for the floors that can touch"
        )
    buildings = [pair for pair in site.pairs if pair.left.masses and pair.right.masses]
    others = [f"{pair.left.name}-{pair.right.name}" for pair in site.pairs if pair not in buildings]
    pairs = [_screened(pair, site, seismicity) for pair in buildings]
    return {"seismicity": seismicity, "mark": _MARK, "pairs": pairs, "not_screened": others}


def _screened(pair: Neighbours, site: Site, seismicity: str) -> dict[str, Any]:
    checks = [*_fema(pair, site, seismicity), *_asce(pair, seismicity), *_nzsee(pair), *_cole(pair, site)]
    checks += [_check("all", text, None, None, None) for text in NOT_ASSESSED]
    critical = [one for one in checks if one["verdict"] == "critical"]
    name = f"{pair.left.name}-{pair.right.name}"
    return {
        "left": pair.left.name,
        "right": pair.right.name,
        "gap": pair.gap,
        "lower_height": pair.lower_height,
        "storeys": [pair.left.storeys, pair.right.storeys],
        "floor_offset": pair.offset,
        "checks": checks,
        "summary": _summary(name, pair, critical, [one for one in checks if one["verdict"] == "unknown"]),
    }


def _check(rule: str, criterion: str, value: Any, limit: Any, critical: bool | None, unit: str = "") -> dict[str, Any]:
    """A criterion; `critical` None: unknown for a rule of the model, not assessed for the rule "all"."""
    verdict = (
        "not assessed" if rule == "all" else "unknown" if critical is None else "critical" if critical else "passes"
    )
    return {"rule": rule, "criterion": criterion, "value": value, "limit": limit, "unit": unit, "verdict": verdict}


def _below(value: float | None, limit: float | None) -> bool | None:
    # Gaps of drawings have round-off.
    return None if value is None or limit is None else value < limit * (1 - 1e-9)


def _above(value: float | None, limit: float) -> bool | None:
    return None if value is None else value > limit * (1 + 1e-9)


def _lower_storeys(pair: Neighbours) -> int:
    """Storeys of the lower building; the smaller number if heights are unknown."""
    left, right = pair.left, pair.right
    if left.height is None or right.height is None or abs(left.height - right.height) <= SAME_ELEVATION:
        return min(len(left.masses), len(right.masses))
    return len((left if left.height < right.height else right).masses)


def _fema(pair: Neighbours, site: Site, seismicity: str) -> Iterator[dict[str, Any]]:
    rule: Any = FEMA_P154
    width = rule["width_per_storey"][seismicity] * _lower_storeys(pair)
    offset = _above(pair.offset, rule["floor_offset"])
    taller = abs(len(pair.left.masses) - len(pair.right.masses))
    ends = ends_of_rows(pair, site, rule["row"])
    narrow = bool(_below(pair.gap, width))
    further = [offset, taller >= rule["storeys_taller"], bool(ends)]
    both = narrow and (True if True in further else None if None in further else False)
    yield _check(rule["name"], "gap below the width per storey", pair.gap, width, narrow, "m")
    yield _check(rule["name"], "floors not aligned", pair.offset, rule["floor_offset"], offset, "m")
    yield _check(rule["name"], "storeys taller", taller, rule["storeys_taller"], taller >= rule["storeys_taller"])
    yield _check(rule["name"], f"end of a row of {rule['row']} or more", ", ".join(ends) or "none", "none", bool(ends))
    yield _check(rule["name"], "pounding counts: gap and a further condition", None, None, both)


def _asce(pair: Neighbours, seismicity: str) -> Iterator[dict[str, Any]]:
    rule: Any = ASCE_41
    height = pair.lower_height
    limit = None if height is None else rule["fraction"][seismicity] * height
    yield _check(rule["name"], "gap below a fraction of the height", pair.gap, limit, _below(pair.gap, limit), "m")


def _nzsee(pair: Neighbours) -> Iterator[dict[str, Any]]:
    rule: Any = NZSEE
    height, offset = pair.lower_height, pair.offset
    if height is None or offset is None:
        yield _check(rule["name"], "factor D", None, 1.0, None)
        return
    ratio = pair.gap / height
    column = 0 if _below(ratio, rule["severe"]) else 1 if _below(ratio, rule["significant"]) else 2
    storey = min(height_of for one in (pair.left, pair.right) for height_of in _storey_heights(one.elevations))
    aligned = not _above(offset, rule["alignment"] * storey)
    taller = abs(len(pair.left.masses) - len(pair.right.masses))
    d1 = rule["aligned" if aligned else "offset"][column]
    d2 = next(factors for above, factors in rule["height"] if taller > above)[column]
    yield _check(rule["name"], "gap / height", ratio, rule["significant"], column < 2)
    yield _check(rule["name"], "floors not aligned", offset, rule["alignment"] * storey, not aligned, "m")
    yield _check(rule["name"], "factor D1 of aligned floors", d1, 1.0, d1 < 1)
    yield _check(rule["name"], "factor D2 of heights", d2, 1.0, d2 < 1)


def _storey_heights(elevations: tuple[float, ...]) -> list[float]:
    return [above - below for below, above in itertools.pairwise((0.0, *elevations))]


def _cole(pair: Neighbours, site: Site) -> Iterator[dict[str, Any]]:
    rule: Any = COLE
    meets = "floor against column" if pair.hits_columns else "floor against floor"
    yield _check(rule["name"], "floors hit columns", meets, "floor against floor", pair.hits_columns)
    facing = min(len(pair.left.masses), len(pair.right.masses))
    ratio = max(max(a / b, b / a) for a, b in zip(pair.left.masses[:facing], pair.right.masses[:facing]))
    yield _check(rule["name"], "mass ratio of floors", ratio, rule["mass_ratio"], _above(ratio, rule["mass_ratio"]))
    heights = None
    if pair.left.height is not None and pair.right.height is not None:
        heights = max(pair.left.height, pair.right.height) / min(pair.left.height, pair.right.height)
    yield _check(rule["name"], "height ratio", heights, rule["height_ratio"], _above(heights, rule["height_ratio"]))
    ends = ends_of_rows(pair, site, 3)
    yield _check(rule["name"], "end of a row", ", ".join(ends) or "none", "none", bool(ends))


def ends_of_rows(pair: Neighbours, site: Site, count: int) -> list[str]:
    """Structures of a pair at the end of a row of at least `count` structures along the axis of the pair."""
    axis = site.axes[pair.left.name, pair.right.name]
    neighbours: dict[str, set[str]] = {}
    for one in site.pairs:
        if site.axes[one.left.name, one.right.name] == axis and one.left.masses and one.right.masses:
            neighbours.setdefault(one.left.name, set()).add(one.right.name)
            neighbours.setdefault(one.right.name, set()).add(one.left.name)
    row, waiting = set(), [pair.left.name]
    while waiting:
        name = waiting.pop()
        if name not in row:
            row.add(name)
            waiting += neighbours[name]
    if len(row) < count:
        return []
    return [one.name for one in (pair.left, pair.right) if len(neighbours[one.name]) == 1]


def _summary(name: str, pair: Neighbours, critical: list[Any], unknown: list[Any]) -> str:
    if not critical and not unknown:
        return f"{name}: {1e3 * pair.gap:.0f} mm pass every rule that the model decides."
    text = f"{name}: {1e3 * pair.gap:.0f} mm"
    limits = [one for one in critical if one["unit"] == "m" and one["criterion"].startswith("gap")]
    if limits:
        text += " is less than " + ", ".join(f"{1e3 * one['limit']:.0f} mm ({one['rule']})" for one in limits)
    others = list(dict.fromkeys(one["criterion"] for one in critical if one not in limits))
    if others:
        text += f"{';' if limits else ':'} {', '.join(others)}"
    if unknown:
        text += f"; unknown without heights of the floors: {', '.join(one['criterion'] for one in unknown)}"
    return text + "."


def table_of(found: Mapping[str, Any]) -> str:
    """The table to print."""
    lines = [f"screening for {found['seismicity'].replace('_', ' ')} seismicity; {found['mark']} of every rule"]
    for pair in found["pairs"]:
        offset = "unknown" if pair["floor_offset"] is None else f"{1e3 * pair['floor_offset']:.0f} mm"
        lines.append(
            f"\n{pair['left']}-{pair['right']}: gap {1e3 * pair['gap']:.1f} mm, {pair['storeys'][0]} and "
            f"{pair['storeys'][1]} storeys, floors up to {offset} apart"
        )
        lines.append(f"{'rule':<26} {'criterion':<46} {'value':>20} {'limit':>20}  verdict")
        lines += [
            f"{one['rule']:<26} {one['criterion']:<46} {_text(one['value'], one['unit']):>20} {_text(one['limit'], one['unit']):>20}  {one['verdict']}"
            for one in pair["checks"]
        ]
        lines.append(pair["summary"])
    if found["not_screened"]:
        lines.append(f"\nnot screened, since one of them has no floors: {', '.join(found['not_screened'])}")
    return "\n".join(lines)


def _text(value: Any, unit: str) -> str:
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    return f"{1e3 * value:.1f} mm" if unit == "m" else f"{value:.4g}"
