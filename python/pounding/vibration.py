"""Periods and mode shapes of the structures of a model."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding.compiled import core
from pounding.models import Model, as_model

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Mode:
    """One mode of a structure."""

    period: float  #: [s]; infinite for a free body
    damping_ratio: float  #: [-]
    participation: np.ndarray  #: [direction] of the ground: x; x, y, z of a frame
    effective_mass: np.ndarray  #: [direction] [kg]
    shape: np.ndarray  #: [floor], of a frame [floor, direction]


class Modes(Mapping[str, list[Mode]]):
    """Modes of every structure, longest period first: `modes["left"][0].period`."""

    def __init__(self, found: dict[str, Any], title: str) -> None:
        self._found, self._title = found, title
        self._modes = {name: [_mode(one) for one in modes] for name, modes in found["modes"].items()}

    def __getitem__(self, structure: str) -> list[Mode]:
        return self._modes[structure]

    def __iter__(self) -> Iterator[str]:
        return iter(self._modes)

    def __len__(self) -> int:
        return len(self._modes)

    def __repr__(self) -> str:
        return f"<pounding.Modes: {', '.join(f'{len(found)} of {name}' for name, found in self._modes.items())}>"

    def _repr_html_(self) -> str:
        from pounding.notebook import modes_html

        return modes_html(self)

    def plot(self, title: str | None = None) -> Figure:
        """The first shapes of every structure. Raises InputError when there is none."""
        from pounding.mode_shapes import plot_modes

        return plot_modes(self._found, title or self._title or "Mode shapes")


def modes(model: Model | str | PathLike[str], count: int = 12) -> Modes:
    """The modes of a model or an input file: `count` of a frame, all of other structures, none of a wall. Raises
    InputError."""
    model = as_model(model)
    return Modes(json.loads(core.modes(model._source(), count)), str(model.title or ""))


def _mode(one: dict[str, Any]) -> Mode:
    return Mode(math.inf if one["period"] is None else one["period"], one["damping_ratio"], np.atleast_1d(one["participation"]),
                np.atleast_1d(one["effective_mass"]), np.array(one["shape"]))
