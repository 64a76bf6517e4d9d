"""`pounding study`, `pounding suite`, `pounding separation` and `pounding screen`."""

from __future__ import annotations

import argparse
import errno
import json
import signal
import sys
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

try:
    import pounding._native  # noqa: F401
except ImportError as error:  # the program without the package, as after `make demo`
    if __name__ != "__main__":
        raise
    print(f"pounding: {error}", file=sys.stderr)
    sys.exit(2)

from pounding._arguments import is_encodable
from pounding._checked_file import STUDY
from pounding._ended import exit_code, show_warning
from pounding._outputs import destination, tell
from pounding._report import require_report
from pounding._studies.options import add_shared, warn
from pounding._studies.progress import duration_text
from pounding._studies.study import records_folder
from pounding._studies.study_commands import READING, study
from pounding._studies.suite import read_suite, run_suite
from pounding._studies.suite_data import PERCENTS
from pounding._studies.suite_report import report, summary
from pounding.errors import ImplausibleWarning, InputError, SolverError

#: Error numbers of disks; others concern names.
_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


class _Terminated(KeyboardInterrupt):
    """Raised for SIGTERM and SIGHUP: the study stops as for Ctrl-C, with the exit code of the signal."""


@contextmanager
def _until_terminated() -> Iterator[None]:
    """Raises _Terminated for SIGTERM and SIGHUP; a second signal ends the process immediately. Ignored signals
    (nohup) stay ignored."""

    def end(number: int, _: object) -> None:
        signal.signal(number, signal.SIG_DFL)
        raise _Terminated

    is_main = threading.current_thread() is threading.main_thread()
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP) if is_main}
    for number, handler in before.items():
        if handler != signal.SIG_IGN:
            signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def main(arguments: list[str] | None = None) -> int:
    """Runs the command line, whose first argument is the name of the command.

    Returns 0, 2 for wrong input, or 3 for failed rows, a full disk and insufficient memory."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    name, rest = (given[0], given[1:]) if given else ("study", [])
    try:
        # The program blocks it during imports.
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        for word in rest:
            if not is_encodable(word):
                raise InputError(f'"{word}" is not valid UTF-8; rename the file, or run in its folder')
        with warnings.catch_warnings(), _until_terminated():
            warnings.simplefilter("always", ImplausibleWarning)
            warnings.showwarning = show_warning
            return {"suite": _suite, "separation": _separation, "screen": _screen}.get(name, study)(rest)
    except BrokenPipeError:
        raise
    except (InputError, ImportError) as error:
        code, said = 2, str(error)
    except SolverError as error:
        code, said = 3, str(error)
    except MemoryError:
        again = "type the same command again to resume, with fewer processes: -j 1"
        code, said = 3, f"out of memory. Finished rows are kept; {again}"
    except OSError as error:
        writes = name == "study" and rest[:1] not in [[verb] for verb in READING]
        on_disk = error.errno in _DISK and writes
        code, said = 3 if on_disk else 2, str(error)
        if on_disk:
            said += ". Finished rows are kept; make room and type the same command again to resume"
    except _Terminated:
        code, said = 3, "stopped by a signal; finished rows are kept. Type the same command again to resume"
    except KeyboardInterrupt:
        code, said = 3, "stopped; finished rows are kept. Type the same command again to resume"
    print(f"pounding: {said}", file=sys.stderr)
    return code


def _suite(words: list[str]) -> int:
    """Returns 3 if a record failed."""
    parser = argparse.ArgumentParser(
        prog="pounding suite",
        description="Run a model under each of its records, in parallel processes, and print mean, percentiles and maximum of every "
        "floor, member, hinge and link. The same command resumes a stopped suite.",
    )
    parser.add_argument("model", help="model file with records:")
    parser.add_argument("-o", "--output", help="table to write (default: MODEL-suite.h5 in the current folder)")
    add_shared(parser, "--workers", "--percentile", "--json", "--quiet")
    parser.add_argument(
        "--plot", nargs="?", const="", metavar="FILE", help="also draw profiles (default: the table's name with .png)"
    )
    parser.add_argument("--report", metavar="FILE", help="also write a report: .pdf or .html")
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


def _separation(words: list[str]) -> int:
    from pounding._studies.separation import percentage, read_separation, run_separation
    from pounding._studies.separation_table import table_of

    parser = argparse.ArgumentParser(
        prog="pounding separation", description="Compute the gap required by records and by the rules of codes."
    )
    parser.add_argument("model", help="model file, with or without study: {records: ..., separation: ...}")
    parser.add_argument("--records", nargs="+", help="files of records, or a folder, instead of the model's motion")
    parser.add_argument("--code", action="append", help="only this code, such as EN; may be repeated")
    parser.add_argument(
        "--property", choices=("same", "line"), help="line: a property line between the structures (default: same)"
    )
    parser.add_argument(
        "--displacements",
        choices=("nonlinear", "elastic", "reduced"),
        help="reduced: from motions divided by a behaviour factor, which the codes multiply back",
    )
    parser.add_argument("--floors", choices=("aligned", "offset"), help="floors of neighbours without elevations")
    parser.add_argument("--similar", action="store_true", default=None, help="neighbours of similar structure")
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="input of the codes, such as q=3, or left.R=8 for one structure; may be repeated",
    )
    parser.add_argument("--quantile", action="append", default=[], help='gap for a fraction of the records: "95 %%"')
    parser.add_argument(
        "--probability", action="append", default=[], help='gap for a target probability of contact: "10 %%"'
    )
    parser.add_argument("--levels", action="store_true", help="also print the gaps of the codes at every level")
    add_shared(parser, "--workers", "--json")
    options = parser.parse_args(words)
    keys = {"codes": options.code, **_inputs_of_codes(options.set)}
    keys |= {key: getattr(options, key) for key in ("property", "displacements", "floors", "similar")}
    plan, request = read_separation(
        options.model,
        options.records,
        {key: value for key, value in keys.items() if value is not None},
        [percentage("--quantile", one) for one in options.quantile],
        [percentage("--probability", one) for one in options.probability],
    )
    warn(plan)
    found = run_separation(plan, request, options.workers)
    print(json.dumps(found) if options.json else table_of(found, options.levels))
    return 0


def _inputs_of_codes(words: list[str]) -> dict[str, Any]:
    """Keys `behaviour` and `structures` from options such as q=3 and left.R=8."""
    found: dict[str, Any] = {}
    for word in words:
        name, equals, value = word.partition("=")
        structure, _, key = name.rpartition(".")
        if not equals or not key or not value:
            raise InputError(f'--set takes KEY=VALUE, such as q=3 or left.R=8; "{word}" was read')
        place = found.setdefault("structures", {}).setdefault(structure, {}) if structure else None
        (found.setdefault("behaviour", {}) if place is None else place)[key] = value
    return found


def _screen(words: list[str]) -> int:
    from pounding._codes.screening import SEISMICITIES
    from pounding._screening import screen, table_of

    parser = argparse.ArgumentParser(
        prog="pounding screen", description="Screen the gaps of a model by rules for existing buildings, without a run."
    )
    parser.add_argument("model", help="model file")
    parser.add_argument("--seismicity", choices=SEISMICITIES, default="high", help="of the site (default: high)")
    add_shared(parser, "--json")
    options = parser.parse_args(words)
    found = screen(options.model, options.seismicity)
    print(json.dumps(found) if options.json else table_of(found))
    return 0


if __name__ == "__main__":
    code = exit_code(main)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the study has ended
    sys.exit(code)
