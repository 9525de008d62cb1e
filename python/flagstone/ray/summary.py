# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What came of a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

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
        finished_before: Those that an earlier run had labelled.
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
    finished_before: int
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
        if self.finished_before:
            lines[0] += f"; {self.finished_before} were finished before"
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


class Interrupted(KeyboardInterrupt):
    """A run was interrupted. What is done stays done; run it again for the rest.

    Attributes:
        summary: What came of it until then.
    """

    def __init__(self, summary: Summary) -> None:
        done = summary.labelled + summary.finished_before
        super().__init__(f"interrupted, {done} of {summary.scans} scans are done; run it again for the rest")
        self.summary = summary
