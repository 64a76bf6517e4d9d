"""Warnings for numbers without a unit whose SI value is implausible."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from pounding._native import core
from pounding._studies import reading
from pounding._studies.factors import at, dotted, find
from pounding._studies.quantities import UNITS, bare_limit_warning
from pounding._studies.sampling import Points

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
