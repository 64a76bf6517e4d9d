"""The header of results files and tables of studies: the kind of file and a checksum.

It is checked before HDF5 opens the file, since HDF5 may crash or hang on damaged files."""

from __future__ import annotations

import io
import zlib
from os import PathLike
from pathlib import Path
from typing import BinaryIO

from pounding._outputs import Kind, replaced
from pounding.errors import InputError

#: Bytes of the header: an HDF5 user block, which HDF5 skips.
BLOCK = 512
FIRST_LINE = b"results of pounding\n"
FIRST_LINE_OF_STUDY = b"study of pounding\n"
_HDF5 = b"\x89HDF\r\n\x1a\n"
#: Files that results and tables of studies may replace.
RESULTS = Kind("results of pounding", lambda _, start: start.startswith(FIRST_LINE))
STUDY = Kind("table of a study", lambda _, start: start.startswith(FIRST_LINE_OF_STUDY))


class NotResults(InputError):
    """An existing file that is not a results file, or is damaged."""


class HoldsPushover(NotResults):
    """A pushover file where a file of a run is expected."""


def block(size: int, crc: int, first_line: bytes = FIRST_LINE) -> bytes:
    """The header of a file of `size` bytes, including the header, whose remaining bytes have the CRC-32 `crc`."""
    text = (
        first_line
        + (
            f"size {size:020}\ncrc32 {crc:08x}\n"
            f"The HDF5 file begins at byte {BLOCK}, as HDF5 allows; h5py and h5dump open it as it is.\n"
            "size: all bytes, these included. crc32: of the bytes behind these.\n"
        ).encode()
    )
    return text.ljust(BLOCK - 1) + b"\n"


def require_whole(path: str | PathLike[str]) -> None:
    """Raises NotResults unless the file is an undamaged results file; OSError if it cannot be read."""
    if not Path(path).is_file():
        raise FileNotFoundError(f"no such file: {path}")
    with open(path, "rb") as file:
        _require_whole(file, str(path))


def require_whole_study(path: Path) -> None:
    """Raises NotResults unless the file is an undamaged table of a study; OSError if it cannot be read."""
    with open(path, "rb") as file:
        start = file.read(BLOCK)
        if not start.startswith(FIRST_LINE_OF_STUDY):
            raise NotResults(
                f"{path} is not a table of a study, such as pounding study STUDY.yaml -o {path} writes, or it is damaged"
            )
        if start != block(*_sums(file, start), FIRST_LINE_OF_STUDY):
            raise NotResults(
                f"{path}: the table is damaged, or another program has changed it. Use an intact copy, or remove it and run the "
                "study again"
            )


def write_study(path: Path, image: bytes) -> None:
    """Writes the table of a study from its HDF5 file in memory, with a header. Raises InputError, OSError."""
    with replaced(path, STUDY) as temporary, open(temporary, "wb") as file:
        file.write(block(BLOCK + len(image), zlib.crc32(image), FIRST_LINE_OF_STUDY))
        file.write(image)


def _sums(file: BinaryIO, header: bytes, start: bytes = b"") -> tuple[int, int]:
    """Size and checksum of a file whose header, and some bytes behind it, have been read."""
    size, crc = len(header) + len(start), zlib.crc32(start)
    while part := file.read(1 << 20):
        size, crc = size + len(part), zlib.crc32(part, crc)
    return size, crc


def require_whole_image(image: bytes) -> None:
    """Same as `require_whole`, for the bytes of a file."""
    _require_whole(io.BytesIO(image), "what was given")


def _require_whole(file: BinaryIO, name: str) -> None:
    start = file.read(BLOCK)
    signature = file.read(len(_HDF5))
    if start.startswith(FIRST_LINE_OF_STUDY):
        raise NotResults(
            f"{name} is the table of a study, not a run; type pounding study show {name}, or pounding.Study.open in Python"
        )
    # HDF5 data follow even if the first line of the header is damaged.
    if not start.startswith(FIRST_LINE) and signature != _HDF5:
        raise NotResults(_foreign(name, start))
    size, crc = _sums(file, start, signature)
    if start == block(size, crc):
        return
    digits = start[len(FIRST_LINE) + len("size ") :][:20]
    what = (
        f"it has {size} of its {int(digits)} bytes" if digits.isdigit() and size < int(digits) else "checksum mismatch"
    )
    raise NotResults(
        f"{name}: the file is damaged or was changed by another program: {what}. Use an intact copy, or run the model "
        "again"
    )


def _foreign(name: str, start: bytes) -> str:
    """How to obtain results from a file of another kind."""
    if not start:
        return f"{name}: the file is empty; run the model again"
    if start.startswith(_HDF5):
        return (
            f"{name}: has no checksum, so damage cannot be detected: an earlier version of pounding or another program wrote it. "
            f'Run the model again, or skip the check: pounding.read("{name}", checked=False)'
        )
    if Path(name).suffix.lower() in (".yaml", ".yml"):
        results = Path(name).with_suffix(".h5")
        return f"{name} is an input file; type pounding run {name} -o {results}, and name {results} here"
    return f"{name} is not a results file of pounding, such as pounding run MODEL.yaml -o OUT.h5 writes"
