# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Summary of a run."""

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
        path: Path of the scan, relative to the source.
        error: Reason, in one line.
    """

    path: str
    error: str


@dataclass(frozen=True)
class Summary:
    """Result of a run. `print` shows it in a few lines.

    Attributes:
        scans: Number of scans in the source.
        already_labelled: Number of scans labelled by earlier runs.
        labelled: Number of scans labelled by this run.
        failures: Scans that could not be labelled, with reasons.
        points: Number of points labelled by this run.
        bytes: Size of the scans that this run labelled.
        seconds: Time from the start of the first scan to the end of the last one, without listing scans and starting
            Ray.
        workers: Number of actors, one core each.
        read_ms: Total time of reading, milliseconds.
        segment_ms: Total time of segmentation, milliseconds.
        write_ms: Total time of writing, milliseconds.
        statistics: Directory of the Parquet files with one row per scan.
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
            lines[0] += f"; {self.already_labelled} already labelled"
        if self.labelled and self.seconds > 0:
            lines.append(self._throughput())
        if self.failures:
            lines.append(f"{len(self.failures)} failed:")
            lines += [f"  {failure.error}" for failure in self.failures[:FAILURES_LISTED]]
            if len(self.failures) > FAILURES_LISTED:
                lines.append(f"  and {len(self.failures) - FAILURES_LISTED} more, listed in the statistics")
        lines.append(f"statistics: {self.statistics}")
        return "\n".join(lines)

    def _throughput(self) -> str:
        return (
            f"{self.labelled / self.seconds:.1f} scans per second, {self.bytes / 1e6 / self.seconds:.1f} MB/s with "
            f"{self.workers} {'worker' if self.workers == 1 else 'workers'}; per scan: "
            f"{self.bytes / 1e6 / self.labelled:.2f} MB, read {self.read_ms / self.labelled:.2f} ms, "
            f"segment {self.segment_ms / self.labelled:.2f} ms, write {self.write_ms / self.labelled:.2f} ms"
        )


@dataclass
class Tally:
    """Sums of the rows of a run."""

    scans: int
    already_labelled: int
    statistics: str
    failures: list[Failure] = field(default_factory=list)
    labelled: int = 0
    points: int = 0
    bytes: int = 0
    started_at: datetime | None = None  # of the first scan, by the clocks of the nodes
    finished_at: datetime | None = None  # of the last scan
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
    """A run was interrupted. Finished scans are kept; run again to resume.

    Attributes:
        summary: Results until the interruption.
    """

    def __init__(self, summary: Summary) -> None:
        done = summary.labelled + summary.already_labelled
        super().__init__(f"interrupted: {done} of {summary.scans} scans are finished (run again to resume)")
        self.summary = summary
