"""Checks of the arguments of public functions. An invalid argument raises InputError with its name, its value and the
allowed values.

@takes(count=whole(1), periods=optional(numbers)) def modes(count, periods=None): ..."""

from __future__ import annotations

import functools
import importlib
import inspect
import math
import numbers as abstract
from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike, fspath
from typing import Any, TypeVar

import numpy as np

from pounding.errors import InputError, excerpt

#: Checks a named argument and returns it, converted if several types are allowed. Raises InputError.
Kind = Callable[[str, Any], Any]
#: Maximum length of a path on Linux.
LONGEST_PATH = 4095
Function = TypeVar("Function", bound=Callable[..., Any])


def takes(**kinds: Kind) -> Callable[[Function], Function]:
    """Checks the named arguments of a function. The check of `**parameters` applies to each of them."""

    def decorate(function: Function) -> Function:
        signature = inspect.signature(function)
        rest = next((name for name, one in signature.parameters.items() if one.kind is one.VAR_KEYWORD), "")
        plain = {name: kind for name, kind in kinds.items() if name != rest}

        @functools.wraps(function)
        def checked(*arguments: Any, **named: Any) -> Any:
            given = signature.bind(*arguments, **named)
            for name, kind in plain.items():
                if name in given.arguments:
                    given.arguments[name] = kind(name, given.arguments[name])
            if rest in kinds and rest in given.arguments:
                given.arguments[rest] = {
                    name: kinds[rest](name, value) for name, value in given.arguments[rest].items()
                }
            return function(*given.args, **given.kwargs)

        return checked  # type: ignore[return-value]

    return decorate


def refuse(name: str, expected: str, value: Any) -> InputError:
    """The error for an invalid argument."""
    return InputError(f"{name}: takes {expected}; {excerpt(value)} was given")


def optional(kind: Kind) -> Kind:
    """Also allows None."""
    return lambda name, value: None if value is None else kind(name, value)


def text(name: str, value: Any) -> str:
    """A text."""
    if not isinstance(value, str):
        raise refuse(name, "a text", value)
    if not is_encodable(value):
        raise refuse(name, "a text in UTF-8", value)
    return value


def is_encodable(value: str) -> bool:
    """False for a text with an unpaired surrogate, such as a file name that is not UTF-8."""
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True


def file(name: str, value: Any) -> Any:
    """The name of a file: a text or a path."""
    if (
        not isinstance(value, (str, PathLike))
        or not isinstance(path := fspath(value), str)
        or "\0" in path
        or len(path) > LONGEST_PATH
    ):
        raise refuse(name, f"the name of a file of at most {LONGEST_PATH} characters", value)
    if not is_encodable(path):
        raise refuse(name, "the name of a file in UTF-8", value)
    return value


def flag(name: str, value: Any) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise refuse(name, "True or False", value)
    return bool(value)


def number(least: float = -math.inf, most: float = math.inf, *, open: bool = False) -> Kind:
    """A finite number within these bounds; `open` excludes the lower one."""
    bounds = f" above {least:g}" if open else f" of at least {least:g}" if math.isfinite(least) else ""
    bounds += f"{' and' if bounds else ' of'} at most {most:g}" if math.isfinite(most) else ""

    def check(name: str, value: Any) -> float:
        found = _real(value)
        if found is None or not math.isfinite(found) or not least <= found <= most or (open and found == least):
            raise refuse(name, f"a finite number{bounds}", value)
        return found

    return check


def whole(least: int, most: int | None = None) -> Kind:
    """A whole number within these bounds."""

    bounds = f"of at least {least}" if most is None else f"from {least} to {most}"

    def check(name: str, value: Any) -> int:
        is_whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
        if not is_whole or value < least or (most is not None and value > most):
            raise refuse(name, f"a whole number {bounds}", value)
        return int(value)

    return check


def quantity(name: str, value: Any) -> float | str:
    """A finite number in SI, or a text with a unit, which is parsed later."""
    if isinstance(value, str):
        return text(name, value)
    found = _real(value)
    if found is None or not math.isfinite(found):
        raise refuse(name, 'a finite number in SI or a text with its unit such as "20 mm"', value)
    return found


def numbers(name: str, value: Any) -> np.ndarray:
    """A number, or an array of numbers of any shape, as floats; NaN and infinity are allowed."""
    try:
        found = np.asarray(value)
        if found.dtype.kind in "iuf" or found.size == 0:
            return found.astype(float)
        if found.dtype.kind == "O" and all(_real(one) is not None for one in found.flat):
            return found.astype(float)
    except (TypeError, ValueError, OverflowError):
        pass
    raise refuse(name, "a number or an array of numbers", value)


def numbers_above(least: float) -> Kind:
    """One or more finite numbers above a bound, in one dimension."""

    def check(name: str, value: Any) -> np.ndarray:
        found = numbers(name, value)
        if found.ndim != 1 or found.size == 0 or not np.all(np.isfinite(found) & (found > least)):
            raise refuse(name, f"a list of finite numbers above {least:g}", value)
        return found

    return check


def mapping(name: str, value: Any) -> Mapping[str, Any]:
    """A map whose keys are texts."""
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise refuse(name, "a map from names to values", value)
    return value


def listed(kind: Kind, expected: str = "a list") -> Kind:
    """A sequence whose items are all of a kind."""

    def check(name: str, value: Any) -> list[Any]:
        if not _has_items(value, (Sequence, np.ndarray)):
            raise refuse(name, expected, value)
        return [kind(f"{name}[{i}]", one) for i, one in enumerate(value)]

    return check


def files(name: str, value: Any) -> list[Any]:
    """Names of files, from any iterable."""
    expected = "a list of names of files"
    if not _has_items(value, (Iterable,)):
        raise refuse(name, expected, value)
    return listed(file, expected)(name, list(value))


def one_of(words: Iterable[str]) -> Kind:
    """One of these texts."""
    known = tuple(words)

    def check(name: str, value: Any) -> str:
        if not isinstance(value, str) or value not in known:
            raise refuse(
                name, " or ".join([", ".join(known[:-1]), known[-1]] if len(known) > 1 else known) or "nothing", value
            )
        return value

    return check


def options_of(function: Callable[..., Any], given: Mapping[str, Any], skipped: int = 0) -> None:
    """Raises InputError if a function does not accept these keywords after `skipped` positional arguments."""
    try:
        inspect.signature(function).bind(*[None] * skipped, **given)
    except TypeError as error:
        raise InputError(f"{function.__name__.strip('_')}: {error}") from None


def size(name: str, value: Any) -> tuple[float, float]:
    """Width and height of a picture [in]."""
    found = (
        numbers(name, value)
        if isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes))
        else np.empty(0)
    )
    if found.shape != (2,) or not np.all(np.isfinite(found) & (found > 0) & (found <= 200)):
        raise refuse(name, "width and height [in], each above 0 and at most 200", value)
    return float(found[0]), float(found[1])


def require_package(name: str) -> None:
    """Raises ImportError with the command to install a package, if it is missing."""
    try:
        importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise ImportError(f"this needs {name}: type python3 -m pip install {name}") from error


def _has_items(value: Any, kinds: tuple[type, ...]) -> bool:
    """True for an object of these kinds with items, neither a text, a map nor a single number."""
    single = isinstance(value, (str, bytes, Mapping)) or isinstance(value, np.ndarray) and value.ndim == 0
    return isinstance(value, kinds) and not single


def _real(value: Any) -> float | None:
    """A number as float; None for other values, including True and False."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if not isinstance(value, abstract.Real) or isinstance(value, (bool, np.bool_)):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf
