"""The folders of pounding/ are modules in one order: each includes only the modules listed in its NEEDS, all of which
precede it."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/docs"))
from declarations import public_headers  # noqa: E402

PARTS = ("elements", "lib")
#: Programs above all modules, in this order.
ABOVE = ("reproduce", "program")


def declared():
    """Module -> its needs, in the order of the declarations."""
    modules = {}
    for part in PARTS:
        text = re.sub(r"#.*", "", (ROOT / part / "CMakeLists.txt").read_text())
        for words in re.findall(r"pounding_module\(([^)]*)\)", text):
            name, *rest = words.split()
            keyword, needs = None, []
            for word in rest:
                if word in ("LIGHT", "NEEDS", "WITH", "SOURCES"):
                    keyword = word
                elif keyword == "NEEDS":
                    needs.append(word)
            modules[name] = needs
    return modules


def includes(path):
    """Modules of the headers included by a file, each with its line."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#include\s+[<"](pounding/)?(\w+)/[\w/]+\.hpp[>"]', line)
        if found and (found.group(1) or found.group(2) in ABOVE):
            yield number, found.group(2)


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".hpp", ".cpp"))


class Modules(unittest.TestCase):
    def test_EveryFolderIsAModule(self):
        folders = {path.name for part in PARTS for path in (ROOT / part / "pounding").iterdir() if path.is_dir()}
        self.assertEqual(folders, set(declared()))
        loose = [
            str(path)
            for part in PARTS
            for path in (ROOT / part / "pounding").iterdir()
            if path.is_file() and path.suffix in (".hpp", ".cpp")
        ]
        public = {name for names in public_headers() for name in names}
        self.assertEqual([path for path in loose if f"pounding/{Path(path).name}" not in public], [])

    def test_AModuleNeedsOnlyWhatStandsBeforeIt(self):
        before = []
        for name, needs in declared().items():
            self.assertEqual([need for need in needs if need not in before], [], f"module {name}")
            before.append(name)

    def test_AModuleIncludesOnlyWhatItNeeds(self):
        modules, wrong = declared(), []
        for part in PARTS:
            for folder in (ROOT / part / "pounding").iterdir():
                if not folder.is_dir():
                    continue
                for path in sources(folder):
                    for line, other in includes(path):
                        if other != folder.name and other not in modules[folder.name]:
                            wrong.append(
                                f"{path.relative_to(ROOT)}:{line}: {folder.name} includes {other}, which its NEEDS do not name"
                            )
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_NoNeedIsIdle(self):
        idle = []
        for part in PARTS:
            for folder in (ROOT / part / "pounding").iterdir():
                if folder.is_dir():
                    used = {other for path in sources(folder) for _, other in includes(path)}
                    idle += [
                        f"{folder.name} needs {need}, but includes none of its headers"
                        for need in declared()[folder.name]
                        if need not in used
                    ]
        self.assertEqual(sorted(idle), [])

    def test_EveryRecordFormatIsInTheList(self):
        folder = ROOT / "elements/pounding/ground/records"
        listed = re.findall(r"(?m)^FORMAT\((\w+)\)$", (folder / "formats.inc").read_text())
        self.assertEqual(sorted(listed), sorted(path.stem for path in folder.glob("*.cpp") if path.stem != "format"))

    def test_NoModuleKnowsTheProgramsAboveIt(self):
        for part in PARTS:
            for path in sources(ROOT / part / "pounding"):
                self.assertEqual([other for _, other in includes(path) if other in ABOVE], [], path)
        for path in sources(ROOT / "lib/reproduce"):
            self.assertNotIn("program", [other for _, other in includes(path)], path)


if __name__ == "__main__":
    unittest.main()
