# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels for all scans in a directory or bucket."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import threading
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import flagstone
from flagstone._optional import needs
from flagstone._progress import Progress
from flagstone.ray.engine import connected, core_count, send
from flagstone.ray.location import location_of
from flagstone.ray.plan import LABEL_ENDINGS, Scans, check_names, find_scans, finished_scans, forget
from flagstone.ray.statistics import FOLDER, StatisticsWriter, schema
from flagstone.ray.summary import Interrupted, Summary, Tally
from flagstone.ray.worker import LabelMap, Scan, Task

if TYPE_CHECKING:
    import pyarrow

LABEL_MAPS = ("flagstone", "semantic-kitti")
LARGEST_BATCH = 256  # scans: about a second of work, compared with milliseconds of overhead per batch
SMALLEST_BATCH = 16


def segment(
    source: str | os.PathLike[str],
    destination: str | os.PathLike[str] | None = None,
    *,
    segmenter: flagstone.Segmenter | None = None,
    format: str = "label",
    label_map: LabelMap = "flagstone",
    columns: int | None = None,
    filesystem: Any = None,
    overwrite: bool = False,
    address: str | None = None,
    workers: int | None = None,
    progress: bool = True,
) -> Summary:
    """Labels every scan in a directory or bucket, on the cores of this machine or of a Ray cluster.

    The label files are bit-identical to those of `flagstone segment SOURCE --output DESTINATION`, and have the same
    names. Each file is written atomically. Only one run at a time may write to a destination.

    Call it again with the same arguments to resume an interrupted run: finished scans are skipped, failed scans are
    tried again. Scans are finished if the statistics contain their row and their label file has the correct size. They
    are also finished if their labels were written but their row was lost when a run was killed.

    An unreadable scan, a dead worker or a lost node does not stop the run. The summary and the statistics list the
    scans that failed, with the reasons.

    Args:
        source: Directory of scans (`.bin`, `.pcd.bin`, `.pcd`, `.ply`, `.npy`), searched recursively, or one scan. A
            local path, or a URL that PyArrow or fsspec supports (`s3://`, `gs://`, `abfs://`, `hdfs://`, ...). On a
            cluster, local paths must refer to the same files on every node.
        destination: Directory or URL for the labels, with the subdirectories of the source. By default, labels are
            written next to the scans.
        segmenter: A `flagstone.Surface`, a `Patchwork`, or a segmenter from `make_segmenter`. Each worker gets a copy.
            By default `flagstone.Surface()`. It must not estimate or track the height or tilt, because workers process
            scans in any order.
        format: "label" writes one uint32 per point to `NAME.label`, "u8" one uint8 per point to `NAME.label.npy`.
        label_map: Codes in the label files: "flagstone" (0 to 4) or "semantic-kitti" (40 for ground, 0 otherwise).
        columns: Floats per point in `.bin` files, 3 to 1,024; by default 5 for `.pcd.bin`, otherwise 4.
        filesystem: PyArrow or fsspec filesystem of `source` and `destination`; by default the one that each names.
        overwrite: Label all scans again, including finished ones, and start new statistics.
        address: Ray cluster to join: `auto` on one of its nodes, or `HOST:PORT` of its head node. By default the
            environment variable RAY_ADDRESS; without it, Ray is started on this machine for this run.
        workers: Number of actors, one core each, 1 to 100,000; by default the number of cores.
        progress: Show progress and the time left on standard error: a bar on a terminal, otherwise one line every few
            seconds.

    Returns:
        Numbers of scans and points, failures with reasons, and times.

    Raises:
        FileNotFoundError: The source contains no scans.
        ValueError: An argument is invalid, two scans would write to the same file, or the labels in the destination
            were written with other settings.
        ImportError: Ray is not installed.
        ConnectionError: The cluster cannot be joined.
        Interrupted: The run was interrupted. This is a KeyboardInterrupt; its `summary` covers the finished scans,
            whose labels are kept.
    """
    check_choice("format", format, tuple(LABEL_ENDINGS))
    check_choice("label_map", label_map, LABEL_MAPS)
    check_number("columns", columns, 3, 1024)
    check_number("workers", workers, 1, 100_000)
    segmenter = segmenter if segmenter is not None else flagstone.Surface()
    check_mount(segmenter)
    needs("ray", "ray")
    made_with = json.loads(  # the form in which it is read back
        json.dumps(
            {
                "version": flagstone.__version__,
                "method": segmenter.method,
                "settings": segmenter.settings,
                "format": format,
                "label_map": label_map,
                "columns": columns,
            }
        )
    )
    with Progress(0, "scans", shown=progress, log=True) as bar:
        bar.note("listing scans")
        folder, scans = find_scans(location_of(source, filesystem))
        check_names(folder, scans, format)
        target = folder if destination is None else location_of(destination, filesystem)
        if overwrite:
            forget(target)
        finished = finished_scans(scans, target, format, made_with)
        tally = Tally(len(scans), len(finished.scans), target.at(FOLDER))
        todo = [(name, file.size) for name, file in scans.items() if name not in finished.scans]
        writer = StatisticsWriter(target.below(FOLDER), made_with)
        if todo or finished.without_row:
            writer.begin()
        if finished.without_row:
            writer.add(rows_of_lost(finished.without_row, scans))
            writer.flush()
        if todo:
            task = Task(segmenter.method, segmenter.settings, folder, target, format, label_map, columns)
            bar.note(f"starting Ray for {len(todo):,} scans")
            with connected(address):
                run(task, todo, workers or core_count(), writer, tally, bar)
        return tally.summary()


def run(task: Task, scans: list[Scan], workers: int, writer: StatisticsWriter, tally: Tally, bar: Progress) -> None:
    """Sends the scans to workers and stores their rows. After an interrupt or error, finished rows are kept."""
    bar.total = len(scans)
    bar.note("starting workers")
    tally.workers = min(workers, -(-len(scans) // SMALLEST_BATCH))
    try:
        with contextlib.closing(send(task, in_batches(scans, workers), tally.workers)) as done:
            for rows in done:
                with uninterrupted():
                    writer.add(rows)
                    tally.add(rows)
                bar.add(rows.num_rows)
    except (KeyboardInterrupt, SystemExit):  # Ray raises SystemExit after SIGTERM
        raise Interrupted(tally.summary()) from None
    finally:
        writer.flush()


@contextlib.contextmanager
def uninterrupted() -> Iterator[None]:
    """Delays SIGINT and SIGTERM until the context ends, so that rows that are written are also counted."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    waiting: list[int] = []
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    for number in handlers:
        signal.signal(number, lambda received, _: waiting.append(received))
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
    if waiting:
        signal.raise_signal(waiting[0])


def in_batches(scans: list[Scan], workers: int) -> Iterator[list[Scan]]:
    """Yields large batches first and smaller ones towards the end, so that all workers finish together."""
    first = 0
    while first < len(scans):
        size = (len(scans) - first) // (2 * workers)
        batch = scans[first : first + min(max(size, SMALLEST_BATCH), LARGEST_BATCH)]
        yield batch
        first += len(batch)


def rows_of_lost(points: dict[str, int], scans: Scans) -> pyarrow.Table:
    """Rows for scans with labels but without a row. Only path, bytes and points are set."""
    import pyarrow as pa

    rows = [{"path": path, "bytes": scans[path].size, "points": count} for path, count in points.items()]
    return pa.Table.from_pylist(rows, schema=schema())


def check_mount(segmenter: flagstone.Segmenter) -> None:
    """Raises ValueError if the segmenter estimates the mounting pose from scans."""
    mount = segmenter.settings["mount"]
    for name, setting in (("sensor_height", "height"), ("tilt", "tilt")):
        if mount[setting] in ("estimate", "track"):
            raise ValueError(
                f"{name}: {mount[setting]!r} is not supported here, because workers process scans in any order and "
                "each would get a different estimate (find the value with `flagstone doctor` and pass it)"
            )


def check_choice(name: str, value: object, allowed: tuple[str, ...]) -> None:
    """Raises ValueError if the value is not one of those allowed."""
    if value not in allowed:
        raise ValueError(f"{name}: {value!r} is not supported (expected {' or '.join(allowed)})")


def check_number(name: str, value: int | None, minimum: int, maximum: int) -> None:
    """Raises ValueError if the value is neither None nor an integer in the range."""
    if value is not None and not (isinstance(value, int) and minimum <= value <= maximum):
        raise ValueError(f"{name}: {value!r} is out of range (expected an integer from {minimum} to {maximum})")
