#!/usr/bin/env python3
"""Generates the page of the input keys and the JSON schema of a model from the tables of the program.

python3 python/docs/word_pages.py build/pounding --write    # the page and the schema
python3 python/docs/word_pages.py build/pounding --check    # exit code 1 if they differ


"""

import json
import subprocess

from generated_pages import ROOT, arguments, refuse

PAGE = ROOT / "python/docs/reference/words.md"
SCHEMA = ROOT / "python/pounding/model.schema.json"
FIRST = "0.1.0"

HEAD = """# Input keys

All keys of a model, as `pounding words` prints them; add a name, such as `gap`, for one key. A quantity without a unit is in the unit
in brackets; any unit of the same dimension may follow the number: `20 mm`. Names in capitals are free, `[]` is each member of a list.
Every key exists since version {first} unless stated otherwise. [Input](../guide/input.md) introduces them.

## In an editor

The option `--schema` of that command prints a JSON schema (draft 2020-12); installed, it is `share/pounding/model.schema.json`, and in the Python
package `pounding/model.schema.json`. In VS Code with the extension YAML (Red Hat), begin a model with

```yaml
# yaml-language-server: $schema=/usr/local/share/pounding/model.schema.json
```

or name it for all of them in `settings.json`: `"yaml.schemas": {{"/usr/local/share/pounding/model.schema.json": "models/*.yaml"}}`.
The editor then completes keys and laws, shows their meaning, and underlines unknown keys, wrong types, units and ranges.
`pounding check` also checks combinations of keys and the existence of names and records.
"""


def cell(text):
    return text.replace("|", "\\|")


def row(word):
    needed = {"required": "**required**", "optional": ""}.get(word["need"], word["need"])
    otherwise = word.get("default", "")
    since = f" Since {word['since']}." if word["since"] != FIRST else ""
    facts = (
        f"`{word['key']}`",
        cell(word["takes"]),
        "; ".join(filter(None, (needed, otherwise))),
        cell(word["meaning"]) + since,
        f"`{word['example']}`",
    )
    return "| " + " | ".join(facts) + " |"


def section(found):
    meaning = found["meaning"][0].upper() + found["meaning"][1:].rstrip(".") + "."
    title = f"`{found['place']}`" if found["place"] else meaning.partition(":")[0].rstrip(".")
    lines = ["", f"## {title}", ""] + ([meaning, ""] if found["place"] else [])
    if (law := found["name"]) and "with law" in found["place"]:
        lines += [f"[Equations and formulas of {law}](../../../elements/pounding/laws/pages/{law}.md)", ""]
    if found["keys"]:
        lines += [
            "| key | takes | needed, or value without it | meaning | example |",
            "|---|---|---|---|---|",
            *map(row, found["keys"]),
        ]
    return "\n".join(lines) + "\n"


def made(program):
    """Text of each file that is made."""

    def printed(*words):
        return subprocess.run([str(program), "words", *words], capture_output=True, text=True, check=True).stdout

    page = HEAD.format(first=FIRST) + "".join(map(section, json.loads(printed("--json"))))
    return {PAGE: page.replace("\n\n\n", "\n\n"), SCHEMA: printed("--schema")}


if __name__ == "__main__":
    program, is_written = arguments(__doc__, "PROGRAM", "the program pounding")
    for path, text in made(program).items():
        if is_written:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            refuse(f"{path.relative_to(ROOT)} says something else than the program.", program)
