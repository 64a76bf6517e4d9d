"""Extensions of Sphinx for the site: links to folders, parts of the README as pages, formulas without a network,
comments as reStructuredText, and a first page at the top."""

import os
import re
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.ext.napoleon import Config, NumpyDocstring
from sphinx.util.docutils import SphinxDirective
from sphinx.util.math import get_node_equation_number

from formulas import tex

ROOT = Path(__file__).resolve().parents[2]
#: Pages that stand for folders without a README.
FOLDERS = {ROOT / "examples": ROOT / "python/docs/lessons.md"}
LINK = re.compile(r"(?<=\]\()(?![a-z]+:|#)([^)#\s]+)(?=[)#])")


def links_from(text, folder, page):
    """A text of this folder on a page of another one: links lead to the same files, and to the README of a folder."""

    def link(match):
        target = (folder / match.group(1)).resolve()
        target = FOLDERS.get(target, target)
        if (target / "README.md").is_file():
            target /= "README.md"
        return os.path.relpath(target, page) if target.is_file() else match.group(1)

    return LINK.sub(link, text)


def correct_links(app, docname, source):
    if app.env.doc2path(docname).suffix == ".md":
        folder = Path(app.env.doc2path(docname)).parent
        source[0] = links_from(source[0], folder, folder)


#: Leads the site to all pages of a folder.
LIST_OF_PAGES = "\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"


def typeset_laws(app, docname, source):
    """On the pages of the laws: forces and damping formulas as mathematics, and the list of all laws above its
    pages."""
    if docname == "elements/pounding/hysteresis/pages/README":
        source[0] += LIST_OF_PAGES
    if not docname.startswith("elements/pounding/laws/pages/"):
        return

    def cell(match):
        # A line may break before the definition of another symbol, not inside of mathematics.
        parts = re.split(r"([;,]) (?=\w\*? (?:=|the|and) )", match.group(2))
        return (
            match.group(1)
            + "".join(f"${tex(part)}$" if place % 2 == 0 else f"{part} " for place, part in enumerate(parts))
            + " |"
        )

    text = re.sub(r"(?m)^    (\S.* = .*)$", lambda match: f"$${tex(match.group(1))}$$", source[0])
    source[0] = re.sub(r"(?m)^(\| [^|]* \| )`([^`|]* = [^`|]*)` \|", cell, text)
    if docname.endswith("/README"):
        source[0] += LIST_OF_PAGES


class ReadmeSection(SphinxDirective):
    """`{readme} TITLE`: what the README says under this title, without the title."""

    required_arguments, final_argument_whitespace = 1, True

    def run(self):
        path = ROOT / "README.md"
        self.env.note_dependency(str(path))
        title = self.arguments[0]
        found = re.search(rf"(?ms)^## {re.escape(title)}\n(.*?)(?=^## |\Z)", path.read_text())
        if not found:
            raise self.error(f'README.md has no section "{title}"')
        text = links_from(found.group(1), ROOT, Path(self.env.doc2path(self.env.docname)).parent)
        parent = nodes.Element()
        self.state.nested_parse(StringList(text.splitlines(), str(path)), 0, parent)
        return parent.children


def show_inline(translator, node):
    translator.body.append(tex2mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def show_block(translator, node):
    tex = node.astext()
    if "\\\\" in tex and "\\begin" not in tex:
        tex = f"\\begin{{aligned}}{tex}\\end{{aligned}}"
    number = f'<span class="eqno">({get_node_equation_number(translator, node)})</span>' if node["number"] else ""
    translator.body.append(
        f"{translator.starttag(node, 'div', CLASS='math')}{number}{tex2mathml(tex, as_block=True)}</div>\n"
    )
    raise nodes.SkipNode


def rst(text):
    """A comment or docstring as reStructuredText: an indented block is code; other text is unchanged except for `names`."""
    rows, is_code = [], False
    for row in text.splitlines():
        if row.startswith("    ") and not is_code:
            rows += ["", "::", ""]
            is_code = True
        elif is_code and row.strip() and not row.startswith("    "):
            rows.append("")
            is_code = False
        rows.append(row if is_code else literal(row))
    return rows


def literal(row):
    """A line as reStructuredText: outside names in backticks all signs are literal, and "file:line" is not a URL."""
    parts = re.split(r"(`[^`]+`)", row)
    return "".join(
        part if place % 2 else re.sub(r"([*|_`\\]|(?<=\bfile):)", r"\\\1", part) for place, part in enumerate(parts)
    )


#: First line of a section of numpydoc.
SECTION = re.compile(r"(?m)^(?=[A-Z][a-z]+\n-{5,}$)")


def docstring(app, what, name, obj, options, lines):
    """Text before the sections as comments are; sections by Sphinx, with literal descriptions."""
    text, *sections = SECTION.split("\n".join(lines))
    lines[:] = rst(text)
    for section in sections:
        rows = section.splitlines()
        if rows[0] != "Examples":
            rows = [f"    {literal(row[4:])}" if row.startswith("    ") else row for row in rows]
        config = Config(napoleon_use_rtype=False, napoleon_use_param=False)
        lines += ["", *NumpyDocstring(rows, config, app, what, name, obj, options).lines()]


def first_page(app, exception):
    """build/docs/index.html leads to the first page."""
    if exception is None and app.builder.format == "html":
        target = app.builder.get_target_uri(app.config.root_doc)
        (Path(app.outdir) / "index.html").write_text(
            f'<!DOCTYPE html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url={target}"><a href="{target}">pounding</a>\n'
        )


def setup(app):
    app.add_directive("readme", ReadmeSection)
    app.add_html_math_renderer("mathml", (show_inline, None), (show_block, None))
    app.connect("source-read", correct_links)
    app.connect("source-read", typeset_laws)
    app.connect("autodoc-process-docstring", docstring)
    app.connect("build-finished", first_page)
    return {"parallel_read_safe": True}
