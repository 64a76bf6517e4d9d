"""Quantities of structures: of floors, of yielding parts and of the ends of members."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from pounding._native import core
from pounding._studies import reading
from pounding.errors import InputError

#: Largest absolute value over time of every floor or storey; a structure's is the largest of its floors.
OF_FLOORS = {
    "displacement": "m",
    "drift": "m",
    "acceleration": "m/s^2",
    "drift_ratio": "",
    "storey_shear": "N",
    "residual_drift": "m",
}
#: Quantities of yielding parts, or of the hinges among them.
OF_PARTS = {"ductility": "", "plastic_rotation": "rad"}
#: Forces at both ends of members, by component: N, Vz, My and so on.
OF_MEMBERS = {"member_force": "N"}
OF_TORSION = {"rotation": "rad", "edge_displacement": "m"}
UNITS = {**OF_FLOORS, **OF_TORSION, **OF_PARTS, **OF_MEMBERS}
#: Quantities that the kernel computes.
OF_KERNEL = ("displacement", "drift", "acceleration")
#: Quantities in the complete summary of a run only.
OF_WHOLE = ("storey_shear", "residual_drift", *OF_PARTS, *OF_MEMBERS)
Moving = core.MovingStructure


class Kind(NamedTuple):
    """Structures that have a quantity, and their parts with own columns."""

    has: Callable[[Moving], Any]
    lacking: str  #: what the quantity belongs to, and what to type instead
    noun: str = "part"  #: name of a part in messages
    parts: Callable[[Moving], Sequence[str]] = lambda one: ()


def _floors(one: Moving) -> list[str]:
    return [str(i + 1) for i in range(one.floors)]


def _ends(one: Moving) -> list[str]:
    return [f"{member}.{kind}" for member in one.members for kind in kinds_of(one.components)]


_NAMED = "name them, as in floors: [{nodes: [a, b], elevation: 3 m}]"
_OF_FLOORS = Kind(lambda one: one.floors, f"floors; {_NAMED}", "floor", _floors)
_OF_STOREYS = Kind(
    lambda one: one.floors and one.has_storeys, f"storeys; keep displacement instead, or {_NAMED}", "floor", _floors
)
_OF_TORSION = Kind(lambda one: one.has_plans, "rigid floors in space; keep displacement instead")
_KINDS = {
    "displacement": _OF_FLOORS,
    "drift": _OF_STOREYS,
    "acceleration": _OF_FLOORS,
    "drift_ratio": Kind(
        lambda one: one.heights, "storeys with heights; type storey_height, or keep drift instead", "floor", _floors
    ),
    "storey_shear": _OF_STOREYS,
    "residual_drift": Kind(
        lambda one: one.parts and one.has_storeys,
        "structures with yielding parts and storeys; keep drift instead",
        "floor",
        _floors,
    ),
    "rotation": _OF_TORSION,
    "edge_displacement": _OF_TORSION,
    "ductility": Kind(lambda one: one.parts, "yielding parts; keep drift instead", parts=lambda one: one.parts),
    "plastic_rotation": Kind(lambda one: one.hinges, "hinges; keep drift instead", parts=lambda one: one.hinges),
    "member_force": Kind(
        lambda one: one.members, "the members of a frame; keep storey_shear instead", "member or component", _ends
    ),
}


def has(quantity: str, one: Moving) -> bool:
    """True if a structure has a quantity."""
    return bool(_KINDS[quantity].has(one))


def columns_of_parts(one: Moving) -> list[str]:
    """All columns of the floors, parts and members of a structure."""
    return [
        f"{quantity}.{one.name}.{part}"
        for quantity, kind in _KINDS.items()
        if kind.has(one)
        for part in kind.parts(one)
    ]


def without_suffix(name: str) -> str:
    """A column without .alone or .ratio."""
    return name.removesuffix(".alone").removesuffix(".ratio")


def split(rest: str, structures: Iterable[str]) -> tuple[str, str]:
    """Structure, and floor, part or member, of a column without its quantity and suffix: ("left", "3"). The structure
    is empty if none matches."""
    known = [name for name in structures if rest == name or rest.startswith(name + ".")]
    name = max(known, key=len, default="")
    return name, rest[len(name) + 1 :] if name else rest


def unit_of(column: str) -> str:
    """SI unit of a column of a structure."""
    quantity = column.partition(".")[0]
    if quantity in OF_MEMBERS:
        return "N m" if without_suffix(column).rpartition(".")[2][:1] in ("M", "T") else "N"
    return UNITS[quantity]


def kinds_of(components: Sequence[str]) -> list[str]:
    """Components of end forces without the end: N, Vz, My."""
    return list(dict.fromkeys(one.partition(" ")[2] for one in components))


def columns_of(word: str, structures: Mapping[str, Moving], place: str) -> list[str]:
    """The columns of an item of `keep:` without suffixes, such as drift.left.3. Raises InputError for a quantity that
    the model does not have, with similar names."""
    quantity, _, rest = word.partition(".")
    name, inside = split(rest, structures)
    if rest and not name:
        first = rest.partition(".")[0]
        raise InputError(
            f'{place}: {word}: unknown structure "{first}", or a wall.{reading.did_you_mean(first, structures)} Known: '
            f"{', '.join(structures)}"
        )
    kind, names = _KINDS[quantity], [name] if name else list(structures)
    having = [structures[each] for each in names if kind.has(structures[each])]
    if not having:
        raise InputError(f"{place}: {quantity} belongs to {kind.lacking}; {', '.join(names)} has none")
    found: list[str] = []
    for one in having:
        known = {part: [part] for part in kind.parts(one)}
        if quantity in OF_MEMBERS:
            kinds = kinds_of(one.components)
            groups = {member: [f"{member}.{each}" for each in kinds] for member in one.members}
            known = {"": kinds, **{each: [each] for each in kinds}, **groups, **known}
        if inside and inside not in known:
            shown = f"1 (lowest) to {one.floors}" if kind.noun == "floor" else reading.shortened(list(known)) or "none"
            raise InputError(
                f'{place}: {word}: {one.name} has no {kind.noun} "{inside}".{reading.did_you_mean(inside, known)} Known: '
                f"{shown}; {quantity}.{one.name} is the largest of all"
            )
        found += [".".join(filter(None, (quantity, one.name, each))) for each in known.get(inside, [""])]
    return found


def value(column: str, summary: Mapping[str, Any]) -> float:
    """A column of a structure from the summary of a run. A ratio is NaN without motion in the run without links."""
    if column.endswith(".ratio"):
        both = value(without_suffix(column), summary), value(without_suffix(column) + ".alone", summary)
        return both[0] / both[1] if both[1] else math.nan
    quantity, _, rest = without_suffix(column).partition(".")
    name, inside = split(rest, summary["structures"])
    structure = (summary["no_pounding"]["structures"] if column.endswith(".alone") else summary["structures"])[name]
    heights = summary["structures"][name].get("storey_heights", ())
    if quantity in OF_MEMBERS:
        return _member_force(structure, inside)
    if quantity in OF_PARTS:
        found = of_parts(quantity, structure, summary["structures"][name].get("hinges", ()))
        return found.get(inside, math.nan) if inside else max(found.values(), default=math.nan)
    values = of_floors(quantity, structure, heights)
    if inside:
        return values[int(inside) - 1] if int(inside) <= len(values) else math.nan
    if quantity in OF_TORSION:  # NaN for floors that are not rigid
        values = [one for one in values if not math.isnan(one)]
    return max(values, default=math.nan)


def of_floors(quantity: str, structure: Mapping[str, Any], heights: Sequence[float]) -> list[float]:
    """[floor] a quantity of floors or storeys; empty if the structure does not have it."""
    if quantity == "drift_ratio":
        drifts = structure.get("peak_drift", ())
        return [number(drift) / height for drift, height in zip(drifts, heights)]
    if quantity == "storey_shear":
        return [largest(one) for one in _both(structure.get("envelope", {}).get("storey_shear"))]
    if quantity == "residual_drift":
        return [abs(number(one)) for one in structure.get("residual_drift", ())]
    return [number(one) for one in structure.get("peak_" + quantity, ())]


def _both(extremes: Mapping[str, Any] | None) -> list[tuple[Any, Any]]:
    """Smallest and largest values."""
    return list(zip(extremes["min"], extremes["max"])) if extremes else []


def largest(values: Any) -> float:
    """The largest absolute number of nested lists."""
    if isinstance(values, (list, tuple)):
        return max((largest(one) for one in values), default=math.nan)
    return abs(number(values))


def of_parts(quantity: str, structure: Mapping[str, Any], hinges: Iterable[str]) -> dict[str, float]:
    """A quantity of all yielding parts, or of hinges, by name."""
    springs = structure.get("yielding", {}).get("springs", ())
    if quantity == "ductility":
        return {one["name"]: number(one["ductility"]) for one in springs}
    among = set(hinges)
    return {one["name"]: number(one["plastic"]) for one in springs if one["name"] in among}


def _member_force(structure: Mapping[str, Any], inside: str) -> float:
    envelope = structure["envelope"]
    member, _, kind = inside.rpartition(".")
    places = [j for j, one in enumerate(envelope["components"]) if one.partition(" ")[2] == kind]
    forces = _both(envelope["member_force"])
    rows = [envelope["members"].index(member)] if member else range(len(forces))
    return max((largest([forces[i][0][j], forces[i][1][j]]) for i in rows for j in places), default=math.nan)


def number(given: float | None) -> float:
    """The number; NaN for null."""
    return math.nan if given is None else float(given)
