"""The parts of the page of `pounding reproduce`, as HTML."""

import html
import re
from typing import Any

from pounding._paper.mathematics import formula, rich

BADGES = {"agrees": "yes", "does not agree": "no", "cannot be checked": "open"}
OF_SEVERAL = {"agrees": "agree", "does not agree": "do not agree", "cannot be checked": "cannot be checked"}
TITLE = "The paper, recomputed"
#: Tables with more rows than these are folded.
LONG_TABLE = 25

STYLE_SHEET = """
:root { --ink: #1c2430; --quiet: #5b6675; --line: #d9dee5; --paper: #ffffff; --wash: #f5f7fa; --accent: #0072B2; }
* { box-sizing: border-box; }
body { margin: 0; color: var(--ink); background: var(--paper); font: 16px/1.55 Charter, "Bitstream Charter", Cambria, Georgia, serif; }
main { max-width: 62rem; margin: 0 auto; padding: 2.5rem 1.5rem 5rem; }
h1, h2, h3, nav, table, figcaption, .badge, .place, .quiet { font-family: "Source Sans 3", "Segoe UI", Helvetica, Arial, sans-serif; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.4rem; margin: 3.2rem 0 .1rem; padding-top: 1rem; border-top: 2px solid var(--ink); }
h3 { font-size: 1rem; margin: 1.8rem 0 .5rem; }
p { margin: .7rem 0; max-width: 48rem; }
.quiet { color: var(--quiet); font-size: .88rem; }
a { color: var(--accent); text-decoration: none; } a:hover { text-decoration: underline; }
code { font-size: .88em; background: var(--wash); padding: .1em .3em; border-radius: 3px; }
table { border-collapse: collapse; font-size: .82rem; line-height: 1.4; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .6rem; text-align: right; border-bottom: 1px solid var(--line); vertical-align: top; }
th { font-weight: 600; vertical-align: bottom; border-bottom: 1.5px solid var(--ink); }
th:first-child, td:first-child, table.equations th, table.equations td { text-align: left; }
table.equations { width: 100%; table-layout: fixed; }
table.equations td { overflow-wrap: break-word; hyphens: auto; }
th .unit { display: block; font-weight: 400; color: var(--quiet); }
td:first-child { white-space: nowrap; } table.equations td:first-child { white-space: normal; }
.scroll { overflow-x: auto; margin: .4rem 0 1.2rem; }
summary { font: .85rem Helvetica, Arial, sans-serif; color: var(--accent); cursor: pointer; }
.badge { display: inline-block; font-size: .74rem; font-weight: 600; padding: .1rem .5rem; border-radius: 1rem; white-space: nowrap; }
.yes { background: #d9f0e6; color: #005c42; } .no { background: #fbe0d2; color: #8a3500; } .open { background: #e7eaef; color: #444f5e; }
table.equations .badge { white-space: normal; }
.place { font-weight: 600; }
.reason { color: var(--quiet); }
figure { margin: 1.6rem 0; } figure img { width: 100%; height: auto; display: block; }
figure.narrow img { width: 68%; margin: 0; }
figcaption { font-size: .85rem; color: var(--quiet); margin-top: .4rem; } figcaption b { color: var(--ink); }
.equations { margin: 1rem 0; padding: .5rem 1rem; background: var(--wash); border-left: 3px solid var(--line); overflow-x: auto; }
.equation { display: flex; padding: .3rem 0; justify-content: space-between; align-items: center; gap: 1.5rem; min-height: 2.4em; }
.equation .number { font-family: Helvetica, Arial, sans-serif; font-size: .8rem; color: var(--quiet); text-align: right; }
.math { display: inline-block; }
.matrices { display: flex; flex-wrap: wrap; gap: 1rem 2.2rem; margin: 1rem 0; }
.matrix table { border-left: 1.5px solid var(--ink); border-right: 1.5px solid var(--ink); border-radius: 5px; }
.matrix td, .matrix td:first-child { border: 0; text-align: right; padding: .15rem .6rem; }
nav ol { padding-left: 1.3rem; columns: 1; } nav li { margin: .2rem 0; }
nav .counts { margin-left: .5rem; }
@media print { main { max-width: none; padding: 0; } h2 { break-after: avoid; } figure, tr { break-inside: avoid; } }
"""


def badge(judgement: str, text: str | None = None) -> str:
    """The HTML of a verdict."""
    return f'<span class="badge {BADGES[judgement]}">{html.escape(text or judgement)}</span>'


def _counts(items: list[dict[str, Any]]) -> str:
    count = dict.fromkeys(BADGES, 0)
    for item in items:
        for verdict in item["verdicts"]:
            count[verdict["judgement"]] += 1
    return " ".join(
        badge(judgement, f"{number} {judgement if number == 1 else OF_SEVERAL[judgement]}")
        for judgement, number in count.items()
        if number
    )


def contents(items: list[dict[str, Any]]) -> str:
    """Head of the page: its subject, the number of verdicts of each kind, and links to the parts."""
    entries = "".join(
        f'<li><a href="#{item["name"]}">{html.escape(item["title"])}</a> '
        f'<span class="quiet">{html.escape(item["sections"])}</span><span class="counts">{_counts([item])}</span></li>'
        for item in items
    )
    return f"""<header><h1>{TITLE}</h1>
<p class="quiet">H. Naderpour, R. C. Barros, S. M. Khatami: A new model for calculating impact force and energy dissipation based on
the CR-factor and impact velocity. Scientia Iranica, Transactions A: Civil Engineering, 2015.</p>
<p>Every equation, table and figure of the paper, computed by the contact laws of this program and by runs through time, with a
verdict on each: it <em>agrees</em>, it <em>does not agree</em> (with the printed value, ours and the likely reason), or it
<em>cannot be checked</em> (with the missing information). The text at hand is a machine extraction of the paper: a missing dot, sign or
exponent may be a loss of the extraction, and the verdicts say so where that is possible. The numbers behind each figure are in the
CSV file named below it, the whole in report.json.</p>
<p>{_counts(items)}</p></header>
<nav><ol>{entries}</ol></nav>"""


def _verdicts(verdicts: list[dict[str, str]]) -> str:
    rows = "".join(
        f'<tr><td>{badge(v["judgement"])}<br><span class="place">{rich(v["place"])}</span></td><td>{rich(v["claim"])}</td>'
        f'<td>{rich(v["printed"])}</td><td>{rich(v["ours"])}</td><td class="reason">{rich(v["reason"])}</td></tr>'
        for v in verdicts
    )
    return (
        '<h3>Verdicts</h3><div class="scroll"><table class="equations"><colgroup><col style="width:19%"><col style="width:17%">'
        '<col style="width:16%"><col style="width:25%"><col style="width:23%"></colgroup>'
        f"<tr><th>Where</th><th>Claim</th><th>Printed</th><th>Ours</th><th>To what, or why not</th></tr>{rows}</table></div>"
    )


def _equations(equations: list[dict[str, str]]) -> str:
    lines = "".join(
        f'<div class="equation"><span>{formula(e["tex"], 12)}</span><span class="number">({html.escape(e["number"])})</span></div>'
        for e in equations
    )
    return f'<div class="equations">{lines}</div>' if equations else ""


def _matrices(matrices: list[dict[str, Any]]) -> str:
    def cells(matrix: dict[str, Any]) -> str:
        return "".join(
            "<tr>" + "".join(f"<td>{_number(value, 3)}</td>" for value in row) + "</tr>" for row in matrix["rows"]
        )

    blocks = "".join(
        f'<div class="matrix"><div class="quiet">{html.escape(m["name"])} [{html.escape(m["unit"])}]</div>'
        f"<table>{cells(m)}</table></div>"
        for m in matrices
    )
    return f'<div class="matrices">{blocks}</div>' if matrices else ""


def item_head(item: dict[str, Any]) -> str:
    """Start of an item: text, equations, matrices, verdicts. The figures and tables follow, then </section>."""
    paragraphs = "".join(f"<p>{rich(text)}</p>" for text in item["paragraphs"])
    return (
        f'<section id="{item["name"]}"><h2>{html.escape(item["title"])}</h2>'
        f'<p class="quiet">{html.escape(item["sections"])}. <code>pounding reproduce --only {item["name"]}</code>, '
        f"computed in {item['seconds']:.2f} s.</p>{paragraphs}{_equations(item['equations'])}{_matrices(item['matrices'])}"
        f"{_verdicts(item['verdicts'])}"
    )


def figure(described: dict[str, Any], address: str) -> str:
    """A figure with its caption; `address` is that of the picture."""
    narrow = ' class="narrow"' if len(described["panels"]) == 1 else ""
    of_paper = f"<b>{html.escape(described['of_paper'])} of the paper.</b> " if described["of_paper"] else ""
    return (
        f'<figure{narrow} id="{described["name"]}"><img src="{address}" alt="{html.escape(described["name"])}"><figcaption>{of_paper}'
        f"{rich(described['caption'])} Data: <code>{described['name']}.csv</code></figcaption></figure>"
    )


def _number(value: float | None, decimals: int) -> str:
    """A number with `decimals` decimals, or with -`decimals` digits if negative."""
    if value is None:
        return "&ndash;"
    if decimals >= 0:
        text = f"{round(value, decimals) + 0.0:.{decimals}f}"  # no minus before zero
    else:
        mantissa, _, exponent = f"{value:.{-decimals}g}".partition("e")
        text = mantissa + (f"&middot;10<sup>{int(exponent)}</sup>" if exponent else "")
    return text.replace("-", "&minus;")


def _powers(text: str) -> str:
    return re.sub(r"\^([\d.]+)", r"<sup>\1</sup>", html.escape(text))


def table(described: dict[str, Any]) -> str:
    """A table of numbers, units below the headings; a long one is folded."""
    headings = "".join(
        f'<th>{rich(h["name"])}<span class="unit">{_powers(h["unit"])}</span></th>' for h in described["headings"]
    )
    decimals = [h["decimals"] for h in described["headings"]]
    rows = "".join(
        f"<tr><td>{_powers(row['name'])}</td>"
        + "".join(f"<td>{_number(value, places)}</td>" for value, places in zip(row["values"], decimals))
        + "</tr>"
        for row in described["rows"]
    )
    whole_table = (
        f'<div class="scroll"><table><tr><th>{rich(described["row_header"])}</th>{headings}</tr>{rows}</table></div>'
    )
    if len(described["rows"]) > LONG_TABLE:
        whole_table = f"<details><summary>{len(described['rows'])} rows</summary>{whole_table}</details>"
    return f"<h3>{rich(described['title'])}</h3>{whole_table}"


#: Start of every page.
BEGIN = f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{TITLE}</title>'


def whole(body: str) -> str:
    """The complete document, without external files."""
    return f"{BEGIN}<style>{STYLE_SHEET}</style></head><body><main>{body}</main></body></html>\n"
