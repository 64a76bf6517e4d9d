"""Output files: rules for replacing existing files, and atomic writing."""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import stat
import struct
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, NoReturn

from pounding.errors import InputError

File = str | PathLike[str]
#: Number of bytes that identify the kind of a file.
START = 1 << 16


@dataclass(frozen=True)
class Kind:
    """Kind of files that may replace each other. Any kind may replace an empty file."""

    name: str  #: for messages: "picture"
    recognises: Callable[[Path, bytes], bool]  #: True if an existing file, with these first bytes, is of this kind


def _is_picture(_: Path, start: bytes) -> bool:
    signatures = (
        b"\x89PNG",
        b"%PDF-",
        b"GIF8",
        b"%!PS",
        b"\xff\xd8\xff",
        b"RIFF",
        b"II*\0",
        b"MM\0*",
        b"%% Creator: Matplotlib",
    )
    is_svg = start.startswith((b"<?xml", b"<svg")) and b"<svg" in start
    return start.startswith(signatures) or start[4:8] == b"ftyp" or is_svg


PICTURE = Kind("picture", _is_picture)


def refuse(path: File, reason: str, advice: str = "Name another file") -> NoReturn:
    """Raises InputError: the file cannot be written."""
    raise InputError(f'cannot write "{os.fsdecode(path)}": {reason}. {advice}')


def destination(path: File, kind: Kind, inputs: Iterable[File] = ()) -> Path:
    """The file that writing `path` creates or replaces, after resolving symbolic links.

    Raises InputError if the path is empty, a directory or special file, write-protected, in a missing directory, one of
    `inputs` under any name, being written by a run, or of another kind."""
    name = os.fsdecode(path)
    if not name:
        refuse(path, "the name of the file is empty", "Name a file")
    try:
        place = Path(os.path.realpath(name) if os.path.islink(name) else name)
        found = os.stat(name)
    except FileNotFoundError:
        if not place.parent.is_dir():
            refuse(path, f"no such directory: {place.parent}", f"First type: mkdir -p {place.parent}")
        if name.endswith(os.sep):
            refuse(path, "the name ends as that of a directory", f"Name a file, such as {name.rstrip(os.sep)}")
        return place
    except (OSError, ValueError) as error:  # circular links, a name that is too long or contains a null byte
        refuse(path, getattr(error, "strerror", None) or str(error))
    if stat.S_ISDIR(found.st_mode):
        refuse(path, "it is a directory", "Name a file in it")
    if not stat.S_ISREG(found.st_mode):
        refuse(path, "it is not a regular file")
    for each in inputs:
        if _is_file(each, found):
            refuse(path, f"it is {each}, an input of this command")
    if not os.access(place, os.W_OK):
        refuse(path, "it is write-protected")
    try:
        with open(place, "rb") as file:
            start = file.read(START)
            busy = _is_held(file.fileno())
    except OSError as error:
        refuse(path, error.strerror or str(error))
    if busy:
        refuse(path, "a run writes it now", "Wait for its end, or name another file")
    if start and not kind.recognises(place, start):
        refuse(
            path, f"a file of this name exists and holds no {kind.name}", f"Name another file, or first type: rm {name}"
        )
    return place


def _is_file(path: File, found: os.stat_result) -> bool:
    try:
        return os.path.samestat(os.stat(path), found)
    except (OSError, ValueError):  # no such file, or an invalid name
        return False


@contextmanager
def replaced(path: File, kind: Kind, inputs: Iterable[File] = ()) -> Iterator[Path]:
    """Yields a temporary file with the suffix of `path`, which replaces `path` atomically at the end.

    A kill or an error keeps the existing file. Its mode is preserved, and its owner if possible. Raises InputError as
    `destination`, and OSError."""
    inputs = tuple(inputs)
    place = destination(path, kind, inputs)
    suffix = ".tmp" + Path(os.fsdecode(path)).suffix
    temporary = place.with_name(f".{place.name}.{os.getpid()}{suffix}")
    try:
        os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW, 0o666))
    except OSError as error:
        refuse(path, error.strerror or str(error), "Name a file in a directory that you may write to")
    try:
        yield temporary
        _bring_to_disk(temporary)
        destination(path, kind, inputs)  # another program may have come first
        _keep_mode(place, temporary)
        os.replace(temporary, place)
    except OSError as error:
        if error.filename in (None, temporary, str(temporary)):
            error.filename = os.fsdecode(path)
        raise
    finally:
        temporary.unlink(missing_ok=True)
    _bring_to_disk(place.parent)


def _keep_mode(earlier: Path, new: Path) -> None:
    """Copies the mode of the existing file, and its owner if permitted."""
    with contextlib.suppress(OSError):
        before = os.stat(earlier)
        with contextlib.suppress(OSError):
            os.chown(new, before.st_uid, before.st_gid)
        os.chmod(new, stat.S_IMODE(before.st_mode))


def _bring_to_disk(path: Path) -> None:
    with contextlib.suppress(PermissionError):  # a directory may be writable and not readable
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


# The lock is on one byte beyond the end of any file, as in `pounding run`, since HDF5 and other readers lock whole
# files.
_FLOCK = struct.Struct("@hhqqi4x")


def _flock(kind: int) -> bytes:
    return _FLOCK.pack(kind, os.SEEK_SET, 2**63 - 2, 1, 0)


def _is_held(descriptor: int) -> bool:
    """True if another open file holds the lock of this one."""
    try:
        held = fcntl.fcntl(descriptor, fcntl.F_OFD_GETLK, _flock(fcntl.F_WRLCK))
    except (OSError, AttributeError):  # a file system, or a system, without such locks
        return False
    return bool(_FLOCK.unpack(held)[0] != fcntl.F_UNLCK)


class Lock:
    """A lock file, held until `release` or the end of the process. Two objects in one process exclude each other."""

    _descriptor = -1

    def __init__(self, path: Path) -> None:
        """Raises BlockingIOError if another object holds the lock, OSError if the file cannot be created."""
        while True:
            self._descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
            try:
                fcntl.fcntl(self._descriptor, fcntl.F_OFD_SETLK, _flock(fcntl.F_WRLCK))
            except (BlockingIOError, PermissionError):
                self.release()
                raise BlockingIOError(f"{path} is locked") from None
            except (OSError, AttributeError):  # without such locks
                return
            # The file that was opened may have been removed before the lock was taken.
            with contextlib.suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(self._descriptor), os.stat(path)):
                    return
            self.release()

    @property
    def is_held(self) -> bool:
        """True until `release`."""
        return self._descriptor >= 0

    def release(self) -> None:
        """Releases the lock."""
        # An exception of a signal handler may come at any time: never close a descriptor twice.
        descriptor, self._descriptor = self._descriptor, -1
        if descriptor >= 0:
            os.close(descriptor)

    def __del__(self) -> None:
        self.release()


def output_for(results: File, given: str | None, ending: str) -> Path:
    """The given file, or the name of the results with another suffix in the current folder."""
    return Path(given) if given else Path(Path(results).stem + ending)


def read_object(file: File) -> Any:
    """The JSON object in a file. Raises InputError if it is not JSON, OSError."""
    try:
        return json.loads(Path(file).read_text(encoding="utf-8"))
    except ValueError as error:
        raise InputError(f"{os.fsdecode(file)} is not JSON: {error}") from error


def tell(kind: str, *files: File) -> None:
    """Prints the name of the written file, in the format of `pounding run`."""
    for file in files:
        print(f"{kind:<12} {file}")
