"""Contact laws on numpy arrays, their tables, free impacts and calibration. SI units.

Penetration > 0 [m] is overlap, rate > 0 [m/s] closes, force > 0 [N] pushes apart.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, cast

import numpy as np

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding._arguments import flag, number, optional, quantity, takes, text
from pounding._calibration import calibrate
from pounding._contact_state import ContactState
from pounding._law_parameters import (
    Given,
    Kinds,
    Numbers,
    Parameter,
    Quantity,
    Values,
    by_key,
    described,
    number_in,
    numbers_of,
    states_of,
)
from pounding._native import core
from pounding.errors import InputError

__all__ = ["Formula", "FreeImpact", "Law", "LawKind", "Laws", "Parameter", "Response", "calibrate", "laws"]


@dataclass(frozen=True)
class Formula:
    """A formula for the damping that belongs to a restitution."""

    name: str
    source: str
    note: str


class Response(NamedTuple):
    """Force and its slopes, with the shape of the states."""

    force: Values  #: [N]
    by_penetration: Values  #: dF/dd [N/m]
    by_rate: Values  #: dF/dd' [N s/m]


@dataclass(frozen=True, repr=False)
class FreeImpact(printing.ReportLines):
    """Result of free impacts of two bodies; every array has the shape of the closing speeds."""

    restitution: Values  #: separation speed over closing speed [-]
    peak_force: Values  #: [N]; infinite for an instantaneous law
    time_of_peak: Values  #: time of the peak force, from first contact [s]
    peak_penetration: Values  #: [m]
    duration: Values  #: from first contact until the force stays zero [s]
    energy_lost: Values  #: work on the link that is dissipated [J]
    impulse: Values  #: integral of the force [N s]
    closed_form: tuple[str, ...]  #: names of the quantities with a closed form; the others are integrated to 1e-10


@dataclass(frozen=True)
class LawKind:
    """A contact law with its tables. Call it with parameters to get a `Law`."""

    name: str
    shape: str  #: the force as a formula
    summary: str
    source: str
    parameters: tuple[Parameter, ...]  #: in addition to restitution, formula, impact_velocity and reduced_mass
    formulas: tuple[Formula, ...]  #: "exact" first; empty for laws without a choice of damping
    takes_restitution: bool
    takes_impact_velocity: bool
    takes_reduced_mass: bool
    may_pull: bool
    leaves_indentation: bool
    instantaneous: bool

    def __call__(
        self,
        *,
        restitution: Quantity | None = None,
        formula: str | None = None,
        impact_velocity: Quantity | None = None,
        reduced_mass: Quantity | None = None,
        **parameters: Given | None,
    ) -> Law:
        """The law with these parameters.

        Damping follows from `restitution` by `formula`, or from one of the parameters that replace a restitution;
        parameters marked "together" replace all others.

        Parameters
        ----------
        restitution : float or str, optional
            Coefficient of restitution in (0, 1]; stereomechanical and kelvin_voigt also accept 0.
        formula : str, optional
            Name of the formula for the damping, by default "exact".
        impact_velocity : float or str, optional
            Fixed design velocity [m/s]; by default each impact has its own.
        reduced_mass : float or str, optional
            m1 m2/(m1+m2) of the bodies [kg], if the damping depends on it.
        **parameters
            Parameters of the law by name, listed by `print(laws[NAME])`.

        Returns
        -------
        Law
            The law.

        Raises
        ------
        InputError
            A parameter is unknown, missing or out of range.

        Examples
        --------
        >>> pounding.laws["hertz"](stiffness="2.75 GN/m^1.5")
        laws["hertz"](stiffness=2750000000.0)
        """
        return Law(self, restitution, formula, impact_velocity, reduced_mass, parameters)

    def __str__(self) -> str:
        lines = described(self.name, self.summary, self.shape, self.source, self.parameters)
        lines += [f"  formula {f.name}: {f.source}; {f.note}" for f in self.formulas]
        return "\n".join(lines)


class Law:
    """A law with its parameters. Pure: it has no history; `start` makes the state of a contact."""

    def __init__(
        self,
        kind: LawKind,
        restitution: Quantity | None,
        formula: str | None,
        impact_velocity: Quantity | None,
        reduced_mass: Quantity | None,
        parameters: Mapping[str, Given | None],
    ) -> None:
        given = {name: value for name, value in parameters.items() if value is not None}
        exponent = next((cast(float, p.typical) for p in kind.parameters if p.name == "exponent"), 1.0)
        if "exponent" in given:
            exponent = number_in("exponent", cast("float | str", given["exponent"]), "")
        self.kind = kind
        self.formula = optional(text)("formula", formula)
        self.restitution = None if restitution is None else number_in("restitution", restitution, "")
        self.impact_velocity = None if impact_velocity is None else number_in("impact_velocity", impact_velocity, "m/s")
        self.reduced_mass = None if reduced_mass is None else number_in("reduced_mass", reduced_mass, "kg")
        #: in SI; "force[1]", "force[2]" of a list
        self.parameters = numbers_of(kind.parameters, given, exponent)
        # Without reduced_mass the parameters are checked with another mass; functions that need the mass require it.
        self._made: core.Law | None = self._make(1.0 if self.reduced_mass is None else self.reduced_mass)
        if self.reduced_mass is None and kind.takes_reduced_mass:
            try:
                self._made = self._make(0.0)
            except InputError:
                self._made = None

    def __reduce__(self) -> tuple[Any, ...]:
        # Copies and pickles rebuild the compiled law from the parameters, bitwise identical.
        velocity, mass = self.impact_velocity, self.reduced_mass
        return Law, (self.kind, self.restitution, self.formula, velocity, mass, self.parameters)

    def force(
        self,
        penetration: Numbers,
        rate: Numbers,
        approach_velocity: Numbers | None = None,
        *,
        reduced_mass: Quantity | None = None,
        in_order: bool = False,
    ) -> Values:
        """Contact force of states, arrays that broadcast together. NaN gives NaN.

        Parameters
        ----------
        penetration : array_like
            Overlap [m].
        rate : array_like
            Its rate [m/s].
        approach_velocity : array_like, optional
            Closing speed of the impact [m/s], if the damping depends on it.
        reduced_mass : float or str, optional
            Reduced mass of the bodies [kg], by default that of the law.
        in_order : bool
            True if each row is one impact, for laws with memory; otherwise each state is the first of its impact.

        Returns
        -------
        numpy.ndarray or float
            Force [N].

        Raises
        ------
        InputError
            An argument is missing or out of range.

        Examples
        --------
        >>> law = pounding.laws["hertz"](stiffness=1e9)
        >>> law.force([-1e-3, 0.0, 1e-3], 0.1).round()
        array([    0.,     0., 31623.])
        """
        return self._asked(penetration, rate, approach_velocity, reduced_mass, in_order, slopes=False)[()]

    def respond(
        self,
        penetration: Numbers,
        rate: Numbers,
        approach_velocity: Numbers | None = None,
        *,
        reduced_mass: Quantity | None = None,
        in_order: bool = False,
    ) -> Response:
        """Contact force of states with its slopes.

        Parameters
        ----------
        penetration, rate, approach_velocity, reduced_mass, in_order
            As for `force`.

        Returns
        -------
        Response
            Force [N] and its slopes by penetration [N/m] and by rate [N s/m].

        Raises
        ------
        InputError
            An argument is missing or out of range.
        """
        answer = self._asked(penetration, rate, approach_velocity, reduced_mass, in_order, slopes=True)
        return Response(*(values[()] for values in answer))

    def start(self) -> ContactState:
        """The state of a contact of two bodies that have never touched, for programs that step in time.

        Returns
        -------
        ContactState
            The state.

        Raises
        ------
        InputError
            The law is instantaneous, or its damping needs a `reduced_mass`.

        Examples
        --------
        >>> state = pounding.laws["hertz"](stiffness=1e9).start()
        >>> state.accept(1e-3, 0.2)
        >>> state.touching
        True
        """
        if self.kind.instantaneous:
            raise InputError(f"{self.kind.name} has no force history")
        return ContactState(self._with_mass(None), self.kind.name)

    @takes(closing_speed=arguments.numbers, reduced_mass=optional(quantity))
    def free_impact(self, closing_speed: Numbers, reduced_mass: Quantity | None = None) -> FreeImpact:
        """Free impacts of two bodies.

        Parameters
        ----------
        closing_speed : array_like
            Closing speeds [m/s].
        reduced_mass : float or str, optional
            Reduced mass of the bodies [kg], by default that of the law.

        Returns
        -------
        FreeImpact
            Results with the shape of the closing speeds.

        Raises
        ------
        InputError
            A closing speed or the reduced mass is not finite and positive.

        Examples
        --------
        >>> law = pounding.laws["jankowski"](stiffness=2.75e9, restitution=0.65, reduced_mass="60 t")
        >>> round(float(law.free_impact(0.5).restitution), 3)
        0.65
        """
        mass = self.reduced_mass if reduced_mass is None else number_in("reduced_mass", reduced_mass, "kg")
        if mass is None:
            raise InputError("free_impact needs reduced_mass [kg]: m1 m2/(m1+m2) of the two bodies")
        law = self._with_mass(None if self.reduced_mass is not None else mass)
        speeds = np.asarray(closing_speed)
        impacts = [law.free_impact(mass, speed) for speed in speeds.ravel()]
        values = {
            name: np.array([getattr(impact, name) for impact in impacts]).reshape(speeds.shape)[()]
            for name in FreeImpact.__dataclass_fields__
            if name != "closed_form"
        }
        return FreeImpact(**values, closed_form=tuple(impacts[0].closed_form) if impacts else ())

    @takes(closing_speed=number(0, open=True))
    def describe(self, closing_speed: float = 1.0) -> dict[str, tuple[float, str]]:
        """Every parameter, the damping number and the damping coefficient.

        Parameters
        ----------
        closing_speed : float
            Closing speed of the impact [m/s].

        Returns
        -------
        dict of str to tuple
            Value and SI unit by name.
        """
        return {name: (value, unit) for name, value, unit in self._with_mass(None).describe(closing_speed)}

    def __str__(self) -> str:
        return "\n".join(printing.law(self))

    def __repr__(self) -> str:
        return f'laws["{self.kind.name}"]({", ".join(f"{name}={value!r}" for name, value in self.given().items())})'

    def given(self) -> dict[str, Any]:
        """The parameters that are given, in SI, by their keys in the input.

        Returns
        -------
        dict of str to object
            Values by key.
        """
        names = ("restitution", "formula", "impact_velocity", "reduced_mass")
        found = {name: getattr(self, name) for name in names} | by_key(self.kind.parameters, self.parameters)
        return {name: value for name, value in found.items() if value is not None}

    def _asked(
        self,
        penetration: Numbers,
        rate: Numbers,
        approach_velocity: Numbers | None,
        reduced_mass: Quantity | None,
        in_order: bool,
        slopes: bool,
    ) -> Any:
        name, in_order = self.kind.name, flag("in_order", in_order)
        if self.kind.instantaneous:
            raise InputError(f"{name} has no force history")
        law = self._with_mass(None if reduced_mass is None else number_in("reduced_mass", reduced_mass, "kg"))
        if approach_velocity is None:
            if law.needs_approach_velocity:
                raise InputError(
                    f"{name} needs approach_velocity [m/s], the closing speed of the impact: its damping depends on it"
                )
            approach_velocity = 1.0
        given = {"penetration": penetration, "rate": rate, "approach_velocity": approach_velocity}
        depth, speed, closing = states_of(given, in_order)
        return (law.responses if slopes else law.forces)(depth, speed, closing, in_order)

    def _with_mass(self, mass: float | None) -> core.Law:
        if mass is not None:
            return self._make(mass)
        if self._made is None:
            raise InputError(
                f"{self.kind.name} needs reduced_mass [kg], m1 m2/(m1+m2) of the two bodies: its damping depends on it"
            )
        return self._made

    def _make(self, mass: float) -> core.Law:
        return core.Law(
            self.kind.name, self.formula or "", self.restitution, self.impact_velocity, mass, self.parameters
        )


class Laws(Kinds[LawKind]):
    """The contact laws by name: `laws["jankowski"](stiffness=2.75e9, restitution=0.65, reduced_mass=6e4)`."""

    variable, noun = "laws", "law"

    def _unknown(self, name: str) -> str:
        return core.unknown_law(name)


def _kind(entry: dict[str, Any]) -> LawKind:
    parameters = tuple(Parameter(*values) for values in entry["parameters"])
    formulas = tuple(Formula(*values) for values in entry["formulas"])
    return LawKind(**entry | {"parameters": parameters, "formulas": formulas})


laws = Laws(map(_kind, core.catalogue()))
