"""The history of one contact, for programs that step in time."""

from __future__ import annotations

from typing import Any

from pounding._arguments import number, takes
from pounding._native import core
from pounding.errors import InputError


class ContactState:
    """State of the contact of two bodies with a law, from `Law.start()`. As in the C interface:

        state = laws["hertz"](stiffness=2.75e9).start()
        force, by_penetration, by_rate = state.respond(1e-3, 0.2)    # any number of times: changes nothing
        state.accept(1e-3, 0.2)                                      # once per accepted step

    `accept` begins an impact at the first state in which the bodies overlap, with its rate as closing speed, and ends it
    when they no longer do. A program that locates these instants calls `touch` and `separate` there, and `accept` for the
    states between. `copy` keeps a state, to undo a step.

    Signs: penetration > 0 [m] is overlap, without the gap; rate > 0 [m/s] closes; force > 0 [N] pushes apart."""

    def __init__(self, made: core.Law, law: str) -> None:
        self._made, self._law = made, law
        self._contact = made.contact()

    @property
    def touching(self) -> bool:
        """True during an impact."""
        return self._contact.touching

    @property
    def indentation(self) -> float:
        """Penetration left by earlier impacts, for laws that leave one; added to the gap [m]."""
        return self._contact.history[1]

    @property
    def closing_speed(self) -> float:
        """Closing speed of the current or the last impact, or the design velocity of the law [m/s]."""
        return self._contact.history[2]

    @property
    def largest_penetration(self) -> float:
        """In the current or the last impact [m]."""
        return self._contact.history[4]

    @takes(penetration=number(), rate=number())
    def respond(self, penetration: float, rate: float) -> tuple[float, float, float]:
        """Force and its slopes; zero unless the bodies overlap during an impact.

        Parameters
        ----------
        penetration : float
            Overlap [m].
        rate : float
            Its rate [m/s].

        Returns
        -------
        tuple of float
            Force [N] and its slopes by penetration [N/m] and by rate [N s/m].
        """
        return self._contact.respond(penetration, rate)

    @takes(penetration=number(), rate=number())
    def accept(self, penetration: float, rate: float) -> None:
        """Updates the history with an accepted state.

        Parameters
        ----------
        penetration : float
            Overlap [m].
        rate : float
            Its rate [m/s].

        Raises
        ------
        InputError
            The penetration is beyond the design of the law; the state is unchanged.
        """
        self._contact.accept(penetration, rate)

    @takes(closing_speed=number(0))
    def touch(self, closing_speed: float) -> None:
        """Begins an impact.

        Parameters
        ----------
        closing_speed : float
            Closing speed at contact [m/s].

        Raises
        ------
        InputError
            An impact is in progress.
        """
        if self.touching:
            raise InputError("an impact is in progress; call separate to end it")
        self._contact.touch(closing_speed)

    @takes(penetration=number())
    def separate(self, penetration: float = 0.0) -> None:
        """Ends the impact.

        Parameters
        ----------
        penetration : float
            Penetration at separation [m].

        Raises
        ------
        InputError
            No impact is in progress.
        """
        if not self.touching:
            raise InputError("no impact is in progress; call touch or accept to begin one")
        self._contact.separate(penetration)

    def copy(self) -> ContactState:
        """An independent copy.

        Returns
        -------
        ContactState
            The same state of another contact.
        """
        other = ContactState(self._made, self._law)
        other._contact.restore(self._contact.history)
        return other

    __copy__ = copy

    def __deepcopy__(self, _: dict[int, Any]) -> ContactState:
        return self.copy()

    def __repr__(self) -> str:
        state = f"in contact since {self.closing_speed:.4g} m/s" if self.touching else "open"
        return f"<pounding.ContactState of {self._law}: {state}>"
