"""Groups of the results file as tables of pandas and datasets of xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pounding._data import Data, DataArray
from pounding.errors import InputError
from pounding.results import RunData

if TYPE_CHECKING:
    import pandas
    import xarray


def to_pandas(run: RunData) -> dict[str, pandas.DataFrame]:
    """See `pounding.Run.to_pandas`."""
    import pandas

    tables = {"impacts": pandas.DataFrame({name: run.impacts[name] for name in run.impacts.dtype.names or ()})}
    for path, group in run._groups().subtree():
        arrays = group.data_vars
        name = path.strip("/")
        if any(array.dims[:1] == ("time",) for array in arrays.values()):
            tables[name] = _histories(group)
        elif any(array.dims[2:] == ("extreme",) for array in arrays.values()):
            tables[name.replace("/structures/", "/")] = _extremes(group)
    if len(tables) == 1:
        raise InputError("the results name no dimensions, as those of earlier versions do; run the model again")
    return tables


def _histories(group: Data) -> pandas.DataFrame:
    """A column per quantity and place, and a row per time."""
    import pandas

    arrays = {name: array for name, array in group.data_vars.items() if array.dims[:1] == ("time",)}
    levels = list(dict.fromkeys(dimension for array in arrays.values() for dimension in array.dims[1:]))
    columns: dict[tuple[str, ...], np.ndarray] = {}
    for name, array in arrays.items():
        values = array.values
        for place in np.ndindex(values.shape[1:]):
            labels = dict(zip(array.dims[1:], _labels(array, place)))
            columns[(name, *(labels.get(level, "") for level in levels))] = values[(slice(None), *place)]
    time = next(iter(arrays.values())).coords["time"].values
    heads = pandas.MultiIndex.from_tuples(columns, names=["quantity", *levels]) if levels and columns else None
    table = pandas.DataFrame(
        np.column_stack(list(columns.values())) if columns else np.empty((len(time), 0)),
        pandas.Index(time, name="time"),
        [name for name, *_ in columns] if heads is None else heads,
    )
    table.attrs = {name: array.attrs for name, array in arrays.items()}
    return table


def _extremes(group: Data) -> pandas.DataFrame:
    """A row per quantity, item and direction."""
    import pandas

    rows, values = [], []
    for name, array in group.data_vars.items():
        if array.dims[2:] == ("extreme",) and f"{name}_time" in group:
            extremes, times = array.values, group[f"{name}_time"].values
            for place in np.ndindex(extremes.shape[:-1]):
                rows.append((name, *_labels(array, place, first=0)))
                values.append([*extremes[place], *times[place]])
    index = pandas.MultiIndex.from_tuples(rows, names=["quantity", "item", "direction"]) if rows else None
    return pandas.DataFrame(np.reshape(values, (-1, 4)), index, ["min", "max", "time_of_min", "time_of_max"])


def _labels(array: DataArray, place: tuple[int, ...], first: int = 1) -> list[str]:
    """Labels of a place along the dimensions from `first`; its numbers along dimensions without labels."""
    known = [array.coords.get(dimension) for dimension in array.dims[first:]]
    return [str(i) if labels is None else str(labels.values[i]) for i, labels in zip(place, known)]


def to_xarray(run: RunData) -> dict[str, xarray.Dataset]:
    """See `pounding.Run.to_xarray`."""
    tree: Any = run.data
    return {node.path.strip("/") or "/": node.to_dataset() for node in tree.subtree if node.data_vars}
