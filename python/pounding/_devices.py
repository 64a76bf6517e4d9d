"""Bars and dampers between two structures in results files."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pounding import _printing as printing
from pounding._data import Data, read_fields


@dataclass(frozen=True, repr=False)
class Device(printing.ReportLines):
    """A bar, a damper or both between two structures. Elongation and force are positive in tension."""

    name: str
    left: str  #: name of the structure on the left
    left_end: str  #: "floor 3", "node b"; empty for a wall
    right: str
    right_end: str
    direction: np.ndarray  #: unit, from left to right
    stiffness: float  #: of the bar [N/m]; 0 for none
    coefficient: float  #: of the damper [N (s/m)^exponent]; 0 for none
    exponent: float  #: of the velocity
    elongation: np.ndarray  #: [time] at the output times [m]
    force: np.ndarray  #: [time] [N]
    #: minimum and maximum elongation and force over all steps; elongation_time and force_time [s]
    largest: dict[str, np.ndarray]


def read_devices(file: Data) -> dict[str, Device]:
    """The devices of a results file in the order of the input; empty if there are none."""
    return {
        name: read_fields(
            Device, group, name=name, largest={key: data.values for key, data in group["envelope"].data_vars.items()}
        )
        for name, group in file.children.get("devices", {}).items()
    }
