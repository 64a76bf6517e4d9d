"""Results of structures: motions of floors and nodes, forces of members, and reactions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding._arguments import takes
from pounding._data import Data, read_fields
from pounding._envelopes import section_signs
from pounding._springs import Springs, read_springs


@dataclass(frozen=True, repr=False)
class Geometry(printing.ReportLines):
    """Nodes and members of a frame at rest."""

    nodes: np.ndarray  #: [node, 3] x, y, z [m], z up
    members: np.ndarray  #: [member, 2] indices of nodes
    floor_of_node: np.ndarray  #: [node] from 0 at the lowest; -1 for none
    node_names: list[str]
    member_names: list[str]


@dataclass(frozen=True, repr=False)
class NodeMotion(printing.ReportLines):
    """Motion of the nodes requested in the input."""

    names: list[str]
    directions: list[str]  #: x, z, ry in the plane; x, y, z, rx, ry, rz in space
    displacement: np.ndarray  #: [time, node, direction] relative to the ground [m], [rad]
    velocity: np.ndarray  #: [time, node, direction] relative to the ground [m/s], [rad/s]
    acceleration: np.ndarray  #: [time, node, direction] absolute [m/s^2], [rad/s^2]


@dataclass(frozen=True, repr=False)
class MemberForces(printing.ReportLines):
    """End forces of the members requested in the input, in local axes."""

    names: list[str]
    components: list[str]  #: "start N", "start Vz", "start My", "end N" ...
    end_forces: np.ndarray  #: [time, member, component] [N], [N m]
    #: True if they include the weights of masses; None if unknown
    gravity_included: bool | None = None
    included: str = ""  #: contents: "gravity, P-Delta"

    @property
    def section_forces(self) -> np.ndarray:
        """[time, member, component] internal forces at both ends, on the face towards the end of the member [N], [N
        m]. N > 0 is tension at either end."""
        return self.end_forces * section_signs(self.components)

    @property
    def axial_force(self) -> np.ndarray:
        """[time, member] axial force, positive in tension [N]; the larger end value if loads act along the member."""
        ends = self.section_forces[:, :, [self.components.index(f"{end} N") for end in ("start", "end")]]
        return np.take_along_axis(ends, np.abs(ends).argmax(axis=2, keepdims=True), axis=2)[:, :, 0]


@dataclass(frozen=True, repr=False)
class Reactions(printing.ReportLines):
    """Reactions at the supported nodes of a frame, in global axes, without damping forces."""

    names: list[str]
    directions: list[str]  #: x, z, ry in the plane; x, y, z, rx, ry, rz in space
    force: np.ndarray  #: [time, node, direction] [N], [N m]; along z positive up, negative in uplift
    gravity_included: bool | None = None  #: as in MemberForces
    included: str = ""


@dataclass(frozen=True, repr=False)
class FloorMotion(printing.ReportLines):
    """Motion of the floors in one direction."""

    displacement: np.ndarray  #: [time, floor] relative to the ground [m]; along rz all quantities are angular
    velocity: np.ndarray  #: [time, floor] relative to the ground [m/s]
    acceleration: np.ndarray  #: [time, floor] absolute [m/s^2]
    drift: np.ndarray  #: [time, floor] [m]; no columns in a structure without storeys, and for rz
    storey_shear: np.ndarray  #: [time, floor] [N]; as drift
    base_shear: np.ndarray | None  #: [time] [N]; None if not in the file


@dataclass(frozen=True, repr=False)
class Structure(printing.ReportLines, lines=printing.structure):
    """One structure. `displacement`, `velocity`, `acceleration`, `drift` and `storey_shear` are along x; other
    directions are in `along`, as in `along["y"].drift`."""

    name: str
    floors: list[str]  #: labels from the ground up
    along: dict[str, FloorMotion]  #: x; in space x, y and rz
    kind: str = ""  #: kind of the structure in the input; empty if unknown
    dimension: int = 1  #: 1: along x only; 2: in x and z; 3: in space
    elevations: np.ndarray = field(default_factory=lambda: np.empty(0))  #: [floor] [m]; NaN if not given
    geometry: Geometry | None = None  #: of a frame; None for other structures
    nodes: NodeMotion | None = None  #: None if no nodes were requested
    members: MemberForces | None = None  #: None if no members were requested
    reactions: Reactions | None = None  #: of a frame; None for other structures
    springs: Springs | None = None  #: parts that can yield; None if the structure is elastic
    #: [floor, 4] min x, max x, min y, max y of rigid floors in space, relative to their reference point [m]; NaN for
    #: other floors, None without rigid floors in space.
    plan: np.ndarray | None = None

    @property
    def directions(self) -> list[str]:
        """Directions of the floors' motion: ["x"], or ["x", "y", "rz"] in space."""
        return list(self.along)

    @takes(quantity=arguments.one_of(("displacement", "velocity", "acceleration", "drift", "storey_shear")))
    def in_all_directions(self, quantity: str = "displacement") -> np.ndarray:
        """A quantity of the floors in all directions; NaN for drifts and shears that a direction does not have.

        Parameters
        ----------
        quantity : str
            displacement, velocity, acceleration, drift or storey_shear; along rz in rad instead of m.

        Returns
        -------
        numpy.ndarray
            [time, floor, direction] in the order of `directions`: x, in space x, y and rz.

        Raises
        ------
        InputError
            The quantity is another one.
        """
        missing = np.full(self.displacement.shape, np.nan)
        found = [getattr(motion, quantity) for motion in self.along.values()]
        return np.stack([values if values.shape == missing.shape else missing for values in found], axis=-1)

    @property
    def displacement(self) -> np.ndarray:
        """[time, floor] along x, relative to the ground [m]; other directions: `in_all_directions`."""
        return self.along["x"].displacement

    @property
    def velocity(self) -> np.ndarray:
        """[time, floor] along x, relative to the ground [m/s]."""
        return self.along["x"].velocity

    @property
    def acceleration(self) -> np.ndarray:
        """[time, floor] along x, absolute [m/s^2]."""
        return self.along["x"].acceleration

    @property
    def drift(self) -> np.ndarray:
        """[time, floor] along x, floor minus the floor below [m]; no columns in a structure without storeys."""
        return self.along["x"].drift

    @property
    def storey_shear(self) -> np.ndarray:
        """[time, floor] along x, of the storey below the floor [N]; as drift."""
        return self.along["x"].storey_shear

    @property
    def rotation(self) -> np.ndarray | None:
        """[time, floor] about z [rad]; NaN for floors that are not rigid, None without rigid floors in space."""
        if self.plan is None:
            return None
        return np.where(np.isnan(self.plan[:, 0]), np.nan, self.along["rz"].displacement)

    @property
    def edge_displacement(self) -> np.ndarray | None:
        """[time, floor, edge] displacements of the edges of rigid floors along themselves, in the order of
        `pounding._envelopes.EDGES` [m]; NaN and None as for `rotation`."""
        if self.plan is None:
            return None
        x, y, turn = (self.along[axis].displacement[:, :, None] for axis in ("x", "y", "rz"))
        return np.concatenate([x - turn * self.plan[:, 2:], y + turn * self.plan[:, :2]], axis=2)

    def centre(self, floor: int) -> np.ndarray:
        """The reference point of a rigid floor, whose motion is reported. For frames in space.

        Parameters
        ----------
        floor : int
            Index of the floor, from 0.

        Returns
        -------
        numpy.ndarray
            x, y [m].
        """
        assert self.geometry is not None and self.plan is not None
        return self.geometry.nodes[self.geometry.floor_of_node == floor, :2].min(axis=0) - self.plan[floor, [0, 2]]

    @property
    def is_wall(self) -> bool:
        """True for a wall, which moves with the ground and has no histories."""
        return not self.floors and self.geometry is None


def read_structure(name: str, group: Data) -> Structure:
    """A structure of a results file."""
    floors = group.attrs["floors"] or []
    directions = group.attrs.get("directions", ["x"])
    elevations = group.attrs["elevations"] if floors and "elevations" in group.attrs else np.full(len(floors), np.nan)
    kinds: dict[str, Any] = {"geometry": Geometry, "nodes": NodeMotion, "members": MemberForces, "reactions": Reactions}
    parts = {key: read_fields(kind, group[key]) for key, kind in kinds.items() if key in group}
    return read_fields(
        Structure,
        group,
        name=name,
        floors=floors,
        along={direction: _floor_motion(group, i) for i, direction in enumerate(directions)},
        elevations=np.asarray(elevations, dtype=float),
        springs=read_springs(group),
        **parts,
    )


def _floor_motion(group: Data, i: int) -> FloorMotion:
    """The motion along direction i of the last axis. Drift and shear have that axis in space only, for x and y."""

    def along(name: str) -> np.ndarray:
        values: np.ndarray = np.atleast_3d(group[name].values)
        return values[:, :, i] if i < values.shape[2] else np.empty((len(values), 0))

    motion = {key: along(key) for key in ("displacement", "velocity", "acceleration", "drift", "storey_shear")}
    base = group.get("base_shear")
    made = FloorMotion(**motion, base_shear=base[:, i] if base is not None and i < base.shape[1] else None)
    vars(made)["_labels"] = {key: f"{values.shape} [{group[key].attrs['units']}]" for key, values in motion.items()}
    return made
