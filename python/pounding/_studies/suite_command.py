"""`pounding suite`."""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

from pounding._checked_file import STUDY
from pounding._outputs import destination, tell
from pounding._report import require_report
from pounding._studies.options import add_percentile, at_least, warn
from pounding._studies.progress import duration_text
from pounding._studies.study import records_folder
from pounding._studies.suite import read_suite, run_suite
from pounding._studies.suite_data import PERCENTS
from pounding._studies.suite_report import report, summary


def suite(words: list[str]) -> int:
    """Runs the command. Returns 0, or 3 if a record failed. Raises InputError, SolverError, OSError."""
    parser = argparse.ArgumentParser(
        prog="pounding suite",
        description="Run a model under each of its records, in parallel processes, and print mean, percentiles and maximum of every "
        "floor, member, hinge and link. The same command resumes a stopped suite.",
    )
    parser.add_argument("model", help="model file with records:")
    parser.add_argument("-o", "--output", help="table to write (default: MODEL-suite.h5 in the current folder)")
    parser.add_argument(
        "-j", "--workers", type=at_least(0), help="processes (default: one per core); 0 runs in this one"
    )
    add_percentile(parser, "16, 50 and 84")
    parser.add_argument("--json", action="store_true", help="print one JSON object with all numbers in SI")
    parser.add_argument(
        "--plot", nargs="?", const="", metavar="FILE", help="also draw profiles (default: the table's name with .png)"
    )
    parser.add_argument("--report", metavar="FILE", help="also write a report: .pdf or .html")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing")
    options = parser.parse_args(words)
    output = Path(options.output or f"{Path(options.model).stem}-suite.h5")
    destination(output, STUDY)
    if options.report is not None:
        require_report(options.report)
    plan = read_suite(options.model, records_folder(output))
    warn(plan)
    begin = time.monotonic()
    done = run_suite(plan, output, options.workers, None, False if options.quiet else None)
    percent = tuple(options.percentile or PERCENTS)
    if options.json:
        print(json.dumps(summary(done, percent)))
    elif not options.quiet:
        print(report(done, percent))
        print(f"\n{duration_text(time.monotonic() - begin)}; {output}")
    sys.stdout.flush()
    code = 3 if done.failed else 0
    shown = max(percent) if options.percentile else 84.0
    if options.report is not None:
        done.report(options.report, percent=shown)
        if not (options.json or options.quiet):
            tell("report", options.report)
    if options.plot is not None:
        from pounding._pictures.style import write_picture

        figure = done.profiles(percent=shown)
        code = write_picture(figure, options.plot or output.with_suffix(".png")) or code
    return code
