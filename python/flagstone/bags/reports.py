# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Lines about damaged parts of a bag."""

from __future__ import annotations

from collections.abc import Callable

MAX_LINES = 100
"""A bag with more problems is reported as such."""


class Reports:
    """Passes each line on once, however often the bag is read, and limits their number."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._lines: set[str] = set()

    def __call__(self, where: object, problem: str) -> None:
        """Reports `WHERE: PROBLEM`, on one line."""
        line = one_line(f"{where}: {problem}")
        if line in self._lines or len(self._lines) > MAX_LINES:
            return
        self._lines.add(line)
        if len(self._lines) > MAX_LINES:
            line = one_line(f"{where}: more than {MAX_LINES} problems (further problems are not reported)")
        self._report(line)


def one_line(text: str) -> str:
    """The text with line breaks and other control characters as escapes."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape", "surrogatepass").decode() for c in text)


class DamagedError(ValueError):
    """A part of a bag that cannot be read. The message contains the reason alone."""
