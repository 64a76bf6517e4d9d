"""Rows on their way: a batch for one worker, and what it made of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pounding.studies.template import Template

NOT_RUN, DONE, EXCEEDED, REFUSED, FAILED, DIED, COLLAPSED = range(7)
#: Rows that have their numbers.
COMPLETE = (DONE, EXCEEDED, COLLAPSED)
#: Outcome of a row, by its number in the column `status`. Tables store the numbers, so new ones are appended.
STATUSES = ("not run", "done", "exceeded a limit", "refused input", "solve failed", "worker died", "collapsed")


@dataclass(frozen=True)
class Batch:
    """Some rows for one worker."""

    template: Template
    rows: np.ndarray  #: [row] their numbers in the plan
    values: np.ndarray  #: [row, factor] in SI
    record: np.ndarray  #: [row] numbers of motions
    scale: np.ndarray  #: [row] factors on the motions
    engine: str  #: "auto", or the name of the one that shall run all of them
    #: contents of the files of its motions, by the names that these give them
    files: Mapping[str, bytes] = field(default_factory=dict)

    def part(self, chosen: Sequence[int] | np.ndarray) -> Batch:
        """Some of the rows."""
        return replace(
            self,
            rows=self.rows[chosen],
            values=self.values[chosen],
            record=self.record[chosen],
            scale=self.scale[chosen],
        )


@dataclass
class Done:
    """The columns of some rows."""

    rows: np.ndarray  #: [row] their numbers in the plan
    values: np.ndarray  #: [row, column] NaN where a row has none
    status: np.ndarray  #: [row] one of STATUSES
    engine: np.ndarray  #: [row] the number of its engine; -1 for none
    seconds: np.ndarray  #: [row] wall time
    reasons: dict[int, str]  #: of rows that are neither done nor exceeded; of a collapsed row where and when

    def part(self, chosen: np.ndarray) -> Done:
        """Some of the rows."""
        rows = self.rows[chosen]
        kept = set(rows.tolist())
        return Done(
            rows,
            self.values[chosen],
            self.status[chosen],
            self.engine[chosen],
            self.seconds[chosen],
            {row: why for row, why in self.reasons.items() if row in kept},
        )

    def take(self, chosen: np.ndarray, other: Done, engine: int) -> None:
        """Puts what an engine has made of the chosen rows into their places; those that it did not run stay, with its
        reason."""
        ran = other.status != NOT_RUN
        places = chosen[ran]
        self.values[places], self.status[places], self.seconds[places] = (
            other.values[ran],
            other.status[ran],
            other.seconds[ran],
        )
        self.engine[places] = engine
        for row in self.rows[places].tolist():
            self.reasons.pop(row, None)
        self.reasons.update(other.reasons)


def nothing_of(batch: Batch, status: int = NOT_RUN) -> Done:
    """Rows without columns."""
    count = len(batch.rows)
    return Done(
        batch.rows,
        np.full((count, len(batch.template.kept.columns)), np.nan),
        np.full(count, status, np.int8),
        np.full(count, -1, np.int8),
        np.zeros(count),
        {},
    )
