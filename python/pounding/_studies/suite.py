"""`pounding.suite`: a model under each record of a suite, with statistics of every floor, member, hinge and link."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _yaml_text as yaml_text
from pounding._arguments import takes
from pounding._checked_file import STUDY
from pounding._native import core
from pounding._outputs import destination
from pounding._studies.execution import Progress
from pounding._studies.plan import Plan, make_plan
from pounding._studies.reading import text_without
from pounding._studies.study import records_folder, run_plan
from pounding._studies.suite_data import SuiteData
from pounding.errors import ImplausibleWarning, InputError
from pounding.models import Model

if TYPE_CHECKING:
    from matplotlib.figure import Figure

File = str | PathLike[str]


class Suite(SuiteData):
    """The table of a suite, with pictures and reports."""

    def profiles(self, quantities: Sequence[str] | None = None, **options: Any) -> Figure:
        """Profiles over the height: records thin, mean and 84 % thick, with and without pounding.

        Parameters
        ----------
        quantities : sequence of str, optional
            Quantities to draw.
        **options
            Options of the picture.

        Returns
        -------
        matplotlib.figure.Figure
            The picture.
        """
        from pounding._studies.suite_picture import profiles_figure

        return profiles_figure(self, quantities, **options)

    @takes(path=arguments.file)
    def report(self, path: str | PathLike[str], *, percent: float = 84.0) -> None:
        """Writes the report of the suite.

        Parameters
        ----------
        path : str or os.PathLike
            File to write, .pdf or .html; an existing one must be a report.
        percent : float
            Percentile to report with mean and maximum.

        Raises
        ------
        InputError
            The suffix is another one, or the file may not be replaced.
        OSError
            The file cannot be written.
        ImportError
            matplotlib is missing.
        """
        from pounding._report import write_suite_report

        write_suite_report(self, path, percent=percent)


def read_suite(name: File, store: Path | None = None) -> Plan:
    """The plan of the file of a suite. Raises InputError."""
    name = str(name)
    text = core.read_file(name)
    parts = core.parse(core.Source(text, name))
    if not isinstance(parts, dict) or "records" not in parts:
        is_study = isinstance(parts, dict) and "study" in parts
        raise InputError(
            f"{name}: is the file of a study; type pounding study {name}"
            if is_study
            else f"{name}: has no records:, which are the ground motions of a suite; add records: {{files: records/*.AT2}}, or type pounding run {name}"
        )
    if "study" in parts:
        raise InputError(
            f"{name}: has records: of a suite and study:; move the records into the study, or the study into another file"
        )
    given = core.read_suite(text, name)
    rest = {key: value for key, value in parts.items() if key != "records"}
    model = Model._from_text(text_without(text, "records", rest), name)
    try:
        return plan_of_suite(model, parts["records"], given, Path(name).parent, text, store)
    except InputError as error:
        raise InputError(str(error) if str(error).startswith(name) else f"{name}: {error}") from None


def plan_of_suite(
    model: Model,
    records: Mapping[str, Any],
    given: Mapping[str, Any],
    folder: Path,
    text: str = "",
    store: Path | None = None,
) -> Plan:
    """The plan of a suite: `records` as typed, and `given` with values in SI. Raises InputError."""
    typed = {key: value for key, value in records.items() if key != "scale_to"}
    keys = {"records": typed, "engine": "solver", "without_links": model.compare is not None}
    try:
        plan = make_plan(model, keys, folder, text, store, given)
    except InputError as error:
        raise InputError(str(error).replace("study.records", "records")) from None
    bare = [
        f"records.scale_to.spectrum.{code}.{key}: a bare {value} is in m/s^2; if {value} g was meant, type its unit"
        for code, one in (_target(records).items())
        if isinstance(one, Mapping)
        for key, value in one.items()
        if key in ("ag", "SDS", "SD1") and re.fullmatch(r"[0-9.eE+-]+", str(value)) and float(str(value)) < 3
    ]
    return replace(plan, suite={**(plan.suite or {}), **_resolved(plan)}, warnings=(*plan.warnings, *bare))


def _resolved(plan: Plan) -> dict[str, Any]:
    """Gaps of the links and the tolerance, which are the same for all records."""
    files = {**plan.template.files, **plan.files_of(np.array([0]))}
    parts = core.parse(core.Source(core.check(core.Source(plan.yaml(0), "row", files))[1], "resolved"))
    rtol = [one.split()[-1] for one in plan.options if one.startswith("-pounding_ts_rtol")]
    return {
        "gaps": {str(one["name"]): float(one["gap"]) for one in parts.get("links") or ()},
        "tolerance": float(rtol[-1] if rtol else parts["analysis"]["tolerance"]),
    }


def _target(records: Mapping[str, Any]) -> Mapping[str, Any]:
    found: Mapping[str, Any] = (records.get("scale_to") or {}).get("spectrum") or {}
    return found


def run_suite(plan: Plan, path: Path | None, workers: int | None, executor: Executor | None, progress: Any) -> Suite:
    """Runs the records that are missing in `path`."""
    found = Suite.__new__(Suite)
    found.__dict__.update(vars(run_plan(plan, path, workers=workers, executor=executor, chunk=1, progress=progress)))
    return found


def suite(
    model: Model | File,
    records: Any = None,
    *,
    scale_to: Mapping[str, Any] | None = None,
    output: File | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    progress: Progress | bool | None = None,
) -> Suite:
    """Runs a model under each record of a suite with the solver (guide, "Suites of records").

    A model with `compare: no_pounding` also runs without links. The numbers are bitwise the same for any number of
    workers.

    Parameters
    ----------
    model : Model, str or os.PathLike
        The file of a suite, or a model with its `records`.
    records : mapping or sequence, optional
        Records of the suite.
    scale_to : mapping, optional
        Target of the scaling.
    output : str or os.PathLike, optional
        HDF5 file of the table, from which a killed suite resumes.
    workers : int, optional
        Number of processes, by default one per core; 0 runs in this process.
    executor : concurrent.futures.Executor, optional
        Executor for the runs.
    progress : callable or bool, optional
        Function that reports the progress; False hides it.

    Returns
    -------
    Suite
        The table.

    Raises
    ------
    InputError
        The plan is wrong.
    OSError
        The table cannot be written.
    SolverError
        A run failed.

    Examples
    --------
    >>> pounding.suite("suite.yaml").statistics("peak_force")  # doctest: +SKIP
    """
    path = None if output is None else Path(arguments.file("output", output))
    if path is not None:
        destination(path, STUDY)
    if records is None:
        if isinstance(model, Model) or scale_to is not None:
            raise InputError('suite: takes records, as in suite(model, {"files": "records/*.AT2"})')
        plan = read_suite(model, records_folder(path or Path(str(model))))
    else:
        typed = dict(records) if isinstance(records, Mapping) else {"files": records}
        typed = yaml_text.plain({**typed, **({"scale_to": scale_to} if scale_to is not None else {})})
        given = core.read_suite(yaml_text.emit({"records": typed}), "records")
        read = model if isinstance(model, Model) else Model.from_file(model)
        as_file = yaml_text.emit({"records": typed, **read._parts()})
        plan = plan_of_suite(read, typed, given, Path(), as_file, store=records_folder(path or Path("suite")))
    for doubt in plan.warnings:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=2)
    return run_suite(plan, path, workers, executor, progress)
