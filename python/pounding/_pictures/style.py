"""Style of all pictures: colours, font sizes, units, and writing of files."""

from __future__ import annotations

import argparse
import io
import os
import re
import sys
import textwrap
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib import font_manager, rc_context
from matplotlib.figure import Figure

from pounding._outputs import PICTURE, read_object, replaced, tell
from pounding.errors import InputError

# The first version with legends outside the axes.
if matplotlib.__version_info__ < (3, 7):
    raise ImportError(
        f"pictures need matplotlib 3.7 or newer, and {sys.executable} has {matplotlib.__version__}: type python3 -m pip install "
        "--upgrade matplotlib, or set the environment variable POUNDING_PYTHON to a Python that has a newer one"
    )

#: Colours of Okabe and Ito, suitable for colour-blind readers.
BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY = "#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9"
YELLOW = "#F0E442"
STRUCTURE_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
LINK_COLOURS = (BLUE, VERMILION, GREEN, ORANGE)
QUIET = "0.72"
#: Lines of the run without links.
DASHED: dict[str, Any] = {"linestyle": (0, (3, 2)), "linewidth": 0.8}
STYLE: dict[Any, Any] = {
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "legend.columnspacing": 1.2,
    "legend.borderaxespad": 0.2,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.0,
    "axes.grid": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "savefig.dpi": 200,
    "text.parse_math": False,
    # TrueType, as journals require.
    "pdf.fonttype": 42,
}
#: Fonts with Chinese, Japanese and Korean characters, in order of preference; the first installed one is a fallback.
EAST_ASIAN = (
    *("Noto Sans CJK SC", "Noto Sans CJK JP", "Source Han Sans SC", "WenQuanYi Micro Hei", "WenQuanYi Zen Hei"),
    *("Droid Sans Fallback", "IPAexGothic", "IPAGothic", "TakaoGothic", "VL Gothic", "Noto Sans JP", "Noto Sans SC"),
    *("Hiragino Sans", "PingFang SC", "Arial Unicode MS", "MS Gothic", "Microsoft YaHei", "SimHei"),
)
MM = 1e3
#: Width of a figure below which legends are below the axes, and small figures have one panel [in].
NARROW = 4.5
FORCE_UNITS = ((1e6, "MN"), (1e3, "kN"), (1.0, "N"))
IMPULSE_UNITS = ((1e6, "MN s"), (1e3, "kN s"), (1.0, "N s"))
ENERGY_UNITS = ((1e6, "MJ"), (1e3, "kJ"), (1.0, "J"))
TIME_UNITS = ((1.0, "s"), (1e-3, "ms"))


def _fonts() -> list[str]:
    """The usual font, and one for characters that it lacks."""
    installed = {font.name for font in font_manager.fontManager.ttflist}
    return ["DejaVu Sans", *[name for name in EAST_ASIAN if name in installed][:1]]


STYLE["font.family"] = _fonts()


@contextmanager
def one_warning_for_missing_letters() -> Iterator[None]:
    """Replaces the warnings of matplotlib about single characters without a font by one that names the remedy."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    missing = [one for one in caught if re.match(r"Glyph \d+ .* missing from", str(one.message))]
    for one in caught:
        if one not in missing:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
    if missing:
        letters = {chr(int(str(one.message).split()[1])) for one in missing}
        warnings.warn(
            f"no installed font has {', '.join(sorted(letters)[:5])}{' ...' if len(letters) > 5 else ''}, which the picture "
            "shows as boxes; install a font such as fonts-noto-cjk of Debian, then remove the font list in "
            f"{matplotlib.get_cachedir()}",
            stacklevel=2,
        )


class BadRequest(InputError):
    """An unknown or impossible picture. The message lists the available ones."""


class DrawnOnce(Figure):
    """A figure drawn once when saved. Matplotlib draws figures with a layout twice, the first time without output."""

    _layout_is_enough = False

    def savefig(self, fname: Any, **options: Any) -> None:
        """Same as Figure.savefig, in three quarters of the time. An existing file must be a picture. Raises
        InputError, OSError."""
        if isinstance(fname, (str, os.PathLike)):
            if not Path(fname).suffix and "format" not in options:
                raise BadRequest(f'cannot write "{fname}": the name of a picture ends in .png, .pdf or .svg')
            with replaced(fname, PICTURE) as temporary:
                self.savefig_into(temporary, **options)
        else:
            self.savefig_into(fname, **options)

    def savefig_into(self, fname: Any, **options: Any) -> None:
        """Same as `savefig`, without a check of the existing file."""
        self._layout_is_enough = self.get_layout_engine() is not None
        try:
            with one_warning_for_missing_letters():
                super().savefig(fname, **options)
        finally:
            self._layout_is_enough = False

    def draw(self, renderer: Any) -> None:
        """Same as Figure.draw, with the layout only in the draw without output."""
        engine, into_nothing = self.get_layout_engine(), "draw_path" in vars(renderer)
        if self._layout_is_enough and into_nothing and engine is not None:
            engine.execute(self)
        else:
            super().draw(renderer)


class Picture(DrawnOnce):
    """A figure that notebooks display with or without pyplot, and that looks the same wherever it is saved."""

    def savefig(self, fname: Any, **options: Any) -> None:
        """As Figure.savefig, in the style of this package."""
        with rc_context(STYLE):
            super().savefig(fname, **options)

    def _repr_png_(self) -> bytes:
        image = io.BytesIO()
        self.savefig(image, format="png", dpi=110)
        return image.getvalue()


@contextmanager
def picture(size: tuple[float, float], title: str = "") -> Iterator[Picture]:
    """Yields a figure of this size [in] to draw in the style of this package; the title is added at the end."""
    with rc_context(STYLE):
        figure = Picture(figsize=size, layout="constrained")
        yield figure
        head(figure, title)


def head(figure: Figure, title: str) -> None:
    """Title above all panels, wrapped to fit; none for an empty one."""
    if title:
        letters = max(20, int(11 * figure.get_figwidth()))
        figure.suptitle("\n".join(textwrap.wrap(title, letters)), fontsize=10.5, fontweight="bold")


def engineering(largest: float, units: Sequence[tuple[float, str]]) -> tuple[float, str]:
    """(size, name) of the largest unit in which `largest` is at least 0.5, or of the smallest unit."""
    return next((unit for unit in units if largest >= 0.5 * unit[0]), units[-1])


def largest(arrays: Iterable[np.ndarray]) -> float:
    """Maximum absolute value over arrays; 0 if they are empty or NaN only (the force of rigid impacts)."""
    return max(
        (float(np.abs(finite).max()) for finite in (a[np.isfinite(a)] for a in arrays) if finite.size), default=0.0
    )


def structure_colour(number: int) -> str:
    """Colour of a structure by its index in the input."""
    return STRUCTURE_COLOURS[number % len(STRUCTURE_COLOURS)]


def write_picture(figure: Figure, path: str | PathLike[str]) -> int:
    """Writes .png, .pdf or .svg, prints its name and returns 0. Raises InputError, OSError."""
    try:
        with rc_context(STYLE):
            figure.savefig(path)
    except InputError:
        raise
    except ValueError as error:
        raise BadRequest(f"cannot write {path}: {error}") from error
    tell("picture", path)
    return 0


def draw_object(
    module: str, description: str, draw: Callable[[Any, str | None], Figure], arguments: list[str] | None
) -> int:
    """Command line `python3 -m pounding.MODULE FILE -o PICTURE [--title TEXT]`: draws the JSON object in a file with
    this title. Returns 0. Raises InputError, OSError."""
    parser = argparse.ArgumentParser(prog=f"python3 -m pounding.{module}", description=description)
    parser.add_argument("file", help="file with the JSON object")
    parser.add_argument("-o", "--output", required=True, help="picture to write: .png, .pdf or .svg")
    parser.add_argument("--title", help="title of the picture")
    options = parser.parse_args(arguments)
    return write_picture(draw(read_object(options.file), options.title), options.output)
