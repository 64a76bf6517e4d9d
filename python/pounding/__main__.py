"""`python3 -m pounding ...` and the command `pounding` of the wheel: start the program in this package.

In a source folder, which has no program, only the Python commands plot, animate, view and export work."""

from __future__ import annotations

import importlib
import os
import sys
from pathlib import Path

from pounding._ended import exit_code
from pounding._working_folder import leave_working_folder_out

#: The program in the wheel and in the build tree.
PROGRAM = Path(__file__).parent / "bin/pounding"
MODULES = {"plot": "_plots", "animate": "animation", "view": "_view_command", "export": "_export"}
#: Commands that run in this process, also as a worker of mpi4py.futures.
STUDIES = ("study", "suite", "separation", "screen")


def main(arguments: list[str] | None = None) -> int:
    """Replaces this process by the program with these arguments, by default those of the command line.

    Without a program, runs the Python command. Returns its exit code, or 2 after a message. Raises InputError,
    OSError."""
    leave_working_folder_out()
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments and arguments[0] in STUDIES:
        return int(importlib.import_module("pounding._studies.command").main(arguments))
    if arguments and arguments[0] in ("demo", "lessons"):
        from pounding import _demo as demo

        if arguments[0] == "lessons":
            return demo.copy_lessons(arguments[1:])
        arguments = demo.demo_words(arguments[1:])
    if PROGRAM.is_file():
        # Pictures are drawn by this Python, which has the package.
        os.environ.setdefault("POUNDING_PYTHON", sys.executable)
        os.execv(PROGRAM, ["pounding", *arguments])
    if not arguments or arguments[0] not in MODULES:
        print(
            f"{PROGRAM} is missing, and without it there is only python3 -m pounding {'|'.join(MODULES)} --help. Type "
            "`python3 -m pip install .` in the source directory",
            file=sys.stderr,
        )
        return 2
    return importlib.import_module(f"pounding.{MODULES[arguments[0]]}").main(arguments[1:])


def command() -> int:
    """The command `pounding` of the wheel: exit codes and closed pipes as those of the program."""
    return exit_code(main)


if __name__ == "__main__":
    sys.exit(command())
