"""The groups and arrays of a results file with their dimensions, coordinates and units, read on demand.

Names and units come from the file: dimension scales of HDF5, `units`, `long_name` and, as in netCDF, `coordinates`. A
table of rows is a group with one array per column."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeVar

import h5py
import numpy as np

from pounding._pictures.html import text_html
from pounding._texts import text, texts

if TYPE_CHECKING:
    import xarray

Read = TypeVar("Read")

#: Attributes of HDF5 and netCDF that describe dimensions.
_OF_DIMENSIONS = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS", "coordinates"}
#: Start of the NAME of a scale without values.
_WITHOUT_VALUES = "This is a netCDF dimension but not a netCDF variable"


class DataArray:
    """An array of a results file. Its values are read on first access."""

    name: str  #: in its group
    dims: tuple[str, ...]  #: names of the dimensions
    shape: tuple[int, ...]  #: length of each dimension
    coords: dict[str, DataArray]  #: coordinates along the dimensions

    def __init__(self, name: str, dataset: h5py.Dataset, scales: Mapping[int, tuple[str, DataArray | None]]) -> None:
        self._dataset = dataset
        self._column = name if dataset.dtype.names else None
        self.name, self.shape = name, tuple(dataset.shape or ())
        self.dtype: np.dtype[Any] = dataset.dtype[name] if dataset.dtype.names else dataset.dtype
        found = [self._dimension(i, scales) for i in range(len(self.shape))]
        self.dims = tuple(dimension for dimension, _ in found)
        self.coords = {dimension: scale for dimension, scale in found if scale is not None}

    def _dimension(self, i: int, scales: Mapping[int, tuple[str, DataArray | None]]) -> tuple[str, DataArray | None]:
        """Name and coordinate of a dimension."""
        if _is_scale(self._dataset):
            return self.name, None
        if len(self._dataset.dims[i]) and (found := scales.get(_address(self._dataset.dims[i][0]))):
            return found
        # Files of earlier versions have no scales. Trees of xarray compare lengths by name, so each has its own.
        return f"{self._dataset.name.strip('/').replace('/', '.')}.{i}", None

    @cached_property
    def attrs(self) -> dict[str, Any]:
        """Attributes, such as `units` and `long_name`."""
        if self._column is None:
            return _attributes(self._dataset)
        number = self._dataset.dtype.names.index(self._column)
        lists = {"units": "units", "long_name": "field_long_names"}
        return {name: text(self._dataset.attrs[given][number]) for name, given in lists.items()}

    @cached_property
    def values(self) -> np.ndarray:
        """The values in the units of the file; texts as str."""
        return self[()]

    def __getitem__(self, key: Any) -> np.ndarray:
        """The values at these indices, read without the others."""
        found = (self._dataset if self._column is None else self._dataset.fields(self._column))[key]
        if self.dtype.kind not in "SO":
            return np.asarray(found)
        return np.array(text(found) if np.ndim(found) == 0 else texts(found), dtype=str)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.array(self.values, dtype=dtype, copy=copy)

    def __len__(self) -> int:
        return self.shape[0]

    @property
    def label(self) -> str:
        """Sizes of the dimensions, and the unit."""
        sizes = ", ".join(f"{name}: {size}" for name, size in zip(self.dims, self.shape))
        unit = self.attrs.get("units", "text")
        return f"({sizes})" + ("" if unit in ("text", "1") else f" [{unit}]")

    def __repr__(self) -> str:
        return f"{self.name} {self.label} {self.attrs.get('long_name', '')}".rstrip()


class Data(Mapping[str, Any]):
    """A group of a results file, with the basic access of `xarray.DataTree`, for Python without xarray."""

    def __init__(
        self, group: h5py.Group | h5py.Dataset, inherited: Mapping[int, tuple[str, DataArray | None]] | None = None
    ) -> None:
        self._group, self._inherited = group, inherited or {}
        self.name = group.name.rpartition("/")[2]

    @cached_property
    def _contents(self) -> tuple[dict[str, Data], dict[str, DataArray], dict[str, DataArray]]:
        group, scales = self._group, dict(self._inherited)
        if not isinstance(group, h5py.Group):
            return {}, {column: DataArray(column, group, scales) for column in group.dtype.names}, {}
        items = dict(group.items())
        coords: dict[str, DataArray] = {}
        for name, item in items.items():
            if _is_scale(item):
                if has_values := not _name_of_scale(item).startswith(_WITHOUT_VALUES):
                    coords[name] = DataArray(name, item, scales)
                scales[_address(item)] = (name, coords[name] if has_values else None)
        tables = {name: item for name, item in items.items() if isinstance(item, h5py.Group) or item.dtype.names}
        arrays = {name: item for name, item in items.items() if name not in tables and not _is_scale(item)}
        found = {name: DataArray(name, item, scales) for name, item in arrays.items() if item.dtype != np.uint8}
        further = text(group.attrs.get("coordinates", "")).split()
        coords |= {name: found.pop(name) for name in further if name in found}
        return {name: Data(item, scales) for name, item in tables.items()}, found, coords

    @cached_property
    def attrs(self) -> dict[str, Any]:
        """Attributes, such as `units` and `long_name`."""
        return _attributes(self._group) if isinstance(self._group, h5py.Group) else {}

    @property
    def children(self) -> dict[str, Data]:
        """Groups in this group, and tables with one array per column."""
        return self._contents[0]

    @property
    def data_vars(self) -> dict[str, DataArray]:
        """Arrays in this group."""
        return self._contents[1]

    @property
    def coords(self) -> dict[str, DataArray]:
        """Coordinates of the arrays."""
        return self._contents[2]

    @property
    def dims(self) -> dict[str, int]:
        """Lengths of the dimensions of the arrays."""
        arrays = [*self.coords.values(), *self.data_vars.values()]
        return {name: size for array in arrays for name, size in zip(array.dims, array.shape)}

    def __getitem__(self, path: str) -> Any:
        """A group or an array by its path, such as "links/left-right/force"."""
        name, _, rest = path.strip("/").partition("/")
        inner: dict[str, Any] = {**self.children, **self.data_vars, **self.coords}
        if name not in inner or rest and not isinstance(inner[name], Data):
            raise KeyError(f"there is no {path!r} in {self.name or '/'!r}; there are {', '.join(inner) or 'none'}")
        return inner[name][rest] if rest else inner[name]

    def __iter__(self) -> Iterator[str]:
        return iter([*self.coords, *self.data_vars, *self.children])

    def __len__(self) -> int:
        return len(self.coords) + len(self.data_vars) + len(self.children)

    def subtree(self, path: str = "/") -> Iterator[tuple[str, Data]]:
        """The groups with their paths, this one first.

        Parameters
        ----------
        path : str
            Path of this group.

        Yields
        ------
        tuple of str and Data
            Path from this group, and the group.
        """
        yield path, self
        for name, child in self.children.items():
            yield from child.subtree(f"{path.rstrip('/')}/{name}")

    def __repr__(self) -> str:
        lines = []
        for path, group in self.subtree():
            depth = "    " * path.rstrip("/").count("/")
            lines.append(f"{depth}{path.rpartition('/')[2] or '/'}")
            lines += [f"{depth}  * {array!r}" for array in group.coords.values()]
            lines += [f"{depth}    {array!r}" for array in group.data_vars.values()]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        return text_html(repr(self))


def read_fields(kind: type[Read], group: Data, **given: Any) -> Read:
    """A dataclass whose fields are the attributes and arrays of a group with their names, or attributes of its arrays,
    except those given. Missing ones have their defaults. Raises KeyError for a missing one without a default."""
    arrays = {**group.coords, **group.data_vars}
    for one in fields(kind):  # type: ignore[arg-type]
        if one.name in given:
            continue
        if one.name in group.attrs:
            given[one.name] = group.attrs[one.name]
        elif one.name in arrays:
            given[one.name] = arrays[one.name].values
        elif found := next((array.attrs for array in arrays.values() if one.name in array.attrs), None):
            given[one.name] = found[one.name]
        elif one.default is MISSING and one.default_factory is MISSING:
            raise KeyError(one.name)
        if one.name in given and one.type in _READ:
            given[one.name] = _READ[one.type](given[one.name])
    made = kind(**given)
    # For print(). A field would make equal values different objects.
    vars(made)["_labels"] = {name: array.label for name, array in arrays.items() if name in given}
    return made


def to_datatree(data: Data) -> xarray.DataTree:
    """The groups as a tree of xarray, whose arrays are read on demand. Raises ImportError without xarray."""
    import xarray
    from xarray.backends import BackendArray
    from xarray.core import indexing

    class OnDemand(BackendArray):
        def __init__(self, array: DataArray) -> None:
            self.array, self.shape, self.dtype = array, array.shape, array.dtype

        def __getitem__(self, key: Any) -> Any:
            kind = indexing.IndexingSupport.OUTER_1VECTOR
            return indexing.explicit_indexing_adapter(key, self.shape, kind, self.array.__getitem__)

    def variable(array: DataArray) -> xarray.Variable:
        is_text = array.dtype.kind in "SO" or not array.shape
        values = array.values if is_text else indexing.LazilyIndexedArray(OnDemand(array))
        return xarray.Variable(array.dims, values, array.attrs)

    return xarray.DataTree.from_dict(
        {
            path: xarray.Dataset(
                {name: variable(array) for name, array in group.data_vars.items()},
                {name: variable(array) for name, array in group.coords.items()},
                group.attrs,
            )
            for path, group in data.subtree()
        }
    )


def _list(value: Any) -> list[str]:
    """A list of texts; empty for a list without texts, which is an empty text in HDF5."""
    return [str(one) for one in np.ravel(value)] if str(value) else []


#: Conversions by the type of a field.
_READ: dict[str, Callable[[Any], Any]] = {"str": str, "list[str]": _list, "bool | None": bool}


def _is_scale(dataset: h5py.Dataset) -> bool:
    return isinstance(dataset, h5py.Dataset) and bool(h5py.h5ds.is_scale(dataset.id))


def _name_of_scale(dataset: h5py.Dataset) -> str:
    return text(dataset.attrs.get("NAME", ""))


def _address(dataset: h5py.Dataset) -> int:
    """Place in the file, the same for all links to a dataset."""
    return int(h5py.h5o.get_info(dataset.id).addr)


def _attributes(item: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """Attributes except those of dimensions: texts as str, numbers as they are."""
    names = (name for name in item.attrs if name not in _OF_DIMENSIONS and not name.startswith("_Netcdf4"))
    return {name: _plain(item.attrs[name]) for name in names}


def _plain(value: Any) -> Any:
    if isinstance(value, (bytes, h5py.Empty)):
        return text(value)
    if isinstance(value, np.ndarray) and value.dtype.kind in "SO":
        return texts(value)
    return value.item() if isinstance(value, np.generic) else value
