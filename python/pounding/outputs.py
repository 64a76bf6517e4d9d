"""Files that the commands write: where, and what they say of them."""

from __future__ import annotations

from os import PathLike
from pathlib import Path


def output_for(results: str | PathLike[str], given: str | None, ending: str) -> Path:
    """The file that was asked for; else the name of the results with another ending, in the current folder."""
    return Path(given) if given else Path(Path(results).stem + ending)


def tell(kind: str, *files: str | PathLike[str]) -> None:
    """Prints what was written, as `pounding run` does."""
    for file in files:
        print(f"{kind:<12} {file}")
