"""Laws of yielding along paths of numpy arrays: storeys, hinges, isolators, soil. SI units.

    law = pounding.hysteresis["bouc_wen"](stiffness="10 MN/m", yield_force="150 kN", hardening=0.05)
    loop = law.follow([0, 0.03, -0.03, 0.01])
    loop.force, loop.work

A deformation is in m and a force in N; at a hinge rad and N m.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from pounding import arguments
from pounding._native import core
from pounding.errors import InputError, excerpt

#: A number in SI, or a text with its unit: "150 kN".
Quantity = float | str
#: An array of the shape of the path.
Values = npt.NDArray[np.float64]


@dataclass(frozen=True)
class YieldingParameter:
    """One parameter of a law."""

    name: str
    unit: str
    meaning: str
    typical: float  #: SI
    need: str  #: required, optional, or others instead, may be left out


@dataclass(frozen=True)
class YieldingChoice:
    """A parameter with named values; the first is the default."""

    name: str
    meaning: str
    words: tuple[str, ...]


class Loop(NamedTuple):
    """Response of a law along a path; every array has the shape of the path."""

    deformation: Values  #: [m]
    force: Values  #: [N]
    slope: Values  #: df/dd at each point [N/m]
    work: Values  #: work since the beginning of the row [J]
    stored: Values  #: recoverable energy [J]

    @property
    def lost(self) -> Values:
        """Energy lost since the beginning of the row [J]."""
        return self.work - self.stored


@dataclass(frozen=True)
class YieldingKind:
    """A law of yielding with its tables. Call it with parameters to get a `YieldingLaw`."""

    name: str
    shape: str  #: the force as a formula
    summary: str
    source: str
    parameters: tuple[YieldingParameter, ...]
    choices: tuple[YieldingChoice, ...]
    has_corners: bool  #: True if the slope also jumps away from turning points

    def __call__(self, **parameters: Quantity | None) -> YieldingLaw:
        """The law with these parameters: numbers in SI, texts with units, or names of choices. Raises InputError."""
        return YieldingLaw(self, parameters)

    def __str__(self) -> str:
        lines = [f"{self.name}: {self.summary}", f"  {self.shape}", f"  {self.source}"]
        lines += [
            f"  {p.name} [{p.unit or '-'}]  {p.meaning} ({p.need}), typically {p.typical:g}" for p in self.parameters
        ]
        lines += [f"  {c.name}: {' or '.join(c.words)}  {c.meaning}" for c in self.choices]
        return "\n".join(lines)


class YieldingLaw:
    """A law with its parameters. Has no history: every path begins undeformed."""

    def __init__(self, kind: YieldingKind, parameters: Mapping[str, Quantity | None]) -> None:
        given = {name: value for name, value in parameters.items() if value is not None}
        chosen = {choice.name for choice in kind.choices}
        units = {p.name: p.unit for p in kind.parameters}
        self.kind = kind
        self.choices = {name: arguments.text(name, value) for name, value in given.items() if name in chosen}
        #: in SI
        self.parameters = {
            name: _number(name, value, units.get(name, "")) for name, value in given.items() if name not in chosen
        }
        self._made = core.YieldingLaw(kind.name, self.parameters, self.choices)

    def __reduce__(self) -> tuple[Any, ...]:
        return YieldingLaw, (self.kind, self.parameters | self.choices)

    @property
    def stiffness(self) -> float:
        """Initial stiffness [N/m]."""
        return self._made.stiffness

    @property
    def yield_deformation(self) -> float:
        """Reference deformation of the ductility [m]."""
        return self._made.yield_deformation

    def follow(self, path: npt.ArrayLike) -> Loop:
        """Response along deformations [m] from an undeformed start, linear between points.

                Each row of a multidimensional array is a path. Response is exact: extra points between turning points
        do not change it. Raises InputError for values that are not finite numbers."""
        deformation = arguments.numbers("path", path)
        if not np.isfinite(deformation).all():
            raise InputError("path: a deformation is not finite")
        rows = deformation.reshape(-1, deformation.shape[-1]) if deformation.ndim else deformation.reshape(1, 1)
        return Loop(deformation, *(values.reshape(deformation.shape) for values in self._made.follow(rows)))


class _Kinds(Mapping[str, YieldingKind]):
    """Laws of yielding by name."""

    def __init__(self) -> None:
        self._kinds = {entry["name"]: _kind(entry) for entry in core.yielding_catalogue()}

    def __getitem__(self, name: str) -> YieldingKind:
        if not isinstance(name, str):
            raise arguments.refuse("hysteresis[...]", "the name of a law of yielding", name)
        if name in self._kinds:
            return self._kinds[name]
        near = difflib.get_close_matches(name[:100], self._kinds, 1)
        hint = f'Did you mean "{near[0]}"?' if near else f"Allowed: {', '.join(self._kinds)}."
        raise InputError(f"unknown law of yielding {excerpt(name)}. {hint}")

    def __iter__(self) -> Iterator[str]:
        return iter(self._kinds)

    def __len__(self) -> int:
        return len(self._kinds)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self._kinds

    def __repr__(self) -> str:
        return f"<laws of yielding: {', '.join(self._kinds)}>"


def _kind(entry: dict[str, Any]) -> YieldingKind:
    parameters = tuple(YieldingParameter(*values) for values in entry["parameters"])
    choices = tuple(YieldingChoice(name, meaning, tuple(words)) for name, meaning, words in entry["choices"])
    return YieldingKind(**entry | {"parameters": parameters, "choices": choices})


def _number(name: str, value: Quantity, unit: str) -> float:
    value = arguments.quantity(name, value)
    if not isinstance(value, str):
        return float(value)
    try:
        return core.quantity(value, unit, 1.0)
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


hysteresis: Mapping[str, YieldingKind] = _Kinds()
