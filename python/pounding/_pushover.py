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
    """Pushover analysis of a structure by horizontal floor forces. Parts of the structure must yield.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A model, or the name of its file.
    structure : str
        Name of the structure; optional if only one structure yields.
    to : str or float, optional
        Displacement of the roof: "250 mm", "2 % roof" of the height, or a number [m].
    cyclic : sequence or str
        Displacements that are reached first, in their order.
    load : str, os.PathLike or sequence of float
        "triangular" (masses times heights), "uniform" (masses), "mode1" (masses times the mode with the largest
        effective mass), the name of a file with one force per floor, or these forces from the ground up, to any scale.
    direction : str
        "x", or "y" in space.
    output : str or os.PathLike
        Results file to write.

    Returns
    -------
    Pushover
        The curve.

    Raises
    ------
    InputError
        The structure cannot be pushed.
    SolverError
        The structure collapses; the error has the partial results.

    Examples
    --------
    >>> found = pounding.pushover("examples/20_hinge_frames/model.yaml", "left", to="1 % roof")
    >>> found.status
    'done'
    """
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
