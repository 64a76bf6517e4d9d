"""scipy.stats, imported where it is first needed: workers of a study and whoever only draws a table do without it."""

from __future__ import annotations

from types import ModuleType

from pounding.errors import InputError


def stats() -> ModuleType:
    """scipy.stats. Raises InputError that says what to install."""
    try:
        import scipy.stats
    except ImportError as error:
        raise InputError("samples, distributions and bands of studies need scipy, which is not installed. Type `python3 -m pip install scipy`, "
                         "or `make python-test` in the source directory and set POUNDING_PYTHON to .venv-test/bin/python3") from error
    return scipy.stats
