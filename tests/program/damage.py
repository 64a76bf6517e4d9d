"""Damaged results files, made with seeds: `python3 damage.py --count 10000`, with POUNDING_PROGRAM and PYTHONPATH set.
They are results of runs of every kind, pushovers and study tables. Each has one to sixteen changed bytes, or is
truncated, filled with zeros, or lengthened. Every reader must refuse it with an error message: the package in a
separate process, the commands of the program with exit code 2. None may read it, crash, or take longer than `SECONDS`.
Commands implemented in Python run in children of this process, which has loaded the package.
"""

import argparse
import collections
import importlib
import importlib.util
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from small_models import PUSH, RUNS, STUDY
from support import PROGRAM

SECONDS = 10  #: processor time for one file
PATIENCE = 120  #: [s] for a waiting process
#: Whether the package has its compiled part, which studies need.
WITH_STUDIES = importlib.util.find_spec("pounding._core") is not None
#: Commands by kind of file; RESULTS is replaced by the file name, and outputs go into the folder of the damaged file.
#: Those from the third on are implemented in Python.
VERBS = {
    "run": (
        ["run", "-q", "--resume", "RESULTS", "-o", "resumed.h5"],
        ["spectrum", "RESULTS", "--floor", "left.1"],
        ["plot", "RESULTS", "-o", "picture.png"],
        ["export", "RESULTS", "-o", "view.xdmf"],
        ["animate", "RESULTS", "-o", "film.gif"],
    ),
    "pushover": (
        ["run", "-q", "--resume", "RESULTS", "-o", "resumed.h5"],
        ["spectrum", "RESULTS", "--floor", "left.1"],
        ["plot", "RESULTS", "-o", "picture.png"],
    ),
    "study": (
        ["run", "-q", "--resume", "RESULTS", "-o", "resumed.h5"],
        ["spectrum", "RESULTS", "--floor", "left.1"],
        ["study", "show", "RESULTS"],
        ["study", "export", "RESULTS", "-o", "table.csv"],
        ["study", "plot", "RESULTS", "--picture", "ida", "--column", "force", "-o", "ida.png"],
        ["study", "merge", "study.yaml", "RESULTS", "-o", "merged.h5"],
        ["study", "study.yaml", "-q", "-j", "0", "-o", "RESULTS"],
    ),
}


class Sample(NamedTuple):
    """An undamaged file."""

    kind: str  #: as in small_models, or pushover, or study
    holds: str  #: the key of its commands
    content: bytes


def samples(folder):
    """Files of a run of every kind, of runs that can be resumed (also in their first part), of a pushover and of a
    study."""
    made = []

    def make(kind, holds, model, verb, *words, codes=(0,)):
        path = folder / f"{kind}.h5"
        (folder / f"{holds}.yaml").write_text(model)
        done = subprocess.run(
            [PROGRAM, verb, f"{holds}.yaml", *words, "-o", path.name],
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=60,
        )
        if done.returncode not in codes:
            raise RuntimeError(f"{kind}: {done.stderr}")
        made.append(Sample(kind, holds, path.read_bytes()))

    for kind, model in RUNS.items():
        make(kind, "run", model, "run", "-q")
    make("cut", "run", RUNS["oscillators"], "run", "-q", "-pounding_ts_max_steps", "100", codes=(3,))
    make("cut hinges", "run", RUNS["hinges"], "run", "-q", "-pounding_ts_max_steps", "100", codes=(3,))
    make(
        "part",
        "run",
        RUNS["oscillators"] + "compare: no_pounding\n",
        "run",
        "-q",
        "-pounding_ts_max_steps",
        "20",
        codes=(3,),
    )
    make("pushover", "pushover", RUNS["hinges"], "pushover", *PUSH)
    if WITH_STUDIES:
        make("study", "study", STUDY, "study", "-q", "-j", "0")
    return made


def damaged(content, chance):
    """The content with one fault."""
    kind = chance.choices(("bytes", "cut", "zeros", "tail", "texts"), (80, 5, 5, 5, 5))[0]
    changed = bytearray(content)
    place = chance.randrange(len(content))
    if kind == "cut":
        return bytes(content[:place])
    if kind == "tail":
        return bytes(content) + chance.randbytes(chance.randrange(1, 100))
    if kind == "zeros":
        # A sector that was never written to disk.
        first = place // 512 * 512
        last = min(len(content), first + 512 * chance.randrange(1, 9))
        changed[first:last] = bytes(last - first)
    elif kind == "texts":
        for place in range(512):
            if chance.random() < 0.01:
                changed[place] = chance.randrange(256)
    else:
        for _ in range(chance.randint(1, 16)):
            changed[chance.randrange(len(changed))] ^= chance.randrange(1, 256)
    return bytes(changed)


def readers():
    """The functions of the package that read a file, by kind of file."""
    from pounding._pushover_curve import read_pushover
    from pounding.results import RunData

    found = {"run": RunData.read, "pushover": read_pushover}
    if WITH_STUDIES:
        from pounding._studies.rows import Rows

        found["study"] = Rows.open
    return found


def code_of_child(do):
    """Exit code of a child of this process that runs this, as of a subprocess: negative for a signal."""
    child = os.fork()
    if child == 0:
        bound_time()
        os._exit(do())
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def fate_by_signal(code):
    return "hangs" if -code in (signal.SIGALRM, signal.SIGKILL) else f"ends by signal {-code}"


def fate_of_reading(path, read):
    """Outcome of a reader of the package on a file, in a separate process: refused, read, an exception, a signal, or
    hangs."""
    from pounding._checked_file import NotResults

    def reading():
        try:
            read(path)
            return 1
        except NotResults:
            return 0
        except BaseException as error:
            sys.stderr.write(f"{path}: {type(error).__name__}: {error}\n")
            return 2

    code = code_of_child(reading)
    return fate_by_signal(code) if code < 0 else ("refused", "read", "other exception")[code]


def bound_time():
    """Ends this process at its time limit, whatever it does with other signals."""
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    signal.alarm(PATIENCE)


def words_for(words, path):
    return [str(path) if word == "RESULTS" else word for word in words]


def fate_by_message(code, messages):
    if code < 0:
        return fate_by_signal(code)
    return (
        "refused"
        if code == 2 and messages.startswith("pounding: ") and "Traceback" not in messages
        else f"exit code {code}"
    )


def fate_of_verb(words, path):
    """As `fate_of_reading`, for a command of the program."""
    done = subprocess.run(
        [PROGRAM, *words_for(words, path)],
        cwd=path.parent,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        preexec_fn=bound_time,
    )
    return fate_by_message(done.returncode, done.stderr)


def fate_of_package(words, path):
    """As `fate_of_verb`, for a command of the package, without starting Python again."""
    from pounding.__main__ import MODULES, STUDIES
    from pounding._ended import exit_code

    name, given = (
        (f"pounding.{MODULES[words[0]]}", words[1:]) if words[0] in MODULES else ("pounding._studies.command", words)
    )
    assert words[0] in (*MODULES, *STUDIES)
    main = importlib.import_module(name).main

    def verb():
        os.chdir(path.parent)
        messages = os.open("messages", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(messages, 1)
        os.dup2(messages, 2)
        sys.stdout = sys.stderr = open(2, "w", buffering=1, closefd=False)
        return exit_code(lambda: main(words_for(given, path)))

    return fate_by_message(code_of_child(verb), (path.parent / "messages").read_text())


def survey(count, seed, verbs):
    """Number of outcomes: {(kind of file, reader, fate): number}. The first `verbs` files go to every command. For
    every twentieth file the program starts Python for one of the commands."""
    fates = collections.Counter()
    chance = random.Random(seed)
    read = readers()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        whole = samples(folder)
        path = folder / "damaged.h5"
        for number in range(count):
            kind, holds, content = whole[number % len(whole)]
            changed = damaged(content, chance)
            if changed == content:
                continue
            path.write_bytes(changed)
            fates[kind, "read", fate_of_reading(path, read[holds])] += 1
            if number < verbs:
                by_program, by_package = VERBS[holds][:2], VERBS[holds][2:]
                for words in VERBS[holds]:
                    fate = fate_of_verb(words, path) if words in by_program else fate_of_package(words, path)
                    fates[kind, " ".join(words[:2]) if words[0] == "study" else words[0], fate] += 1
                if number % 20 == 0:
                    words = by_package[number // 20 % len(by_package)]
                    fates[kind, f"{words[0]}, new Python", fate_of_verb(words, path)] += 1
    return fates


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbs", type=int, default=500, help="number of files that every command reads as well")
    options = parser.parse_args()
    fates = survey(options.count, options.seed, options.verbs)
    for (kind, reader, fate), number in sorted(fates.items()):
        print(f"{kind:<12} {reader:<18} {fate:<16} {number}")
    return any(fate != "refused" for *_, fate in fates)


if __name__ == "__main__":
    sys.exit(main())
