"""Rules of codes for the gap between structures, as data: displacements with their factors, widths by height, and the
statistic over ground motions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

#: Standard gravity [m/s^2].
GRAVITY = 9.80665


class Missing(Exception):
    """An input of a rule that was not given: the key to type."""

    def __init__(self, key: str) -> None:
        super().__init__(key)
        self.key = key


@dataclass(frozen=True)
class Place:
    """A level of a pair of structures, or of one structure."""

    height: float | None  #: of the level above the ground [m]
    inputs: Mapping[str, Any]  #: keys of `behaviour`
    aligned: bool = False  #: floors of the neighbours at equal elevations
    lower: float | None = None  #: height of the lower structure [m]
    own: float | None = None  #: height of the structure itself [m]
    storeys: int | None = None  #: of the structure itself

    def value(self, key: str) -> Any:
        """An input. Raises Missing."""
        if self.inputs.get(key) is None:
            raise Missing(key)
        return self.inputs[key]

    def known(self, name: str) -> float:
        """A height [m] or number of storeys. Raises Missing."""
        value = getattr(self, name)
        if value is None:
            raise Missing("heights of the floors in the model, such as storey_height or height")
        return float(value)


class Width(Protocol):
    """A width that does not depend on displacements."""

    @property
    def text(self) -> str:
        """Formula for tables."""

    def __call__(self, place: Place) -> float:
        """The width [m]. Raises Missing."""


@dataclass(frozen=True)
class Fixed:
    """A constant width."""

    metres: float
    text: str

    def __call__(self, place: Place) -> float:
        return self.metres


@dataclass(frozen=True)
class Proportional:
    """A multiple of the height of the level and of inputs."""

    rate: float
    by: tuple[str, ...]
    text: str

    def __call__(self, place: Place) -> float:
        return self.rate * math.prod(float(place.value(key)) for key in self.by) * place.known("height")


@dataclass(frozen=True)
class ByZone:
    """A multiple of the height of the level that depends on a zone."""

    rates: Mapping[str, float]
    text: str

    def __call__(self, place: Place) -> float:
        return self.rates[str(place.value("zone"))] * place.known("height")


@dataclass(frozen=True)
class Steps:
    """A width up to a height, and an increment for every started step above it."""

    width: float
    up_to: float
    step: float
    increment: float
    text: str

    def __call__(self, place: Place) -> float:
        return self.width + self.increment * _steps(place.known("height") - self.up_to, self.step)


@dataclass(frozen=True)
class StepsBySystem:
    """`Steps` by the height of the lower structure, with the step of an intensity, times the fraction of a structural
    system."""

    width: float
    up_to: float
    steps: Mapping[int, float]  #: intensity -> step [m]
    increment: float
    fractions: Mapping[str, float]  #: structural system -> fraction
    minimum: float
    steel: float  #: factor for steel structures
    text: str

    def __call__(self, place: Place) -> float:
        count = _steps(place.known("lower") - self.up_to, self.steps[int(place.value("intensity"))])
        width = (self.width + self.increment * count) * self.fractions[str(place.value("system"))]
        return max(self.minimum, width) * (self.steel if place.inputs.get("steel") else 1.0)


@dataclass(frozen=True)
class ByStoreys:
    """A fraction of the height of the structure itself that depends on its storeys and on the floors."""

    rows: tuple[tuple[float, float, float], ...]  #: maximum of storeys, fraction for aligned and for offset floors
    text: str

    def __call__(self, place: Place) -> float:
        storeys = place.known("storeys")
        aligned, offset = next((a, o) for maximum, a, o in self.rows if storeys <= maximum)
        fraction = aligned if place.aligned else offset
        return fraction * place.known("own") if fraction else 0.0


@dataclass(frozen=True)
class Largest:
    """The largest of several widths."""

    widths: tuple[Width, ...]

    @property
    def text(self) -> str:
        """Formulas of all widths."""
        return "max(" + ", ".join(width.text for width in self.widths) + ")"

    def __call__(self, place: Place) -> float:
        return max(width(place) for width in self.widths)


def _steps(above: float, step: float) -> int:
    """Number of started steps; a millionth of a step is round-off."""
    return max(0, math.ceil(above / step - 1e-6))


@dataclass(frozen=True)
class Factor:
    """A product of inputs divided by others, for displacements under reduced motions."""

    times: tuple[str, ...]
    over: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The factor as typed in a formula."""
        return " ".join(self.times) + "".join(f" / {key}" for key in self.over)

    def __call__(self, place: Place) -> float:
        above = math.prod(float(place.value(key)) for key in self.times)
        return above / math.prod(float(place.value(key)) for key in self.over)


@dataclass(frozen=True)
class Statistic:
    """The value over ground motions: the mean from a number of records on, otherwise the largest."""

    mean_from: int | None  #: None: always the largest
    least: int  #: minimum number of records of the code; 1 if it states none
    source: str  #: clause, or the reason of the choice

    @property
    def text(self) -> str:
        """Statistic and number of records."""
        least = f"; at least {self.least} records" if self.least > 1 else ""
        return (
            "largest" if self.mean_from is None else f"mean from {self.mean_from} records on, otherwise the largest"
        ) + least


@dataclass(frozen=True)
class Example:
    """A worked example: displacements [m], inputs and results [m]."""

    left: float
    right: float
    displacements: str
    inputs: Mapping[str, Any]  #: of both structures
    expected: Mapping[str, float]  #: case -> gap [m]: offset, aligned, similar (also aligned), line
    source: str
    right_inputs: Mapping[str, Any] = field(default_factory=dict)  #: of the right structure, if different
    height: float | None = None  #: of level and structures [m]
    storeys: int | None = None


@dataclass(frozen=True)
class Rule:
    """The rule of one code."""

    name: str
    clause: str
    region: str
    combination: str  #: "srss", "sum", or "" for a rule without displacements
    statistic: Statistic
    verified: bool  #: the text of this edition was read in a public source
    source: str  #: what was read and where, or that the rule is from professional knowledge
    example: Example
    factor: Factor | None = None  #: of displacements under reduced motions
    aligned: float = 1.0  #: factor on the combination if floors are aligned
    offset: float = 1.0  #: factor on the combination if they are not
    only_similar: bool = False  #: the factor for aligned floors needs similar neighbours
    added: Width | None = None  #: added to the displacement of each structure
    minimum: Width | None = None  #: of the gap of a pair
    #: "own": each structure is set back by its displacement, so a pair needs the sum; "unknown": the displacement of
    #: the neighbour is that of the structure itself; "half": displacement, and half of the minimum of a pair;
    #: "width": the minimum of `line_minimum` alone; "" without a rule
    line: str = "own"
    line_minimum: Width | None = None  #: of each structure
    #: storeys up to which `added` replaces the displacement; 0: never
    storeys_by_height: int = 0
    notes: tuple[str, ...] = ()

    @property
    def mark(self) -> str:
        """Mark for every output."""
        return "" if self.verified else "check the edition"
