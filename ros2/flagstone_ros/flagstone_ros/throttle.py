# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Limits how often the same problem is logged."""

from __future__ import annotations


class Throttle:
    """Lets one line per problem and period pass, with the number of lines it withheld before. Not thread-safe."""

    def __init__(self, period: float) -> None:
        """Creates a throttle. `period`: minimum time between two lines about the same problem, seconds."""
        self._period = period
        self._last: dict[str, float] = {}
        self._withheld: dict[str, int] = {}

    def line(self, problem: str, text: str, now: float) -> str | None:
        """The line to log, or None.

        Args:
            problem: Identifies the problem; lines about other problems have no effect on it.
            text: One line.
            now: Time in seconds, of any epoch.
        """
        last = self._last.get(problem)
        if last is not None and now - last < self._period:
            self._withheld[problem] = self._withheld.get(problem, 0) + 1
            return None
        self._last[problem] = now
        withheld = self._withheld.pop(problem, 0)
        return f"{text} [{withheld} more since the last line]" if withheld else text
