# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Summary of a run of `flagstone.bag`."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

LINES_PER_KIND = 10
"""Failures with the same message, apart from numbers, are listed up to this number."""


class Failure(NamedTuple):
    """A point cloud without labels.

    Attributes:
        topic: Its topic.
        message: Its index in the topic, from 0.
        error: The reason, in one line.
    """

    topic: str
    message: int
    error: str


@dataclass
class BagTimes:
    """Times of a run, in seconds.

    Attributes:
        total: From the first message to the finished bag.
        read: Of the thread that reads and writes: reading.
        write: Of the thread that reads and writes: writing.
        wait: Of the thread that reads and writes: waiting for labels.
        segment: Of all threads together: reading coordinates and segmenting.
        encode: Of all threads together: creating the added messages.
    """

    total: float = 0
    read: float = 0
    write: float = 0
    wait: float = 0
    segment: float = 0
    encode: float = 0

    @property
    def bottleneck(self) -> str:
        """The part that limits the speed: "reading", "writing" or "segmenting"."""
        parts = {"reading": self.read, "writing": self.write, "segmenting": self.wait}
        return max(parts, key=lambda name: parts[name])


@dataclass(frozen=True)
class BagSummary:
    """Result of `flagstone.bag`. `print` shows it in a few lines.

    Attributes:
        destination: The bag that was written.
        messages: Number of messages that were copied.
        topics: Added topics for each labelled topic.
        clouds: Number of point clouds that were labelled.
        failures: Point clouds that have no labels. They are copied.
        problems: Damaged or missing parts of the input, one line each.
        points: Number of labelled points.
        counts: Number of points for each of the five label names.
        bytes: Size of all messages, copied and added.
        threads: Number of threads that label clouds.
        times: Times of the parts of the run.
    """

    destination: str
    messages: int
    topics: dict[str, tuple[str, ...]]
    clouds: int
    failures: tuple[Failure, ...]
    problems: tuple[str, ...]
    points: int
    counts: dict[str, int]
    bytes: int
    threads: int
    times: BagTimes = field(default_factory=BagTimes)

    @property
    def ok(self) -> bool:
        """Whether every cloud has labels, and no part of the input is damaged."""
        return not self.failures and not self.problems

    def __str__(self) -> str:
        lines = [f"{topic}: {', '.join(added)} added" for topic, added in self.topics.items()]
        ground = 100 * self.counts.get("ground", 0) / self.points if self.points else 0
        lines.append(
            f"{self.destination}: {self.messages} messages copied, {self.clouds} of "
            f"{self.clouds + len(self.failures)} clouds labelled, {self.points} points, {ground:.1f} % ground"
        )
        if self.clouds and self.times.total > 0:
            lines.append(self._throughput())
        return "\n".join(lines)

    def _throughput(self) -> str:
        times = self.times
        parts = ", ".join(
            f"{name} {1000 * getattr(times, name) / self.clouds:.2f} ms"
            for name in ("read", "write", "wait", "segment", "encode")
        )
        return (
            f"{self.clouds / times.total:.1f} clouds per second, {self.bytes / 1e6 / times.total:.0f} MB/s, "
            f"{self.threads} {'thread' if self.threads == 1 else 'threads'}; per cloud: {parts}; "
            f"bottleneck: {times.bottleneck}"
        )


class FailureLines:
    """Prints failures, at most ten of the same kind, and then their number."""

    def __init__(self, print_line: Callable[[str], None]) -> None:
        self._print_line = print_line
        self._counts: dict[str, int] = {}

    def add(self, where: str, error: str) -> None:
        """Prints `WHERE: ERROR` unless ten lines of this kind were printed."""
        kind = re.sub(r"\d+", "N", error)
        self._counts[kind] = self._counts.get(kind, 0) + 1
        if self._counts[kind] <= LINES_PER_KIND:
            self._print_line(f"{where}: {error}")

    def finish(self, where: str) -> None:
        """Prints how many lines of each kind were omitted."""
        for kind, count in self._counts.items():
            if count > LINES_PER_KIND:
                self._print_line(f"{where}: {count - LINES_PER_KIND} more messages with the error: {kind}")
