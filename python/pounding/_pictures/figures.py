"""Pictures of a run by name, returned as figures."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

from matplotlib.figure import Figure

from pounding._pictures import style
from pounding._pictures.comparison import OVER_TIME, WITHOUT_LINKS, require_comparison
from pounding._pictures.displacements import directions_of, turning
from pounding._pictures.hinge_map import hinges_figure
from pounding._pictures.loops import draw_loops
from pounding._pictures.model_picture import model_figure
from pounding._pictures.panels import gather_legends, label_time
from pounding._pictures.plan_map import plan_figure
from pounding._pictures.profiles import profiles_figure
from pounding._pictures.run_picture import standard_figure
from pounding._pictures.spring_loops import loops_figure, most_energy
from pounding._pictures.style import NARROW, BadRequest
from pounding._pictures.worst import worst_figure
from pounding.results import RunData

WHOLE: dict[str, Callable[..., Figure]] = {
    "run": standard_figure,
    "model": model_figure,
    "profiles": profiles_figure,
    "plan": plan_figure,
    "loops": loops_figure,
    "hinges": hinges_figure,
    "worst": worst_figure,
}
PANELS: dict[str, Callable[..., None]] = {**OVER_TIME, "contact_loops": draw_loops}


def figure(
    run: RunData,
    picture: str = "run",
    title: str | None = None,
    size: tuple[float, float] | None = None,
    compare: bool | None = None,
    floors: dict[str, str] | None = None,
) -> Figure:
    """One picture of a run.

    `title` replaces that of the run, `size` is width and height [in], and `floors` {structure: label} are those of the
    picture "run". `compare` also draws the run without links; None draws it in profiles and plan if it exists. Loops
    are those of yielding parts and devices, or of contacts if the run has no such parts. Raises BadRequest for an
    unknown picture and for an impossible comparison."""
    if picture == "springs":
        warnings.warn('the picture "springs" is now called "loops"', DeprecationWarning, stacklevel=5)
        picture = "loops"
    if picture == "loops" and not most_energy(run):
        picture = "contact_loops"
    if picture in ("profiles", "plan"):
        return WHOLE[picture](run, title, size, compare)
    if compare:
        require_comparison(run, picture)
    if picture == "run":
        return standard_figure(run, title, floors, size, bool(compare))
    if picture in WHOLE:
        return WHOLE[picture](run, title, size=size)
    if picture not in PANELS:
        raise BadRequest(f'unknown picture "{picture}"; known: {", ".join([*WHOLE, *PANELS])}')
    if picture == "rotation" and not turning(run):
        raise BadRequest("no rotation to draw: no structure of this run has rigid floors in space")
    # In space there is a panel of displacements for each direction.
    directions: list[dict[str, Any]] = (
        [{"direction": each} for each in directions_of(run)] if picture == "displacement" else [{}]
    )
    size = size or ((6.5, 0.8 + 2.4 * len(directions)) if picture in OVER_TIME else (5.5, 4.0))
    with style.picture(size, run.title if title is None else title) as made:
        panels: Any = made.subplots(len(directions), 1, squeeze=False, sharex=True)[:, 0]
        for axes, options in zip(panels, directions):
            PANELS[picture](axes, run, **options)
            if compare:
                WITHOUT_LINKS[picture](axes, run, **options)
        if picture in OVER_TIME:
            label_time(panels[-1], run)
        if size[0] < NARROW:
            gather_legends(made, list(panels))
            if len(panels) > 1:  # they are too low for the whole label
                for axes in panels:
                    axes.set_ylabel("[mm]")
        if title == "" and len(panels) == 1:
            panels[0].set_title("")
        return made
