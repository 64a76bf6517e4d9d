"""The parts of a report, from the results of a run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from pounding._pictures.worst import ranked
from pounding._report import assumptions, results_tables
from pounding._report.blocks import Heading, Paragraph, Picture, Report, Table, filled
from pounding._report.drawings import has_drifts, model_drawing, motion_drawing, worst_drawing
from pounding._report.verdict import verdict
from pounding._spectra import Spectrum
from pounding.results import RunData


def report_of(run: RunData, spectra: Sequence[Spectrum] = ()) -> Report:
    """The report of a run with the spectra of its ground motion, one per direction, named x, y and z."""
    model = run.summary.get("model", {})
    status = run.status.partition(":")[0]  # the verdict has the reason
    tolerance = run.summary.get("solver", {}).get("tolerance")
    return Report(
        run.title or "Structural pounding",
        model.get("project", ""),
        f"Run of {run.created.replace('T', ' ').replace('Z', ' UTC')}; status: {status}" if run.created else status,
        list(_blocks(run, spectra)),
        "; ".join(
            [
                f"pounding {run.version}".strip(),
                f"SHA-256 of the input {model.get('sha256', 'not known')}",
                f"tolerance {tolerance:.4g}" if tolerance else "tolerance not known",
                f"run {run.created}" if run.created else "",
            ]
        ).rstrip("; "),
        run.created,
    )


def _blocks(run: RunData, spectra: Sequence[Spectrum]) -> Iterator[Heading | Paragraph | Table | Picture]:
    summary = run.summary
    model = summary.get("model", {})
    yield Paragraph(verdict({**summary, "status": run.status}), emphasis=True)
    if run.structures:
        yield Picture(lambda figure, box: model_drawing(figure, box, run), _caption(run), 62)
    yield Heading("Assumptions")
    yield from filled(
        assumptions.structures_table(model), assumptions.contacts_table(model), assumptions.devices_table(model)
    )
    yield assumptions.analysis(summary)
    if any(np.any(values) for values in (run.ground_acceleration, *run.ground_across.values())):
        yield Heading("Ground motion")
        yield from filled(assumptions.motions_table(model))
        yield Picture(
            lambda figure, box: motion_drawing(figure, box, run, spectra),
            "Ground acceleration over time" + (", and its response spectrum with 5 % damping." if spectra else "."),
            38,
        )
    else:
        yield Paragraph("Ground motion: none for the whole model.")
    if not summary.get("structures"):
        yield results_tables.warnings_paragraph(summary)
        return
    yield Heading("Results")
    if ranked(summary):
        yield Picture(
            lambda figure, box: worst_drawing(figure, box, summary),
            "Members and yielding parts with the largest increases by contact: with links in colour, without links grey.",
            36,
        )
    yield from filled(
        results_tables.floors_table(summary),
        *results_tables.members_tables(summary),
        *results_tables.parts_tables(summary),
        results_tables.links_table(summary),
        results_tables.impacts_table(summary),
        results_tables.energy_table(summary),
    )
    if run.links and run.no_pounding is None:
        yield Paragraph("The run has no comparison without links; type compare: no_pounding in the model to add it.")
    yield results_tables.warnings_paragraph(summary)


def _caption(run: RunData) -> str:
    """Description of the drawing of the model."""
    springs = [one.springs for one in run.structures.values() if one.springs is not None]
    kinds = {
        "diamonds": ("links", bool(run.links)),
        "triangles": ("supports", any(one.reactions is not None for one in run.structures.values())),
        "circles": ("hinges", any(one.is_hinge(i) for one in springs for i in range(len(one)))),
        "squares": ("isolators", any(one.isolates(i) for one in springs for i in range(len(one)))),
        "dashed lines": ("devices", bool(run.devices)),
    }
    marks = ", ".join(f"{mark} are {kind}" for mark, (kind, exists) in kinds.items() if exists)
    text = "Model at rest" + (f": {marks}." if marks else ".")
    if has_drifts(run):
        text += " Right: extremes of the storey drift" + (
            ", dashed without links." if run.no_pounding is not None else "."
        )
    return text
