"""Checks of a plan: sections that do not fit together, records that the duration cuts, and numbers without a unit whose
SI value is implausible."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies import reading
from pounding._studies.batches import side_by_side
from pounding._studies.factors import Factor, at, dotted, find
from pounding._studies.motions import Intensity, Motion
from pounding._studies.quantities import COLLAPSED_COLUMN, UNITS, bare_limit_warning
from pounding._studies.reading import quantity
from pounding._studies.sampling import Points
from pounding._studies.template import Places, Template
from pounding.errors import InputError


def require_one_ground(parts: Mapping[str, Any]) -> None:
    """Raises InputError if a structure or support has its own motion, which records and levels do not change."""

    def find(part: Any, place: str) -> None:
        for key, value in part.items() if isinstance(part, Mapping) else ():
            if key == "ground_motion":
                raise InputError(
                    f"{place}.ground_motion: is the same in every row, regardless of records and levels; remove it, or the records and "
                    "the intensity of the study"
                )
            find(value, f"{place}.{key}")

    for name, structure in (parts.get("structures") or {}).items():
        find(structure, f"structures.{name}")


def require_kept(factors: Mapping[str, Mapping[str, Any]]) -> None:
    """Raises InputError for a factor of the ground motion of the model if records replace it."""
    for name, one in factors.items():
        paths = one.get("of", [])
        for path in [paths] if isinstance(paths, str) else paths:
            first, _, rest = path.partition(".")
            if first == "ground_motion" and rest.partition(".")[0] != "wave":
                raise InputError(
                    f"study.factors.{name}.of: the records replace the ground motion of the model; vary intensity instead of {path}"
                )


def require_own_strength(factors: Sequence[Factor], parts: Mapping[str, Any], intensity: Intensity | None) -> None:
    """Raises InputError for a factor that sets the strength of the ground motion if the study has an intensity."""
    strength = ("ground_motion", "synthetic", "pga")
    for factor in factors if intensity else ():
        if any(keys == strength for path in factor.of for keys in find(parts, path, "")):
            raise InputError(
                f"study.factors.{factor.name}.of: intensity sets or measures ground_motion.synthetic.pga; type its values as levels, or leave "
                "intensity out"
            )


def require_free_names(factors: list[Factor]) -> None:
    """Raises InputError if the name of a factor is that of another column of the table."""
    taken = (*UNITS, COLLAPSED_COLUMN, "point", "record", "scale", "im", "status", "engine")
    for factor in factors:
        if factor.name in taken:
            raise InputError(
                f"study.factors.{factor.name}: the table already has a column of this name; rename the factor, for example to {factor.name}_factor"
            )


def require_scales(motions: Sequence[Motion], intensity: Intensity | None) -> None:
    """Raises InputError if no finite factor scales a motion to a level."""
    levels = intensity.levels if intensity else ()
    for motion in motions if levels else ():
        if (
            not motion.intensity > 0
            or not math.isfinite(max(levels) / motion.intensity)
            or min(levels) / motion.intensity == 0
        ):
            raise InputError(
                f"study.intensity: {motion.name} has the intensity {motion.intensity:g} m/s^2, which cannot be scaled to "
                f"{min(levels):g} to {max(levels):g} m/s^2; type other levels, another measure or period, or leave the motion out"
            )


#: Maximum fraction of the Arias intensity cut without a warning, as for a single run.
MAX_CUT = 0.05
#: Maximum number of points of the factors whose durations are compared.
LOOKED_AT = 100_000
#: Maximum number of motions of the model that are checked.
MAX_MOTIONS = 100
#: End of the warning of a model whose duration cuts its record.
_OF_DURATION = "accept: [duration])"


def with_cuts(of_model: Sequence[str], of_first: Sequence[str], cuts: Sequence[str]) -> list[str]:
    """Warnings of the model, with the one about cut records replaced by that for all rows of the study."""
    return [doubt for doubt in of_model if not doubt.endswith(_OF_DURATION)] + list(
        cuts or [doubt for doubt in of_first if doubt.endswith(_OF_DURATION)]
    )


def cut_records(template: Template, points: Points, last_arrival: float, files: Mapping[str, bytes]) -> list[str]:
    """A warning with the number of records that lose more than MAX_CUT of their Arias intensity in any row.

    Empty if there are none, or if the model accepts the warning. A motion reaches the last support at `last_arrival`
    [s]; `files` contains the contents of the records. Raises InputError for an unreadable motion."""
    columns = points.columns(np.unique(np.linspace(0, points.count - 1, min(points.count, LOOKED_AT)).astype(np.int64)))
    values = side_by_side([columns[factor.name] for factor in points.factors], 1)
    durations = _durations(template, values)
    duration = float(durations.min())
    if not duration or "duration" in (template.model.get("accept") or []):
        return []
    cut, worst, needed = 0, 0.0, 0.0
    for number, motion in enumerate(template.motions):
        if 0 < motion.duration <= duration - last_arrival:
            continue
        # Records replace the motion of the model.
        points_of = [int(durations.argmin())] if motion.words else _different_motions(template, values, durations)
        losses = []
        for point in points_of:
            ground = template.case(values[point].tolist(), number, 1.0).get("ground_motion")
            if ground is not None:
                row = core.RowMotion(yaml_text.emit({"ground_motion": ground}), template.place, files)
                losses.append((*row.arias_after(float(durations[point]) - last_arrival), float(durations[point])))
        if losses and max(losses)[0] > MAX_CUT:
            lost, t95, duration = max(losses)
            cut, worst, needed = cut + 1, max(worst, lost), max(needed, t95 + last_arrival)
    if not cut:
        return []
    count = len(template.motions)
    return [
        f"analysis: the duration of {duration:.4g} s cuts {cut} of {count} record{'s' if count > 1 else ''}, by more than {100 * MAX_CUT:g} % of the Arias "
        f"intensity and up to {100 * worst:.0f} %; type a duration of at least {math.ceil(10 * needed) / 10:.6g} s, or leave it out, and each row lasts as "
        "long as its record (to suppress this warning: accept: [duration] in the model)"
    ]


def _durations(template: Template, values: np.ndarray) -> np.ndarray:
    """[point] analysis.duration [s] for the values of [point, factor]; 0 if rows last as long as their motions."""
    analysis = template.model.get("analysis") or {}
    places = Places(template.model, template.factors)
    if ("analysis", "duration") in places.keys:
        return np.asarray(places.numbers(values)[:, places.keys.index(("analysis", "duration"))], dtype=float)
    return np.full(
        len(values), quantity(analysis["duration"], "analysis.duration")[0] if "duration" in analysis else 0.0
    )


def _different_motions(template: Template, values: np.ndarray, durations: np.ndarray) -> list[int]:
    """Points with different ground motions or durations, at most MAX_MOTIONS."""
    moving = [
        j
        for j, factor in enumerate(template.factors)
        if any(path.split(".")[0] in ("ground_motion", "*") for path in factor.of)
    ]
    _, first = np.unique(np.column_stack([durations, values[:, moving]]), axis=0, return_index=True)
    return [int(point) for point in first[np.unique(np.linspace(0, len(first) - 1, MAX_MOTIONS).astype(int))]]


#: Range of peak accelerations of strong motion [g].
WEAKEST, STRONGEST = 0.02, 1.5
#: Ratio to the value of the model above which a bare number is also tried in the unit of the model.
FAR = 5.0
#: Default exponent n of laws.
EXPONENT = 1.5
_NUMBER = re.compile(r"\s*[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
#: Maximum number of samples of a factor that are checked.
LOOKED_AT = 1000


def bare_number_warnings(given: Mapping[str, Any], points: Points, model: Mapping[str, Any]) -> list[str]:
    """Warnings for the keys of a study, given as typed, and for the factors of this model."""
    accepted = model.get("accept") or []
    found = [] if "pga" in accepted else [*_accelerations(given)]
    return [
        *found,
        *filter(None, _limits(given.get("limits") or {})),
        *_factors(points, model, "pga" in accepted),
        *_laws(points, model),
    ]


def _accelerations(given: Mapping[str, Any]) -> Iterator[str]:
    synthetic = (given.get("records") or {}).get("synthetic")
    for place, values in (
        ("study.intensity.levels", (given.get("intensity") or {}).get("levels", [])),
        (
            "study.records.synthetic.pga",
            [synthetic["pga"]] if isinstance(synthetic, Mapping) and "pga" in synthetic else [],
        ),
    ):
        bare = [value for value in values if not _unit_of(value) and _is_like_g(reading.quantity(value, place)[0])]
        if bare:
            yield _in_g(place, bare[0])


def _is_like_g(value: float) -> bool:
    return WEAKEST <= value <= STRONGEST


def _in_g(place: str, value: Any) -> str:
    return f"{place}: a bare {value} is in m/s^2, {float(value) / 9.80665:.3g} g; did you mean {value} g? Type its unit"


def _limits(given: Mapping[str, Any]) -> Iterator[str]:
    for name, value in given.items():
        if not _unit_of(value):
            unit, number = UNITS[str(name).partition(".")[0]], reading.quantity(value, "")[0]
            yield bare_limit_warning(f"study.limits.{name}", number, unit)


def _factors(points: Points, model: Mapping[str, Any], accepts_pga: bool) -> Iterator[str]:
    """Warns of bare values that are far from the value of the model in SI and near it in the unit of the model."""
    columns = points.columns(np.arange(min(points.count, LOOKED_AT)))
    for factor in points.factors:
        if factor.unit or factor.times is not None or factor.labels:
            continue
        values = np.array([factor.values if factor.values is not None else columns[factor.name]]).ravel()
        for keys in (keys for path in factor.of for keys in find(model, path, "")):
            held, place = at(model, keys), f"study.factors.{factor.name}"
            own, unit = reading.quantity(held, place)[0], _unit_of(held)
            if (
                not unit
                and keys[-1] == "pga"
                and not accepts_pga
                and (like := [value for value in values.tolist() if _is_like_g(value)])
            ):
                yield _in_g(place, f"{like[0]:g}")
                break
            far = [
                value
                for value in values.tolist()
                if unit and own and value and _is_meant_in(value, own, core.si_value(f"1 {unit}")[0])
            ]
            if far:
                yield (
                    f"{place}: a bare {far[0]:g} is in SI, and {dotted(keys)} of the model is {held}; did you mean {far[0]:g} {unit}? Type the unit "
                    "with every value"
                )
                break


def _is_meant_in(value: float, own: float, factor: float) -> bool:
    apart = abs(math.log(abs(value / own)))
    return apart > math.log(FAR) and abs(math.log(abs(value * factor / own))) < apart


def _unit_of(value: Any) -> str:
    """The unit as typed; empty for a bare number."""
    found = _NUMBER.match(str(value))
    return str(value)[found.end() :].strip() if found else ""


def _laws(points: Points, model: Mapping[str, Any]) -> Iterator[str]:
    """Warns of lists of laws for which the same bare number has different units."""
    parameters = {law["name"]: {one[0]: one[1] for one in law["parameters"]} for law in core.catalogue()}
    for factor in points.factors:
        for keys in (
            keys for path in factor.of for keys in find(model, path, "") if factor.labels and keys[-1] == "law"
        ):
            link = at(model, keys[:-1])
            found = {name: _units(name, link, factor.labels, parameters) for name in link}
            name, mixed = next(
                ((name, units) for name, units in found.items() if len(set(units.values())) > 1), ("", {})
            )
            if mixed:
                yield (
                    f"study.factors.{factor.name}: {dotted(keys[:-1])}.{name} is a bare {link[name]}, "
                    f"{', '.join(f'in {unit} for {law}' for law, unit in mixed.items())}; compare laws with one unit, or run one study per unit"
                )
                break


def _units(
    name: str, link: Mapping[str, Any], laws: Sequence[str], parameters: Mapping[str, Mapping[str, str]]
) -> dict[str, str]:
    """The unit of a bare number of a link, by the laws that have this parameter."""
    if isinstance(link[name], (Mapping, list)) or _unit_of(link[name]):
        return {}
    exponent = reading.quantity(link.get("exponent", EXPONENT), "")[0]
    return {
        law: parameters[law][name].replace("^(n+1)", f"^{exponent + 1:g}").replace("^n", f"^{exponent:g}")
        for law in laws
        if name in parameters.get(law, {})
    }
