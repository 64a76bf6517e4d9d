"""Errors and warnings of the package. Their texts are those of the program `pounding`."""

from __future__ import annotations

import reprlib
import unicodedata
from typing import Any

#: Characters of a message, at most, as in the program; and those that it quotes of one value.
LONGEST_MESSAGE, LONGEST_EXCERPT = 1800, 200


def shortened(text: str) -> str:
    """The text without its middle if it is longer than a message may be: its end says what to type."""
    return text if len(text) <= LONGEST_MESSAGE else f"{text[: LONGEST_MESSAGE - 605]} ... {text[-600:]}"


def excerpt(value: object) -> str:
    """A value as a message quotes it: its beginning if it is long."""
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
    """Wrong input. The text says where it is, what was read, what is allowed and what to type."""

    def __init__(self, text: object = "") -> None:
        super().__init__(
            "".join(
                letter if letter == "\n" or _is_shown(letter) else letter.encode("unicode_escape").decode()
                for letter in shortened(str(text))
            )
        )


def _is_shown(letter: str) -> bool:
    """Whether a character is shown as itself: what a file quotes may hold characters that move the cursor of a
    terminal."""
    return (
        letter.isascii()
        and letter.isprintable()
        or not letter.isascii()
        and unicodedata.category(letter) not in ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")
    )


class SolverError(RuntimeError):
    """A run that failed. The text says at which time and why."""

    def __init__(self, text: str, results: Any = None) -> None:
        super().__init__(text)
        self.results = results  #: a `pounding.Run` with what was computed until then; None where there is nothing


class Interrupted(KeyboardInterrupt):
    """A run that Ctrl-C, or the stop button of a notebook, ended."""

    def __init__(self, text: str, results: Any = None) -> None:
        super().__init__(text)
        self.results = results  #: a `pounding.Run` with what was computed until then


class AccuracyWarning(UserWarning):
    """The energies of a run do not close: its results should not be trusted as they are."""


class ImplausibleWarning(UserWarning):
    """A model, or a run of it, holds numbers far from those of buildings, mostly by a unit that is missing. `accept` of
    the model silences what is meant."""
