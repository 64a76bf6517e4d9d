"""Texts and dataclasses in HDF5 files; h5py returns texts as bytes or str."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, fields
from typing import Any, TypeVar

import h5py
import numpy as np

Read = TypeVar("Read")


def text(value: Any) -> str:
    """One text."""
    if isinstance(value, h5py.Empty):
        return ""
    return value.decode() if isinstance(value, bytes) else str(value)


def texts(values: Any) -> list[str]:
    """A list of texts; empty for an empty dataset."""
    return [] if isinstance(values, h5py.Empty) else [text(value) for value in values]


#: Attributes by the type of their field; other attributes are arrays of numbers.
_ATTRIBUTES: dict[str, Callable[[Any], Any]] = {"str": text, "int": int, "float": float, "list[str]": texts}


def read_fields(kind: type[Read], group: h5py.Group, **given: Any) -> Read:
    """A dataclass whose fields are the datasets and attributes of a group with their names, except those given.
    Missing ones have their defaults. Raises KeyError for a missing one without a default."""
    for one in fields(kind):  # type: ignore[arg-type]
        if one.name in given:
            continue
        if one.name in group.attrs or one.type in ("str", "int", "float") and one.default is MISSING:
            value = group.attrs[one.name]
            read = _ATTRIBUTES.get(str(one.type))
            given[one.name] = read(value) if read else np.asarray(value, dtype=float)
        elif one.name in group or one.default is MISSING and one.default_factory is MISSING:
            values = group[one.name][:]
            given[one.name] = texts(values) if one.type == "list[str]" else values
    return kind(**given)
