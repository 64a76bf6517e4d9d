"""Frames of an OpenSees model with the keys of input files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pounding._opensees.constraints import DOFS, floors_and_ties
from pounding._opensees.hinge_members import HINGE_MEMBER, read_hinge_member
from pounding._opensees.materials import GAPS
from pounding._opensees.printed import PRINTED, Printed
from pounding._opensees.springs import SPRINGS, End, Spring, hinge_words, read_spring, rotates_only, take_hinges
from pounding.errors import InputError
from pounding.opensees import links

_BEAM3 = {"E": "E", "G": "G", "A": "A", "Jx": "J", "Iy": "Iy", "Iz": "Iz"}
#: Supported members, their properties, and the parameters for their exact values in OpenSees.
MEMBERS = {
    "ElasticBeam2d": {"E": "E", "A": "A", "Iz": "I"},
    "ElasticTimoshenkoBeam2d": {"E": "E", "G": "G", "A": "A", "Iz": "Iz", "Avy": "Avy"},
    "ElasticBeam3d": _BEAM3,
    "ElasticTimoshenkoBeam3d": {**_BEAM3, "Avy": "Avy", "Avz": "Avz"},
}
#: Commands that create these members.
COMMANDS = {
    "ElasticBeam2d": "elasticBeamColumn",
    "ElasticTimoshenkoBeam2d": "ElasticTimoshenkoBeam",
    HINGE_MEMBER: "forceBeamColumn",
    "ElasticBeam3d": "elasticBeamColumn",
    "ElasticTimoshenkoBeam3d": "ElasticTimoshenkoBeam",
}
#: Reasons for refusing a geometric transformation.
TRANSFORMATIONS = {
    "PDelta": "its axial forces change with time, those of geometry: p_delta stay as at rest",
    "Corot": "define the frame as Linear, and set geometry: corotational in the resulting model",
}


@dataclass
class Member:
    """A beam-column of OpenSees without its hinges."""

    tag: int
    kind: str
    nodes: tuple[int, int]
    values: dict[str, float]  #: as in MEMBERS, exact
    printed: dict[str, Any]
    transformation: dict[str, Any]
    mass: float  #: per length [kg/m]


@dataclass
class Frames:
    """The model of the running process. Raises InputError at the first unsupported part."""

    ops: Any
    printed: Printed
    without: set[int]
    members: list[Member] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)  #: elements other than hinges
    hinges: list[End] = field(default_factory=list)

    def __post_init__(self) -> None:
        ops = self.ops
        self.dimension = ops.getNDM()[0]
        if self.dimension not in DOFS:
            raise InputError(f"the model has the dimension {self.dimension}; frames in 2 and 3 are supported")
        self.dofs = DOFS[self.dimension]
        self.nodes = {node: tuple(ops.nodeCoord(node)) for node in ops.getNodeTags()}
        for node in self.nodes:
            if ops.getNDF(node)[0] != len(self.dofs):
                raise InputError(
                    f"node {node} has {ops.getNDF(node)[0]} degrees of freedom; nodes of frames have {len(self.dofs)}"
                )
        for tag in self.without - set(ops.getEleTags()):
            raise InputError(f"without: unknown element {tag}")
        ours = {link.tag for link in links()}
        transformations = {each["name"]: each for each in self.printed.model["properties"]["crdTransformations"]}
        for element in self.printed.model["geometry"]["elements"]:
            if element["name"] in self.without | ours:
                continue
            if element["type"] in SPRINGS:
                self.springs.append(read_spring(self.printed, element, self.nodes, self._exact))
            else:
                self.members.append(self._member(element, transformations))
        # Elements without printed output are missing in the list of the model.
        known = self.without | ours | {member.tag for member in self.members} | {spring.tag for spring in self.springs}
        for tag in ops.getEleTags():
            if tag not in known:
                raise InputError(self._refusal(tag, ops.eleType(tag)))
        self.held = {node: tuple(sorted(set(ops.getFixedDOFs(node)))) for node in set(ops.getFixedNodes())}
        self._join_hinges()

    def _join_hinges(self) -> None:
        """Replaces ends of members that are attached by rotational springs by the nodes at the other end of the
        springs."""
        turning = [spring for spring in self.springs if rotates_only(spring, self.dimension)]
        self.springs = [spring for spring in self.springs if spring not in turning]
        busy = {node for node in self.nodes if node in self.held or any(self.ops.nodeMass(node))}
        busy |= self._joined()
        local = {
            member.tag: [np.array(self.ops.eleResponse(member.tag, axis)) for axis in ("ylocal", "zlocal")]
            for member in self.members
            if self.dimension == 3
        }
        for spring in turning:
            end, kept, hinges = take_hinges(spring, self.printed.constraints, self.members, busy, self.dimension, local)
            self.hinges += hinges
            for member in self.members:
                if member.tag == hinges[0].member:
                    member.nodes = tuple(kept if node == end else node for node in member.nodes)  # type: ignore[assignment]
            self.printed.constraints = [c for c in self.printed.constraints if {c.node, c.retained} != {end, kept}]
            del self.nodes[end]

    def require_rest(self) -> None:
        """Raises InputError if a node has moved."""
        for node in self.ops.getNodeTags():
            if any(self.ops.nodeDisp(node)) or any(self.ops.nodeVel(node)):
                raise InputError(f"node {node} has moved: read the model before its analysis, or after ops.reset()")

    def parts(self) -> list[list[int]]:
        """Nodes of each connected part, ordered by smallest x. Unconnected nodes are not included."""
        neighbours: dict[int, set[int]] = defaultdict(set)
        pairs = [member.nodes for member in self.members] + [(c.node, c.retained) for c in self.printed.constraints]
        for a, b in pairs:
            neighbours[a].add(b)
            neighbours[b].add(a)
        for node in self.nodes:
            if node not in neighbours and any(self.ops.nodeMass(node)):
                raise InputError(f"node {node} has a mass, and no member is connected to it")
        parts, seen = [], set()
        for first in neighbours:
            if first in seen:
                continue
            part, waiting = [], [first]
            seen.add(first)
            while waiting:
                node = waiting.pop()
                part.append(node)
                waiting += neighbours[node] - seen
                seen |= neighbours[node]
            parts.append(sorted(part))
        if not parts:
            raise InputError("the model has no members")
        return sorted(parts, key=lambda part: min(self.nodes[node][0] for node in part))

    def structure(self, part: Sequence[int], damping: Any) -> dict[str, Any]:
        """Input keys of one frame."""
        inside = set(part)
        members = [member for member in self.members if member.nodes[0] in inside]
        # A node that only retains a rigid floor is created by the floor.
        constraints = [c for c in self.printed.constraints if c.node in inside]
        floors, ties = floors_and_ties(constraints, self.nodes, self.dimension)
        used = {node for member in members for node in member.nodes} | {node for tie in ties for node in tie["all"]}
        used |= {node for node in inside if any(self.ops.nodeMass(node))}
        used |= self._joined() & inside
        for master in floors:
            if master not in used:
                self._require_loose(master)
        nodes = [node for node in part if node in used]
        frame: dict[str, Any] = {"dimension": self.dimension}
        materials, sections, words = self._member_words(members)
        frame["materials"], frame["sections"] = materials, sections
        frame["nodes"] = {f"n{node}": list(self.nodes[node]) for node in nodes}
        frame["members"] = words
        if self._is_consistent(members):
            frame["mass"] = "consistent"
        frame["supports"] = {
            f"n{node}": "fixed"
            if len(self.held[node]) == len(self.dofs)
            else {"fix": [self.dofs[dof - 1] for dof in self.held[node]]}
            for node in nodes
            if node in self.held
        }
        masses = {f"n{node}": {name: m for name, m in zip(self.dofs, self.ops.nodeMass(node)) if m} for node in nodes}
        frame["masses"] = {name: value for name, value in masses.items() if value}
        frame["ties"] = [
            {"master": f"n{tie['all'][0]}", "nodes": [f"n{node}" for node in tie["all"][1:]], **tie["words"]}
            for tie in ties
        ]
        frame["floors"] = self._floors(nodes, floors, used)
        frame["hinges"] = hinge_words(
            [hinge for hinge in self.hinges if hinge.member in {member.tag for member in members}]
        )
        frame["devices"] = {
            f"d{spring.tag}": {
                "between": [f"n{node}" if node in inside else "ground" for node in spring.nodes],
                **spring.direction(self.dimension),
                **spring.words(),
            }
            for spring in self._within(inside)
        }
        structure: dict[str, Any] = {"frame": {key: value for key, value in frame.items() if value}}
        structure["damping"] = 0 if damping is None else damping
        return structure

    def _joined(self) -> set[int]:
        """Nodes attached to links or springs."""
        return {node for link in links() for node in link.nodes} | {
            node for spring in self.springs for node in spring.nodes
        }

    def _within(self, part: set[int]) -> list[Spring]:
        """Springs between nodes of a part, or from it to a fixed node outside all parts."""
        others = {node for member in self.members for node in member.nodes} - part
        return [
            spring
            for spring in self.springs
            if part & set(spring.nodes)
            and not others & set(spring.nodes)
            and all(node in part or len(self.held.get(node, ())) == len(self.dofs) for node in spring.nodes)
            and not any(material.kind in GAPS for material in spring.materials.values())
        ]

    def _member(self, element: Mapping[str, Any], transformations: Mapping[str, Mapping[str, Any]]) -> Member:
        tag, kind = element["name"], element["type"]
        if kind not in MEMBERS and kind != HINGE_MEMBER:
            raise InputError(self._refusal(tag, kind))
        transformation = dict(transformations[element["crdTransformation"]])
        if not transformation["type"].startswith("Linear"):
            reason = next(
                (text for start, text in TRANSFORMATIONS.items() if transformation["type"].startswith(start)), ""
            )
            raise InputError(
                f"element {tag}: its transformation {transformation['name']} is {transformation['type']}, and only "
                f"Linear is supported{'; ' + reason if reason else ''}"
            )
        if kind == HINGE_MEMBER:
            values, hinges = read_hinge_member(self.printed, element, self.nodes, self._exact)
            self.hinges += hinges
        else:
            values = {name: self._exact(tag, (word,), element[name]) for name, word in MEMBERS[kind].items()}
        return Member(
            tag, kind, tuple(element["nodes"]), values, dict(element), transformation, element["massperlength"]
        )

    def _exact(self, tag: int, words: Sequence[str | int], printed: float) -> float:
        """Exact value of a property, from a parameter that is created and removed."""
        ops = self.ops
        free = max(ops.getParamTags() or [0]) + 1
        ops.parameter(free, "element", tag, *words)
        value = ops.getParamValue(free)
        ops.remove("parameter", free)
        if not abs(value - printed) <= PRINTED * abs(printed):
            raise InputError(f"element {tag}: OpenSees returns {value!r} and prints {printed!r} for its {words[-1]}")
        return value

    @staticmethod
    def _refusal(tag: int, kind: str) -> str:
        return (
            f"element {tag} is of the type {kind}, which is not supported; only elasticBeamColumn, ElasticTimoshenkoBeam, "
            "forceBeamColumn with HingeRadau in the plane, zeroLength, twoNodeLink, truss and links of pounding.opensees are. "
            f"without=[{tag}] omits it"
        )

    def _member_words(self, members: Sequence[Member]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        materials: dict[tuple[float, ...], str] = {}
        sections: dict[tuple[tuple[str, Any], ...], str] = {}
        words: dict[str, Any] = {}
        for member in members:
            v = member.values
            material = (v["E"], v.get("G", 0.0), member.mass / v["A"])
            section: dict[str, Any] = {"area": v["A"]}
            if self.dimension == 2:
                section["inertia_y"] = v["Iz"]
                if "Avy" in v:
                    section["shear_area_z"] = v["Avy"]
            else:
                section |= {"inertia_y": v["Iy"], "inertia_z": v["Iz"], "torsion": v["Jx"]}
                if "Avy" in v:
                    section |= {"shear_area_y": v["Avy"], "shear_area_z": v["Avz"]}
            of = materials.setdefault(material, f"m{len(materials) + 1}")
            by = sections.setdefault(tuple(section.items()), f"s{len(sections) + 1}")
            words[f"e{member.tag}"] = {
                "between": [f"n{node}" for node in member.nodes],
                "section": by,
                "material": of,
                **self._ends(member),
            }
        named = {
            name: {key: value for key, value in zip(("E", "G", "density"), material) if value}
            for material, name in materials.items()
        }
        return named, {name: dict(section) for section, name in sections.items()}, words

    def _ends(self, member: Member) -> dict[str, Any]:
        """Releases, offsets and axes of a member."""
        printed, transformation = member.printed, member.transformation
        words: dict[str, Any] = {}
        released = (
            {"ry": printed.get("release", 0)}
            if self.dimension == 2
            else {"rz": printed.get("releasez", 0), "ry": printed.get("releasey", 0)}
        )
        # 1: at the start, 2: at the end, 3: at both.
        ends = {
            "start": [dof for dof, code in released.items() if code & 1],
            "end": [dof for dof, code in released.items() if code & 2],
        }
        if any(ends.values()):
            words["releases"] = ends
        offsets = {
            end: list(transformation[key])
            for end, key in (("start", "iOffset"), ("end", "jOffset"))
            if any(transformation.get(key, ()))
        }
        if offsets:
            words["offsets"] = offsets
        if self.dimension == 3:
            # The printed vector has six digits; local z is exact.
            words["reference"] = list(self.ops.eleResponse(member.tag, "zlocal"))
        return words

    def _is_consistent(self, members: Sequence[Member]) -> bool:
        heavy = [member for member in members if member.mass > 0]
        consistent = {
            member.tag: member.kind != HINGE_MEMBER and self.printed.consistent_mass(member.tag) for member in heavy
        }
        for member in heavy:
            if consistent[member.tag] and member.kind != "ElasticBeam2d":
                raise InputError(
                    f"element {member.tag}: the consistent mass of a {COMMANDS[member.kind]} in {self.dimension}D has "
                    "terms that are not supported; build it without -cMass"
                )
        if len(set(consistent.values())) > 1:
            raise InputError(
                f"elements {', '.join(str(tag) for tag in consistent)}: some masses are consistent and some lumped; use "
                "one kind per frame"
            )
        return any(consistent.values())

    def _require_loose(self, master: int) -> None:
        if set(self.held.get(master, ())) != {3, 4, 5}:
            raise InputError(f"node {master} only retains a rigid floor; fix exactly its degrees of freedom 3, 4 and 5")

    def _floors(self, nodes: Sequence[int], rigid: Mapping[int, Sequence[int]], used: set[int]) -> list[dict[str, Any]]:
        """Rigid floors, and levels with nodal masses, from the ground up."""
        levels: dict[float, dict[str, Any]] = {}
        for master, members in rigid.items():
            z = self.nodes[master][-1]
            if z in levels:
                raise InputError(f"there are two rigid floors at {z:g}; a frame has at most one per level")
            held = [master, *members] if master in used else list(members)
            levels[z] = {"nodes": [f"n{node}" for node in held], "elevation": z, "rigid": True}
        for node in nodes:
            z = self.nodes[node][-1]
            free = len(self.held.get(node, ())) < len(self.dofs)
            if free and self.ops.nodeMass(node, 1) > 0 and not levels.get(z, {}).get("rigid"):
                levels.setdefault(z, {"nodes": [], "elevation": z, "rigid": False})["nodes"].append(f"n{node}")
        return [levels[z] for z in sorted(levels)]
