# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The Ray actor that reads scans, segments them and writes their labels."""

from __future__ import annotations

import contextlib
import io
import os
import socket
import threading
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

import flagstone
from flagstone._optional import needs
from flagstone.ray.location import Location
from flagstone.ray.plan import is_scan, label_name
from flagstone.ray.statistics import LABELS, schema

if TYPE_CHECKING:
    import pyarrow

LabelMap = Literal["flagstone", "semantic-kitti"]
Scan = tuple[str, int]  # path relative to the source, bytes

# Remote filesystems have a high latency but also a high throughput. Reading many scans in parallel hides the latency.
REMOTE_SCANS_AT_ONCE = 32
# A single death of a worker may have another cause than the scan, for example a node that ran out of memory.
DEATHS_ALLOWED = 1


@dataclass(frozen=True)
class Task:
    """Description of the work, the same for all workers of a run."""

    method: str
    settings: dict[str, Any]  # all settings, so that the node of a worker needs no settings file
    source: Location
    destination: Location
    format: str  # label, u8
    label_map: LabelMap
    columns: int | None

    def segmenter(self) -> flagstone.Segmenter:
        return flagstone.make_segmenter(self.method, **self.settings)


class ScanWorker:
    """Labels batches of scans with one segmenter, whose buffers are allocated once."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._segmenter = task.segmenter()
        self._turn = threading.Lock()
        self._folders: set[str] = set()  # directories that exist
        self._node, notes = identity()
        self._in_progress = InProgressLog(notes)
        is_local = task.source.is_local and task.destination.is_local
        self._threads = None if is_local else ThreadPoolExecutor(REMOTE_SCANS_AT_ONCE)

    def ready(self) -> None:
        """Returns once the worker has started."""

    def label(self, batch: list[Scan]) -> pyarrow.Table:
        """Labels scans and returns their rows of the statistics."""
        suspects = [scan for scan in batch if self._in_progress.deaths(scan[0])]
        others = [scan for scan in batch if not self._in_progress.deaths(scan[0])]
        rows = list(self._threads.map(self._work, others) if self._threads else map(self._work, others))
        rows += map(self._work, suspects)  # one at a time, to identify the scan that crashes the worker
        return needs("pyarrow", "ray").Table.from_pylist(rows, schema=schema())

    def _work(self, scan: Scan) -> dict[str, Any]:
        name, size = scan
        row = {"path": name, "bytes": size, "started_at": now(), "node": self._node}
        try:
            self._check_survivable(name)
            with self._in_progress.on(name):
                self._label(name, row)
        except Exception as error:  # an error in one scan must not affect the other scans
            row["error"] = one_line(error, self._task.source.at(name))
        row["finished_at"] = now()
        return row

    def _check_survivable(self, name: str) -> None:
        deaths = self._in_progress.deaths(name)
        if deaths > DEATHS_ALLOWED:
            raise RuntimeError(f"{deaths} workers crashed while processing this scan (it may need too much memory)")

    def _label(self, name: str, row: dict[str, Any]) -> None:
        with took(row, "read_ms"):
            points = self._read(name)
        with self._turn, took(row, "segment_ms"):
            result = self._segmenter.segment(points)
        counts = result.counts
        row["points"] = sum(counts.values())
        row.update({label: counts[label] for label in LABELS})
        with took(row, "write_ms"):
            self._write(label_name(name, self._task.format), result.labels)

    def _read(self, name: str) -> npt.NDArray[np.void]:
        source, columns = self._task.source, self._task.columns
        if source.is_local:
            return flagstone.io.read(source.at(name), columns=columns)
        if columns is None:
            columns = 5 if name.lower().endswith(".pcd.bin") else 4
        return flagstone.io.parse(source.read(name), flagstone.io.format_of(name) or "raw", columns=columns)

    def _write(self, name: str, labels: npt.NDArray[np.uint8]) -> None:
        destination, label_map = self._task.destination, self._task.label_map
        if not destination.is_local:
            destination.write(name, label_file(labels, self._task.format, label_map))
            return
        path = destination.at(name)
        if Path(path).is_symlink() and is_scan(os.path.realpath(path)):
            raise ValueError(f"{path}: is a link to a scan (remove it, or choose another destination)")
        folder, _, _ = path.rpartition("/")
        if folder not in self._folders:
            Path(folder).mkdir(parents=True, exist_ok=True)
            self._folders.add(folder)
        flagstone.io.write_labels(path, labels, label_map=label_map)


def label_file(labels: npt.NDArray[np.uint8], format: str, label_map: LabelMap) -> bytes:
    """The contents of a label file, identical to those that `flagstone.io.write_labels` writes to local files."""
    codes = labels if label_map == "flagstone" else np.where(labels == flagstone.Label.GROUND, 40, 0)
    if format == "label":
        return codes.astype("<u4").tobytes()
    file = io.BytesIO()
    np.save(file, codes.astype(np.uint8))
    return file.getvalue()


def one_line(error: Exception, path: str) -> str:
    """The error in one line that starts with the path of the scan."""
    text = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, OSError) and error.strerror:
        text = f"{error.filename or path}: {error.strerror}"
    return text if path in text else f"{path}: {text}"


def identity() -> tuple[str, Path]:
    """Name of the node, and path of the notes, which is the same after this actor is restarted on the node."""
    context = needs("ray", "ray").get_runtime_context()
    node = f"{socket.gethostname()}/{context.get_node_id()[:8]}"  # a host may run several nodes
    folder = Path(context.get_temp_dir()) / context.get_session_name()
    return node, folder / f"flagstone-{context.get_actor_id()}.notes"


def now() -> datetime:
    """Current time in UTC."""
    return datetime.now(timezone.utc)


@contextlib.contextmanager
def took(row: dict[str, Any], name: str) -> Iterator[None]:
    """Stores the duration of the context in the row, in milliseconds."""
    begun = time.perf_counter()
    yield
    row[name] = 1000 * (time.perf_counter() - begun)


class InProgressLog:
    """Notes of the scans in progress, which a worker reads again after it is restarted on the same node.

    If a worker dies, Ray sends its batch to the restarted worker, any number of times. If a scan needs too
    much memory, it would crash the worker each time. The notes identify this scan.
    """

    def __init__(self, notes: Path) -> None:
        self._deaths = Counter[str]()
        if notes.exists():
            for line in notes.read_text(encoding="ascii").splitlines():
                self._deaths[line[1:]] += 1 if line.startswith("+") else -1
        self._file = notes.open("ab", buffering=0)  # unbuffered, so that notes survive a crash

    @contextlib.contextmanager
    def on(self, scan: str) -> Iterator[None]:
        """Marks a scan as in progress for the duration of the context."""
        self._note("+", scan)
        try:
            yield
        finally:
            self._note("-", scan)

    def deaths(self, scan: str) -> int:
        """Number of times that this worker died while it processed the scan."""
        return self._deaths[ascii(scan)]

    def _note(self, sign: str, scan: str) -> None:
        self._file.write(f"{sign}{scan!a}\n".encode("ascii"))
