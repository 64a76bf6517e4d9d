"""Functions of Python in `keep:`, from the summary of a run to numbers."""

from __future__ import annotations

import hashlib
import numbers
import pickle
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from pounding.errors import InputError, excerpt


@dataclass(frozen=True)
class Function:
    """A function and its columns: its own name for a number, else the keys of the dict that it returns."""

    call: Callable[[Mapping[str, Any]], Any]
    columns: tuple[str, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name of the function; that of a lambda is "function"."""
        found = str(getattr(self.call, "__name__", type(self.call).__name__))
        return found if found.isidentifier() else "function"

    def of(self, summary: Mapping[str, Any]) -> dict[str, float]:
        """Its numbers by column. Raises InputError for other keys than those of the first row."""
        found = self.numbers(self.call(summary))
        if set(found) != set(self.columns):
            raise InputError(
                f"study.keep: {self.name} returns {', '.join(sorted(found))}, and for the first row it returns "
                f"{', '.join(self.columns)}; return the same keys for every row"
            )
        return found

    def numbers(self, returned: Any) -> dict[str, float]:
        """Numbers by column. Raises InputError if the function returns something else."""
        named = returned if isinstance(returned, Mapping) else {self.name: returned}
        for key, value in named.items():
            if not isinstance(key, str) or not key.isidentifier() or not _is_number(value):
                raise InputError(
                    f"study.keep: {self.name} takes the summary of a run and returns a number, or a dict of names and numbers; "
                    f"{excerpt(returned)} was returned"
                )
        return {key: float(value) for key, value in named.items()}

    def begun(self, summary: Mapping[str, Any], taken: Mapping[str, str]) -> Function:
        """The function with the columns that it returns for this summary. Raises InputError for a name that the
        table has already."""
        columns = tuple(self.numbers(self.call(summary)))
        for column in columns:
            if column in taken:
                raise InputError(
                    f"study.keep: {self.name} returns {column}, and the table already has a column of this name; return another name"
                )
        units = getattr(self.call, "units", {})
        units = {column: str(units) if isinstance(units, str) else str(units.get(column, "")) for column in columns}
        return Function(self.call, columns, units)

    def description(self) -> dict[str, Any]:
        """Name, columns and a checksum of the code, so that a table is not resumed with another function."""
        code = getattr(self.call, "__code__", None)
        text = repr((code.co_code, code.co_names, _constants(code))) if code else self.name
        return {
            "name": self.name,
            "columns": list(self.columns),
            "units": dict(self.units),
            "digest": hashlib.sha256(text.encode()).hexdigest(),
        }

    def is_picklable(self) -> bool:
        """True if processes can receive the function."""
        try:
            pickle.dumps(self.call)
        except Exception:
            return False
        return True


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool) and not isinstance(value, complex)


def _constants(code: Any) -> list[str]:
    """Constants of a code, with those of functions in it; without addresses."""
    return [
        repr((one.co_code, one.co_names, _constants(one))) if hasattr(one, "co_code") else repr(one)
        for one in code.co_consts
    ]


def functions_of(given: Any) -> tuple[tuple[Function, ...], Any]:
    """The functions of `keep=`, and its other items; None if no `keep` is given."""
    if callable(given):
        return (Function(given),), []
    if given is None or isinstance(given, str):
        return (), given
    try:
        items = list(given)
    except TypeError:  # neither a list nor one quantity, which the reader of quantities refuses
        return (), given
    return tuple(Function(one) for one in items if callable(one)), [one for one in items if not callable(one)]
