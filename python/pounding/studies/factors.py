"""Factors: what a study varies, where it stands in the model, and the values that it takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.studies import words
from pounding.studies.distributions import KINDS, Distribution, read_distribution
from pounding.studies.files import KEYS, Files

#: Integers up to this one are exact as floating-point numbers.
LARGEST_INTEGER = 2**53
#: Values of one factor, at most.
MOST_VALUES = 1_000_000
_WORDS = ("of", "times", "list", "from", "to", "count", "spacing", "truncate", "at", "column", *KINDS)


@dataclass(frozen=True)
class Factor:
    """A name, the places in the model that take its value, and the values: a list, a distribution, or a column of the
    study's table of samples.

    With `times` the factor is a ratio: the places take it times the number that stands at that path."""

    name: str
    of: tuple[str, ...]
    times: str | None
    unit: str  #: SI unit of the values; "" for bare numbers and ratios
    #: [value] in SI; numbers of `labels` where there are any; None for a distribution and for a column
    values: tuple[float, ...] | None
    distribution: Distribution | None = None
    labels: tuple[str, ...] = ()  #: words, such as names of laws, that the places take instead of numbers
    column: str = ""  #: of the table of samples

    @property
    def is_sampled(self) -> bool:
        """Whether its values stand in the sample, and in no list."""
        return self.values is None

    def word(self, value: float, held: Any) -> str:
        """The text that the model takes for a value in the place of `held`: an integer in the place of one."""
        if self.labels:
            return self.labels[int(value)]
        return str(round(value)) if is_integer(held) and is_whole(value) else repr(float(value))


def with_files(factor: Factor, model: Mapping[str, Any], folder: Path, files: Files) -> Factor:
    """The factor with absolute names in the place of files that its labels name from `folder`."""
    if not factor.labels or not any(keys[-1] in KEYS for path in factor.of for keys in find(model, path, "")):
        return factor
    return replace(factor, labels=tuple(files.find(label, folder) or label for label in factor.labels))


def is_integer(held: Any) -> bool:
    """Whether the text of a model is an integer without a unit."""
    return isinstance(held, str) and held.isascii() and held.strip().removeprefix("+").removeprefix("-").isdigit()


def is_whole(value: float) -> bool:
    """Whether a value is an integer that floating-point numbers hold exactly, up to the round-off of a range or
    ratio."""
    return abs(value) < LARGEST_INTEGER and abs(value - round(value)) <= 1e-12 * abs(value)


def read_factors(given: Any, model: Mapping[str, Any]) -> list[Factor]:
    """The factors of a study file. Raises InputError for a path that meets nothing in the model, for units that do not
    fit, and for words that are not known."""
    if given is None:
        return []
    if not isinstance(given, Mapping):
        raise InputError(f"study.factors: takes a map of names, as in {words.STUDY_WORDS['factors']}")
    factors = [_read(str(name), one, model) for name, one in given.items()]
    places: dict[tuple[str | int, ...], str] = {}
    for factor in factors:
        for keys in (keys for path in factor.of for keys in find(model, path, "")):
            if keys in places:
                raise InputError(
                    f"study.factors.{factor.name}.of: {dotted(keys)} is set by {places[keys]} already; give each place one factor"
                )
            places[keys] = factor.name
    in_order(model, factors)
    return factors


def in_order(model: Mapping[str, Any], factors: Sequence[Factor]) -> list[int]:
    """Numbers of the factors, each after the one that sets the base of its ratio. A ratio of a place that it sets
    itself is one of the model's own number. Raises InputError for ratios of each other."""
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


def _read(name: str, given: Any, model: Mapping[str, Any]) -> Factor:
    place = f"study.factors.{name}"
    if not name.isidentifier():
        raise InputError(
            f'{place}: a factor\'s name is a column of the table: letters, digits and _; "{name}" was read'
        )
    one = words.only(given, _WORDS, place)
    if "of" not in one and "column" not in one:
        raise InputError(f"{place}: say what it is, as in of: links.*.gap")
    # A column that stands nowhere in the model is carried along, for the readings.
    of = one.get("of", [])
    if not isinstance(of, (str, list)) or not all(isinstance(path, str) for path in of):
        raise InputError(f"{place}.of: takes a path such as links.*.gap, or a list of paths; {of!r} was read")
    paths = [of] if isinstance(of, str) else of
    places = [keys for path in paths for keys in find(model, path, f"{place}.of")]
    if one.get("column", "x") in ("", None):
        raise InputError(f"{place}.column: takes the name of a column of the table of samples")
    times = one.get("times")
    if times is not None and len(find(model, times, f"{place}.times")) != 1:
        raise InputError(f"{place}.times: {times} meets several places of the model; name one")
    ways = [kind for kind in ("list", "from", "column", *KINDS) if kind in one]
    if len(ways) != 1:
        raise InputError(
            f"{place}: give its values in one way: a list, from, to and count, a column, or a distribution ({', '.join(KINDS)}); "
            f"{' and '.join(ways) or 'none'} was read"
        )
    distribution, values = None, None
    labels: tuple[str, ...] = ()
    if ways[0] == "list" and _are_labels(one["list"]):
        labels = tuple(map(str, one["list"]))
        values, unit = [float(i) for i in range(len(labels))], ""
    elif ways[0] == "list":
        values, unit = words.quantities(one["list"], f"{place}.list")
    elif ways[0] == "from":
        values, unit = _range(one, place)
    elif ways[0] == "column":
        unit = ""
    else:
        distribution, unit = read_distribution(ways[0], one[ways[0]], one.get("truncate"), place)
    if times is not None:
        words.quantity(at(model, find(model, times, f"{place}.times")[0]), f"{place}.times: {times}")
    if times is not None and unit:
        raise InputError(f"{place}: with times it is a ratio, without a unit; its values are in {unit}")
    if times is None and not labels and ways[0] != "column":
        check_units(model, places, unit, place, _percent(one))
    if (
        values is not None
        and not labels
        and max(map(abs, values)) >= LARGEST_INTEGER
        and any(is_integer(at(model, keys)) for keys in places)
    ):
        raise InputError(
            f"{place}: takes integers below {LARGEST_INTEGER} in the place of {dotted(places[0])}, so that each is exact; {max(values):g} was read"
        )
    return Factor(
        name,
        tuple(paths),
        times,
        unit,
        None if values is None else tuple(values),
        distribution,
        labels,
        str(one.get("column", "")),
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
    (begin, end), unit = words.quantities([one["from"], one["to"]], f"{place}: [from, to]")
    count = words.whole(one["count"], f"{place}.count", 2, MOST_VALUES)
    spacing = one.get("spacing", "even")
    if spacing not in ("even", "log") or spacing == "log" and min(begin, end) <= 0:
        raise InputError(f"{place}.spacing: takes even, or log between positive values; {spacing!r} was read")
    made = np.geomspace(begin, end, count) if spacing == "log" else np.linspace(begin, end, count)
    return [float(value) for value in made], unit


def check_units(
    model: Mapping[str, Any], places: list[tuple[str | int, ...]], unit: str, place: str, percent: str = ""
) -> None:
    """Raises InputError where a factor's unit is not that of the model's own value, and both have one; `percent` is a
    value in %."""
    for keys in places:
        held = at(model, keys)
        if isinstance(held, (Mapping, list)):
            raise InputError(f"{place}.of: {dotted(keys)} is no single value; it holds {', '.join(map(str, held))}")
        try:
            _, own = words.quantity(held, "")
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
    """All places that a path such as `links.*.gap` meets, as keys from the top. Links are found by name, "left-right",
    or number. Raises InputError where there is none."""
    found: list[tuple[str | int, ...]] = [()]
    for step in str(path).split("."):
        further = [(*keys, key) for keys in found for key in _keys(at(model, keys), step)]
        if not further:
            known = list(dict.fromkeys(name for keys in found for name in _names(at(model, keys))))
            whole = ".".join([dotted(found[0]), step]) if found[0] else step
            held = f"there is {', '.join(known)}" if known else "there is nothing"
            raise InputError(
                f"{place}: {path} meets nothing in the model: {whole} is not there; {held}.{words.meant(step, known)} A key that the "
                "model leaves to its default must stand in the model"
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
                f'links.{step} means two links: the one of the name "{step}", and number {step} counted from 0; give the first another name, '
                f'such as "link {step}"'
            )
        return sorted({*named, *numbered})
    return []


def link_name(link: Any, i: int) -> str:
    """The name of a link of the input, by which a path calls it."""
    if isinstance(link, Mapping):
        ends = link.get("between")
        return str(link.get("name") or ("-".join(map(str, ends)) if isinstance(ends, list) else ends or i))
    return str(i)


def at(model: Any, keys: Sequence[str | int]) -> Any:
    """The value at these keys."""
    for key in keys:
        model = model[key]
    return model


def put(model: Any, keys: Sequence[str | int], value: Any) -> None:
    """Replaces what stands at these keys."""
    at(model, keys[:-1])[keys[-1]] = value


def dotted(keys: Sequence[str | int]) -> str:
    """The keys as a path."""
    return ".".join(map(str, keys))
