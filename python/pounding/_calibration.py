"""Damping of contact laws for a restitution."""

from __future__ import annotations

from typing import Any

from pounding._arguments import optional, quantity, takes, text
from pounding._law_parameters import Quantity
from pounding._native import core


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


def _word(value: Quantity | None) -> str:
    return "" if value is None else value if isinstance(value, str) else repr(float(value))
