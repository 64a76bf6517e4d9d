"""The table of a study: one HDF5 file with a checksum, and a folder of finished chunks while the study runs.

A killed study loses only the chunks in progress. The table is written atomically from all chunks when the study ends
or stops. A lock in the folder of chunks prevents two studies from writing the same table. A sample of the rows of the
kernel also runs with the solver; the table contains the differences."""

from __future__ import annotations

import json
import os
import resource
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from pounding._checked_file import STUDY, NotResults, require_whole_study, write_study
from pounding._outputs import destination
from pounding._studies.batches import COMPLETE, DIED, NOT_RUN, STATUSES, Done, side_by_side
from pounding._studies.engines import ENGINES
from pounding._studies.files import by_content, relative
from pounding._studies.parts import Parts
from pounding._studies.plan import Plan
from pounding._texts import text
from pounding.errors import ImplausibleWarning, InputError

FORMAT = "study of pounding 1"
#: Copies of the table in memory while it is written: its columns, those of the file, and the file.
COPIES = 3


#: In the warning of tables of version 0.2.0.
OF_0_2_0 = "was made by version 0.2.0, which counted rows that end by collapse_drift"


class Table:
    """Finished rows in memory, and their files if the table has a path."""

    def __init__(self, plan: Plan, path: str | os.PathLike[str] | None = None) -> None:
        """An empty table, or the rows of an earlier run of this plan at `path`. The path is locked until `write` or
        `close`.

        Raises InputError if the path cannot be written, is locked by another study or contains another plan, and if the
        rows do not fit into memory."""
        require_room(plan)
        self.plan = plan
        self.path = None if path is None else Path(path)
        self.parts: Parts | None = None
        self.values = np.full((plan.count, len(plan.template.kept.columns)), np.nan)
        self.status = np.zeros(plan.count, np.int8)
        self.engine = np.full(plan.count, -1, np.int8)
        self.seconds = np.zeros(plan.count)
        self.engines = [engine.name for engine in ENGINES]
        self.check: dict[int, np.ndarray] = {}  #: row of the kernel -> its columns by the solver
        self.reasons: dict[int, str] = {}
        if self.path is not None:
            # The folder of chunks is next to the target of a symbolic link.
            self.parts = Parts(destination(self.path, STUDY), self.path)
            try:
                self._take_up(self.path)
            except BaseException:
                self.close()
                raise

    @property
    def folder(self) -> Path:
        """The folder of the table; the working folder for a table in memory."""
        return Path() if self.path is None else self.path.parent

    def missing(self) -> np.ndarray:
        """Indices of the rows that have not run."""
        return np.flatnonzero(self.status == NOT_RUN)

    def add(self, done: Done) -> None:
        """Adds finished rows and writes their chunk. Raises OSError if it cannot be written."""
        if self.parts is not None:
            self.parts.add(done)
        self._fill(done)

    def write(self) -> None:
        """Writes the whole table, removes the chunks and unlocks the path. Raises InputError, OSError."""
        if self.path is None or self.parts is None:
            return
        try:
            write_study(self.path, _image(self))
            self.parts.remove()
        finally:
            self.close()

    def close(self) -> None:
        """Unlocks the path. Finished chunks are kept."""
        if self.parts is not None:
            self.parts.close()

    def merge(self, other: Path) -> None:
        """Adds the rows of the table of another shard. Raises InputError for another plan."""
        self._read_table(other)

    def _fill(self, done: Done) -> None:
        # Complete rows take precedence over failed ones, and both over dead workers.
        done = done.part(_rank(done.status) > _rank(self.status[done.rows]))
        for row in done.rows.tolist():
            self.reasons.pop(row, None)
        self.values[done.rows] = done.values
        self.status[done.rows] = done.status
        self.engine[done.rows] = done.engine
        self.seconds[done.rows] = done.seconds
        self.reasons.update(done.reasons)

    def _take_up(self, path: Path) -> None:
        parts = self.parts
        assert parts is not None
        if path.is_file() and path.stat().st_size:
            self._read_table(path)
        kept = parts.plan()
        if kept is not None:
            _require_same(kept, self.plan, path)
            for done in parts.chunks():
                self._fill(done)
        parts.begin({"digest": self.plan.digest(), "plan": relative(self.plan.description(), self.folder)})

    def _read_table(self, path: Path) -> None:
        with open_study(path) as file:
            _require_same(json.loads(text(file["study/plan"][()])), self.plan, path)
            status = file["rows/status"][:]
            rows = np.flatnonzero(status != NOT_RUN)
            columns = self.plan.template.kept.columns
            values = side_by_side([file[f"rows/{column}"][:] for column in columns], len(status))
            engine, seconds = file["rows/engine"][:], file["timing/seconds"][:]
            self._fill(Done(rows, values[rows], status[rows], engine[rows], seconds[rows], read_reasons(file)))
            self.check.update(zip(file["check/row"][:].tolist(), file["check/solver"][:]))


def size_of(plan: Plan) -> int:
    """Size of the table of a plan [bytes]."""
    return plan.count * (8 * (len(plan.units()) + 1) + 2)


def size_text(size: float) -> str:
    """ "3.2 MB"."""
    return f"{size / 1e9:.3g} GB" if size >= 1e9 else f"{size / 1e6:.3g} MB"


def require_room(plan: Plan) -> None:
    """Raises InputError if the table of a plan does not fit into memory."""
    memory = min(
        [
            os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"),
            *(limit for limit in resource.getrlimit(resource.RLIMIT_AS) if limit > 0),
        ]
    )
    if COPIES * size_of(plan) > memory:
        raise InputError(
            f"study: {plan.count} rows make a table of {size_text(size_of(plan))}, which takes {size_text(COPIES * size_of(plan))} of memory to write, "
            f"and this machine has {size_text(memory)}; take fewer values, samples, levels or records"
        )


def _rank(status: np.ndarray) -> np.ndarray:
    """0 for rows that have not run, 1 for dead workers, 2 for failures, 3 for complete rows."""
    return np.select([status == NOT_RUN, status == DIED, np.isin(status, COMPLETE)], [0, 1, 3], 2)


def open_study(path: Path) -> h5py.File:
    """Opens the table at `path`. Raises InputError if there is none."""
    if not path.is_file():
        raise InputError(f"no such study: {path}; type pounding study STUDY.yaml -o {path}")
    require_whole_study(path)
    file = h5py.File(path, "r")
    if text(file.attrs["format"]) != FORMAT:
        file.close()
        raise NotResults(f"{path} is the table of a study by another version of pounding; run the study again")
    return file


def warnings_of_0_2_0(path: str | os.PathLike[str], description: Mapping[str, Any]) -> list[str]:
    """Warns of a table of version 0.2.0, which stores no warnings, if rows of its model may have collapsed."""
    if "collapse_drift" not in (description["model"].get("analysis") or {}):
        return []
    doubt = f"{path} {OF_0_2_0} as done, with their responses until then; run the study again"
    warnings.warn(doubt, ImplausibleWarning, stacklevel=3)
    return [doubt]


def read_reasons(file: h5py.File) -> dict[int, str]:
    """Reasons of failures and collapses, by row."""
    return {int(row): text(why) for row, why in zip(file["reasons/row"][:], file["reasons/text"][:])}


def _require_same(kept: Mapping[str, Any], plan: Plan, path: Path) -> None:
    if kept["digest"] == plan.digest():
        return
    now = json.loads(json.dumps(by_content(plan.description())))
    before = by_content({"files": {}, **kept["plan"]})
    different = [name for name in {**now, **before} if now.get(name) != before.get(name)]
    raise InputError(
        f"{path} contains rows of another plan: {', '.join(different) or 'something'} differs. Name another output with -o, or remove "
        f"{path} and {path.name}.parts to begin again"
    )


def _image(table: Table) -> bytes:
    """The HDF5 file as bytes. It is made in memory, because HDF5 may end the process on a full or failing disk."""
    plan = table.plan
    with h5py.File("table in memory", "w", driver="core", backing_store=False) as file:
        file.attrs["format"] = FORMAT
        rows = file.create_group("rows", track_order=True)
        units = plan.units()
        given = plan.columns(np.arange(plan.count))
        computed = dict(zip(plan.template.kept.columns, table.values.T))
        for name, values in {**given, **computed, "status": table.status, "engine": table.engine}.items():
            data = rows.create_dataset(name, data=values)
            data.attrs["units"] = units.get(name, "")
        for factor in plan.points.factors:
            if factor.labels:
                rows[factor.name].attrs["labels"] = list(factor.labels)
        rows["status"].attrs["labels"] = list(STATUSES)
        reasons = sorted(table.reasons.items())
        file["reasons/row"] = np.array([row for row, _ in reasons], np.int64)
        file.create_dataset(
            "reasons/text", data=[why for _, why in reasons], dtype=h5py.string_dtype(), shape=(len(reasons),)
        )
        file["study/plan"] = json.dumps({"digest": plan.digest(), "plan": relative(plan.description(), table.folder)})
        file["study/text"] = plan.text
        file.create_dataset(
            "study/warnings", data=plan.warnings, dtype=h5py.string_dtype(), shape=(len(plan.warnings),)
        )
        file.create_dataset("study/engines", data=table.engines, dtype=h5py.string_dtype(), shape=(len(table.engines),))
        _write_records(file, plan)
        _write_check(file, table)
        file["timing/seconds"] = table.seconds
        file["timing/seconds"].attrs["units"] = "s"
        file.flush()
        return file.id.get_file_image()


def _write_records(file: h5py.File, plan: Plan) -> None:
    group = file.create_group("records")
    motions = plan.template.motions
    for name in ("name", "event", "component", "digest"):
        group.create_dataset(name, data=[getattr(motion, name) for motion in motions], dtype=h5py.string_dtype())
    for name, unit in (("points", ""), ("step", "s"), ("duration", "s"), ("pga", "m/s^2"), ("intensity", "m/s^2")):
        group.create_dataset(name, data=[getattr(motion, name) for motion in motions]).attrs["units"] = unit


def _write_check(file: h5py.File, table: Table) -> None:
    columns = table.plan.template.kept.columns
    rows = sorted(table.check)
    by_solver = np.array([table.check[row] for row in rows]).reshape(len(rows), len(columns))
    group = file.create_group("check")
    group["row"] = np.array(rows, np.int64)
    group["solver"] = by_solver
    group["difference"] = differences(table.values[rows], by_solver)
    group["difference"].attrs["long_name"] = "of both engines, relative to the larger one"
    group.create_dataset("columns", data=columns, dtype=h5py.string_dtype(), shape=(len(columns),))


#: Interval of checked rows, and their minimum number.
ONE_IN, MIN_ROWS = 1000, 3
#: Relative difference above which a row is listed.
LARGE = 1e-3


def rows_to_check(count: int) -> np.ndarray:
    """Indices of the rows of a plan that run with both engines, evenly spaced."""
    return np.unique(np.linspace(0, count - 1, min(count, max(MIN_ROWS, count // ONE_IN))).astype(np.int64))


def differences(kernel: np.ndarray, solver: np.ndarray) -> np.ndarray:
    """|a - b| relative to the larger absolute value; 0 if both are equal or both are NaN."""
    larger = np.maximum(np.abs(kernel), np.abs(solver))
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = np.abs(kernel - solver) / larger
    apart = np.where(np.isnan(kernel) != np.isnan(solver), np.inf, apart)
    return np.where((kernel == solver) | (np.isnan(kernel) & np.isnan(solver)), 0.0, apart)


def report_lines(check: Mapping[int, np.ndarray], values: np.ndarray, columns: Sequence[str]) -> list[str]:
    """Lines of the report: number of compared rows and their differences. `values` are those of the table."""
    if not check or not columns:
        return []
    rows = sorted(check)
    apart = differences(values[rows], np.array([check[row] for row in rows]))
    worst, where = apart.max(axis=1), apart.argmax(axis=1)
    lines = [
        f"{len(rows)} rows run by both engines: they differ by {np.median(worst):.1e} in the median row, {worst.max():.1e} at most"
    ]
    far = [f"{rows[i]} ({columns[where[i]]} by {worst[i]:.1e})" for i in np.flatnonzero(worst > LARGE)]
    if far:
        lines.append(
            f"  beyond {LARGE:g}: rows {', '.join(far[:5])}{f' and {len(far) - 5} more' if len(far) > 5 else ''}; grazing impacts cause such "
            "differences, and so do errors: run these rows with a tenth of the tolerance"
        )
    return lines
