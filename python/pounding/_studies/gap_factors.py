"""Factors for the gap of drawn frames: they move one of the two frames."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from pounding._native import core
from pounding._studies import reading
from pounding._studies.factors import Factor
from pounding.errors import InputError

#: First key of the path: gaps.left-right.
GAPS = "gaps"
#: Distance of the trial that finds the direction in which a frame moves [m].
TRIAL = 1e-3


class GapFactors:
    """The paths gaps.A-B of a study, as coordinates of the origins of frames."""

    def __init__(self, factors: Mapping[str, Any], parts: Mapping[str, Any], layout: Callable[[Any], core.Layout]):
        """Raises InputError for a path that is not the gap of two frames, or whose frames cannot be moved alone."""
        self.parts: dict[str, Any] = copy.deepcopy(dict(parts))  #: with the origins that are moved
        self.factors: dict[str, Any] = dict(factors)  #: with paths of origins
        self._moves: dict[str, tuple[float, float]] = {}
        for name, one in factors.items():
            paths = [one["of"]] if isinstance(one.get("of"), str) else one.get("of", [])
            if not any(path.partition(".")[0] == GAPS for path in paths):
                continue
            place = f"study.factors.{name}"
            if len(paths) != 1 or "times" in one or "alternatives" in one:
                raise InputError(
                    f"{place}: a gap of drawn frames is one path with values, as in of: {paths[0]}, list: [10 mm, 20 mm]; leave the other paths, times and alternatives out"
                )
            path, self._moves[name] = self._origin(paths[0].partition(".")[2], f"{place}.of", layout)
            self.factors[name] = {**one, "of": path}
        self._require_own_geometry()

    def applied(self, factor: Factor) -> Factor:
        """The factor with the line from gap to coordinate."""
        slope, shift = self._moves.get(factor.name, (1.0, 0.0))
        return replace(factor, slope=slope, shift=shift)

    def _origin(self, pair: str, place: str, layout: Callable[[Any], core.Layout]) -> tuple[str, tuple[float, float]]:
        """Path of the coordinate, and its slope and shift over the gap."""
        at_rest = layout(self.parts)
        pairs = list(dict.fromkeys(f"{a}-{b}" for a, b, _ in at_rest.ends))
        of_pair = [i for i, (a, b, _) in enumerate(at_rest.ends) if f"{a}-{b}" == pair]
        if not of_pair:
            raise InputError(
                f"{place}: no link is between {pair}.{reading.did_you_mean(pair, pairs)} Known: {', '.join(pairs) or 'none'}"
            )
        left, right, _ = at_rest.ends[of_pair[0]]
        structures = self.parts["structures"]
        frames = [one for one in (right, left) if isinstance(structures.get(one, {}).get("frame"), Mapping)]
        if len(frames) < 2:
            raise InputError(f"{place}: {pair} are not two frames; type the path of their gap, as in of: links.*.gap")
        # The frame without links to other structures.
        alone = [one for one in frames if all({a, b} == {left, right} for a, b, _ in at_rest.ends if one in (a, b))]
        if not alone:
            raise InputError(
                f"{place}: {left} and {right} have links to other structures, whose gaps would change as well; vary the coordinate of a frame, as in of: structures.{right}.frame.origin.0"
            )
        moved = alone[0]
        frame = structures[moved]["frame"]
        in_space = any(len(one.components) > 6 for one in at_rest.structures if one.name == moved)
        origin = frame.setdefault("origin", ["0 m"] * (3 if in_space else 2))
        gaps = [at_rest.ends[i][2] for i in of_pair]
        for axis in range(2 if in_space else 1):
            held = reading.quantity(origin[axis], f"structures.{moved}.frame.origin")[0]
            trial = copy.deepcopy(self.parts)
            # Away from the other frame: an overlap would be refused.
            for way in (1.0, -1.0):
                trial["structures"][moved]["frame"]["origin"][axis] = repr(held + way * TRIAL)
                try:
                    ends = layout(trial).ends
                except InputError:
                    continue
                if len(ends) != len(at_rest.ends):
                    continue
                changes = [(ends[i][2] - gap) / (way * TRIAL) for i, gap in zip(of_pair, gaps)]
                if all(abs(abs(change) - 1) < 1e-6 and change * changes[0] > 0 for change in changes):
                    slope = 1.0 if changes[0] > 0 else -1.0
                    return f"structures.{moved}.frame.origin.{axis}", (slope, held - slope * min(gaps))
        raise InputError(
            f"{place}: moving {moved} along one axis does not change all gaps of {pair} equally; vary a coordinate, as in of: structures.{moved}.frame.origin.0"
        )

    def _require_own_geometry(self) -> None:
        """Raises InputError if another factor changes the drawing, and with it the gap."""
        moved = {str(self.factors[name]["of"]).split(".")[1] for name in self._moves}
        for name, one in self.factors.items():
            paths = [one["of"]] if isinstance(one.get("of"), str) else one.get("of", [])
            for path in paths:
                keys = path.split(".")
                drawn = keys[:1] == ["structures"] and (
                    keys[2:3] == ["frame"] and (len(keys) < 4 or keys[3] in ("origin", "grid", "nodes", "face"))
                )
                if self._moves and name not in self._moves and drawn:
                    raise InputError(
                        f"study.factors.{name}.of: {path} changes the drawing, and with it the gap that moves {', '.join(sorted(moved))}; "
                        "leave out one of the two factors"
                    )
