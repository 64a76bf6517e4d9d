"""The page and the figures of `pounding reproduce`: `python3 -m pounding._reproduce REPORT.json -o REPORT.html`.

Draws every figure of the JSON object that the program writes, as NAME.png next to the page and embedded in it, and
sets equations, tables and verdicts. The object: {"items": [{name, title, sections, seconds, paragraphs, equations,
matrices, figures, tables, verdicts}]}, see lib/reproduce/report.hpp."""

import argparse
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.transforms import ScaledTranslation

from pounding._ended import exit_code
from pounding._outputs import Kind, read_object, replaced
from pounding._paper import page
from pounding._paper.mathematics import data_uri, svg_of
from pounding._pictures.style import BLUE, GREEN, ORANGE, PURPLE, SKY, STYLE, VERMILION, DrawnOnce

COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, "0.45", "#8C6D31", "0.7")
#: The report may replace an earlier one.
PAGE = Kind("report of a reproduction", lambda _, start: start.startswith(page.BEGIN.encode()))
#: The reference curve of a comparison is black in every figure.
REFERENCE = "0.1"
DRAWN: dict[str, dict[str, Any]] = {
    "line": {},
    "thin": {"linewidth": 0.7},
    "dashed": {"linestyle": (0, (4, 2)), "linewidth": 1.2, "color": REFERENCE},
    "points": {"linestyle": "none", "marker": "o", "markersize": 3.5},
}
MATH: dict[Any, Any] = {
    "text.parse_math": True,
    "mathtext.fontset": "dejavusans",
    "svg.fonttype": "path",
    "svg.hashsalt": "pounding",
}


def draw(figure: dict[str, Any]) -> Figure:
    """One figure of the report, with panels side by side and legends below. A label has the same colour in all
    panels."""
    columns = {column["name"]: np.array(column["values"], float) for column in figure["columns"]}
    panels = figure["panels"]
    labels = list(
        dict.fromkeys(
            curve["label"]
            for panel in panels
            for curve in panel["curves"]
            if curve["kind"] != "dashed" and curve["label"] != "exact"
        )
    )
    colours = {label: COLOURS[number % len(COLOURS)] for number, label in enumerate(labels)} | {"exact": REFERENCE}
    if not _share_labels(panels):
        colours |= {
            curve["label"]: COLOURS[number % len(COLOURS)]
            for panel in panels
            for number, curve in enumerate(panel["curves"])
        }
    with rc_context(STYLE | MATH):
        drawn = DrawnOnce(figsize=(7.6 if len(panels) > 1 else 5.4, 3.5), layout="constrained")
        for axes, panel in zip(drawn.subplots(1, len(panels), squeeze=False)[0], panels):
            for curve in panel["curves"]:
                axes.plot(
                    columns[curve["x"]],
                    columns[curve["y"]],
                    **{"label": _powers(curve["label"]), "color": colours.get(curve["label"])} | DRAWN[curve["kind"]],
                )
            axes.set(title=_powers(panel["title"]), xlabel=_powers(panel["x_label"]), ylabel=_powers(panel["y_label"]))
            axes.set(xscale="log" if panel["x_log"] else "linear", yscale="log" if panel["y_log"] else "linear")
        _add_legends(drawn, panels)
        return drawn


def _powers(text: str) -> str:
    """Exponents raised: "m^1.5"."""
    return re.sub(r"\^([\d.]+)", r"$^{\1}$", text)


def _share_labels(panels: list[dict[str, Any]]) -> bool:
    labels = [{curve["label"] for curve in panel["curves"]} for panel in panels]
    return len(panels) > 1 and bool(set.intersection(*labels))


def _add_legends(figure: Figure, panels: list[dict[str, Any]]) -> None:
    """One legend for all panels if they share curves, else one per panel."""
    if _share_labels(panels):
        lines: dict[str, Any] = {}
        for axes in figure.axes:
            handles: tuple[list[Any], list[str]] = axes.get_legend_handles_labels()
            for line, label in zip(*handles):
                # If a line and points share a label, the legend shows the line.
                if label not in lines or line.get_linestyle() != "None":
                    lines[label] = line
        longest = max(map(len, lines))
        figure.legend(
            lines.values(), lines, loc="outside lower center", ncols=min(len(lines), 4 if longest < 26 else 3)
        )
        return
    below_label = ScaledTranslation(0, -0.45, figure.dpi_scale_trans)
    for axes, panel in zip(figure.axes, panels):
        columns = 1 if len(panels) > 2 or len(panel["curves"]) <= 3 else 2
        axes.legend(
            loc="upper center", bbox_to_anchor=(0.5, 0), bbox_transform=axes.transAxes + below_label, ncols=columns
        )


def build(report: dict[str, Any], directory: Path) -> str:
    """The page as text; writes its pictures into the same folder."""
    parts = [page.contents(report["items"])]
    for item in report["items"]:
        parts.append(page.item_head(item))
        for figure in item["figures"]:
            drawn = draw(figure)
            with rc_context(STYLE | MATH):
                drawn.savefig(directory / f"{figure['name']}.png", dpi=120)
                parts.append(page.figure(figure, data_uri(svg_of(drawn))))
        parts += [page.table(table) for table in item["tables"]]
        parts.append("</section>")
    return page.whole("".join(parts))


def main(arguments: list[str] | None = None) -> int:
    """Command line: writes the page. Raises InputError, OSError."""
    parser = argparse.ArgumentParser(
        prog="python3 -m pounding._reproduce", description="Set the report of a reproduction."
    )
    parser.add_argument("report", help="report.json that `pounding reproduce` wrote")
    parser.add_argument("-o", "--output", required=True, help="page to write; figures are written to the same folder")
    options = parser.parse_args(arguments)
    report, output = read_object(options.report), Path(options.output)
    with replaced(output, PAGE) as temporary:
        temporary.write_text(build(report, output.parent), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(exit_code(main))
