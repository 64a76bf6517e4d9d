"""`pounding.study` and `pounding.sweep`, and the object that both return."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _yaml_text as yaml_text
from pounding._arguments import takes
from pounding._checked_file import STUDY
from pounding._outputs import destination
from pounding._studies.batches import COMPLETE
from pounding._studies.engines import run_batch
from pounding._studies.execution import Progress, batch_of, require_count, run_rows
from pounding._studies.factors import Factor
from pounding._studies.files import located, relative
from pounding._studies.motions import Motion
from pounding._studies.plan import Plan, make_plan, plan_of, read_given
from pounding._studies.progress import Shown
from pounding._studies.quantities import Kept
from pounding._studies.rows import Rows
from pounding._studies.table import Table
from pounding._studies.template import Template
from pounding.errors import ImplausibleWarning, InputError, excerpt
from pounding.models import Model

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from pounding._studies.indices import Indices

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
        from pounding._studies.indices import sobol_indices

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


def _model(name: str, value: Any) -> Any:
    """A model, or the name of its file."""
    return value if isinstance(value, Model) else arguments.file(name, value)


def _executor(name: str, value: Any) -> Any:
    """An executor of concurrent.futures."""
    if not callable(getattr(value, "submit", None)):
        raise arguments.refuse(name, "an executor of concurrent.futures", value)
    return value


def _progress(name: str, value: Any) -> Any:
    """True, False or a function."""
    return value if callable(value) else arguments.flag(name, value)


@takes(
    model=_model,
    stop_after=arguments.quantity,
    output=arguments.optional(arguments.file),
    executor=arguments.optional(_executor),
    progress=arguments.optional(_progress),
)
def study(
    model: Model | File,
    factors: Mapping[str, Any] | None = None,
    *,
    records: Any = None,
    intensity: Mapping[str, Any] | None = None,
    keep: Sequence[str | Callable[[Mapping[str, Any]], Any]] | None = None,
    sampling: Any = None,
    without_links: bool = False,
    limits: Mapping[str, Any] | None = None,
    seed: int = 1,
    stop_after: float | str = "5 %",
    output: File | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    chunk: int | None = None,
    progress: Progress | bool | None = None,
) -> Study:
    """Runs a study: a study file, or a model with the keys of `study:` as arguments (guide, "Studies").

    By default, rows of the kernel run on threads and rows of the solver in one process per core. Scripts that use
    processes need the guard `if __name__ == "__main__":`.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A study file, or a model or its file.
    factors, records, intensity, keep, sampling, without_links, limits, seed
        Keys of `study:`.
    stop_after : float or str
        Fraction of failed rows that ends the study.
    output : str or os.PathLike, optional
        HDF5 file of the table, from which a killed study resumes; by default the table is in memory.
    workers : int, optional
        Number of processes for all rows; 0 runs them in this process.
    executor : concurrent.futures.Executor, optional
        Executor for the rows, such as MPIPoolExecutor or Dask's Client.get_executor().
    chunk : int, optional
        Number of rows per task.
    progress : callable or bool, optional
        Function that reports the progress; False hides it.

    Returns
    -------
    Study
        The table.

    Raises
    ------
    InputError
        The plan is wrong; no row has run.
    OSError
        The table cannot be written. Finished chunks are kept.
    SolverError
        More than `stop_after` of the rows fail. Finished chunks are kept.

    Examples
    --------
    >>> table = pounding.study(model, {"gap": {"of": "links.*.gap", "list": ["10 mm", "20 mm"]}}, workers=0, progress=False)
    >>> table["gap"]
    array([0.01, 0.02])
    """
    words = {
        "factors": factors,
        "records": records,
        "intensity": intensity,
        "keep": keep,
        "sampling": sampling,
        "limits": limits,
    }
    given = {name: value for name, value in words.items() if value is not None}
    require_count("workers", workers, 0)
    require_count("chunk", chunk, 1)
    if output is not None:
        destination(arguments.file("output", output), STUDY)
    path = None if output is None else Path(output)
    read = None if isinstance(model, Model) else read_given(model)
    if read is not None and read.keys is not None:
        others = {"without_links": without_links, "seed": seed != 1, "stop_after": str(stop_after) != "5 %"}
        typed = [*given, *(name for name, is_typed in others.items() if is_typed)]
        if typed:
            raise InputError(f"{read.name} is a study file; write {', '.join(typed)} there")
        plan = plan_of(read, records_folder(path or Path(read.name)))
    else:
        plan = make_plan(
            model if read is None else read.model,
            {**given, "without_links": without_links, "seed": seed, "stop_after": str(stop_after)},
            Path(),
            store=records_folder(path or Path("study")),
        )
    for doubt in plan.warnings:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
    return run_plan(plan, path, workers=workers, executor=executor, chunk=chunk, progress=progress)


@takes(model=_model, records=arguments.optional(arguments.files))
def sweep(
    model: Model | File,
    factors: Mapping[str, Sequence[Any]],
    *,
    records: Sequence[File] | None = None,
    keep: Sequence[str | Callable[[Mapping[str, Any]], Any]] | None = None,
    workers: int = 0,
) -> Study:
    """Runs all combinations of values, for every record.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A model, or the name of its file.
    factors : mapping
        Values by path. Each column has the name of the last key of its path, with a number if the name is taken.
    records : sequence, optional
        Files of records.
    keep : sequence, optional
        Columns of results.
    workers : int
        Number of processes; 0 runs in this process.

    Returns
    -------
    Study
        The table.

    Raises
    ------
    InputError
        The plan is wrong.

    Examples
    --------
    >>> len(pounding.sweep(model, {"links.*.gap": ["10 mm", "20 mm"]}))
    2
    """
    if not isinstance(factors, Mapping):
        raise InputError(
            f'sweep: factors takes a map of paths and their values, such as {{"links.*.gap": ["10 mm", "20 mm"]}}; {excerpt(factors)} was read'
        )
    named: dict[str, dict[str, Any]] = {}
    for path, values in factors.items():
        if (
            not isinstance(path, str)
            or isinstance(values, (str, Mapping))
            or not isinstance(values, Iterable)
            or getattr(values, "ndim", 1) == 0
        ):
            raise InputError(
                f'sweep: takes a list of values for each path, such as {{"links.*.gap": ["10 mm", "20 mm"]}}; {excerpt(path)}: {excerpt(values)} was read'
            )
        keys = ["gap"] if path.startswith("gaps.") else path.split(".")
        # An index, or a name such as left-right, cannot be the name of a column.
        last = next((key for key in reversed(keys) if key.isidentifier()), "factor")
        name = next(each for each in (last, *(f"{last}_{i}" for i in range(2, len(named) + 3))) if each not in named)
        named[name] = {"of": path, "list": list(values)}
    return study(
        model,
        named,
        records=None if records is None else {"files": [fspath(one) for one in records]},
        keep=keep,
        workers=workers,
        progress=False,
    )


def run_plan(
    plan: Plan,
    path: Path | None,
    *,
    workers: int | None = None,
    executor: Executor | None = None,
    chunk: int | None = None,
    progress: Progress | bool | None = None,
    shard: tuple[int, int] = (1, 1),
) -> Study:
    """Runs the rows of a plan that are missing in `path`; for shard (k, n) only the k-th of n equal shares."""
    require_count("workers", workers, 0)
    require_count("chunk", chunk, 1)
    _require_picklable(plan, workers, executor)
    table = Table(plan, path)
    rows = table.missing()
    number, count = shard
    rows = rows[(rows >= (number - 1) * plan.count // count) & (rows < number * plan.count // count)]
    try:
        with Shown(progress) as shown:
            run_rows(plan, table, rows, workers, executor, chunk, shown.report)
    finally:
        table.write()
    return Study.of(table)


def _require_picklable(plan: Plan, workers: int | None, executor: Executor | None) -> None:
    """Raises InputError if processes would receive a function that cannot be pickled."""
    for function in plan.template.kept.functions if workers != 0 or executor is not None else ():
        if not function.is_picklable():
            raise InputError(
                f"keep: processes cannot receive the function {function.name}; define it at the top of a module, or pass workers=0"
            )


def records_folder(path: Path) -> Path:
    """The folder for records of packages, next to the table."""
    return path.with_name(path.name + ".records")
