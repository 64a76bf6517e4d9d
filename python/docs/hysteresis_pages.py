#!/usr/bin/env python3
"""Generates the page of each hysteresis law, elements/pounding/hysteresis/pages, from the output of the program.

    python3 python/docs/hysteresis_pages.py build/pounding --write    # pages and pictures
    python3 python/docs/hysteresis_pages.py build/pounding --check    # exit code 1 on a difference

Equations, sources, parameters and loops come from `pounding laws`. Pictures are not compared.
"""

import io
import json
import subprocess
import sys
from functools import partial

from generated_pages import ROOT, arguments, write_or_compare
from law_pages import table

PAGES = ROOT / "elements/pounding/hysteresis/pages"
FIRST, TURNS = 2.5, "-1.2, 0.4, -3.6, -3.1, -3.4, 1, 0.2, 4.5, 0"
PATH = f"{FIRST:g}, {TURNS}"
COMMON = "f [N] force, positive where d grew from rest; d [m] deformation; at a hinge f is a moment [N m] and d a rotation [rad]"


class Program:
    def __init__(self, path):
        self.path = str(path)

    def json(self, *words):
        return json.loads(
            subprocess.run([self.path, "laws", *words, "--json"], capture_output=True, text=True, check=True).stdout
        )

    def loop(self, law, path=PATH, points=1):
        return self.json(law["name"], "--path", path, "--points", str(points))["rows"]


def page(law, rows):
    name = law["name"]
    lines = [
        f"# {name}",
        "",
        law["summary"][0].upper() + law["summary"][1:] + ".",
        "",
        f"    {law['force']}",
        "",
        f"With {law['symbols']}; {COMMON}.",
        "",
    ]
    for word in ("source", "range", "beware"):
        lines += [f"**{word.capitalize()}:** {law[word]}.", ""]
    lines += [f"![Force over deformation]({name}.png)", "", "## Parameters", ""]
    shown = [
        (f"`{p['name']}`", p["unit"] or "-", f"{p['typical']:g}", p["meaning"], p["need"]) for p in law["parameters"]
    ]
    shown += [
        (f"`{c['name']}`", "-", f"`{c['words'][0]}`", c["meaning"], " or ".join(f"`{word}`" for word in c["words"]))
        for c in law["choices"]
    ]
    lines += table(("parameter", "unit", "typical", "meaning", "need"), shown, {2})
    lines += ["## Memory", "", "Beside the deformation:", ""]
    lines += table(("number", "unit", "meaning"), [(s["name"], s["unit"] or "-", s["meaning"]) for s in law["state"]])
    lines += ["## A loop", "", "Turning points with typical parameters; work is done since the beginning:", ""]
    lines += table(
        ("d [mm]", "f [kN]", "work [kJ]"),
        [(f"{1e3 * d:.4g}", f"{f / 1e3 + 0.0:.6g}", f"{w / 1e3:.5g}") for d, f, w, *_ in rows],
        {0, 1, 2},
    )
    lines += [f'    pounding laws {name} --path "{PATH}"', "", "[All laws of yielding](README.md)"]
    return "\n".join(lines) + "\n"


def index(all_laws):
    lines = [
        "# Laws of yielding",
        "",
        f"With {COMMON}.",
        "",
        "Each follows the path between two kept states exactly: it does not matter where a way without a turn is cut into steps, no energy",
        "comes from a cycle that repeats, and slopes are those of the force. `tests/hysteresis` holds all of them to it. Made by",
        "",
        "    .venv-test/bin/python3 python/docs/hysteresis_pages.py build/pounding --write",
        "",
        "from what `pounding laws NAME` says.",
        "",
    ]
    lines += table(
        ("law", "force", "what it is", "corners"),
        [
            (
                f"[`{law['name']}`]({law['name']}.md)",
                f"`{law['force']}`",
                law["summary"],
                "yes" if law["has_corners"] else "at turns only",
            )
            for law in all_laws
        ],
    )
    return "\n".join(lines).rstrip("\n") + "\n"


def draw(program, law, path):
    sys.path.insert(0, str(ROOT / "python"))
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from PIL import Image  # comes with matplotlib
    from pounding.pictures.style import STYLE

    first = [f"{FIRST * part / 60:.6g}" for part in range(61)][1:-1]
    rows = program.loop(law, ", ".join(first)) + program.loop(law, points=60)
    with plt.rc_context(STYLE | {"savefig.dpi": 110}):
        figure, axes = plt.subplots(figsize=(3.6, 2.9), layout="constrained")
        axes.axhline(0, color="0.5", linewidth=0.6)
        axes.axvline(0, color="0.5", linewidth=0.6)
        axes.plot(
            [0] + [1e3 * row[0] for row in rows], [0] + [row[1] / 1e3 for row in rows], color="black", linewidth=1.2
        )
        axes.set(xlabel="deformation d (mm)", ylabel="force f (kN)")
        drawn = io.BytesIO()
        figure.savefig(drawn, format="png")
        plt.close(figure)
    Image.open(drawn).convert("RGB").quantize(64, Image.Quantize.MAXCOVERAGE).save(path, optimize=True)


def main():
    path, write = arguments(__doc__, "program", "the program `pounding`")
    program = Program(path)
    all_laws = program.json("--yielding")
    texts = {law["name"] + ".md": page(law, program.loop(law)) for law in all_laws} | {"README.md": index(all_laws)}
    pictures = {f"{law['name']}.png": partial(draw, program, law) for law in all_laws}
    write_or_compare(PAGES, texts, pictures, write)


if __name__ == "__main__":
    main()
