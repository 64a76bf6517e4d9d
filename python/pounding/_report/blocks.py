"""Parts of a report, independent of its format."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Shown for a value that does not exist.
NONE = "–"
#: Shown for the response of a collapse.
INFINITE = "∞"


@dataclass(frozen=True)
class Heading:
    """Title of a section."""

    text: str


@dataclass(frozen=True)
class Paragraph:
    """Wrapped text; `emphasis` for the verdict."""

    text: str
    emphasis: bool = False


@dataclass(frozen=True)
class Table:
    """Rows of texts under one or two header rows."""

    columns: list[str]  #: headers, with units
    rows: list[list[str]]
    caption: str = ""
    #: (title, number of columns) above the headers; empty for none
    groups: list[tuple[str, int]] = field(default_factory=list)
    texts: int = 1  #: number of leading columns with texts, aligned to the left
    last_text: bool = False  #: the last column is a text
    note: str = ""  #: below the table

    def is_text(self, column: int) -> bool:
        """True if a column is aligned to the left."""
        return column < self.texts or self.last_text and column == len(self.columns) - 1


@dataclass(frozen=True)
class Picture:
    """A drawing in a box of a figure. `draw(figure, box)` gets left, bottom, width and height as fractions of the
    figure."""

    draw: Callable[[Figure, tuple[float, float, float, float]], None]
    alt: str  #: description for readers that do not show pictures
    height: float  #: [mm] at full width


@dataclass(frozen=True)
class Report:
    """All parts of a report in their order."""

    title: str
    project: str
    subtitle: str
    blocks: list[Heading | Paragraph | Table | Picture]
    footer: str
    created: str  #: time of the run, ISO 8601; empty if not known


def decimals(values: Iterable[float | None], digits: int = 4) -> int:
    """Number of decimals that shows the largest value with `digits` significant digits, at most 4."""
    largest = max((abs(v) for v in values if v is not None and math.isfinite(v)), default=0.0)
    if largest == 0:
        return 0
    return min(max(digits - 1 - math.floor(math.log10(largest)), 0), 4)


def shown(value: float | None, places: int) -> str:
    """A number with this many decimals; NONE for a missing one, zero without a sign."""
    if value is None or not math.isfinite(value):
        return _without_digits(value)
    text = f"{value:.{places}f}"
    return text.lstrip("-") if float(text) == 0 else text


def _without_digits(value: float | None) -> str:
    """INFINITE, or NONE for a missing number."""
    return NONE if value is None or math.isnan(value) else INFINITE


def column(values: Sequence[float | None], scale: float = 1.0, digits: int = 4) -> list[str]:
    """Numbers of a column, divided by `scale`, with the same number of decimals."""
    scaled = [None if v is None else v / scale for v in values]
    places = decimals(scaled, digits)
    return [shown(value, places) for value in scaled]


def number(value: float | None, scale: float = 1.0, digits: int = 3) -> str:
    """One number with at least `digits` significant digits, without trailing zeros, and with an exponent if it is
    very small or large."""
    if value is None or not math.isfinite(value):
        return _without_digits(value)
    value /= scale
    if value == 0:
        return "0"
    if not 1e-4 <= abs(value) < 1e7:
        return f"{value:.{digits}g}"
    text = f"{value:.{max(digits - 1 - math.floor(math.log10(abs(value))), 0)}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def span(values: Iterable[float | None], scale: float = 1.0, digits: int = 4) -> str:
    """One number, or the smallest and the largest of several: "50", "20 to 50"."""
    known = sorted(v for v in values if v is not None and math.isfinite(v))
    if not known:
        return NONE
    ends = [number(v, scale, digits) for v in (known[0], known[-1])]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def ratio(value: float | None) -> str:
    """A ratio with two decimals, or with at least two significant digits."""
    if value is None or not math.isfinite(value):
        return _without_digits(value)
    return f"{value:.2f}" if value < 100 else f"{value:.0f}"


def filled(*tables: Table) -> Iterator[Table]:
    """Tables with rows."""
    return (table for table in tables if table.rows)


def cut(rows: list[list[str]], limit: int, noun: str) -> tuple[list[list[str]], str]:
    """At most `limit` rows, and a note on the number of others; empty if there are none."""
    more = len(rows) - limit
    return rows[:limit], f"{more} more {noun} in the results file" if more > 0 else ""
