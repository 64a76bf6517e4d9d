"""The table of a study: its columns and evaluations of them."""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from pounding import _arguments as arguments
from pounding._arguments import number, takes, whole
from pounding._native import core
from pounding._studies import fragility, gaps
from pounding._studies import percentiles as curves
from pounding._studies.batches import COLLAPSED, COMPLETE, EXCEEDED, NOT_RUN, STATUSES
from pounding._studies.quantities import COLLAPSED_COLUMN, bare_limit_warning
from pounding._studies.table import OF_0_2_0, open_study, read_reasons, warnings_of_0_2_0
from pounding._texts import text, texts
from pounding.errors import ImplausibleWarning, InputError, excerpt

Table = TypeVar("Table", bound="Rows")


class Rows:
    """A table of rows and its evaluations, which do not run models."""

    def __init__(
        self,
        columns: Mapping[str, np.ndarray],
        units: Mapping[str, str],
        records: Mapping[str, Any],
        reasons: Mapping[int, str],
        description: Mapping[str, Any],
        engines: Sequence[str],
        path: Path | None = None,
        check: Mapping[int, np.ndarray] | None = None,
        warnings: Sequence[str] = (),
    ) -> None:
        self.columns = dict(columns)  #: name -> [row] in SI
        self.units = dict(units)  #: name -> SI unit
        self.records = dict(records)  #: name, event, component, points, step, duration, pga, intensity -> [record]
        self.reasons = dict(reasons)  #: row -> reason of a failure or collapse
        self.description = dict(description)  #: the plan: model, factors, sampling, records, intensity
        self.engines = list(engines)  #: names of those in the column `engine`
        self.path = path
        self.check = dict(check or {})  #: row of the kernel -> its kept columns by the solver
        self.warnings = tuple(warnings)  #: of the plan

    @classmethod
    @takes(path=arguments.file)
    def open(cls: type[Table], path: str | PathLike[str]) -> Table:
        """Opens the table in a file, also that of a killed study.

        Parameters
        ----------
        path : str or os.PathLike
            Name of the file.

        Returns
        -------
        Study
            The table.

        Raises
        ------
        InputError
            The file is of another kind or damaged.
        OSError
            The file cannot be opened.
        """
        with open_study(Path(path)) as file:
            columns = {name: data[:] for name, data in file["rows"].items()}
            units = {name: text(data.attrs["units"]) for name, data in file["rows"].items()}
            records = {
                name: texts(data[:]) if data.dtype.kind in "OS" else data[:] for name, data in file["records"].items()
            }
            description = json.loads(text(file["study/plan"][()]))["plan"]
            check = dict(zip(file["check/row"][:].tolist(), file["check/solver"][:])) if "check" in file else {}
            doubts = (
                texts(file["study/warnings"][:]) if "study/warnings" in file else warnings_of_0_2_0(path, description)
            )
            reasons, engines = read_reasons(file), texts(file["study/engines"][:])
            return cls(columns, units, records, reasons, description, engines, Path(path), check, doubts)

    def __len__(self) -> int:
        return len(self.columns["status"])

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {word}" for word, count in self.counts.items() if count)
        return f"<pounding.Study of {len(self)} rows: {counts}; columns {', '.join(self.columns)}>"

    @property
    def counts(self) -> dict[str, int]:
        """Number of rows by status, in words."""
        return dict(zip(STATUSES, np.bincount(self.columns["status"], minlength=len(STATUSES)).tolist()))

    def __getitem__(self, column: str) -> np.ndarray:
        """A column; "collapsed" is 1 in rows that ended at collapse_drift and 0 in others. Raises InputError for an
        unknown name."""
        if column == COLLAPSED_COLUMN and column not in self.columns:
            return (self.columns["status"] == COLLAPSED).astype(float)
        if not isinstance(column, str) or column not in self.columns:
            raise InputError(f"unknown column {excerpt(column)}; known: {', '.join(self.columns)}")
        return self.columns[column]

    @property
    def table(self) -> np.ndarray:
        """All columns as a structured array with one element per row."""
        made = np.empty(len(self), dtype=[(name, values.dtype) for name, values in self.columns.items()])
        for name, values in self.columns.items():
            made[name] = values
        return made

    @property
    def factors(self) -> list[str]:
        """Names of the factors."""
        return [factor["name"] for factor in self.description["factors"]]

    @property
    def finished(self) -> np.ndarray:
        """[row] True for rows with numbers: done, exceeded or collapsed, whose numbers are infinite."""
        return np.isin(self.columns["status"], COMPLETE)

    @property
    def failed(self) -> dict[int, str]:
        """Reasons of failed rows, by row. They count neither as survivals nor as collapses; evaluations exclude them
        and report their number."""
        return {row: why for row, why in sorted(self.reasons.items()) if self.columns["status"][row] != COLLAPSED}

    @property
    def collapsed(self) -> dict[int, str]:
        """Place and time of collapses, by row. Collapsed rows exceed every limit: their responses are infinite."""
        return {int(row): self.reasons.get(int(row), "") for row in np.flatnonzero(self.columns["status"] == COLLAPSED)}

    def choose(self, **values: float | str) -> np.ndarray:
        """Finished rows with these values of factors: `choose(gap=0.02)`, `choose(gap="20 mm")`, `choose(law="hertz")`.

        Parameters
        ----------
        **values : float or str
            Value in SI, a text with its unit, or the name of a level, by factor.

        Returns
        -------
        numpy.ndarray
            [row] True for these rows.

        Raises
        ------
        InputError
            The row is unknown.
        """
        return self._among(self.finished, values)

    def value_of(self, name: str, value: float | str) -> float:
        """A value of a factor in SI, or the index of its name.

        Parameters
        ----------
        name : str
            Name of the factor.
        value : float or str
            The value.

        Returns
        -------
        float
            The number.

        Raises
        ------
        InputError
            The factor or the value is unknown.
        """
        self[name]
        labels: Sequence[str] = next((one["labels"] for one in self.description["factors"] if one["name"] == name), ())
        if not isinstance(value, str):
            return float(number()(name, value))
        if labels:
            if value not in labels:
                raise InputError(f'{name} has no value "{value}"; it is {", ".join(labels)}')
            return float(labels.index(value))
        unit = self.units.get(name, "")
        try:
            return float(core.quantity(value, unit)) if unit else float(value)
        except (ValueError, TypeError) as error:
            raise InputError(
                f"{name}: takes a value{f' in {unit}' if unit else ' without a unit'}; {value} was read ({error})"
            ) from None

    def _among(self, rows: np.ndarray, values: Mapping[str, float | str]) -> np.ndarray:
        chosen = rows.copy()
        for name, value in values.items():
            chosen &= np.isclose(self[name], self.value_of(name, value), rtol=1e-9, atol=0)
        if not chosen.any():
            known = "; ".join(
                f"{name} is {', '.join(f'{value:g}' for value in np.unique(self[name])[:12])}" for name in values
            )
            raise InputError(f"no finished row has these values{': ' + known if known else ''}")
        return chosen

    def limit_of(self, column: str, limit: float | str) -> float:
        """A limit of a column in SI.

        Parameters
        ----------
        column : str
            Name of the column.
        limit : float or str
            A number in the unit of the column, or a text with a unit, such as "5 MN".

        Returns
        -------
        float
            The number.

        Raises
        ------
        InputError
            The column or the unit is unknown.

        Warns
        -----
        ImplausibleWarning
            A bare number is implausible.
        """
        self[column]
        limit = (arguments.text if isinstance(limit, str) else number())(f"limit of {column}", limit)
        unit = self.units.get(column, "")
        if doubt := bare_limit_warning(f"limit of {column}", limit, unit, column):
            warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
        try:
            found = limit if not isinstance(limit, str) else core.quantity(limit, unit) if unit else float(limit)
        except InputError as error:
            raise InputError(f"limit of {column}: {error}") from None
        except ValueError:
            raise InputError(f'limit of {column}: takes a number without a unit, not "{limit}"') from None
        if not math.isfinite(found):
            raise InputError(f"limit of {column}: takes a finite number; {limit} was read")
        return found

    @takes(bootstrap=whole(0, 1_000_000), seed=whole(0))
    def fragility(
        self,
        column: str,
        limit: float | str | None = None,
        *,
        bootstrap: int = 1000,
        seed: int = 1,
        **values: float | str,
    ) -> fragility.Fragility:
        """Lognormal curve of the probability that a column exceeds a limit, over the intensity.

        The band is from bootstrap over events, since rows of one event are not independent. Rows with an undefined
        column are excluded and counted. See `pounding.studies.fragility.fit`.

        Parameters
        ----------
        column : str
            Name of the column. "collapsed" has no limit: its curve is that of collapse.
        limit : float or str, optional
            The limit in SI, or "5 MN".
        bootstrap : int
            Number of bootstrap samples.
        seed : int
            Seed of the samples.
        **values : float or str
            Values of factors that select rows.

        Returns
        -------
        Fragility
            The curve.

        Raises
        ------
        InputError
            The column, the limit or the intensity is missing.
        """
        if column == COLLAPSED_COLUMN and column not in self.columns:
            self._require_collapse()
            limit = 0.5 if limit is None else limit
        if limit is None:
            raise InputError(
                f'a fragility of {column} needs its limit, as in fragility("{column}", "80 mm"); only that of collapse has none'
            )
        above = self.limit_of(column, limit)
        chosen = self.choose(**values)
        known = chosen & self._defined(column, chosen)
        return fragility.of_rows(
            self._im()[known],
            self[column][known] > above,
            self._events()[known],
            bootstrap=bootstrap,
            seed=seed,
            failed=int((~self.finished & (self["status"] != NOT_RUN)).sum()),
            undefined=int((chosen & ~known).sum()),
        )

    @takes(percent=arguments.listed(number(0, 100), "a list of percentages"))
    def percentiles(
        self, column: str, percent: Sequence[float] = (16, 50, 84), **values: float | str
    ) -> curves.Percentiles:
        """Percentiles of a column at every level, by order statistics; exceeded and collapsed rows are infinite.

        Without an intensity all rows are one level, whose `im` is NaN.

        Parameters
        ----------
        column : str
            Name of the column.
        percent : sequence of float
            Percentages.
        **values : float or str
            Values of factors that select rows.

        Returns
        -------
        Percentiles
            The curves.
        """
        chosen = self.choose(**values)
        beyond = (self["status"] == EXCEEDED) & bool(self.description["kept"]["limits"])
        chosen = chosen & (beyond | self._defined(column, chosen))
        return curves.at_levels(self["im"][chosen], np.where(beyond, np.inf, self[column])[chosen], percent)

    def gaps(self, **values: float | str) -> gaps.GapCurve:
        """Probability that a gap is insufficient, over the gap, with its band from the number of events, and the rules.
        Needs keep: [required_gap].

        Parameters
        ----------
        **values : float or str
            Values of factors that select rows.

        Returns
        -------
        GapCurve
            The curve.
        """
        chosen = self.choose(**values)
        rules = {name: self[f"gap_{name}"][chosen] for name in ("abs", "srss", "ddc") if f"gap_{name}" in self.columns}
        return gaps.GapCurve.of(self["required_gap"][chosen], rules, self._events()[chosen])

    @takes(percent=number(0, 100))
    def map(self, column: str, across: str, along: str, percent: float = 50, **values: float | str) -> curves.Map:
        """A percentile of a column over two factors, pooled over all others.

        Parameters
        ----------
        column : str
            Name of the column.
        across, along : str
            Names of the factors.
        percent : float
            Percentage.
        **values : float or str
            Values of factors that select rows.

        Returns
        -------
        Map
            The map.
        """
        return curves.over_two(self[across], self[along], self[column], self.choose(**values), percent, (across, along))

    def _defined(self, column: str, chosen: np.ndarray) -> np.ndarray:
        """[row] True if the column is a number. Raises InputError if it is not a number in any chosen row."""
        defined = ~np.isnan(self[column])
        if not (defined & chosen).any():
            why = (
                "both runs of a ratio must be complete"
                if column.endswith(".ratio")
                else "rigid links have no force: keep impulse; bodies have no drift: keep displacement"
            )
            raise InputError(f"{column} is undefined in all of these rows ({why})")
        return defined

    def _require_collapse(self) -> None:
        if "collapse_drift" not in (self.description["model"].get("analysis") or {}):
            raise InputError(
                "no row of this study can collapse: its model has no analysis: {collapse_drift: 10 %}; type it and run the study again"
            )
        if any(OF_0_2_0 in doubt for doubt in self.warnings):
            raise InputError("this table of version 0.2.0 does not say which rows collapsed; run the study again")

    def _im(self) -> np.ndarray:
        if not np.isfinite(self["im"]).any():
            raise InputError("this study has no measure of intensity; add intensity: {measure: pga} to the study")
        return self["im"]

    def _events(self) -> np.ndarray:
        return np.asarray(self.records["event"], dtype=str)[self["record"]]
