"""Parameters of laws: numbers in SI, texts with units, lists, and flags."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from pounding._arguments import flag, quantity
from pounding._native import core
from pounding.errors import InputError

#: A number in SI, or a text with its unit: "0.5 m/s".
Quantity = float | str
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
    numbers: dict[str, float] = {}
    for name, value in given.items():
        of = known.get(name.partition("[")[0])
        unit = of.unit if of else ""
        if of and of.kind == "flag" and not (isinstance(value, (int, float)) and value in (0, 1)):
            numbers[name] = float(flag(name, value))
        elif of and of.kind == "flag":
            numbers[name] = float(bool(value))
        elif of and of.kind == "list" and not isinstance(value, (str, bool)) and np.ndim(value) == 1:
            items = {f"{name}[{i}]": item for i, item in enumerate(cast("Sequence[float | str]", value), 1)}
            numbers |= {item: number_in(item, one, unit, exponent) for item, one in items.items()}
        else:
            numbers[name] = number_in(name, cast("float | str", value), unit, exponent)
    return numbers


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
