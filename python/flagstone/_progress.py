# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Progress of long operations, on standard error."""

from __future__ import annotations

import sys
import time
from types import TracebackType

_WIDTH = 30  # characters of the bar
_INTERVAL = 0.2  # seconds between updates on a terminal
_LOG_INTERVAL = 5.0  # seconds between lines if standard error is not a terminal


class Progress:
    """On a terminal, one line that is redrawn; otherwise, if `log` is set, one line every few seconds."""

    def __init__(self, total: int, what: str, *, shown: bool = True, log: bool = False) -> None:
        """Starts the clock.

        Args:
            total: Number of items to process.
            what: Name of the items in the plural, for example "scans".
            shown: Whether to print anything.
            log: Whether to print lines if standard error is not a terminal.
        """
        self.total = total
        self._what = what
        self._done = 0
        self._on_terminal = shown and sys.stderr is not None and sys.stderr.isatty()
        self._logs = shown and log and sys.stderr is not None and not self._on_terminal
        self._begin = time.monotonic()
        self._next = self._begin + 1  # operations under a second print nothing
        self._first: tuple[int, float] | None = None  # number of items done at the first call of add(), and its time
        self._is_drawn = False

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.clear()

    def clear(self) -> None:
        """Removes the bar, so that something else can be printed."""
        if self._is_drawn:
            self._draw("")

    def note(self, text: str) -> None:
        """Prints a step that has no count."""
        if self._on_terminal or self._logs:
            self._draw(text)

    def add(self, count: int) -> None:
        """Counts `count` more items. The time left is computed since the first call, which excludes the start-up."""
        self._done += count
        now = time.monotonic()
        first, since = self._first = self._first or (self._done, now)
        if not (self._on_terminal or self._logs) or now < self._next:
            return
        self._next = now + (_INTERVAL if self._on_terminal else _LOG_INTERVAL)
        seconds_each = (now - since) / (self._done - first) if self._done > first else None
        text = progress_text(self._done, self.total, self._what, seconds_each)
        self._draw(text if self._on_terminal else text.partition("] ")[2])

    def _draw(self, text: str) -> None:
        if self._on_terminal:
            sys.stderr.write(f"\r\x1b[K{text}")
            self._is_drawn = True
        else:
            sys.stderr.write(f"{text}\n")
        sys.stderr.flush()


def progress_text(done: int, total: int, what: str, seconds_each: float | None) -> str:
    """One line: a bar, the number of items done and, if `seconds_each` is known, the time left."""
    filled = _WIDTH if total == 0 else _WIDTH * done // total
    text = f"[{'#' * filled:<{_WIDTH}}] {done:,} of {total:,} {what}"
    if seconds_each is not None and done < total:
        text += f", {duration_text(seconds_each * (total - done))} left"
    return text


def duration_text(seconds: float) -> str:
    """A duration in readable form: 5 s, 3 min 04 s, 2 h 10 min."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole // 60 % 60:02} min"
