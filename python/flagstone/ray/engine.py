# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Starts or joins Ray without its messages, and sends batches of scans to its workers."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import socket
import threading
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING, Any

from flagstone._optional import needs
from flagstone.ray.worker import Scan, ScanWorker, Task

if TYPE_CHECKING:
    import pyarrow

OBJECT_STORE_BYTES = 256 * 2**20  # it transports only paths and statistics
ENVIRONMENT = {
    "RAY_BACKEND_LOG_LEVEL": "fatal",
    "RAY_enable_output_error_log_if_still_retry": "0",
    "RAY_USAGE_STATS_ENABLED": "0",
}
WAITING_BATCHES = 2  # per worker: one in progress, one next


@contextlib.contextmanager
def connected(address: str | None) -> Iterator[None]:
    """Connects to Ray for the duration of the context.

    Uses the cluster that the caller has already joined. Otherwise joins the cluster at `address`, or at RAY_ADDRESS,
    which Ray sets for submitted jobs. Otherwise starts Ray on this machine with all cores and stops it afterwards.

    Raises:
        ConnectionError: Ray does not respond at the address.
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
            raise ConnectionError(f"Ray at {address}: cannot connect: {reason}") from error
        try:
            yield
        finally:
            ray.shutdown()


def check_answers(address: str) -> None:
    """Tries to connect to host and port, because Ray itself would wait for minutes.

    Raises:
        OSError: The connection fails.
    """
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if host and port.isdecimal():
        socket.create_connection((host.strip("[]"), int(port)), timeout=10).close()


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Disables the messages of Ray and its usage reports."""
    added = {name: value for name, value in ENVIRONMENT.items() if name not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for name in added:
            del os.environ[name]


@contextlib.contextmanager
def quiet_start() -> Iterator[None]:
    """Redirects file descriptor 2, because the C++ part of Ray prints to it. Restores the caller's SIGTERM handler."""
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
    """Number of cores of the cluster."""
    return max(1, int(needs("ray", "ray").cluster_resources().get("CPU", 1)))


def send(task: Task, batches: Iterator[list[Scan]], workers: int) -> Generator[pyarrow.Table, None, None]:
    """Sends batches to workers and yields the statistics of each finished batch, in any order.

    Workers are actors. If a worker dies, Ray restarts it (on another node if its node is lost) and sends it the same
    batches again.

    Args:
        task: Description of the work, the same for all workers.
        batches: Batches of scans; each batch is sent to one worker.
        workers: Number of actors, one core each. If there are fewer cores, only the actors that start do the work.

    Raises:
        RuntimeError: Ray reported an error that it cannot recover from.
    """
    ray = needs("ray", "ray")
    actor = ray.remote(num_cpus=1, max_restarts=-1, max_task_retries=-1)(ScanWorker)
    pool = [actor.remote(task) for _ in range(workers)]
    starting = {worker.ready.remote(): worker for worker in pool}
    in_progress: dict[Any, Any] = {}  # worker of each unfinished batch
    batch: list[Scan] | None = next(batches, None)
    try:
        while batch or in_progress:
            done = ray.wait([*in_progress, *starting], num_returns=1)[0][0]
            rows = ray.get(done)
            is_new = done in starting
            worker = (starting if is_new else in_progress).pop(done)
            for _ in range(WAITING_BATCHES if is_new else 1):
                if batch:
                    in_progress[worker.label.remote(batch)] = worker
                    batch = next(batches, None)
            if not any(other is worker for other in in_progress.values()):
                ray.kill(worker)  # a worker of a lost node may be waiting for this core
            if rows is not None:
                yield rows
    except ray.exceptions.RayError as error:
        reason = str(error).strip().splitlines()[-1]  # the lines above it are a traceback in Ray
        raise RuntimeError(f"Ray failed: {reason} (finished scans are kept; run again to resume)") from error
    finally:
        for worker in pool:
            ray.kill(worker)
