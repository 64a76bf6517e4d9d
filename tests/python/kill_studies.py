"""Kills studies by SIGKILL at random instants, goes on with them, and compares the bits of their tables with
undisturbed ones.

    PYTHONPATH=build/python .venv-test/bin/python3 tests/python/kill_studies.py [COUNT]

COUNT kills (200) in turn of the kernel on threads, the kernel and the solver in one process, and the solver in two.
Half of the instants lie anywhere in the life of the process, the others after its first chunk. A study that comes to
its end is compared, and the next one begins."""

import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py

import pounding
from study_samples import FACTORS, WORDS, pair

WAYS = (
    ("auto", "--chunk", "2"),
    ("auto", "-j", "0", "--chunk", "2"),
    ("solver", "-j", "0", "--chunk", "2"),
    ("solver", "-j", "2", "--chunk", "2"),
)


def bits(path):
    with h5py.File(path) as file:
        return {name: data[:].tobytes() for name, data in file["rows"].items()}


def chunks_in(folder):
    """Finished chunks; the study takes the folder away when it has put them together."""
    try:
        return sum(name.endswith(".npz") for name in os.listdir(folder))
    except FileNotFoundError:
        return 0


class Way:
    """One engine and its processes."""

    def __init__(self, folder, number, generator):
        self.generator, self.number, self.folder = generator, number, folder
        engine, *self.options = WAYS[number]
        self.study = folder / f"study{number}.yaml"
        words = pounding.yaml_text.plain({"factors": FACTORS, **WORDS, "engine": engine})
        self.study.write_text(pounding.yaml_text.emit({"model": "pair.yaml", "study": words}))
        self.kills, self.in_work, self.finished, self.wrong = 0, 0, 0, 0
        begin = time.monotonic()
        process = self.start("whole.h5")
        first = self.first_part(process, "whole.h5", 600)
        assert process.wait() == 0
        self.whole, self.work = time.monotonic() - begin, max(0.02, time.monotonic() - first)
        self.expected = bits(self.file("whole.h5"))

    def file(self, name):
        return self.folder / f"{self.number}{name}"

    def start(self, name):
        return subprocess.Popen(
            [
                sys.executable,
                "-m",
                "pounding",
                "study",
                str(self.study),
                "-o",
                str(self.file(name)),
                "-q",
                *self.options,
            ],
            start_new_session=True,
        )

    def first_part(self, process, name, seconds):
        """When the first chunk of this process is there, or the process over."""
        parts, end = Path(f"{self.file(name)}.parts"), time.monotonic() + seconds
        before = chunks_in(parts)
        while process.poll() is None and time.monotonic() < end and chunks_in(parts) <= before:
            time.sleep(0.001)
        return time.monotonic()

    def kill_once(self):
        """Starts the study or goes on with it, and kills it; compares where it was sooner."""
        process = self.start("killed.h5")
        if self.generator.random() < 0.5:
            time.sleep(self.generator.uniform(0, self.whole))
        else:
            self.first_part(process, "killed.h5", 600)
            time.sleep(self.generator.uniform(0, self.work))
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            self.kills += 1
            self.in_work += Path(f"{self.file('killed.h5')}.parts").is_dir()
            return
        self.compare(process.returncode)

    def compare(self, code):
        self.finished += 1
        self.wrong += code != 0 or bits(self.file("killed.h5")) != self.expected
        self.file("killed.h5").unlink(missing_ok=True)

    def finish(self):
        self.compare(self.start("killed.h5").wait())


def main(count):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "pair.yaml").write_text(pair().to_yaml())
        generator = random.Random(2018)
        ways = [Way(folder, i, generator) for i in range(len(WAYS))]
        while sum(way.kills for way in ways) < count:
            min(ways, key=lambda way: way.kills).kill_once()
        for way in ways:
            way.finish()
            print(
                f"{' '.join(WAYS[way.number])}: {way.kills} kills, {way.in_work} of them with chunks on disk; {way.finished} tables, {way.wrong} wrong",
                flush=True,
            )
        return 1 if any(way.wrong for way in ways) else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 200))
