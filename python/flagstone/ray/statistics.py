# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Table of results with one row per scan, in Parquet files next to the labels."""

from __future__ import annotations

import io
import json
import os
import time
from datetime import datetime, timezone
from typing import TYPE_CHECKING, Any

from flagstone.ray.location import Location, location_of

if TYPE_CHECKING:
    import pandas
    import pyarrow

FOLDER = "flagstone-statistics"
LABELS = ("nonground", "ground", "noise", "out_of_range", "invalid")
MADE_WITH = b"flagstone"  # metadata key of each file: version, method and settings as JSON


def schema() -> pyarrow.Schema:
    """Columns of the table."""
    import pyarrow as pa

    return pa.schema(
        [
            ("path", pa.string()),  # of the scan, relative to the source
            ("bytes", pa.int64()),  # size of the scan file
            ("points", pa.int64()),
            *((label, pa.int64()) for label in LABELS),
            ("read_ms", pa.float64()),
            ("segment_ms", pa.float64()),
            ("write_ms", pa.float64()),
            ("started_at", pa.timestamp("us", tz="UTC")),
            ("finished_at", pa.timestamp("us", tz="UTC")),
            ("node", pa.string()),
            ("error", pa.string()),  # null for success
        ]
    )


class StatisticsWriter:
    """Collects rows and writes them to several files, each atomically, so that a killed run loses few rows.

    The first file has no rows. It is written before the first label and records the settings and the start time, even
    if the run is killed early.
    """

    def __init__(self, folder: Location, made_with: dict[str, Any]) -> None:
        self._folder = folder
        self._schema = schema().with_metadata({MADE_WITH: json.dumps(made_with, sort_keys=True).encode()})
        self._run = datetime.now(timezone.utc).strftime("%Y%m%dT%H%M%S.%f")
        self._tables: list[pyarrow.Table] = []
        self._files = 0
        self._pause = 2.0  # seconds between files; it increases, to limit the number of files of long runs
        self._next = time.monotonic() + self._pause

    def begin(self) -> None:
        """Writes the first file, without rows."""
        self._write(self._schema.empty_table())

    def add(self, rows: pyarrow.Table) -> None:
        self._tables.append(rows)
        if time.monotonic() >= self._next:
            self.flush()

    def flush(self) -> None:
        """Writes the collected rows."""
        if self._tables:
            import pyarrow as pa

            self._write(pa.concat_tables(self._tables).cast(self._schema))
            self._tables = []
            self._pause = min(1.1 * self._pause, 60.0)
        self._next = time.monotonic() + self._pause

    def _write(self, rows: pyarrow.Table) -> None:
        import pyarrow.parquet

        file = io.BytesIO()
        pyarrow.parquet.write_table(rows, file, compression="zstd")
        self._folder.write(f"{self._run}-{self._files:05d}.parquet", file.getvalue())
        self._files += 1


def read_rows(folder: Location, columns: list[str] | None = None) -> tuple[pyarrow.Table, list[dict[str, Any]]]:
    """All rows in the order in which they were written, and the distinct settings that their labels were made with."""
    import pyarrow as pa
    import pyarrow.parquet

    tables = []
    made_with: list[dict[str, Any]] = []
    for name in sorted(file.name for file in folder.files() if is_part(file.name)):
        try:
            table = pyarrow.parquet.read_table(pa.BufferReader(folder.read(name)), columns=columns)
        except pa.ArrowInvalid as error:
            raise ValueError(f"{folder.at(name)}: not a statistics file: {error} (remove the file)") from None
        tables.append(table)
        made = json.loads((table.schema.metadata or {}).get(MADE_WITH, b"{}"))
        if made not in made_with:
            made_with.append(made)
    wanted = schema() if columns is None else pa.schema([schema().field(name) for name in columns])
    return (pa.concat_tables([table.cast(wanted) for table in tables]) if tables else wanted.empty_table()), made_with


def latest_begin(folder: Location) -> float | None:
    """Start time of the latest run, by the clock of the filesystem; None if unknown."""
    begins = [file for file in folder.files() if is_part(file.name) and file.name.endswith("-00000.parquet")]
    return max(begins).modified if begins else None


def is_part(name: str) -> bool:
    """Whether a file in the statistics directory contains statistics. Hidden files are temporary files."""
    return name.endswith(".parquet") and "/" not in name and not name.startswith(".")


def statistics(destination: str | os.PathLike[str], *, filesystem: Any = None) -> pandas.DataFrame:
    """Reads the statistics of `flagstone.ray.segment`.

    Args:
        destination: Directory or URL of the labels. If they are next to the scans, the source.
        filesystem: PyArrow or fsspec filesystem of `destination`; by default the one that `destination` names.

    Returns:
        Data frame with one row per scan, sorted by path. Columns: `path` (relative to the source), `bytes`, `points`,
        the number of points of each of the five labels, `read_ms`, `segment_ms`, `write_ms`, `started_at` and
        `finished_at` (UTC), `node`, and `error` (missing for success). If a scan was labelled several times, its row
        describes the last time. If a killed run lost the row of a scan, only `path`, `bytes` and `points` are set.

    Raises:
        FileNotFoundError: There are no statistics.
        ValueError: A file in the statistics directory is not a statistics file.
    """
    where = location_of(destination, filesystem)
    rows, _ = read_rows(where.below(FOLDER))
    if rows.num_rows == 0:
        raise FileNotFoundError(
            f"{where.at(FOLDER)}: no statistics (check that flagstone.ray.segment wrote to {where})"
        )
    frame = rows.to_pandas()
    last: pandas.DataFrame = frame[~frame["path"].duplicated(keep="last")]
    return last.sort_values("path", ignore_index=True)
