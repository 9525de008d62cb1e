# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Ray started or joined, quietly, and batches of scans sent through Ray Data."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import socket
import threading
from collections.abc import Iterator
from typing import TYPE_CHECKING

from flagstone._optional import needs
from flagstone.ray.worker import ScanWorker, Task

if TYPE_CHECKING:
    import pyarrow

OBJECT_STORE_BYTES = 256 * 2**20  # only paths and statistics go through it
ENVIRONMENT = {
    "RAY_BACKEND_LOG_LEVEL": "fatal",
    "RAY_enable_output_error_log_if_still_retry": "0",
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_DATA_USAGE_DISABLED": "1",
}
WAITING_BATCHES = 2  # at each worker: one under work, one next


@contextlib.contextmanager
def connected(address: str | None) -> Iterator[None]:
    """Ray, for as long as the context lasts.

    Joins the cluster at `address` or in the environment's RAY_ADDRESS, which submitted jobs have; else starts Ray on
    this machine with all cores and ends it afterwards. Where the caller has joined one already, that one is used.

    Raises:
        ConnectionError: There is no Ray at the address.
    """
    ray = needs("ray", "ray")
    with quiet():
        if ray.is_initialized():
            yield
            return
        address = address or os.environ.get("RAY_ADDRESS") or "local"
        alone = {"num_cpus": len(os.sched_getaffinity(0)), "object_store_memory": OBJECT_STORE_BYTES}
        try:
            check_answers(address)
            with quiet_start():
                ray.init(
                    address=address,
                    include_dashboard=False,
                    log_to_driver=False,
                    logging_level=logging.ERROR,
                    **(alone if address == "local" else {}),
                )
        except (OSError, RuntimeError, ValueError) as error:
            reason = " ".join(str(error).split())
            raise ConnectionError(f"Ray at {address}: cannot be had: {reason}") from error
        try:
            yield
        finally:
            ray.shutdown()


def check_answers(address: str) -> None:
    """Tries host and port, for which Ray itself would wait for minutes.

    Raises:
        OSError: Nobody answers there.
    """
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if host and port.isdecimal():
        socket.create_connection((host.strip("[]"), int(port)), timeout=10).close()


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Ray's messages and progress bars turned off, and its reports to its makers."""
    context = needs("ray.data", "ray").DataContext.get_current()
    logger = logging.getLogger("ray.data")
    bars, level = context.enable_progress_bars, logger.level
    context.enable_progress_bars = False
    logger.setLevel(logging.CRITICAL)
    added = {name: value for name, value in ENVIRONMENT.items() if name not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for name in added:
            del os.environ[name]
        context.enable_progress_bars = bars
        logger.setLevel(level)


@contextlib.contextmanager
def quiet_start() -> Iterator[None]:
    """File descriptor 2 turned away, to which Ray's C++ parts say how loud they will be; SIGTERM stays the caller's."""
    is_main = threading.current_thread() is threading.main_thread()
    on_terminate = signal.getsignal(signal.SIGTERM)
    kept = os.dup(2)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
        if is_main and on_terminate is not None:
            signal.signal(signal.SIGTERM, on_terminate)


def core_count() -> int:
    """The cores of the cluster."""
    return max(1, int(needs("ray", "ray").cluster_resources().get("CPU", 1)))


def send(task: Task, batches: list[pyarrow.Table], workers: int) -> Iterator[pyarrow.Table]:
    """The rows of the batches as they are done, in any order.

    Ray Data restarts a worker that died, on another node where its own is lost, and gives it its batches again.

    Args:
        task: What to do.
        batches: Tables with the columns `path` and `bytes`; each goes to a worker whole.
        workers: Actors, a core each. Where there are fewer cores, at least one starts.

    Raises:
        RuntimeError: Ray gave up.
    """
    ray = needs("ray", "ray")
    data = ray.data.from_arrow(batches).map_batches(
        ScanWorker,
        fn_constructor_args=(task,),
        batch_size=None,
        batch_format="pyarrow",
        compute=ray.data.ActorPoolStrategy(
            min_size=1, max_size=workers, initial_size=workers, max_tasks_in_flight_per_actor=WAITING_BATCHES
        ),
        num_cpus=1,
    )
    try:
        yield from data.iter_batches(batch_size=None, batch_format="pyarrow")
    except ray.exceptions.RayError as error:
        reason = str(error).strip().splitlines()[-1]  # above it stands where in Ray that was
        raise RuntimeError(f"Ray gave up: {reason}; what is done stays done, run it again for the rest") from error
