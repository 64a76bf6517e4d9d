"""The commands of this package use no module of Python and no settings of matplotlib from the working folder: a folder
with a model may come from anywhere. In your own scripts and notebooks Python and matplotlib work as usual."""

from __future__ import annotations

import os
import sys


def leave_working_folder_out() -> None:
    """Prepares this process for a command: call it before numpy and matplotlib are imported."""
    _leave_modules_out()
    _leave_settings_out()


def _leave_modules_out() -> None:
    """Removes the working folder from the module path of this process and of those that it starts: `python3 -m` and
    empty entries of PYTHONPATH add it. It stays if this package is in it."""
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
    """Imports matplotlib from another folder if the working folder has a file matplotlibrc: its settings name programs
    to run and modules to load, and matplotlib prefers them to those of the user."""
    if "matplotlib" in sys.modules or not os.path.exists("matplotlibrc"):
        return
    here = os.getcwd()
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        pass  # The module that draws says what to type.
    finally:
        os.chdir(here)
