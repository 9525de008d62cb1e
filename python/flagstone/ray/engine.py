# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Ray started or joined, quietly, and batches of scans sent through it."""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

from flagstone.ray.worker import ScanWorker, Task

if TYPE_CHECKING:
    import pyarrow

OBJECT_STORE_BYTES = 256 * 2**20  # only paths and statistics go through it
RETRIES = 3  # of a batch whose worker died; a node that is lost costs its batches one


@contextlib.contextmanager
def connected(address: str | None) -> Iterator[None]:
    """Ray, for as long as the context lasts.

    Joins the cluster at `address` or in the environment's RAY_ADDRESS, as in a submitted job; else starts Ray on this
    machine with all cores and ends it afterwards. Where the caller has joined one already, that one is used and left.
    """
    ray = import_ray()
    if ray.is_initialized():
        with quiet():
            yield
        return
    address = address or os.environ.get("RAY_ADDRESS") or "local"
    with quiet():
        if address == "local":
            os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
            ray.init(
                address="local",
                num_cpus=len(os.sched_getaffinity(0)),
                object_store_memory=OBJECT_STORE_BYTES,
                include_dashboard=False,
                log_to_driver=False,
                logging_level=logging.ERROR,
            )
        else:
            try:
                ray.init(address=address, log_to_driver=False, logging_level=logging.ERROR)
            except (ConnectionError, ValueError, RuntimeError) as error:
                text = " ".join(str(error).split())
                raise ConnectionError(f"Ray at {address}: cannot be joined: {text}") from None
        try:
            yield
        finally:
            ray.shutdown()


def import_ray():  # type: ignore[no-untyped-def]
    try:
        import ray
        import ray.data
    except ImportError as error:
        raise ImportError(f"Ray is not installed ({error}): pip install 'flagstone[ray]'") from None
    return ray


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Ray Data's progress bars and messages turned off: we have our own."""
    import ray.data

    context = ray.data.DataContext.get_current()
    logger = logging.getLogger("ray.data")
    before = context.enable_progress_bars, logger.level
    context.enable_progress_bars = False
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        context.enable_progress_bars, level = before
        logger.setLevel(level)


def core_count() -> int:
    """The cores of the cluster."""
    import ray

    return max(1, int(ray.cluster_resources().get("CPU", 1)))


def send(task: Task, batches: list[pyarrow.Table], workers: int, *, at_once: int) -> Iterator[pyarrow.Table]:
    """The rows of the batches as they are done, in any order; none of a batch whose workers died again and again.

    Args:
        task: What to do.
        batches: Tables with the columns `path` and `bytes`; each goes to a worker whole.
        workers: Actors, a core each.
        at_once: Batches that wait at a worker or are under work there.
    """
    import ray.data

    context = ray.data.DataContext.get_current()
    before = context.max_errored_blocks
    context.max_errored_blocks = -1  # a batch that is lost is missed by the caller
    try:
        data = ray.data.from_arrow(batches).map_batches(
            ScanWorker,
            fn_constructor_args=(task,),
            batch_size=None,
            batch_format="pyarrow",
            compute=ray.data.ActorPoolStrategy(
                min_size=1, max_size=workers, initial_size=workers, max_tasks_in_flight_per_actor=at_once
            ),
            num_cpus=1,
            max_restarts=-1,
            max_task_retries=RETRIES,
        )
        yield from data.iter_batches(batch_size=None, batch_format="pyarrow", prefetch_batches=0)
    finally:
        context.max_errored_blocks = before
