"""Runs the cells of a page of the site, including the hidden ones that check its numbers; no notebook is needed.

PYTHONPATH=build/python python3 tests/docs/tutorials.py python/docs/tutorials/one_impact.md
"""

import re
import sys
from pathlib import Path

import matplotlib

CELL = re.compile(r"(?ms)^```\{code-cell\}[^\n]*\n((?::[^\n]*\n)*)(.*?)^```$")


def main(page: Path) -> None:
    matplotlib.use("Agg")
    text, names = page.read_text(), {}
    cells = list(CELL.finditer(text))
    if not any("assert" in cell.group(2) for cell in cells):
        sys.exit(f"{page}: no cell checks a number")
    for cell in cells:
        # Empty lines, so that an error reports the line of the page.
        exec(compile("\n" * text.count("\n", 0, cell.start(2)) + cell.group(2), str(page), "exec"), names)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
