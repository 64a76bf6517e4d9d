"""Extremes of a run: least and largest value of every quantity, with their times. They are tracked in every step of the run and
inside the steps, so they do not depend on the output times."""

from __future__ import annotations

from dataclasses import dataclass, field

import h5py
import numpy as np

from pounding.texts import texts


@dataclass(frozen=True)
class Extremes:
    """Least and largest values of one quantity, signed, in the last place of both arrays."""

    values: np.ndarray  #: [..., 2]
    times: np.ndarray  #: [..., 2] [s]

    @property
    def min(self) -> np.ndarray:
        """[...] least values."""
        return self.values[..., 0]

    @property
    def max(self) -> np.ndarray:
        """[...] largest values."""
        return self.values[..., 1]

    @property
    def peak(self) -> np.ndarray:
        """[...] largest absolute values."""
        return np.abs(self.values).max(axis=-1)


@dataclass(frozen=True)
class StructureEnvelope:
    """Extremes of one structure. Quantities that it does not have are None."""

    name: str
    floors: list[str]  #: labels from the ground up
    directions: list[str] = field(default_factory=list)  #: of the floors: x; in space x, y, rz
    displacement: Extremes | None = None  #: [floor, direction] relative to the ground [m], [rad]
    acceleration: Extremes | None = None  #: [floor, direction] absolute [m/s^2], [rad/s^2]
    drift: Extremes | None = None  #: [floor, x or x and y] floor minus the floor below [m]
    storey_shear: Extremes | None = None  #: [floor, x or x and y] of the storey below the floor [N]
    base_shear: Extremes | None = None  #: [1, x or x and y] of the lowest storey [N]
    members: list[str] = field(default_factory=list)  #: names of all members of a frame
    components: list[str] = field(default_factory=list)  #: "start N", "start Vz", "start My", "end N" ...
    member_force: Extremes | None = None  #: [member, component] on the ends of members, local axes [N], [N m]
    supports: list[str] = field(default_factory=list)  #: names of the nodes that the ground holds
    support_directions: list[str] = field(default_factory=list)  #: x, z, ry; in space x, y, z, rx, ry, rz
    reaction: Extremes | None = None  #: [support, direction] of the ground on a frame [N], [N m]

    def member(self, name: str) -> dict[str, tuple[float, float]]:
        """Least and largest value of each component of one member: `member("column 1.0")["start My"]` [N], [N m]. Raises KeyError."""
        if self.member_force is None or name not in self.members:
            raise KeyError(f"{self.name} has no member {name}; it has {', '.join(self.members) or 'none'}")
        low_high = self.member_force.values[self.members.index(name)]
        return {component: (float(low), float(high)) for component, (low, high) in zip(self.components, low_high)}


def read_envelopes(file: h5py.Group) -> dict[str, StructureEnvelope]:
    """The envelopes of all structures in a results file, or in its group of the run without links; none in files of version 0.1."""
    place = "envelopes/structures"
    return {name: _envelope(name, group) for name, group in file[place].items()} if place in file else {}


def _envelope(name: str, group: h5py.Group) -> StructureEnvelope:
    quantities = ("displacement", "acceleration", "drift", "storey_shear", "base_shear", "member_force", "reaction")
    found = {key: Extremes(group[key][:], group[f"{key}_time"][:]) for key in quantities if key in group}
    return StructureEnvelope(
        name=name, floors=texts(group.attrs["floors"]), directions=_attribute(group, "displacement", "directions"),
        members=texts(group["members"][:]) if "members" in group else [],
        components=_attribute(group, "member_force", "components"),
        supports=texts(group["supports"][:]) if "supports" in group else [],
        support_directions=_attribute(group, "reaction", "directions"), **found)


def _attribute(group: h5py.Group, quantity: str, name: str) -> list[str]:
    return texts(group[quantity].attrs[name]) if quantity in group else []
