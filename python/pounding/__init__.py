"""Adjacent structures that hit each other in earthquakes.

    import pounding

    law = pounding.laws["jankowski"](stiffness=2.75e9, restitution=0.65, reduced_mass=6e4)
    law.force(penetration=[1e-3, 2e-3], rate=0.3)          # numpy arrays, SI

    model = pounding.Model.from_file("model.yaml")         # or Model(structures={...}, links=[...])
    results = pounding.run(model, tolerance=1e-6, output="model.h5")
    results.impacts["restitution"]
    results.plot("force").savefig("force.pdf")

Everything is loaded when it is first used: results files need numpy and h5py, pictures matplotlib as well.
`python3 -m pounding ...` is the program: `python3 -m pounding run MODEL.yaml`.
"""

from __future__ import annotations

import importlib
import sys

# With `python3 -m pounding...`, the package is imported before the name of the script is known.
if getattr(sys, "argv", [])[:1] == ["-m"]:
    from pounding.working_folder import leave_working_folder_out

    leave_working_folder_out()

# True for type checkers only. Importing typing would take two thirds of the import time.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from pounding import animation as animation
    from pounding import contact as contact
    from pounding import models as models
    from pounding import opensees as opensees
    from pounding import plan as plan
    from pounding import results as results
    from pounding._modes import Mode, Modes
    from pounding._pushover import pushover
    from pounding.contact import FreeImpact, Law, Response, calibrate, laws
    from pounding.contact_state import ContactState
    from pounding.errors import AccuracyWarning, ImplausibleWarning, InputError, Interrupted, SolverError
    from pounding.models import Model, check, modes
    from pounding.opensees.from_model import from_opensees
    from pounding.pushover_curve import Pushover, read_pushover
    from pounding.records import record
    from pounding.running import resume, run
    from pounding.runs import Run, read
    from pounding.screening import screen
    from pounding.spectra import Spectrum, record_spectrum
    from pounding.studies.separation import separation
    from pounding.studies.study import Study, study, sweep
    from pounding.yielding import Loop, YieldingLaw, hysteresis

    __version__: str

__all__ = [
    "AccuracyWarning",
    "ContactState",
    "FreeImpact",
    "ImplausibleWarning",
    "InputError",
    "Interrupted",
    "Law",
    "Loop",
    "Mode",
    "Model",
    "Modes",
    "Pushover",
    "Response",
    "Run",
    "SolverError",
    "Spectrum",
    "Study",
    "Suite",
    "YieldingLaw",
    "calibrate",
    "check",
    "from_opensees",
    "hysteresis",
    "laws",
    "modes",
    "pushover",
    "read",
    "read_pushover",
    "record",
    "record_spectrum",
    "resume",
    "run",
    "screen",
    "separation",
    "study",
    "suite",
    "sweep",
]

#: Public modules: `pounding.opensees.link`.
_PUBLIC_MODULES = ("animation", "contact", "models", "opensees", "plan", "results")
#: The module of every other public name.
_MODULES = {
    "_modes": ("Mode", "Modes"),
    "_pushover": ("pushover",),
    "contact": ("FreeImpact", "Law", "Response", "calibrate", "laws"),
    "contact_state": ("ContactState",),
    "errors": ("AccuracyWarning", "ImplausibleWarning", "InputError", "Interrupted", "SolverError"),
    "models": ("Model", "check", "modes"),
    "opensees.from_model": ("from_opensees",),
    "pushover_curve": ("Pushover", "read_pushover"),
    "records": ("record",),
    "running": ("resume", "run"),
    "runs": ("Run", "read"),
    "screening": ("screen",),
    "spectra": ("Spectrum", "record_spectrum"),
    "studies.separation": ("separation",),
    "studies.study": ("Study", "study", "sweep"),
    "studies.suite": ("Suite", "suite"),
    "yielding": ("Loop", "YieldingLaw", "hysteresis"),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return importlib.import_module("pounding._native").core.version
    if name in _PUBLIC_MODULES:
        return importlib.import_module(f"pounding.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'pounding' has no attribute {name!r}")
    return getattr(importlib.import_module(f"pounding.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*__all__, *_PUBLIC_MODULES, "__doc__", "__file__", "__name__", "__path__", "__version__"})
