# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels for all scans of a folder or a bucket."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from datetime import datetime
from typing import TYPE_CHECKING, Any

import flagstone
from flagstone._optional import needs
from flagstone.ray.engine import connected, core_count, send
from flagstone.ray.place import place
from flagstone.ray.plan import Scans, check_names, find_scans, finished_scans, forget
from flagstone.ray.progress import Progress
from flagstone.ray.scan_names import LABEL_ENDINGS
from flagstone.ray.statistics import FOLDER, StatisticsWriter
from flagstone.ray.summary import Failure, Interrupted, Summary
from flagstone.ray.worker import LabelMap, Task

if TYPE_CHECKING:
    import pyarrow

LABEL_MAPS = ("flagstone", "semantic_kitti")
LARGEST_BATCH = 1024  # scans: three seconds of work, against 15 milliseconds of the driver's and of the worker's time
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
    again: bool = False,
    address: str | None = None,
    workers: int | None = None,
    progress: bool = True,
) -> Summary:
    """Labels every scan of a folder or bucket, on the cores of this machine or of a Ray cluster.

    Names and bytes of the label files are those that `flagstone segment SOURCE --output DESTINATION` writes. Run again,
    it does what is left: a scan is finished where its row stands in the statistics and its labels have the size they
    must have. Labels appear whole or not at all. A scan that cannot be read, a worker that dies and a node that is
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
        label_map: Codes in the label files: `flagstone` (0 to 4), or `semantic_kitti` (40 ground, 0 else).
        columns: Floats a point in `.bin` files, 3 to 1024; None: 5 for `.pcd.bin`, else 4.
        filesystem: A PyArrow or fsspec filesystem that source and destination are paths of; None: those that they name.
        again: Label all scans, finished or not, and begin the statistics anew.
        address: The Ray cluster to join, `auto` on one of its nodes or `HOST:PORT` of its head; None: the
            environment's RAY_ADDRESS, or Ray started here for this run.
        workers: Actors, a core each; None: as many as there are cores.
        progress: Whether to show progress and time left where standard error is a terminal.

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
    needs("ray.data", "ray")
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
    bar = Progress(progress)
    try:
        bar.note("listing scans")
        folder, scans = find_scans(place(source, filesystem))
        check_names(folder, scans, format)
        target = folder if destination is None else place(destination, filesystem)
        if again:
            forget(target)
        finished = finished_scans(scans, target, format, made_with)
        tally = Tally(len(scans), len(finished), target.at(FOLDER))
        todo = as_table({name: size for name, size in scans.items() if name not in finished})
        if todo.num_rows:
            task = Task(segmenter.method, segmenter.settings, folder, target, format, label_map, columns)
            writer = StatisticsWriter(target.below(FOLDER), made_with)
            bar.note("starting Ray")
            with connected(address):
                run(task, todo, workers or core_count(), writer, tally, bar)
        return tally.summary()
    finally:
        bar.clear()


@dataclass
class Tally:
    """Adds up the rows of a run."""

    scans: int
    finished_before: int
    statistics: str
    failures: list[Failure] = field(default_factory=list)
    labelled: int = 0
    points: int = 0
    bytes: int = 0
    begun: datetime | None = None  # when the first scan was begun, by the clocks of the workers' nodes
    ended: datetime | None = None  # when the last one was done
    workers: int = 0
    read_ms: float = 0
    segment_ms: float = 0
    write_ms: float = 0

    def add(self, rows: pyarrow.Table) -> None:
        import pyarrow.compute as pc

        good = rows.filter(pc.is_null(rows["error"]))
        self.labelled += good.num_rows
        for name in ("points", "bytes", "read_ms", "segment_ms", "write_ms"):
            setattr(self, name, getattr(self, name) + (pc.sum(good[name]).as_py() or 0))
        first, last = pc.min(rows["begun"]).as_py(), pc.max(rows["ended"]).as_py()
        self.begun = min(first, self.begun or first)
        self.ended = max(last, self.ended or last)
        for row in rows.filter(pc.is_valid(rows["error"])).select(["path", "error"]).to_pylist():
            self.failures.append(Failure(row["path"], row["error"]))

    def summary(self) -> Summary:
        return Summary(
            scans=self.scans,
            finished_before=self.finished_before,
            labelled=self.labelled,
            failures=tuple(sorted(self.failures)),
            points=self.points,
            bytes=self.bytes,
            seconds=(self.ended - self.begun).total_seconds() if self.begun and self.ended else 0,
            workers=self.workers,
            read_ms=self.read_ms,
            segment_ms=self.segment_ms,
            write_ms=self.write_ms,
            statistics=self.statistics,
        )


def run(task: Task, scans: pyarrow.Table, workers: int, writer: StatisticsWriter, tally: Tally, bar: Progress) -> None:
    """Sends the scans and takes their rows; what came until an interrupt or error is kept."""
    batches = in_batches(scans, workers)
    tally.workers = min(workers, len(batches))
    bar.note("starting workers")
    try:
        for rows in send(task, batches, tally.workers):
            writer.add(rows)
            tally.add(rows)
            bar.show(tally.labelled + len(tally.failures), scans.num_rows)
    except (KeyboardInterrupt, SystemExit):  # the latter is how Ray answers SIGTERM
        raise Interrupted(tally.summary()) from None
    finally:
        writer.flush()


def in_batches(scans: pyarrow.Table, workers: int) -> list[pyarrow.Table]:
    """Large ones first, smaller ones towards the end, so that all workers finish together."""
    batches = []
    first = 0
    while first < scans.num_rows:
        size = (scans.num_rows - first) // (2 * workers)
        batches.append(scans.slice(first, min(max(size, SMALLEST_BATCH), LARGEST_BATCH)))
        first += batches[-1].num_rows
    return batches


def as_table(scans: Scans) -> pyarrow.Table:
    """What workers are sent."""
    import pyarrow as pa

    return pa.table({"path": pa.array(scans.keys(), pa.string()), "bytes": pa.array(scans.values(), pa.int64())})


def check_mount(segmenter: flagstone.Segmenter) -> None:
    """Raises ValueError where the segmenter is to find out from scans how the sensor stands."""
    mount = segmenter.settings["mount"]
    for name, setting in (("sensor_height", "height"), ("tilt", "tilt")):
        if mount[setting] in ("estimate", "track"):
            raise ValueError(
                f"{name}={mount[setting]!r}: workers see scans in any order, and each would find something "
                "else; find it with `flagstone doctor` and name it"
            )


def check_choice(name: str, value: object, allowed: tuple[str, ...]) -> None:
    """Raises ValueError where the value is none of those allowed."""
    if value not in allowed:
        raise ValueError(f"{name}={value!r}: allowed are {', '.join(allowed)}")


def check_number(name: str, value: int | None, least: int, most: int) -> None:
    """Raises ValueError where there is a value and it is not within the range."""
    if value is not None and not (isinstance(value, int) and least <= value <= most):
        raise ValueError(f"{name}={value!r}: not a whole number within {least} to {most}")
