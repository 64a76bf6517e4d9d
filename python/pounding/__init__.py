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
    from pounding._working_folder import leave_working_folder_out

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
    from pounding._contact_state import ContactState
    from pounding._modes import Mode, Modes
    from pounding._opensees.from_model import from_opensees
    from pounding._pushover import pushover
    from pounding._pushover_curve import Pushover, PushoverEvent, read_pushover
    from pounding._records import record
    from pounding._running import resume, run
    from pounding._runs import Run, read
    from pounding._screening import screen
    from pounding._spectra import Spectrum, record_spectrum
    from pounding._studies.separation import separation
    from pounding._studies.study import study, sweep
    from pounding._studies.study_table import Study
    from pounding._studies.suite import Suite, suite
    from pounding._yielding import Loop, YieldingLaw, hysteresis
    from pounding.contact import FreeImpact, Law, Response, calibrate, laws
    from pounding.errors import AccuracyWarning, ImplausibleWarning, InputError, Interrupted, SolverError
    from pounding.models import Model, check, modes

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
    "PushoverEvent",
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
_PUBLIC_MODULES = ("animation", "contact", "errors", "models", "opensees", "plan", "results", "studies", "view")
#: The module of every other public name.
_MODULES = {
    "_modes": ("Mode", "Modes"),
    "_pushover": ("pushover",),
    "contact": ("FreeImpact", "Law", "Response", "calibrate", "laws"),
    "_contact_state": ("ContactState",),
    "errors": ("AccuracyWarning", "ImplausibleWarning", "InputError", "Interrupted", "SolverError"),
    "models": ("Model", "check", "modes"),
    "_opensees.from_model": ("from_opensees",),
    "_pushover_curve": ("Pushover", "PushoverEvent", "read_pushover"),
    "_records": ("record",),
    "_running": ("resume", "run"),
    "_runs": ("Run", "read"),
    "_screening": ("screen",),
    "_spectra": ("Spectrum", "record_spectrum"),
    "_studies.separation": ("separation",),
    "_studies.study": ("study", "sweep"),
    "_studies.study_table": ("Study",),
    "_studies.suite": ("Suite", "suite"),
    "_yielding": ("Loop", "YieldingLaw", "hysteresis"),
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
