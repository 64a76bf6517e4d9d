"""Results as tables of pandas and datasets of xarray, one per group of the results file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pounding._envelopes import EDGES, StructureEnvelope
from pounding.results import FloorMotion, MemberForces, RunData, Structure

if TYPE_CHECKING:
    import pandas
    import xarray

#: Units of the histories of a floor; rotations (rx, ry, rz) are in rad.
UNITS = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s^2", "drift": "m", "storey_shear": "N"}
#: Units of the histories of a node; along rx, ry, rz in rad instead of m.
NODE_UNITS = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s^2"}
#: Units of the histories of a link.
LINK_UNITS = {"penetration": "m", "velocity": "m/s", "force": "N", "energy": "J"}
#: Units of the histories of a device.
DEVICE_UNITS = {"elongation": "m", "force": "N"}
#: Units of the histories of yielding parts; of hinges in rad instead of m and N m instead of N.
SPRING_UNITS = {"deformation": "m", "force": "N", "hysteretic": "J"}
#: Tables of the forces of members, and their signs.
MEMBER_TABLES = {
    "members": ("end_forces", "forces on the ends, in local axes"),
    "sections": ("section_forces", "internal forces on the face towards the end, N positive in tension"),
}


class Group(NamedTuple):
    """Histories in one group of the results file."""

    time: np.ndarray
    #: quantity -> dimensions after the time, values [time, ...], attributes
    variables: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, Any]]]
    coordinates: dict[str, list[str]]  #: dimension -> names


def _envelope(one: StructureEnvelope) -> pandas.DataFrame:
    """Rows (quantity, item, direction): min, max and their times [s]. Items are floors, edges, members or supports."""
    import pandas

    axes = {
        **{name: (one.floors, one.directions) for name in ("displacement", "acceleration")},
        "edge_displacement": (one.floors, list(EDGES)),
        **{name: (one.floors, one.directions) for name in ("drift", "storey_shear")},
        "member_force": (one.members, one.components),
        "reaction": (one.supports, one.support_directions),
    }
    rows, values = [], []
    for quantity, (items, directions) in axes.items():
        extremes = getattr(one, quantity)
        if extremes is None:
            continue
        for place in np.ndindex(extremes.values.shape[:-1]):
            rows.append((quantity, items[place[0]], directions[place[1]]))
            values.append([*extremes.values[place], *extremes.times[place]])
    index = pandas.MultiIndex.from_tuples(rows, names=["quantity", "item", "direction"]) if rows else None
    return pandas.DataFrame(np.reshape(values, (-1, 4)), index, ["min", "max", "time_of_min", "time_of_max"])


def to_pandas(run: RunData) -> dict[str, pandas.DataFrame]:
    """See `pounding.Run.to_pandas`."""
    import pandas

    tables = {"impacts": pandas.DataFrame({name: run.impacts[name] for name in run.impacts.dtype.names or ()})}
    for group, (time, variables, coordinates) in _groups(run).items():
        index = pandas.Index(time, name="time")
        columns = {
            (quantity, *(coordinates[dimension][i] for dimension, i in zip(dimensions, place))): values[
                (slice(None), *place)
            ]
            for quantity, (dimensions, values, _) in variables.items()
            for place in np.ndindex(values.shape[1:])
        }
        names = ["quantity", *coordinates][:3]
        if not coordinates:
            tables[group] = pandas.DataFrame({quantity: values for (quantity,), values in columns.items()}, index)
        elif "component" in coordinates:
            for table, (quantity, _) in MEMBER_TABLES.items():
                own = {key[1:]: values for key, values in columns.items() if key[0] == quantity}
                made = _table(index, own, names[1:])
                made.attrs = {key: value for key, value in variables[quantity][2].items() if key != "units"}
                tables[group.removesuffix("members") + table] = made
        elif "floor" in coordinates:
            tables[group] = _table(index, _by_direction(run.structures[group.partition("/")[2]], columns), names)
        else:
            tables[group] = _table(index, columns, names)
    tables |= {f"envelopes/{name}": _envelope(one) for name, one in run.envelopes.items()}
    return tables


def to_xarray(run: RunData) -> dict[str, xarray.Dataset]:
    """See `pounding.Run.to_xarray`."""
    import xarray

    sets = {"impacts": xarray.Dataset({name: ("impact", run.impacts[name]) for name in run.impacts.dtype.names or ()})}
    for group, (time, variables, coordinates) in _groups(run).items():
        sets[group] = xarray.Dataset(
            {
                quantity: (("time", *dimensions), values, _plain(attributes))
                for quantity, (dimensions, values, attributes) in variables.items()
            },
            {"time": ("time", time, {"units": "s"}), **coordinates},
        )
    return sets


def _groups(run: RunData) -> dict[str, Group]:
    """The histories of a run, by group of the results file."""
    ground = {f"acceleration_{axis}": values for axis, values in run.ground_across.items()}
    energy = {key: values for key, values in run.energy.items() if key != "time"}
    found = {
        "ground": _plain_group(run.time, {"acceleration": run.ground_acceleration, **ground}, "m/s^2"),
        "energy": _plain_group(run.energy["time"], energy, "J"),
    }
    found |= {f"links/{name}": _group(link.time, link, LINK_UNITS) for name, link in run.links.items()}
    found |= {f"devices/{name}": _group(run.time, device, DEVICE_UNITS) for name, device in run.devices.items()}
    for name, structure in run.structures.items():
        place = f"structures/{name}"
        found[place] = _floors(run.time, structure)
        if (nodes := structure.nodes) is not None:
            found[f"{place}/nodes"] = _group(run.time, nodes, NODE_UNITS, node=nodes.names, direction=nodes.directions)
        if structure.members is not None:
            found[f"{place}/members"] = _members(run.time, structure.members)
        if (springs := structure.springs) is not None:
            found[f"{place}/springs"] = _group(run.time, springs, SPRING_UNITS, part=springs.names)
    return found


def _plain_group(time: np.ndarray, values: dict[str, np.ndarray], unit: str) -> Group:
    return Group(time, {key: ((), each, {"units": unit}) for key, each in values.items()}, {})


def _group(time: np.ndarray, of: Any, units: dict[str, str], **coordinates: list[str]) -> Group:
    dimensions = tuple(coordinates)
    return Group(
        time, {key: (dimensions, getattr(of, key), {"units": unit}) for key, unit in units.items()}, coordinates
    )


def _floors(time: np.ndarray, structure: Structure) -> Group:
    """Arrays [time, floor, direction]; NaN for directions without drift."""
    motions, floors = structure.along.values(), len(structure.floors)
    found = _group(time, None, {}, floor=structure.floors, direction=structure.directions)
    for key, unit in UNITS.items():
        values = np.stack([_padded(motion, key, floors) for motion in motions], axis=-1)
        found.variables[key] = (("floor", "direction"), values, {"units": unit})
    if structure.edge_displacement is not None:
        found.variables["edge_displacement"] = (("floor", "edge"), structure.edge_displacement, {"units": "m"})
        found.coordinates["edge"] = list(EDGES)
    return found


def _by_direction(
    structure: Structure, columns: dict[tuple[str, ...], np.ndarray]
) -> dict[tuple[str, ...], np.ndarray]:
    """The columns of floors direction by direction, without drifts and shears of directions without them."""
    order = {axis: i for i, axis in enumerate(structure.along)}
    chosen = [
        (quantity, floor, axis)
        for quantity, floor, axis in columns
        if axis not in order or getattr(structure.along[axis], quantity).shape[1]
    ]
    return {key: columns[key] for key in sorted(chosen, key=lambda key: order.get(key[2], len(order)))}


def _members(time: np.ndarray, members: MemberForces) -> Group:
    about = {"units": "N, N m", "included": members.included, "gravity_included": members.gravity_included}
    found = _group(time, None, {}, member=members.names, component=members.components)
    for quantity, sign in MEMBER_TABLES.values():
        found.variables[quantity] = (("member", "component"), getattr(members, quantity), {**about, "sign": sign})
    return found


def _plain(attributes: dict[str, Any]) -> dict[str, Any]:
    """Attributes that files can store."""
    return {
        key: int(value) if isinstance(value, bool) else value for key, value in attributes.items() if value is not None
    }


def _padded(motion: FloorMotion, key: str, floors: int) -> np.ndarray:
    values = getattr(motion, key)
    return values if values.shape[1] == floors else np.full((len(values), floors), np.nan)


def _table(index: pandas.Index, columns: dict[tuple[str, ...], np.ndarray], names: list[str]) -> pandas.DataFrame:
    import pandas

    heads = (
        pandas.MultiIndex.from_tuples(list(columns), names=names)
        if columns
        else pandas.MultiIndex.from_arrays([[] for _ in names], names=names)
    )
    values = np.column_stack(list(columns.values())) if columns else np.empty((len(index), 0))
    return pandas.DataFrame(values, index, heads)
