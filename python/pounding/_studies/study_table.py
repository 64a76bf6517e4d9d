"""The table of a study with pictures, exports and runs of single models."""

from __future__ import annotations

import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _yaml_text as yaml_text
from pounding._arguments import takes
from pounding._studies.batches import COMPLETE
from pounding._studies.engines import run_batch
from pounding._studies.execution import batch_of
from pounding._studies.factors import Factor
from pounding._studies.files import located, relative
from pounding._studies.motions import Motion
from pounding._studies.plan import Plan
from pounding._studies.quantities import Kept
from pounding._studies.rows import Rows
from pounding._studies.table import Table
from pounding._studies.template import Template
from pounding.errors import InputError

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from pounding._studies.sensitivity import Indices

File = str | PathLike[str]


class Study(Rows):
    """A table of rows with pictures and exports. Only `evaluate` runs models."""

    #: The plan; None for a table opened from a file.
    plan: Plan | None = None

    @classmethod
    def of(cls, table: Table) -> Study:
        """The study of a table in memory.

        Parameters
        ----------
        table : Table
            The table.

        Returns
        -------
        Study
            The study.
        """
        plan = table.plan
        columns = {
            **plan.columns(np.arange(plan.count)),
            **dict(zip(plan.template.kept.columns, table.values.T)),
            "status": table.status,
            "engine": table.engine,
        }
        motions = plan.template.motions
        records = {
            name: [getattr(motion, name) for motion in motions]
            if name in ("name", "event", "component")
            else np.array([getattr(motion, name) for motion in motions])
            for name in ("name", "event", "component", "points", "step", "duration", "pga", "intensity")
        }
        found = cls(
            columns,
            plan.units(),
            records,
            table.reasons,
            json.loads(json.dumps(relative(plan.description(), table.folder))),
            table.engines,
            table.path,
            table.check,
            plan.warnings,
        )
        found.plan = plan
        return found

    def indices(self, column: str) -> Indices:
        """Sobol indices of the factors of a study with sampling: {saltelli: n}. Needs SALib.

        Parameters
        ----------
        column : str
            Name of a column.

        Returns
        -------
        Indices
            First and total indices.
        """
        from pounding._studies.sensitivity import sobol_indices

        return sobol_indices(self, column)

    @takes(picture=arguments.text, column=arguments.optional(arguments.text))
    def plot(self, picture: str, column: str | None = None, **options: Any) -> Figure:
        """A picture from the table alone.

        Parameters
        ----------
        picture : str
            "fragility", "ida", "gap", "map" or "tornado".
        column : str, optional
            Name of a column.
        **options
            Options of the picture.

        Returns
        -------
        matplotlib.figure.Figure
            The picture.

        Raises
        ------
        InputError
            The picture, the column or an option is unknown.
        ImportError
            matplotlib is missing.
        """
        from pounding._studies.pictures import study_figure

        return study_figure(self, picture, column, **options)

    def to_pandas(self) -> pandas.DataFrame:
        """All rows as a table; records, labels and statuses by name.

        Returns
        -------
        pandas.DataFrame
            One column per column of the table.
        """
        import pandas

        from pounding._studies.export import readable

        return pandas.DataFrame(readable(self), index=pandas.RangeIndex(len(self), name="row"))

    def to_xarray(self) -> xarray.Dataset:
        """The columns over the dimensions record, point and level, with units; each factor of a grid is a dimension.

        Returns
        -------
        xarray.Dataset
            The columns.
        """
        from pounding._studies.export import to_xarray

        return to_xarray(self)

    @takes(path=arguments.file)
    def to_csv(self, path: File, **values: float | str) -> None:
        """Writes all rows as text, one line per row, below a header of names with units.

        Parameters
        ----------
        path : str or os.PathLike
            File to write; an existing one must be such a table.
        **values : float or str
            Values of factors, to write the finished rows with them only.

        Raises
        ------
        InputError
            The file may not be replaced.
        OSError
            The file cannot be written.
        """
        from pounding._studies.export import to_csv

        to_csv(self, path, **values)

    @takes(path=arguments.file)
    def to_parquet(self, path: File, **values: float | str) -> None:
        """Writes all rows as Parquet, with units. Needs PyArrow.

        Parameters
        ----------
        path : str or os.PathLike
            File to write; an existing one must be such a table.
        **values : float or str
            As for `to_csv`.

        Raises
        ------
        InputError
            The file may not be replaced.
        OSError
            The file cannot be written.
        """
        from pounding._studies.export import to_parquet

        to_parquet(self, path, **values)

    def model_of(self, row: int) -> str:
        """The input of one row, for `pounding run`.

        Parameters
        ----------
        row : int
            Index of the row, from 0.

        Returns
        -------
        str
            Text in YAML.

        Raises
        ------
        InputError
            The row is unknown.
        """
        row = arguments.whole(0, len(self) - 1)("row", row)
        given = located(self.description, Path() if self.path is None else self.path.parent)
        factors = tuple(
            Factor(
                one["name"],
                tuple(one["of"]),
                one["times"],
                one["unit"],
                None,
                labels=tuple(one["labels"]),
                alternatives=tuple(one.get("alternatives", ())),
                slope=one.get("slope", 1.0),
                shift=one.get("shift", 0.0),
            )
            for one in given["factors"]
        )
        motions = tuple(Motion(one["name"], one["words"], one["event"], pga=one["pga"]) for one in given["records"])
        template = Template(given["model"], "", factors, motions, Kept(()))
        values = [float(self[factor.name][row]) for factor in factors]
        return yaml_text.emit(template.case(values, int(self["record"][row]), float(self["scale"][row])))

    def evaluate(self, factors: Mapping[str, float]) -> dict[str, np.ndarray]:
        """Runs all records and levels for one set of factors in this process.

        A plain function for scipy.optimize, pymoo or Optuna.

        Parameters
        ----------
        factors : mapping
            Value of each factor in SI.

        Returns
        -------
        dict of str to numpy.ndarray
            [record times level] by column. Columns of a collapsed row are infinite.

        Raises
        ------
        InputError
            A factor is missing, or a row failed.
        """
        if self.plan is None:
            raise InputError("a table opened from a file cannot run models; create the study with pounding.study(...)")
        factors = {
            name: arguments.number()(name, value) for name, value in arguments.mapping("factors", factors).items()
        }
        missing = [name for name in self.factors if name not in factors]
        if missing or set(factors) - set(self.factors):
            raise InputError(f"evaluate takes a value for each of {', '.join(self.factors)}")
        records, points, levels = self.plan.shape
        for factor in self.plan.points.factors:
            if factor.labels and factors[factor.name] not in range(len(factor.labels)):
                raise arguments.refuse(
                    factor.name, f"the number of a label, from 0 to {len(factor.labels) - 1}", factors[factor.name]
                )
        rows = (np.arange(records)[:, None] * points * levels + np.arange(levels)).ravel()
        batch = batch_of(self.plan, rows)
        batch.values[:] = [factors[name] for name in self.factors]
        done = run_batch(batch)
        wrong = [row for row, status in zip(done.rows.tolist(), done.status.tolist()) if status not in COMPLETE]
        if wrong:
            raise InputError(done.reasons[wrong[0]])
        return dict(zip(self.plan.template.kept.columns, done.values.T))
