"""Factors: varied quantities of the model and their values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pounding._native import core
from pounding._studies import reading
from pounding._studies.distributions import KINDS, Distribution, read_distribution
from pounding._studies.files import KEYS, Files
from pounding.errors import InputError

#: Floating-point numbers represent integers up to this one exactly.
LARGEST_INTEGER = 2**53


@dataclass(frozen=True)
class Factor:
    """A factor: its name, paths in the model, and values from a list, a distribution or a column of the table of
    samples.

    With `times` the factor is a ratio: the model takes its value times the number at that path."""

    name: str
    of: tuple[str, ...]
    times: str | None
    unit: str  #: SI unit of the values; "" for bare numbers and ratios
    #: [value] in SI, or indices of `labels`; None for a distribution and for a column
    values: tuple[float, ...] | None
    distribution: Distribution | None = None
    labels: tuple[str, ...] = ()  #: names, such as those of laws, instead of numbers
    column: str = ""  #: column of the table of samples
    #: maps that replace the map at the path, one per label
    alternatives: tuple[Any, ...] = ()
    #: the model takes slope * value + shift: the coordinate that gives a gap
    slope: float = 1.0
    shift: float = 0.0

    def description(self) -> dict[str, Any]:
        """Everything that determines the rows; the last three members if they have an effect."""
        found = asdict(self)
        default = {"alternatives": (), "slope": 1.0, "shift": 0.0}
        return {key: value for key, value in found.items() if key not in default or value != default[key]}

    def word(self, value: float, held: Any) -> str:
        """The text of a value in the model; an integer if `held`, the text that it replaces, is one."""
        if self.labels:
            return self.labels[int(value)]
        return str(round(value)) if is_integer(held) and is_whole(value) else repr(float(value))


def with_files(factor: Factor, model: Mapping[str, Any], folder: Path, files: Files) -> Factor:
    """The factor with absolute names of the files among its labels; relative ones start from `folder`."""
    if not factor.labels or not any(keys[-1] in KEYS for path in factor.of for keys in find(model, path, "")):
        return factor
    return replace(factor, labels=tuple(files.find(label, folder) or label for label in factor.labels))


def is_integer(held: Any) -> bool:
    """True if the text of a model is an integer without a unit."""
    return isinstance(held, str) and held.isascii() and held.strip().removeprefix("+").removeprefix("-").isdigit()


def is_whole(value: float) -> bool:
    """True if a value is an integer that floating-point numbers represent exactly, up to the round-off of a range or
    ratio."""
    return abs(value) < LARGEST_INTEGER and abs(value - round(value)) <= 1e-12 * abs(value)


def read_factors(given: Mapping[str, Any], model: Mapping[str, Any]) -> list[Factor]:
    """The factors of a study. Raises InputError for a path without a match in the model and for units that differ from
    those of the model."""
    factors = [_read(name, one, model) for name, one in given.items()]
    places: dict[tuple[str | int, ...], str] = {}
    for factor in factors:
        for keys in (keys for path in factor.of for keys in find(model, path, "")):
            if keys in places:
                raise InputError(
                    f"study.factors.{factor.name}.of: {dotted(keys)} is set by {places[keys]} already; let one factor set each value"
                )
            places[keys] = factor.name
    _require_outside_alternatives(factors, places)
    in_order(model, factors)
    return factors


def _require_outside_alternatives(factors: Sequence[Factor], places: Mapping[tuple[str | int, ...], str]) -> None:
    """Raises InputError for a factor inside a map that another factor replaces."""
    replaced = {name for factor in factors if factor.alternatives for name in (factor.name,)}
    for outer, name in places.items():
        for inner, other in places.items():
            if name in replaced and len(inner) > len(outer) and inner[: len(outer)] == outer:
                raise InputError(
                    f"study.factors.{other}.of: {dotted(inner)} is inside {dotted(outer)}, which {name} replaces as a whole; write its values as more alternatives of {name}"
                )


def in_order(model: Mapping[str, Any], factors: Sequence[Factor]) -> list[int]:
    """Indices of the factors, each after the factor that sets the base of its ratio.

    If a factor sets its own base, the base is the number in the model. Raises InputError for circular ratios."""
    setter = {
        keys: j for j, factor in enumerate(factors) for path in factor.of for keys in find(model, path, factor.name)
    }
    after = {
        j: setter.get(find(model, factor.times, factor.name)[0], j) if factor.times is not None else j
        for j, factor in enumerate(factors)
    }
    found: list[int] = []
    while len(found) < len(factors):
        ready = [j for j in range(len(factors)) if j not in found and (after[j] == j or after[j] in found)]
        if not ready:
            circle = [factor.name for j, factor in enumerate(factors) if j not in found]
            raise InputError(
                f"study.factors.{circle[0]}.times: {' and '.join(circle)} are ratios of each other; give one of them values without times"
            )
        found += ready
    return found


def _read(name: str, one: Mapping[str, Any], model: Mapping[str, Any]) -> Factor:
    place = f"study.factors.{name}"
    if not name.isidentifier():
        raise InputError(
            f'{place}: a factor\'s name is a column of the table: letters, digits and _; "{name}" was read'
        )
    # A factor without a path is a column of the results only.
    of = one.get("of", [])
    if not of and "column" not in one:
        raise InputError(f"{place}: of is missing; type the path of a value, as in of: links.*.gap")
    paths = [of] if isinstance(of, str) else of
    places = [keys for path in paths for keys in find(model, path, f"{place}.of")]
    times = one.get("times")
    if times is not None and len(find(model, times, f"{place}.times")) != 1:
        raise InputError(f"{place}.times: {times} matches several values of the model; type the path of one")
    distribution, values, unit = None, None, ""
    labels: tuple[str, ...] = ()
    kind = next((kind for kind in KINDS if kind in one), "")
    if kind:
        distribution, unit = read_distribution(kind, one[kind], one.get("truncate"), place)
    elif "alternatives" in one:
        _require_alternatives(one["alternatives"], model, places, place)
        labels = tuple(one["alternatives"])
        values = [float(i) for i in range(len(labels))]
    elif _are_labels(one.get("list")):
        labels = tuple(one["list"])
        values = [float(i) for i in range(len(labels))]
    elif "list" in one:
        values, unit = reading.quantities(one["list"], f"{place}.list")
    elif "from" in one:
        values, unit = _range(one, place)
    if times is not None:
        reading.quantity(at(model, find(model, times, f"{place}.times")[0]), f"{place}.times: {times}")
    if times is not None and unit:
        raise InputError(f"{place}: with times it is a ratio, without a unit; its values are in {unit}")
    if times is None and not labels and "column" not in one:
        check_units(model, places, unit, place, _percent(one))
    if (
        values is not None
        and not labels
        and max(map(abs, values)) >= LARGEST_INTEGER
        and any(is_integer(at(model, keys)) for keys in places)
    ):
        raise InputError(
            f"{place}: {dotted(places[0])} takes integers below {LARGEST_INTEGER}, which are exact; {max(values):g} was read"
        )
    return Factor(
        name,
        tuple(paths),
        times,
        unit,
        None if values is None else tuple(values),
        distribution,
        labels,
        one.get("column", ""),
        tuple(one.get("alternatives", {}).values()),
    )


def _require_alternatives(
    given: Mapping[str, Any], model: Mapping[str, Any], places: Sequence[tuple[str | int, ...]], place: str
) -> None:
    """Raises InputError unless the alternatives are maps for maps of the model."""
    example = "{LRB: {lead_rubber: {...}}, FPS: {friction_pendulum: {...}}}"
    if not given:
        raise InputError(f"{place}.alternatives: takes named maps, as in {example}; none was read")
    for name, one in given.items():
        if not isinstance(one, Mapping):
            raise InputError(
                f"{place}.alternatives.{name}: takes a map that replaces the one of the model, as in {example}; {one!r} was read. Single values are a list"
            )
        if not name[:1].isalpha():
            raise InputError(f'{place}.alternatives: a name begins with a letter; "{name}" was read')
    for keys in places:
        if not isinstance(at(model, keys), Mapping):
            raise InputError(
                f"{place}.of: {dotted(keys)} is a single value, and alternatives replace a map; type list: instead, or the path of the map"
            )


def _are_labels(values: Any) -> bool:
    return (
        isinstance(values, Sequence)
        and not isinstance(values, str)
        and bool(values)
        and all(isinstance(value, str) and value[:1].isalpha() for value in values)
    )


def _percent(one: Mapping[str, Any]) -> str:
    """The first value in % of a list, a range or a distribution; "" if there is none."""
    kinds = [one[kind] for kind in KINDS if isinstance(one.get(kind), Mapping)]
    typed = [
        *(one[key] for key in ("list", "from", "to") if key in one),
        *(value for kind in kinds for key, value in kind.items() if key not in ("cov", "beta", "sd", "probabilities")),
    ]
    every = [each for value in typed for each in (value if isinstance(value, list) else [value])]
    return next((each for each in every if isinstance(each, str) and "%" in each), "")


def _range(one: Mapping[str, Any], place: str) -> tuple[list[float], str]:
    for key in ("to", "count"):
        if key not in one:
            raise InputError(f"{place}: a range is from: 0.3, to: 1.5, count: 25; {key} is missing")
    (begin, end), unit = reading.quantities([one["from"], one["to"]], f"{place}: [from, to]")
    is_log = one["spacing"] == "log"
    if is_log and min(begin, end) <= 0:
        raise InputError(f"{place}.spacing: log needs positive ends; {min(begin, end):g} was read")
    made = (np.geomspace if is_log else np.linspace)(begin, end, one["count"])
    return [float(value) for value in made], unit


def check_units(
    model: Mapping[str, Any], places: list[tuple[str | int, ...]], unit: str, place: str, percent: str = ""
) -> None:
    """Raises InputError if the unit of a factor differs from that of the model; bare numbers have none. `percent` is
    a value in %."""
    for keys in places:
        held = at(model, keys)
        if isinstance(held, (Mapping, list)):
            raise InputError(
                f"{place}.of: {dotted(keys)} is not a single value; it contains {', '.join(map(str, held))}"
            )
        try:
            _, own = reading.quantity(held, "")
        except InputError:
            continue
        if percent and own:
            raise InputError(
                f"{place}: {percent} was read, and {dotted(keys)} of the model is {held}; type values in {own}, or a ratio: "
                f"times: {dotted(keys)}"
            )
        if unit and own and unit != own:
            raise InputError(f"{place}: its values are in {unit}, and {dotted(keys)} of the model is {held}, in {own}")


def find(model: Mapping[str, Any], path: str, place: str) -> list[tuple[str | int, ...]]:
    """All matches of a path such as `links.*.gap`, as keys from the top of the model. Links match by name,
    "left-right", or by index. Raises InputError without a match."""
    found: list[tuple[str | int, ...]] = [()]
    for step in str(path).split("."):
        further = [(*keys, key) for keys in found for key in _keys(at(model, keys), step)]
        if not further:
            known = list(dict.fromkeys(name for keys in found for name in _names(at(model, keys))))
            whole = ".".join([dotted(found[0]), step]) if found[0] else step
            held = f"there is {', '.join(known)}" if known else "there is nothing"
            raise InputError(
                f"{place}: {path} does not match the model: {whole} does not exist; {held}.{reading.did_you_mean(step, known)} A key that "
                "has its default value must be typed in the model"
            )
        found = further
    return found


def _names(part: Any) -> list[str]:
    if isinstance(part, Mapping):
        return [str(key) for key in part]
    return [link_name(one, i) for i, one in enumerate(part)] if isinstance(part, list) else []


def _keys(part: Any, step: str) -> list[str | int]:
    if isinstance(part, Mapping):
        return list(part) if step == "*" else [step] if step in part else []
    if isinstance(part, list):
        named = [i for i, one in enumerate(part) if link_name(one, i) == step]
        numbered = [i for i in range(len(part)) if step in ("*", str(i))]
        if named and step != "*" and set(numbered) - set(named):
            raise InputError(
                f'links.{step} matches two links: the one with the name "{step}", and number {step} counted from 0; give the first another name, '
                f'such as "link {step}"'
            )
        return sorted({*named, *numbered})
    return []


def link_name(link: Any, i: int) -> str:
    """The name of a link of the input in paths."""
    if isinstance(link, Mapping):
        ends = link.get("between")
        return str(link.get("name") or ("-".join(map(str, ends)) if isinstance(ends, list) else ends or i))
    return str(i)


def kept_of_link(link: Mapping[str, Any]) -> dict[str, Any]:
    """The keys of a link that do not belong to its law: those that an alternative keeps."""
    of_laws = {"law", "formula", "restitution", "impact_velocity", "reduced_mass"}
    of_laws |= {parameter[0] for law in core.catalogue() for parameter in law["parameters"]}
    return {key: value for key, value in link.items() if key not in of_laws}


def at(model: Any, keys: Sequence[str | int]) -> Any:
    """The value at these keys."""
    for key in keys:
        model = model[key]
    return model


def put(model: Any, keys: Sequence[str | int], value: Any) -> None:
    """Replaces the value at these keys."""
    at(model, keys[:-1])[keys[-1]] = value


def dotted(keys: Sequence[str | int]) -> str:
    """The keys joined to a path."""
    return ".".join(map(str, keys))
