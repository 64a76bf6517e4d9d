"""The finding of a run in one or two sentences."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from pounding._comparison import worst
from pounding._report.blocks import number

#: Names of the kinds of a force component, by its first letter.
FORCES = {"N": "axial force", "V": "shear", "M": "moment", "T": "torsional moment"}
#: Smallest increase that the verdict mentions.
NOTABLE = 1.05


def verdict(summary: dict[str, Any]) -> str:
    """The verdict of the object of `pounding run --json`: sufficiency of the gap, and the worst consequence of
    contact."""
    status = summary.get("status", "")
    if status.startswith("failed"):
        return f"No verdict, because the run failed: {status.partition(': ')[2] or 'the reason is not known'}."
    if status == "running":
        return "No verdict, because the run is not complete."
    sentences = [_gap(summary)]
    if worst := _worst(summary):
        sentences[0] = f"{sentences[0]}; {worst}"
    if status.startswith("done: "):
        sentences.insert(0, f"The run ended by {status[len('done: ') :]}")
    alone = (summary.get("no_pounding") or {}).get("status", "done")
    if alone.startswith("done: "):
        sentences.append(f"Without links the run ended by {alone[len('done: ') :]}")
    return " ".join(f"{one[:1].upper()}{one[1:]}." for one in sentences)


def _gap(summary: dict[str, Any]) -> str:
    """The clause on gaps and impacts."""
    links = summary.get("links", [])
    if not links:
        return "the model has no links, so nothing can collide"
    count = sum(one["impacts"] for one in links)
    separations = (summary.get("no_pounding") or {}).get("separations", [])
    if separations and all(one["enough"] is None for one in separations):
        return f"{_impacts(count)}; no gap is sufficient, because the structures do not survive without links"
    known = [one for one in separations if one["enough"] is not None]
    if not known:
        if count == 0:
            return "no contact: no link closes"
        where = max(links, key=lambda one: one["peak_force"] or 0)
        force = (
            f", largest force {number(where['peak_force'], 1e3)} kN at {where['name']}" if where["peak_force"] else ""
        )
        return f"contact: {_impacts(count)}{force}; type compare: no_pounding for the sufficient gap"
    # The link with the largest difference between the sufficient and the present gap.
    lacking = max(known, key=lambda one: one["enough"] - one["gap"])
    gap, needed, place = (
        f"{number(lacking['gap'], 1e-3)} mm",
        f"{number(lacking['enough'], 1e-3)} mm",
        f" at {lacking['link']}" if len(links) > 1 else "",
    )
    if count == 0:
        return f"no contact: {gap} is enough{place}, {needed} needed"
    if lacking["enough"] <= lacking["gap"]:
        return f"contact: {_impacts(count)}, although {gap} is enough{place} without contact"
    return f"{gap} is not enough{place}: {needed} needed"


def _impacts(count: int) -> str:
    return "no impacts" if count == 0 else "1 impact" if count == 1 else f"{count} impacts"


def _worst(summary: dict[str, Any]) -> str:
    """The member and the yielding part with the largest increase by contact; empty if nothing increases notably."""
    clauses = [member_clause(row) for row in worst(summary, "members")[:1] if _value(row["ratio"]) > NOTABLE]
    for row in worst(summary, "hinges")[:1]:
        pair = row["ductility"]
        if _value(pair["ratio"]) > NOTABLE:
            ductility = f"ductility {number(pair['with'])} with contact and {number(pair['without'])} without"
            clauses.append(f"{row['part']} of {row['structure']} has {ductility}")
    return "; ".join(clauses) or _worst_floor(summary.get("comparison") or {})


def member_clause(row: Mapping[str, Any]) -> str:
    """The increase of the force of a member by contact."""
    kind = FORCES.get(row["component"][:1], row["component"])
    return f"{row['member']} of {row['structure']} carries {number(row['ratio'])} times its {kind} without contact"


def _worst_floor(comparison: dict[str, Any]) -> str:
    """The storey with the largest increase of drift, for structures without members; empty if none increases."""
    rows = [(name, row) for name, one in comparison.items() for row in one.get("drift", [])]
    if not rows:
        return ""
    name, row = max(rows, key=lambda one: _value(one[1]["ratio"]))
    if _value(row["ratio"]) <= NOTABLE:
        return ""
    return f"storey {row['floor']} of {name} drifts {number(row['ratio'])} times as far as without contact"


def _value(number: float | None) -> float:
    return number if number is not None and math.isfinite(number) else 0.0
