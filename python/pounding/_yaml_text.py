"""Nested dicts and lists as YAML in the layout of the examples: short branches on one line, long ones in block
style."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from os import PathLike, fspath
from typing import Any

import numpy as np

from pounding._arguments import is_encodable
from pounding.errors import InputError, excerpt

#: Maximum length of a line, except for longer values.
WIDTH = 118
#: Texts that need no quotes in YAML.
PLAIN = re.compile(r"[A-Za-z0-9_./+][A-Za-z0-9_./+%^ -]*(?<! )|-[0-9.][A-Za-z0-9_./+%^ -]*(?<! )")
NOTHING = ("null", "Null", "NULL", "~")


#: Maximum depth of nested maps and lists; a circular one is infinite.
DEEPEST = 60


def plain(value: Any, place: str = "", depth: int = 0) -> Any:
    """The value as dicts, lists and texts, as parsed from YAML. Raises InputError, with the path, for a value that
    YAML cannot represent."""
    if depth > DEEPEST:
        raise InputError(
            f"{place[:200]}...: has more than {DEEPEST} maps and lists inside each other; does one contain itself?"
        )
    if isinstance(value, Mapping):
        return {
            str(key): plain(inner, f"{place}.{key}" if place else str(key), depth + 1) for key, inner in value.items()
        }
    if isinstance(value, (list, tuple)) or isinstance(value, np.ndarray) and value.ndim:
        return [plain(inner, f"{place}[{i}]", depth + 1) for i, inner in enumerate(value)]
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, PathLike) and isinstance(path := fspath(value), str):
        value = path
    if value is None or isinstance(value, str) and is_encodable(value):
        return value
    if isinstance(value, str):
        raise InputError(f"{place}: takes texts in UTF-8; {excerpt(value)} was given")
    raise InputError(f"{place}: takes numbers, texts, lists and dicts; {excerpt(value)} was given")


def emit(values: Mapping[str, Any]) -> str:
    """YAML text of a result of `plain`, in the order of its keys."""
    return "".join(_entry(key, value, "") for key, value in values.items())


def _entry(key: str, value: Any, indent: str) -> str:
    line = f"{indent}{_scalar(key)}: {_flow(value)}\n"
    nested = isinstance(value, (dict, list)) and value
    if not nested or (indent and len(line) <= WIDTH) or (len(line) <= WIDTH and not _holds_branches(value)):
        return line
    inner = indent + "  "
    if isinstance(value, dict):
        return f"{indent}{_scalar(key)}:\n" + "".join(_entry(k, v, inner) for k, v in value.items())
    return f"{indent}{_scalar(key)}:\n" + "".join(_item(v, inner) for v in value)


def _item(value: Any, indent: str) -> str:
    line = f"{indent}- {_flow(value)}\n"
    if len(line) <= WIDTH or not isinstance(value, dict) or not value:
        return line
    entries = "".join(_entry(k, v, indent + "  ") for k, v in value.items())
    return f"{indent}- {entries[len(indent) + 2 :]}"


def _holds_branches(value: Any) -> bool:
    inner = value.values() if isinstance(value, dict) else value
    return any(isinstance(one, (dict, list)) for one in inner)


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_scalar(k)}: {_flow(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_flow, value)) + "]"
    return _scalar(value)


def _scalar(text: str | None) -> str:
    if text is None:
        return "null"
    return text if PLAIN.fullmatch(text) and text not in NOTHING else json.dumps(text, ensure_ascii=False)
