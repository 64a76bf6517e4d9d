"""`pounding view RESULTS.h5 [-o view.html]` and `pounding view MODEL.yaml` call `python3 -m pounding._view_command`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from pounding._arguments import whole
from pounding._ended import exit_code
from pounding._outputs import output_for, tell
from pounding._pictures.style import BadRequest
from pounding._runs import Run
from pounding.models import Model
from pounding.view import View, check_output


def main(arguments: list[str] | None = None) -> int:
    """Command line: writes the view. Raises InputError, OSError, ImportError without plotly."""
    parser = argparse.ArgumentParser(
        prog="pounding view", description="Interactive view of a run or a model: one HTML file."
    )
    parser.add_argument("file", help="results file that `pounding run` wrote, or input file")
    parser.add_argument("-o", "--output", help="file to write: .html (default: FILE.html in the current folder)")
    parser.add_argument("--modes", type=int, default=0, help="number of mode shapes per structure")
    parser.add_argument("--frames", type=int, help="number of instants of the film")
    parser.add_argument("--scale", type=float, help="scale factor of displacements and gaps")
    parser.add_argument("--title", help="title instead of that of the run")
    options = parser.parse_args(arguments)
    output = output_for(options.file, options.output, ".html")
    check_output(output)
    _view(options).save(output)
    tell("view", output)
    return 0


def _view(options: argparse.Namespace) -> View:
    count = whole(0, 1000)("--modes", options.modes)
    if Path(options.file).suffix == ".h5":
        run = Run.read(options.file)
        return run.view(modes=count, frames=options.frames, scale=options.scale, title=options.title)
    if options.frames is not None:
        raise BadRequest("--frames belongs to the film of a run; this is a model. Remove --frames, or name results")
    return Model.from_file(options.file).view(modes=count, scale=options.scale, title=options.title)


if __name__ == "__main__":
    sys.exit(exit_code(main))
