"""Files named by a plan. Each is read once; later changes of a file have no effect on the rows."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from pounding._native import core
from pounding.errors import InputError

#: Keys with names of files.
KEYS = ("record",)


class Files(dict[str, bytes]):
    """Contents of files by absolute name."""

    def content(self, name: str) -> bytes:
        """The content of a file with an absolute name. Raises InputError if it cannot be read."""
        if name not in self:
            self[name] = core.read_record(name)
        return self[name]

    def find(self, name: str, folder: Path) -> str | None:
        """The absolute name of a file that is named relative to `folder`; None if it cannot be read."""
        try:
            found = str(Path(core.find_record(name, str(folder))).resolve())
            self.content(found)
        except (InputError, OSError):
            return None
        return found

    def named_by(self, part: Any) -> dict[str, bytes]:
        """The files named by texts in nested dicts and lists."""
        return {text: self[text] for text in texts(part) if text in self}

    def digests(self, part: Any) -> dict[str, str]:
        """SHA-256 of the files named by texts in nested dicts and lists."""
        return {name: hashlib.sha256(content).hexdigest() for name, content in sorted(self.named_by(part).items())}


def absolute(parts: Mapping[str, Any], folder: Path, files: Files) -> tuple[dict[str, Any], dict[str, bytes]]:
    """The parts of a model with absolute file names, and the contents of the files by the names in the model.

    Names of unreadable files are kept, so that the reader of models reports their position."""
    typed: dict[str, bytes] = {}

    def named(part: Any, key: str = "") -> Any:
        if isinstance(part, Mapping):
            return {inner: named(value, inner) for inner, value in part.items()}
        if isinstance(part, list):
            return [named(one) for one in part]
        if key not in KEYS or not isinstance(part, str) or (found := files.find(part, folder)) is None:
            return part
        typed[part] = files[found]
        return found

    return {key: named(value) for key, value in parts.items()}, typed


def texts(part: Any) -> Iterator[str]:
    """All texts of nested dicts and lists, without keys."""
    if isinstance(part, (Mapping, list, tuple)):
        for value in part.values() if isinstance(part, Mapping) else part:
            yield from texts(value)
    elif isinstance(part, str):
        yield part


def replaced(part: Any, by: Callable[[str], str]) -> Any:
    """Nested dicts and lists with replaced texts."""
    if isinstance(part, Mapping):
        return {key: replaced(value, by) for key, value in part.items()}
    if isinstance(part, (list, tuple)):
        return [replaced(one, by) for one in part]
    return by(part) if isinstance(part, str) else part


def by_content(description: Mapping[str, Any]) -> dict[str, Any]:
    """The description of a plan with digests instead of file names, which is the same for copies of a folder."""
    digests = description["files"]
    found: dict[str, Any] = replaced(
        {key: value for key, value in description.items() if key != "files"}, lambda text: digests.get(text, text)
    )
    return found


def relative(description: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The description of a plan with file names relative to `folder`, that of the table, so that both can be moved
    together."""

    def from_folder(text: str) -> str:
        return os.path.join(".", os.path.relpath(text, folder.resolve())) if text in description["files"] else text

    found: dict[str, Any] = replaced(description, from_folder)
    return {**found, "files": {from_folder(name): digest for name, digest in description["files"].items()}}


def located(description: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The inverse of `relative`. Tables of version 0.2.0 have absolute names."""
    names = description.get("files", {})
    found: dict[str, Any] = replaced(
        description, lambda text: str((folder / text).resolve()) if text in names else text
    )
    return found
