# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What came of a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import pyarrow

FAILURES_LISTED = 20


class Failure(NamedTuple):
    """A scan that could not be labelled.

    Attributes:
        path: The scan, below the source.
        error: Why, in one line.
    """

    path: str
    error: str


@dataclass(frozen=True)
class Summary:
    """What came of a run; printed, it is a few lines for people.

    Attributes:
        scans: Scans in the source.
        already_labelled: Those that an earlier run had labelled.
        labelled: Those that this run labelled.
        failures: Those that it could not label, and why.
        points: Points labelled in this run.
        bytes: Bytes of scans read for that.
        seconds: From the first scan begun to the last one done; listing scans and starting Ray are not in it.
        workers: Actors at work, a core each.
        read_ms: Milliseconds of reading, added up over the scans of this run.
        segment_ms: Milliseconds of segmenting, added up.
        write_ms: Milliseconds of writing, added up.
        statistics: The folder of Parquet files with a row a scan.
    """

    scans: int
    already_labelled: int
    labelled: int
    failures: tuple[Failure, ...]
    points: int
    bytes: int
    seconds: float
    workers: int
    read_ms: float
    segment_ms: float
    write_ms: float
    statistics: str

    def __str__(self) -> str:
        lines = [f"{self.labelled} of {self.scans} scans labelled, {self.points} points"]
        if self.already_labelled:
            lines[0] += f"; {self.already_labelled} were already labelled"
        if self.labelled and self.seconds > 0:
            lines.append(self._throughput())
        if self.failures:
            lines.append(f"{len(self.failures)} failed:")
            lines += [f"  {failure.error}" for failure in self.failures[:FAILURES_LISTED]]
            if len(self.failures) > FAILURES_LISTED:
                lines.append(f"  and {len(self.failures) - FAILURES_LISTED} more, in the statistics")
        lines.append(f"statistics: {self.statistics}")
        return "\n".join(lines)

    def _throughput(self) -> str:
        return (
            f"{self.labelled / self.seconds:.1f} scans a second, {self.bytes / 1e6 / self.seconds:.1f} MB/s read by "
            f"{self.workers} {'worker' if self.workers == 1 else 'workers'}; a scan: "
            f"{self.bytes / 1e6 / self.labelled:.2f} MB, {self.read_ms / self.labelled:.2f} ms reading, "
            f"{self.segment_ms / self.labelled:.2f} ms segmenting, {self.write_ms / self.labelled:.2f} ms writing"
        )


@dataclass
class Tally:
    """Adds up the rows of a run."""

    scans: int
    already_labelled: int
    statistics: str
    failures: list[Failure] = field(default_factory=list)
    labelled: int = 0
    points: int = 0
    bytes: int = 0
    started_at: datetime | None = None  # the first scan, by the clocks of the workers' nodes
    finished_at: datetime | None = None  # the last one
    workers: int = 0
    read_ms: float = 0
    segment_ms: float = 0
    write_ms: float = 0

    def add(self, rows: pyarrow.Table) -> None:
        import pyarrow.compute as pc

        good = rows.filter(pc.is_null(rows["error"]))
        self.labelled += good.num_rows
        for name in ("points", "bytes", "read_ms", "segment_ms", "write_ms"):
            setattr(self, name, getattr(self, name) + (pc.sum(good[name]).as_py() or 0))
        first, last = pc.min(rows["started_at"]).as_py(), pc.max(rows["finished_at"]).as_py()
        self.started_at = min(first, self.started_at or first)
        self.finished_at = max(last, self.finished_at or last)
        for row in rows.filter(pc.is_valid(rows["error"])).select(["path", "error"]).to_pylist():
            self.failures.append(Failure(row["path"], row["error"]))

    def summary(self) -> Summary:
        return Summary(
            scans=self.scans,
            already_labelled=self.already_labelled,
            labelled=self.labelled,
            failures=tuple(sorted(self.failures)),
            points=self.points,
            bytes=self.bytes,
            seconds=(self.finished_at - self.started_at).total_seconds() if self.started_at and self.finished_at else 0,
            workers=self.workers,
            read_ms=self.read_ms,
            segment_ms=self.segment_ms,
            write_ms=self.write_ms,
            statistics=self.statistics,
        )


class Interrupted(KeyboardInterrupt):
    """A run was interrupted. What is done stays done; run it again for the rest.

    Attributes:
        summary: What came of it until then.
    """

    def __init__(self, summary: Summary) -> None:
        done = summary.labelled + summary.already_labelled
        super().__init__(f"interrupted, {done} of {summary.scans} scans are done; run it again for the rest")
        self.summary = summary
