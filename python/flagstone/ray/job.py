# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels for all scans of a folder or a bucket."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import flagstone
from flagstone.ray.engine import connected, core_count, import_ray, send
from flagstone.ray.place import Place, place
from flagstone.ray.plan import check_names, find_scans, make_plan
from flagstone.ray.progress import Progress
from flagstone.ray.scan_names import LABEL_ENDINGS
from flagstone.ray.statistics import FOLDER, StatisticsWriter, schema
from flagstone.ray.summary import Failure, Interrupted, Summary
from flagstone.ray.worker import Task

if TYPE_CHECKING:
    import pyarrow

LABEL_MAPS = ("flagstone", "semantic_kitti")
LARGEST_BATCH = 256  # scans: half a second of work, against milliseconds that sending it takes
BATCHES_A_WORKER = 16  # at least, where there are scans enough: workers finish together
WAITING_BATCHES = 2  # at each worker: one under work, one next


def segment(
    source: str | os.PathLike[str],
    destination: str | os.PathLike[str] | None = None,
    *,
    segmenter: flagstone.Segmenter | None = None,
    format: str = "label",
    label_map: str = "flagstone",
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
        address: The Ray cluster to join, such as `auto` or `ray://head:10001`; None: the environment's RAY_ADDRESS, or
            Ray started here for this run.
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
    import_ray()
    bar = Progress(progress)
    try:
        bar.note("listing scans")
        folder, scans = find_scans(place(source, filesystem))
        check_names(folder, scans, format)
        target = folder if destination is None else place(destination, filesystem)
        made_with = {
            "version": flagstone.__version__,
            "method": segmenter.method,
            "settings": segmenter.settings,
            "format": format,
            "label_map": label_map,
            "columns": columns,
        }
        plan = make_plan(scans, target, format, made_with, again)
        tally = Tally(len(scans), plan.finished, target.at(FOLDER))
        if plan.scans.num_rows:
            task = Task(segmenter, folder, target, format, label_map, columns)
            writer = StatisticsWriter(Place(target.at(FOLDER), target.filesystem), made_with)
            bar.note("starting Ray")
            with connected(address):
                run(task, plan.scans, workers or core_count(), writer, tally, bar)
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
    seconds: float = 0
    workers: int = 0
    read_ms: float = 0
    segment_ms: float = 0
    write_ms: float = 0

    @property
    def done(self) -> int:
        return self.finished_before + self.labelled + len(self.failures)

    def add(self, rows: pyarrow.Table) -> None:
        import pyarrow.compute as pc

        good = rows.filter(pc.is_null(rows["error"]))
        self.labelled += good.num_rows
        for name in ("points", "bytes", "read_ms", "segment_ms", "write_ms"):
            setattr(self, name, getattr(self, name) + (pc.sum(good[name]).as_py() or 0))
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
            seconds=self.seconds,
            workers=self.workers,
            read_ms=self.read_ms,
            segment_ms=self.segment_ms,
            write_ms=self.write_ms,
            statistics=self.statistics,
        )


def run(
    task: Task, scans: pyarrow.Table, workers: int, writer: StatisticsWriter, tally: Tally, bar: Progress
) -> None:
    """Sends all scans, then those whose batch was lost, one by one: what kills a worker is known then."""
    tally.workers = min(workers, scans.num_rows)
    begun = time.monotonic()
    bar.begin()
    batch = min(LARGEST_BATCH, max(1, scans.num_rows // (workers * BATCHES_A_WORKER)))

    def gather(todo: pyarrow.Table, batch: int, at_once: int) -> pyarrow.Table:
        """Sends scans and returns those that no row came back of."""
        import pyarrow as pa
        import pyarrow.compute as pc

        seen = []
        batches = [todo.slice(first, batch) for first in range(0, todo.num_rows, batch)]
        for rows in send(task, batches, min(workers, len(batches)), at_once=at_once):
            seen.append(rows["path"].combine_chunks())
            writer.add(rows)
            tally.add(rows)
            tally.seconds = time.monotonic() - begun
            bar.show(tally.done, tally.scans)
        if sum(len(part) for part in seen) == todo.num_rows:
            return todo.slice(0, 0)
        return todo.filter(pc.invert(pc.is_in(todo["path"], pa.chunked_array(seen, pa.string()))))

    try:
        bar.show(tally.done, tally.scans)
        lost = gather(scans, batch, WAITING_BATCHES)
        if lost.num_rows:
            lost = gather(lost, 1, 1)
        if lost.num_rows:
            rows = died(lost)
            writer.add(rows)
            tally.add(rows)
    except (KeyboardInterrupt, SystemExit):
        raise Interrupted(tally.summary()) from None
    finally:
        writer.flush()


def died(scans: pyarrow.Table) -> pyarrow.Table:
    """Rows of scans that no worker survives."""
    import pyarrow as pa

    error = "every worker that took it died, alone with it too (killed, out of memory?)"
    rows = [{**scan, "error": f"{scan['path']}: {error}"} for scan in scans.to_pylist()]
    return pa.Table.from_pylist(rows, schema=schema())


def check_choice(name: str, value: object, allowed: tuple[str, ...]) -> None:
    if value not in allowed:
        raise ValueError(f"{name}={value!r}: allowed are {', '.join(allowed)}")


def check_number(name: str, value: int | None, least: int, most: int) -> None:
    if value is not None and not (isinstance(value, int) and least <= value <= most):
        raise ValueError(f"{name}={value!r}: not a whole number within {least} to {most}")
