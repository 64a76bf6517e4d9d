"""Exit codes of the commands of Python: those of `pounding`, whatever happens."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

from pounding.errors import InputError, SolverError


def exit_code(main: Callable[[], int]) -> int:
    """Runs a command. Returns its code: 0 done, 2 bad input or output that cannot be written, 3 anything else; 130 after Ctrl-C.

    Every exception is one line on standard error. A closed pipe, as by `head`, is no error."""
    # Names of files need not be UTF-8.
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    code, text = _ended(main)
    try:
        if text:
            print(f"pounding: {text}", file=sys.stderr)
        if sys.stdout is not None:  # None where the caller has closed it
            sys.stdout.flush()
    except BrokenPipeError:
        # Python flushes again at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        print(f"pounding: what was printed could not be written: {error.strerror}", file=sys.stderr)
        return code or 2
    return code


def _ended(main: Callable[[], int]) -> tuple[int, str]:
    """Code and message of a command."""
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
        return 130, "stopped"
    except OSError as error:
        return 2, str(error)
    except Exception as error:
        return 3, f"a fault of this program: {type(error).__name__}: {error}. Please report it with what you typed"
