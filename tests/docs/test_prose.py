"""Comments open with the thing they speak of: "Mass weight of each coordinate", not "What the square of a coordinate
counts".

Counted are comments of C++ and C, of Fortran, and docstrings and comments of Python, that open with a bare What,
Whatever, Of, Those, The same or But for, or with a "Where ..." that no main clause follows. Such an opening makes the
reader look for the noun; a few are the shortest good sentence.

    python3 tests/docs/test_prose.py            # all of them, and how many there are in each folder
"""

import ast
import io
import re
import sys
import tokenize
import unittest
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("elements", "examples", "lib", "python", "tests")
MARKS = {".hpp": "//", ".cpp": "//", ".h": "//", ".c": "//", ".in": "//", ".f90": "!"}
LIMIT = 10

BARE = re.compile(r"(What|Whatever|Of|Those|The same|But for)\b")
#: "Where the files are." has no main clause; "Where it is zero, the step ends." has one behind its comma.
WHERE = re.compile(r"Where\b[^,]*?([.;:](\s|$)|$)")


def is_bare(comment):
    return bool(BARE.match(comment) or WHERE.match(comment))


def marked_comments(text, mark):
    """Comments of a language whose comments end with the line: (line, text); lines below each other are one comment."""
    found, open_at = [], None
    for number, line in enumerate(text.splitlines(), 1):
        behind = re.search(rf"(?<![:\"'\w]){re.escape(mark)}[/!<>*]*<?", line)
        if not behind:
            open_at = None
            continue
        words, alone = line[behind.end() :].strip(), not line[: behind.start()].strip()
        if alone and open_at is not None and words:
            found[open_at] = (found[open_at][0], f"{found[open_at][1]} {words}".strip())
        elif words:
            found.append((number, words))
            open_at = len(found) - 1
        else:
            open_at = None  # an empty line begins a paragraph
        if not alone:
            open_at = len(found) - 1 if words else None
    for block in re.finditer(r"/\*+(.*?)\*/", text, re.DOTALL) if mark == "//" else ():
        found.append((text.count("\n", 0, block.start()) + 1, re.sub(r"\s+\**\s*", " ", block.group(1)).strip()))
    return found


def python_comments(text):
    """Docstrings and comments: (line, text)."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)) and ast.get_docstring(
            node
        ):
            found.append((node.body[0].lineno, " ".join(ast.get_docstring(node).split())))
    last = None
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            words, alone = token.string.lstrip("#:! "), not token.line[: token.start[1]].strip()
            if alone and last == token.start[0] - 1:
                found[-1] = (found[-1][0], f"{found[-1][1]} {words}")
            else:
                found.append((token.start[0], words))
            last = token.start[0] if alone else None
    return found


def comments(path):
    text = path.read_text()
    return python_comments(text) if path.suffix == ".py" else marked_comments(text, MARKS[path.suffix])


def bare_openings():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (*MARKS, ".py") and path.is_file() and "build" not in path.parts:
                for line, words in comments(path):
                    if is_bare(words):
                        yield path.relative_to(ROOT), line, words


class Prose(unittest.TestCase):
    def test_FewCommentsOpenWithoutTheirNoun(self):
        found = [f"{path}:{line}: {words[:80]}" for path, line, words in bare_openings()]
        self.assertLessEqual(len(found), LIMIT, "\n" + "\n".join(found))


class Reader(unittest.TestCase):
    """The check itself knows bare openings, and finds the comments of a file."""

    def test_KnowsABareOpening(self):
        for words in (
            "What the square counts.",
            "Of the present state [s].",
            "Those that move.",
            "The same for 95 %.",
            "But for rounding it is zero.",
            "Where a record is: its name.",
            "Where the files are.",
        ):
            self.assertTrue(is_bare(words), words)
        for words in (
            "Mass weight of each coordinate.",
            "of the floor [kg]",
            "Where the force is zero, the contact ends.",
            "Whether it moves.",
            "Offset of the floor.",
        ):
            self.assertFalse(is_bare(words), words)

    def test_TakesLinesBelowEachOtherForOneComment(self):
        text = (
            "/// Force of a link, and\n/// What is not an opening.\nint a;  // Of two.\nint b;  ///< Those\n"
            '"http://what";\n/* What a\n * block says. */\n'
        )
        self.assertEqual([line for line, words in marked_comments(text, "//") if is_bare(words)], [3, 4, 6])

    def test_ReadsDocstringsAndCommentsOfPython(self):
        text = (
            '"""What it is."""\n\n\ndef f():\n    """A noun."""\n    # Of it,\n    # Those\n    return 1  # The same\n'
        )
        self.assertEqual([line for line, words in python_comments(text) if is_bare(words)], [1, 6, 8])


if __name__ == "__main__" and len(sys.argv) == 1:
    found = list(bare_openings())
    for path, line, words in found:
        print(f"{path}:{line}: {words[:100]}")
    for folder, count in sorted(Counter(path.parent for path, _, _ in found).items()):
        print(f"{count:4} {folder}")
    print(f"{len(found):4} in all; at most {LIMIT}")
