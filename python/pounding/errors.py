"""What goes wrong, with the texts of the program `pounding`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pounding.results import Run


class InputError(ValueError):
    """Wrong input. The text says where, what was read, what is allowed and what to type."""


class SolverError(RuntimeError):
    """A run that failed. The text says at which time and why."""

    def __init__(self, text: str, results: Run | None = None) -> None:
        super().__init__(text)
        self.results = results  #: what was computed until then


class Interrupted(KeyboardInterrupt):
    """A run that Ctrl-C, or the button of a notebook, ended."""

    def __init__(self, text: str, results: Run) -> None:
        super().__init__(text)
        self.results = results  #: what was computed until then


class AccuracyWarning(UserWarning):
    """Results that should not be trusted as they are."""
