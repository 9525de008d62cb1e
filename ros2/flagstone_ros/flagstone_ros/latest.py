# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A queue between threads that drops its oldest elements when it is full."""

from __future__ import annotations

import threading
from collections import deque
from typing import Generic, TypeVar

Element = TypeVar("Element")


class LatestQueue(Generic[Element]):
    """The latest elements, in their order. Thread-safe."""

    def __init__(self, depth: int) -> None:
        """Creates a queue for at most `depth` elements, at least 1."""
        self._elements: deque[Element] = deque()
        self._depth = depth
        self._changed = threading.Condition()
        self._is_closed = False

    def put(self, element: Element) -> int:
        """Adds an element, and returns how many of the oldest were dropped for it: 0 or 1. Never waits."""
        with self._changed:
            self._elements.append(element)
            dropped = len(self._elements) - self._depth
            if dropped > 0:
                self._elements.popleft()
            self._changed.notify()
            return max(0, dropped)

    def get(self) -> Element | None:
        """Removes and returns the oldest element. Waits for one; returns None if the queue is closed."""
        with self._changed:
            while not self._elements and not self._is_closed:
                self._changed.wait()
            return None if self._is_closed else self._elements.popleft()

    def close(self) -> None:
        """Ends all waiting calls of `get`, now and later. Elements that wait are not returned."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
