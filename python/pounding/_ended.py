"""Exit codes of Python commands, the same as those of `pounding`."""

from __future__ import annotations

import io
import os
import sys
import warnings
from collections.abc import Callable
from typing import Any, TextIO, cast

from pounding.errors import InputError, SolverError


def exit_code(main: Callable[[], int]) -> int:
    """Exit code of a command that it calls: 0 done, 2 wrong input or an unwritable output, 3 other errors and Ctrl-C.

    Every exception is one line on standard error. A closed pipe, as by `head`, is not an error."""
    before = sys.stdout, sys.stderr
    output, errors = _Stream(sys.stdout), _Stream(sys.stderr)
    sys.stdout, sys.stderr = cast(Any, output), cast(Any, errors)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = show_warning
            code, text = _ended(main)
        if text:
            print(f"pounding: {text}", file=sys.stderr)
        output.flush()
        if output.error is not None and not isinstance(output.error, BrokenPipeError):
            print(f"pounding: the output could not be written: {output.error.strerror}", file=sys.stderr)
            code = code or 2
        errors.flush()
        return code
    finally:
        sys.stdout, sys.stderr = before


def show_warning(message: Warning | str, *_: Any, **__: Any) -> None:
    """Prints a warning as the program does, for `warnings.showwarning`."""
    print(f"pounding: warning: {message}", file=sys.stderr)


class _Stream:
    """A standard stream whose write errors do not end the command; the first one is stored. None if the stream is
    closed."""

    def __init__(self, stream: TextIO | None) -> None:
        self._stream = stream
        self.error: OSError | None = None
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")  # names of files need not be UTF-8

    def write(self, text: str) -> int:
        self._try(lambda stream: stream.write(text))
        return len(text)

    def flush(self) -> None:
        self._try(lambda stream: stream.flush())

    def _try(self, act: Callable[[TextIO], object]) -> None:
        if self._stream is None or self.error is not None:
            return
        try:
            act(self._stream)
        except OSError as error:
            self.error = error
            # Python flushes again at its end.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def _ended(main: Callable[[], int]) -> tuple[int, str]:
    """Exit code and message of a command."""
    try:
        return main(), ""
    except SystemExit as ended:  # of argparse, which has printed its message
        return ended.code if isinstance(ended.code, int) else 0 if ended.code is None else 2, ""
    except BrokenPipeError:
        return 0, ""
    except (InputError, ImportError) as error:
        return 2, str(error)
    except SolverError as error:
        return 3, str(error)
    except MemoryError:
        return 3, "out of memory"
    except KeyboardInterrupt:
        return 3, "stopped"
    except OSError as error:
        known = error.filename is not None and error.strerror
        return 2, f"{error.filename}: {error.strerror}" if known else str(error)
    except Exception as error:
        return 3, f"internal error: {type(error).__name__}: {error}. Please report it with what you typed"
