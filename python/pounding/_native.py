"""The compiled part of the package, as `core`. If it is missing, ImportError names the command to install it.
Pictures and results files do not need it."""

import atexit
import contextlib
import sys

try:
    from pounding import _core as core
except ImportError as error:
    raise ImportError(
        f"the compiled part of pounding cannot be loaded: {error}. Type `make` in the source directory, which compiles "
        "it for build/pounding, or `python3 -m venv env` and then `env/bin/python3 -m pip install .`; scripts also need "
        "build/python in PYTHONPATH after `make`"
    ) from error


def _end() -> None:
    """Ends PETSc before the interpreter; if mpi4py started MPI, it ends MPI afterwards."""
    # Python keeps the exception that ended the program; at a prompt (ps1) it keeps those of single lines too.
    failed = hasattr(sys, "last_value") and not hasattr(sys, "ps1")
    for stream in (sys.stdout, sys.stderr):
        # Without a terminal a stream is None; a pipe may be closed at its other end.
        with contextlib.suppress(AttributeError, OSError, ValueError):
            stream.flush()
    core.end_petsc(failed)


atexit.register(_end)

__all__ = ["core"]
