"""Progress of a study: finished and failed rows, rows per second, and the remaining time."""

from __future__ import annotations

import sys
import time

from pounding._studies.execution import Progress


class Shown:
    """Shows progress on one line of a terminal, or calls a function; silent in a pipe."""

    def __init__(self, progress: Progress | bool | None) -> None:
        shows = sys.stderr.isatty() if progress is None else progress
        self.report: Progress | None = progress if callable(progress) else self._write if shows else None
        self._begin = time.monotonic()
        self._width = 0
        self._written = 0.0

    def __enter__(self) -> Shown:
        return self

    def __exit__(self, *failure: object) -> None:
        if self._width:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()

    def _write(self, done: int, failed: int, count: int) -> None:
        now = time.monotonic()
        if now < self._written + 0.1 and done < count:
            return
        self._written = now
        line = line_of(done, failed, count, time.monotonic() - self._begin)
        self._width = max(self._width, len(line))
        sys.stderr.write("\r" + line.ljust(self._width))
        sys.stderr.flush()


def line_of(done: int, failed: int, count: int, seconds: float) -> str:
    """ "128 of 1024 rows, 2 failed, 41 per second, 22 s left"."""
    rate = done / seconds if seconds > 0 else 0.0
    text = f"{done} of {count} rows" + (f", {failed} failed" if failed else "")
    return text + (f", {rate:.3g} per second, {duration_text((count - done) / rate)} left" if rate > 0 else "")


def duration_text(seconds: float) -> str:
    """ "22 s", "3 min", "2.5 h"."""
    if seconds < 100:
        return f"{seconds:.2g} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
