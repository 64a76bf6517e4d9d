"""Animations of runs: `python3 -m pounding.animation RESULTS.h5 [-o FILE.gif|.mp4|.png]`.

Frames move with their nodes, or with their floors if the file has no nodes; other structures are sticks with masses.
Displacements are relative to the ground. Displacements and gaps are drawn to the same enlarged scale, so that
contacts of the run are contacts in the picture. A link flashes while it is in contact."""

from __future__ import annotations

import argparse
import base64
import math
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from matplotlib import rc_context
from matplotlib.animation import FFMpegWriter
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from pounding import _printing as printing
from pounding._ended import exit_code
from pounding._outputs import PICTURE, destination, output_for, replaced, tell
from pounding._pictures.drawing import Drawing, are_many, draw_ground, frame_axes, hide_x, label_axes
from pounding._pictures.panels import legend_below
from pounding._pictures.scene import Motion, Scene
from pounding._pictures.style import STYLE, TIME_UNITS, VERMILION, BadRequest, head, largest
from pounding.results import RunData

__all__ = ["Film", "animate", "save"]

DPI = 110
SLOWEST, FASTEST = 5, 25  #: frames per second
SUFFIXES = (".gif", ".mp4", ".png")


def choose_scale(run: RunData) -> float:
    """Largest of 1, 2, 5, 10 ... for which displacements stay below a twelfth of the size of the picture."""
    scene = Scene(run)
    size = float(np.ptp(scene.bounds(), axis=1).max())
    moved = largest(
        [
            motion.displacement
            for structure in run.structures.values()
            for axis, motion in structure.along.items()
            if axis in "xy"
        ]
    )
    if moved <= 0 or size <= 0:
        return 1.0
    wanted = size / 12 / moved
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(1.0, next(step * power for step in (10, 5, 2, 1) if step * power <= wanted * (1 + 1e-12)))


def frame_times(
    run: RunData, frames: int | None = None, start: float | None = None, end: float | None = None
) -> np.ndarray:
    """Times of the frames, evenly spaced: by default 15 per second of film, 30 to 240 in total. Raises BadRequest for
    times outside the run and for fewer than two frames."""
    if run.time.size < 2:
        raise BadRequest("nothing to animate: the results have fewer than two output times")
    first, last = run.time[0], run.time[-1]
    start, end = first if start is None else start, last if end is None else end
    if not (math.isfinite(start) and math.isfinite(end)) or not first <= start < end <= last:
        raise BadRequest(
            f"--from {start:g} --to {end:g} is not within the run, which lasts from {first:g} s to {last:g} s"
        )
    frames = int(np.clip(round(15 * (end - start)), 30, 240)) if frames is None else frames
    if frames < 2:
        raise BadRequest(f"--frames {frames} is too few; type --frames 2 or more")
    return np.linspace(start, end, frames)


def pressed(run: RunData, times: np.ndarray) -> np.ndarray:
    """[frame, link] peak force since the frame before, relative to the largest of the run; 0 without contact.

    Includes contacts shorter than a frame. A contact without a finite force counts as 1."""
    strongest = largest([link.force for link in run.links.values()])
    strengths = np.zeros((len(times), len(run.links)))
    since = np.concatenate([[times[0] - (times[1] - times[0])], times[:-1]])
    for j, link in enumerate(run.links.values()):
        impacts = run.impacts_of(link.name)
        for i, (before, now) in enumerate(zip(since, times)):
            first, last = np.searchsorted(link.time, [before, now], side="right")
            inside = link.penetration[first:last] > 0
            # An unfinished impact has no end.
            struck = np.any((impacts["t_start"] <= now) & ~(impacts["t_end"] <= before))
            if not inside.any() and not struck:
                continue
            peak = largest([link.force[first:last][inside]])
            rigid = peak == 0 and struck and largest([impacts["peak_force"]]) == 0
            strengths[i, j] = 1.0 if rigid else max(peak / strongest if strongest > 0 else 0, 1e-3)
    return strengths


@dataclass(frozen=True, repr=False)
class Film(printing.ReportLines):
    """Frames of an animation, drawn in order."""

    figure: Figure
    draw: Callable[[int], None]  #: updates the figure to a frame, from 0
    moving: list[Artist]  #: changed by `draw`, lowest first, above the others
    frames: int
    speed: float  #: frames per second

    def pictures(self) -> Iterator[Image.Image]:
        """The frames in RGB. Only moving parts are redrawn, since axes and legends would take most of the time.

        Yields
        ------
        PIL.Image.Image
            The next frame.
        """
        canvas: Any = FigureCanvasAgg(self.figure)  # without types in matplotlib
        for artist in self.moving:
            artist.set_animated(True)
        canvas.draw()
        stays = canvas.copy_from_bbox(self.figure.bbox)
        for frame in range(self.frames):
            self.draw(frame)
            canvas.restore_region(stays)
            for artist in self.moving:
                self.figure.draw_artist(artist)
            yield Image.fromarray(np.asarray(canvas.buffer_rgba())[:, :, :3])
        for artist in self.moving:
            artist.set_animated(False)

    def _repr_html_(self) -> str:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "film.gif"
            save(self, path)
            data = base64.b64encode(path.read_bytes()).decode()
        return f'<img alt="film" src="data:image/gif;base64,{data}">'


def animate(run: RunData, times: np.ndarray, scale: float | None = None, title: str | None = None) -> Film:
    """The film of a run.

    Parameters
    ----------
    run : RunData
        The results.
    times : numpy.ndarray
        Times of the frames [s].
    scale : float, optional
        Magnification of displacements and gaps, by default so that they are visible.
    title : str, optional
        Title instead of that of the run.

    Returns
    -------
    Film
        The film.

    Raises
    ------
    InputError
        The scale is not positive.
    """
    scale = choose_scale(run) if scale is None else scale
    if not (math.isfinite(scale) and scale > 0):
        raise BadRequest(f"--scale {scale:g} should be above zero")
    scene = Scene(run, scale)
    motion = Motion(scene, times)
    strengths = pressed(run, times)
    view = "oblique" if scene.is_spatial else "elevation"
    room = scale * np.array([largest([moved[:, :, j] for moved in motion.displacements.values()]) for j in range(3)])

    with rc_context(STYLE):
        figure = Figure(figsize=_size(scene, room), dpi=DPI, layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
        axes.grid(False)
        draw_ground(axes, scene, view)
        drawing = Drawing(axes, scene, view, marks=False)
        frame_axes(axes, scene, view, margin=room)
        label_axes(axes, scene, view)
        if not scene.has_places or scale != 1:
            # Gaps are enlarged, so that coordinates across them would be wrong.
            hide_x(axes)
        if not are_many(scene):
            legend_below(figure, list(drawing.lines.values()), list(drawing.lines), 5)
        head(figure, run.title if title is None else title)
        clock = axes.set_title("", fontweight="normal")
        gaps = f"displacements{' and gaps' if run.links else ''} {scale:g} times as large"

    strikes = np.sort(run.impacts["t_start"])

    def draw(frame: int) -> None:
        drawing.move(motion, frame)
        drawing.flash(motion, frame, strengths[frame])
        size, unit = TIME_UNITS[1] if times[-1] - times[0] < 0.5 else TIME_UNITS[0]
        count = np.searchsorted(strikes, times[frame], side="right")
        words = f"t = {times[frame] / size:.2f} {unit}   {gaps}"
        if run.links:
            words += f"   {count} impact{'' if count == 1 else 's'}"
        clock.set_text(words)
        clock.set_color(VERMILION if strengths[frame].any() else "black")

    # The layout is fixed after the first drawing.
    draw(0)
    with rc_context(STYLE):
        figure.canvas.draw()
    figure.set_layout_engine("none")
    speed = float(np.clip(len(times) / (times[-1] - times[0]), SLOWEST, FASTEST))
    return Film(figure, draw, [*drawing.artists(), clock], len(times), speed)


def save(film: Film, path: str | PathLike[str], progress: Callable[[int, int], None] | None = None) -> None:
    """Writes .gif, .mp4, or one .png per frame: NAME_0001.png and so on.

    Parameters
    ----------
    film : Film
        The film.
    path : str or os.PathLike
        File to write.
    progress : callable, optional
        Called with the number of frames that are done and of all frames.

    Raises
    ------
    InputError
        The suffix is another one, .mp4 lacks ffmpeg, or an existing file is not a picture.
    OSError
        The file cannot be written.
    """
    path = Path(path)
    check_output(path)
    with rc_context(STYLE):
        if path.suffix == ".mp4":
            with replaced(path, PICTURE) as temporary:
                _save_mp4(film, temporary, progress)
            return
        if path.suffix == ".png":
            for frame in range(1, film.frames + 1):
                destination(_frame_path(path, frame, film.frames), PICTURE)
        pictures = []
        for frame, picture in enumerate(film.pictures(), start=1):
            if path.suffix == ".png":
                with replaced(_frame_path(path, frame, film.frames), PICTURE) as temporary:
                    picture.save(temporary)
            else:
                pictures.append(picture)
            if progress:
                progress(frame, film.frames)
        if path.suffix == ".gif":
            with replaced(path, PICTURE) as temporary:
                _save_gif(pictures, temporary, film.speed)


def check_output(path: str | PathLike[str]) -> None:
    """Raises InputError if `save` cannot write this file."""
    suffix = Path(path).suffix
    if suffix not in SUFFIXES:
        raise BadRequest(f'cannot write {path}: "{suffix}" is none of {", ".join(SUFFIXES)}')
    if suffix == ".mp4" and shutil.which("ffmpeg") is None:
        raise BadRequest(
            f"cannot write {path}: .mp4 needs ffmpeg, which is not installed. Type `apt-get install ffmpeg`, or "
            f"`-o {Path(path).with_suffix('.gif')}`"
        )
    if suffix != ".png":  # its frames have other names
        destination(path, PICTURE)


def _save_gif(pictures: list[Image.Image], path: Path, speed: float) -> None:
    """Writes an endless loop. All frames share the 256 dominant colours of four of them, since a palette per frame
    would take too long. The nearest-colour search of Pillow would turn white into grey."""
    numbers = np.linspace(0, len(pictures) - 1, 4).round().astype(int)
    counts = np.sum([np.bincount(_coarse(pictures[number]).ravel(), minlength=64**3) for number in numbers], axis=0)
    levels = np.linspace(0, 255, 64).round()
    chosen = np.argsort(-counts, kind="stable")[:256]
    palette = np.stack([levels[chosen // 4096], levels[chosen // 64 % 64], levels[chosen % 64]], axis=1)
    green_and_blue = np.stack(np.meshgrid(levels, levels, indexing="ij"), axis=-1).reshape(-1, 2)
    rest = ((green_and_blue[:, None] - palette[None, :, 1:]) ** 2).sum(axis=2)
    nearest = np.concatenate([np.argmin(rest + (red - palette[:, 0]) ** 2, axis=1) for red in levels]).astype(np.uint8)
    frames = []
    for picture in pictures:
        frames.append(Image.fromarray(nearest[_coarse(picture)]))
        frames[-1].putpalette(palette.astype(np.uint8).tobytes())
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=round(1000 / speed), loop=0)


def _coarse(picture: Image.Image) -> np.ndarray:
    """Index of the colour of each pixel among 64 levels of red, green and blue."""
    red, green, blue = (np.asarray(channel, dtype=np.int32) // 4 for channel in picture.split())
    return red * 4096 + green * 64 + blue


def _save_mp4(film: Film, path: Path, progress: Callable[[int, int], None] | None) -> None:
    speed: Any = film.speed  # an int to matplotlib's types, a number to its writers
    writer = FFMpegWriter(fps=speed)
    with writer.saving(film.figure, str(path), DPI):
        for frame in range(film.frames):
            film.draw(frame)
            writer.grab_frame()
            if progress:
                progress(frame + 1, film.frames)


def _frame_path(path: Path, number: int, frames: int) -> Path:
    """NAME_0001.png of NAME.png."""
    return path.with_name(f"{path.stem}_{number:0{max(4, len(str(frames)))}}.png")


def _size(scene: Scene, room: np.ndarray) -> tuple[float, float]:
    """Width and height of the figure [in]."""
    width, depth, height = np.ptp(scene.bounds(room), axis=1)
    across = 0.83 * width + 0.56 * depth if scene.is_spatial else width
    up = 0.91 * height + 0.24 * width + 0.35 * depth if scene.is_spatial else height
    return 6.4, float(np.clip(5.6 * up / max(across, 1e-9) + 1.0, 3.4, 7.0))


class Progress:
    """Progress on one line of a terminal."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def __call__(self, done: int, total: int) -> None:
        filled = 30 * done // total
        self.stream.write(f"\r[{'#' * filled}{'.' * (30 - filled)}] frame {done} of {total} ")
        if done == total:
            self.stream.write("\r\033[K")
        self.stream.flush()


def _progress(number: int | None) -> Progress | None:
    """Progress on the file descriptor of this number, or on standard error if it is a terminal; otherwise none."""
    if number is not None:
        return Progress(os.fdopen(number, "w"))
    return Progress(sys.stderr) if sys.stderr.isatty() else None


def main(arguments: list[str] | None = None) -> int:
    """Command line: writes the animation. Raises InputError, OSError."""
    parser = argparse.ArgumentParser(prog="python3 -m pounding.animation", description="Animate the results of a run.")
    parser.add_argument("results", help="file that `pounding run` wrote")
    parser.add_argument(
        "-o",
        "--output",
        help="file to write: .gif, .mp4, or .png for one file per frame (default: RESULTS.gif in the current folder)",
    )
    parser.add_argument("--scale", type=float, help="scale factor of displacements")
    parser.add_argument("--frames", type=int, help="number of frames")
    parser.add_argument("--from", type=float, dest="start", help="time of the first frame [s]")
    parser.add_argument("--to", type=float, dest="end", help="time of the last frame [s]")
    parser.add_argument("--title", help="title instead of that of the run")
    parser.add_argument("--progress-to", type=int, help="number of an open file for a progress line")
    options = parser.parse_args(arguments)
    output = output_for(options.results, options.output, ".gif")
    check_output(output)
    run = RunData.read(options.results)
    film = animate(run, frame_times(run, options.frames, options.start, options.end), options.scale, options.title)
    save(film, output, _progress(options.progress_to))
    if output.suffix == ".png":
        tell("frames", f"{_frame_path(output, 1, film.frames)} to {_frame_path(output, film.frames, film.frames).name}")
    else:
        tell("film", output)
    return 0


if __name__ == "__main__":
    sys.exit(exit_code(main))
