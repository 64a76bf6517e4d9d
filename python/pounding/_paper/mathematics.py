"""Texts with mathematics between dollar signs as HTML with embedded pictures."""

import base64
import functools
import html
import io
import re
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

#: Font size of the surrounding text [points].
SIZE = 11
_STYLE: dict[Any, Any] = {
    "mathtext.fontset": "stix",
    "svg.fonttype": "path",
    "svg.hashsalt": "pounding",
    "text.parse_math": True,
}


def data_uri(svg: str) -> str:
    """An SVG text as the address of a picture."""
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()


def svg_of(figure: Figure) -> str:
    """A figure as SVG text, the same for the same figure."""
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None}, transparent=True)
    return stream.getvalue()


@functools.lru_cache(maxsize=None)
def formula(tex: str, size: float = SIZE) -> str:
    """The HTML of one formula; `tex` with its dollar signs. Its base line is that of the surrounding text.
    Raises ValueError if matplotlib cannot parse it."""
    with rc_context(_STYLE):
        width, height, depth, _, _ = MathTextParser("path").parse(tex, 72, FontProperties(size=size))
        # Glyphs may extend slightly beyond their TeX boxes.
        width, height, depth = width + 1, height + 1, depth + 0.5
        figure = Figure(figsize=(width / 72, height / 72))
        figure.text(0.5 / width, depth / height, tex, fontsize=size)
        svg = svg_of(figure)
    return (
        f'<img class="math" src="{data_uri(svg)}" alt="{html.escape(tex.strip("$"))}" '
        f'style="width:{width / SIZE:.3f}em;height:{height / SIZE:.3f}em;vertical-align:{-depth / SIZE:.3f}em">'
    )


def rich(text: str) -> str:
    """A text with mathematics between dollar signs and `commands` as HTML."""
    parts = re.split(r"(\$[^$]+\$|`[^`]+`)", text)
    return "".join(
        formula(part)
        if part.startswith("$") and len(part) > 1
        else f"<code>{html.escape(part[1:-1])}</code>"
        if part.startswith("`") and len(part) > 1
        else html.escape(part)
        for part in parts
    )
