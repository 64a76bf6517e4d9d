"""The table of a study: one HDF5 file with a checksum in front, and while the study runs finished chunks as small files beside it, whose
checksums stand in their names.

A finished chunk is written under another name and moved into place, so a study that is killed at any moment loses only the chunks
under way. The table itself is written the same way, from all chunks, when the study ends or stops."""

from __future__ import annotations

import io
import json
import os
import shutil
import zlib
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from pounding.checked_file import NotResults, require_whole_study, write_study
from pounding.errors import InputError
from pounding.studies.cross_check import differences
from pounding.studies.engines import ENGINES, NOT_RUN, STATUSES, Done
from pounding.studies.files import by_content, relative
from pounding.studies.plan import Plan
from pounding.texts import text

FORMAT = "study of pounding 1"


class Table:
    """The columns that have been filled so far, in memory, and their files where there are any."""

    def __init__(self, plan: Plan, path: str | os.PathLike[str] | None = None) -> None:
        """An empty table, or what an earlier run of this plan has left at `path`. Raises InputError when another plan has."""
        self.plan = plan
        self.path = None if path is None else Path(path)
        self.values = np.full((plan.count, len(plan.template.kept.columns)), np.nan)
        self.status = np.zeros(plan.count, np.int8)
        self.engine = np.full(plan.count, -1, np.int8)
        self.seconds = np.zeros(plan.count)
        self.engines = [engine.name for engine in ENGINES]
        self.check: dict[int, np.ndarray] = {}  #: row of the kernel -> its columns by the solver
        self.reasons: dict[int, str] = {}
        if self.path is not None:
            self._take_up(self.path)

    @property
    def parts(self) -> Path | None:
        """The folder of finished chunks."""
        return None if self.path is None else self.path.with_name(self.path.name + ".parts")

    @property
    def folder(self) -> Path:
        """The folder of the table; the working folder for a table in memory."""
        return Path() if self.path is None else self.path.parent

    def missing(self) -> np.ndarray:
        """Numbers of the rows that have not run."""
        return np.flatnonzero(self.status == NOT_RUN)

    def add(self, done: Done) -> None:
        """Takes finished rows, and writes their chunk. Raises OSError when it cannot be written."""
        if self.parts is not None:
            told = json.dumps({"reasons": {str(row): why for row, why in done.reasons.items()}})
            written = io.BytesIO()
            np.savez(written, rows=done.rows, values=done.values, status=done.status, engine=done.engine, seconds=done.seconds, told=np.array(told))
            content = written.getvalue()
            with _moved(self.parts / f"{int(done.rows[0]):012d}-{len(done.rows)}-{zlib.crc32(content):08x}.npz") as temporary:
                temporary.write_bytes(content)
        self._fill(done)

    def write(self) -> None:
        """Writes the whole table and removes the chunks, which it holds now. Raises OSError."""
        if self.path is None:
            return
        with _moved(self.path) as temporary:
            write_study(temporary, _image(self))
            _bring_to_disk(temporary)
        _bring_to_disk(self.path.parent)
        if self.parts is not None:
            shutil.rmtree(self.parts, ignore_errors=True)

    def merge(self, other: Path) -> None:
        """Takes the rows of the table of another shard. Raises InputError for another plan."""
        self._read_table(other)

    def _fill(self, done: Done) -> None:
        self.values[done.rows] = done.values
        self.status[done.rows] = done.status
        self.engine[done.rows] = done.engine
        self.seconds[done.rows] = done.seconds
        self.reasons.update(done.reasons)

    def _take_up(self, path: Path) -> None:
        parts = self.parts
        assert parts is not None
        if path.is_file():
            self._read_table(path)
        if (parts / "plan.json").is_file():
            _require_same(_read_plan_of(parts), self.plan, path)
            for name in sorted(parts.glob("*.npz")):
                self._fill(_read_part(name))
        parts.mkdir(parents=True, exist_ok=True)
        with _moved(parts / "plan.json") as temporary:
            temporary.write_text(json.dumps({"digest": self.plan.digest(), "plan": relative(self.plan.description(), self.folder)}))

    def _read_table(self, path: Path) -> None:
        with open_study(path) as file:
            _require_same(json.loads(text(file["study/plan"][()])), self.plan, path)
            status = file["rows/status"][:]
            rows = np.flatnonzero(status != NOT_RUN)
            columns = self.plan.template.kept.columns
            values = np.column_stack([file[f"rows/{column}"][:] for column in columns]) if columns else np.empty((len(status), 0))
            reasons = {int(row): text(why) for row, why in zip(file["reasons/row"][:], file["reasons/text"][:])}
            self._fill(Done(rows, values[rows], status[rows], file["rows/engine"][:][rows], file["timing/seconds"][:][rows], reasons))
            self.check.update(zip(file["check/row"][:].tolist(), file["check/solver"][:]))


class _moved:
    """A file that is written beside its place and moved there when it is whole."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._temporary = path.with_name(f".{path.name}.{os.getpid()}")

    def __enter__(self) -> Path:
        return self._temporary

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None:
            os.replace(self._temporary, self._path)
        else:
            self._temporary.unlink(missing_ok=True)


def open_study(path: Path) -> h5py.File:
    """The table at `path`. Raises InputError where there is none."""
    if not path.is_file():
        raise InputError(f"there is no study {path}; type pounding study STUDY.yaml -o {path}")
    require_whole_study(path)
    file = h5py.File(path, "r")
    if text(file.attrs["format"]) != FORMAT:
        file.close()
        raise NotResults(f"{path} is the table of a study by another version of pounding; run the study again")
    return file


def _read_plan_of(parts: Path) -> dict[str, Any]:
    try:
        kept = json.loads((parts / "plan.json").read_text(encoding="utf-8"))
        return {"digest": str(kept["digest"]), "plan": dict(kept["plan"])}
    except (ValueError, TypeError, KeyError):
        raise NotResults(f"{parts / 'plan.json'} is damaged. Remove {parts}; the rows in it run again") from None


def _read_part(path: Path) -> Done:
    content = path.read_bytes()
    if not path.stem.endswith(f"-{zlib.crc32(content):08x}"):
        raise NotResults(f"{path} is damaged. Remove it; its rows run again")
    with np.load(io.BytesIO(content), allow_pickle=False) as part:
        told = json.loads(str(part["told"]))
        return Done(part["rows"], part["values"], part["status"], part["engine"], part["seconds"],
                    {int(row): why for row, why in told["reasons"].items()})


def _require_same(kept: dict[str, Any], plan: Plan, path: Path) -> None:
    if kept["digest"] == plan.digest():
        return
    now = json.loads(json.dumps(by_content(plan.description())))
    before = by_content({"files": {}, **kept["plan"]})
    different = [name for name in now if now[name] != before.get(name)]
    raise InputError(f"{path} holds rows of another plan: {', '.join(different) or 'something'} is not the same. Name another output with -o, or remove "
                     f"{path} and {path.name}.parts to begin again")


def _bring_to_disk(path: Path) -> None:
    """Waits until a file, or the names in a folder, would outlast a power failure."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _image(table: Table) -> bytes:
    """The HDF5 file. It is made in memory: where a disk is full or fails, HDF5 may end the process."""
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
        file.create_dataset("reasons/text", data=[why for _, why in reasons], dtype=h5py.string_dtype(), shape=(len(reasons),))
        file["study/plan"] = json.dumps({"digest": plan.digest(), "plan": relative(plan.description(), table.folder)})
        file["study/text"] = plan.text
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
