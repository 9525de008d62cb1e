# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""How far a long piece of work is, on a terminal."""

from __future__ import annotations

import sys
import time
from types import TracebackType

_width = 30


class Progress:
    """A line on standard error that is drawn anew as the work goes on. Silent where that is no terminal."""

    def __init__(self, total: int, what: str) -> None:
        self._total = total
        self._what = what
        self._done = 0
        self._begin = time.monotonic()
        self._drawn = self._begin
        self._on_terminal = sys.stderr is not None and sys.stderr.isatty()

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._drawn > self._begin:
            self._show("")

    def add(self, count: int) -> None:
        """So many more are done."""
        self._done += count
        now = time.monotonic()
        # Short work draws nothing, long work no more often than eyes can follow.
        if not self._on_terminal or now - self._drawn < 0.2 or now - self._begin < 1:
            return
        self._drawn = now
        self._show(progress_text(self._done, self._total, self._what, now - self._begin))

    def _show(self, text: str) -> None:
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()


def progress_text(done: int, total: int, what: str, seconds: float) -> str:
    """One line: a bar, how many are done, how long the rest will take at the same pace."""
    filled = _width if total == 0 else _width * done // total
    text = f"[{'#' * filled:<{_width}}] {done:,} of {total:,} {what}"
    if 0 < done < total:
        text += f", {duration_text(seconds / done * (total - done))} left"
    return text


def duration_text(seconds: float) -> str:
    """Seconds as people say them: 5 s, 3 min 04 s, 2 h 10 min."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole // 60 % 60:02} min"
