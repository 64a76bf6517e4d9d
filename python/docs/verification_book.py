#!/usr/bin/env python3
"""Makes the verification book, tests/verification/README.md, from the tests themselves.

    python3 python/docs/verification_book.py build --write    # runs the tests that compare with a source of their own,
    writes the page python3 python/docs/verification_book.py build --check    # refuses, with exit code 1, a page that
    says something else POUNDING_BOOK=build/book python3 python/docs/verification_book.py build --check    # from what
    tests have written there

The tests write what they compared through `Book` (tests/support/book.hpp, tests/program/book.py). What was obtained may
differ from machine to machine within its tolerance, and is not compared.
"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from itertools import groupby
from pathlib import Path

from generated_pages import ROOT, arguments, refuse

PAGE = ROOT / "tests/verification/README.md"
#: Folders of tests, with the words that head their chapters.
CHAPTERS = {
    "tests/laws": "Contact laws and free impacts",
    "tests/verification": "Impacts of structures",
    "tests/frames": "Structures and frames",
    "tests/structures": "Structures and frames",
    "tests/stepping": "Time integration",
    "tests/linear": "Time integration",
    "tests/run": "Time integration",
    "tests/ground": "Ground motions",
    "tests/reproduce": "The paper, recomputed",
    "tests/program": "The program",
    "tests/study": "Studies",
}
INTRODUCTION = """\
# Verification book

What the tests compare with numbers that the program did not make: closed forms, publications, other programs, independent
integrations. {cases} comparisons of {quantities} quantities. Made by

    .venv-test/bin/python3 python/docs/verification_book.py build --write

from what the tests write down while they run; the test `verification.book` refuses this page when the tests say something else.
Tests of the program against itself (mirrors, restarts, processes, refusals) are not here.

A row is a quantity. Of several cases it shows the least and the greatest expected number with what was obtained for them, and
the case that came nearest to its tolerance: deviation/tolerance is below 1 where the test passes. Where 0 is expected, as of a
difference, the largest that was obtained is shown. "1e-12 of it" is of each expected number. Digits are those that the tolerance resolves.
"""


def environment(build, book):
    records = {
        "POUNDING_PROGRAM": build / "pounding",
        "POUNDING_EXAMPLES": ROOT / "examples",
        "PYTHONDONTWRITEBYTECODE": "1",
        "POUNDING_TEST_ENVIRONMENT": ROOT / ".venv",
        "POUNDING_BOOK": book,
        "OPENBLAS_NUM_THREADS": "1",
    }
    return os.environ | {name: str(value) for name, value in records.items()}


def run(words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))} failed:\n{done.stdout[-4000:]}{done.stderr[-4000:]}")


def tests_with_a_book(binary, folder):
    """Names of the GoogleTest cases of this program whose file opens a book."""
    listing = Path(folder) / "tests.json"
    run([binary, "--gtest_list_tests", f"--gtest_output=json:{listing}"])
    suites = json.loads(listing.read_text())["testsuites"]
    cases = [(suite["name"], case) for suite in suites for case in suite["testsuite"]]
    files = {case["file"] for _, case in cases}
    with_book = {file for file in files if "support/book.hpp" in (ROOT / file).read_text()}
    return [f"{suite}.{case['name']}" for suite, case in cases if case["file"] in with_book]


def run_tests(build, book):
    """Lets all tests that compare with a source of their own write into the folder `book`."""
    shared = environment(build, book)
    for chapter in CHAPTERS:
        for binary in sorted(
            path for path in (build / chapter).glob("test_*") if path.is_file() and os.access(path, os.X_OK)
        ):
            names = tests_with_a_book(binary, book)
            if names:
                run([binary, "--gtest_brief=1", "--gtest_filter=" + ":".join(names)], env=shared, cwd=book)
    for module in sorted((ROOT / "tests/program").glob("test_*.py")):
        if re.search(r"^from book import", module.read_text(), re.MULTILINE):
            run([sys.executable, "-m", "unittest", module.stem], env=shared, cwd=module.parent)


def entries(build):
    """Entries that the books of all tests wrote, in the order of chapters, files and tests."""
    with tempfile.TemporaryDirectory() as folder:
        book = os.environ.get("POUNDING_BOOK", folder)
        if book == folder:
            run_tests(build, folder)
        written = [json.loads(path.read_text()) for path in Path(book).glob("*.*.*.json")]
    place = list(CHAPTERS)
    return sorted(
        (entry for entry in written if str(Path(entry["file"]).parent) in place),
        key=lambda entry: (place.index(str(Path(entry["file"]).parent)), entry["file"], entry["order"]),
    )


def number(value):
    """JSON has no infinities; the books write null."""
    return math.nan if value is None else value


def digits(value, tolerance):
    """A number with the decimals that a tolerance resolves."""
    value, tolerance = number(value), number(tolerance)
    if not math.isfinite(value):
        return str(value)
    if tolerance == 0:
        return f"{value:.15g}"
    decimals = math.ceil(-math.log10(tolerance) - 1e-9)
    if abs(value) < 0.5 * 10.0**-decimals:
        return "0"
    size = math.floor(math.log10(abs(value)))
    figures = min(max(size + 1 + decimals, 1), 15)
    if -4 <= size < 7:
        return f"{value:.{max(figures - 1 - size, 0)}f}"
    return f"{value:.{figures - 1}e}"


def short(value):
    return f"{value:.2g}"


def span(cases, which):
    """The expected numbers (0) or the obtained ones (1), of the least and the greatest expected."""
    least, most = (extreme(cases, key=lambda case: number(case[0])) for extreme in (min, max))
    if which == 1 and least[0] == most[0] == 0 and most[2] > 0:
        return short(max(abs(number(case[1])) for case in cases))
    first, last = digits(least[which], least[2]), digits(most[which], most[2])
    return first if least[0] == most[0] and (which == 0 or first == last) else f"{first} ... {last}"


def tolerance(cases):
    tolerances = [case[2] for case in cases]
    least, most = min(tolerances), max(tolerances)
    if most == 0:
        return "equal"
    if most - least <= 1e-9 * most:
        return short(most)
    relative = [abs(case[2] / case[0]) if case[0] else math.inf for case in cases if case[0] or case[2]]
    if math.isfinite(max(relative)) and max(relative) - min(relative) <= 1e-6 * max(relative):
        return f"{short(relative[0])} of it"
    return f"{short(least)} ... {short(most)}"


def nearness(cases):
    """The largest deviation over its tolerance. What is rounding differs from machine to machine: no digits below
    0.01."""
    ratios = [
        abs(number(obtained) - number(expected)) / allowed if allowed else 0.0 for expected, obtained, allowed in cases
    ]
    worst = max(ratios)
    return "0" if worst == 0 else "< 0.01" if worst < 0.01 else f"{worst:.2f}"


def row(quantity, cases):
    cells = [quantity, str(len(cases)), span(cases, 0), span(cases, 1), tolerance(cases), nearness(cases)]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def test_name(name):
    """Without the instantiation of a parametrised test."""
    suite, case = name.split(".", 1)
    return f"{suite.split('/')[-2 if re.search(r'/[0-9]+$', suite) else -1]}.{case.split('/')[0]}"


def block(source, reason, of_one_source):
    """One source: what it is, the reason of the tolerances, the tests, the table."""
    quantities = {}
    for entry in of_one_source:
        for each in entry.get("rows", []):
            quantities.setdefault(each["quantity"], []).extend(each["cases"])
    files = {}
    for entry in of_one_source:
        tests = files.setdefault(entry["file"], [])
        if test_name(entry["test"]) not in tests:
            tests.append(test_name(entry["test"]))
    where = "; ".join(
        f"[{Path(file).name}]({os.path.relpath(file, 'tests/verification')}) "
        + ", ".join(f"`{test}`" for test in tests)
        for file, tests in files.items()
    )
    lines = [
        f"**Source:** {source}. **Tolerances:** {reason}. {where}",
        "",
        "| quantity | cases | expected | obtained | tolerance | deviation/tolerance |",
        "|---|---:|---|---|---|---:|",
    ]
    lines += [row(quantity, cases) for quantity, cases in quantities.items()]
    return lines + [""], quantities


def anchor(title):
    """As GitHub makes it of a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def page(written):
    contents, body, cases, rows = [], [], 0, 0
    for chapter, of_chapter in groupby(written, key=lambda entry: CHAPTERS[str(Path(entry["file"]).parent)]):
        sections = {}
        for entry in of_chapter:
            sections.setdefault(entry["subject"], {}).setdefault((entry["source"], entry["reason"]), []).append(entry)
        contents.append(f"- {chapter}")
        body += [f"## {chapter}", ""]
        for subject, sources in sections.items():
            contents.append(f"  - [{subject}](#{anchor(subject)})")
            body += [f"### {subject}", ""]
            for (source, reason), of_one_source in sources.items():
                lines, quantities = block(source, reason, of_one_source)
                body += lines
                rows += len(quantities)
                cases += sum(map(len, quantities.values()))
    return "\n".join([INTRODUCTION.format(cases=cases, quantities=rows), *contents, "", *body]).rstrip("\n") + "\n"


def same_number(a, b, tolerance="0"):
    """To a unit of the last digit that is shown, or a tenth of the tolerance that a cell of the table states."""
    if a == b:
        return True
    try:
        allowed = max(
            10.0 ** (int(exponent or 0) - len(decimals or ""))
            for decimals, exponent in (
                re.fullmatch(r"-?\d+(?:\.(\d*))?(?:e([+-]\d+))?", text).groups() for text in (a, b)
            )
        )
        first = tolerance.split()[0]
        if first != "equal":
            allowed = max(allowed, 0.1 * float(first) * (abs(float(a)) if tolerance.endswith("of it") else 1))
        return abs(float(a) - float(b)) <= 1.01 * allowed
    except (AttributeError, ValueError):
        return False


def same_cell(a, b, tolerance="0"):
    first, second = a.split(), b.split()
    return len(first) == len(second) and all(same_number(*pair, tolerance) for pair in zip(first, second))


def same_line(a, b):
    if a == b:
        return True
    if not (a.startswith("| ") and b.startswith("| ")):
        return False
    first, second = ([cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in (a, b))
    return (
        len(first) == len(second) == 6
        and first[:2] == second[:2]
        and same_cell(first[2], second[2], first[4])
        and same_cell(first[4], second[4])
    )


def differences(committed, made):
    """Lines of the committed page and of the one just made that do not say the same."""
    before, now = committed.splitlines(), made.splitlines()
    if len(before) == len(now):
        return [(a, b) for a, b in zip(before, now) if not same_line(a, b)]
    known, fresh = set(before), set(now)
    return [(line, "") for line in before if line not in fresh] + [("", line) for line in now if line not in known]


def main():
    build, write = arguments(__doc__, "build", "where the tests were built")
    made = page(entries(build))
    if write:
        PAGE.write_text(made)
        return
    wrong = differences(PAGE.read_text() if PAGE.exists() else "", made)
    if wrong:
        shown = "\n".join(f"page: {a}\nnow:  {b}" for a, b in wrong[:10])
        refuse(f"tests/verification/README.md does not say what the tests do, in {len(wrong)} lines:\n{shown}", "build")


if __name__ == "__main__":
    main()
