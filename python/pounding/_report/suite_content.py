"""The parts of the report of a suite."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.figure import Figure

from pounding._report import suite_tables
from pounding._report.blocks import Heading, Paragraph, Picture, Report, Table, filled, number, span
from pounding._report.drawings import LETTERS, Box, axes_in
from pounding._report.results_tables import warnings_paragraph
from pounding._report.suite_tables import TABLE, Found
from pounding._report.verdict import NOTABLE, member_clause
from pounding._studies.batches import STATUSES
from pounding._studies.scaling import Scaling
from pounding._studies.suite_data import SuiteData
from pounding._studies.suite_picture import DEFAULT, WITH, draw_panel, height_label, legend_lines
from pounding._studies.suite_report import GRAVITY, numbers, scaling_text

#: Names of failed records.
NAMES = 10
#: Structures with all quantities in the picture, and largest number of structures in it.
WHOLE, DRAWN = 3, 8
#: Heights of a row of panels, of the legend and of the spectra [mm].
PANEL, LEGEND, SPECTRA = 41.0, 6.0, 38.0


def report_of_suite(suite: SuiteData, percent: float = 84.0) -> Report:
    """The report of a suite with one percentile. Raises InputError for the table of a study."""
    _ = suite.layout
    found = numbers(suite, (percent,))
    counts = ", ".join(f"{count} {word}" for word, count in found["status"].items() if count)
    return Report(
        found["title"] or "SuiteData of records",
        found["project"],
        f"SuiteData of {len(suite)} records: {counts}",
        list(_blocks(suite, found, percent)),
        "; ".join(
            [
                f"pounding {found['version']}",
                f"SHA-256 of the input {found['sha256']}",
                f"tolerance {found['tolerance']:.4g}",
                *suite.description.get("options", ()),
            ]
        ),
        "",
    )


def _blocks(suite: SuiteData, found: Found, percent: float) -> Iterator[Heading | Paragraph | Table | Picture]:
    rank = f"{percent:g} %"
    yield Paragraph(verdict(found, rank), emphasis=True)
    yield from _unfinished(found)
    drawn = [name for name in suite.structures if suite.structure(name)["floors"]][:DRAWN]
    if drawn and found["finished"]:
        grid = _grid(suite, drawn)
        yield Picture(
            lambda figure, box: _draw(figure, box, suite, grid, percent),
            f"Largest responses over the height: records thin, mean and {rank} thick"
            + (", with pounding red and without blue." if suite.has_comparison else "."),
            PANEL * len(grid) + LEGEND,
        )
    yield Heading("Records")
    if suite.scaling:
        scaling = suite.scaling
        yield Paragraph(" ".join(f"{line[:1].upper()}{line[1:]}." for line in scaling_text(scaling)))
        yield Picture(
            lambda figure, box: _draw_spectra(figure, box, scaling),
            "Left: spectra of the scaled records thin, their mean thick, the target dashed. Right: mean divided by the target.",
            SPECTRA,
        )
    yield suite_tables.records_table(found)
    if found["finished"]:
        yield Heading("Results")
        yield from filled(
            suite_tables.members_table(found, rank),
            suite_tables.parts_table(found, rank),
            suite_tables.links_table(found, rank),
        )
        yield from suite_tables.floors_tables(found, rank)
        yield Paragraph(
            f"Mean, {rank} and maximum are those of the largest absolute values of the records. "
            f"At least {rank} of the records do not exceed the value of {rank}."
        )
    if suite.links and not suite.has_comparison:
        yield Paragraph("The suite has no run without links; type compare: no_pounding in the model to add it.")
    yield warnings_paragraph({"warnings": found.get("warnings", [])})


def verdict(found: Found, rank: str) -> str:
    """One sentence on the gap, and one on the worst consequence of contact."""
    count, contacts = found["finished"], found["records_with_contact"]
    if not count:
        return "No verdict, because no record finished."
    if not found["links"]:
        return "The model has no links, so nothing can collide."
    sizes = span((one["gap"] for one in found["links"].values()), 1e-3)
    gap, verb = (f"gaps of {sizes} mm", "are") if " to " in sizes else (f"gap of {sizes} mm", "is")
    if "required_gap" not in found:
        force = f"; {rank} of the records have link forces of at most {number(found['force'][rank], 1e3)} kN"
        has_force = contacts and "force" in found
        return f"Contact in {contacts} of {count} records with the {gap}{force if has_force else ''}."
    required = found["required_gap"][rank]
    need = (
        f"{rank} of the records need at most {number(required, 1e-3, 4)} mm"
        if np.isfinite(required)
        else f"no gap is sufficient for {rank} of the records, because structures do not survive without links"
    )
    if not contacts:
        return f"The {gap} {verb} enough in all {count} records; {need}."
    among = f"all {count}" if contacts == count > 1 else f"{contacts} of {count}"
    return f"The {gap} {verb} exceeded in {among} records; {need}.{_worst(found)}"


def _worst(found: Found) -> str:
    """The member and the hinge with the largest ratios of means."""
    clauses = []
    for row in found["worst"]["members"][:1]:
        if np.isfinite(row["with"]["mean"]) and row.get("ratio", 0) > NOTABLE:
            clauses.append(member_clause(row))
    for row in found["worst"]["hinges"][:1]:
        if np.isfinite(row["with"]["mean"]) and row.get("ratio", 0) > NOTABLE:
            clauses.append(
                f"{row['part']} of {row['structure']} has {number(row['ratio'])} times its ductility without contact"
            )
    return f" On average, {'; '.join(clauses)}." if clauses else ""


def _unfinished(found: Found) -> Iterator[Paragraph]:
    """Failed and collapsed records with their reasons."""
    complete = (STATUSES[1], STATUSES[2])
    for title, is_chosen in (
        ("Failed records, which are in no statistics", lambda word: word not in (*complete, "collapsed")),
        ("Collapsed records, which count as infinite values (∞)", lambda word: word == "collapsed"),
    ):
        named = [
            f"{one['name']} ({one['reason']})" if one.get("reason") else f"{one['name']} ({one['status']})"
            for one in found["records"]
            if is_chosen(one["status"])
        ]
        if named:
            more = f"; {len(named) - NAMES} more {TABLE}" if len(named) > NAMES else ""
            yield Paragraph(f"{title}: {'; '.join(named[:NAMES])}{more}.")


def _grid(suite: SuiteData, names: Sequence[str]) -> list[list[tuple[str, str]]]:
    """Rows of panels (structure, quantity): all quantities of few structures, or one of many."""
    known = {name: [each for each in DEFAULT if each in suite.structure(name)["quantities"]] for name in names}
    if len(names) <= WHOLE:
        return [[(name, each) for each in known[name]] for name in names]
    chosen = [(name, "drift_ratio" if "drift_ratio" in known[name] else known[name][0]) for name in names]
    return [chosen[i : i + len(DEFAULT)] for i in range(0, len(chosen), len(DEFAULT))]


def _draw(
    figure: Figure, box: Box, suite: SuiteData, grid: Sequence[Sequence[tuple[str, str]]], percent: float
) -> None:
    """Profiles above their legend."""
    left, bottom, width, height = box
    legend = LEGEND / (PANEL * len(grid) + LEGEND) * height
    step, most = (height - legend) / len(grid), max(map(len, grid))
    for i, panels in enumerate(grid):
        for j, (name, quantity) in enumerate(panels):
            place = (left + j * width / most, bottom + height - (i + 1) * step, width / most, step)
            axes = axes_in(figure, place, (0.42, 0.4, 0.08, 0.22))
            draw_panel(axes, suite, name, quantity, percent, suite.has_comparison)
            axes.xaxis.label.set_fontsize(LETTERS)
            if j == 0:
                axes.set_ylabel(height_label(suite, name), fontsize=LETTERS)
    figure.legend(
        handles=legend_lines(percent, suite.has_comparison),
        loc="lower center",
        bbox_to_anchor=(left + width / 2, bottom),
        ncols=5,
        fontsize=LETTERS,
    )


def _draw_spectra(figure: Figure, box: Box, scaling: Scaling) -> None:
    """Spectra of the scaled records with the target, and the fit of their mean."""
    left, bottom, width, height = box
    panels = [
        axes_in(figure, (left + i * width / 2, bottom, width / 2, height), (0.5, 0.38, 0.12, 0.06)) for i in range(2)
    ]
    for factor, spectrum in zip(scaling.factors, scaling.spectra):
        panels[0].plot(scaling.periods, factor * np.array(spectrum) / GRAVITY, color="0.5", linewidth=0.5, alpha=0.6)
    panels[0].plot(scaling.periods, scaling.mean / GRAVITY, color=WITH, linewidth=1.8)
    panels[0].plot(scaling.periods, np.array(scaling.sa) / GRAVITY, color="black", linestyle=(0, (3, 1.5)))
    panels[1].plot(scaling.periods, scaling.fit, color=WITH, linewidth=1.8)
    panels[1].axhline(1.0, color="black", linestyle=(0, (3, 1.5)))
    if scaling.fraction:
        panels[1].axhline(scaling.fraction, color="0.4", linewidth=0.8)
    for axes, label in zip(panels, ("spectrum [g]", "mean / target")):
        axes.set_xlim(scaling.periods[0], scaling.periods[-1])
        axes.set_ylim(bottom=0)
        axes.set_xlabel("period [s]", fontsize=LETTERS)
        axes.set_ylabel(label, fontsize=LETTERS)
