# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""How far a long piece of work is, on standard error."""

from __future__ import annotations

import sys
import time
from types import TracebackType

_WIDTH = 30  # characters, of the bar
_PAUSE = 0.2  # seconds between two updates on a terminal, which eyes can follow
_PAUSE_OF_LOG = 5.0  # seconds between two lines elsewhere


class Progress:
    """On a terminal one line, drawn anew as the work goes on; elsewhere, if `log`, a line every few seconds."""

    def __init__(self, total: int, what: str, *, shown: bool = True, log: bool = False) -> None:
        """Begins.

        Args:
            total: How much there is to do.
            what: The things that are counted, such as "scans".
            shown: Whether to say anything at all.
            log: Whether to write lines where standard error is not a terminal.
        """
        self.total = total
        self._what = what
        self._done = 0
        self._on_terminal = shown and sys.stderr is not None and sys.stderr.isatty()
        self._logs = shown and log and sys.stderr is not None and not self._on_terminal
        self._begin = time.monotonic()
        self._next = self._begin + 1  # short work draws nothing
        self._first: tuple[int, float] | None = None  # how many were done when the first were, and when that was
        self._is_drawn = False

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._is_drawn:
            self._draw("")

    def note(self, text: str) -> None:
        """Says what is done before anything can be counted."""
        if self._on_terminal or self._logs:
            self._draw(text)

    def add(self, count: int) -> None:
        """So many more are done. The time left is computed from the first ones on, so that it has no start in it."""
        self._done += count
        now = time.monotonic()
        first, since = self._first = self._first or (self._done, now)
        if not (self._on_terminal or self._logs) or now < self._next:
            return
        self._next = now + (_PAUSE if self._on_terminal else _PAUSE_OF_LOG)
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
    """One line: a bar, how many are done, and how long the rest takes if it is known how long each does."""
    filled = _WIDTH if total == 0 else _WIDTH * done // total
    text = f"[{'#' * filled:<{_WIDTH}}] {done:,} of {total:,} {what}"
    if seconds_each is not None and done < total:
        text += f", {duration_text(seconds_each * (total - done))} left"
    return text


def duration_text(seconds: float) -> str:
    """Seconds as people say them: 5 s, 3 min 04 s, 2 h 10 min."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole // 60 % 60:02} min"
