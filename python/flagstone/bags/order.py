# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Work on some items of a sequence by several threads, with results in the order of the sequence."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

WAITING_ITEMS = 256
"""At most this many items wait for the work on an earlier item; this limits the memory that they occupy."""


def in_order(
    items: Iterable[Item],
    work_of: Callable[[Item], Callable[[Item], Result] | None],
    threads: int,
    on_wait: Callable[[float], None] = lambda seconds: None,
) -> Iterator[tuple[Item, Result | None]]:
    """Yields each item with the result of its work, in the order of the items.

    Args:
        items: Read by the calling thread.
        work_of: Returns the function that a thread calls with the item; None for an item without work and result.
        threads: Number of threads.
        on_wait: Called with the seconds for which the calling thread waited for a result.

    Raises:
        Exception: An exception of the work, at the position of its item.
    """
    pending: deque[tuple[Item, Future[Result] | None]] = deque()
    busy = 0  # pending items with work

    def next_result() -> tuple[Item, Result | None]:
        nonlocal busy
        item, future = pending.popleft()
        if future is None:
            return item, None
        busy -= 1
        begun = time.perf_counter()
        result = future.result()
        on_wait(time.perf_counter() - begun)
        return item, result

    executor = ThreadPoolExecutor(threads, thread_name_prefix="flagstone")
    try:
        for item in items:
            work = work_of(item)
            pending.append((item, None if work is None else executor.submit(work, item)))
            busy += work is not None
            while pending and (
                (first := pending[0][1]) is None or first.done() or busy > 2 * threads or len(pending) > WAITING_ITEMS
            ):
                yield next_result()
        while pending:
            yield next_result()
    finally:
        executor.shutdown(cancel_futures=True)
