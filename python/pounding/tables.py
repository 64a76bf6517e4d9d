"""Results as tables of pandas and datasets of xarray, one per group of the results file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pounding.envelopes import EDGES
from pounding.results import FloorMotion, MemberForces, NodeMotion, RunData, Structure

if TYPE_CHECKING:
    import pandas
    import xarray

#: Units of the histories of a floor; rotations (rx, ry, rz) are in rad.
UNITS = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s^2", "drift": "m", "storey_shear": "N"}
#: Units of the histories of a node; along rx, ry, rz in rad instead of m.
NODE_UNITS = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s^2"}
#: Signs of forces of members.
SIGNS = {
    "members": "forces on the ends, in local axes",
    "sections": "internal forces on the face towards the end, N positive in tension",
}
#: Units of the histories of a link.
LINK_UNITS = {"penetration": "m", "velocity": "m/s", "force": "N", "energy": "J"}
#: Units of the histories of a device.
DEVICE_UNITS = {"elongation": "m", "force": "N"}
#: Units of the histories of yielding parts; of hinges in rad instead of m and N m instead of N.
SPRING_UNITS = {"deformation": "m", "force": "N", "hysteretic": "J"}


def to_pandas(run: RunData) -> dict[str, pandas.DataFrame]:
    """See `pounding.Run.to_pandas`."""
    import pandas

    impacts = pandas.DataFrame({name: run.impacts[name] for name in run.impacts.dtype.names or ()})
    tables = {
        "impacts": impacts,
        "ground": pandas.DataFrame(_ground(run), _index(run.time)),
        "energy": pandas.DataFrame({k: v for k, v in run.energy.items() if k != "time"}, _index(run.energy["time"])),
    }
    for name, link in run.links.items():
        tables[f"links/{name}"] = pandas.DataFrame({key: getattr(link, key) for key in LINK_UNITS}, _index(link.time))
    for name, device in run.devices.items():
        tables[f"devices/{name}"] = pandas.DataFrame(
            {key: getattr(device, key) for key in DEVICE_UNITS}, _index(run.time)
        )
    for name, structure in run.structures.items():
        columns: dict[tuple[str, ...], np.ndarray] = {
            (key, floor, direction): getattr(motion, key)[:, i]
            for direction, motion in structure.along.items()
            for key in UNITS
            for i, floor in enumerate(structure.floors)
            if i < getattr(motion, key).shape[1]
        }
        edges = structure.edge_displacement
        if edges is not None:
            columns |= {
                ("edge_displacement", floor, edge): edges[:, i, j]
                for i, floor in enumerate(structure.floors)
                for j, edge in enumerate(EDGES)
            }
        tables[f"structures/{name}"] = _table(run.time, columns, ["quantity", "floor", "direction"])
        if structure.nodes is not None:
            moved = structure.nodes
            columns = {
                (key, node, direction): getattr(moved, key)[:, i, j]
                for key in NODE_UNITS
                for i, node in enumerate(moved.names)
                for j, direction in enumerate(moved.directions)
            }
            tables[f"structures/{name}/nodes"] = _table(run.time, columns, ["quantity", "node", "direction"])
        if structure.members is not None:
            forces = structure.members
            for table, values in (("members", forces.end_forces), ("sections", forces.section_forces)):
                columns = {
                    (member, component): values[:, i, j]
                    for i, member in enumerate(forces.names)
                    for j, component in enumerate(forces.components)
                }
                made = tables[f"structures/{name}/{table}"] = _table(run.time, columns, ["member", "component"])
                made.attrs = {
                    "gravity_included": forces.gravity_included,
                    "included": forces.included,
                    "sign": SIGNS[table],
                }
        if structure.springs is not None:
            springs = structure.springs
            columns = {
                (key, part): getattr(springs, key)[:, i] for key in SPRING_UNITS for i, part in enumerate(springs.names)
            }
            tables[f"structures/{name}/springs"] = _table(run.time, columns, ["quantity", "part"])
    return tables


def to_xarray(run: RunData) -> dict[str, xarray.Dataset]:
    """See `pounding.Run.to_xarray`."""
    import xarray

    def dataset(time: np.ndarray, variables: dict[str, Any], **coordinates: Any) -> xarray.Dataset:
        times = ("time", time, {"units": "s"})
        return xarray.Dataset(variables, {"time": times, **coordinates})

    sets = {
        "ground": dataset(
            run.time, {key: ("time", values, {"units": "m/s^2"}) for key, values in _ground(run).items()}
        ),
        "energy": dataset(
            run.energy["time"],
            {key: ("time", values, {"units": "J"}) for key, values in run.energy.items() if key != "time"},
        ),
        "impacts": xarray.Dataset({name: ("impact", run.impacts[name]) for name in run.impacts.dtype.names or ()}),
    }
    for name, link in run.links.items():
        sets[f"links/{name}"] = dataset(
            link.time, {key: ("time", getattr(link, key), {"units": unit}) for key, unit in LINK_UNITS.items()}
        )
    for name, device in run.devices.items():
        sets[f"devices/{name}"] = dataset(
            run.time, {key: ("time", getattr(device, key), {"units": unit}) for key, unit in DEVICE_UNITS.items()}
        )
    for name, structure in run.structures.items():
        edges = structure.edge_displacement
        sets[f"structures/{name}"] = dataset(
            run.time,
            _motion(structure),
            floor=structure.floors,
            direction=structure.directions,
            **({} if edges is None else {"edge": list(EDGES)}),
        )
        if structure.nodes is not None:
            sets[f"structures/{name}/nodes"] = dataset(
                run.time,
                _node_motion(structure.nodes),
                node=structure.nodes.names,
                direction=structure.nodes.directions,
            )
        if structure.members is not None:
            sets[f"structures/{name}/members"] = dataset(
                run.time,
                _member_forces(structure.members),
                member=structure.members.names,
                component=structure.members.components,
            )
        if structure.springs is not None:
            springs = structure.springs
            sets[f"structures/{name}/springs"] = dataset(
                run.time,
                {key: (("time", "part"), getattr(springs, key), {"units": unit}) for key, unit in SPRING_UNITS.items()},
                part=springs.names,
            )
    return sets


def _motion(structure: Structure) -> dict[str, Any]:
    """Arrays [time, floor, direction]; NaN for directions without drift."""
    found: dict[str, Any] = {
        key: (
            ("time", "floor", "direction"),
            np.stack([_padded(motion, key, len(structure.floors)) for motion in structure.along.values()], axis=-1),
            {"units": unit},
        )
        for key, unit in UNITS.items()
    }
    if structure.edge_displacement is not None:
        found["edge_displacement"] = (("time", "floor", "edge"), structure.edge_displacement, {"units": "m"})
    return found


def _node_motion(nodes: NodeMotion) -> dict[str, Any]:
    return {
        key: (("time", "node", "direction"), getattr(nodes, key), {"units": unit}) for key, unit in NODE_UNITS.items()
    }


def _member_forces(members: MemberForces) -> dict[str, Any]:
    about: dict[str, Any] = {"units": "N, N m", "included": members.included}
    if members.gravity_included is not None:
        about["gravity_included"] = int(members.gravity_included)
    return {
        key: (("time", "member", "component"), values, {**about, "sign": SIGNS[table]})
        for key, table, values in (
            ("end_forces", "members", members.end_forces),
            ("section_forces", "sections", members.section_forces),
        )
    }


def _ground(run: RunData) -> dict[str, np.ndarray]:
    return {
        "acceleration": run.ground_acceleration,
        **{f"acceleration_{axis}": values for axis, values in run.ground_across.items()},
    }


def _padded(motion: FloorMotion, key: str, floors: int) -> np.ndarray:
    values = getattr(motion, key)
    return values if values.shape[1] == floors else np.full((len(values), floors), np.nan)


def _table(time: np.ndarray, columns: dict[tuple[str, ...], np.ndarray], names: list[str]) -> pandas.DataFrame:
    import pandas

    heads = (
        pandas.MultiIndex.from_tuples(list(columns), names=names)
        if columns
        else pandas.MultiIndex.from_arrays([[] for _ in names], names=names)
    )
    values = np.column_stack(list(columns.values())) if columns else np.empty((len(time), 0))
    return pandas.DataFrame(values, _index(time), heads)


def _index(time: np.ndarray) -> pandas.Index:
    import pandas

    return pandas.Index(time, name="time")
