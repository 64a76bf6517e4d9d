"""A report as pages of a PDF."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from os import PathLike
from typing import Any

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from pounding._pictures.style import STYLE, VERMILION
from pounding._report.blocks import Heading, Paragraph, Picture, Report, Table

#: A4, margins, and the height of the footer [mm].
WIDTH, HEIGHT, MARGIN, FOOTER = 210.0, 297.0, 15.0, 9.0
INCH, POINT = 25.4, 25.4 / 72
#: Sizes of letters [points], and distance of rows of tables and of lines of texts in letter sizes.
TABLE, TEXT, SUBTITLE, HEADING, TITLE = 7.0, 8.0, 8.0, 10.0, 14.0
PITCH = 1.32
#: Space between columns, and minimum width of a column of texts [mm].
GAP, MIN_TEXT = 3.0, 14.0
#: Lines per cell of a table.
CELL_LINES = 3

Draw = Callable[[Figure], None]


def write_pdf(report: Report, path: str | PathLike[str]) -> None:
    """Writes the report to a PDF with texts that can be selected."""
    metadata: dict[str, Any] = {"Title": report.title, "Creator": "pounding", "CreationDate": None}
    if report.created:
        metadata["CreationDate"] = datetime.fromisoformat(report.created.replace("Z", "+00:00"))
    with rc_context(STYLE), PdfPages(path, metadata=metadata) as pages:
        for figure in page_figures(report):
            pages.savefig(figure)


def page_figures(report: Report) -> list[Figure]:
    """The pages as figures of A4 size."""
    with rc_context(STYLE):
        layout = _Layout()
        layout.head(report)
        for i, block in enumerate(report.blocks):
            following = report.blocks[i + 1] if i + 1 < len(report.blocks) else None
            layout.add(block, following)
        figures = []
        for number, draws in enumerate(layout.pages, 1):
            figure = Figure(figsize=(WIDTH / INCH, HEIGHT / INCH))
            for draw in draws:
                draw(figure)
            _foot(figure, report.footer, f"page {number} of {len(layout.pages)}")
            figures.append(figure)
        return figures


def _font(size: float, bold: bool = False) -> FontProperties:
    return FontProperties(size=size, weight="bold" if bold else "normal")


def _measure() -> Callable[[str, float, bool], float]:
    """A function of text, size [points] and weight: width [mm]."""
    renderer = FigureCanvasAgg(Figure(figsize=(1, 1), dpi=720)).get_renderer()  # type: ignore[no-untyped-call]
    known: dict[tuple[str, float, bool], float] = {}

    def width(text: str, size: float, bold: bool = False) -> float:
        key = (text, size, bold)
        if key not in known:
            known[key] = renderer.get_text_width_height_descent(text, _font(size, bold), False)[0] * INCH / 720 * 1.01
        return known[key]

    return width


def _put(figure: Figure, x: float, y: float, text: str, size: float, **style: Any) -> None:
    """Text with its baseline at x, y [mm], from the left and the top of the page."""
    figure.text(x / WIDTH, 1 - y / HEIGHT, text, fontsize=size, va="baseline", **style)


def _rule(figure: Figure, x0: float, x1: float, y: float, width: float = 0.5, colour: str = "0.4") -> None:
    figure.add_artist(Line2D([x0 / WIDTH, x1 / WIDTH], [1 - y / HEIGHT] * 2, color=colour, linewidth=width))


def _foot(figure: Figure, footer: str, page: str) -> None:
    _rule(figure, MARGIN, WIDTH - MARGIN, HEIGHT - MARGIN - 1)
    # The checksum alone takes half of a line.
    parts = footer.split("; ")
    _put(figure, MARGIN, HEIGHT - MARGIN + 2.5, "; ".join(parts[:2]), TABLE, color="0.3")
    _put(figure, MARGIN, HEIGHT - MARGIN + 5.8, "; ".join(parts[2:]), TABLE, color="0.3")
    _put(figure, WIDTH - MARGIN, HEIGHT - MARGIN + 5.8, page, TABLE, ha="right", color="0.3")


class _Layout:
    """Places blocks on pages from the top down; `pages` are lists of functions that draw."""

    def __init__(self) -> None:
        self.pages: list[list[Draw]] = [[]]
        self.y = MARGIN  # lower edge of the last block [mm]
        self.bottom = HEIGHT - MARGIN - FOOTER + 6
        self.width = WIDTH - 2 * MARGIN
        self.measure = _measure()

    def head(self, report: Report) -> None:
        """Title, project and status."""
        for text, size, bold, lines in (
            (report.title, TITLE, True, 2),
            (report.project, HEADING, False, 2),
            (report.subtitle, SUBTITLE, False, 2),
        ):
            self.y += 0.8
            for line in self.wrap(text, size, bold, self.width, lines) if text else []:
                self.y += size * POINT * 1.25
                self.draw(_put, MARGIN, self.y, line, size, fontweight="bold" if bold else "normal")
        self.y += 3

    def add(self, block: Heading | Paragraph | Table | Picture, following: object) -> None:
        """Places one block; a heading stays on the page of its first block."""
        if isinstance(block, Heading):
            more = self.height(following) if isinstance(following, (Picture, Table)) else 10.0
            self.need(8 + more)
            self.y += 6
            self.draw(_put, MARGIN, self.y, block.text, HEADING, fontweight="bold")
            self.draw(_rule, MARGIN, WIDTH - MARGIN, self.y + 1.2)
            self.y += 2
        elif isinstance(block, Paragraph):
            self.paragraph(block)
        elif isinstance(block, Table):
            self.table(block)
        else:
            self.picture(block)

    def height(self, block: Picture | Table) -> float:
        """Height of what must be on one page [mm]."""
        pitch = TABLE * POINT * PITCH
        if isinstance(block, Picture):
            return block.height + 2 * pitch
        return min((len(block.rows) + 5) * pitch, 0.6 * (self.bottom - MARGIN))

    def need(self, height: float) -> None:
        """Starts a new page if the rest of this one is lower [mm]."""
        if self.y + height > self.bottom and self.pages[-1]:
            self.pages.append([])
            self.y = MARGIN

    def draw(self, function: Callable[..., None], *arguments: Any, **style: Any) -> None:
        """Adds a function of a figure and more arguments to the page."""
        self.pages[-1].append(lambda figure: function(figure, *arguments, **style))

    def wrap(self, text: str, size: float, bold: bool, width: float, limit: int | None = None) -> list[str]:
        """Lines of at most this width [mm], the last of `limit` cut with an ellipsis."""
        lines, line = [], ""
        for word in text.split():
            for piece in self.pieces(word, size, bold, width):
                longer = f"{line} {piece}".strip()
                if line and self.measure(longer, size, bold) > width:
                    lines.append(line)
                    line = piece
                else:
                    line = longer
        lines.append(line)
        if limit is not None and len(lines) > limit:
            last = lines[limit - 1]
            while last and self.measure(f"{last}…", size, bold) > width:
                last = last[:-1]
            lines = [*lines[: limit - 1], f"{last}…"]
        return lines

    def pieces(self, word: str, size: float, bold: bool, width: float) -> list[str]:
        """Pieces of a text without spaces that fit the width: long names, and texts in Chinese or Japanese."""
        pieces = [""]
        for letter in word:
            if pieces[-1] and self.measure(pieces[-1] + letter, size, bold) > width:
                pieces.append("")
            pieces[-1] += letter
        return pieces

    def paragraph(self, block: Paragraph) -> None:
        size, inset = (TEXT + 1.5, 3.0) if block.emphasis else (TEXT, 0.0)
        lines = self.wrap(block.text, size, block.emphasis, self.width - 2 * inset)
        pitch = size * POINT * PITCH
        height = len(lines) * pitch + (3 if block.emphasis else 1)
        self.need(min(height, self.bottom - MARGIN))
        if block.emphasis:
            self.draw(_box, MARGIN, self.y, self.width, height)
        for line in lines:
            if self.y + pitch > self.bottom:
                self.need(self.bottom)
            self.y += pitch
            self.draw(_put, MARGIN + inset, self.y, line, size, fontweight="bold" if block.emphasis else "normal")
        self.y += 3.5 if block.emphasis else 2

    def picture(self, block: Picture) -> None:
        pitch = TABLE * POINT * PITCH
        lines = self.wrap(block.alt, TABLE, False, self.width)
        self.need(block.height + (len(lines) + 1) * pitch)
        box = (MARGIN / WIDTH, 1 - (self.y + block.height) / HEIGHT, self.width / WIDTH, block.height / HEIGHT)
        self.draw(block.draw, box)
        self.y += block.height + pitch
        for line in lines:
            self.draw(_put, MARGIN, self.y, line, TABLE, color="0.35")
            self.y += pitch

    def table(self, block: Table) -> None:
        widths = self.widths(block)
        pitch = TABLE * POINT * PITCH
        rows = [
            [
                self.wrap(cell, TABLE, False, width, CELL_LINES) if block.is_text(i) else [cell]
                for i, (cell, width) in enumerate(zip(row, widths))
            ]
            for row in block.rows
        ]
        head = (1 + bool(block.groups) + bool(block.caption)) * pitch + 2.5
        heights = [max(len(cell) for cell in row) * pitch for row in rows]
        tail = pitch if block.note else 0.0
        whole = head + sum(heights) + tail
        # Tables are kept on one page unless they are longer than half of one.
        self.need(whole if whole < 0.6 * (self.bottom - MARGIN) else head + sum(heights[:4]))
        ends = [MARGIN + sum(widths[: i + 1]) + GAP * i for i in range(len(widths))]
        self.table_head(block, widths, ends, pitch)
        for row, height in zip(rows, heights):
            if self.y + height > self.bottom:
                self.need(self.bottom)
                self.table_head(block, widths, ends, pitch)
            for i, (cell, width, end) in enumerate(zip(row, widths, ends)):
                x, align = (end - width, "left") if block.is_text(i) else (end, "right")
                for number, line in enumerate(cell, 1):
                    self.draw(_put, x, self.y + number * pitch, line, TABLE, ha=align)
            self.y += height
        if block.note:
            self.y += pitch
            self.draw(_put, MARGIN, self.y, block.note, TABLE, color="0.35", fontstyle="italic")
        self.y += 2.5

    def table_head(self, block: Table, widths: list[float], ends: list[float], pitch: float) -> None:
        if block.caption:
            self.y += pitch + 0.5
            self.draw(_put, MARGIN, self.y, block.caption, TABLE + 0.5, fontweight="bold")
        if block.groups:
            self.y += pitch
            first = 0
            for title, span in block.groups:
                if title:
                    left, right = ends[first] - widths[first], ends[first + span - 1]
                    self.draw(_put, (left + right) / 2, self.y, title, TABLE, ha="center", fontweight="bold")
                first += span
        self.y += pitch
        for i, (name, width, end) in enumerate(zip(block.columns, widths, ends)):
            x, align = (end - width, "left") if block.is_text(i) else (end, "right")
            self.draw(_put, x, self.y, name, TABLE, ha=align, fontweight="bold")
        self.draw(_rule, MARGIN, ends[-1], self.y + 0.9)
        self.y += 1.0

    def widths(self, block: Table) -> list[float]:
        """Widths of the columns [mm]: those of their texts, with wide text columns narrowed to fit the page."""
        widths = [
            max(
                self.measure(block.columns[i], TABLE, True), *(self.measure(row[i], TABLE, False) for row in block.rows)
            )
            for i in range(len(block.columns))
        ]
        first = 0
        for title, span in block.groups:
            lacking = self.measure(title, TABLE, True) - sum(widths[first : first + span]) - GAP * (span - 1)
            widths[first] += max(lacking, 0.0)
            first += span
        excess = sum(widths) + GAP * (len(widths) - 1) - self.width
        while excess > 1e-6:
            wide = [i for i in range(len(widths)) if block.is_text(i) and widths[i] > MIN_TEXT]
            if not wide:
                break
            widest = max(wide, key=lambda i: widths[i])
            taken = min(excess, 1.0, widths[widest] - MIN_TEXT)
            widths[widest] -= taken
            excess -= taken
        return widths


def _box(figure: Figure, x: float, y: float, width: float, height: float) -> None:
    """A shaded box with a mark at its left edge."""
    corner = (x / WIDTH, 1 - (y + height) / HEIGHT)
    for across, colour in ((width, "#faf3ee"), (1.0, VERMILION)):
        shape = Rectangle(corner, across / WIDTH, height / HEIGHT, facecolor=colour, edgecolor="none", zorder=0)
        figure.add_artist(shape)
