"""Rankings of members and yielding parts by their responses with and without links (`compare: no_pounding`)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pounding._arguments import one_of

#: Length of a ranking.
WORST = 5


def worst(summary: Mapping[str, Any], kind: str = "members", by: str = "ratio") -> list[dict[str, Any]]:
    """The five worst members or hinges of all structures.

    Parameters
    ----------
    summary : mapping
        The object of `pounding run --json`, of a run with `compare: no_pounding`.
    kind : str
        "members", or "hinges", which includes yielding storeys, isolators and devices.
    by : str
        "ratio", response with links over that without, or "demand", with links: of members the force relative to the
        largest of its component in the structure, of hinges the ductility.

    Returns
    -------
    list of dict
        Rows with `structure` and the keys of the object; empty without a comparison.

    Raises
    ------
    InputError
        `kind` or `by` is another one.
    """
    one_of(("members", "hinges"))("kind", kind)
    one_of(("ratio", "demand"))("by", by)
    rows = [
        {"structure": name, **row}
        for name, one in (summary.get("comparison") or {}).items()
        for row in (one.get(kind) or {}).get(f"by_{by}", [])
    ]
    return sorted(rows, key=lambda row: -(measure(row, by) or 0))[:WORST]


def measure(row: Mapping[str, Any], by: str) -> float | None:
    """The number that ranks a row; None if a run ended early or nothing moved without links."""
    if "ductility" in row:
        return row["ductility"]["ratio" if by == "ratio" else "with"]
    return row[by]
