"""`pounding separation` and `pounding screen`."""

from __future__ import annotations

import argparse
import json
from typing import Any

from pounding._studies.options import at_least, warn
from pounding.errors import InputError


def separation(words: list[str]) -> int:
    """Runs `pounding separation`. Returns 0; raises the errors of a separation."""
    from pounding._studies.separation import percentage, read_separation, run_separation
    from pounding._studies.separation_table import table_of

    parser = argparse.ArgumentParser(
        prog="pounding separation", description="Compute the gap required by records and by the rules of codes."
    )
    parser.add_argument("model", help="model file, with or without study: {records: ..., separation: ...}")
    parser.add_argument("--records", nargs="+", help="files of records, or a folder, instead of the model's motion")
    parser.add_argument("--code", action="append", help="only this code, such as EN; may be repeated")
    parser.add_argument(
        "--property", choices=("same", "line"), help="line: a property line between the structures (default: same)"
    )
    parser.add_argument(
        "--displacements",
        choices=("nonlinear", "elastic", "reduced"),
        help="reduced: from motions divided by a behaviour factor, which the codes multiply back",
    )
    parser.add_argument("--floors", choices=("aligned", "offset"), help="floors of neighbours without elevations")
    parser.add_argument("--similar", action="store_true", default=None, help="neighbours of similar structure")
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="input of the codes, such as q=3, or left.R=8 for one structure; may be repeated",
    )
    parser.add_argument("--quantile", action="append", default=[], help='gap for a fraction of the records: "95 %%"')
    parser.add_argument(
        "--probability", action="append", default=[], help='gap for a target probability of contact: "10 %%"'
    )
    parser.add_argument("--levels", action="store_true", help="also print the gaps of the codes at every level")
    parser.add_argument("-j", "--workers", type=at_least(0), help="processes (default: one per core)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(words)
    keys = {"codes": options.code, **_inputs(options.set)}
    keys |= {key: getattr(options, key) for key in ("property", "displacements", "floors", "similar")}
    plan, request = read_separation(
        options.model,
        options.records,
        {key: value for key, value in keys.items() if value is not None},
        [percentage("--quantile", one) for one in options.quantile],
        [percentage("--probability", one) for one in options.probability],
    )
    warn(plan)
    found = run_separation(plan, request, options.workers)
    print(json.dumps(found) if options.json else table_of(found, options.levels))
    return 0


def _inputs(words: list[str]) -> dict[str, Any]:
    """Keys `behaviour` and `structures` from options such as q=3 and left.R=8."""
    found: dict[str, Any] = {}
    for word in words:
        name, equals, value = word.partition("=")
        structure, _, key = name.rpartition(".")
        if not equals or not key or not value:
            raise InputError(f'--set takes KEY=VALUE, such as q=3 or left.R=8; "{word}" was read')
        place = found.setdefault("structures", {}).setdefault(structure, {}) if structure else None
        (found.setdefault("behaviour", {}) if place is None else place)[key] = value
    return found


def screening(words: list[str]) -> int:
    """Runs `pounding screen`. Returns 0; raises InputError."""
    from pounding._codes.screening import SEISMICITIES
    from pounding._screening import screen, table_of

    parser = argparse.ArgumentParser(
        prog="pounding screen", description="Screen the gaps of a model by rules for existing buildings, without a run."
    )
    parser.add_argument("model", help="model file")
    parser.add_argument("--seismicity", choices=SEISMICITIES, default="high", help="of the site (default: high)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(words)
    found = screen(options.model, options.seismicity)
    print(json.dumps(found) if options.json else table_of(found))
    return 0
