"""The pages for users and contributors name only what is there: headers, files, links and headings."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/docs"))
from declarations import headers_at, installed_headers  # noqa: E402

PARTS = ("elements", "lib")
#: Top folders whose files the pages name, and files that only a build makes.
FOLDERS = ("cmake", "elements", "examples", "lib", "python", "tests")
MADE = ("my_law", "my_format")


def pages():
    """Markdown that was written by hand; the pages of the laws and the verification book are made from the program."""
    found = list(ROOT.glob("*.md"))
    for folder in ("python/docs", "examples", "tests/benchmarks", "tests/verification/opensees"):
        found += (ROOT / folder).rglob("*.md")
    return sorted(path for path in found if path.is_file() and "build" not in path.parts)


def header_exists(path):
    return any((ROOT / part / path).is_file() for part in PARTS)


def anchors(path):
    """Anchors of the headings of a page, as GitHub and the site make them."""
    text = re.sub(r"(?ms)^```.*?^```$", "", path.read_text())
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")
        for heading in re.findall(r"(?m)^#+ (.*)$", text)
    }


def links(text):
    text = re.sub(r"(?ms)^```.*?^```$", "", text)
    return re.findall(r"(?<!\\)\]\((?![a-z]+:)([^)\s]+)\)", text)


class Pages(unittest.TestCase):
    def test_EveryHeaderThatAPageNamesExists(self):
        wrong = []
        for page in pages():
            if page.name == "CHANGELOG.md":
                continue  # names the places of earlier versions, too
            for number, line in enumerate(page.read_text().splitlines(), 1):
                wrong += [
                    f"{page.relative_to(ROOT)}:{number}: {path}"
                    for path in re.findall(r"(?<![\w/])pounding/[\w/]+\.hpp", line)
                    if not header_exists(path)
                ]
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_EveryFileThatAPageNamesExists(self):
        wrong = []
        for page in pages():
            for number, line in enumerate(page.read_text().splitlines(), 1):
                for path in re.findall(rf"`((?:{'|'.join(FOLDERS)})/[\w./-]+)`", line):
                    if not (ROOT / path).exists() and not any(made in path for made in MADE):
                        wrong.append(f"{page.relative_to(ROOT)}:{number}: {path}")
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_EveryLinkLeadsSomewhere(self):
        wrong = []
        for page in pages():
            for link in links(page.read_text()):
                path, _, anchor = link.partition("#")
                target = (page.parent / path).resolve() if path else page
                if not target.exists():
                    wrong.append(f"{page.relative_to(ROOT)}: {link}")
                elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                    wrong.append(f"{page.relative_to(ROOT)}: {link}: no such heading")
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_TheReferenceShowsEveryInstalledHeaderOnOnePage(self):
        shown = []
        for page in (ROOT / "python/docs/reference").glob("*.rst"):
            for places in re.findall(r"(?m)^\.\. headers:: (.*\n(?:   .*\n)*)", page.read_text()):
                for place in map(ROOT.joinpath, places.split()):
                    shown += headers_at(place)
        self.assertEqual(sorted(shown), sorted(installed_headers()))

    def test_TheArchitectureListsEveryModuleInTheirOrder(self):
        text = (ROOT / "ARCHITECTURE.md").read_text()
        for part in PARTS:
            declared = re.findall(r"(?m)^pounding_module\((\w+)", (ROOT / part / "CMakeLists.txt").read_text())
            tree = re.search(rf"(?m)^{part}/pounding/\n((?:  .*\n)+)", text).group(1)
            self.assertEqual(re.findall(r"(?m)^  (\w+)/", tree), declared)

    def test_EveryFenceHasALanguage(self):
        wrong = []
        for page in [*pages(), *ROOT.glob("elements/pounding/*/pages/*.md"), ROOT / "tests/verification/README.md"]:
            fences = re.findall(r"(?m)^ *(```.*)$", page.read_text())
            wrong += [str(page.relative_to(ROOT))] * fences[::2].count("```")
        self.assertEqual(wrong, [])

    def test_TheReadmeShowsTheFirstCommandOnTheFirstScreen(self):
        lines = (ROOT / "README.md").read_text().splitlines()
        self.assertLess(next(number for number, line in enumerate(lines) if line.startswith("make demo")), 20)


class Reader(unittest.TestCase):
    """The check itself finds links, and skips examples of text."""

    def test_FindsLinksOutsideOfPrograms(self):
        self.assertEqual(
            links("[a](b.md#c) [w](https://x.y) `[z]`\n```\n[d](e)\n```\n![p](q.png)"), ["b.md#c", "q.png"]
        )


if __name__ == "__main__":
    unittest.main()
