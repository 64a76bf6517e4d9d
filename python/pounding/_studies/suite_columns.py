"""All columns of a suite: every floor, member, yielding part and link."""

from __future__ import annotations

from typing import Any

from pounding._native import core
from pounding._studies.quantities import OF_LINKS, OF_OPENINGS
from pounding._studies.structure_values import OF_FLOORS, kinds_of


def contents(layout: core.Layout) -> dict[str, Any]:
    """Structures with their floors, members and parts, and links with their quantities, for the table."""
    structures = [
        {
            "name": one.name,
            "floors": one.floors,
            "heights": list(one.heights),
            "quantities": [quantity for quantity in OF_FLOORS if _has(quantity, one)],
            "members": list(one.members),
            "components": kinds_of(one.components),
            "parts": list(one.parts),
            "hinges": list(one.hinges),
        }
        for one in layout.structures
    ]
    links = [
        {
            "name": name,
            "quantities": [quantity for quantity in (*OF_LINKS, *OF_OPENINGS) if quantity != "force" or not is_rigid],
        }
        for name, is_rigid in layout.links
    ]
    return {"structures": structures, "links": links}


def _has(quantity: str, one: core.MovingStructure) -> bool:
    if quantity == "drift_ratio":
        return bool(one.heights)
    if quantity == "residual_drift":
        return bool(one.parts) and one.has_storeys
    return bool(one.floors) and (one.has_storeys or quantity in ("displacement", "acceleration"))


def every_column(layout: core.Layout, without_links: bool) -> tuple[str, ...]:
    """The columns of a suite; with those of the run without links if `without_links`."""
    found: list[str] = []
    every = contents(layout)
    for one in every["structures"]:
        name = one["name"]
        own = [f"{quantity}.{name}.{i + 1}" for quantity in one["quantities"] for i in range(one["floors"])]
        own += [f"ductility.{name}.{part}" for part in one["parts"]]
        own += [f"plastic_rotation.{name}.{part}" for part in one["hinges"]]
        own += [f"member_force.{name}.{member}.{kind}" for member in one["members"] for kind in one["components"]]
        found += own + ([f"{column}.alone" for column in own] if without_links else [])
    found += [f"{quantity}.{link['name']}" for link in every["links"] for quantity in link["quantities"]]
    if without_links and every["links"]:
        found.append("required_gap")
    return tuple(found)
