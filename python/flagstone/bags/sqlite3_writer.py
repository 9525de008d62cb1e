# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Writing .db3 files of rosbag2, with the tables of its newest version (4)."""

from __future__ import annotations

import errno
import os
import sqlite3
from pathlib import Path

from flagstone.bags.container import Data, Topic

_SCHEMA_VERSION = 4
_PAGE_SIZE = 65536  # bytes, the most: clouds extend over fewer pages than with rosbag2's 4096
_TABLES = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
  offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
  encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
  data BLOB NOT NULL);
"""
_INDEX = "CREATE INDEX timestamp_idx ON messages (timestamp ASC)"
_TIME_LIMIT = 2**63


class Sqlite3Storage:
    """One .db3 file that is being written."""

    def __init__(self, path: Path, ros_distro: str) -> None:
        """Creates the tables."""
        self._path = path
        self._types: set[str] = set()
        self._connection = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
        # The file is temporary until it is complete, so that changes never need to be undone.
        for pragma in (
            f"page_size = {_PAGE_SIZE}",
            "journal_mode = OFF",
            "synchronous = OFF",
            "locking_mode = EXCLUSIVE",
        ):
            self._execute(f"PRAGMA {pragma}").fetchall()
        self._execute("BEGIN")
        for statement in _TABLES.split(";"):
            self._execute(statement)
        self._execute("INSERT INTO schema VALUES(?, CAST(? AS TEXT))", _SCHEMA_VERSION, _bytes(ros_distro))

    def _execute(self, statement: str, *values: int | Data) -> sqlite3.Cursor:
        try:
            return self._connection.execute(statement, values)
        except sqlite3.OperationalError as error:
            code = getattr(error, "sqlite_errorname", str(error))  # since Python 3.11
            number = errno.ENOSPC if "FULL" in code or "full" in code else errno.EIO
            raise OSError(number, f"{os.strerror(number)} ({error})", os.fspath(self._path)) from None
        except sqlite3.DataError as error:
            raise ValueError(f"{self._path}: {error}") from None

    def add_topic(self, topic: Topic) -> None:
        """Declares a topic."""
        text = "CAST(? AS TEXT)"
        values = [_bytes(v) for v in (topic.name, topic.type, topic.encoding, topic.qos, topic.type_hash)]
        self._execute(f"INSERT INTO topics VALUES(?, {', '.join([text] * 5)})", topic.id, *values)
        if topic.type not in self._types and topic.definition:
            self._types.add(topic.type)
            format_of_definition = topic.definition_format or "ros2msg"
            values = [_bytes(v) for v in (topic.type, format_of_definition, topic.definition, topic.type_hash)]
            self._execute(f"INSERT INTO message_definitions VALUES(NULL, {', '.join([text] * 4)})", *values)

    def add(
        self, topic: Topic, log_time: int, publish_time: int, data: Data, sequence: int | None = None, chunk: int = -1
    ) -> None:
        """Writes a message. SQLite has neither publish times nor sequence numbers nor chunks."""
        if not -_TIME_LIMIT <= log_time < _TIME_LIMIT:
            raise ValueError(f"{topic.name}: time {log_time} is out of range (expected at most {_TIME_LIMIT - 1})")
        self._execute("INSERT INTO messages VALUES(NULL, ?, ?, ?)", topic.id, log_time, data)

    def close(self, version: int, metadata: str) -> None:
        """Writes metadata and index, and closes the file."""
        self._execute("INSERT INTO metadata VALUES(NULL, ?, CAST(? AS TEXT))", version, _bytes(metadata))
        self._execute(_INDEX)
        self._execute("COMMIT")
        self._connection.close()

    def discard(self) -> None:
        """Closes the file as it is."""
        self._connection.close()


def _bytes(text: str) -> bytes:
    return text.encode(errors="surrogateescape")
