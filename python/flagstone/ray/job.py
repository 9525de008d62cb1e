# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels for all scans of a folder or a bucket."""

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
LARGEST_BATCH = 256  # scans: about a second of work, against milliseconds of the time of driver and worker
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
    """Labels every scan of a folder or bucket, on the cores of this machine or of a Ray cluster.

    Names and bytes of the label files are those that `flagstone segment SOURCE --output DESTINATION` writes. Run again,
    it does what is left: a scan is finished if the statistics have its row and its labels have the right size, or if
    a killed run lost the row of labels it had written. Labels appear whole or not at all. One run at a time may write
    to a destination. A scan that cannot be read, a worker that dies and a node that is
    lost cost nothing but themselves; what failed, and why, is in the summary and in the statistics.

    Args:
        source: Folder of scans (`.bin`, `.pcd.bin`, `.pcd`, `.ply`, `.npy`, in folders below it too), or one scan: a
            local path, or a URL that PyArrow or fsspec knows (`s3://`, `gs://`, `abfs://`, `hdfs://`, ...). On a
            cluster, local paths must lead to the same files on every node.
        destination: Folder or URL for the labels, which mirrors the source's folders; None: beside the scans.
        segmenter: What segments, as `flagstone.Surface`, `Patchwork` and `make_segmenter` make it; each worker has its
            own. None: `flagstone.Surface()`. One that estimates or tracks its height or tilt is refused, since
            workers see scans in any order.
        format: `label`, a uint32 a point in `NAME.label`; or `u8`, a uint8 a point in `NAME.label.npy`.
        label_map: Codes in the label files: `flagstone` (0 to 4), or `semantic-kitti` (40 ground, 0 else).
        columns: Floats a point in `.bin` files, 3 to 1024; None: 5 for `.pcd.bin`, else 4.
        filesystem: A PyArrow or fsspec filesystem that source and destination are paths of; None: those that they name.
        overwrite: Label all scans, finished or not, and start new statistics.
        address: The Ray cluster to join, `auto` on one of its nodes or `HOST:PORT` of its head; None: the
            environment's RAY_ADDRESS, or Ray started here for this run.
        workers: Actors, a core each; None: as many as there are cores.
        progress: Whether to show progress and time left on standard error: a bar on a terminal, elsewhere a line every
            few seconds.

    Returns:
        How many scans were labelled, what failed and why, and what the time went into.

    Raises:
        FileNotFoundError: There is no scan in the source.
        ValueError: A value is not allowed, two scans would write to one file, or the destination holds labels that
            were made with other settings.
        ImportError: Ray is not installed.
        ConnectionError: The cluster cannot be joined.
        Interrupted: A KeyboardInterrupt; what is done stays done, and its `summary` says what that is.
    """
    check_choice("format", format, tuple(LABEL_ENDINGS))
    check_choice("label_map", label_map, LABEL_MAPS)
    check_number("columns", columns, 3, 1024)
    check_number("workers", workers, 1, 100_000)
    segmenter = segmenter if segmenter is not None else flagstone.Surface()
    check_mount(segmenter)
    needs("ray", "ray")
    made_with = json.loads(  # as it is read again
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
    """Sends the scans and takes their rows; what came until an interrupt or error is kept."""
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
    except (KeyboardInterrupt, SystemExit):  # the latter is how Ray answers SIGTERM
        raise Interrupted(tally.summary()) from None
    finally:
        writer.flush()


@contextlib.contextmanager
def uninterrupted() -> Iterator[None]:
    """Lets SIGINT and SIGTERM wait until the context ends: what is written is also counted."""
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
    """Large ones first, smaller ones towards the end, so that all workers finish together."""
    first = 0
    while first < len(scans):
        size = (len(scans) - first) // (2 * workers)
        batch = scans[first : first + min(max(size, SMALLEST_BATCH), LARGEST_BATCH)]
        yield batch
        first += len(batch)


def rows_of_lost(points: dict[str, int], scans: Scans) -> pyarrow.Table:
    """Rows of the scans that have labels and lost theirs: with path, bytes and points alone."""
    import pyarrow as pa

    rows = [{"path": path, "bytes": scans[path].size, "points": count} for path, count in points.items()]
    return pa.Table.from_pylist(rows, schema=schema())


def check_mount(segmenter: flagstone.Segmenter) -> None:
    """Raises ValueError where the segmenter is to find out from scans how the sensor stands."""
    mount = segmenter.settings["mount"]
    for name, setting in (("sensor_height", "height"), ("tilt", "tilt")):
        if mount[setting] in ("estimate", "track"):
            raise ValueError(
                f"{name}={mount[setting]!r}: workers see scans in any order, and each would get a "
                "different estimate; find the value with `flagstone doctor` and pass it"
            )


def check_choice(name: str, value: object, allowed: tuple[str, ...]) -> None:
    """Raises ValueError where the value is none of those allowed."""
    if value not in allowed:
        raise ValueError(f"{name}={value!r}: allowed are {', '.join(allowed)}")


def check_number(name: str, value: int | None, least: int, most: int) -> None:
    """Raises ValueError where there is a value and it is not within the range."""
    if value is not None and not (isinstance(value, int) and least <= value <= most):
        raise ValueError(f"{name}={value!r}: not a whole number within {least} to {most}")
