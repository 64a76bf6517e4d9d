"""Laws of yielding along paths of numpy arrays: storeys, hinges, isolators, soil. SI units.

    law = pounding.hysteresis["bouc_wen"](stiffness="10 MN/m", yield_force="150 kN", hardening=0.05)
    loop = law.follow([0, 0.03, -0.03, 0.01])
    loop.force, loop.work

A deformation is in m and a force in N; at a hinge rad and N m.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from pounding import _arguments as arguments
from pounding._law_parameters import Given, Kinds, Parameter, Values, described, numbers_of
from pounding._native import core
from pounding.errors import InputError


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
    """A hysteretic law with its tables. Call it with parameters to get a `YieldingLaw`."""

    name: str
    shape: str  #: the force as a formula
    summary: str
    source: str
    parameters: tuple[Parameter, ...]
    choices: tuple[YieldingChoice, ...]
    has_corners: bool  #: True if the slope also jumps away from turning points

    def __call__(self, **parameters: Given | None) -> YieldingLaw:
        """The law with these parameters.

        Parameters
        ----------
        **parameters
            Numbers in SI, texts with units, or names of choices.

        Returns
        -------
        YieldingLaw
            The law.

        Raises
        ------
        InputError
            A parameter is unknown, missing or out of range.
        """
        return YieldingLaw(self, parameters)

    def __str__(self) -> str:
        lines = described(self.name, self.summary, self.shape, self.source, self.parameters)
        lines += [f"  {c.name}: {' or '.join(c.words)}  {c.meaning}" for c in self.choices]
        return "\n".join(lines)


class YieldingLaw:
    """A law with its parameters. Has no history: every path begins undeformed."""

    def __init__(self, kind: YieldingKind, parameters: Mapping[str, Given | None]) -> None:
        given = {name: value for name, value in parameters.items() if value is not None}
        chosen = {choice.name for choice in kind.choices}
        self.kind = kind
        self.choices = {name: arguments.text(name, value) for name, value in given.items() if name in chosen}
        #: in SI; "force[1]", "force[2]" of a list
        self.parameters = numbers_of(
            kind.parameters, {name: value for name, value in given.items() if name not in chosen}
        )
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
        """Response along a path of deformations from an undeformed start, linear between points.

        It is exact: extra points between turning points do not change it.

        Parameters
        ----------
        path : array_like
            Deformations [m]; each row of a multidimensional array is a path.

        Returns
        -------
        Loop
            Force, slope and energies at each point.

        Raises
        ------
        InputError
            A value is not a finite number.

        Examples
        --------
        >>> law = pounding.hysteresis["bilinear"](stiffness="10 MN/m", yield_force="100 kN", hardening=0.1)
        >>> law.follow([0, 0.005, 0.02]).force
        array([     0.,  50000., 110000.])
        """
        deformation = arguments.numbers("path", path)
        if not np.isfinite(deformation).all():
            raise InputError("path: a deformation is not finite")
        rows = deformation.reshape(-1, deformation.shape[-1]) if deformation.ndim else deformation.reshape(1, 1)
        return Loop(deformation, *(values.reshape(deformation.shape) for values in self._made.follow(rows)))


class _Kinds(Kinds[YieldingKind]):
    """Laws of yielding by name."""

    variable, noun = "hysteresis", "hysteretic law"


def _kind(entry: dict[str, Any]) -> YieldingKind:
    parameters = tuple(Parameter(*values) for values in entry["parameters"])
    choices = tuple(YieldingChoice(name, meaning, tuple(words)) for name, meaning, words in entry["choices"])
    return YieldingKind(**entry | {"parameters": parameters, "choices": choices})


hysteresis: Mapping[str, YieldingKind] = _Kinds(map(_kind, core.yielding_catalogue()))
