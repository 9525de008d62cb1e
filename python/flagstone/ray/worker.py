# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What runs in each Ray actor: scans read, segmented, their labels written."""

from __future__ import annotations

import contextlib
import io
import socket
import threading
import time
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
from flagstone.ray.place import Place
from flagstone.ray.scan_names import label_name
from flagstone.ray.statistics import LABELS, schema
from flagstone.ray.under_work import UnderWork

if TYPE_CHECKING:
    import pyarrow

LabelMap = Literal["flagstone", "semantic_kitti"]

# A remote filesystem answers late, not slowly: so many scans are on their way at once.
REMOTE_SCANS_AT_ONCE = 32
# One more might be chance: a node out of memory, somebody's kill.
DEATHS_ALLOWED = 1


@dataclass(frozen=True)
class Task:
    """What all workers of a run have in common."""

    method: str
    settings: dict[str, Any]  # all of them, so that no file of settings is needed on the worker's node
    source: Place
    destination: Place
    format: str  # label, u8
    label_map: LabelMap
    columns: int | None

    def segmenter(self) -> flagstone.Segmenter:
        return flagstone.make_segmenter(self.method, **self.settings)


class ScanWorker:
    """Labels batches of scans; keeps its segmenter, whose buffers are made once."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._segmenter = task.segmenter()
        self._turn = threading.Lock()
        self._folders: set[str] = set()  # made already
        self._node, notes = identity()
        self._under_work = UnderWork(notes)
        is_local = task.source.is_local and task.destination.is_local
        self._threads = None if is_local else ThreadPoolExecutor(REMOTE_SCANS_AT_ONCE)

    def __call__(self, batch: pyarrow.Table) -> pyarrow.Table:
        """Labels scans.

        Args:
            batch: Columns `path` and `bytes` of the scans.

        Returns:
            Their rows of the statistics.
        """
        scans = batch.to_pylist()
        suspects = [scan for scan in scans if self._under_work.deaths(scan["path"])]
        others = [scan for scan in scans if not self._under_work.deaths(scan["path"])]
        rows = list(self._threads.map(self._work, others) if self._threads else map(self._work, others))
        rows += map(self._work, suspects)  # alone, so that it is plain who did it
        return needs("pyarrow", "ray").Table.from_pylist(rows, schema=schema())

    def _work(self, scan: dict[str, Any]) -> dict[str, Any]:
        name = scan["path"]
        row = {**scan, "begun": now(), "node": self._node}
        try:
            self._check_survivable(name)
            with self._under_work.on(name):
                self._label(name, row)
        except Exception as error:  # whatever is wrong with one scan, the others are done
            row["error"] = one_line(error, self._task.source.at(name))
        row["ended"] = now()
        return row

    def _check_survivable(self, name: str) -> None:
        deaths = self._under_work.deaths(name)
        if deaths > DEATHS_ALLOWED:
            raise RuntimeError(f"{deaths} workers died while they had it under work (out of memory?)")

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
        folder, _, _ = path.rpartition("/")
        if folder not in self._folders:
            Path(folder).mkdir(parents=True, exist_ok=True)
            self._folders.add(folder)
        flagstone.io.write_labels(path, labels, label_map=label_map)


def label_file(labels: npt.NDArray[np.uint8], format: str, label_map: LabelMap) -> bytes:
    """The bytes that `flagstone.io.write_labels` writes, for filesystems it cannot write to."""
    codes = labels if label_map == "flagstone" else np.where(labels == flagstone.Label.GROUND, 40, 0)
    if format == "label":
        return codes.astype("<u4").tobytes()
    file = io.BytesIO()
    np.save(file, codes.astype(np.uint8))
    return file.getvalue()


def one_line(error: Exception, path: str) -> str:
    """What is wrong, in one line that begins with the scan's path."""
    text = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, OSError) and error.strerror:
        text = f"{error.filename or path}: {error.strerror}"
    return text if path in text else f"{path}: {text}"


def identity() -> tuple[str, Path]:
    """The node's name, and where an actor that is restarted there finds its notes again."""
    context = needs("ray", "ray").get_runtime_context()
    node = f"{socket.gethostname()}/{context.get_node_id()[:8]}"  # several nodes may be on one host
    folder = Path(context.get_temp_dir()) / context.get_session_name()
    return node, folder / f"flagstone-{context.get_actor_id()}.notes"


def now() -> datetime:
    """The time in UTC."""
    return datetime.now(timezone.utc)


@contextlib.contextmanager
def took(row: dict[str, Any], name: str) -> Iterator[None]:
    """Puts the milliseconds that the context took into the row."""
    begun = time.perf_counter()
    yield
    row[name] = 1000 * (time.perf_counter() - begun)
