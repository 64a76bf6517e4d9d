"""Extension of Sphinx for the pages of the lessons: each shows its model before its commands, and behind them the
pictures that they draw. The pictures are made when the page is read."""

import os
import re
from pathlib import Path

import matplotlib

import pounding

PAGE = re.compile(r"examples/(\d\d_\w+|demo)/README")
#: The block of commands, indented as on GitHub.
COMMANDS = re.compile(r"(?m)^    \S.*\n(?:    .*\n)*")
MODEL = re.compile(r"pounding run examples/\w+/([\w.]+)")
LANGUAGES = {".yaml": "yaml", ".hpp": "cpp", ".cpp": "cpp", ".py": "python"}
NAMES = {
    "run": "histories and impacts",
    "profiles": "extreme values over the height",
    "model": "the structures at rest",
    "plan": "drifts and impacts in plan",
}
DOTS_PER_INCH = 128  #: 960 of them make the width of a page


def pictures(commands):
    """Pictures that the commands of a lesson draw, in their order: "run", "model", "profiles"."""
    return re.findall(r"--plot|(?<=--picture )\w+", commands)


def draw(model, names, place):
    """Runs a model and writes a picture for each of the names. Returns their paths."""
    matplotlib.use("Agg")
    results = pounding.run(model, progress=False)
    paths = [place.with_name(f"{place.name}-{name}.png") for name in names]
    for name, path in zip(names, paths):
        results.plot(name).savefig(path, dpi=DOTS_PER_INCH)
    return paths


def show_parts(app, docname, source):
    """Adds model and pictures to the text of a lesson's README."""
    page = PAGE.fullmatch(docname)
    if not page:
        return
    folder = Path(app.env.doc2path(docname)).parent
    commands = COMMANDS.search(source[0])
    run = MODEL.search(commands[0])
    # The model that is run comes first, then those that the text compares it with.
    files = sorted(
        (path for path in folder.iterdir() if path.suffix in LANGUAGES),
        key=lambda path: (not run or path.name != run[1], path.name),
    )
    listings = "".join(
        f"```{{literalinclude}} {path.name}\n:language: {LANGUAGES[path.suffix]}\n:caption: {path.name}\n```\n\n"
        for path in files
    )
    shown = ""
    if run:
        place = Path(app.doctreedir) / "lessons" / page[1]
        place.parent.mkdir(parents=True, exist_ok=True)
        names = [name.replace("--plot", "run") for name in pictures(commands[0])]
        shown = "\n" + "".join(
            f"![{NAMES.get(name, name).capitalize()}]({os.path.relpath(path, folder)})\n\n"
            for name, path in zip(names, draw(folder / run[1], names, place))
        )
    # Every number gets a line of its own.
    rest = re.sub(r"(?m)^(?=Expect\b)", "\n", source[0][commands.end() :])
    source[0] = source[0][: commands.start()] + listings + commands[0] + shown + rest


def setup(app):
    app.connect("source-read", show_parts)
    return {"parallel_read_safe": True}
