# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Which scans a worker has begun and not ended, on disk, so that its successor knows what it died of."""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path


class UnderWork:
    """Notes of a worker, which the same worker finds again once it has been restarted on its node.

    Ray gives a batch whose worker died to the worker's successor, again and again. A scan that takes too much memory
    would kill every one of them; the notes say which it is.
    """

    def __init__(self, notes: Path) -> None:
        self._deaths = Counter[str]()
        if notes.exists():
            for line in notes.read_text(encoding="ascii").splitlines():
                self._deaths[line[1:]] += 1 if line.startswith("+") else -1
        self._file = notes.open("ab", buffering=0)  # each line is with the system before the next step

    @contextlib.contextmanager
    def on(self, scan: str) -> Iterator[None]:
        """While a scan is under work."""
        self._note("+", scan)
        try:
            yield
        finally:
            self._note("-", scan)

    def deaths(self, scan: str) -> int:
        """How many of this worker's predecessors died while they had the scan under work."""
        return self._deaths[ascii(scan)]

    def _note(self, sign: str, scan: str) -> None:
        self._file.write(f"{sign}{scan!a}\n".encode("ascii"))
