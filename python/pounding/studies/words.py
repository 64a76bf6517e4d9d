"""Words of a study file: readers of its quantities, whose errors name the place and what to type."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from pounding._native import core
from pounding.errors import InputError

#: Words of `study:`; the second of each pair is an example.
STUDY_WORDS = {
    "seed": "1",
    "factors": "{gap: {of: links.*.gap, list: [10 mm, 20 mm]}}",
    "sampling": "{sobol: 128}",
    "records": "{files: records/*.AT2}",
    "intensity": "{measure: pga, levels: [0.1 g, 0.2 g]}",
    "keep": "[displacement, force]",
    "without_links": "yes",
    "limits": "{drift: 30 mm}",
    "stop_after": "5 %",
    "engine": "auto",
}


def only(words: Any, known: Iterable[str], place: str) -> dict[str, Any]:
    """The map `words`. Raises InputError for anything else, and for a key that is not known."""
    if not isinstance(words, Mapping):
        raise InputError(f"{place}: takes a map such as {{{next(iter(known), 'key')}: ...}}; {words!r} was read")
    for key in words:
        if key not in known:
            raise InputError(f'{place}: unknown key "{key}".{meant(str(key), known)} Allowed: {", ".join(known)}')
    return dict(words)


def meant(word: str, known: Iterable[str]) -> str:
    """ " Did you mean "gap"?", or nothing."""
    close = difflib.get_close_matches(word, [str(each) for each in known], 1)
    return f' Did you mean "{close[0]}"?' if close else ""


def quantity(value: Any, place: str) -> tuple[float, str]:
    """Value in SI and its SI unit; "" for a bare number, which is in SI. Raises InputError."""
    if isinstance(value, bool) or isinstance(value, (Mapping, list, tuple)) or value is None:
        raise InputError(f'{place}: takes a number or a quantity such as "20 mm"; {value!r} was read')
    try:
        return core.si_value(value if isinstance(value, str) else repr(float(value)))
    except InputError as error:
        raise InputError(f"{place}: {error}") from None


def quantities(values: Any, place: str) -> tuple[list[float], str]:
    """Values in SI of a list, and their unit. Raises InputError where units differ or only some have one."""
    if not isinstance(values, Sequence) or isinstance(values, str) or not values:
        raise InputError(f"{place}: takes a list of values such as [10 mm, 20 mm]; {values!r} was read")
    read = [quantity(value, f"{place}[{i}]") for i, value in enumerate(values)]
    for i, (_, unit) in enumerate(read):
        if unit != read[0][1]:

            def told(number: int) -> str:
                return f'"{values[number]}" is {"in " + read[number][1] if read[number][1] else "a bare number, which is in SI"}'

            raise InputError(
                f"{place}[{i}]: {told(i)}, and {told(0)}; write every value of the list with a unit of one kind, or all of "
                "them as bare numbers in SI"
            )
    return [number for number, _ in read], read[0][1]


def whole(value: Any, place: str, least: int = 1, most: int | None = None) -> int:
    """A whole number. Raises InputError."""
    number, unit = quantity(value, place)
    if unit or number != int(number) or number < least:
        raise InputError(f"{place}: takes a whole number of at least {least}; {value!r} was read")
    if most is not None and number > most:
        raise InputError(f"{place}: takes at most {most}; {value} was read")
    return int(number)


def yes(value: Any, place: str) -> bool:
    """True or False of `yes` and `no`. Raises InputError."""
    words = {"yes": True, "true": True, "on": True, "no": False, "false": False, "off": False}
    word = str(value).lower()
    if word not in words:
        raise InputError(f"{place}: takes yes or no; {value!r} was read")
    return words[word]


def few(items: Sequence[Any]) -> str:
    """The first five of some things, and the number of the others."""
    return ", ".join(map(str, items[:5])) + (f" and {len(items) - 5} more" if len(items) > 5 else "")


def no_percent(values: Any, place: str, expected: str, example: str) -> None:
    """Raises InputError for a value in %, which would be a bare number, in the place of a quantity with a unit."""
    for value in values if isinstance(values, (list, tuple)) else [values]:
        if isinstance(value, str) and "%" in value:
            raise InputError(f'{place}: takes a quantity in {expected} such as "{example}"; {value} was read')


def same_unit(unit: str, expected: str, place: str, example: str) -> None:
    """Raises InputError where a quantity has a unit that is not the expected one; a bare number is in SI."""
    if unit and unit != expected:
        raise InputError(f'{place}: takes a quantity in {expected or "no unit"} such as "{example}"; it is in {unit}')
