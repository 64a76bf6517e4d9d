"""OpenSees members with plastic lengths at their ends: forceBeamColumn with HingeRadau."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from pounding._opensees.materials import Material, read_material
from pounding._opensees.printed import PRINTED, Printed
from pounding._opensees.springs import Ask, End, plastic
from pounding.errors import InputError

#: Its type in the printed model.
HINGE_MEMBER = "ForceBeamColumn2d"


def read_hinge_member(
    printed: Printed, element: Mapping[str, Any], nodes: Mapping[int, Sequence[float]], ask: Ask
) -> tuple[dict[str, float], list[End]]:
    """E, A and Iz of the member between its hinges, and the hinges. They represent the plastic lengths exactly, since
    the four inner points of HingeRadau are elastic. Raises InputError for other integrations and sections."""
    tag, integration, sections = element["name"], element["integration"], element["sections"]
    if integration["type"] != "HingeRadau" or len(sections) != 6:
        raise InputError(
            f"element {tag}: its integration {integration['type']} spreads the yielding; only HingeRadau is supported"
        )
    named = {each["name"]: each for each in printed.model["properties"]["sections"]}
    inner = named[sections[1]]
    if inner["type"] != "ElasticSection2d" or len(set(sections[1:5])) != 1:
        raise InputError(
            f"element {tag}: its section {sections[1]} between the hinges is a {inner['type']}; it must be Elastic"
        )
    values = {name: ask(tag, ("section", 2, word), inner[name]) for name, word in (("E", "E"), ("A", "A"), ("Iz", "I"))}
    length = float(np.linalg.norm(np.subtract(nodes[element["nodes"][1]], nodes[element["nodes"][0]])))
    ends = []
    for end, number, name, word in (("start", 1, sections[0], "lpI"), ("end", 6, sections[5], "lpJ")):
        if name != sections[1]:
            moment = _moment(printed, element, number, named[name], values, ask)
            over = ask(tag, ("integration", word), integration[word])
            ends.append(End(tag, end, "", plastic(moment.law(), over, length)))
    return values, ends


def _moment(
    printed: Printed,
    element: Mapping[str, Any],
    number: int,
    section: Mapping[str, Any],
    inner: Mapping[str, float],
    ask: Ask,
) -> Material:
    """The bilinear bending material of an end section; its axial and shear stiffness must equal those of the other
    sections."""
    tag = element["name"]
    if section["type"] != "SectionAggregator" or sorted(section["dof"]) != ["Mz", "P"]:
        raise InputError(f"element {tag}: section {section['name']} of its hinge must be an Aggregator of P and Mz")
    read = {
        dof: read_material(printed, name, partial(_ask_at, ask, tag, ("section", number, "material", int(name))))
        for dof, name in zip(section["dof"], section["materials"])
    }
    if read["P"].kind != "ElasticMaterial" or read["Mz"].kind not in ("Steel01", "ElasticPPMaterial"):
        raise InputError(
            f"element {tag}: section {section['name']} must be Elastic along the member and Steel01 or ElasticPP in bending"
        )
    for dof, stiffness, wanted in (
        ("P", read["P"].values["Epos"], inner["E"] * inner["A"]),
        ("Mz", read["Mz"].values["E"], inner["E"] * inner["Iz"]),
    ):
        if not abs(stiffness - wanted) <= PRINTED * wanted:
            raise InputError(
                f"element {tag}: section {section['name']} has the stiffness {stiffness:g} for {dof}, and between the "
                f"hinges it is {wanted:g}; they must be the same"
            )
    return read["Mz"]


def _ask_at(ask: Ask, tag: int, where: Sequence[str | int], word: str, printed: float) -> float:
    return ask(tag, (*where, word), printed)
