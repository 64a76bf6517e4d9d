"""`python3 -m pounding plot|animate|export|modes ...`: the parts of the program that draw and convert."""

from __future__ import annotations

import importlib
import sys

MODULES = {"plot": "plots", "animate": "animation", "export": "export", "modes": "mode_shapes"}


def main(arguments: list[str]) -> int:
    """Hands the rest of the command line to one module. Returns its code, or 2 after a message."""
    if not arguments or arguments[0] not in MODULES:
        print(f"type python3 -m pounding {'|'.join(MODULES)} --help", file=sys.stderr)
        return 2
    return importlib.import_module(f"pounding.{MODULES[arguments[0]]}").main(arguments[1:])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
