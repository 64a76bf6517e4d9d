"""Formulas as the program prints them, in TeX."""

import re

GREEK = r"alpha|pi|xi|zeta"
FUNCTIONS = r"arccos|exp|ln|max"
NAMED = r"clamp|STEP"
WORD = rf"(?!(?:{GREEK}|{FUNCTIONS}|{NAMED}|sqrt)\b)[A-Za-z]{{2,}}"
TOKEN = re.compile(
    rf"(?P<text>{WORD}(?: (?:a )?{WORD})*)|(?P<greek>{GREEK})\b|(?P<function>{FUNCTIONS})\b|(?P<named>{NAMED})\b"
    r"|(?P<root>sqrt)|(?P<index>[A-Za-z](?:_\w+|\d+))|(?P<jump>[a-z][+-](?= |$))|(?P<number>[\d.]+)|(?P<letter>[A-Za-z])"
    r"|(?P<open>[(\[{])|(?P<close>[)\]}])|(?P<power>\^)|(?P<after>['*])|(?P<space> +)|(?P<sign><=|>=|.)"
)
SIGNS = {"<=": r"\le ", ">=": r"\ge ", "{": r"\{", "}": r"\}", ";": r";\quad ", "*": "^{*}"}
OPENS = {"jump", "greek", "function", "named", "root", "index", "number", "letter", "open"}
ENDS = {"greek", "index", "number", "letter", "close", "after"}


def tex(formula):
    """`xi = sqrt(5) z/2` is `\\xi =\\sqrt{5}\\,z/2`: names as text, the argument of a root or a power without
    brackets."""
    tokens = [(match.lastgroup, match.group()) for match in TOKEN.finditer(formula)]
    made, at = [], 0
    while at < len(tokens):
        piece, at = _piece(tokens, at)
        made.append(piece)
    return "".join(made)


def _piece(tokens, at):
    """TeX of the piece that begins there, and the place where the next one begins."""
    kind, word = tokens[at]
    if kind in ("root", "power"):
        inner, end = _argument(tokens, at + 1)
        return ("^" if kind == "power" else r"\sqrt") + f"{{{tex(inner)}}}", end
    if kind == "space":
        before, behind = tokens[at - 1][0], tokens[at + 1][0]
        return r"\ " if "text" in (before, behind) or tokens[at - 1][
            1
        ] == "," else r"\," if before in ENDS and behind in OPENS else " ", at + 1
    return {
        "text": rf"\text{{{word}}}",
        "greek": rf"\{word} ",
        "function": rf"\{word} ",
        "named": rf"\operatorname{{{word}}}",
        "index": f"{word[0]}_{{{word[1:].lstrip('_')}}}",
        "jump": f"{word[0]}^{{{word[1:]}}}",
    }.get(kind, SIGNS.get(word, word)), at + 1


def _argument(tokens, at):
    """Text in the brackets that open there, or else one token; and the place where the next begins."""
    depth = 0
    for end in range(at, len(tokens)):
        depth += (tokens[end][0] == "open") - (tokens[end][0] == "close")
        if depth == 0:
            inner = tokens[at + 1 : end] if end > at else tokens[at : end + 1]
            return "".join(word for _, word in inner), end + 1
    raise ValueError("a bracket is not closed")
