"""Values of study files: the keys by the tables of the input, quantities whose dimension the model decides, and texts
with a section removed or added, in which errors have the lines of the file."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding.errors import InputError

#: Examples of the keys of a study: section -> key -> value as typed.
EXAMPLES = core.study_examples()


def read_study(given: Any, text: str = "", name: str = "") -> dict[str, Any]:
    """Keys of `study:` with values in SI and with their defaults, from nested dicts, lists and texts.

    Quantities whose dimension the model decides, such as values of factors, are returned as typed. Raises InputError,
    with the line and the column if `text` is that of the file `name`."""
    shown, table = given, None
    if isinstance(given, Mapping) and isinstance(given.get("sampling"), Mapping):
        table = given["sampling"].get("table")
        if isinstance(table, Mapping):  # arrays of samples
            shown, text = {**given, "sampling": {**given["sampling"], "table": "arrays"}}, ""
    try:
        read: dict[str, Any] = core.read_study(text or yaml_text.emit({"study": shown}), name if text else "")
    except InputError as error:
        # A position in the emitted text would mislead.
        raise InputError(re.sub(r"^:\d+:\d+: ", "", str(error))) from None
    if isinstance(table, Mapping):
        read["sampling"]["table"] = table
    return read


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The suggestion `Did you mean "gap"?` with a space in front; empty if no known name is similar."""
    close = difflib.get_close_matches(name, [str(each) for each in known], 1)
    return f' Did you mean "{close[0]}"?' if close else ""


def quantity(value: Any, place: str) -> tuple[float, str]:
    """Value in SI and its SI unit, which is empty for a bare number. Raises InputError."""
    if isinstance(value, bool) or isinstance(value, (Mapping, list, tuple)) or value is None:
        raise InputError(f'{place}: takes a number or a quantity such as "20 mm"; {value!r} was read')
    try:
        return core.si_value(value if isinstance(value, str) else repr(float(value)))
    except InputError as error:
        raise InputError(f"{place}: {error}") from None


def quantities(values: Any, place: str) -> tuple[list[float], str]:
    """Values of a list in SI, and their SI unit. Raises InputError if units differ, or if only some values have one."""
    if not isinstance(values, Sequence) or isinstance(values, str) or not values:
        raise InputError(f"{place}: takes a list of values such as [10 mm, 20 mm]; {values!r} was read")
    read = [quantity(value, f"{place}[{i}]") for i, value in enumerate(values)]
    for i, (_, unit) in enumerate(read):
        if unit != read[0][1]:
            first, other = (
                f'"{values[j]}" is {"in " + read[j][1] if read[j][1] else "a bare number, which is in SI"}'
                for j in (0, i)
            )
            raise InputError(
                f"{place}[{i}]: {other}, and {first}; write every value of the list with a unit of one kind, or all of "
                "them as bare numbers in SI"
            )
    return [number for number, _ in read], read[0][1]


def shortened(items: Sequence[Any]) -> str:
    """The first five items, and the number of the others."""
    return ", ".join(map(str, items[:5])) + (f" and {len(items) - 5} more" if len(items) > 5 else "")


def require_unit(unit: str, expected: str, place: str, example: str) -> None:
    """Raises InputError if a quantity has a unit other than the expected one; a bare number is in SI."""
    if unit and unit != expected:
        raise InputError(f'{place}: takes a quantity in {expected or "no unit"} such as "{example}"; it is in {unit}')


def text_without(text: str, key: str, rest: Mapping[str, Any]) -> str:
    """The text with empty lines in place of the section `key`; `rest` are the other sections. They are written anew if
    the section cannot be removed by lines."""
    found = re.sub(
        rf"^{key}\s*:[^\n]*(\n(?![^\s#}}\]-])[^\n]*)*", lambda old: "\n" * old[0].count("\n"), text, flags=re.MULTILINE
    )
    return found if _is(found, rest) else yaml_text.emit(rest)


def text_with(text: str, parts: Mapping[str, Any], more: Mapping[str, Any]) -> str:
    """The text of `parts` with the sections `more` after its end, in place of those of the same name."""
    whole = {**parts, **more}
    found = text.rstrip() + "\n" + yaml_text.emit(more)
    return found if text and not set(parts) & set(more) and _is(found, whole) else yaml_text.emit(whole)


def _is(text: str, parts: Mapping[str, Any]) -> bool:
    try:
        return bool(core.parse(core.Source(text, "")) == yaml_text.plain(parts))
    except InputError:
        return False
