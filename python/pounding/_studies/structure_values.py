"""Quantities of structures: of floors, of yielding parts and of the ends of members."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

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
SUFFIXES = (".alone", ".ratio")


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


def columns_of(word: str, structures: Mapping[str, core.MovingStructure], place: str) -> list[str]:
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
    among = [one for one in structures.values() if name in ("", one.name)]
    having = [one for one in among if _has(quantity, one)]
    if not having:
        raise InputError(f"{place}: {_lacking(quantity, name or ', '.join(structures), among)}")
    found: list[str] = []
    for one in having:
        if quantity in OF_MEMBERS:
            found += _of_members(word, one, inside, place)
        else:
            if inside:
                _require_inside(quantity, inside, one, f"{place}: {word}")
            found.append(f"{quantity}.{one.name}" + (f".{inside}" if inside else ""))
    return found


def _has(quantity: str, one: core.MovingStructure) -> bool:
    if quantity in OF_TORSION:
        return one.has_plans
    if quantity == "residual_drift":
        return bool(one.parts) and one.has_storeys
    if quantity == "drift_ratio":
        return bool(one.heights)
    if quantity in OF_PARTS:
        return bool(one.parts if quantity == "ductility" else one.hinges)
    if quantity in OF_MEMBERS:
        return bool(one.members)
    return bool(one.floors) and (one.has_storeys or quantity not in ("drift", "storey_shear"))


def _lacking(quantity: str, names: str, among: Sequence[core.MovingStructure]) -> str:
    if quantity in OF_TORSION:
        return f"{quantity} is that of rigid floors in space, and {names} has none; keep displacement instead"
    if quantity == "residual_drift":
        return f"residual_drift is that of structures with yielding parts and storeys, and {names} has none; keep drift instead"
    if quantity == "drift_ratio":
        return f"drift_ratio is the drift divided by the height of the storey, and the heights of {names} are unknown; type storey_height, or keep drift instead"
    if quantity in OF_PARTS:
        what = "yielding parts" if quantity == "ductility" else "hinges"
        return f"{quantity} is that of {what}, and {names} has none; keep drift instead"
    if quantity in OF_MEMBERS:
        return f"member_force is that of the members of a frame, and {names} has none; keep storey_shear instead"
    if quantity in ("drift", "storey_shear") and all(one.floors for one in among):
        return f"{quantity} is that of storeys, and {names} has no storeys; keep displacement instead"
    return f"{quantity} is that of floors, and {names} has none; name them, as in floors: [{{nodes: [a, b], elevation: 3 m}}]"


def _require_inside(quantity: str, inside: str, one: core.MovingStructure, place: str) -> None:
    """Raises InputError for an unknown floor or part."""
    if quantity in OF_PARTS:
        known = one.parts if quantity == "ductility" else one.hinges
        if inside not in known:
            raise InputError(
                f'{place}: {one.name} has no part "{inside}".{reading.did_you_mean(inside, known)} Known: {reading.shortened(known)}'
            )
    elif quantity in OF_TORSION:
        raise InputError(f"{place}: {quantity} is the largest of all floors; type {quantity}.{one.name}")
    elif not inside.isdecimal() or not 1 <= int(inside) <= one.floors or str(int(inside)) != inside:
        raise InputError(
            f'{place}: {one.name} has no floor "{inside}"; its floors count from 1 at the lowest to {one.floors}'
        )


def _of_members(word: str, one: core.MovingStructure, inside: str, place: str) -> list[str]:
    kinds = kinds_of(one.components)
    if not inside:
        return [f"member_force.{one.name}.{kind}" for kind in kinds]
    if inside in kinds:
        return [f"member_force.{one.name}.{inside}"]
    member, _, kind = inside.rpartition(".")
    if inside in one.members:
        return [f"member_force.{one.name}.{inside}.{each}" for each in kinds]
    if member in one.members and kind in kinds:
        return [f"member_force.{one.name}.{inside}"]
    if member in one.members:
        raise InputError(
            f'{place}: {word}: unknown component "{kind}" of {member}.{reading.did_you_mean(kind, kinds)} Known: {", ".join(kinds)}'
        )
    near = inside if inside.rpartition(".")[2] not in kinds else member
    raise InputError(
        f'{place}: {word}: {one.name} has no member "{near}".{reading.did_you_mean(near, one.members)} Known: '
        f"{reading.shortened(one.members)}; components: {', '.join(kinds)}"
    )


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
