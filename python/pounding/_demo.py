"""`pounding demo`, two frames in an artificial earthquake, and `pounding lessons`, which copies the models of the
lessons.

Both are part of the wheel; in a source folder they are in examples/."""

from __future__ import annotations

import argparse
import importlib.util
import os
import shutil
import sys
from pathlib import Path

from pounding.errors import InputError

_PLACES = (Path(__file__).parent / "lessons", Path(__file__).resolve().parents[2] / "examples")


def lessons() -> Path:
    """Folder of the lessons, each with a model and a page. Raises InputError if it does not exist."""
    for place in _PLACES:
        if (place / "demo/synthetic.yaml").is_file():
            return place
    raise InputError(
        f"the lessons are in none of {', '.join(map(str, _PLACES))}; the wheel that `make portable-wheel` builds brings them"
    )


def demo_words(arguments: list[str]) -> list[str]:
    """Arguments of the program for `pounding demo`. The run writes demo.h5, and demo.png if matplotlib is
    installed."""
    parser = argparse.ArgumentParser(
        prog="pounding demo",
        description="Two frames, 10 mm apart, through a synthetic earthquake of 30 s: prints the table, "
        "leaves demo.h5 and demo.png in this folder.",
    )
    parser.parse_args(arguments)
    words = ["run", str(lessons() / "demo/synthetic.yaml"), "-o", "demo.h5"]
    if importlib.util.find_spec("matplotlib"):
        return [*words, "--plot"]
    print(
        "pounding: warning: no demo.png without matplotlib; type python3 -m pip install matplotlib",
        file=sys.stderr,
        flush=True,
    )
    return words


def copy_lessons(arguments: list[str]) -> int:
    """`pounding lessons FOLDER`: copies the lessons. Returns 0."""
    parser = argparse.ArgumentParser(
        prog="pounding lessons", description="Copies the models of the lessons, each with its page."
    )
    parser.add_argument("folder", nargs="?", default="lessons", help="new folder (default: lessons)")
    folder = Path(parser.parse_args(arguments).folder)
    if folder.exists():
        raise InputError(f"{folder} exists already; name a folder that does not")
    for file in sorted(lessons().glob("*/*.yaml")):
        if not (file.parent / "README.md").is_file():  # a study with a page in the guide
            continue
        place = folder / file.parent.name
        place.mkdir(parents=True, exist_ok=True)
        for source in (file, file.parent / "README.md"):
            shutil.copy(source, place)
    count = sum(1 for model in folder.glob("[0-9]*/model.yaml"))
    print(
        f"lessons      {folder}{os.sep} ({count} models); the first one: pounding run {folder}/02_two_oscillators/model.yaml"
    )
    return 0
