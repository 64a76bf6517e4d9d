"""Placement of frames in plan: rows along streets, and blocks with corners. Functions set the `origin` of frames in
the format of a model."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from pounding import _arguments as arguments
from pounding._law_parameters import number_in
from pounding.errors import InputError, excerpt

__all__ = ["Extent", "extent", "row"]

#: Number of decimals of coordinates in m: 12.03, not 12.030000000000001.
DECIMALS = 9


class Extent(NamedTuple):
    """A rectangle in plan [m]."""

    x0: float
    x1: float
    y0: float
    y1: float

    @property
    def width(self) -> float:
        """Along x [m]."""
        return round(self.x1 - self.x0, DECIMALS)

    @property
    def depth(self) -> float:
        """Along y [m]."""
        return round(self.y1 - self.y0, DECIMALS)


def extent(structures: Mapping[str, Any]) -> Extent:
    """Bounding rectangle of frames. A plane frame has no depth.

    Parameters
    ----------
    structures : mapping
        Frames in the format of a model: {name: {"frame": {...}, "damping": ...}}.

    Returns
    -------
    Extent
        The rectangle [m].

    Raises
    ------
    InputError
        A structure is not a frame, or has neither grid nor nodes.
    """
    if not arguments.mapping("structures", structures):
        raise InputError("structures: there is none; give at least one frame")
    every = [_extent(name, words) for name, words in structures.items()]
    return Extent(
        min(one.x0 for one in every),
        max(one.x1 for one in every),
        min(one.y0 for one in every),
        max(one.y1 for one in every),
    )


def row(
    structures: Mapping[str, Any], gap: Any, *, along: str = "x", start: Sequence[Any] = (0.0, 0.0), align: str = "low"
) -> dict[str, Any]:
    """Places frames one after the other along x or y.

    Parameters
    ----------
    structures : mapping
        Frames in the format of a model. They are not modified; an existing `origin` is replaced.
    gap : float, str or sequence
        Gap between the faces of neighbours [m], or one after each frame except the last. Faces are `face` outside the
        axes of a frame; "auto" is not supported.
    along : str
        "x" or "y".
    start : sequence
        Position x, y of the beginning [m].
    align : str
        Sides on the line through `start`: those with the smallest ("low") or largest ("high") other coordinate.

    Returns
    -------
    dict of str to object
        The structures with their origins.

    Raises
    ------
    InputError
        As for `extent`, and for negative or missing gaps.

    Examples
    --------
    >>> grid = {"storeys": 2, "bays": 1, "storey_height": "3 m", "bay_width": "6 m"}
    >>> placed = pounding.plan.row({"a": {"frame": {"grid": grid}}, "b": {"frame": {"grid": grid}}}, "30 mm")
    >>> placed["b"]["frame"]["origin"]
    [6.03]
    >>> pounding.plan.extent(placed).width
    12.03
    """
    arguments.mapping("structures", structures)
    arguments.one_of(("x", "y"))("along", along)
    arguments.one_of(("low", "high"))("align", align)
    axis = "xy".index(along)
    gaps = [number_in("gap", one, "m") for one in _each(gap, len(structures) - 1)]
    place = [
        number_in("start", value, "m") for value in arguments.listed(arguments.quantity, "x and y")("start", start)
    ]
    if len(place) != 2:
        raise InputError(f"start: takes x and y [m]; {excerpt(start)} was given")
    if any(one < 0 for one in gaps):
        raise InputError("gap: takes distances of at least 0; frames that overlap cannot be linked")
    # Separate copies: several names may share one object.
    placed = {name: copy.deepcopy(words) for name, words in structures.items()}
    faces = [_face(name, words) for name, words in placed.items()]
    between = [one + face + following for one, face, following in zip(gaps, faces, faces[1:])]
    for name, following in zip(placed, [*between, 0.0]):
        frame = _frame(name, placed[name])
        is_plane = not _is_spatial(frame)
        if is_plane and along == "y":
            raise InputError(f"structures.{name}: is a plane frame, which can be placed in rows along x only")
        height = list(frame.pop("origin", ()))[1 if is_plane else 2 :]
        own = _extent(name, placed[name])
        corner = [place[0] - own.x0, place[1] - own.y0][: 1 if is_plane else 2]
        if align == "high" and not is_plane:
            corner[1 - axis] -= (own.width, own.depth)[1 - axis]
        frame["origin"] = [*(round(value, DECIMALS) for value in corner), *height]
        place[axis] += (own.width, own.depth)[axis] + following
    return placed


def _each(gap: Any, count: int) -> list[Any]:
    if isinstance(gap, str) or not isinstance(gap, Sequence):
        return [gap] * max(count, 0)
    if len(gap) != count:
        raise InputError(
            f"gap: takes one gap, or a list of {count}, one after each frame but the last; {len(gap)} were given"
        )
    return list(gap)


def _frame(name: str, words: Any) -> dict[str, Any]:
    frame = words.get("frame") if isinstance(words, Mapping) else None
    if isinstance(frame, dict):
        for key, kind in (("grid", Mapping), ("nodes", Mapping), ("origin", Sequence)):
            if key in frame and not isinstance(frame[key], kind):
                raise arguments.refuse(
                    f"structures.{name}.frame.{key}", "a map" if kind is Mapping else "a list", frame[key]
                )
        for node, position in frame.get("nodes", {}).items():
            if isinstance(position, str) or not isinstance(position, Sequence) or len(position) not in (2, 3):
                raise arguments.refuse(f"structures.{name}.frame.nodes.{node}", "two or three coordinates", position)
    if not isinstance(frame, dict):
        raise InputError(f'structures.{name}: has no place in plan; only frames have: {{"frame": {{...}}}}')
    return frame


def _face(name: str, words: Mapping[str, Any]) -> float:
    """Distance from the axes of a frame to its faces [m]; the key may be next to the frame or inside."""
    frame = _frame(name, words)
    face = words.get("face", frame.get("face", 0.0))
    if face == "auto":
        raise InputError(
            f'structures.{name}.face: a row needs the distance from the axes to the faces; type "0.3 m" instead of auto'
        )
    return number_in(f"structures.{name}.face", face, "m")


def _is_spatial(frame: Mapping[str, Any]) -> bool:
    """True if the grid has bays along x and y, or nodes have three coordinates. The origin of a plane frame is [x,
    z]."""
    bays = frame.get("grid", {}).get("bays")
    return isinstance(bays, (list, tuple)) or any(len(position) == 3 for position in frame.get("nodes", {}).values())


def _extent(name: str, words: Any) -> Extent:
    frame = _frame(name, words)
    origin = [
        *(number_in(f"structures.{name}.frame.origin", value, "m") for value in frame.get("origin", ())),
        0.0,
        0.0,
    ]
    if not _is_spatial(frame):
        origin[1] = 0.0
    points = [(0.0, 0.0), _size(f"structures.{name}.frame.grid", frame["grid"])] if "grid" in frame else []
    for node, position in frame.get("nodes", {}).items():
        values = [number_in(f"structures.{name}.frame.nodes.{node}", value, "m") for value in position]
        points.append((values[0], values[1] if len(values) == 3 else 0.0))
    if not points:
        raise InputError(f"structures.{name}.frame: has neither grid nor nodes, and so no size in plan")
    x, y = [value + origin[0] for value, _ in points], [value + origin[1] for _, value in points]
    return Extent(*(round(value, DECIMALS) for value in (min(x), max(x), min(y), max(y))))


def _size(place: str, grid: Mapping[str, Any]) -> tuple[float, float]:
    """Width and depth of a grid [m]; a plane one has no depth."""
    bays, width = grid.get("bays"), grid.get("bay_width")
    if bays is None or width is None:
        raise InputError(f'{place}: its size needs bays and bay_width, as in "bays": [3, 2], "bay_width": "6 m"')
    counts = list(bays) if isinstance(bays, Sequence) and not isinstance(bays, str) else [bays]
    if not counts:
        raise InputError(
            f"{place}.bays: takes a number of bays, or one along x and one along y; an empty list was given"
        )
    sizes = []
    for count, axis in zip(counts, "xy"):
        if isinstance(width, Mapping) and axis not in width:
            raise InputError(f"{place}.bay_width: has no {axis}, and there are bays along {axis}")
        count = arguments.whole(1, 100_000)(f"{place}.bays", count)
        own = width[axis] if isinstance(width, Mapping) else width
        widths = own if isinstance(own, Sequence) and not isinstance(own, str) else [own] * int(count)
        sizes.append(sum(number_in(f"{place}.bay_width", value, "m") for value in widths))
    return sizes[0], sizes[1] if len(sizes) > 1 else 0.0
