"""Modules of scipy, imported on first use so that workers and pictures do not load them."""

from __future__ import annotations

import importlib
from types import ModuleType

from pounding.errors import InputError


def stats() -> ModuleType:
    """scipy.stats. Raises InputError with the command to install it."""
    return _part("scipy.stats")


def special() -> ModuleType:
    """scipy.special, which imports faster than scipy.stats. Raises InputError with the command to install it."""
    return _part("scipy.special")


def _part(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise InputError(
            "samples, distributions and bands of studies need scipy, which is not installed. Type `python3 -m pip install scipy`, "
            "or `make python-test` in the source directory and set POUNDING_PYTHON to .venv-test/bin/python3"
        ) from error
