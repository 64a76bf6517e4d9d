"""The command line of a script that makes pages: `SCRIPT SOURCE --write` or `SCRIPT SOURCE --check`."""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def arguments(description, source, meaning):
    """The path that was given, and whether to write (else to check). `source` is its name in the help, `meaning` what
    it is."""
    words = argparse.ArgumentParser(description=description.splitlines()[0])
    words.add_argument("source", metavar=source, type=Path, help=meaning)
    what = words.add_mutually_exclusive_group(required=True)
    what.add_argument("--write", action="store_true", help="write what is made")
    what.add_argument(
        "--check", action="store_true", help="compare with the existing pages; exit code 1 if they differ"
    )
    given = words.parse_args()
    return given.source.resolve(), given.write


def write_or_compare(folder, texts, pictures, write):
    """Writes `texts`, by name, and `pictures`, functions that draw to a path by name, into a folder; or refuses a
    folder that holds other texts or other names. Pictures are not compared."""
    if write:
        folder.mkdir(exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text)
        for name, draw in pictures.items():
            draw(folder / name)
        return
    there = {path.name for path in folder.iterdir()} if folder.exists() else set()
    wrong = sorted(name for name, text in texts.items() if name not in there or (folder / name).read_text() != text)
    wrong += sorted((set(pictures) - there) | (there - set(pictures) - set(texts)))
    if wrong:
        refuse(f"{folder.relative_to(ROOT)} is not what the program says: {', '.join(wrong)}.", "build/pounding")


def refuse(complaint, source):
    """Ends a failed check with the command that rewrites the page; `source` is the argument before --write."""
    sys.exit(f"{complaint}\nType: python3 {Path(sys.argv[0]).resolve().relative_to(ROOT)} {source} --write")
