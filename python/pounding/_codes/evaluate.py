"""Gaps by the rules of codes, from displacements of two neighbouring structures at their levels."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pounding._codes.rule import Missing, Place, Rule


@dataclass(frozen=True)
class Side:
    """One of two neighbouring structures."""

    name: str
    inputs: Mapping[str, Any]  #: keys of `behaviour`
    height: float | None = None  #: [m]
    storeys: int | None = None
    rigid: bool = False  #: a wall, without displacement


@dataclass(frozen=True)
class Level:
    """Two facing points, with the statistic of their displacements."""

    link: str
    left: float  #: displacement [m]
    right: float
    height: float | None = None  #: above the ground [m]


@dataclass(frozen=True)
class Conditions:
    """Conditions of a rule for a pair."""

    aligned: bool = False  #: floors at equal elevations
    similar: bool = False  #: similar structure and height
    property: str = "same"  #: or "line"
    displacements: str = "nonlinear"  #: "nonlinear", "elastic" or "reduced"


def evaluate(rule: Rule, left: Side, right: Side, levels: Sequence[Level], conditions: Conditions) -> dict[str, Any]:
    """Gap of a pair at every level, and the largest one [m]; the setback of each structure with a property line.

    The gap is None if displacements are infinite, or if an input is missing, which is named by `missing`."""
    found: dict[str, Any] = {"left": left.name, "right": right.name, "gap": None, "levels": [], "missing": ""}
    if conditions.property == "line" and not rule.line:
        return {**found, "missing": "the code has no rule for a property line"}
    heights = [side.height for side in (left, right) if side.height is not None and not side.rigid]
    lower = min(heights) if heights else None
    try:
        for level in levels:
            places = [
                Place(level.height, side.inputs, conditions.aligned, lower, side.height, side.storeys)
                for side in (left, right)
            ]
            found["levels"].append(_at(rule, (left, right), places, level, conditions))
    except Missing as missing:
        return {**found, "levels": [], "missing": missing.key}
    if found["levels"] and all(math.isfinite(one["gap"]) for one in found["levels"]):
        governing = max(found["levels"], key=lambda one: float(one["gap"]))
        found |= {"gap": governing["gap"], "governs": governing["link"]}
        if conditions.property == "line":
            found["setbacks"] = {
                left.name: max(one["setbacks"][0] for one in found["levels"]),
                right.name: max(one["setbacks"][1] for one in found["levels"]),
            }
    for one in found["levels"]:
        one.update({key: None for key in ("gap", "left", "right") if not math.isfinite(one[key])})
    return found


def factor_for_alignment(rule: Rule, conditions: Conditions) -> float:
    """The factor on the combination for these floors."""
    reduces = conditions.aligned and (conditions.similar or not rule.only_similar)
    return rule.aligned if reduces else rule.offset


def _at(
    rule: Rule, sides: Sequence[Side], places: Sequence[Place], level: Level, conditions: Conditions
) -> dict[str, Any]:
    own = [
        0.0 if side.rigid or not rule.combination else _own(rule, place, displacement, conditions)
        for side, place, displacement in zip(sides, places, (level.left, level.right))
    ]
    minimum = 0.0 if rule.minimum is None else rule.minimum(_moving(sides, places))
    one = {"link": level.link, "height": level.height, "left": level.left, "right": level.right}
    if conditions.property == "line":
        setbacks = [
            0.0 if side.rigid else _setback(rule, place, value, minimum)
            for side, place, value in zip(sides, places, own)
        ]
        gap = max(setbacks) if rule.line in ("unknown", "width") else max(math.fsum(setbacks), minimum)
        return {**one, "gap": gap, "setbacks": setbacks}
    both = math.hypot(*own) if rule.combination == "srss" else math.fsum(own)
    return {**one, "gap": max(factor_for_alignment(rule, conditions) * both, minimum)}


def _moving(sides: Sequence[Side], places: Sequence[Place]) -> Place:
    """The place of the first structure that is not a wall."""
    return next((place for side, place in zip(sides, places) if not side.rigid), places[0])


def _own(rule: Rule, place: Place, displacement: float, conditions: Conditions) -> float:
    """Displacement of a structure with its factor and its addition."""
    if rule.storeys_by_height and rule.added and place.known("storeys") <= rule.storeys_by_height:
        return rule.added(place)
    factor = rule.factor(place) if rule.factor and conditions.displacements == "reduced" else 1.0
    added = rule.added(place) if rule.added and not rule.storeys_by_height else 0.0
    own = factor * displacement + added
    return max(own, rule.line_minimum(place)) if rule.line_minimum and rule.line == "own" else own


def _setback(rule: Rule, place: Place, own: float, minimum: float) -> float:
    if rule.line == "unknown":
        return max(rule.offset * math.hypot(own, own), minimum)
    if rule.line == "half":
        return max(rule.offset * own, minimum / 2)
    if rule.line == "width":
        return rule.line_minimum(place) if rule.line_minimum else 0.0
    return own
