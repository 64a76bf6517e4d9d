"""`.. headers:: PATH ...` shows what headers declare, with their comments; a folder means its installed headers."""

import re

from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective
from sphinx.util.nodes import nested_parse_with_titles
from docutils import nodes

from declarations import ROOT, Item, declarations, headers_at
from pages import rst


class Headers(SphinxDirective):
    required_arguments, final_argument_whitespace = 1, True

    def run(self):
        paths = []
        for word in self.arguments[0].split():
            paths += headers_at(ROOT / word)
        rows = []
        known: list[Item] = []
        for path in paths:
            self.env.note_dependency(str(path))
            rows += self.header(path, known)
        parent = nodes.section()
        parent.document = self.state.document
        nested_parse_with_titles(self.state, StringList(rows, "headers"), parent)
        return parent.children

    def header(self, path, known):
        """Declarations of one header that no header before it has."""
        doc, items = declarations(path)
        items = [item for item in items if not any(one.same_as(item) for one in known)]
        known += items
        title = str(path.relative_to(ROOT)).split("/", 1)[1] if path.suffix == ".hpp" else path.name
        rows = [title, "-" * len(title), "", *rst(doc), ""]
        domain = "c" if path.suffix == ".h" else "cpp"
        space = None
        for group in groups(items):
            around = group[0].name.rpartition("::")[0]
            if domain == "cpp" and around != space:
                rows += [f".. cpp:namespace:: {around or 'NULL'}", ""]
                space = around
            rows += shown(group, domain, "")
        return rows + ([".. cpp:namespace:: NULL", ""] if domain == "cpp" else [])


def groups(items):
    """Groups declarations of one kind that share a comment."""
    together = []
    for item in items:
        same = (
            together
            and item.shares
            and not item.members
            and not together[-1][0].members
            and (item.kind, item.name.rpartition("::")[0])
            == (together[-1][0].kind, together[-1][0].name.rpartition("::")[0])
        )
        if same:
            together[-1].append(item)
        else:
            together.append([item])
    return together


def shown(group: list[Item], domain: str, indent: str) -> list[str]:
    kind, signatures = group[0].kind, [one for item in group for one in signatures_of(item)]
    if kind == "enum" and " class" in group[0].text and domain == "cpp":
        kind = "enum-class"
    directive = f"{indent}.. {domain}:{kind}:: "
    rows = [directive + signatures[0], *(" " * len(directive) + more for more in signatures[1:]), ""]
    inner = indent + "   "
    rows += [inner + row if row else "" for row in rst(group[0].doc)] + [""]
    for members in groups(group[0].members):
        rows += shown(members, domain, inner)
    return rows


def signatures_of(item: Item) -> list[str]:
    """One for each name that is declared: `double a, b` are two."""
    text = signature(item)
    if item.kind != "member":
        return [text]
    parts = [declared(part) for part in split(text, ",")]
    kind = re.sub(r"\*?\w+\s*(\[\w*\])*( = .*)?$", "", parts[0])
    return [parts[0], *(kind + part for part in parts[1:])]


def declared(part: str) -> str:
    """A name with its value, if that is a number, a name or a text."""
    whole, *body = split(part, "{")
    head, *value = split(whole, "=")
    return f"{head} = {value[0]}" if value and not body and re.fullmatch(r"-?[\w.:+-]+|\"[^\"]*\"", value[0]) else head


def split(text: str, sign: str) -> list[str]:
    """Splits at signs outside brackets and strings."""
    depth, parts = 0, [""]
    for word in re.findall(r'"(?:\\.|[^"\\])*"|.', text):
        if word == sign and depth == 0:
            parts.append("")
            continue
        depth += (word in "<([{") - (word in ">)]}")
        parts[-1] += word
    return [part.strip() for part in parts]


def signature(item: Item) -> str:
    text = re.sub(r"\s*requires requires\(.*?\) \{.*?\}", "", item.text)
    if item.kind in ("struct", "class", "union", "enum"):
        return re.sub(
            r"^(template\s*<.*?>\s*)?(enum class|enum|class|struct|union)\s+", lambda m: m.group(1) or "", text
        )
    if item.kind == "type":
        return re.sub(r"\busing\s+", "", text)
    if item.kind == "concept":
        return re.sub(r"\bconcept\s+", "", text)
    return re.sub(r"\b(inline|constinit) (?=\w)", "", text)


def setup(app):
    app.add_directive("headers", Headers)
    return {"parallel_read_safe": True}
