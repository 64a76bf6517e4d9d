"""Study files with random faults, by seed: `python3 mutate_plans.py --count 100000`, with PYTHONPATH set. A plan must
be read or refused by InputError, within 10 s and 2 GB; any other outcome is written with its seed to the folder
FOUND."""

import argparse
import collections
import os
import random
import re
import resource
import shutil
import signal
import sys
import tempfile
import traceback
import warnings
from pathlib import Path

from pounding.errors import InputError
from pounding._studies.plan import read_plan
from pounding._studies.quantities import UNITS
from pounding._studies.reading import EXAMPLES
from pounding._studies.distributions import stats

SECONDS, MEMORY = 10, 2_000_000_000
MODEL = """\
ground_motion: {synthetic: {seed: 1, duration: 0.4 s, pga: 0.3 g, soil: firm}}
structures:
  left: {oscillator: {mass: 100 t, period: 0.8 s, damping: 5 %}}
  right: {oscillator: {mass: 150 t, period: 0.4 s, damping: 5 %}}
links:
  - {between: [left, right], gap: 1 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}
"""
#: Models of `study:` that together use every key.
STUDIES = (
    "  factors:\n    ratio: {of: structures.right.oscillator.period, times: structures.left.oscillator.period, list: [0.4, 0.8]}\n"
    "    gap: {of: links.*.gap, from: 1 mm, to: 9 mm, count: 5, spacing: log}\n"
    "  records: {synthetic: {count: 3, duration: 0.4 s, pga: 0.3 g}}\n  intensity: {measure: pga, levels: [0.2 g, 0.4 g]}\n"
    "  keep: [displacement, force.left-right, impacts, gap_srss]\n  without_links: yes\n  limits: {force: 2 MN}\n  seed: 3\n",
    "  factors:\n    gap: {of: links.*.gap, uniform: {from: 1 mm, to: 9 mm}}\n    e: {of: links.0.restitution, normal: {mean: 0.6, sd: 0.1}, truncate: [0.3, 0.9]}\n"
    "    k: {of: links.*.stiffness, lognormal: {median: 2.75e9, cov: 0.3}}\n    zeta: {of: structures.*.oscillator.damping, triangular: {from: 2 %, mode: 4 %, to: 9 %}}\n"
    "  sampling: {sobol: 8}\n  records: {files: a.csv, units: g}\n  intensity: {measure: sa, period: 0.5 s, damping: 5 %, levels: [1, 2]}\n"
    "  stop_after: 5 %\n  engine: kernel\n",
    "  factors:\n    gap: {of: links.left-right.gap, discrete: {values: [10 mm, 20 mm], probabilities: [0.3, 0.7]}}\n"
    "    m: {of: structures.left.oscillator.mass, scipy: {name: gamma, a: 2, scale: 1e5}}\n    law: {of: links.0.law, list: [hertz, jankowski]}\n"
    "  sampling: {latin_hypercube: 5}\n  records: {files: [a.csv, b.csv], skip: [b.csv], channel: 1}\n  intensity: {measure: avg_sa, periods: [0.2 s, 1 s]}\n"
    "  engine: solver\n  keep: drift\n",
    "  factors:\n    gap: {of: links.*.gap, column: gap}\n    T: {of: structures.left.oscillator.period, column: T}\n    share: {column: share}\n"
    "  sampling: {table: t.csv}\n  keep: [required_gap, acceleration.left]\n",
)
FILES = {
    "a.csv": "time,acc (g)\n" + "".join(f"{i * 0.02:.2f},{0.1 * (-1) ** i}\n" for i in range(20)),
    "b.csv": "time,acc (g)\n0,0\n0.02,x\n",
    "t.csv": "T,gap (mm),share\n0.5,10,0.5\n0.7,20,0.7\n",
    "pair.yaml": MODEL,
}
SEEDS = tuple(f"{MODEL}study:\n{words}" for words in STUDIES) + (f"model: pair.yaml\nstudy:\n{STUDIES[3]}",)
VALUES = (
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "-inf",
    "1e9",
    "1e18",
    "1 mm",
    "-3 %",
    "0.5 g",
    "2 s",
    "yes",
    "no",
    "null",
    "~",
    "''",
    "[]",
    "{}",
    "[[]]",
    "[1, x]",
    "{a: 1}",
    "*",
    "links.*",
    "structures",
    "structures.*.*",
    "../..",
    ".",
    "*.csv",
    "/dev/null",
    "/dev/zero",
    "t.csv",
    "pair.yaml",
    "é",
    "\\x00",
    "0x10",
    "1_000",
    "9" * 400,
    "a" * 300,
    "[" * 50,
    "true",
    "far_field",
    "grid",
    "{from: 1, to: 2}",
    "{count: 2}",
)
KEYS = {key for section in EXAMPLES.values() for key in section}
WORDS = sorted({*KEYS, "kernel", "solver", *UNITS, *(re.findall(r"[a-z_]{2,}", "".join(STUDIES)))})
TOKEN = re.compile(r"[A-Za-z0-9_.*%/-]+|[\[\]{}:,]")


def mutant(chance):
    """A study file with one to five faults."""
    text = chance.choice(SEEDS)
    for _ in range(chance.choice((1, 1, 1, 2, 3, 5))):
        # The majority is in the section that Python reads.
        begin = text.find("study:") if chance.random() < 0.9 else 0
        tokens = [found.span() for found in TOKEN.finditer(text, max(begin, 0))]
        if not tokens:
            break
        first, last = chance.choice(tokens)
        kind = chance.randrange(9)
        if kind <= 3:
            text = text[:first] + chance.choice(VALUES) + text[last:]
        elif kind == 4:
            text = text[:first] + chance.choice(WORDS) + text[last:]
        elif kind == 5:
            text = text[:first] + text[last:]
        elif kind == 6:
            other = chance.choice(tokens)
            text = text[:first] + text[other[0] : other[1]] + text[last:]
        elif kind == 7:
            lines = text.splitlines(keepends=True)
            i, j = chance.randrange(len(lines)), chance.randrange(len(lines))
            lines[i] = lines[j] if chance.random() < 0.5 else ""
            text = "".join(lines)
        else:
            place = chance.randrange(first, last + 1)
            text = (
                text[:place]
                + chance.choice(
                    ("\t", "\n", " ", ":", "-", "#", "'", '"', "&a ", "*a", "!!int ", "|", ">", "\x07", "?", "%")
                )
                + text[place:]
            )
    return text


def look(seeds, folder, found):
    """Reads the mutants of these seeds in this process, which ends at a hang or without memory. {outcome: number}."""
    fates = collections.Counter()
    path = folder / "study.yaml"
    warnings.simplefilter("error", RuntimeWarning)
    for seed in seeds:
        path.write_text(mutant(random.Random(seed)))
        (folder / "now").write_text(str(seed))
        signal.alarm(SECONDS)
        try:
            read_plan(path, folder / "store")
            fates["read"] += 1
        except InputError as error:
            fates["refused"] += 1
            if any(ord(letter) < 32 and letter != "\n" for letter in str(error)):
                fates["control characters in a message"] += 1
                shutil.copy(path, found / f"{seed}.yaml")
        except Exception as error:
            fates[type(error).__name__] += 1
            shutil.copy(path, found / f"{seed}.yaml")
            (found / f"{seed}.txt").write_text(traceback.format_exc())
        signal.alarm(0)
    return fates


def survey(count, seed, found):
    """{outcome: number} of this number of mutants; one child process per thousand, since a mutant may end its
    process."""
    fates = collections.Counter()
    found.mkdir(parents=True, exist_ok=True)
    stats()  # takes a second, once for all children
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in FILES.items():
            (folder / file).write_text(text)
        first = 0
        while first < count:
            last = min(count, first + 1000)
            child = os.fork()
            if child == 0:
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
                (folder / "fates").write_text(
                    repr(dict(look((f"{seed}-{i}" for i in range(first, last)), folder, found)))
                )
                os._exit(0)
            status = os.waitpid(child, 0)[1]
            if status == 0:
                fates.update(eval((folder / "fates").read_text()))
                first = last
                continue
            now = (folder / "now").read_text()
            fates[
                "hang" if os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGALRM else f"status {status}"
            ] += 1
            shutil.copy(folder / "study.yaml", found / f"{now}.yaml")
            # Earlier mutants count again only if they failed.
            first = int(now.split("-")[1]) + 1
    return fates


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--found", type=Path, default=Path("found"))
    options = parser.parse_args()
    fates = survey(options.count, options.seed, options.found)
    for fate, number in fates.most_common():
        print(f"{fate:<20} {number}")
    return any(fate not in ("read", "refused") for fate in fates)


if __name__ == "__main__":
    sys.exit(main())
