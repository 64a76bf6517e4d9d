"""Rules of codes for the gap between structures: one module per code, with the rule as data in `RULE`."""

from __future__ import annotations

import importlib
from collections.abc import Sequence

from pounding._codes.rule import Rule
from pounding.errors import InputError

_MODULES = (
    "asce_7_16",
    "asce_7_22",
    "en_1998_1",
    "ntc_2018",
    "tbdy_2018",
    "is_1893",
    "gb_50011",
    "nzs_1170_5",
    "nbcc",
    "e_030",
    "nsr_10",
    "ntc_sismo",
    "standard_2800",
)

#: Bridges, whose rules are not evaluated.
BRIDGES = (
    "Seats and joints of bridges (EN 1998-2, 6.6.4; AASHTO) also need half of the thermal and the ground displacement; "
    "they are not evaluated. Check the edition."
)


def rules() -> tuple[Rule, ...]:
    """Rules of all codes."""
    return tuple(importlib.import_module(f"pounding._codes.{name}").RULE for name in _MODULES)


def chosen(names: Sequence[str]) -> tuple[Rule, ...]:
    """Rules whose names start with one of these texts, all without texts. Raises InputError for an unknown name."""
    every = rules()
    for name in names:
        if not any(_starts(rule, name) for rule in every):
            raise InputError(f'unknown code "{name}"; allowed: {", ".join(rule.name for rule in every)}')
    return tuple(rule for rule in every if not names or any(_starts(rule, name) for name in names))


def _starts(rule: Rule, name: str) -> bool:
    return bool(name.strip()) and rule.name.lower().startswith(name.strip().lower())
