"""Frames of an OpenSeesPy model as a Model of ours."""

from __future__ import annotations

import json
import math
import re
import tempfile
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.models import Model
from pounding.opensees import Link, links, openseespy

#: OpenSees prints this many digits, which is how far its other answers are held against them.
PRINTED = 1e-5
#: Names of degrees of freedom by the dimension. In the plane OpenSees has x, y and a rotation from x to y.
DOFS = {2: ("ux", "uz", "ry"), 3: ("ux", "uy", "uz", "rx", "ry", "rz")}
#: Members that are carried over, their properties, and the words by which OpenSees tells these to the last bit.
MEMBERS = {
    "ElasticBeam2d": {"E": "E", "A": "A", "Iz": "I"},
    "ElasticTimoshenkoBeam2d": {"E": "E", "G": "G", "A": "A", "Iz": "Iz", "Avy": "Avy"},
    "ElasticBeam3d": {"E": "E", "G": "G", "A": "A", "Jx": "J", "Iy": "Iy", "Iz": "Iz"},
    "ElasticTimoshenkoBeam3d": {"E": "E", "G": "G", "A": "A", "Jx": "J", "Iy": "Iy", "Iz": "Iz", "Avy": "Avy", "Avz": "Avz"},
}
#: What is typed for them.
COMMANDS = {"ElasticBeam2d": "elasticBeamColumn", "ElasticTimoshenkoBeam2d": "ElasticTimoshenkoBeam",
            "ElasticBeam3d": "elasticBeamColumn", "ElasticTimoshenkoBeam3d": "ElasticTimoshenkoBeam"}
#: Why a geometric transformation is refused.
TRANSFORMATIONS = {"PDelta": "its axial forces change with time, those of geometry: p_delta stay as at rest",
                   "Corot": "set the frame up as Linear, and geometry: corotational in the model that is made"}


def from_opensees(*, ground_motion: Mapping[str, Any] | None = None, analysis: Mapping[str, Any] | None = None,
                  rayleigh: Sequence[float] | None = None, damping: Any = None, names: Sequence[str] | None = None,
                  without: Iterable[int] = (), without_loads: bool = False, title: str | None = None) -> Model:
    """The OpenSeesPy model of this process as a Model: every connected part is a structure of the kind `frame`, and links
    made by `pounding.opensees.link` are its links.

    Carried over: nodes, masses, fix, elasticBeamColumn and ElasticTimoshenkoBeam with the transformation Linear, releases,
    joint offsets and mass per length, equalDOF, rigidLink and rigidDiaphragm. The model is in N, m, kg, s; in the plane y
    is up, in space z. Nodes and members are named by their tags: n24, e7. Structures are called left and right when there
    are two, else frame1, frame2, ... from the smaller x on, unless `names` says otherwise.

    OpenSees does not tell the damping: give `rayleigh`, the numbers of ops.rayleigh (alphaM, betaK, betaKinit, betaKcomm),
    or `damping` in our own words; neither is no damping. Nor does it tell the motion of a UniformExcitation: give
    `ground_motion`, and `analysis`, as in Model. `without` are tags of elements that are left out, `without_loads` leaves
    load patterns out. Mass per length and joint offsets are read with the six digits that OpenSees prints, all else exactly.

    Raises InputError that names what cannot be carried over; ImportError without openseespy."""
    ops = openseespy()
    printed = Printed(ops)
    source = Source(ops, printed, set(without))
    source.require_rest()
    printed.require_nothing_else(ground_motion is not None, without_loads)
    if rayleigh is not None:
        if damping is not None:
            raise InputError("rayleigh and damping both say the damping; keep one of them")
        damping = rayleigh_words(rayleigh)
    elif damping is None and printed.alpha_m != 0:
        raise InputError(f"the nodes have Rayleigh damping with alphaM = {printed.alpha_m:g}; OpenSees does not tell the other "
                         "factors, so give rayleigh=(alphaM, betaK, betaKinit, betaKcomm), or damping=")
    parts = source.parts()
    if names is None:
        names = ("left", "right") if len(parts) == 2 else [f"frame{i + 1}" for i in range(len(parts))]
    if len(names) != len(parts):
        raise InputError(f"names has {len(names)} names, and the model has {len(parts)} parts")
    structures = {name: source.structure(part, damping) for name, part in zip(names, parts)}
    home = {node: name for name, part in zip(names, parts) for node in part}
    between = [_link_words(each, home) for each in links() if each.tag not in source.without]
    return Model(structures, between, ground_motion=ground_motion, analysis=analysis, title=title)


def rayleigh_words(factors: Sequence[float]) -> dict[str, Any] | None:
    """Damping in the words of the input from alphaM [1/s] and the betas [s], whose sum acts on elastic members."""
    by_mass, by_stiffness = float(factors[0]), float(sum(factors[1:]))
    if not all(math.isfinite(factor) and factor >= 0 for factor in (by_mass, by_stiffness)):
        raise InputError(f"rayleigh is {tuple(factors)}, but takes factors that are not negative")
    if by_mass == by_stiffness == 0:
        return None
    # a0 = 2 z w1 w2/(w1 + w2) and a1 = 2 z/(w1 + w2) with any w1 < w2; where one factor is zero, the other frequency is so
    # far away that what it adds is lost in rounding.
    if by_stiffness == 0:
        low, high = max(1.0, 10 * by_mass), 1e15
        ratio = by_mass / (2 * low)
    elif by_mass == 0:
        low, high = 1e-15, min(1.0, 0.1 / by_stiffness)
        ratio = by_stiffness * high / 2
    else:
        middle = math.sqrt(by_mass / by_stiffness)
        low, high = middle / 2, middle * 2
        ratio = 1.25 * math.sqrt(by_mass * by_stiffness)
    if ratio >= 1:
        raise InputError(f"rayleigh is {tuple(factors)}, which is overdamped at every frequency; its factors must give less "
                         "than 80 % somewhere")
    return {"rayleigh": {"ratio": ratio, "periods": [2 * math.pi / low, 2 * math.pi / high]}}


def _link_words(link: Link, home: Mapping[int, str]) -> dict[str, Any]:
    for node in link.nodes:
        if node not in home:
            raise InputError(f"element {link.tag}: node {node} belongs to no frame")
    if link.dof != 1:
        raise InputError(f"element {link.tag} acts along degree of freedom {link.dof}; only links along x are carried over")
    law = link.law
    given = {"formula": law.formula, "restitution": law.restitution, "impact_velocity": law.impact_velocity,
             "reduced_mass": link.reduced_mass, **law.parameters}
    return {"between": [{"structure": home[node], "node": f"n{node}"} for node in link.nodes], "gap": link.gap,
            "law": law.kind.name, **{name: value for name, value in given.items() if value is not None}}


@dataclass
class Constraint:
    """u[constrained dofs] = matrix u[retained dofs]; dofs from 1, the matrix in six digits."""

    node: int
    retained: int
    dofs: tuple[int, ...]
    retained_dofs: tuple[int, ...]
    matrix: np.ndarray


class Printed:
    """What only the printed model tells."""

    def __init__(self, ops: Any) -> None:
        self._ops = ops
        self._text = self._print()
        # The line of a genericClient is no JSON.
        lines = re.sub(r"^.*\"GenericClient\".*\n", "", self._print("-JSON"), flags=re.MULTILINE)
        self.model = json.loads(re.sub(r",(\s*\])", r"\1", lines))["StructuralAnalysisModel"]
        factors = [float(value) for value in re.findall(r"Rayleigh Factor: alphaM: (\S+)", self._text)]
        self.alpha_m = max(factors, default=0.0)
        whole, _, self._patterns = self._text.partition("LOAD PATTERNS:")
        self._supports = whole.partition("SP_Constraints: numConstraints:")[2].partition("MP_Constraints: numConstraints:")
        self.constraints = list(self._read_constraints(self._supports[2]))

    def consistent_mass(self, element: int) -> bool:
        """Whether the mass of an element is consistent. Raises InputError where the print does not tell."""
        parts = re.split(r"^(?:ElasticBeam[23]d|Element): (\d+)", self._text.partition("ELEMENT DATA:")[2], flags=re.MULTILINE)
        of = dict(zip(parts[1::2], parts[2::2])).get(str(element), "")
        found = re.search(r"cMass: (\d)", of)
        if not found:
            raise InputError(f"element {element}: OpenSees does not tell whether its mass is consistent")
        return found[1] == "1"

    def require_nothing_else(self, with_motion: bool, without_loads: bool) -> None:
        """Raises InputError for supports that are displaced, motions and loads that would not be carried over."""
        for node, dof, value in re.findall(r"Node: (\d+) DOF: (\d+) ref value: (\S+)", self._supports[0]):
            if float(value) != 0:
                raise InputError(f"node {node}, degree of freedom {dof}: a support with the displacement {value} is not carried over")
        for pattern in re.split(r"^(?=Load Pattern: |UniformExcitation )", self._patterns, flags=re.MULTILINE)[1:]:
            kind, tag = re.match(r"(Load Pattern|UniformExcitation)\D+(\d+)", pattern).groups()  # type: ignore[union-attr]
            if kind == "UniformExcitation":
                if not with_motion:
                    raise InputError(f"pattern {tag}: OpenSees does not tell the motion of a UniformExcitation; give ground_motion=")
            elif re.search(r"numComponents: [1-9]", pattern) and not without_loads:
                raise InputError(f"pattern {tag}: loads are not carried over; type without_loads=True, and add them to the model "
                                 "as `loads`")

    def _print(self, *words: str) -> str:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "model"
            self._ops.printModel(*words, "-file", str(file))
            return file.read_text()

    def _read_constraints(self, text: str) -> Iterator[Constraint]:
        blocks = text.split("MP_Constraint: ")[1:]
        count = int(text.split()[0])
        if len(blocks) != count:
            raise InputError(f"OpenSees prints {len(blocks)} of {count} constraints")
        for block in blocks:
            found = re.search(r"Node Constrained: (\d+) node Retained: (\d+)\s+constrained dof:([\d ]*)\s+retained dof:([\d ]*)\s+"
                              r"constraint matrix:\s+([-+.\deE\s]*)", block)
            if not found:
                raise InputError(f"a constraint is printed as {block.strip()!r}, which is not understood")
            node, retained = int(found[1]), int(found[2])
            dofs, retained_dofs = (tuple(map(int, found[i].split())) for i in (3, 4))
            matrix = np.array([float(word) for word in found[5].split()]).reshape(len(dofs), len(retained_dofs))
            yield Constraint(node, retained, dofs, retained_dofs, matrix)


@dataclass
class Member:
    """An elastic beam-column as OpenSees tells of it."""
    tag: int
    kind: str
    nodes: tuple[int, int]
    values: dict[str, float]  #: as in MEMBERS, exact
    printed: dict[str, Any]
    transformation: dict[str, Any]
    mass: float  #: per length [kg/m]


@dataclass
class Source:
    """The model of the running process. Raises InputError at the first part that cannot be carried over."""
    ops: Any
    printed: Printed
    without: set[int]
    members: list[Member] = field(default_factory=list)

    def __post_init__(self) -> None:
        ops = self.ops
        self.dimension = ops.getNDM()[0]
        if self.dimension not in DOFS:
            raise InputError(f"the model has {self.dimension} dimension; frames in 2 and 3 are carried over")
        self.dofs = DOFS[self.dimension]
        self.nodes = {node: tuple(ops.nodeCoord(node)) for node in ops.getNodeTags()}
        for node in self.nodes:
            if ops.getNDF(node)[0] != len(self.dofs):
                raise InputError(f"node {node} has {ops.getNDF(node)[0]} degrees of freedom; nodes of frames have {len(self.dofs)}")
        for tag in self.without - set(ops.getEleTags()):
            raise InputError(f"without: there is no element {tag}")
        ours = {link.tag for link in links()}
        transformations = {each["name"]: each for each in self.printed.model["properties"]["crdTransformations"]}
        for element in self.printed.model["geometry"]["elements"]:
            if element["name"] not in self.without | ours:
                self.members.append(self._member(element, transformations))
        # The list of the model has no elements that do not print themselves.
        known = self.without | ours | {member.tag for member in self.members}
        for tag in ops.getEleTags():
            if tag not in known:
                raise InputError(self._refusal(tag, ops.eleType(tag)))
        self.held = {node: tuple(sorted(set(ops.getFixedDOFs(node)))) for node in set(ops.getFixedNodes())}

    def require_rest(self) -> None:
        """Raises InputError when a node has moved."""
        for node in self.nodes:
            if any(self.ops.nodeDisp(node)) or any(self.ops.nodeVel(node)):
                raise InputError(f"node {node} has moved: read the model before its analysis, or after ops.reset()")

    def parts(self) -> list[list[int]]:
        """Nodes of each part that members and constraints connect, from the smaller x on. A node that is not connected is
        no part."""
        neighbours: dict[int, set[int]] = defaultdict(set)
        pairs = [member.nodes for member in self.members] + [(c.node, c.retained) for c in self.printed.constraints]
        for a, b in pairs:
            neighbours[a].add(b)
            neighbours[b].add(a)
        for node in self.nodes:
            if node not in neighbours and any(self.ops.nodeMass(node)):
                raise InputError(f"node {node} has a mass, and no member meets it")
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
        """Words of one frame."""
        inside = set(part)
        members = [member for member in self.members if member.nodes[0] in inside]
        # A node that only holds a rigid floor together is one that the floor makes for itself.
        constraints = [c for c in self.printed.constraints if c.node in inside]
        floors, ties = self._constraints(constraints)
        used = {node for member in members for node in member.nodes} | {node for tie in ties for node in tie["all"]}
        used |= {node for node in inside if any(self.ops.nodeMass(node))}
        used |= {node for link in links() for node in link.nodes if node in inside}
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
        frame["supports"] = {f"n{node}": "fixed" if len(self.held[node]) == len(self.dofs) else
                             {"fix": [self.dofs[dof - 1] for dof in self.held[node]]} for node in nodes if node in self.held}
        masses = {f"n{node}": {name: m for name, m in zip(self.dofs, self.ops.nodeMass(node)) if m} for node in nodes}
        frame["masses"] = {name: value for name, value in masses.items() if value}
        frame["ties"] = [{"master": f"n{tie['all'][0]}", "nodes": [f"n{node}" for node in tie["all"][1:]], **tie["words"]}
                         for tie in ties]
        frame["floors"] = self._floors(nodes, floors, used)
        structure: dict[str, Any] = {"frame": {key: value for key, value in frame.items() if value}}
        structure["damping"] = 0 if damping is None else damping
        return structure

    def _member(self, element: Mapping[str, Any], transformations: Mapping[str, Mapping[str, Any]]) -> Member:
        tag, kind = element["name"], element["type"]
        if kind not in MEMBERS:
            raise InputError(self._refusal(tag, kind))
        transformation = dict(transformations[element["crdTransformation"]])
        if not transformation["type"].startswith("Linear"):
            reason = next((text for start, text in TRANSFORMATIONS.items() if transformation["type"].startswith(start)), "")
            raise InputError(f"element {tag}: its transformation {transformation['name']} is {transformation['type']}, and only "
                             f"Linear is carried over{'; ' + reason if reason else ''}")
        values = {name: self._value(tag, word, element[name]) for name, word in MEMBERS[kind].items()}
        return Member(tag, kind, tuple(element["nodes"]), values, dict(element), transformation, element["massperlength"])

    def _value(self, tag: int, word: str, printed: float) -> float:
        """A property to the last bit, by a parameter that is made and removed."""
        ops = self.ops
        free = max(ops.getParamTags() or [0]) + 1
        ops.parameter(free, "element", tag, word)
        value = ops.getParamValue(free)
        ops.remove("parameter", free)
        if not abs(value - printed) <= PRINTED * abs(printed):
            raise InputError(f"element {tag}: OpenSees tells {value!r} and prints {printed!r} for its {word}")
        return value

    @staticmethod
    def _refusal(tag: int, kind: str) -> str:
        return (f"element {tag} is of the type {kind}, which is not carried over; only elasticBeamColumn, ElasticTimoshenkoBeam "
                f"and links of pounding.opensees are. without=[{tag}] leaves it out")

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
            words[f"e{member.tag}"] = {"between": [f"n{node}" for node in member.nodes], "section": by, "material": of,
                                       **self._ends(member)}
        named = {name: {key: value for key, value in zip(("E", "G", "density"), material) if value}
                 for material, name in materials.items()}
        return named, {name: dict(section) for section, name in sections.items()}, words

    def _ends(self, member: Member) -> dict[str, Any]:
        """Releases, offsets and axes of a member."""
        printed, transformation = member.printed, member.transformation
        words: dict[str, Any] = {}
        released = {"ry": printed.get("release", 0)} if self.dimension == 2 else {"rz": printed.get("releasez", 0),
                                                                                  "ry": printed.get("releasey", 0)}
        # 1: at the start, 2: at the end, 3: at both.
        ends = {"start": [dof for dof, code in released.items() if code & 1],
                "end": [dof for dof, code in released.items() if code & 2]}
        if any(ends.values()):
            words["releases"] = ends
        offsets = {end: list(transformation[key]) for end, key in (("start", "iOffset"), ("end", "jOffset"))
                   if any(transformation.get(key, ()))}
        if offsets:
            words["offsets"] = offsets
        if self.dimension == 3:
            # The vector as it was given has six digits; local z has all.
            words["reference"] = list(self.ops.eleResponse(member.tag, "zlocal"))
        return words

    def _is_consistent(self, members: Sequence[Member]) -> bool:
        heavy = [member for member in members if member.mass > 0]
        consistent = {member.tag: self.printed.consistent_mass(member.tag) for member in heavy}
        for member in heavy:
            if consistent[member.tag] and member.kind != "ElasticBeam2d":
                raise InputError(f"element {member.tag}: the consistent mass of a {COMMANDS[member.kind]} in {self.dimension}D has "
                                 "terms that ours has not; build it without -cMass")
        if len(set(consistent.values())) > 1:
            raise InputError(f"elements {', '.join(str(tag) for tag in consistent)}: some masses are consistent and some lumped; a "
                             "frame has one kind")
        return any(consistent.values())

    def _constraints(self, constraints: Sequence[Constraint]) -> tuple[dict[int, list[int]], list[dict[str, Any]]]:
        """Nodes of rigid floors by their masters, and ties."""
        floors: dict[int, list[int]] = defaultdict(list)
        ties: list[dict[str, Any]] = []
        in_plan = (1, 2, 6) if self.dimension == 3 else ()
        above: list[Constraint] = []  # a node in the plan of its master follows a floor as it follows a tie
        for c in constraints:
            arm = np.subtract(self.nodes[c.node], self.nodes[c.retained])
            if c.dofs == in_plan and c.retained_dofs == in_plan and not arm.any():
                above.append(c)
            elif c.dofs == c.retained_dofs and np.array_equal(c.matrix, np.eye(len(c.dofs))):
                ties.append(_tie(c, {"dofs": [self.dofs[dof - 1] for dof in c.dofs]}))
            elif c.dofs != c.retained_dofs or not _is_rigid(c, arm, self.dimension):
                raise InputError(f"the constraint of node {c.node} to node {c.retained}, degrees of freedom {list(c.dofs)}, is "
                                 "neither an equalDOF, a rigidLink nor a rigidDiaphragm that is level")
            elif c.dofs == in_plan:
                floors[c.retained].append(c.node)
            else:
                ties.append(_tie(c, {"rigid": True}))
        for c in above:
            if c.retained in floors:
                floors[c.retained].append(c.node)
            else:
                ties.append(_tie(c, {"dofs": ["ux", "uy", "rz"]}))
        return dict(floors), ties

    def _require_loose(self, master: int) -> None:
        if set(self.held.get(master, ())) != {3, 4, 5}:
            raise InputError(f"node {master} holds a rigid floor and nothing else; fix its degrees of freedom 3, 4 and 5 and no others")

    def _floors(self, nodes: Sequence[int], rigid: Mapping[int, Sequence[int]], used: set[int]) -> list[dict[str, Any]]:
        """Rigid floors, and levels whose nodes have mass, from the ground up."""
        levels: dict[float, dict[str, Any]] = {}
        for master, members in rigid.items():
            z = self.nodes[master][-1]
            if z in levels:
                raise InputError(f"there are two rigid floors at {z:g}; a frame has one at a level")
            held = [master, *members] if master in used else list(members)
            levels[z] = {"nodes": [f"n{node}" for node in held], "elevation": z, "rigid": True}
        for node in nodes:
            z = self.nodes[node][-1]
            free = len(self.held.get(node, ())) < len(self.dofs)
            if free and self.ops.nodeMass(node, 1) > 0 and not levels.get(z, {}).get("rigid"):
                levels.setdefault(z, {"nodes": [], "elevation": z, "rigid": False})["nodes"].append(f"n{node}")
        return [levels[z] for z in sorted(levels)]


def _tie(constraint: Constraint, words: dict[str, Any]) -> dict[str, Any]:
    return {"all": [constraint.retained, constraint.node], "words": words}


def _is_rigid(constraint: Constraint, arm: np.ndarray, dimension: int) -> bool:
    """Rows and columns of a rigid body's motion; in six digits."""
    full = np.eye(len(DOFS[dimension]))
    if dimension == 2:
        full[:2, 2] = -arm[1], arm[0]
    else:
        x, y, z = arm
        full[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    rows = [dof - 1 for dof in constraint.dofs]
    if len(rows) < len(full) and not (dimension == 3 and constraint.dofs == (1, 2, 6)):
        return False
    wanted = full[np.ix_(rows, rows)]
    return bool(np.allclose(constraint.matrix, wanted, rtol=PRINTED, atol=PRINTED * max(1.0, np.abs(arm).max())))
