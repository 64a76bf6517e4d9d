"""Contact laws on numpy arrays, their tables, free impacts and calibration. SI units.

Penetration > 0 [m] is overlap, rate > 0 [m/s] closes, force > 0 [N] pushes apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeVar, cast

import numpy as np
import numpy.typing as npt

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding._arguments import flag, number, optional, quantity, takes, text
from pounding._contact_state import ContactState
from pounding._law_parameters import Given, Parameter, Quantity, by_key, number_in, numbers_of
from pounding._native import core
from pounding.errors import InputError

__all__ = ["Formula", "FreeImpact", "Law", "LawKind", "Laws", "Parameter", "Response", "calibrate", "laws"]

#: A number or an array of numbers.
Numbers = npt.ArrayLike
#: Results: an array, or a number if all arguments are numbers.
Values = npt.NDArray[np.float64]


def described(name: str, summary: str, shape: str, source: str, parameters: Iterable[Parameter]) -> list[str]:
    """Description of a law, one line per parameter."""
    return [f"{name}: {summary}", f"  {shape}", f"  {source}"] + [
        f"  {p.name} [{p.unit or '-'}]  {p.meaning} ({p.need}), typically {_shown(p.typical)}" for p in parameters
    ]


def _shown(typical: float | list[float] | bool) -> str:
    return f"{typical:g}" if isinstance(typical, float) else str(typical)


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
class FreeImpact(printing.ReportLines, lines=printing.free_impact):
    """Result of free impacts of two bodies; every array has the shape of the closing speeds."""

    restitution: Values  #: separation speed over closing speed [-]
    peak_force: Values  #: [N]; infinite for an instantaneous law
    time_of_peak: Values  #: time of the peak force, from first contact [s]
    peak_penetration: Values  #: [m]
    duration: Values  #: from first contact until the force stays zero [s]
    energy_lost: Values  #: work on the link that is dissipated [J]
    impulse: Values  #: integral of the force [N s]
    closed_form: tuple[str, ...]  #: names of the quantities with a closed form; the others are integrated to 1e-10


class _Named(Protocol):
    @property
    def name(self) -> str: ...


Kind = TypeVar("Kind", bound=_Named)


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
        arrays = [arguments.numbers(key, values) for key, values in given.items()]
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
        ask = law.responses if slopes else law.forces
        return ask(arrays[0], arrays[1], arrays[2], in_order)

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


class Kinds(Mapping[str, Kind]):
    """Laws by name. `variable` is the name of the object in its module, `noun` that of its items in messages."""

    variable: str
    noun: str

    def __init__(self, kinds: Iterable[Kind]) -> None:
        self._kinds = {kind.name: kind for kind in kinds}

    def __getitem__(self, name: str) -> Kind:
        place = f"{self.variable}[...]"
        if not isinstance(name, str):
            raise arguments.refuse(place, f"the name of a {self.noun}", name)
        if arguments.text(place, name) not in self._kinds:
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
        raise NotImplementedError


class Laws(Kinds[LawKind]):
    """The contact laws by name: `laws["jankowski"](stiffness=2.75e9, restitution=0.65, reduced_mass=6e4)`."""

    variable, noun = "laws", "law"

    def __init__(self) -> None:
        super().__init__(map(_kind, core.catalogue()))

    def _unknown(self, name: str) -> str:
        return core.unknown_law(name)


@takes(
    law=text,
    m1=quantity,
    m2=quantity,
    restitution=optional(quantity),
    stiffness=optional(quantity),
    velocity=optional(quantity),
    exponent=optional(quantity),
    parameters=quantity,
)
def calibrate(
    law: str,
    *,
    m1: Quantity,
    m2: Quantity = "wall",
    restitution: Quantity | None = None,
    stiffness: Quantity | None = None,
    velocity: Quantity | None = None,
    exponent: Quantity | None = None,
    **parameters: Quantity,
) -> dict[str, Any]:
    """Damping of a law for a restitution by every formula, and the restitution obtained in a free impact.

    Parameters
    ----------
    law : str
        Name of the law.
    m1 : float or str
        Mass of one body [kg].
    m2 : float or str
        Mass of the other body [kg]; "wall" for a rigid wall.
    restitution : float or str, optional
        Requested restitution.
    stiffness : float or str, optional
        Stiffness of the contact.
    velocity : float or str, optional
        Closing speed [m/s].
    exponent : float or str, optional
        Exponent of the law.
    **parameters
        Further parameters of the law.

    Returns
    -------
    dict of str to object
        The object that `pounding calibrate --json` prints. Missing parameters have typical values and are listed in
        "assumed". "formulas" has one entry per formula with restitution, peak_force [N], time_of_peak [s],
        peak_penetration [m], duration [s], energy_lost [J], impulse [N s] and damping, or the reason in "refused".

    Raises
    ------
    InputError
        A parameter is unknown or out of range.

    Examples
    --------
    >>> found = pounding.calibrate("hertz_damped", m1="100 t", restitution=0.65)
    >>> "exact" in [one["formula"] for one in found["formulas"]]
    True
    """
    others = [(name, _word(value)) for name, value in parameters.items()]
    given = _word(restitution), _word(m1), _word(m2), _word(stiffness), _word(velocity), _word(exponent)
    return core.calibrate(law, *given, others)


def _kind(entry: dict[str, Any]) -> LawKind:
    parameters = tuple(Parameter(*values) for values in entry["parameters"])
    formulas = tuple(Formula(*values) for values in entry["formulas"])
    return LawKind(**entry | {"parameters": parameters, "formulas": formulas})


def _word(value: Quantity | None) -> str:
    return "" if value is None else value if isinstance(value, str) else repr(float(value))


laws = Laws()
