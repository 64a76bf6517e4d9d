"""Texts of files with a section removed or added, in which errors have the lines of the file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding.errors import InputError


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
