"""The table that `pounding separation` prints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from pounding._studies.reading import shortened

#: Maximum number of levels that are printed without --levels.
_LEVELS = 12


def table_of(found: Mapping[str, Any], with_levels: bool = False) -> str:
    """The table to print, in mm."""
    return "\n".join(
        [
            *_records(found),
            *_quantiles(found),
            *_levels(found, with_levels),
            *_codes(found, with_levels),
            *_notes(found),
        ]
    )


def _mm(value: float | None, width: int = 9) -> str:
    return f"{'-':>{width}}" if value is None else f"{1e3 * value:{width}.1f}"


def _width(found: Mapping[str, Any]) -> int:
    # The number of a sample ends its name.
    return min(60, max(28, *(len(one["record"]) for one in found["records"])))


def _records(found: Mapping[str, Any]) -> Iterator[str]:
    width = _width(found)
    yield f"{'record':<{width}} needed (mm)       ABS      SRSS       DDC"
    for one in found["records"]:
        yield f"{one['record'][:width]:<{width}}   {_mm(one['required'])} {_mm(one['abs'])} {_mm(one['srss'])} {_mm(one['ddc'])}"
    mean = found["mean"]
    yield f"{'mean of the rules':<{width}}   {'':>9} {_mm(mean['abs'])} {_mm(mean['srss'])} {_mm(mean['ddc'])}"


def _quantiles(found: Mapping[str, Any]) -> Iterator[str]:
    width, count = _width(found), len(found["records"])
    for kind, text in (("required", "enough for {} of records"), ("contact", "for {} probability of contact")):
        for percent, one in found[kind].items():
            band = f"(90 % band {_mm(one['low']).strip()} to {_mm(one['high']).strip()}"
            if one["high"] is None and one["gap"] is not None:
                band += f"; an upper bound needs {one['records_for_band']} records instead of {count}"
            yield f"{text.format(percent):<{width}}   {_mm(one['gap'])}   {band})"


def _levels(found: Mapping[str, Any], every: bool) -> Iterator[str]:
    levels: Sequence[Mapping[str, Any]] = found["levels"]
    ordered = sorted(levels, key=lambda one: -(one["required"] or 0.0))
    shown = levels if every or len(levels) <= _LEVELS else ordered[:_LEVELS]
    width = max([12, *(len(one["link"]) for one in shown)])
    yield f"\n{'level (link)':<{width}} height (m)  gap (mm)    needed   left mean   largest  right mean   largest"
    for one in shown:
        height = "-" if one["height"] is None else f"{one['height']:.2f}"
        yield (
            f"{one['link']:<{width}} {height:>10} {_mm(one['gap'])} {_mm(one['required'])}   {_mm(one['left_mean'])} "
            f"{_mm(one['left_largest'])}   {_mm(one['right_mean'])} {_mm(one['right_largest'])}"
        )
    if len(shown) < len(levels):
        yield f"{len(levels) - len(shown)} further levels need less; --levels prints them"


def _codes(found: Mapping[str, Any], with_levels: bool) -> Iterator[str]:
    is_line = found["property"] == "line"
    pairs = [f"{pair['left']}-{pair['right']}" for code in found["codes"] for pair in code["pairs"]]
    width, names = max([8, *map(len, pairs)]), max([4, *(len(code["code"]) for code in found["codes"])])
    clauses = max([6, *(len(code["clause"]) for code in found["codes"])])
    kind = "setback of each structure from a property line" if is_line else "structures on one property"
    yield f"\nrules of codes; {kind}; {found['displacements']} displacements"
    yield f"{'code':<{names}}  {'clause':<{clauses}}  {'pair':<{width}}  gap (mm)  from"
    for code in found["codes"]:
        for pair in code["pairs"]:
            yield (
                f"{code['code']:<{names}}  {code['clause']:<{clauses}}  {pair['left'] + '-' + pair['right']:<{width}} "
                f"{_mm(pair['gap'])}  {'; '.join(_reasons(code, pair))}"
            )
            for one in pair["levels"] if with_levels else ():
                yield f"{'':<{names}}  {'':<{clauses}}  {one['link']:<{width}} {_mm(one['gap'])}"


def _reasons(code: Mapping[str, Any], pair: Mapping[str, Any]) -> Iterator[str]:
    if pair["missing"]:
        yield pair["missing"]
    elif pair["gap"] is None:
        yield "no gap is enough after a collapse"
    else:
        yield code["statistic"]
        if "setbacks" in pair:
            yield ", ".join(f"{name} {_mm(value, 0)}" for name, value in pair["setbacks"].items())
        if pair["factor"] != 1:
            yield f"factor {pair['factor']:.3g}, floors {'aligned' if pair['aligned'] else 'offset'}"
        if len(pair["levels"]) > 1:
            yield f"governed by {pair['governs']}"
        if pair["note"]:
            yield pair["note"]
    yield from code["warnings"]
    if code["mark"]:
        yield code["mark"]


def _notes(found: Mapping[str, Any]) -> Iterator[str]:
    if found["collapsed"]:
        yield (
            f"Without links {len(found['collapsed'])} of {len(found['records'])} records cause a collapse "
            f"({shortened(found['collapsed'])}): no gap is enough for them, and the rules have no mean."
        )
    if found["displacements"] == "reduced":
        yield "Reduced displacements are multiplied by the factors of each code."
    else:
        yield (
            "Displacements are those of the model under the records; no behaviour factor multiplies them. Those of "
            "elastic structures stand for yielding ones by the equal displacement rule, except at short periods."
            if found["displacements"] == "elastic"
            else "Displacements are those of the model under the records; no behaviour factor multiplies them."
        )
    if any(code["mark"] for code in found["codes"]):
        yield "Check the edition: the text of this clause was not read in its source. The page Codes lists the sources."
    yield found["bridges"]
