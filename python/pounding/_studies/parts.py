"""Finished chunks of a running study: small files in the folder TABLE.parts with checksums in their names, and a
lock.

A chunk is written to a temporary file and renamed, so that it is complete if it exists."""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pounding._checked_file import NotResults
from pounding._outputs import Lock, refuse
from pounding._studies.batches import Done
from pounding.errors import InputError

PLAN, LOCK = "plan.json", "lock"
_CHUNK = re.compile(r"\d{12}-\d+-[0-9a-f]{8}\.npz")
_OWN = re.compile(rf"{LOCK}|\.?({_CHUNK.pattern}|{re.escape(PLAN)})(\.\d+)?")


class Parts:
    """The folder of chunks next to a table, locked until `close`."""

    def __init__(self, table: Path, given: Path) -> None:
        """Creates the folder if necessary; `given` is the name of the table for messages. Raises InputError if the
        folder cannot be created, contains other files, or is locked by another study."""
        self.folder = table.with_name(table.name + ".parts")
        for _ in range(100):
            try:
                self.folder.mkdir(exist_ok=True)
                self._require_own()
                self._lock = Lock(self.folder / LOCK)
                return
            except BlockingIOError:
                refuse(given, "another study is writing it", "Wait for its end, or name another table")
            except FileNotFoundError:  # removed by another study at its end
                continue
            except InputError:
                raise
            except OSError as error:
                reason = "it is not a folder" if isinstance(error, FileExistsError) else error.strerror or str(error)
                refuse(given, f"finished rows are kept in {self.folder} meanwhile: {reason}", "Name another table")
        refuse(given, f"{self.folder} is removed repeatedly", "Name another table")

    def _require_own(self) -> None:
        """Raises InputError if the folder contains other files than chunks."""
        names = os.listdir(self.folder)
        foreign = sorted(name for name in names if not _OWN.fullmatch(name))
        if foreign and PLAN not in names:
            others = " and others" if len(foreign) > 1 else ""
            raise InputError(
                f"{self.folder} exists and is not the folder of a study: it contains {foreign[0]}{others}. "
                "Name another table, or move the folder away"
            )

    def plan(self) -> dict[str, Any] | None:
        """Digest and description of the plan of the chunks; None for a new folder. Raises NotResults."""
        path = self.folder / PLAN
        if not path.exists():
            return None
        try:
            kept = json.loads(path.read_text(encoding="utf-8"))
            return {"digest": str(kept["digest"]), "plan": dict(kept["plan"])}
        except (OSError, ValueError, TypeError, KeyError):
            raise NotResults(
                f"{path} is damaged. Remove {self.folder} if no file in it is yours; its rows run again"
            ) from None

    def begin(self, plan: Mapping[str, Any]) -> None:
        """Writes the plan. Raises OSError."""
        self._write(PLAN, json.dumps(plan).encode())

    def chunks(self) -> Iterator[Done]:
        """All chunks. Raises NotResults for a damaged one, OSError."""
        for name in sorted(name for name in os.listdir(self.folder) if _CHUNK.fullmatch(name)):
            yield _read_chunk(self.folder / name)

    def add(self, done: Done) -> None:
        """Stores finished rows in a new file. Raises OSError."""
        text = json.dumps({"reasons": {str(row): why for row, why in done.reasons.items()}})
        written = io.BytesIO()
        np.savez(
            written,
            rows=done.rows,
            values=done.values,
            status=done.status,
            engine=done.engine,
            seconds=done.seconds,
            told=np.array(text),
        )
        content = written.getvalue()
        self._write(f"{int(done.rows[0]):012d}-{len(done.rows)}-{zlib.crc32(content):08x}.npz", content)

    def remove(self) -> None:
        """Removes the chunks, then the lock, and the folder if it is empty."""
        with contextlib.suppress(OSError):
            for name in sorted(os.listdir(self.folder), key=lambda name: name == LOCK):
                if _OWN.fullmatch(name):
                    (self.folder / name).unlink()
            self.folder.rmdir()

    def close(self) -> None:
        """Unlocks the folder, and removes it if it contains no chunks."""
        if self._lock.is_held and self.folder.is_dir() and not any(map(_CHUNK.fullmatch, os.listdir(self.folder))):
            self.remove()
        self._lock.release()

    def _write(self, name: str, content: bytes) -> None:
        temporary = self.folder / f".{name}.{os.getpid()}"
        try:
            temporary.write_bytes(content)
            os.replace(temporary, self.folder / name)
        finally:
            temporary.unlink(missing_ok=True)


def _read_chunk(path: Path) -> Done:
    content = path.read_bytes()
    if not path.stem.endswith(f"-{zlib.crc32(content):08x}"):
        raise NotResults(f"{path} is damaged. Remove it; its rows run again")
    with np.load(io.BytesIO(content), allow_pickle=False) as part:
        text = json.loads(str(part["told"]))
        return Done(
            part["rows"],
            part["values"],
            part["status"],
            part["engine"],
            part["seconds"],
            {int(row): why for row, why in text["reasons"].items()},
        )
