"""Options of the commands of studies: their arguments for argparse, types of values, and warnings."""

from __future__ import annotations

import argparse
import math
import re
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pounding._checked_file import STUDY
from pounding._outputs import destination
from pounding._studies.plan import Plan
from pounding.errors import ImplausibleWarning, InputError


def at_least(least: int) -> Callable[[str], int]:
    """Type for argparse: integers with a lower bound."""

    def read(text: str) -> int:
        if not re.fullmatch(r"\+?[0-9]{1,18}", text) or int(text) < least:
            raise argparse.ArgumentTypeError(f'takes an integer of at least {least}, not "{text[:40]}"')
        return int(text)

    return read


def shard(text: str) -> tuple[int, int]:
    """Type for argparse: the number of a share and the number of shares."""
    number, _, count = text.partition("/")
    if not (number.isdigit() and count.isdigit() and 1 <= int(number) <= int(count)):
        raise argparse.ArgumentTypeError(f'"{text}" is not a shard; type K/N, as in 3/16')
    return int(number), int(count)


def percentage(text: str) -> float:
    """Type for argparse: 84, 84% or "84 %"."""
    try:
        value = float(text.replace("%", ""))
    except ValueError:
        value = math.nan
    if not 0 < value <= 100:
        raise argparse.ArgumentTypeError(f'takes a percentage such as 84, above 0 and at most 100, not "{text[:40]}"')
    return value


def value_of_factor(text: str) -> tuple[str, str]:
    """Type for argparse: gap=20mm."""
    name, sign, value = text.partition("=")
    if not sign or not name.strip() or not value.strip():
        raise argparse.ArgumentTypeError(f'takes a factor and its value, as in gap=20mm, not "{text[:40]}"')
    return name.strip(), value.strip()


_SHARED: dict[str, dict[str, Any]] = {
    "study": {"help": "study file"},
    "table": {"help": "table of a study"},
    "--workers": {"type": at_least(0), "help": "processes (default: one per core); 0 runs in this one"},
    "--percentile": {
        "type": percentage,
        "action": "append",
        "metavar": "P",
        "help": "percentile, repeatable (default: 16, 50 and 84; 50 for a map, which has one)",
    },
    "--where": {
        "type": value_of_factor,
        "action": "append",
        "default": [],
        "metavar": "FACTOR=VALUE",
        "help": "only rows with this value of a factor, with a unit or a name: gap=20mm, law=hertz; repeatable",
    },
    "--limit": {"help": "limit of a fragility curve, with a unit or in the unit of the column: 5 MN"},
    "--json": {"action": "store_true", "help": "print one JSON object with all numbers in SI"},
    "--quiet": {"action": "store_true", "help": "print nothing"},
}
_SHORT = {"--workers": "-j", "--quiet": "-q"}


def add_shared(parser: argparse.ArgumentParser, *names: str) -> None:
    """Adds arguments that several commands have."""
    for name in names:
        parser.add_argument(*filter(None, (_SHORT.get(name), name)), **_SHARED[name])


def warn(plan: Plan) -> None:
    """Emits the warnings of a plan."""
    for doubt in plan.warnings:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=2)


def table_name(study: str, given: str | None) -> Path:
    """The given table, or the name of the study with .h5 in the current folder."""
    if given is None:
        return Path(Path(study).stem + ".h5")
    if not given:
        raise InputError("the name of the file is empty: -o needs one, such as -o study.h5")
    if Path(given).name in ("", ".."):
        raise InputError(f'cannot write "{given}": it is a directory. Name a file in it')
    if given.endswith("/"):
        destination(given, STUDY)
    return Path(given)
