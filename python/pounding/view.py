"""Interactive views of runs and models.

One HTML file with the model in three dimensions, the film of the run and mode shapes. It contains plotly.js and needs
no network. Needs plotly: `python3 -m pip install plotly`, or `pounding[view]`."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding._arguments import require_package, takes
from pounding._outputs import Kind, destination, replaced
from pounding._pictures.drawing import VIEWS
from pounding._pictures.scene import Scene
from pounding._pictures.style import TIME_UNITS, BadRequest
from pounding._pictures.view_scene import film_motions, mode_motions, packed, traces
from pounding.animation import FASTEST, SLOWEST, choose_scale, frame_times, pressed
from pounding.results import RunData

if TYPE_CHECKING:
    from pounding._modes import Modes

__all__ = ["View"]

#: Maximum size of the film in the file [bytes]; plotly.js takes 5 MB.
FILM = 12e6
#: Mark of our files.
MARK = b'<script id="data" type="application/json">'
#: Width of the widest gap of sticks as a fraction of the picture.
APART = 0.04


def _is_view(place: Path, _: bytes) -> bool:
    try:
        return MARK in place.read_bytes()
    except OSError:
        return False


VIEW = Kind("view", _is_view)


@dataclass(frozen=True, repr=False)
class View(printing.ReportLines):
    """An interactive view: a page with everything in it. A notebook shows it."""

    html: str  #: text of the page
    frames: int  #: number of instants of the film; 0 without a film
    modes: int  #: number of modes

    @takes(path=arguments.file)
    def save(self, path: str | PathLike[str]) -> None:
        """Writes the page.

        Parameters
        ----------
        path : str or os.PathLike
            File to write; an existing one must be a view.

        Raises
        ------
        InputError
            The file may not be replaced.
        OSError
            The file cannot be written.
        """
        check_output(path)
        with replaced(path, VIEW) as temporary:
            temporary.write_text(self.html, encoding="utf-8")

    def _repr_html_(self) -> str:
        page = html.escape(self.html, quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:640px;border:0"></iframe>'


def check_output(path: str | PathLike[str]) -> None:
    """Raises InputError if a view cannot be written to this file."""
    if Path(path).suffix not in (".html", ".htm"):
        raise BadRequest(f'cannot write {path}: "{Path(path).suffix}" is not .html')
    destination(path, VIEW)


def view_of_run(
    run: RunData,
    found: Modes | None = None,
    frames: int | None = None,
    scale: float | None = None,
    title: str | None = None,
) -> View:
    """The view of a run, or of a model at rest, which has no output times. `found` are modes of its structures.

    Raises BadRequest for a scale that is not positive and fewer than two frames, ImportError without plotly."""
    if scale is not None and not (math.isfinite(scale) and scale > 0):
        raise BadRequest(f"--scale {scale:g} should be above zero")
    has_film = run.time.size > 1
    if frames is not None and not has_film:
        raise BadRequest("--frames belongs to a film, and these results have fewer than two output times")
    scene = Scene(run, _scale(run) if scale is None else scale)
    page: dict[str, Any] = {
        "title": (run.title or "Model") if title is None else title,
        "about": _about(run, scene),
        "nodes": [len(scene.line_models[name].nodes) for name in run.structures],
        "traces": [{"shown": one.shown, "points": one.points.packed(), "role": one.role} for one in traces(scene)],
        "layout": _layout(scene),
        "film": _film(run, scene, frames) if has_film else None,
        "modes": _modes(scene, found) if found else [],
    }
    text = json.dumps(page, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    pieces = {"@TITLE@": html.escape(page["title"]), "@PLOTLY@": _plotly(), "@DATA@": text}
    whole_page = Path(__file__).with_name("_pictures").joinpath("view.html").read_text(encoding="utf-8")
    for name, piece in pieces.items():
        before, after = whole_page.split(name, 1)
        whole_page = before + piece + after
    return View(whole_page, len(page["film"]["times"]) if has_film else 0, len(page["modes"]))


def _plotly() -> str:
    require_package("plotly")
    from plotly.offline import get_plotlyjs

    return str(get_plotlyjs())


def _scale(run: RunData) -> float:
    """Enlargement of displacements and gaps: that of an animation; without motion gaps of sticks become visible."""
    if run.time.size > 1:
        return choose_scale(run)
    scene = Scene(run)
    widest = max((link.gap for link in run.links.values()), default=0.0)
    if scene.has_places or widest <= 0:
        return 1.0
    return max(1.0, APART * float(np.ptp(scene.bounds(), axis=1).max()) / widest)


def _about(run: RunData, scene: Scene) -> str:
    """Numbers of structures and links, impacts and the enlargement."""
    words = [printing.counted(len(run.structures), "structure"), printing.counted(len(run.links), "link")]
    if run.time.size > 1:
        words.append(printing.counted(len(run.impacts), "impact"))
    if scene.scale != 1:
        what = "displacements and gaps" if run.time.size > 1 else "gaps"
        words.append(f"{what} {scene.scale:.3g} times as large")
    if run.status not in ("done", "not run"):
        words.append(run.status)
    return ", ".join(words)


def _layout(scene: Scene) -> dict[str, Any]:
    bounds = scene.bounds()
    size = max(float(np.ptp(bounds, axis=1).max()), 1e-6)
    bounds = scene.bounds(0.16 * size)
    spans = np.ptp(bounds, axis=1)
    # The window shows 2 units vertically; the page shrinks the scene in a narrow one.
    unit = 1.6 / spans.max() if scene.is_spatial else min(2.6 / spans[0], 1.9 / spans[2])
    labels = {"x": scene.has_places, "y": scene.is_spatial and scene.has_places, "z": scene.has_heights}
    axes = {
        f"{axis}axis": {
            "range": bounds[i].tolist(),
            "title": {"text": f"{axis} [m]" if labels[axis] else ""},
            "showticklabels": labels[axis],
            "showbackground": False,
            "showspikes": False,
            "gridcolor": "#eeeeee",
            "zeroline": False,
        }
        for i, axis in enumerate("xyz")
    }
    eye = np.cross(*VIEWS["oblique"]) if scene.is_spatial else np.array([0.0, -1.0, 0.12])
    distance = 2.1 if scene.is_spatial else 1.55
    camera = {
        "eye": dict(zip("xyz", (distance * eye / np.linalg.norm(eye)).tolist())),
        "projection": {"type": "perspective" if scene.is_spatial else "orthographic"},
    }
    return {
        "margin": {"l": 0, "r": 0, "t": 4, "b": 0},
        "scene": {
            **axes,
            "aspectmode": "manual",
            "aspectratio": dict(zip("xyz", (unit * spans).tolist())),
            "camera": camera,
            "dragmode": "orbit",
        },
        "legend": {"x": 0.0, "y": 1.0, "bgcolor": "rgba(255,255,255,0.7)", "itemsizing": "constant"},
        "hoverlabel": {"align": "left"},
        "uirevision": "same",
    }


def _film(run: RunData, scene: Scene, frames: int | None) -> dict[str, Any]:
    """The film, with as many instants as fit in FILM."""
    times = frame_times(run, frames)
    each = 8.0 * sum(len(model.nodes) for model in scene.line_models.values())  # base64 of three 16-bit numbers
    most = max(2, int(FILM / max(each, 1.0)))
    if len(times) > most:
        if frames is not None:
            raise BadRequest(f"--frames {frames} would take {each * frames / 1e6:.0f} MB; type at most --frames {most}")
        times = frame_times(run, most)
    seconds = times[-1] - times[0]
    size, name = TIME_UNITS[1] if seconds < 0.5 else TIME_UNITS[0]
    return {
        "times": times.tolist(),
        "speed": float(np.clip(len(times) / seconds, SLOWEST, FASTEST)),
        "unit": {"size": size, "name": name},
        "motion": vars(film_motions(scene, times)),
        "links": len(run.links),
        "pressed": packed(np.ceil(255 * np.clip(pressed(run, times), 0, 1)).astype(np.uint8)),
        "strikes": np.sort(run.impacts["t_start"]).tolist(),
    }


def _modes(scene: Scene, found: Modes) -> list[dict[str, Any]]:
    """Mode 1 of every structure, then mode 2 of every structure that has one, and so on."""
    drawn = []
    for number in range(max((len(one) for one in found.values()), default=0)):
        having = {name: one[number] for name, one in found.items() if number < len(one)}
        shapes: Mapping[str, np.ndarray] = {
            name: found.node_shapes(name)[number] if found.node_shapes(name) else mode.shape
            for name, mode in having.items()
        }
        about = "; ".join(
            f"{name}: {'no period' if math.isinf(mode.period) else f'T = {mode.period:.4g} s'}, "
            f"{100 * mode.damping_ratio:.3g} %"
            for name, mode in list(having.items())[:6]
        )
        more = f"; and {len(having) - 6} more" if len(having) > 6 else ""
        drawn.append({"about": f"Mode {number + 1}. {about}{more}", "motion": vars(mode_motions(scene, dict(shapes)))})
    return drawn
