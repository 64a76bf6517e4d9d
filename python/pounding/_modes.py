"""Periods and mode shapes of the structures of a model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _printing as printing
from pounding._native import core
from pounding._pictures.html import table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class Mode(printing.ReportLines):
    """One mode of a structure."""

    period: float  #: [s]; infinite for a free body
    damping_ratio: float  #: [-]
    participation: np.ndarray  #: [direction] of the ground motion: x; x, y, z of a frame
    effective_mass: np.ndarray  #: [direction] [kg]
    shape: np.ndarray  #: [floor], of a frame [floor, direction]; 1 at the top, of a frame at its largest translation


class Modes(printing.ReportLines, Mapping[str, list[Mode]], lines=printing.modes):
    """Modes of every structure, longest period first: `modes["left"][0].period`."""

    def __init__(self, found: Sequence[core.StructureModes], title: str) -> None:
        self._title = title
        #: fields of mode_shapes.DrawnStructure
        self._drawn: dict[str, dict[str, Any]] = {
            one.name: {
                "elevations": list(one.elevations),
                "nodes": np.reshape(one.nodes, (-1, 3)),
                "members": np.reshape(np.array(one.members, int), (-1, 2)),
                "node_shapes": [np.array(shape) for shape in one.node_shapes],
            }
            for one in found
        }
        self._modes = {one.name: [_mode(mode, one.is_frame) for mode in one.modes] for one in found}

    def __getitem__(self, structure: str) -> list[Mode]:
        return self._modes[structure]

    def __iter__(self) -> Iterator[str]:
        return iter(self._modes)

    def __len__(self) -> int:
        return len(self._modes)

    def node_shapes(self, structure: str) -> list[np.ndarray]:
        """Displacements of the nodes of a frame in each mode, to the scale of `shape`.

        Parameters
        ----------
        structure : str
            Name of the structure.

        Returns
        -------
        list of numpy.ndarray
            [node, 3] for each mode; empty for other structures.
        """
        found: list[np.ndarray] = self._drawn[structure]["node_shapes"]
        return found

    def _repr_html_(self) -> str:
        names = [name for name, found in self.items() if found]
        longest = max((len(self[name]) for name in names), default=0)
        rows = [
            [number + 1, *(_words(self[name][number]) if number < len(self[name]) else "" for name in names)]
            for number in range(longest)
        ]
        return table(["mode", *(f"{name}: T [s], damping" for name in names)], rows)

    def plot(self, title: str | None = None) -> Figure:
        """A picture of the first shapes of every structure.

        Parameters
        ----------
        title : str, optional
            Title instead of that of the model.

        Returns
        -------
        matplotlib.figure.Figure
            The picture.

        Raises
        ------
        InputError
            All structures are walls.
        """
        from pounding._mode_shapes import DrawnMode, DrawnStructure, plot_modes

        structures = [
            DrawnStructure(name, [DrawnMode(one.period, one.damping_ratio, one.shape) for one in self[name]], **drawn)
            for name, drawn in self._drawn.items()
        ]
        return plot_modes(structures, title or self._title or "Mode shapes")


def _mode(one: core.Mode, is_frame: bool) -> Mode:
    # Without a frame there is the direction x only.
    directions = len(one.participation) if is_frame else 1
    shape = np.array(one.shape, order="C")
    return Mode(
        one.period,
        one.damping_ratio,
        np.array(one.participation[:directions]),
        np.array(one.effective_mass[:directions]),
        shape if is_frame else shape[:, 0],
    )


def _words(mode: Mode) -> str:
    period = "none" if math.isinf(mode.period) else f"{mode.period:.4g}"
    return f"{period}, {100 * mode.damping_ratio:.3g} %"
