"""Catalogues of laws, and their parameters: numbers in SI, texts with units, lists, and flags."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar, cast

import numpy as np
import numpy.typing as npt

from pounding._arguments import flag, numbers, quantity, refuse, text
from pounding._native import core
from pounding.errors import InputError, excerpt

#: A number in SI, or a text with its unit: "0.5 m/s".
Quantity = float | str
#: A number or an array of numbers.
Numbers = npt.ArrayLike
#: Results: an array, or a number if all arguments are numbers.
Values = npt.NDArray[np.float64]
#: A parameter of a law: a quantity, a list of quantities, or True or False.
Given = Quantity | Sequence[Quantity] | bool


@dataclass(frozen=True)
class Parameter:
    """One parameter of a law. In a unit, `n` is the law's exponent."""

    name: str
    unit: str
    meaning: str
    typical: float | list[float] | bool  #: SI; of the same kind as the parameter
    need: str  #: required, optional, instead of restitution, or together, instead of all others
    kind: str = "number"  #: number, list or flag (True or False)


def number_in(name: str, value: Quantity, unit: str, exponent: float = 1.0) -> float:
    """The number in SI of a parameter with this unit. Raises InputError with its name."""
    value = quantity(name, value)
    if not isinstance(value, str):
        return float(value)
    try:
        return core.quantity(value, unit, exponent)
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def numbers_of(parameters: Iterable[Parameter], given: Mapping[str, Given], exponent: float = 1.0) -> dict[str, float]:
    """The numbers in SI of the given parameters; those of a list are numbered: "force[1]", "force[2]". Raises
    InputError."""
    known = {p.name: p for p in parameters}
    found: dict[str, float] = {}
    for name, value in given.items():
        of = known.get(name.partition("[")[0])
        unit = of.unit if of else ""
        if of and of.kind == "flag" and not (isinstance(value, (int, float)) and value in (0, 1)):
            found[name] = float(flag(name, value))
        elif of and of.kind == "flag":
            found[name] = float(bool(value))
        elif of and of.kind == "list" and not isinstance(value, (str, bool)) and np.ndim(value) == 1:
            items = {f"{name}[{i}]": item for i, item in enumerate(cast("Sequence[float | str]", value), 1)}
            found |= {item: number_in(item, one, unit, exponent) for item, one in items.items()}
        else:
            found[name] = number_in(name, cast("float | str", value), unit, exponent)
    return found


def by_key(parameters: Iterable[Parameter], numbers: Mapping[str, float]) -> dict[str, Any]:
    """The numbers by input keys: lists in one value, flags as True or False."""
    kinds = {p.name: p.kind for p in parameters}
    found: dict[str, Any] = {}
    for name, value in numbers.items():
        key = name.partition("[")[0]
        if name != key:
            found.setdefault(key, []).append(value)
        else:
            found[key] = bool(value) if kinds.get(key) == "flag" else value
    return found


def described(name: str, summary: str, shape: str, source: str, parameters: Iterable[Parameter]) -> list[str]:
    """Description of a law, one line per parameter."""
    return [f"{name}: {summary}", f"  {shape}", f"  {source}"] + [
        f"  {p.name} [{p.unit or '-'}]  {p.meaning} ({p.need}), typically {_shown(p.typical)}" for p in parameters
    ]


def _shown(typical: float | list[float] | bool) -> str:
    return f"{typical:g}" if isinstance(typical, float) else str(typical)


class _Named(Protocol):
    @property
    def name(self) -> str: ...


Kind = TypeVar("Kind", bound=_Named)


class Kinds(Mapping[str, Kind]):
    """Laws by name. `variable` is the name of the object in its module, `noun` that of its items in messages."""

    variable: str
    noun: str

    def __init__(self, kinds: Iterable[Kind]) -> None:
        self._kinds = {kind.name: kind for kind in kinds}

    def __getitem__(self, name: str) -> Kind:
        place = f"{self.variable}[...]"
        if not isinstance(name, str):
            raise refuse(place, f"the name of a {self.noun}", name)
        if text(place, name) not in self._kinds:
            raise InputError(self._unknown(name))
        return self._kinds[name]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self._kinds

    def __iter__(self) -> Iterator[str]:
        return iter(self._kinds)

    def __len__(self) -> int:
        return len(self._kinds)

    def __repr__(self) -> str:
        return f"<pounding.{self.variable}: {', '.join(self._kinds)}>"

    def __reduce__(self) -> str:
        return self.variable

    def _unknown(self, name: str) -> str:
        near = difflib.get_close_matches(name[:100], self._kinds, 1)
        hint = f'Did you mean "{near[0]}"?' if near else f"Allowed: {', '.join(self._kinds)}."
        return f"unknown {self.noun} {excerpt(name)}. {hint}"


def states_of(given: Mapping[str, Numbers], in_order: bool) -> list[np.ndarray]:
    """Arrays of penetration, rate and approach_velocity of one shape, or numbers. Raises InputError."""
    arrays = [numbers(key, values) for key, values in given.items()]
    velocity = arrays[2]
    if not np.all(np.isfinite(velocity) & (velocity >= 0)):
        worst = velocity[~(np.isfinite(velocity) & (velocity >= 0))].flat[0]
        raise InputError(f"approach_velocity is {worst:g}, but must be finite and not negative")
    if in_order and (velocity.ndim or max(array.ndim for array in arrays) != 1):
        raise InputError(
            "in_order takes the states of one impact: rows of penetrations and rates, one approach_velocity"
        )
    if len({array.shape for array in arrays if array.ndim}) > 1:
        try:
            arrays = list(np.broadcast_arrays(*arrays))
        except ValueError:
            shapes = ", ".join(f"{key} {array.shape}" for key, array in zip(given, arrays))
            raise InputError(
                f"the arrays have shapes that do not broadcast: {shapes}; give arrays of one shape, or numbers"
            ) from None
    return arrays
