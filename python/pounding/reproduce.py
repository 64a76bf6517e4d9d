"""The page and the figures of `pounding reproduce`: `python3 -m pounding.reproduce REPORT.json -o REPORT.html`.

Draws every figure of the JSON object that the program writes, as NAME.png beside the page and inside it, and sets equations,
tables and verdicts. The object: {"items": [{name, title, sections, seconds, paragraphs, equations, matrices, figures, tables,
verdicts}]}, as lib/reproduce/report.hpp describes them.
"""

import argparse
import html
import json
import sys
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from pounding import page
from pounding.mathematics import data_uri, rich, svg_of
from pounding.style import BLUE, GREEN, ORANGE, PURPLE, SKY, STYLE, VERMILION

#: Black comes last but one: most figures have no more than six curves.
COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, "0.25", "#8C6D31", "0.6")
DRAWN = {"line": {}, "thin": {"linewidth": 0.7}, "dashed": {"linestyle": (0, (4, 2)), "linewidth": 1.2},
         "points": {"linestyle": "none", "marker": "o", "markersize": 3.5}}
MATH = {"text.parse_math": True, "mathtext.fontset": "dejavusans", "svg.fonttype": "path", "svg.hashsalt": "pounding"}


def draw(figure) -> Figure:
    """One figure of the report, its panels side by side, the legends below them."""
    columns = {column["name"]: np.array(column["values"], float) for column in figure["columns"]}
    panels = figure["panels"]
    with rc_context(STYLE | MATH):
        drawn = Figure(figsize=(7.6 if len(panels) > 1 else 5.4, 3.5 if len(panels) < 3 else 3.2), layout="constrained")
        for axes, panel in zip(drawn.subplots(1, len(panels), squeeze=False)[0], panels):
            _draw_panel(axes, panel, columns)
        _add_legends(drawn, panels)
        return drawn


def _draw_panel(axes, panel, columns):
    for number, curve in enumerate(panel["curves"]):
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(columns[curve["x"]], columns[curve["y"]], label=curve["label"], color=colour, **DRAWN[curve["kind"]])
    axes.set(title=panel["title"], xlabel=panel["x_label"], ylabel=panel["y_label"])
    if panel["x_log"]:
        axes.set_xscale("log")
    if panel["y_log"]:
        axes.set_yscale("log")


def _add_legends(figure, panels):
    """One legend for all panels when they show the same curves, else one each."""
    labels = [[curve["label"] for curve in panel["curves"]] for panel in panels]
    longest = max(labels, key=len)
    if len(panels) > 1 and all(set(some) <= set(longest) for some in labels) and _same_colours(labels, longest):
        handles = figure.axes[labels.index(longest)].get_legend_handles_labels()
        figure.legend(*handles, loc="outside lower center", ncols=min(4, len(longest)))
        return
    for axes, some in zip(figure.axes, labels):
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=1 if len(panels) > 2 else 2 if len(some) > 3 else 1)


def _same_colours(labels, longest):
    return all(longest.index(label) == number for some in labels for number, label in enumerate(some))


def build(report, directory):
    """The page as text; writes the pictures beside it."""
    parts = [page.contents(report["items"])]
    for item in report["items"]:
        parts.append(page.item_head(item))
        for figure in item["figures"]:
            drawn = draw(figure)
            with rc_context(STYLE | MATH):
                drawn.savefig(directory / f"{figure['name']}.png", dpi=150)
                parts.append(page.figure(figure, data_uri(svg_of(drawn))))
        parts += [page.table(table) for table in item["tables"]]
        parts.append("</section>")
    return page.whole("".join(parts))


def main(arguments=None):
    """Command line. Returns 0, or 2 after a message when the data cannot be read or the page not written."""
    parser = argparse.ArgumentParser(prog="python3 -m pounding.reproduce", description="Set the report of a reproduction.")
    parser.add_argument("report", help="report.json that `pounding reproduce` wrote")
    parser.add_argument("-o", "--output", required=True, help="page to write; the figures are written beside it")
    options = parser.parse_args(arguments)
    try:
        report = json.loads(Path(options.report).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        print(f"cannot read {options.report}: {error}", file=sys.stderr)
        return 2
    output = Path(options.output)
    try:
        output.write_text(build(report, output.parent), encoding="utf-8")
    except OSError as error:
        print(f"cannot write {options.output}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
