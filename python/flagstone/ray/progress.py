# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The line that says how far a run is, on a terminal."""

from __future__ import annotations

import sys
import time


def duration_text(seconds: float) -> str:
    """Seconds as people say them: 5 s, 3 min 04 s, 2 h 10 min."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole // 60 % 60:02} min"


def progress_text(done: int, total: int, seconds: float) -> str:
    """A bar, how many are done, and how long the rest takes where that is known."""
    width = 30
    filled = width * done // total if total else width
    text = f"[{'#' * filled}{' ' * (width - filled)}] {done} of {total} scans"
    if 0 < done < total:
        text += f", {duration_text(seconds / done * (total - done))} left"
    return text


class Progress:
    """One line on standard error, drawn again and again; nothing where that is no terminal."""

    def __init__(self, wanted: bool = True) -> None:
        self._is_shown = wanted and sys.stderr.isatty()
        self._begun = time.monotonic()
        self._next = 0.0

    def note(self, text: str) -> None:
        """What is done before the first scan."""
        self._draw(text)

    def begin(self) -> None:
        """The time left is reckoned from now."""
        self._begun = time.monotonic()

    def show(self, done: int, total: int) -> None:
        now = time.monotonic()
        if now >= self._next or done == total:
            self._next = now + 0.1
            self._draw(progress_text(done, total, now - self._begun))

    def clear(self) -> None:
        self._draw("")

    def _draw(self, text: str) -> None:
        if self._is_shown:
            print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
