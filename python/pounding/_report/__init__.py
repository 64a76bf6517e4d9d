"""Reports of runs and suites: A4 pages as PDF, or one HTML file.

`content` and `suite_content` make the parts of a report, `pdf_pages` and `html_page` write them."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING

from pounding import _arguments as arguments
from pounding._arguments import takes
from pounding._outputs import Kind, destination, replaced
from pounding._spectra import Spectrum
from pounding.errors import InputError, excerpt
from pounding.results import RunData

if TYPE_CHECKING:
    from pounding._report.blocks import Report
    from pounding._studies.suite_data import SuiteData

File = str | PathLike[str]

#: Reports that may replace each other.
REPORT = Kind("report", lambda _, start: start.startswith((b"%PDF-", b"<!DOCTYPE html>")))


@takes(path=arguments.file)
def write_report(run: RunData, path: File, *, spectra: Sequence[Spectrum] = ()) -> None:
    """Writes the report of a run, .pdf or .html. `spectra` are those of the ground motion, named x, y and z.

    The same results give the same bytes. Raises InputError for another suffix and for a file that is not a report,
    OSError, ImportError without matplotlib."""
    require_report(path)
    from pounding._report.content import report_of

    _write(report_of(run, spectra), path)


@takes(path=arguments.file, percent=arguments.number(0, 100))
def write_suite_report(suite: SuiteData, path: File, *, percent: float = 84.0) -> None:
    """Writes the report of a suite, .pdf or .html, with this percentile. Raises the same errors as `write_report`, and
    InputError for the table of a study."""
    require_report(path)
    from pounding._report.suite_content import report_of_suite

    _write(report_of_suite(suite, percent), path)


def require_report(path: File) -> None:
    """Raises InputError unless a report can be written to `path`: for another suffix, and for a file that is not a
    report."""
    if Path(path).suffix not in (".pdf", ".html"):
        raise InputError(
            f"{excerpt(fspath(path))} is not the name of a report; type a name that ends in .pdf or .html, such as report.pdf"
        )
    destination(path, REPORT)


def _write(report: Report, path: File) -> None:
    with replaced(path, REPORT) as temporary:
        if Path(path).suffix == ".html":
            from pounding._report.html_page import html_page

            temporary.write_text(html_page(report), encoding="utf-8")
        else:
            from pounding._pictures.style import one_warning_for_missing_letters
            from pounding._report.pdf_pages import write_pdf

            with one_warning_for_missing_letters():
                write_pdf(report, temporary)
