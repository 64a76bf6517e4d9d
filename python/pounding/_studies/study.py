"""`pounding.study` and `pounding.sweep`."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from pounding import _arguments as arguments
from pounding._arguments import takes
from pounding._checked_file import STUDY
from pounding._outputs import destination
from pounding._studies.execution import MAX_WORKERS, Progress, run_rows
from pounding._studies.plan import Plan, make_plan, plan_of, read_given
from pounding._studies.progress import Shown
from pounding._studies.study_table import Study
from pounding._studies.table import Table
from pounding.errors import ImplausibleWarning, InputError, excerpt
from pounding.models import Model

File = str | PathLike[str]


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


@takes(workers=arguments.optional(arguments.whole(0, MAX_WORKERS)), chunk=arguments.optional(arguments.whole(1)))
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
