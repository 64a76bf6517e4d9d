"""Tables of a study for other programs."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding._native import core
from pounding._outputs import Kind, replaced
from pounding._studies import files
from pounding._studies.batches import STATUSES
from pounding._studies.table import open_study
from pounding._texts import text

if TYPE_CHECKING:
    import xarray

    from pounding._studies.rows import Rows


#: Columns of every exported table.
_COLUMNS = (b"point", b"record", b"scale", b"im [m/s^2]")
CSV = Kind(
    "table that study export wrote",
    lambda _, start: set(_COLUMNS) <= set(start.partition(b"\n")[0].strip().split(b",")),
)
PARQUET = Kind("Parquet table", lambda _, start: start.startswith(b"PAR1"))


def readable(study: Rows) -> dict[str, np.ndarray]:
    """The columns, with names instead of the indices of records, statuses, engines and labels."""
    found = dict(study.columns)
    for factor in study.description["factors"]:
        if factor["labels"]:
            found[factor["name"]] = np.array(factor["labels"])[found[factor["name"]].astype(int)]
    found["record"] = np.asarray(study.records["name"], dtype=str)[found["record"]]
    found["status"] = np.array(STATUSES)[found["status"]]
    found["engine"] = np.array([*study.engines, ""])[found["engine"]]
    return found


def chosen(study: Rows, values: Mapping[str, float | str]) -> dict[str, np.ndarray]:
    """The readable columns, of the rows with these values of factors. Raises InputError if there are none."""
    columns = readable(study)
    if not values:
        return columns
    rows = study.choose(**values)
    return {name: column[rows] for name, column in columns.items()}


def to_csv(study: Rows, path: str | PathLike[str], **values: float | str) -> None:
    """Writes one line per row, with all digits of numbers; `values` select finished rows by values of factors.

    Texts that a spreadsheet would evaluate as formulas begin with an apostrophe. Raises InputError for an existing file
    of another kind, OSError."""
    columns = chosen(study, values)
    with replaced(path, CSV, _inputs(study)) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(
            [_inert(f"{name} [{study.units[name]}]" if study.units.get(name) else name) for name in columns]
        )
        writer.writerows(
            zip(
                *(
                    [_inert(each) for each in values.tolist()] if values.dtype.kind == "U" else values.tolist()
                    for values in columns.values()
                )
            )
        )


def _inert(cell: str) -> str:
    """A text that no spreadsheet evaluates as a formula; texts of numbers are unchanged."""
    return (
        f"'{cell}" if cell.startswith(("=", "+", "-", "@", "\t", "\r", "\n")) and not _NUMBER.fullmatch(cell) else cell
    )


_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(inf|nan)")


def _inputs(study: Rows) -> list[Path]:
    """The table of the study and the files that its text names, which must not be overwritten."""
    if study.path is None or not study.path.is_file():
        return []
    with open_study(study.path) as file:
        given = core.parse(core.Source(text(file["study/text"][()]), "study"))
    return [study.path, *(folder / name for name in files.texts(given) for folder in (study.path.parent, Path()))]


def to_parquet(study: Rows, path: str | PathLike[str], **values: float | str) -> None:
    """Writes one Parquet file, with units as metadata. Raises ImportError without PyArrow, InputError for an existing
    file of another kind, OSError."""
    try:
        import pyarrow
        from pyarrow import parquet
    except ModuleNotFoundError as error:
        raise ImportError("this needs pyarrow: type python3 -m pip install pyarrow") from error
    columns = {
        name: pyarrow.array(column.tolist() if column.dtype.kind == "U" else column)
        for name, column in chosen(study, values).items()
    }
    fields = [
        pyarrow.field(name, column.type, metadata={"units": study.units.get(name, "")})
        for name, column in columns.items()
    ]
    with replaced(path, PARQUET, _inputs(study)) as temporary:
        parquet.write_table(pyarrow.Table.from_arrays(list(columns.values()), schema=pyarrow.schema(fields)), temporary)


def to_xarray(study: Rows) -> xarray.Dataset:
    """Dataset with the dimensions record, each factor of the grid, sample if factors are sampled, and level if there
    are levels."""
    import xarray

    factors = study.description["factors"]
    dims: list[str] = ["record"]
    sizes = [len(study.records["name"])]
    coordinates: dict[str, Any] = {"record": study.records["name"]}
    for factor in factors:
        if factor["values"] is not None:
            dims.append(factor["name"])
            sizes.append(len(factor["values"]))
            coordinates[factor["name"]] = factor["labels"] or factor["values"]
    intensity = study.description["intensity"]
    levels = intensity["levels"] if intensity else []
    dims += ["sample", "level"]
    sizes += [study.description["sampling"]["count"], max(1, len(levels))]
    if levels:
        coordinates["level"] = levels
    held = {
        name: (dims, values.reshape(sizes), {"units": study.units.get(name, "")})
        for name, values in study.columns.items()
        if name not in coordinates
    }
    return xarray.Dataset(held, coords=coordinates)
