"""OpenSees elements with uniaxial materials: hinges at the ends of members, bars and dampers, gaps to walls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from pounding._opensees.materials import Law, Material, device_words, gap_words, read_material
from pounding._opensees.printed import Constraint, Printed
from pounding.errors import InputError

#: Types of elements that are springs.
SPRINGS = ("ZeroLength", "TwoNodeLink", "Truss")
#: Directions as they are printed, and their degrees of freedom from 1, by the dimension.
DIRECTIONS = {2: {"P": 1, "Vy": 2, "Mz": 3}, 3: {"P": 1, "Vy": 2, "Vz": 3, "T": 4, "My": 5, "Mz": 6}}
#: Axes of displacements in input keys.
AXES = {2: ("x", "z"), 3: ("x", "y", "z")}


class Ask(Protocol):
    """Returns exact values of an element through ops.parameter."""

    def __call__(self, tag: int, words: Sequence[str | int], printed: float) -> float:
        """The exact value, checked against the printed one."""


@dataclass(frozen=True)
class Spring:
    """An element with one material per direction."""

    tag: int
    kind: str
    nodes: tuple[int, int]
    materials: Mapping[int, Material]  #: by degrees of freedom from 1; of a truss and of a twoNodeLink 1 is along it
    area: float  #: of a truss [m^2], else 1
    length: float  #: of a truss [m], else 1
    has_length: bool  #: True if its nodes have different coordinates

    def words(self) -> dict[str, Any]:
        """Input keys of the device. Raises InputError for several materials and for directions other than x, y and
        z."""
        if len(self.materials) != 1:
            raise InputError(f"element {self.tag} has {len(self.materials)} materials; make an element of each")
        [material] = self.materials.values()
        return device_words(material, self.area, self.length)

    def direction(self, dimension: int) -> dict[str, str]:
        """Input key of its axis; empty along the line between its nodes."""
        [dof] = self.materials
        if self.has_length:
            if dof != 1:
                raise InputError(f"element {self.tag} acts across the line between its nodes; only -dir 1 is supported")
            return {}
        axes = AXES[dimension]
        if dof > len(axes):
            raise InputError(
                f"element {self.tag} rotates, but is not at the end of a member; only displacements are supported"
            )
        return {"axis": axes[dof - 1]}


def read_spring(printed: Printed, element: Mapping[str, Any], nodes: Mapping[int, Sequence[float]], ask: Ask) -> Spring:
    """A spring from its line in the printed model. Raises InputError if its axes are not global."""
    tag, kind = element["name"], element["type"]
    at = tuple(element["nodes"])
    length = float(np.linalg.norm(np.subtract(nodes[at[1]], nodes[at[0]])))

    def material(name: str, *where: str | int) -> Material:
        return read_material(printed, name, lambda word, value: ask(tag, (*where, word), value))

    if kind == "Truss":
        if element.get("massperlength", 0):
            raise InputError(f"element {tag}: the mass of a truss is not supported; give it to the nodes")
        area = ask(tag, ("A",), element["A"])
        return Spring(tag, kind, at, {1: material(element["material"], "material")}, area, length, True)
    if length == 0 and not np.array_equal(element["transMatrix"], np.eye(3)):
        raise InputError(f"element {tag} has local axes (-orient); only global axes are supported")
    if element.get("mass", 0):
        raise InputError(f"element {tag}: the mass of a twoNodeLink is not supported; give it to the nodes")
    directions = DIRECTIONS[len(nodes[at[0]])]
    of = {
        directions[name]: material(number, "material", i + 1)
        for i, (name, number) in enumerate(zip(element["dof"], element["materials"]))
    }
    if len(of) != len(element["dof"]):
        raise InputError(f"element {tag} has several materials in one direction; combine them in a Parallel material")
    return Spring(tag, kind, at, of, 1.0, 1.0, length > 0)


@dataclass(frozen=True)
class End:
    """A hinge at an end of a member."""

    member: int
    end: str  #: start or end
    axis: str  #: y or z, of the member; empty in the plane
    law: Mapping[str, Any]  #: input keys


class JoinedMember(Protocol):
    """A member whose ends can be assigned to other nodes."""

    tag: int
    nodes: tuple[int, int]


def rotates_only(spring: Spring, dimension: int) -> bool:
    """True if all its materials act on rotations."""
    return spring.kind == "ZeroLength" and not spring.has_length and min(spring.materials) > dimension


def take_hinges(
    spring: Spring,
    constraints: Sequence[Constraint],
    members: Sequence[JoinedMember],
    busy: set[int],
    dimension: int,
    local: Mapping[int, Sequence[np.ndarray]],
) -> tuple[int, int, list[End]]:
    """The node at the end of a member, the node at the other end of the spring, and its hinges.

    The displacements, and the rotations without a material, must be tied by one equalDOF. `busy` are nodes with other
    constraints or loads, `local` the local y and z of members in space. Raises InputError if it is not a hinge."""
    turns = f"element {spring.tag} rotates between nodes {spring.nodes[0]} and {spring.nodes[1]}"
    free = set(spring.materials)
    wanted = tuple(dof for dof in range(1, (3 if dimension == 2 else 6) + 1) if dof not in free)
    tie = next(
        (c for c in constraints if {c.node, c.retained} == set(spring.nodes) and c.dofs == c.retained_dofs == wanted),
        None,
    )
    if tie is None:
        raise InputError(
            f"{turns}, which are not tied to each other; "
            f"type equalDOF({spring.nodes[0]}, {spring.nodes[1]}, {', '.join(map(str, wanted))})"
        )
    at = {node: [member for member in members if node in member.nodes] for node in spring.nodes}
    end = next((node for node in (tie.node, tie.retained) if len(at[node]) == 1 and node not in busy), None)
    if end is None:
        raise InputError(f"{turns}, and neither is the end of exactly one member, without mass, support and link")
    [member] = at[end]
    where = "start" if member.nodes[0] == end else "end"
    [kept] = set(spring.nodes) - {end}
    hinges = [
        End(
            member.tag,
            where,
            "" if dimension == 2 else _axis(spring, member.tag, dof, local[member.tag]),
            material.law().moments(),
        )
        for dof, material in spring.materials.items()
    ]
    return end, kept, hinges


def _axis(spring: Spring, member: int, dof: int, local: Sequence[np.ndarray]) -> str:
    along = np.eye(3)[dof - 4]
    for name, axis in zip("yz", local):
        if abs(abs(float(along @ axis)) - 1) < 1e-9:
            return name
    raise InputError(f"element {spring.tag}: degree of freedom {dof} is not an axis of bending of element {member}")


def hinge_words(hinges: Sequence[End]) -> dict[str, dict[str, Any]]:
    """Input key `hinges` of a frame. Raises InputError if the ends of a member differ."""
    words: dict[str, dict[str, Any]] = {}
    for tag in sorted({hinge.member for hinge in hinges}):
        of = [hinge for hinge in hinges if hinge.member == tag]
        ends, axes = {hinge.end for hinge in of}, {hinge.axis for hinge in of}
        if any(hinge.law != of[0].law for hinge in of) or len(of) != len(ends) * len(axes):
            raise InputError(
                f"element {tag}: its hinges differ; a member has equal hinges at both ends and about both axes"
            )
        words[f"e{tag}"] = {
            "at": ends.pop() if len(ends) == 1 else "both",
            **({"axis": axes.pop() if len(axes) == 1 else "both"} if axes != {""} else {}),
            **of[0].law,
        }
    return words


def plastic(moment: Law, plastic_length: float, length: float) -> dict[str, Any]:
    """Input keys of the rigid-plastic hinge for a section with a bilinear moment [N m] over `plastic_length` [m] at
    the end of a member of this length [m] that is elastic throughout.

    After yielding it rotates by plastic_length (1-b)/(b E I) per N m; the `hardening` a of a hinge is 6 E I/L
    a/(1-a)."""
    b = float(moment.values["hardening"])
    x = b / (1 - b) * length / (6 * plastic_length)
    return {"yield_moment": moment.values["yield_force"], "hardening": x / (1 + x)}


def between_words(spring: Spring, home: Mapping[int, str], fixed: set[int]) -> dict[str, Any]:
    """Input keys of a gap material: a link between structures; "ground" is a fixed node outside all structures."""
    if set(spring.materials) != {1} or spring.kind != "ZeroLength":
        raise InputError(f"element {spring.tag}: only a zeroLength along x, -dir 1, joins two structures as a gap")
    ends: list[Any] = []
    for node in spring.nodes:
        if node not in home and node not in fixed:
            raise InputError(f"element {spring.tag}: node {node} belongs to no frame")
        ends.append({"structure": home[node], "node": f"n{node}"} if node in home else "ground")
    return {"between": ends, **gap_words(spring.materials[1])}
