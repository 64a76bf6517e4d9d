"""Errors and warnings of the package, with the messages of the program."""

from __future__ import annotations

import reprlib
import unicodedata
from typing import Any

__all__ = ["AccuracyWarning", "ImplausibleWarning", "InputError", "Interrupted", "SolverError"]

#: Maximum length of a message, as in the program, and of a quoted value.
LONGEST_MESSAGE, LONGEST_EXCERPT = 1800, 200


def shortened(text: str) -> str:
    """The text without its middle if it is too long for a message; its end names the remedy."""
    return text if len(text) <= LONGEST_MESSAGE else f"{text[: LONGEST_MESSAGE - 605]} ... {text[-600:]}"


def excerpt(value: object) -> str:
    """A value as quoted in a message: the start of a long one."""
    if isinstance(value, str):
        return f'"{value}"' if len(value) <= LONGEST_EXCERPT else f'"{value[:LONGEST_EXCERPT]}..."'
    if isinstance(value, (bytes, bytearray)):
        shown = repr(value[: LONGEST_EXCERPT + 1])
    else:
        try:
            shown = reprlib.repr(value)
        except Exception:  # an object without a representation
            shown = f"an object of type {type(value).__name__}"
    return shown if len(shown) <= LONGEST_EXCERPT else shown[:LONGEST_EXCERPT] + "..."


class InputError(ValueError):
    """Wrong input. The message states the place, the value read, the allowed values and the remedy."""

    def __init__(self, text: object = "") -> None:
        super().__init__(
            "".join(
                letter if letter == "\n" or _is_shown(letter) else letter.encode("unicode_escape").decode()
                for letter in shortened(str(text))
            )
        )


def _is_shown(letter: str) -> bool:
    """True if a character is printed as such; quoted files may contain characters that move the cursor of a
    terminal."""
    return (
        letter.isascii()
        and letter.isprintable()
        or not letter.isascii()
        and unicodedata.category(letter) not in ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")
    )


class SolverError(RuntimeError):
    """A failed run. The message states the time and the reason."""

    def __init__(self, text: str, results: Any = None) -> None:
        super().__init__(text)
        self.results = results  #: a `pounding.Run` with the results until then, or None


class Interrupted(KeyboardInterrupt):
    """A run stopped by Ctrl-C or by the stop button of a notebook."""

    def __init__(self, text: str, results: Any = None) -> None:
        super().__init__(text)
        self.results = results  #: a `pounding.Run` with the results until then


class AccuracyWarning(UserWarning):
    """The energy balance of a run does not close: its results may be inaccurate."""


class ImplausibleWarning(UserWarning):
    """A model or run has values implausible for buildings, usually because of a missing unit. `accept` of the model
    suppresses such warnings."""
