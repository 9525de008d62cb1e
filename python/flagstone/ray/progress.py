# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The line that says how far a run is, on a terminal."""

from __future__ import annotations

import sys
import time

from flagstone._progress import duration_text


def progress_text(done: int, total: int, seconds_each: float | None) -> str:
    """A bar, how many are done, and how long the rest takes where it is known how long each does."""
    width = 30
    filled = width * done // total if total else width
    text = f"[{'#' * filled}{' ' * (width - filled)}] {done} of {total} scans"
    if seconds_each is not None and done < total:
        text += f", {duration_text(seconds_each * (total - done))} left"
    return text


class Progress:
    """One line on standard error, drawn again and again; nothing where that is no terminal."""

    def __init__(self, wanted: bool = True) -> None:
        self._is_shown = wanted and sys.stderr.isatty()
        self._first: tuple[int, float] | None = None  # how many were done when the first came, and when that was
        self._next = 0.0

    def note(self, text: str) -> None:
        """What is done before the first scan."""
        self._draw(text)

    def show(self, done: int, total: int) -> None:
        """How far it is; the time left is reckoned from the first scans done on, so that no start is in it."""
        now = time.monotonic()
        first, since = self._first = self._first or (done, now)
        if now >= self._next or done == total:
            self._next = now + 0.1
            self._draw(progress_text(done, total, (now - since) / (done - first) if done > first else None))

    def clear(self) -> None:
        self._draw("")

    def _draw(self, text: str) -> None:
        if self._is_shown:
            print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
