# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The queue that drops its oldest elements, and the throttle of log lines."""

from __future__ import annotations

import threading

from flagstone_ros.latest import LatestQueue
from flagstone_ros.throttle import Throttle


def test_a_full_queue_drops_its_oldest_element() -> None:
    queue: LatestQueue[int] = LatestQueue(2)
    assert [queue.put(i) for i in range(4)] == [0, 0, 1, 1]
    assert [queue.get(), queue.get()] == [2, 3]


def test_an_element_ends_the_wait_of_another_thread() -> None:
    queue: LatestQueue[int] = LatestQueue(1)
    received: list[int | None] = []
    thread = threading.Thread(target=lambda: received.append(queue.get()))
    thread.start()
    queue.put(7)
    thread.join(10)
    assert received == [7]


def test_a_closed_queue_ends_waits_and_returns_nothing() -> None:
    queue: LatestQueue[int] = LatestQueue(3)
    received: list[int | None] = [0]
    thread = threading.Thread(target=lambda: received.append(queue.get()))
    thread.start()
    queue.close()
    thread.join(10)
    queue.put(1)
    assert received == [0, None]
    assert queue.get() is None


def test_a_problem_is_logged_once_per_period_with_the_number_of_withheld_lines() -> None:
    throttle = Throttle(5.0)
    lines = [throttle.line("invalid", f"at {now}", now) for now in (0.0, 1.0, 4.9, 5.0, 6.0, 10.0)]
    assert lines == [
        "at 0.0",
        None,
        None,
        "at 5.0 [2 more since the last line]",
        None,
        "at 10.0 [1 more since the last line]",
    ]


def test_problems_are_throttled_separately() -> None:
    throttle = Throttle(5.0)
    assert throttle.line("invalid", "first", 0.0) == "first"
    assert throttle.line("transform", "second", 1.0) == "second"
