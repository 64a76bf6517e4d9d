"""Pushovers of the structures of a model."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path

from pounding import _arguments as arguments
from pounding._arguments import optional, quantity, takes, text
from pounding._native import core
from pounding._pushover_curve import Pushover
from pounding.errors import InputError, SolverError
from pounding.models import Model, as_model


@takes(structure=text, to=optional(quantity), direction=text, output=arguments.file)
def pushover(
    model: Model | str | PathLike[str],
    structure: str = "",
    *,
    to: str | float | None = None,
    cyclic: Sequence[str | float] | str = (),
    load: str | PathLike[str] | Sequence[float] = "triangular",
    direction: str = "x",
    output: str | PathLike[str] = "",
) -> Pushover:
    """Pushover analysis of a structure of a model or an input file, by horizontal floor forces until the roof
    displacement is `to`.

    `to` is "250 mm", "2 % roof" of the height, or a number [m]. Parts of the structure must yield. `structure` is
    optional if only one structure of the model yields. Displacements in `cyclic` are reached first, in their order.

    `load` is "triangular" (masses times heights), "uniform" (masses), "mode1" (masses times the mode with the largest
    effective mass), the name of a file with one force per floor, or these forces from the ground up, to any scale.
    `direction` is x, or y in space. `output` is a results file to write.

    Raises InputError for a structure that cannot be pushed, and SolverError, with partial results, for a collapse."""
    model = as_model(model)
    steps = (
        arguments.text("cyclic", cyclic)
        if isinstance(cyclic, str)
        else ", ".join(map(_length, arguments.listed(quantity)("cyclic", cyclic)))
    )
    words = (direction, "" if to is None else _length(to), steps, fspath(output))
    if isinstance(load, (str, PathLike)):
        pushed = core.pushover(model._source(), structure, fspath(arguments.file("load", load)), *words)
    else:
        with tempfile.TemporaryDirectory() as folder:
            forces = Path(folder) / "load"
            forces.write_text(
                "\n".join(
                    map(repr, arguments.listed(arguments.number(), "a name, a file or a list of forces")("load", load))
                )
            )
            try:
                pushed = core.pushover(model._source(), structure, str(forces), *words)
            except InputError as error:
                raise InputError(str(error).replace(f"{forces} holds", "the list holds")) from None
    found = Pushover.from_json(json.loads(pushed))
    if found.status != "done":
        raise SolverError(
            f"{found.structure} collapses: {found.status.removeprefix('collapse: ')}; push it less far", found
        )
    return found


def _length(value: str | float) -> str:
    return value if isinstance(value, str) else f"{float(value)!r} m"
