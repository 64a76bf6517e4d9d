"""Pictures of a run or a pushover: `python3 -m pounding._plots RESULTS.h5 [-o OUT.png] [--title TEXT]`.

`--picture` selects the picture of a run, by default its histories and impacts. A pushover has one picture, its
curve."""

from __future__ import annotations

import argparse
import sys

from matplotlib.figure import Figure

from pounding._checked_file import HoldsPushover
from pounding._ended import exit_code
from pounding._outputs import output_for
from pounding._pictures.figures import PANELS, WHOLE, figure
from pounding._pictures.style import BadRequest, write_picture
from pounding._pushover_curve import read_pushover
from pounding.results import RunData


def _pushover(options: argparse.Namespace) -> Figure:
    """The curve in a results file of a pushover."""
    if options.picture != "run" or options.compare or options.floors:
        raise BadRequest("this file is a pushover, which has one picture; remove --picture, --compare and --floors")
    return read_pushover(options.results).plot(options.title)


def _floor_choice(text: str) -> dict[str, str]:
    """{structure: label} of "A.3,B.2"; argparse reports other formats."""
    pairs = [part.strip().partition(".") for part in text.split(",")]
    if not all(name and label for name, _, label in pairs):
        raise argparse.ArgumentTypeError(f'"{text}" should name structures and floors, as in A.3,B.2')
    return {name: label for name, _, label in pairs}


def main(arguments: list[str] | None = None) -> int:
    """Command line: writes the picture. Raises InputError, OSError."""
    parser = argparse.ArgumentParser(prog="python3 -m pounding._plots", description="Draw the results of a run.")
    parser.add_argument("results", help="file that `pounding run` or `pounding pushover` wrote")
    parser.add_argument(
        "-o",
        "--output",
        help="picture to write: .png, .pdf or .svg (default: RESULTS.png in the current "
        "folder; of the other pictures RESULTS-model.png ...)",
    )
    parser.add_argument("--title", help="title instead of that of the run")
    parser.add_argument(
        "--picture",
        choices=(*WHOLE, *PANELS),
        default="run",
        help="run (histories and impacts), model (the structures at rest), profiles (extremes over the height), plan (a "
        "map of drifts and impacts), loops (of the six parts with the largest energy losses, or of contacts), hinges (a map of "
        "yielded parts), worst (members and yielding parts with the largest increases by contact), or one panel",
    )
    parser.add_argument(
        "--floors", type=_floor_choice, help="of whose displacements the standard picture shows: A.3,B.2"
    )
    parser.add_argument("--compare", action="store_true", help="also draw the run without links, dashed")
    options = parser.parse_args(arguments)
    if options.floors and options.picture != "run":
        raise BadRequest(f"--floors belongs to --picture run; --picture {options.picture} shows every floor")
    try:
        run = RunData.read(options.results)
    except HoldsPushover:
        return write_picture(_pushover(options), output_for(options.results, options.output, ".png"))
    picture = figure(run, options.picture, options.title, compare=options.compare or None, floors=options.floors)
    ending = ".png" if options.picture == "run" else f"-{options.picture}.png"
    return write_picture(picture, output_for(options.results, options.output, ending))


if __name__ == "__main__":
    sys.exit(exit_code(main))
