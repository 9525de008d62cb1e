# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The table of what was done: a row a scan, in Parquet files beside the labels."""

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
MADE_WITH = b"flagstone"  # what the labels were made with, as JSON, in the metadata of each file


def schema() -> pyarrow.Schema:
    """The columns of the table."""
    import pyarrow as pa

    return pa.schema(
        [
            ("path", pa.string()),  # of the scan, below the source
            ("bytes", pa.int64()),  # of the scan's file
            ("points", pa.int64()),
            *((label, pa.int64()) for label in LABELS),
            ("read_ms", pa.float64()),
            ("segment_ms", pa.float64()),
            ("write_ms", pa.float64()),
            ("started_at", pa.timestamp("us", tz="UTC")),
            ("finished_at", pa.timestamp("us", tz="UTC")),
            ("node", pa.string()),
            ("error", pa.string()),  # null where all went well
        ]
    )


class StatisticsWriter:
    """Collects rows and writes them as files of their own, each whole: a run that is killed loses few rows.

    The first file has no rows. It is written before the first label, so that a run that is killed early has left what
    its labels are made with, and when it began.
    """

    def __init__(self, folder: Location, made_with: dict[str, Any]) -> None:
        self._folder = folder
        self._schema = schema().with_metadata({MADE_WITH: json.dumps(made_with, sort_keys=True).encode()})
        self._run = datetime.now(timezone.utc).strftime("%Y%m%dT%H%M%S.%f")
        self._tables: list[pyarrow.Table] = []
        self._files = 0
        self._pause = 2.0  # seconds between files; longer and longer, so that a week's run leaves hundreds, not 300,000
        self._next = time.monotonic() + self._pause

    def begin(self) -> None:
        """Writes the file without rows."""
        self._write(self._schema.empty_table())

    def add(self, rows: pyarrow.Table) -> None:
        self._tables.append(rows)
        if time.monotonic() >= self._next:
            self.flush()

    def flush(self) -> None:
        """Writes what has been gathered."""
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
    """All rows in the order they were written, and with what their labels were made, each kind once."""
    import pyarrow as pa
    import pyarrow.parquet

    tables = []
    made_with: list[dict[str, Any]] = []
    for name in sorted(file.name for file in folder.files() if is_part(file.name)):
        try:
            table = pyarrow.parquet.read_table(pa.BufferReader(folder.read(name)), columns=columns)
        except pa.ArrowInvalid as error:
            raise ValueError(f"{folder.at(name)}: not statistics of flagstone: {error}; remove it") from None
        tables.append(table)
        made = json.loads((table.schema.metadata or {}).get(MADE_WITH, b"{}"))
        if made not in made_with:
            made_with.append(made)
    wanted = schema() if columns is None else pa.schema([schema().field(name) for name in columns])
    return (pa.concat_tables([table.cast(wanted) for table in tables]) if tables else wanted.empty_table()), made_with


def latest_begin(folder: Location) -> float | None:
    """When the latest run began, by the clock of the file system; None if that is not known."""
    begins = [file for file in folder.files() if is_part(file.name) and file.name.endswith("-00000.parquet")]
    return max(begins).modified if begins else None


def is_part(name: str) -> bool:
    """Whether a file in the folder of statistics is a part of them: not hidden, not half written."""
    return name.endswith(".parquet") and "/" not in name and not name.startswith(".")


def statistics(destination: str | os.PathLike[str], *, filesystem: Any = None) -> pandas.DataFrame:
    """What was done in a destination of `flagstone.ray.segment`, a row a scan.

    Args:
        destination: The folder or URL that the labels are in; the source, where they lie beside the scans.
        filesystem: A PyArrow or fsspec filesystem that `destination` is a path of; None: the one it names.

    Returns:
        A frame with the columns `path` (below the source), `bytes`, `points`, one for each of the five labels with
        its points, `read_ms`, `segment_ms`, `write_ms`, `started_at` and `finished_at` (UTC), `node` and `error`
        (missing if all went well). Of a scan that was done several times, the last. Of a scan whose row was lost when a
        run was killed, only `path`, `bytes` and `points`.

    Raises:
        FileNotFoundError: There are no statistics.
        ValueError: A file among them is none of ours.
    """
    where = location_of(destination, filesystem)
    rows, _ = read_rows(where.below(FOLDER))
    if rows.num_rows == 0:
        raise FileNotFoundError(f"{where.at(FOLDER)}: no statistics; is {where} what flagstone-ray wrote to?")
    frame = rows.to_pandas()
    last: pandas.DataFrame = frame[~frame["path"].duplicated(keep="last")]
    return last.sort_values("path", ignore_index=True)
