# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What runs in each Ray actor: read, segment, write, a scan at a time."""

from __future__ import annotations

import contextlib
import io
import os
import socket
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import datetime, timezone
from typing import TYPE_CHECKING, Any

import flagstone
from flagstone.ray.place import Place
from flagstone.ray.scan_names import label_name
from flagstone.ray.statistics import LABELS, schema

if TYPE_CHECKING:
    import numpy as np
    import pyarrow

# Waiting for a remote filesystem takes longer than segmenting: so many scans are on their way at once.
REMOTE_SCANS_AT_ONCE = 32


@dataclass(frozen=True)
class Task:
    """What all workers of a run have in common."""

    segmenter: flagstone.Segmenter
    source: Place
    destination: Place
    format: str  # label, u8
    label_map: str  # flagstone, semantic_kitti
    columns: int | None


class ScanWorker:
    """Labels batches of scans; keeps its segmenter, so that buffers are made once."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._turn = threading.Lock()
        self._folders: set[str] = set()  # made already
        self._node = node_name()
        at_once = 1 if task.source.is_local and task.destination.is_local else REMOTE_SCANS_AT_ONCE
        self._threads = ThreadPoolExecutor(at_once) if at_once > 1 else None

    def __call__(self, batch: pyarrow.Table) -> pyarrow.Table:
        """Labels scans.

        Args:
            batch: Columns `path` and `bytes` of the scans.

        Returns:
            Their rows of the statistics.
        """
        import pyarrow as pa

        scans = batch.to_pylist()
        rows = self._threads.map(self._work, scans) if self._threads else map(self._work, scans)
        return pa.Table.from_pylist(list(rows), schema=schema())

    def _work(self, scan: dict[str, Any]) -> dict[str, Any]:
        row = {**scan, "begun": datetime.now(timezone.utc), "node": self._node}
        try:
            with took(row, "read_ms"):
                points = self._read(scan["path"])
            with self._turn, took(row, "segment_ms"):
                result = self._task.segmenter.segment(points)
            row["points"] = len(result.labels)
            row.update({label: result.counts[label] for label in LABELS})
            with took(row, "write_ms"):
                self._write(label_name(scan["path"], self._task.format), result.labels)
        except Exception as error:  # one scan, whatever is wrong with it; the others are done
            row["error"] = one_line(error, self._task.source.at(scan["path"]))
        return row

    def _read(self, name: str) -> np.ndarray:
        source = self._task.source
        path = source.at(name)
        if source.is_local:
            return flagstone.io.read(path, columns=self._task.columns)
        format = flagstone.io.format_of(name)
        assert format is not None
        return flagstone.io.parse(source.read(name), format, columns=self._columns_of(name))

    def _columns_of(self, name: str) -> int | None:
        if self._task.columns is None and name.lower().endswith(".pcd.bin"):
            return 5
        return self._task.columns

    def _write(self, name: str, labels: np.ndarray) -> None:
        destination = self._task.destination
        if not destination.is_local:
            destination.write(name, label_file(labels, self._task.format, self._task.label_map))
            return
        path = destination.at(name)
        folder = os.path.dirname(path)
        if folder not in self._folders:
            os.makedirs(folder or ".", exist_ok=True)
            self._folders.add(folder)
        flagstone.io.write_labels(path, labels, label_map=self._task.label_map)


def label_file(labels: np.ndarray, format: str, label_map: str) -> bytes:
    """The bytes that `flagstone.io.write_labels` writes, for filesystems it cannot write to."""
    import numpy as np

    codes = labels if label_map == "flagstone" else np.where(labels == 1, np.uint8(40), np.uint8(0))
    if format == "label":
        return codes.astype("<u4").tobytes()
    file = io.BytesIO()
    np.save(file, codes.astype(np.uint8))
    return file.getvalue()


def one_line(error: Exception, path: str) -> str:
    """What went wrong, with the scan's path, once."""
    text = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, OSError) and error.strerror:
        where = error.filename or path
        return f"{where}: {error.strerror}" if str(where) not in error.strerror else error.strerror
    if isinstance(error, MemoryError):
        text = "out of memory"
    return text if path in text else f"{path}: {text}"


def node_name() -> str:
    """Host and the beginning of Ray's id of the node: several nodes may be on one host."""
    import ray

    return f"{socket.gethostname()}/{ray.get_runtime_context().get_node_id()[:8]}"


@contextlib.contextmanager
def took(row: dict[str, Any], name: str) -> Iterator[None]:
    begun = time.perf_counter()
    yield
    row[name] = 1000 * (time.perf_counter() - begun)
