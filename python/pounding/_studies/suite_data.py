"""The table of a suite: arrays by record, and statistics over the records."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding import _arguments as arguments
from pounding._arguments import listed, number, takes
from pounding._studies.percentiles import order_statistic
from pounding._studies.scaling import Scaling
from pounding._studies.study_table import Study
from pounding._studies.table import open_study
from pounding._texts import text as text_of
from pounding.errors import InputError

PERCENTS = (16.0, 50.0, 84.0)


@dataclass(frozen=True)
class Statistics:
    """Mean, percentiles and maximum over the records; infinite if a record ends in collapse."""

    mean: np.ndarray
    percent: tuple[float, ...]
    percentiles: np.ndarray  #: [percent, ...] order statistics
    max: np.ndarray

    @classmethod
    def of(cls, values: np.ndarray, percent: Sequence[float] = PERCENTS) -> Statistics:
        """Statistics of [record, ...]. A record without the quantity is NaN and excluded from the statistics."""
        flat = values.reshape(len(values), int(np.prod(values.shape[1:])))
        known = ~np.isnan(flat)
        mean = np.full(flat.shape[1], np.nan)
        largest = np.full(flat.shape[1], np.nan)
        for j in np.flatnonzero(known.any(axis=0)):
            mean[j] = flat[known[:, j], j].mean()
            largest[j] = flat[known[:, j], j].max()
        found = np.array([[order_statistic(column, one) for column in flat.T] for one in percent])
        shape = values.shape[1:]
        return cls(mean.reshape(shape), tuple(percent), found.reshape(len(percent), *shape), largest.reshape(shape))


class SuiteData(Study):
    """Arrays of a suite by record, their statistics, pictures and report. It is also a study with one row per record."""

    @property
    def layout(self) -> Mapping[str, Any]:
        """Structures and links with their contents.

        Raises
        ------
        InputError
            The table is that of a study.
        """
        if "suite" not in self.description:
            raise InputError(
                f"{self.path} is the table of a study, not of a suite; type pounding study show {self.path}"
            )
        found: Mapping[str, Any] = self.description["suite"]["layout"]
        return found

    @property
    def scaling(self) -> Scaling | None:
        """Factors of the records and their fit to the target; None without scale_to."""
        found = self.description["suite"].get("scaling")
        return None if found is None else Scaling.of(found)

    @property
    def link_gaps(self) -> Mapping[str, float]:
        """Gap of each link [m]."""
        found: Mapping[str, float] = self.description["suite"]["gaps"]
        return found

    @property
    def tolerance(self) -> float:
        """Relative tolerance of the time integration."""
        return float(self.description["suite"]["tolerance"])

    @property
    def sha256(self) -> str:
        """Checksum of the input: of the suite's file, or of a file with the same contents."""
        if self.plan is not None:
            typed = self.plan.text
        else:
            assert self.path is not None
            with open_study(self.path) as file:
                typed = text_of(file["study/text"][()])
        return hashlib.sha256(typed.encode()).hexdigest()

    @property
    def structures(self) -> list[str]:
        """Names of the moving structures."""
        return [one["name"] for one in self.layout["structures"]]

    @property
    def links(self) -> list[str]:
        """Names of the links."""
        return [one["name"] for one in self.layout["links"]]

    @property
    def has_comparison(self) -> bool:
        """True if the suite also ran without links."""
        return any(column.endswith(".alone") for column in self.columns)

    def structure(self, name: str) -> Mapping[str, Any]:
        """Contents of a structure.

        Parameters
        ----------
        name : str
            Name of the structure.

        Returns
        -------
        mapping
            Its quantities, floors, members, components, parts and hinges.

        Raises
        ------
        InputError
            The structure is unknown.
        """
        for one in self.layout["structures"]:
            if one["name"] == name:
                found: Mapping[str, Any] = one
                return found
        raise InputError(f'unknown structure "{name}"; known: {", ".join(self.structures)}')

    def floors(self, structure: str, quantity: str, *, alone: bool = False) -> np.ndarray:
        """Largest absolute values of the floors of a structure.

        Parameters
        ----------
        structure : str
            Name of the structure.
        quantity : str
            displacement, drift, acceleration, drift_ratio, storey_shear or residual_drift.
        alone : bool
            True for the runs without links.

        Returns
        -------
        numpy.ndarray
            [record, floor] in SI.

        Raises
        ------
        InputError
            The structure or the quantity is unknown.
        """
        one = self.structure(structure)
        if quantity not in one["quantities"]:
            raise InputError(f'{structure} has no "{quantity}"; it has {", ".join(one["quantities"])}')
        return self._columns([f"{quantity}.{structure}.{i + 1}" for i in range(one["floors"])], alone)

    def members(self, structure: str, *, alone: bool = False) -> np.ndarray:
        """Largest absolute end forces of the members of a structure.

        Parameters
        ----------
        structure : str
            Name of the structure.
        alone : bool
            True for the runs without links.

        Returns
        -------
        numpy.ndarray
            [record, member, component] in the order of `structure(name)` [N], [N m].
        """
        one = self.structure(structure)
        names = [f"member_force.{structure}.{member}.{kind}" for member in one["members"] for kind in one["components"]]
        return self._columns(names, alone).reshape(len(self), len(one["members"]), len(one["components"]))

    def parts(self, structure: str, quantity: str, *, alone: bool = False) -> np.ndarray:
        """Responses of the yielding parts of a structure.

        Parameters
        ----------
        structure : str
            Name of the structure.
        quantity : str
            ductility, or plastic_rotation of hinges [rad].
        alone : bool
            True for the runs without links.

        Returns
        -------
        numpy.ndarray
            [record, part].

        Raises
        ------
        InputError
            The structure or the quantity is unknown.
        """
        if quantity not in ("ductility", "plastic_rotation"):
            raise InputError(f'unknown quantity "{quantity}"; known: ductility, plastic_rotation')
        one = self.structure(structure)
        among = one["parts"] if quantity == "ductility" else one["hinges"]
        return self._columns([f"{quantity}.{structure}.{part}" for part in among], alone)

    def of_links(self, quantity: str) -> np.ndarray:
        """A quantity of the links.

        Parameters
        ----------
        quantity : str
            force, penetration, impacts, impulse or energy_lost.

        Returns
        -------
        numpy.ndarray
            [record, link]; NaN for links without it.

        Raises
        ------
        InputError
            The quantity is unknown.
        """
        known = list(dict.fromkeys(each for link in self.layout["links"] for each in link["quantities"]))
        if quantity not in known:
            raise InputError(f'unknown quantity "{quantity}" of links; known: {", ".join(known)}')
        names = [f"{quantity}.{link}" for link in self.links]
        return np.column_stack([self.columns.get(name, np.full(len(self), np.nan)) for name in names])

    @takes(percent=listed(number(0, 100), "a list of percentages"))
    def statistics(self, values: np.ndarray, percent: Sequence[float] = PERCENTS) -> Statistics:
        """Statistics over the finished records. Failed records are excluded, see `failed`.

        Parameters
        ----------
        values : numpy.ndarray
            [record, ...] values.
        percent : sequence of float
            Percentages of the percentiles.

        Returns
        -------
        Statistics
            Mean, percentiles and maximum.
        """
        return Statistics.of(np.asarray(values)[self.finished], percent)

    def _columns(self, names: Sequence[str], alone: bool) -> np.ndarray:
        if alone and not self.has_comparison:
            raise InputError("the suite has no run without links; add compare: no_pounding to the model")
        every = [self.columns[name + (".alone" if alone else "")] for name in names]
        return np.column_stack(every) if every else np.empty((len(self), 0))
