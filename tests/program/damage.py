"""Damaged results files, made with seeds: `python3 damage.py --count 10000`, with POUNDING_PROGRAM and PYTHONPATH set. Each file has one to sixteen changed
bytes, or was cut, filled with zeros, or lengthened. Every reader must refuse it by its own message: the package in a process of its
own, the verbs of the program by exit code 2; none may read it, crash, or take longer than `SECONDS`.
"""

import argparse
import collections
import os
import random
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from support import OSCILLATORS, PROGRAM

SECONDS = 10  #: for one file
#: Verbs with RESULTS in the place of the file; what they would write goes into the folder of the damaged file.
VERBS = (["run", "-q", "--resume", "RESULTS", "-o", "resumed.h5"], ["spectrum", "RESULTS", "--floor", "left.1"],
         ["plot", "RESULTS", "-o", "picture.png"], ["export", "RESULTS", "-o", "view.xdmf"],
         ["animate", "RESULTS", "-o", "film.gif"])


def samples(folder):
    """Bytes of a run that is done, and of one that can be resumed, in its first part too."""
    made = []
    for name, more, words in (("done", "", []), ("cut", "", ["-pounding_ts_max_steps", "100"]),
                              ("part", "compare: no_pounding\n", ["-pounding_ts_max_steps", "20"])):
        (folder / "model.yaml").write_text(OSCILLATORS + more)
        subprocess.run([PROGRAM, "run", "model.yaml", "-q", "-o", f"{name}.h5", *words], cwd=folder, capture_output=True, timeout=60)
        made.append((folder / f"{name}.h5").read_bytes())
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
        # A sector that never reached the disk.
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


def fate_of_reading(path):
    """Outcome of `pounding.read` on a file in a process of its own: refused, read, an exception, a signal, or hangs."""
    from pounding.checked_file import NotResults
    from pounding.results import RunData

    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        try:
            RunData.read(path)
            os._exit(1)
        except NotResults:
            os._exit(0)
        except BaseException as error:
            sys.stderr.write(f"{path}: {type(error).__name__}: {error}\n")
            os._exit(2)
    status = os.waitpid(child, 0)[1]
    if os.WIFSIGNALED(status):
        return "hangs" if os.WTERMSIG(status) == signal.SIGALRM else f"ends by signal {os.WTERMSIG(status)}"
    return ("refused", "read", "other exception")[os.WEXITSTATUS(status)]


def fate_of_verb(words, path):
    """As `fate_of_reading`, of a verb of the program."""
    try:
        done = subprocess.run([PROGRAM, *(str(path) if word == "RESULTS" else word for word in words)], cwd=path.parent,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return "hangs"
    if done.returncode < 0:
        return f"ends by signal {-done.returncode}"
    if done.returncode == 2 and done.stderr.startswith("pounding: ") and "Traceback" not in done.stderr:
        return "refused"
    return f"exit code {done.returncode}"


def survey(count, seed, verbs):
    """How often each reader did what: {(reader, fate): number}. Of the verbs that start Python one is tried for each file."""
    fates = collections.Counter()
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        whole = samples(folder)
        path = folder / "damaged.h5"
        for number in range(count):
            content = chance.choice(whole)
            changed = damaged(content, chance)
            if changed == content:
                continue
            path.write_bytes(changed)
            fates["read", fate_of_reading(path)] += 1
            if number < verbs:
                for words in (*VERBS[:2], VERBS[2 + number % 3]):
                    fates[words[0], fate_of_verb(words, path)] += 1
    return fates


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbs", type=int, default=500, help="files that the verbs of the program read, too")
    options = parser.parse_args()
    fates = survey(options.count, options.seed, options.verbs)
    for (reader, fate), number in sorted(fates.items()):
        print(f"{reader:<9} {fate:<16} {number}")
    return any(fate != "refused" for _, fate in fates)


if __name__ == "__main__":
    sys.exit(main())
