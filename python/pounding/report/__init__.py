"""Reports of runs: two A4 pages as PDF, or one HTML file.

`content` makes the parts of a report from the results, `pdf_pages` and `html_page` write them."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path

from pounding import arguments
from pounding.arguments import takes
from pounding.errors import InputError, excerpt
from pounding.outputs import Kind, replaced
from pounding.results import RunData
from pounding.spectra import Spectrum

#: Reports that may replace each other.
REPORT = Kind("report", lambda _, start: start.startswith((b"%PDF-", b"<!DOCTYPE html>")))


@takes(path=arguments.file)
def write_report(run: RunData, path: str | PathLike[str], *, spectra: Sequence[Spectrum] = ()) -> None:
    """Writes the report of a run, .pdf or .html. `spectra` are those of the ground motion, named x, y and z.

    The same results give the same bytes. Raises InputError for another suffix and for a file that is not a report,
    OSError, ImportError without matplotlib."""
    suffix = Path(path).suffix
    if suffix not in (".pdf", ".html"):
        raise InputError(
            f"{excerpt(fspath(path))} is not the name of a report; type a name that ends in .pdf or .html, such as report.pdf"
        )
    from pounding.report.content import report_of

    report = report_of(run, spectra)
    with replaced(path, REPORT) as temporary:
        if suffix == ".html":
            from pounding.report.html_page import html_page

            temporary.write_text(html_page(report), encoding="utf-8")
        else:
            from pounding.report.pdf_pages import write_pdf

            write_pdf(report, temporary)
