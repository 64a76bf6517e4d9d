"""The compiled part of the package, or what to type where it is missing. Pictures and results files do without it."""

import atexit

try:
    from pounding import _core as core
except ImportError as error:
    raise ImportError(f"the compiled part of pounding cannot be loaded: {error}. Type `python3 -m pip install .` in the source "
                      "directory, or set PYTHONPATH to build/python after `make`") from error

# Before the interpreter goes; mpi4py, when it started MPI, ends it after this.
atexit.register(core.end_petsc)

__all__ = ["core"]
