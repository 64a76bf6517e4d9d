"""Files that the commands write: where, and what they say of them."""

from __future__ import annotations

from os import PathLike
from pathlib import Path


def output_for(results: str | PathLike[str], given: str | None, ending: str) -> Path:
    """The file that was asked for; else the name of the results with another ending, in the current folder."""
    return Path(given) if given else Path(Path(results).stem + ending)


def cannot_read(file: str | PathLike[str], error: Exception) -> str:
    """The message for a file that could not be read, which names it once: some errors do so by themselves."""
    text = getattr(error, "strerror", None) or str(error)
    names_it = text.startswith((f"{file}: ", f"{file} ")) or text.endswith(f" {file}")
    return text if names_it else f"cannot read {file}: {text}"


def tell(kind: str, *files: str | PathLike[str]) -> None:
    """Prints what was written, as `pounding run` does."""
    for file in files:
        print(f"{kind:<12} {file}")
