# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Ray started or joined, quietly, and batches of scans sent to its workers."""

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

OBJECT_STORE_BYTES = 256 * 2**20  # only paths and statistics go through it
ENVIRONMENT = {
    "RAY_BACKEND_LOG_LEVEL": "fatal",
    "RAY_enable_output_error_log_if_still_retry": "0",
    "RAY_USAGE_STATS_ENABLED": "0",
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
    """Ray's messages turned off, and its reports to its makers."""
    added = {name: value for name, value in ENVIRONMENT.items() if name not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for name in added:
            del os.environ[name]


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


def send(task: Task, batches: Iterator[list[Scan]], workers: int) -> Generator[pyarrow.Table, None, None]:
    """The rows of the batches as they are done, in any order.

    Workers are actors. Ray restarts one that died, on another node if its own is lost, and gives it its batches again.

    Args:
        task: What to do.
        batches: Scans; each batch goes to a worker whole.
        workers: Actors, a core each. If there are fewer cores, those that start do all the work.

    Raises:
        RuntimeError: Ray gave up.
    """
    ray = needs("ray", "ray")
    actor = ray.remote(num_cpus=1, max_restarts=-1, max_task_retries=-1)(ScanWorker)
    pool = [actor.remote(task) for _ in range(workers)]
    starting = {worker.ready.remote(): worker for worker in pool}
    at_work: dict[Any, Any] = {}  # the worker of each batch that is not done yet
    batch: list[Scan] | None = next(batches, None)
    try:
        while batch or at_work:
            done = ray.wait([*at_work, *starting], num_returns=1)[0][0]
            rows = ray.get(done)
            is_new = done in starting
            worker = (starting if is_new else at_work).pop(done)
            for _ in range(WAITING_BATCHES if is_new else 1):
                if batch:
                    at_work[worker.label.remote(batch)] = worker
                    batch = next(batches, None)
            if not any(other is worker for other in at_work.values()):
                ray.kill(worker)  # its core may be what a worker of a lost node waits for
            if rows is not None:
                yield rows
    except ray.exceptions.RayError as error:
        reason = str(error).strip().splitlines()[-1]  # above it stands where in Ray that was
        raise RuntimeError(f"Ray gave up: {reason}; what is done stays done, run it again for the rest") from error
    finally:
        for worker in pool:
            ray.kill(worker)
