"""Protection of commands from the working folder, which may be untrusted: they import no module and read no settings
of matplotlib from it.

Scripts and notebooks are not affected."""

from __future__ import annotations

import os
import sys


def leave_working_folder_out() -> None:
    """Prepares this process for a command; call it before importing numpy and matplotlib."""
    _leave_modules_out()
    _leave_settings_out()


def _leave_modules_out() -> None:
    """Removes the working folder, which `python3 -m` and empty entries of PYTHONPATH add, from the module path of
    this process and its children. It is kept if this package is in it."""
    try:
        here = os.path.realpath(os.getcwd())
    except OSError:
        return
    if here == os.path.realpath(os.path.dirname(os.path.dirname(__file__))):
        return
    sys.path[:] = [folder for folder in sys.path if os.path.realpath(folder) != here]
    os.environ["PYTHONSAFEPATH"] = "1"
    given = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    if kept := [os.path.abspath(folder) for folder in given if os.path.realpath(folder) != here]:
        os.environ["PYTHONPATH"] = os.pathsep.join(kept)
    else:
        os.environ.pop("PYTHONPATH", None)


def _leave_settings_out() -> None:
    """Imports matplotlib from another folder if the working folder contains matplotlibrc, which can name programs to
    run and modules to load."""
    if "matplotlib" in sys.modules or not os.path.exists("matplotlibrc"):
        return
    here = os.getcwd()
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        pass  # The drawing module reports the missing package.
    finally:
        os.chdir(here)
