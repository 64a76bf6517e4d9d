"""`python3 -m pounding._report RESULTS.h5 -o REPORT.pdf`, also for the table of a suite."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from pounding._checked_file import STUDY
from pounding._ended import exit_code
from pounding._outputs import START, read_object, tell
from pounding._report import write_report, write_suite_report
from pounding._spectra import read_spectra
from pounding.results import RunData


def main(arguments: list[str] | None = None) -> int:
    """Command line: writes the report. Raises InputError, OSError."""
    parser = argparse.ArgumentParser(
        prog="python3 -m pounding._report", description="Write the report of a run or a suite."
    )
    parser.add_argument("results", help="file that `pounding run` or `pounding suite` wrote")
    parser.add_argument("-o", "--output", required=True, help="report to write: .pdf or .html")
    parser.add_argument("--spectra", help="file with the spectra of the ground motion as a JSON object")
    options = parser.parse_args(arguments)
    if _is_table(options.results):
        from pounding._studies.suite_data import SuiteData

        write_suite_report(SuiteData.open(options.results), options.output)
        tell("report", options.output)
        return 0
    spectra = read_spectra(read_object(options.spectra))[1] if options.spectra else []
    write_report(RunData.read(options.results), options.output, spectra=spectra)
    return 0


def _is_table(name: str) -> bool:
    """True for the table of a suite or a study."""
    path = Path(name)
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return STUDY.recognises(path, file.read(START))


if __name__ == "__main__":
    sys.exit(exit_code(main))
