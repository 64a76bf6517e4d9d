"""`python3 -m pounding._report RESULTS.h5 -o REPORT.pdf`, also for the table of a suite."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from pounding._checked_file import STUDY, NotResults
from pounding._ended import exit_code
from pounding._outputs import START, cannot_read, tell
from pounding._report import write_report, write_suite_report
from pounding._spectra import read_spectra
from pounding.errors import InputError
from pounding.results import RunData


def main(arguments: list[str] | None = None) -> int:
    """Command line. Returns 0, or 2 after a message if the results cannot be read or the report cannot be written."""
    parser = argparse.ArgumentParser(
        prog="python3 -m pounding._report", description="Write the report of a run or a suite."
    )
    parser.add_argument("results", help="file that `pounding run` or `pounding suite` wrote")
    parser.add_argument("-o", "--output", required=True, help="report to write: .pdf or .html")
    parser.add_argument("--spectra", help="file with the spectra of the ground motion as a JSON object")
    options = parser.parse_args(arguments)
    try:
        if _is_table(options.results):
            from pounding._studies.suite import Suite

            write_suite_report(Suite.open(options.results), options.output)
            tell("report", options.output)
            return 0
        spectra = []
        if options.spectra:
            with open(options.spectra, encoding="utf-8") as file:
                spectra = read_spectra(json.load(file))[1]
        run = RunData.read(options.results)
        write_report(run, options.output, spectra=spectra)
    except NotResults as error:
        print(cannot_read(options.results, error), file=sys.stderr)
        return 2
    except (InputError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
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
