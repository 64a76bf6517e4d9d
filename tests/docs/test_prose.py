"""Comments, docstrings, messages and pages are plain technical English: few of the patterns that make it sound translated.

    python3 tests/docs/test_prose.py            # every place, and the count per 10,000 words of each folder
    python3 tests/docs/test_prose.py lib        # the places below one folder

Each pattern is a phrase for which technical English has a standard term, named with it. A pattern may also hit a correct
sentence, so a few hits per folder are allowed.
"""

import ast
import io
import re
import sys
import tokenize
import unittest
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("elements", "lib", "python", "examples", "tests", "cmake")
PAGES_AT_THE_TOP = ("README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md")
MARKS = {".hpp": "//", ".cpp": "//", ".h": "//", ".c": "//", ".in": "//", ".inc": "//", ".f90": "!"}
LIMIT = 5.0  #: hits per 10,000 words
FEWEST_WORDS = 2000  #: folders with fewer words are counted with the folder above them

#: The term to use instead, and the phrase.
PATTERNS = {
    "a noun (the state, the value)": r"\b(?:by|of|to|for|with|from|in|on|than|and|is|are|as|about|after|before) what(?:ever)? (?!if\b)(?:\w+ )?(?:is|are|was|were|it|they|the|a|an|can|has|have|does|do|will|would|no|its|we|other|another|each|every|\w+s)\b|^What(?:ever)?\b(?![^.]*\?)",
    "the noun first": r"^(?:Of|Those|The same|But for)\b",
    "next to, in addition to, compared with": r"\bbeside\b",
    "is, lies, follows, appears": r"\b(?:stands?|stood|standing)\b(?!-| still| for\b)",
    "separate, own, automatically": r"\bby (?:itself|themselves|himself)\b|\bof (?:its|their|his|our|your|one's) own\b",
    "empty, nullopt or null if": r"\bnothing (?:where|for|of|in|at|there|that|but)\b|\bnothing (?:is|was|are)\b",
    "reports, states": r"\b(?:tells?|told|telling)\b",
    "there is no, without, permanently": r"\b(?:is|are|was|were) no (?!longer\b|more\b|less\b|\w+er than\b)|\bfor good\b",
    "key, option, argument": r"(?<!pounding )(?<!`)\bwords?\b(?! processor)",
    "continue, resume, proceed": r"\b(?:go|goes|going|went|gone) on\b",
    "similar, identical, both": r"\b(?:likewise|alike)\b",
    "simultaneously, in one call, immediately": r"\bat once\b",
    "fraction, share": r"\b(?:as a|the same|this|that|which|a small|a large|what) part of\b|\bparts? of (?:it|its|the (?:value|error|tolerance|sum|energy|force|time))\b",
    "bitwise identical": r"\bbits? of (?:the|a|its|their)\b|\b(?:the )?(?:same|equal) bits\b|\bto the last bit\b",
    "also, as well": r", too\b(?=[.;,:)]|$)|, too [a-z]",
    "that many, n": r"\bso (?:many|much|often|few|long)\b(?! as)(?! that)",
    "per": r"\b(?:one|two|three|each|once|twice|times|steps|iterations|impacts|values|floors|rows|nodes|links|bytes|numbers|columns|points|seconds|bits|unknowns|degrees|lines|terms|products|calls|entries|forces|states|%s|\d+ (?!if\b|during\b)\w+) (?:a|an) (?:link|structure|floor|step|contact|spring|member|row|storey|node|column|process|key|run|line|record|group|mode|file|impact|pair|law|model|unknown|thread|device|hinge|section|module|element|test|page|case|frame|command|chunk|entry)\b",
    "instead of": r"\bin (?:the|its|their) places?\b",
    "minimum, lowest, smallest": r"\bleast\b(?<!at least)|\bmost\b(?<!at most)(?! of\b| recent\b| common)|\bas many again\b",
    "requires, expects, requests": r"\b(?:asks?|asked|asking) (?:for|of)\b|\bis asked\b|\bare asked\b|\bwas asked\b",
    "contains, stores, satisfies": r"\b(?:knows?|wants?|sees?|feels?|wants) (?:of |no |nothing|only|its|their|how|whether|where|what)\b",
    "fails, yields": r"\bgives? way\b|\bgave way\b",
}
COMPILED = [
    (term, re.compile(pattern, re.IGNORECASE if "^" not in pattern else 0)) for term, pattern in PATTERNS.items()
]


def marked_comments(text, mark):
    """Comments of a language whose comments end with the line: (line, text); consecutive lines are one comment."""
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
            open_at = None  # an empty line starts a new paragraph
        if not alone:
            open_at = len(found) - 1 if words else None
    for block in re.finditer(r"/\*+(.*?)\*/", text, re.DOTALL) if mark == "//" else ():
        found.append((text.count("\n", 0, block.start()) + 1, re.sub(r"\s+\**\s*", " ", block.group(1)).strip()))
    return found


def cpp_messages(text):
    """String literals of at least four words: (line, text); adjacent literals are one."""
    for match in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', re.sub(r"//[^\n]*", "", text)):
        words = " ".join("".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match.group())).split())
        if len(re.findall(r"[A-Za-z]{2,}", words)) > 3:
            yield text.count("\n", 0, match.start()) + 1, words


def python_texts(text):
    """Docstrings, comments and other strings of at least four words: (line, text)."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            if len(re.findall(r"[A-Za-z]{2,}", node.value)) > 3:
                found.append((node.lineno, " ".join(node.value.split())))
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


def markdown_paragraphs(text):
    """Paragraphs outside fences and without inline code: (line, text)."""
    found, fence, words, start = [], None, [], 0
    for number, line in enumerate([*text.splitlines(), ""], 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and (fence is None or line.strip() == fence):
            fence = mark.group(1) if fence is None else None
            line = ""
        elif fence:
            continue
        line = re.sub(r"`[^`]*`|\$\$?[^$]*\$\$?|\]\([^)]*\)|<!--.*?-->", " x ", line)
        if line.strip() and not re.match(r"\s*([-*]|\d+\.|\||#)\s", line):
            start = start or number
            words.append(line.strip())
        else:
            if words:
                found.append((start, " ".join(words)))
            words, start = ([line.strip()], number) if line.strip() else ([], 0)
    return found


def texts(path):
    text = path.read_text()
    if path.suffix == ".py":
        return python_texts(text)
    if path.suffix == ".md":
        return markdown_paragraphs(text)
    return [
        *marked_comments(text, MARKS[path.suffix]),
        *(cpp_messages(text) if path.suffix in (".hpp", ".cpp") else ()),
    ]


def hits(words):
    """(term, phrase) of each pattern that a text contains."""
    return [(term, match.group()) for term, pattern in COMPILED for match in pattern.finditer(words)]


def sources():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            skipped = (  # generated pages, and the phrases themselves
                "pages" in path.parts
                or path.name in ("words.md", Path(__file__).name)
                or path.parts[-2:] == ("verification", "README.md")
            )
            if path.suffix in (*MARKS, ".py", ".md") and path.is_file() and "build" not in path.parts and not skipped:
                yield path
    yield from (ROOT / name for name in PAGES_AT_THE_TOP)


def counted():
    """Folder -> its number of words, and folder -> places (path, line, term, phrase, text)."""
    words, places = defaultdict(int), defaultdict(list)
    for path in sources():
        name = path.relative_to(ROOT)
        for line, text in texts(path):
            words[name.parent] += len(re.findall(r"[A-Za-z]{2,}", text))
            places[name.parent] += [(name, line, term, phrase, text) for term, phrase in hits(text)]
    for folder in sorted(words, key=lambda one: -len(one.parts)):
        if words[folder] < FEWEST_WORDS and folder.parts:
            words[folder.parent] += words.pop(folder)
            places[folder.parent] += places.pop(folder, [])
    return words, places


def shown(name, line, term, phrase, text):
    at = text.find(phrase)
    return f'{name}:{line}: "{phrase}", better {term}: ...{text[max(0, at - 40) : at + len(phrase) + 40]}...'


class Prose(unittest.TestCase):
    def test_FewTranslatedSoundingPhrases(self):
        words, places = counted()
        for folder, found in places.items():
            rate = 1e4 * len(found) / words[folder]
            with self.subTest(folder=str(folder)):
                listed = "\n".join(shown(*place) for place in found)
                self.assertLessEqual(rate, LIMIT, f"{len(found)} in {words[folder]} words\n{listed}")


class Reader(unittest.TestCase):
    """Checks that the test recognises the phrases and finds the texts of a file."""

    def test_KnowsThePhrases(self):
        for text in (
            "What the square counts.", "Those that move.", "Files beside the first.", "It stands here.", "One a link.",
            "It goes on.", "Nothing where it is open.", "They are alike.", "All at once.", "The same bits.",
            "Names, too.", "The least value.", "It is told so.", "There is no force.", "In the place of it.",
        ):  # fmt: skip
            self.assertTrue(hits(text), text)
        for text in ("Mass of each floor [kg].", "At least two, at most three.", "Where the force is zero, it ends."):
            self.assertEqual(hits(text), [], text)

    def test_TakesConsecutiveLinesForOneComment(self):
        text = "/// Force of a link, and\n/// its sign.\nint a;  // Of two.\nint b;  ///< Those\n/* A\n * block. */\n"
        self.assertEqual([line for line, _ in marked_comments(text, "//")], [1, 3, 4, 5])

    def test_ReadsDocstringsCommentsAndMessagesOfPython(self):
        text = '"""A noun and its property."""\nx = "a text of five words"\n# A comment\n# of two lines\n'
        self.assertEqual([line for line, _ in python_texts(text)], [1, 2, 3])

    def test_ReadsMessagesOfCpp(self):
        self.assertEqual(list(cpp_messages('f("one", "a text "\n  "of five words");')), [(1, "a text of five words")])

    def test_ReadsParagraphsOfMarkdownOutsideFences(self):
        text = "# Title\n\nOne `code` line\nand two\n\n```\nnot this\n```\n- item\n"
        self.assertEqual(markdown_paragraphs(text), [(1, "# Title"), (3, "One  x  line and two"), (9, "- item")])


if __name__ == "__main__":
    words, places = counted()
    below = sys.argv[1] if len(sys.argv) > 1 else ""
    for folder in sorted(places):
        if str(folder).startswith(below):
            print("\n".join(shown(*place) for place in places[folder]))
    for folder in sorted(words):
        if str(folder).startswith(below):
            print(f"{1e4 * len(places[folder]) / words[folder]:6.1f} per 10,000 of {words[folder]:6} words  {folder}")
    print(f"{1e4 * sum(map(len, places.values())) / sum(words.values()):6.1f} in all")
