#!/usr/bin/env python3
"""Generates the page of each contact law, elements/pounding/laws/pages, from the output of the program.

    python3 python/docs/law_pages.py build/pounding --write    # pages and pictures
    python3 python/docs/law_pages.py build/pounding --check    # exit code 1 if the text of a page differs

Equations, sources, parameters and numbers are from `pounding laws` and `pounding calibrate`, loops from runs, and
verification sections from tests/verification/README.md. Pictures are not compared.
"""

import io
import json
import os
import re
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

from generated_pages import ROOT, arguments, write_or_compare
from verification_book import PAGE as BOOK
from verification_book import anchor

PAGES = ROOT / "elements/pounding/laws/pages"
HALF = 4  # index of 0.50 among the target restitutions
MASSES, SPEED, RESTITUTION = ("100 t", "150 t"), 0.5, 0.65
COMMON = (
    "F [N] contact force, positive if it pushes the bodies apart; d [m] penetration; d' [m/s] its rate, positive in approach; v [m/s] "
    "closing speed of the impact; m [kg] reduced mass m1 m2/(m1+m2) of the two floors"
)


class Program:
    def __init__(self, path):
        self.path = str(path)

    def json(self, *words):
        return json.loads(
            subprocess.run([self.path, *words, "--json"], capture_output=True, text=True, check=True).stdout
        )

    def calibrate(self, law):
        asked = ["--restitution", str(RESTITUTION)] if law["restitution"] else []
        return self.json("calibrate", "--law", law["name"], *asked, "--m1", MASSES[0], "--m2", MASSES[1])["formulas"]

    def loop(self, law, formula):
        """Recorded penetrations [m] and forces [N] of one impact of two free floors."""
        import h5py

        asked = f", restitution: {RESTITUTION}" if law["restitution"] else ""
        chosen = f", formula: {formula}" if formula else ""
        given = "".join(f", {p['name']}: {typical(p)}" for p in law["parameters"] if p["need"] == "required")
        model = (
            f"structures:\n  a: {{body: {{mass: {MASSES[0]}}}, initial_velocity: {SPEED} m/s}}\n  b: {{body: {{mass: {MASSES[1]}}}}}\n"
            f"links: [{{between: [a, b], gap: 1 mm, law: {law['name']}{given}{asked}{chosen}}}]\n"
            "analysis: {duration: 0.5, tolerance: 1e-6}\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "model.yaml").write_text(model)
            subprocess.run(
                [self.path, "run", "model.yaml", "-o", "out.h5", "-q"], cwd=folder, check=True, capture_output=True
            )
            with h5py.File(Path(folder) / "out.h5") as file:
                link = file["links/a-b"]
                penetration, force = link["penetration"][()], link["force"][()]
        closed = penetration >= 0
        return penetration[closed], force[closed]


def sections():
    """Title and text of each section of the verification book."""
    parts = re.split(r"(?m)^### (.*)$", BOOK.read_text())
    return list(zip(parts[1::2], parts[2::2]))


def verified(law):
    """Links to the sections that name this law or apply to every law."""
    named = re.compile(rf"(?<![\w/]){law['name']}(?!\w)|by (every|any) law\b")
    found = [title for title, text in sections() if named.search(text)]
    where = os.path.relpath(BOOK, PAGES)
    return [f"- [{title}]({where}#{anchor(title)})" for title in found]


def table(head, rows, right=()):
    line = lambda cells: "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"
    return [
        line(head),
        "|" + "|".join("---:" if i in right else "---" for i in range(len(head))) + "|",
        *map(line, rows),
        "",
    ]


def typical(parameter):
    """The typical value of a parameter, as it is typed: a number, a list of numbers, or true."""
    value = parameter["typical"]
    if isinstance(value, bool):
        return str(value).lower()
    return f"[{', '.join(f'{one:g}' for one in value)}]" if isinstance(value, list) else f"{value:g}"


def parameters(law):
    rows = [(f"`{p['name']}`", p["unit"] or "-", typical(p), p["meaning"], p["need"]) for p in law["parameters"]]
    if law["restitution"]:
        direct = any(p["need"].startswith("instead") for p in law["parameters"])
        rows.append(
            (
                "`restitution`",
                "-",
                RESTITUTION,
                f"coefficient of restitution e, in {'[' if law['sticks_at_zero'] else '('}0, 1]",
                "or a direct damping value" if direct else "required",
            )
        )
    if law["impact_velocity"]:
        rows.append(
            ("`impact_velocity`", "m/s", "", "fixed design velocity; default: closing speed of each impact", "optional")
        )
    if law["reduced_mass"]:
        rows.append(("`reduced_mass`", "kg", "", "m of the linked floors", "found by the link"))
    return table(("parameter", "unit", "typical", "meaning", "need"), rows, {2})


def formulas(law):
    lines = ["## Damping formulas", "", "Each formula computes the damping from a target restitution e.", ""]
    lines += table(
        ("formula", "equation", "source", "note"),
        [(f"`{f['name']}`", f"`{f['equation']}`", f["source"], f["note"]) for f in law["formulas"]],
    )
    asked = [row["asked"] for row in law["formulas"][0]["obtained"]]
    lines += [f"Restitution obtained in a free impact at {SPEED:g} m/s:", ""]
    lines += table(
        ("target", *(f"{e:.1f}" for e in asked)),
        [
            (f"`{f['name']}`", *("-" if row["obtained"] is None else f"{row['obtained']:.4f}" for row in f["obtained"]))
            for f in law["formulas"]
        ],
        set(range(1, 10)),
    )
    return lines


def one_impact(law, rows):
    asked = f", target restitution {RESTITUTION}" if law["restitution"] else ""
    lines = [
        "## One impact",
        "",
        f"A floor of {MASSES[0]} hits a floor of {MASSES[1]} at {SPEED:g} m/s{asked}, typical parameters:",
        "",
    ]
    shown = [
        (
            f"`{row['formula']}`" if row["formula"] else "-",
            f"{row['restitution']:.3f}",
            f"{row['peak_force'] / 1e3:.4g}",
            f"{row['peak_penetration'] * 1e3:.4g}",
            f"{row['duration'] * 1e3:.4g}",
            f"{row['energy_lost'] / 1e3 if abs(row['energy_lost']) > 1e-6 else 0:.3g}",  # round-off of elastic laws
        )
        for row in rows
    ]
    return lines + table(
        ("formula", "restitution", "peak force [kN]", "penetration [mm]", "duration [ms]", "energy lost [kJ]"),
        shown,
        set(range(1, 6)),
    )


def page(law, rows):
    name = law["name"]
    symbols = law["symbols"] if law["instantaneous"] else f"{law['symbols']}; {COMMON}"
    lines = [
        f"# {name}",
        "",
        law["summary"][0].upper() + law["summary"][1:] + ".",
        "",
        f"    {law['force']}",
        "",
        f"With {symbols}.",
        "",
    ]
    for key, title in (("source", "Source"), ("range", "Range"), ("beware", "Limitations")):
        lines += [f"**{title}:** {law[key]}.", ""]
    lines += [
        f"In a model: `law: {name}`"
        + "".join(f", `{p['name']}: {typical(p)}`" for p in law["parameters"] if p["need"] == "required")
        + (f", `restitution: {RESTITUTION}`" if law["restitution"] else "")
        + ".",
        "",
    ]
    if not law["instantaneous"]:
        lines += [f"![Force over penetration, and the restitution obtained]({name}.png)", ""]
    lines += ["## Parameters", "", *parameters(law)] if law["parameters"] else []
    lines += formulas(law) if law["formulas"] else []
    lines += one_impact(law, rows) if not law["instantaneous"] else []
    lines += [
        "## Verified by",
        "",
        "Sections of the verification book:",
        "",
        *verified(law),
        "",
        "[All laws](README.md)",
    ]
    return "\n".join(lines) + "\n"


def index(all_laws):
    rows = []
    for law in all_laws:
        half = [row["obtained"][HALF]["obtained"] for row in law["formulas"]]
        spread = " ... ".join(sorted({f"{e:.3f}" for e in (min(half), max(half))})) if half else "-"
        rows.append(
            (
                f"[`{law['name']}`]({law['name']}.md)",
                f"`{law['force']}`",
                law["summary"],
                len(law["formulas"]) or "-",
                spread,
            )
        )
    lines = [
        "# Contact laws",
        "",
        f"{COMMON}.",
        "",
        "The page of each law lists symbols, source, range, limitations, parameters, damping formulas with the restitution",
        "that they yield, the loop of one impact, and verification tests. The pages are generated by",
        "",
        "    .venv-test/bin/python3 python/docs/law_pages.py build/pounding --write",
        "",
        "from the output of `pounding laws NAME`.",
        "",
    ]
    lines += table(("law", "force", "summary", "formulas", "restitution for a target of 0.50"), rows, {3})
    return "\n".join(lines).rstrip("\n") + "\n"


def draw(program, law, path):
    """Left: loop of one impact. Right: obtained over target restitution of each formula."""
    sys.path.insert(0, str(ROOT / "python"))
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from PIL import Image  # comes with matplotlib
    from pounding._pictures.style import STYLE

    names = [f["name"] for f in law["formulas"]] or [""]
    colours = ["black", *plt.colormaps["tab10"].colors, "0.6"]
    with plt.rc_context(STYLE | {"savefig.dpi": 110}):
        figure, axes = plt.subplots(
            1,
            2 if law["formulas"] else 1,
            figsize=(7.8, 2.9) if law["formulas"] else (3.6, 2.9),
            squeeze=False,
            layout="constrained",
        )
        loops, curves = axes[0][0], axes[0][-1]
        for number, (name, colour) in enumerate(zip(names, colours)):
            penetration, force = program.loop(law, name)
            width = 1.6 if number == 0 else 0.8
            loops.plot(1e3 * penetration, force / 1e6, color=colour, linewidth=width, zorder=5 if number == 0 else 3)
        loops.set(
            xlabel="penetration d (mm)",
            ylabel="force F (MN)",
            title=f"One impact at {SPEED:g} m/s" + (f", target e = {RESTITUTION}" if law["restitution"] else ""),
        )
        loops.axhline(0, color="0.5", linewidth=0.6)
        if law["formulas"]:
            curves.plot([0, 1], [0, 1], color="0.75", linewidth=3, zorder=1)
            for number, (formula, colour) in enumerate(zip(law["formulas"], colours)):
                known = [row for row in formula["obtained"] if row["obtained"] is not None]
                curves.plot(
                    [row["asked"] for row in known],
                    [row["obtained"] for row in known],
                    color=colour,
                    marker="o",
                    markersize=2.2,
                    linewidth=1.4 if number == 0 else 0.9,
                    label=formula["name"],
                )
            curves.set(
                xlabel="target restitution",
                ylabel="obtained restitution",
                xlim=(0, 1),
                ylim=(0, 1),
                title="Free impact",
            )
            curves.legend(loc="upper left", bbox_to_anchor=(1, 1))
        drawn = io.BytesIO()
        figure.savefig(drawn, format="png")
        plt.close(figure)
    Image.open(drawn).convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE).save(path, optimize=True)


def main():
    path, write = arguments(__doc__, "program", "the program `pounding`")
    program = Program(path)
    all_laws = [program.json("laws", law["name"]) for law in program.json("laws")]
    texts = {law["name"] + ".md": page(law, program.calibrate(law)) for law in all_laws} | {
        "README.md": index(all_laws)
    }
    pictures = {f"{law['name']}.png": partial(draw, program, law) for law in all_laws if not law["instantaneous"]}
    write_or_compare(PAGES, texts, pictures, write)


if __name__ == "__main__":
    main()
