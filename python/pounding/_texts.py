"""Texts in HDF5 files, which h5py returns as bytes or str."""

from __future__ import annotations

from typing import Any

import h5py


def text(value: Any) -> str:
    """One text."""
    if isinstance(value, h5py.Empty):
        return ""
    return value.decode() if isinstance(value, bytes) else str(value)


def texts(values: Any) -> list[str]:
    """A list of texts; empty for an empty dataset."""
    return [] if isinstance(values, h5py.Empty) else [text(value) for value in values]
