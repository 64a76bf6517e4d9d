"""Declarations of C and C++ headers for their users, with the comments that document them. Standard library only.

    for item in declarations(path): ...

A comment documents what follows it: `///` in C++ (or `///<` behind it), any comment in C. It holds for the lines below
it as well, up to the next comment or empty line: these declarations are shown together.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Item:
    """One declaration."""

    kind: str  #: struct, class, union, enum, concept, type, function, member, enumerator
    name: str  #: with the namespaces and classes around it
    text: str  #: the declaration without its body and comments
    line: int
    doc: str = ""  #: Markdown
    shares: bool = False  #: documented by the comment above a declaration before it
    elsewhere: bool = False  #: documented where it was first declared, or by its class
    heads: bool = False  #: its comment is above it and applies to the following ones
    members: list[Item] = field(default_factory=list)

    def same_as(self, other: Item) -> bool:
        """Declared once more: a definition after its declaration, a type that depends on a version."""
        texts = [re.sub(r"\binline ", "", one.text) for one in (self, other)]
        return (self.kind, self.name) == (other.kind, other.name) and (self.kind == "type" or texts[0] == texts[1])

    @property
    def is_documented(self) -> bool:
        """True if the header explains this declaration."""
        return bool(self.doc) or self.shares or self.elsewhere


def public_headers() -> tuple[list[str], list[str]]:
    """Installed headers: those with all headers that they include in one file, and the others."""
    text = (ROOT / "cmake/install_headers.cmake").read_text()
    bundles, headers = (
        re.search(rf"(?m)^set\({name}\s([^)]*)\)", text).group(1).split() for name in ("bundles", "headers")
    )
    return bundles, headers


def source_of(header: str) -> Path:
    """The file that `#include <pounding/...>` means; that of a generated header is its template."""
    paths = (ROOT / part / f"{header}{suffix}" for part in ("elements", "lib") for suffix in ("", ".in"))
    return next(path for path in paths if path.exists())


def bundled_headers() -> set[str]:
    """Headers that are installed inside of another one."""
    bundles, _ = public_headers()
    found, pending = set(), list(bundles)
    while pending:
        header = pending.pop()
        if header not in found:
            found.add(header)
            pending += re.findall(r"(?m)^#include <(pounding/[^>]*)>", source_of(header).read_text())
    return found - set(bundles)


def installed_headers() -> list[Path]:
    """Sources of the headers that cmake/install_headers.cmake installs, except version.hpp."""
    bundles, headers = public_headers()
    names = {*bundles, *headers, *bundled_headers()} - {"pounding/core/version.hpp"}
    return sorted(map(source_of, names)) + [ROOT / "elements/c/pounding.h"]


def headers_at(place: Path) -> list[Path]:
    """The installed headers in a folder, or the one header."""
    return sorted(set(place.glob("*.hpp")).intersection(installed_headers())) if place.is_dir() else [place]


def declarations(path: Path) -> tuple[str, list[Item]]:
    """The comment of a header and its public declarations, without namespace `detail`."""
    reader = _Reader(path.read_text(), path.suffix == ".h")
    items = reader.scope("", "namespace")
    return reader.file_doc(), items


class _Reader:
    def __init__(self, source: str, is_c: bool) -> None:
        self.is_c = is_c
        self.leading: dict[int, str] = {}  # line -> text of a comment without code
        self.trailing: dict[int, str] = {}
        self.used: set[int] = set()
        self.first_item = 0
        self.text, self.masked = self._without_comments(source)
        self.at = 0

    def _without_comments(self, source: str) -> tuple[str, str]:
        """Two texts of the same length and lines: one without comments and directives, one also without the contents of
        strings."""
        pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
        text, masked, end = [], [], 0
        for match in pattern.finditer(source):
            for kept in (text, masked):
                kept.append(source[end : match.start()])
            word, blank = match.group(), re.sub(r"[^\n]", " ", match.group())
            if word[0] == "/":
                self._note(source, match.start(), word)
                text.append(blank)
                masked.append(blank)
            else:
                text.append(word)
                masked.append(word[0] + "x" * (len(word) - 2) + word[-1])
            end = match.end()
        for kept in (text, masked):
            kept.append(source[end:])
        directive = re.compile(r"(?m)^[ \t]*#(?:[^\n]*\\\n)*[^\n]*")
        blanked = lambda match: re.sub(r"[^\n]", " ", match.group())
        return directive.sub(blanked, "".join(text)), directive.sub(blanked, "".join(masked))

    def _note(self, source: str, start: int, word: str) -> None:
        line = source.count("\n", 0, start) + 1
        alone = not source[source.rfind("\n", 0, start) + 1 : start].strip()
        if not self.is_c and not word.startswith("///"):
            return
        if self.is_c and word.startswith("/* ----"):
            return
        body = re.sub(r"(?m)^[ \t]*\* ?", "", word[2:-2]).strip() if self.is_c else re.sub(r"^///<? ?", "", word)
        if alone and not word.startswith("///<"):
            for offset, row in enumerate(body.split("\n")):
                self.leading[line + offset] = row
        elif alone:  # continues the trailing comment of the line above
            self.trailing[line - 1] = self.trailing.get(line - 1, "") + " " + body
        else:
            self.trailing[line] = body

    def file_doc(self) -> str:
        """The first comment, unless a declaration has it."""
        lines = sorted(self.leading)
        if not lines or lines[0] in self.used:
            return ""
        return self._block_from(lines[0])

    def _block_from(self, line: int) -> str:
        rows = []
        while line in self.leading:
            rows.append(self.leading[line])
            line += 1
        return "\n".join(rows).strip()

    def _line(self, position: int) -> int:
        return self.masked.count("\n", 0, position) + 1

    def _skip_space(self) -> None:
        while self.at < len(self.masked) and self.masked[self.at] in " \t\n;":
            self.at += 1

    def _past(self, opening: int) -> int:
        """The place behind the brace, bracket or parenthesis that closes the one at `opening`."""
        depth = 0
        for place in range(opening, len(self.masked)):
            if self.masked[place] in "([{":
                depth += 1
            elif self.masked[place] in ")]}":
                depth -= 1
                if depth == 0:
                    return place + 1
        raise ValueError(f"line {self._line(opening)}: nothing closes this")

    def scope(self, prefix: str, kind: str) -> list[Item]:
        """Declarations up to the brace that closes the scope, or the end of the file."""
        items: list[Item] = []
        public, last_line, last_public = kind != "class", -1, False
        while True:
            self._skip_space()
            if self.at >= len(self.masked):
                return items
            if self.masked[self.at] == "}":
                self.at += 1
                return items
            label = re.compile(r"(public|protected|private)\s*:(?!:)").match(self.masked, self.at)
            if label:
                public, last_line = label.group(1) == "public", -1
                self.at = label.end()
                continue
            begin = self.at
            found = self._declaration(prefix, kind)
            first = self._line(begin)
            if not isinstance(found, Item):
                items += found or []
                last_line = -1
                continue
            self._document(found, first, self._line(self.at - 1))
            if (
                not found.doc
                and first <= last_line + 1
                and last_public
                and items
                and (items[-1].heads or items[-1].shares)
            ):
                found.shares = True
            last_line, last_public = self._line(self.at - 1), public
            if public and "::detail" not in found.name and not _is_noise(found):
                # A constructor is documented by its class, an overload by the first of its name.
                is_constructor = found.kind == "function" and _last(found.name) == _last(prefix).split("<")[0]
                found.elsewhere |= is_constructor or any(one.name == found.name and one.is_documented for one in items)
                if not any(one.same_as(found) for one in items):
                    items.append(found)
            elif not public:
                last_line = -1

    def _document(self, item: Item, first: int, last: int) -> None:
        line = first - 1
        while line in self.leading:
            self.used.add(line)
            line -= 1
        above = self._block_from(line + 1) if line < first - 1 else ""
        behind = (
            " ".join(self.trailing[at] for at in range(first, last + 1) if at in self.trailing)
            if not item.members
            else ""
        )
        item.heads = bool(above)
        item.doc = "\n\n".join(part for part in (above, behind) if part)

    def _declaration(self, prefix: str, kind: str) -> Item | list[Item] | None:
        """Reads one declaration: a list for a namespace, None for private declarations."""
        begin, equals, colon = self.at, None, None
        while self.at < len(self.masked):
            c = self.masked[self.at]
            head = self.masked[begin : self.at]
            if c in "([":
                self.at = self._past(self.at)
                continue
            if c == "<" and re.search(r"[\w>]\s?$", head) and not re.search(r"operator\s*$", head) and equals is None:
                self.at = self._past_angle(self.at)
                continue
            if c == "=" and equals is None and not re.search(r"operator\s*(=|!|<|>|<=)?$", head):
                equals = self.at
            if (
                c == ":"
                and equals is None
                and colon is None
                and ")" in head
                and "::" not in self.masked[self.at - 1 : self.at + 2]
            ):
                colon = self.at
            if c == ";":
                self.at += 1
                return self._simple(prefix, begin, min(x for x in (equals, self.at - 1) if x is not None), equals)
            if c == "{":
                if re.search(r"(=|&&|\brequires)\s*requires\s*(\([^()]*\))?\s*$", head):
                    self.at = self._past(self.at)
                    continue
                plain = _without_template(head).strip()
                if re.match(r"(inline )?namespace\b|extern\b", plain):
                    name = re.sub(r"(inline )?namespace|extern|\"\w*\"", "", plain).strip()
                    self.at += 1
                    return self.scope(_join(prefix, name), "namespace")
                word = re.match(r"(?:typedef\s+)?(enum class|enum struct|enum|class|struct|union)\b", plain)
                if word and equals is None and "(" not in plain:
                    return self._type(prefix, begin, word.group(1))
                if "(" in _without_template(head) and equals is None and not (colon and re.search(r"\w$|>$", head)):
                    end = colon if colon else self.at
                    self.at = self._past(self.at)
                    return self._simple(prefix, begin, end, None)
                if equals is None and not colon:
                    equals = self.at
                self.at = self._past(self.at)
                continue
            self.at += 1
        return None

    def _past_angle(self, opening: int) -> int:
        depth, place = 0, opening
        while place < len(self.masked):
            c = self.masked[place]
            if c in "([{":
                place = self._past(place)
                continue
            depth += (c == "<") - (c == ">" and self.masked[place - 1] != "-")
            place += 1
            if depth == 0:
                return place
            if c == ";":
                break
        return opening + 1  # it was "less than"

    def _type(self, prefix: str, begin: int, word: str) -> Item:
        head = " ".join(self.text[begin : self.at].split())
        plain = re.sub(r"^typedef\s+", "", _without_template(head).strip())
        match = re.match(rf"{word}\s+(?:\[\[\w+\]\]\s*)?([\w:]+(?:<[^{{]*>)?)?", plain)
        name = _join(prefix, (match.group(1) or "").split(" : ")[0].strip()) if match else prefix
        line = self._line(begin)
        self.at += 1
        if word.startswith("enum"):
            item = Item("enum", name, head, line, members=self._enumerators(name))
        else:
            item = Item(word, name, re.sub(r"^typedef\s+", "", head), line)
            item.members = self.scope(name, word)
        # Names between the brace and the semicolon are variables of this type.
        self.at = self.masked.index(";", self.at) + 1
        return item

    def _enumerators(self, prefix: str) -> list[Item]:
        close = self._past(self.at - 1) - 1
        items = []
        for match in re.finditer(r"(\w+)(\s*=\s*[^,}]+)?\s*(?=,|$)", self.masked[self.at : close]):
            line = self._line(self.at + match.start())
            items.append(
                Item("enumerator", _join(prefix, match.group(1)), match.group(1), line, self.trailing.get(line, ""))
            )
        self.at = close + 1
        return items

    def _simple(self, prefix: str, begin: int, end: int, equals: int | None) -> Item | None:
        text = " ".join(self.text[begin:end].split())
        text = re.sub(r"\bPND_API\s*", "", text)
        plain = _without_template(text).strip()
        line = self._line(begin)
        if not plain or re.match(
            r"(friend|static_assert|extern template|using namespace|using enum|typedef struct \w+ \w+$)\b", plain
        ):
            if not plain.startswith("typedef struct"):
                return None
        if re.match(r"(class|struct|enum class|enum)\s+\w+$", plain) or re.match(r"template\s*<", plain):
            return None
        if re.match(r"typedef struct \w+ (\w+)$", plain):
            return Item(
                "struct", _join(prefix, plain.split()[-1]), plain.removeprefix("typedef ").rsplit(" ", 1)[0], line
            )
        if re.match(r"concept\b", plain):
            return Item("concept", _join(prefix, plain.split()[1]), text, line)
        if re.match(r"using\s+[\w:]+(,\s*[\w:]+)+$", plain):  # members of a base class
            return None
        if match := re.match(r"using\s+([\w:]+)$", plain):
            if equals is None:
                return None
            whole = " ".join(self.text[begin : self.at - 1].split())
            return Item("type", _join(prefix, match.group(1)), whole, line)
        bare = _without_angles(plain)
        if match := re.search(r"\(\s*\*\s*(\w+)\s*\)\s*\(", bare):  # a pointer to a function
            return Item("member", _join(prefix, match.group(1)), text, line)
        match = re.search(r"(operator\s*(?:\(\)|[^\s\w(]+|\w+)|~?\w+)\s*\(", bare)
        if match and bare[: match.start()].endswith("::"):  # the definition of a member that its class declares
            return None
        if match and not re.match(r".*\boperator\b", bare[: match.start()]):
            text = re.sub(r"\s+(final|override)\b", "", text)
            elsewhere = bool(re.search(r"\boverride\b|\bfinal\b", plain[plain.rfind(")") :]))
            return Item("function", _join(prefix, match.group(1)), text, line, elsewhere=elsewhere)
        names = re.findall(r"\w+(?=\s*(?:\[[^]]*\]\s*)*(?:,|$))", bare)
        whole = " ".join(self.text[begin : self.at - 1].split())
        return Item("member", _join(prefix, names[-1] if names else bare), whole, line)


def _is_noise(item: Item) -> bool:
    """Destructors, copies and moves, template specialisations, and declarations without meaning to users."""
    if item.kind in ("struct", "class") and "<" in item.name:
        return True
    last = _last(item.name)
    around = item.name.rsplit("::", 2)
    is_copy = (
        len(around) > 1
        and item.kind == "function"
        and re.search(rf"\b{re.escape(last)}\((const )?{re.escape(last)}\s*&&?\s*\w*\)", item.text)
    )
    return last.startswith("~") or last.startswith("operator=") and "==" not in last or bool(is_copy)


def _last(name: str) -> str:
    return name.rsplit("::", 1)[-1]


def _join(prefix: str, name: str) -> str:
    return f"{prefix}::{name}" if prefix and name else prefix or name


def _without_template(text: str) -> str:
    text = text.strip()
    while text.startswith("template"):
        depth = 0
        for place, c in enumerate(text):
            depth += (c == "<") - (c == ">")
            if c == ">" and depth == 0:
                text = text[place + 1 :].strip()
                break
        else:
            return text
        if match := re.match(r"requires\s*(?:requires\s*\([^)]*\)\s*\{.*?\}|\([^)]*\)|[\w:]+<[^>]*>|[\w:]+)\s*", text):
            text = text[match.end() :]
    return text


def _without_angles(text: str) -> str:
    """A text without template arguments."""
    before = None
    while before != text:
        before, text = text, re.sub(r"(?<=[\w])<[^<>]*>", "", text)
    return text
