"""Response quantities of rows; names and units are those in the summary of a run."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding._native import core
from pounding._studies import reading, structure_values
from pounding._studies.functions import Function, functions_of
from pounding._studies.structure_values import number as _number
from pounding.errors import InputError

#: Quantities of structures, also of one floor, part or member.
OF_STRUCTURES = structure_values.UNITS
#: Quantities of all links, or of one as in force.left-right.
OF_LINKS = {"force": "N", "penetration": "m", "impacts": "", "impulse": "N s", "energy_lost": "J"}
#: Largest opening of all links, or of one as in opening.joint.
OF_OPENINGS = {"opening": "m"}
#: From the run without links: the required gap, gaps by rules, and the peak displacements of the ends of a link along
#: it. The largest of all links, or of one as in required_gap.left-right.
OF_GAPS = {"required_gap": "m", "gap_abs": "m", "gap_srss": "m", "gap_ddc": "m", "end_left": "m", "end_right": "m"}
UNITS = {**OF_STRUCTURES, **OF_LINKS, **OF_OPENINGS, **OF_GAPS}
_EXAMPLES = {
    "rad": "0.005",
    "m": "30 mm",
    "m/s^2": "0.5 g",
    "N": "5 MN",
    "N m": "500 kN m",
    "N s": "200 kN s",
    "J": "50 kJ",
    "": "3",
}
_KEYS = {
    "force": "peak_force",
    "penetration": "peak_penetration",
    "opening": "largest_opening",
    "required_gap": "enough",
    "gap_abs": "abs",
    "gap_srss": "srss",
    "gap_ddc": "ddc",
    "end_left": "left",
    "end_right": "right",
}
SUMS = ("impacts", "impulse", "energy_lost")
DEFAULT = ("displacement", "force", "impacts")
#: Derived column: 1 in collapsed rows, 0 in others.
COLLAPSED_COLUMN = "collapsed"
#: A bare number up to this one may be a ratio to the storey height.
LARGEST_DRIFT_RATIO = 0.1
#: Implausible limits in SI: SI unit -> range of bare numbers, and the unit that was probably intended.
_DOUBTFUL = {
    "m/s^2": (0.02, 1.5, "g"),
    "m": (1.0, math.inf, "mm"),
    "N": (0.0, 1e3, "kN"),
    "N s": (0.0, 10.0, "kN s"),
    "J": (0.0, 10.0, "kJ"),
}


@dataclass(frozen=True)
class Kept:
    """The columns of a row, and the limits of quantities."""

    columns: tuple[str, ...]  #: "displacement.left", "displacement.left.alone", "force", "required_gap"
    limits: tuple[tuple[str, float], ...] = ()
    functions: tuple[Function, ...] = ()  #: of Python, with their columns

    @property
    def needs_comparison(self) -> bool:
        """True if a column needs the run without links."""
        return any(column.split(".")[0] in OF_GAPS or column.endswith((".alone", ".ratio")) for column in self.columns)

    def units(self) -> dict[str, str]:
        """SI units of the columns."""
        units = {column: unit for function in self.functions for column, unit in function.units.items()}
        return {column: units.get(column, "") if column in units else _unit(column) for column in self.columns}

    def of(self, summary: Mapping[str, Any]) -> list[float]:
        """The columns from the summary of a run. After a collapse they are infinite; a ratio is NaN unless both runs
        are complete, and the force of rigid impacts is NaN."""
        own = {name: value for function in self.functions for name, value in function.of(summary).items()}
        return [
            own[column] if column in own else _after_collapse(column, _value(column, summary), summary)
            for column in self.columns
        ]

    @property
    def needs_whole(self) -> bool:
        """True if a column needs the complete summary of a run."""
        whole = structure_values.OF_WHOLE
        return bool(self.functions) or any(column.split(".")[0] in whole for column in self.columns)

    def for_solver(self) -> str:
        """The first column that the kernel does not compute; empty if there is none."""
        if self.functions:
            return f"the function {self.functions[0].name}"
        kernel = (*structure_values.OF_KERNEL, *OF_LINKS, *OF_GAPS)
        return next((column for column in self.columns if column.split(".")[0] not in kernel), "")

    def description(self) -> dict[str, Any]:
        """The columns and limits, for comparisons of plans."""
        functions = {"functions": [function.description() for function in self.functions]} if self.functions else {}
        return {"columns": self.columns, "limits": self.limits, **functions}

    def exceeded(self, values: np.ndarray) -> np.ndarray:
        """[row] True if [row, column] exceeds a limit; a limit of drift applies to every structure."""
        found = np.zeros(len(values), bool)
        for i, limit in self._limited():
            found |= values[:, i] > limit
        return found

    def undefined_limits(self, values: np.ndarray) -> list[str]:
        """Columns with a limit that are NaN in any row of [row, column]."""
        return [self.columns[i] for i, _ in self._limited() if np.isnan(values[:, i]).any()]

    def _limited(self) -> list[tuple[int, float]]:
        """Index and limit of the columns with a limit."""
        return [
            (i, limit)
            for quantity, limit in self.limits
            for i, column in enumerate(self.columns)
            if column == quantity or column.startswith(quantity + ".") and not column.endswith((".alone", ".ratio"))
        ]


def read_keep(given: Any, without_links: bool, layout: core.Layout, limits: tuple[tuple[str, float], ...]) -> Kept:
    """The columns of `keep:` for rows with this layout. Raises InputError, also for quantities that the rows do not
    have."""
    structures = {one.name: one for one in layout.structures}
    rigid = {name for name, is_rigid in layout.links if is_rigid}
    links = [name for name, _ in layout.links]
    default = [{"force": "impulse"}.get(quantity, quantity) if rigid else quantity for quantity in DEFAULT]
    functions, typed = functions_of(given)
    asked = default if given is None else [given] if isinstance(given, str) else [str(one) for one in typed]
    columns: list[str] = []
    for place, word in [("keep", word) for word in asked] + [
        ("limits", word) for word, _ in limits if word not in asked
    ]:
        if (place, word) == ("keep", COLLAPSED_COLUMN):
            continue  # in every table
        quantity, _, name = word.partition(".")
        if quantity not in UNITS:
            raise InputError(
                f'study.{place}: unknown quantity "{word}".{reading.did_you_mean(quantity, UNITS)} Allowed: {", ".join(UNITS)}'
            )
        if quantity in OF_STRUCTURES:
            for column in structure_values.columns_of(word, structures, f"study.{place}"):
                columns += [column]
                columns += [f"{column}.alone", f"{column}.ratio"] if without_links else []
        else:
            _require_links(quantity, name, links, rigid, f"study.{place}")
            columns.append(word)
    return Kept(tuple(dict.fromkeys(columns)), limits, functions)


def _unit(column: str) -> str:
    """SI unit of a column."""
    quantity = column.partition(".")[0]
    if column.endswith(".ratio"):
        return ""
    return structure_values.unit_of(column) if quantity in OF_STRUCTURES else UNITS[quantity]


def _require_links(quantity: str, name: str, links: Sequence[str], rigid: set[str], place: str) -> None:
    """Raises InputError if links do not have a quantity."""
    if name and name not in links:
        raise InputError(
            f'{place}: unknown link "{name}".{reading.did_you_mean(name, links)} Known: {", ".join(links) or "none"}'
        )
    if quantity in OF_OPENINGS and not links:
        raise InputError(f"{place}: {quantity} is that of a link, and the model has none; add a link")
    if quantity in OF_GAPS and not links:
        raise InputError(
            f"{place}: {quantity} is the gap of a link, and the model has none; add one, whose law is not used"
        )
    wrong = [each for each in links if each in rigid and name in ("", each)]
    if quantity == "force" and wrong:
        suffix = f".{name}" if name else ""
        others = [each for each in links if each not in rigid]
        raise InputError(
            f"{place}: force{suffix}: link {wrong[0]} has a rigid law, whose impacts have no finite force; keep impulse{suffix} instead"
            + (f", or force.{others[0]}" if others and not name else "")
        )


def bare_limit_warning(place: str, value: Any, unit: str, column: str = "") -> str:
    """Warning for a limit without a unit that is usual in another unit, or for a drift that may be a ratio; empty if
    there is none."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        return ""
    if (
        isinstance(value, str)
        and column.partition(".")[0] == "drift"
        and not column.endswith(".ratio")
        and 0 < number <= LARGEST_DRIFT_RATIO
    ):
        return f"{place}: a bare {number:g} is in m; the drift of a study is a length, not a ratio to the storey height. Type its unit, as in {1e3 * number:g} mm"
    lowest, highest, other = _DOUBTFUL.get(unit, (math.nan, math.nan, ""))
    if not lowest < number < highest:
        return ""
    return f"{place}: a bare {number:g} is in {unit}; if {number:g} {other} was meant, type its unit"


def read_limits(given: Mapping[str, str]) -> tuple[tuple[str, float], ...]:
    """Limits, as in {drift: 30 mm, force: 2 MN}. Raises InputError."""
    found = []
    for word, value in given.items():
        quantity = word.partition(".")[0]
        if quantity not in UNITS:
            raise InputError(
                f'study.limits: unknown quantity "{word}".{reading.did_you_mean(quantity, UNITS)} Allowed: {", ".join(UNITS)}'
            )
        number, unit = reading.quantity(value, f"study.limits.{word}")
        if not math.isfinite(number):
            raise InputError(f"study.limits.{word}: takes a finite number; {value} was read")
        if quantity in structure_values.OF_MEMBERS and len(word.split(".")) < 3:
            raise InputError(
                f"study.limits.{word}: forces and moments have different limits; name the component, as in {word if '.' in word else f'{word}.NAME'}.My: 500 kN m"
            )
        if isinstance(value, str) and not unit and "%" in value and quantity not in ("drift_ratio", "ductility"):
            raise InputError(
                f"study.limits.{word}: the {quantity} of a summary is in {_unit(word) or 'numbers'}; type a value such as {_EXAMPLES[_unit(word)]} instead of {value}"
            )
        reading.require_unit(unit, _unit(word), f"study.limits.{word}", _EXAMPLES[_unit(word)])
        found.append((word, number))
    return tuple(found)


def contents(layout: core.Layout) -> dict[str, Any]:
    """Structures with their floors, members and parts, and links with their quantities, for the table of a suite."""
    structures = [
        {
            "name": one.name,
            "floors": one.floors,
            "heights": list(one.heights),
            "quantities": [quantity for quantity in structure_values.OF_FLOORS if structure_values.has(quantity, one)],
            "members": list(one.members),
            "components": structure_values.kinds_of(one.components),
            "parts": list(one.parts),
            "hinges": list(one.hinges),
        }
        for one in layout.structures
    ]
    links = [
        {
            "name": name,
            "quantities": [quantity for quantity in (*OF_LINKS, *OF_OPENINGS) if quantity != "force" or not is_rigid],
        }
        for name, is_rigid in layout.links
    ]
    return {"structures": structures, "links": links}


def every_column(layout: core.Layout, without_links: bool) -> tuple[str, ...]:
    """The columns of a suite; with those of the run without links if `without_links`."""
    found: list[str] = []
    for one in layout.structures:
        own = structure_values.columns_of_parts(one)
        found += own + ([f"{column}.alone" for column in own] if without_links else [])
    found += [f"{quantity}.{link['name']}" for link in contents(layout)["links"] for quantity in link["quantities"]]
    return (*found, "required_gap") if without_links and layout.links else tuple(found)


def collapse_of(summary: Mapping[str, Any]) -> str:
    """Place and time of the collapse that ended a run, from its status; empty without a collapse."""
    status = str(summary.get("status", ""))
    return status.removeprefix("done: ") if status.startswith("done: ") else ""


def _after_collapse(column: str, value: float, summary: Mapping[str, Any]) -> float:
    collapsed, alone_collapsed = bool(collapse_of(summary)), bool(collapse_of(summary.get("no_pounding") or {}))
    if column.endswith(".ratio"):
        return math.nan if collapsed or alone_collapsed else value
    is_alone = column.endswith(".alone") or column.split(".")[0] in OF_GAPS
    return math.inf if (alone_collapsed if is_alone else collapsed) else value


def _value(column: str, summary: Mapping[str, Any]) -> float:
    quantity, _, rest = column.partition(".")
    if quantity in OF_STRUCTURES:
        return structure_values.value(column, summary)
    if quantity in OF_GAPS:
        ends = summary["no_pounding"]["separations"]
        found = [_number(one[_KEYS[quantity]]) for one in ends if not rest or one["link"] == rest]
        return math.nan if any(map(math.isnan, found)) else max(found, default=0.0)
    links = [one for one in summary["links"] if not rest or one["name"] == rest]
    if rest and not links:
        raise InputError(
            f'study.keep: unknown link "{rest}"; known: {", ".join(one["name"] for one in summary["links"])}'
        )
    values = [_number(one[_KEYS.get(quantity, quantity)]) for one in links]
    # fsum: the result does not depend on the order of the links.
    if quantity in SUMS:
        return math.fsum(values)
    return math.nan if any(map(math.isnan, values)) else max(values, default=0.0)
