#!/usr/bin/env python3
"""Checks the sources of a build folder with Clang, without generating code: any warning or error fails.

    clang.py BUILD CLANG

Tests are skipped: GoogleTest's typed tests need Clang 15.
"""

import concurrent.futures
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

#: Options of GCC only, or of the omitted object file.
LEFT_OUT = (
    "-fno-semantic-interposition",
    "-fpch-preprocess",
    "--param=",
    "-Winvalid-pch",
    "-fno-fat-lto-objects",
    "-fmacro-prefix-map=",
)


def words_of(command, clang):
    """Arguments with which Clang reads the source of a GCC command."""
    words, kept = iter(shlex.split(command)[1:]), []
    for word in words:
        if word in ("-o", "-include"):
            next(words)
        elif word != "-c" and not word.startswith(LEFT_OUT):
            kept.append(word)
    return [clang, "-fsyntax-only", *kept, "-Werror", "-Wno-unknown-warning-option", "-Wno-unknown-pragmas"]


def message_of(entry, clang):
    """Clang's output for a source; empty if there is none."""
    return subprocess.run(
        words_of(entry["command"], clang), cwd=entry["directory"], capture_output=True, text=True
    ).stderr


def main(build, clang):
    entries = [
        entry
        for entry in json.loads((Path(build) / "compile_commands.json").read_text())
        if entry["file"].endswith((".cpp", ".cxx")) and " -o tests/" not in entry["command"]
    ]
    if not entries:
        sys.exit(f"{build} lists no sources")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        messages = [message for message in pool.map(lambda entry: message_of(entry, clang), entries) if message]
    print(f"{len(entries)} sources, {len(messages)} of them with messages", *messages, sep="\n")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
