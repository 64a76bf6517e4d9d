"""`python3 -m pounding.report RESULTS.h5 -o REPORT.pdf`."""

from __future__ import annotations

import argparse
import json
import sys

from pounding.checked_file import NotResults
from pounding.ended import exit_code
from pounding.errors import InputError
from pounding.outputs import cannot_read
from pounding.report import write_report
from pounding.results import RunData
from pounding.spectra import read_spectra


def main(arguments: list[str] | None = None) -> int:
    """Command line. Returns 0, or 2 after a message if the results cannot be read or the report cannot be written."""
    parser = argparse.ArgumentParser(prog="python3 -m pounding.report", description="Write the report of a run.")
    parser.add_argument("results", help="file that `pounding run` wrote")
    parser.add_argument("-o", "--output", required=True, help="report to write: .pdf or .html")
    parser.add_argument("--spectra", help="file with the spectra of the ground motion as a JSON object")
    options = parser.parse_args(arguments)
    try:
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


if __name__ == "__main__":
    sys.exit(exit_code(main))
