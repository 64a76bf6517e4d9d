#!/usr/bin/env python3
"""Collects a release: archives, checksums, and the notes of this version from CHANGELOG.md.

    release.py --out FOLDER ARCHIVE...

CMakeLists.txt defines the version. The names of all archives must contain it, and CHANGELOG.md must begin with it.
"""

import argparse
import hashlib
import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def version(root=ROOT):
    return re.search(r"project\(pounding\s+VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)


def notes(root=ROOT):
    """The section of CHANGELOG.md for this version, which must be the first."""
    wanted = version(root)
    sections = re.split(r"(?m)^## ", (root / "CHANGELOG.md").read_text())[1:]
    name, _, text = sections[0].partition("\n")
    if name.strip() != wanted:
        sys.exit(
            f"CHANGELOG.md begins with {name.strip()}, and CMakeLists.txt has version {wanted}: add a section or correct the version"
        )
    return f"# pounding {wanted}\n\n{text.strip()}\n"


def main(arguments=None, root=ROOT):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("archives", nargs="+", type=Path)
    words = parser.parse_args(arguments)
    text = notes(root)
    for archive in words.archives:
        if f"-{version(root)}" not in archive.name:
            sys.exit(f"{archive} is not of version {version(root)}; build it again")
    shutil.rmtree(words.out, ignore_errors=True)
    words.out.mkdir(parents=True)
    sums = []
    for archive in sorted(words.archives, key=lambda path: path.name):
        shutil.copy(archive, words.out)
        sums.append(f"{hashlib.sha256(archive.read_bytes()).hexdigest()}  {archive.name}\n")
    (words.out / "SHA256SUMS").write_text("".join(sums))
    (words.out / "NOTES.md").write_text(text)
    print(f"{words.out}: {len(sums)} archives, SHA256SUMS, NOTES.md")


if __name__ == "__main__":
    main()
