"""A report as one HTML file."""

from __future__ import annotations

import html
import io
import re

from matplotlib import rc_context

from pounding._pictures.style import STYLE, DrawnOnce
from pounding._report.blocks import Heading, Paragraph, Picture, Report, Table

CSS = """
body { font: 14px/1.45 system-ui, sans-serif; color: #222; max-width: 60em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; margin: 0; } h2 { font-size: 1.15em; margin: 1.6em 0 .4em; border-bottom: 1px solid #bbb; }
.project { font-size: 1.1em; } .subtitle, footer, .note { color: #555; font-size: .9em; }
.verdict { border-left: 4px solid #D55E00; background: #faf3ee; padding: .6em .8em; font-size: 1.1em; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; margin: .8em 0 .2em; font-size: .9em; }
caption { text-align: left; font-weight: bold; padding-bottom: .2em; }
th, td { padding: .15em .7em; text-align: right; } th { border-bottom: 1px solid #888; font-weight: 600; }
tbody tr:nth-child(even) { background: #f5f5f5; } .text { text-align: left; } .group { text-align: center; }
td { font-variant-numeric: tabular-nums; } figure { margin: 1em 0; } figure svg { width: 100%; height: auto; }
figcaption { color: #555; font-size: .9em; } footer { border-top: 1px solid #bbb; margin-top: 2em; overflow-wrap: anywhere; }
@media print { body { max-width: none; margin: 0; font-size: 9pt; } table, figure { break-inside: avoid; }
  @page { size: A4; margin: 15mm; } }
""".strip()
#: Width of pictures [in].
WIDTH = 7.1


def html_page(report: Report) -> str:
    """The report as HTML, with inline pictures."""
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{html.escape(report.title)}</title><style>{CSS}</style></head><body>",
        f"<h1>{html.escape(report.title)}</h1>",
    ]
    if report.project:
        parts.append(f'<div class="project">{html.escape(report.project)}</div>')
    parts.append(f'<div class="subtitle">{html.escape(report.subtitle)}</div>')
    pictures = 0
    for block in report.blocks:
        if isinstance(block, Heading):
            parts.append(f"<h2>{html.escape(block.text)}</h2>")
        elif isinstance(block, Paragraph):
            kind = ' class="verdict"' if block.emphasis else ""
            parts.append(f"<p{kind}>{html.escape(block.text)}</p>")
        elif isinstance(block, Table):
            parts.append(_table(block))
        else:
            pictures += 1
            parts.append(_picture(block, pictures))
    parts.append(f"<footer>{html.escape(report.footer)}</footer></body></html>\n")
    return "\n".join(parts)


def _table(table: Table) -> str:
    def cell(tag: str, text: str, column: int) -> str:
        kind = ' class="text"' if table.is_text(column) else ""
        scope = ' scope="col"' if tag == "th" else ""
        return f"<{tag}{scope}{kind}>{html.escape(text)}</{tag}>"

    lines = [f'<div class="scroll"><table><caption>{html.escape(table.caption)}</caption><thead>']
    if table.groups:
        cells = (f'<th class="group" colspan="{span}">{html.escape(title)}</th>' for title, span in table.groups)
        lines.append(f"<tr>{''.join(cells)}</tr>")
    lines.append(f"<tr>{''.join(cell('th', text, i) for i, text in enumerate(table.columns))}</tr></thead><tbody>")
    lines += [f"<tr>{''.join(cell('td', text, i) for i, text in enumerate(row))}</tr>" for row in table.rows]
    lines.append("</tbody></table></div>")
    if table.note:
        lines.append(f'<div class="note">{html.escape(table.note)}</div>')
    return "\n".join(lines)


def _picture(picture: Picture, number: int) -> str:
    """Inline SVG with texts, whose names differ from those of other pictures."""
    style = {**STYLE, "svg.fonttype": "none", "svg.hashsalt": f"report {number}"}
    file = io.StringIO()
    with rc_context(style):
        figure = DrawnOnce(figsize=(WIDTH, picture.height / 25.4))
        picture.draw(figure, (0.0, 0.0, 1.0, 1.0))
        figure.savefig_into(file, format="svg", metadata={"Date": None, "Creator": None})
    svg = file.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r'(id="|url\(#|href="#)', rf"\g<1>p{number}-", svg)
    alt = html.escape(picture.alt, quote=True)
    return f'<figure role="img" aria-label="{alt}">{svg.strip()}<figcaption>{html.escape(picture.alt)}</figcaption></figure>'
