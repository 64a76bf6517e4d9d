"""Batches of rows for a worker, and their results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pounding._studies.template import Template

NOT_RUN, DONE, EXCEEDED, REFUSED, FAILED, DIED, COLLAPSED = range(7)
#: Statuses of rows with numbers.
COMPLETE = (DONE, EXCEEDED, COLLAPSED)
#: Names of the values in the column `status`. Tables store the values, so new names are appended.
STATUSES = ("not run", "done", "exceeded a limit", "refused input", "solve failed", "worker died", "collapsed")


def side_by_side(columns: Sequence[np.ndarray], rows: int) -> np.ndarray:
    """[row, column] of columns with this number of rows; also without columns."""
    return np.column_stack(columns) if columns else np.empty((rows, 0))


@dataclass(frozen=True)
class Batch:
    """Rows for one worker."""

    template: Template
    rows: np.ndarray  #: [row] their numbers in the plan
    values: np.ndarray  #: [row, factor] in SI
    record: np.ndarray  #: [row] numbers of motions
    scale: np.ndarray  #: [row] factors on the motions
    engine: str  #: name of the engine for all rows, or "auto"
    #: contents of the files of the motions, by name
    files: Mapping[str, bytes] = field(default_factory=dict)

    def part(self, chosen: Sequence[int] | np.ndarray) -> Batch:
        """A subset of the rows."""
        own = {name: getattr(self, name)[chosen] for name in ("rows", "values", "record", "scale")}
        return replace(self, **own)


@dataclass
class Done:
    """Results of the rows of a batch."""

    rows: np.ndarray  #: [row] their numbers in the plan
    values: np.ndarray  #: [row, column]; NaN if a row has no value
    status: np.ndarray  #: [row] one of STATUSES
    engine: np.ndarray  #: [row] index of the engine; -1 for none
    seconds: np.ndarray  #: [row] wall time
    reasons: dict[int, str]  #: row -> reason of a failure, or place and time of a collapse

    def part(self, chosen: np.ndarray) -> Done:
        """A subset of the rows."""
        own = {name: getattr(self, name)[chosen] for name in ("rows", "values", "status", "engine", "seconds")}
        kept = set(own["rows"].tolist())
        return Done(**own, reasons={row: why for row, why in self.reasons.items() if row in kept})

    def take(self, chosen: np.ndarray, other: Done, engine: int) -> None:
        """Copies the results of the chosen rows from an engine. Rows that it did not run keep their values and take
        its reason."""
        ran = other.status != NOT_RUN
        places = chosen[ran]
        for mine, theirs in ((self.values, other.values), (self.status, other.status), (self.seconds, other.seconds)):
            mine[places] = theirs[ran]
        self.engine[places] = engine
        for row in self.rows[places].tolist():
            self.reasons.pop(row, None)
        self.reasons.update(other.reasons)


def nothing_of(batch: Batch, status: int = NOT_RUN) -> Done:
    """Results of a batch before any row has run."""
    count = len(batch.rows)
    return Done(
        batch.rows,
        np.full((count, len(batch.template.kept.columns)), np.nan),
        np.full(count, status, np.int8),
        np.full(count, -1, np.int8),
        np.zeros(count),
        {},
    )
