"""Extension of Sphinx for the pages of the lessons. Each page shows the files of the lesson, each model with a link to
download it, then the commands, then the pictures that the commands draw. The commands run when the page is read."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pounding

ROOT = Path(__file__).resolve().parents[2]
PAGE = re.compile(r"examples/(\d\d_\w+|demo)/README")
#: The first block of commands.
COMMANDS = re.compile(r"(?ms)^```sh\n(.*?)^```\n")
#: Statements that the tests read.
EXPECTATIONS = re.compile(r"(?ms)^<!--\nExpect\b.*?-->\n")
MODEL = re.compile(r"pounding (?:run|study) examples/\w+/([\w.]+)")
LANGUAGES = {".yaml": "yaml", ".hpp": "cpp", ".cpp": "cpp", ".py": "python"}
CAPTIONS = {
    "profiles": "extreme values over the height",
    "spectrum": "spectrum of the floor with the strongest motion",
    "model": "the structures at rest",
    "plan": "drifts and impacts in plan",
    "loops": "hysteresis loops",
    "gap": "distribution of the required gap",
    "fragility": "fragility curve",
}
#: Films take minutes; the tests make short ones.
SKIPPED = " animate "


def commands_of(block):
    """Commands that draw on the site: those of the program, continued lines joined."""
    lines = block.replace("\\\n", "").splitlines()
    return [line for line in lines if "build/pounding" in line and SKIPPED not in line]


def caption(path, command):
    """Caption of a picture, from `--picture` or from its name."""
    names = [*re.findall(r"--picture (\w+)", command), *re.split(r"[^a-z]+", path.stem)]
    return next((CAPTIONS[name] for name in names if name in CAPTIONS), "histories and impacts")


def draw(commands, place):
    """Runs the commands in a temporary folder. Copies the pictures next to `place`, and returns (path, caption) of
    each."""
    environment = os.environ | {"POUNDING_PYTHON": sys.executable, "MPLBACKEND": "agg"}
    found = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "build").mkdir()
        (folder / "build/pounding").symlink_to(Path(pounding.__file__).parent / "bin/pounding")
        for shared in ("examples", ".venv"):
            (folder / shared).symlink_to(ROOT / shared)
        for command in commands:
            before = set(folder.glob("*.png"))
            done = subprocess.run(
                ["bash", "-ec", command], check=False, cwd=folder, env=environment, capture_output=True, text=True
            )
            if done.returncode:
                raise RuntimeError(f"{command}: {done.stderr}")
            for path in sorted(set(folder.glob("*.png")) - before, key=lambda path: (len(path.name), path.name)):
                kept = place.with_name(f"{place.name}-{path.name}")
                shutil.copyfile(path, kept)
                found.append((kept, caption(path, command)))
    return found


def show_parts(app, docname, source):
    """Adds files and pictures to the text of a lesson's README, and removes the statements for tests."""
    page = PAGE.fullmatch(docname)
    if not page:
        return
    folder = Path(app.env.doc2path(docname)).parent
    text = EXPECTATIONS.sub("", source[0])
    commands = COMMANDS.search(text)
    run = MODEL.search(commands[1])
    # The model that is run comes first, then those that the text compares it with.
    files = sorted(
        (path for path in folder.iterdir() if path.suffix in LANGUAGES),
        key=lambda path: (not run or path.name != run[1], path.name),
    )
    listings = "".join(
        f"```{{literalinclude}} {path.name}\n:language: {LANGUAGES[path.suffix]}\n:caption: {path.name}\n```\n\n"
        + f"{{download}}`Download this model <{path.name}>`\n\n" * (path.suffix == ".yaml")
        for path in files
    )
    place = Path(app.doctreedir) / "lessons" / page[1]
    place.parent.mkdir(parents=True, exist_ok=True)
    shown = "".join(
        f"![{words.capitalize()}]({os.path.relpath(path, folder)})\n\n"
        for path, words in draw(commands_of(commands[1]), place)
    )
    source[0] = f"{text[: commands.start()]}{listings}{commands[0]}\n{shown}{text[commands.end() :]}"


def setup(app):
    app.connect("source-read", show_parts)
    return {"parallel_read_safe": True}
