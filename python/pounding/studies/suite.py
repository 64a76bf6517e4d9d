"""`pounding.suite`: a model under each record of a suite, with statistics of every floor, member, hinge and link."""

from __future__ import annotations

import hashlib
import re
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import arguments, yaml_text
from pounding._native import core
from pounding.arguments import listed, number, takes
from pounding.checked_file import STUDY
from pounding.errors import ImplausibleWarning, InputError
from pounding.models import Model
from pounding.outputs import destination
from pounding.studies.execution import Progress, require_count
from pounding.studies.percentiles import order_statistic
from pounding.studies.plan import Plan, make_plan
from pounding.studies.scaling import Scaling
from pounding.studies.sections import text_without
from pounding.studies.study import Study, records_folder, run_plan
from pounding.studies.table import open_study
from pounding.texts import text as text_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PERCENTS = (16.0, 50.0, 84.0)
File = str | PathLike[str]


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


class Suite(Study):
    """The runs of a suite: arrays by record, and their statistics. It is also a study with one row per record."""

    @property
    def layout(self) -> Mapping[str, Any]:
        """Structures and links with their contents. Raises InputError for the table of a study."""
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
        """Contents of a structure. Raises InputError."""
        for one in self.layout["structures"]:
            if one["name"] == name:
                found: Mapping[str, Any] = one
                return found
        raise InputError(f'unknown structure "{name}"; known: {", ".join(self.structures)}')

    def floors(self, structure: str, quantity: str, *, alone: bool = False) -> np.ndarray:
        """[record, floor] largest absolute values: displacement, drift, acceleration, drift_ratio, storey_shear or
        residual_drift, in SI; `alone` for the run without links. Raises InputError."""
        one = self.structure(structure)
        if quantity not in one["quantities"]:
            raise InputError(f'{structure} has no "{quantity}"; it has {", ".join(one["quantities"])}')
        return self._columns([f"{quantity}.{structure}.{i + 1}" for i in range(one["floors"])], alone)

    def members(self, structure: str, *, alone: bool = False) -> np.ndarray:
        """[record, member, component] largest absolute end forces, in the order of `structure(name)`. [N], [N m]."""
        one = self.structure(structure)
        names = [f"member_force.{structure}.{member}.{kind}" for member in one["members"] for kind in one["components"]]
        return self._columns(names, alone).reshape(len(self), len(one["members"]), len(one["components"]))

    def parts(self, structure: str, quantity: str, *, alone: bool = False) -> np.ndarray:
        """[record, part] ductility of yielding parts, or plastic_rotation of hinges [rad]. Raises InputError."""
        if quantity not in ("ductility", "plastic_rotation"):
            raise InputError(f'unknown quantity "{quantity}"; known: ductility, plastic_rotation')
        one = self.structure(structure)
        among = one["parts"] if quantity == "ductility" else one["hinges"]
        return self._columns([f"{quantity}.{structure}.{part}" for part in among], alone)

    def of_links(self, quantity: str) -> np.ndarray:
        """[record, link] force, penetration, impacts, impulse or energy_lost; NaN for links without it."""
        known = list(dict.fromkeys(each for link in self.layout["links"] for each in link["quantities"]))
        if quantity not in known:
            raise InputError(f'unknown quantity "{quantity}" of links; known: {", ".join(known)}')
        names = [f"{quantity}.{link}" for link in self.links]
        return np.column_stack([self.columns.get(name, np.full(len(self), np.nan)) for name in names])

    @takes(percent=listed(number(0, 100), "a list of percentages"))
    def statistics(self, values: np.ndarray, percent: Sequence[float] = PERCENTS) -> Statistics:
        """Statistics over the finished records of an array [record, ...]. Failed records are excluded, see `failed`."""
        return Statistics.of(np.asarray(values)[self.finished], percent)

    def profiles(self, quantities: Sequence[str] | None = None, **options: Any) -> Figure:
        """Profiles over the height: records thin, mean and 84 % thick, with and without pounding. See
        `pounding.studies.suite_picture`."""
        from pounding.studies.suite_picture import profiles_figure

        return profiles_figure(self, quantities, **options)

    @takes(path=arguments.file)
    def report(self, path: File, *, percent: float = 84.0) -> None:
        """Writes the report, .pdf or .html, with mean, this percentile and maximum. Raises InputError for another
        suffix and for a file that is not a report, OSError, ImportError without matplotlib."""
        from pounding.report import write_suite_report

        write_suite_report(self, path, percent=percent)

    def _columns(self, names: Sequence[str], alone: bool) -> np.ndarray:
        if alone and not self.has_comparison:
            raise InputError("the suite has no run without links; add compare: no_pounding to the model")
        every = [self.columns[name + (".alone" if alone else "")] for name in names]
        return np.column_stack(every) if every else np.empty((len(self), 0))


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
    """Runs a model under each record of a suite with the solver: the file of a suite, or a model with its `records`
    and `scale_to` (guide, "Suites of records").

    `output` is the HDF5 file of the table, from which a killed suite resumes. `workers` is the number of processes (by
    default one per core); 0 runs in this process. A model with `compare: no_pounding` also runs without links. The
    numbers are bitwise the same for any number of workers. Raises InputError, OSError, SolverError."""
    require_count("workers", workers, 0)
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
