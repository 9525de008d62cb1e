# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reading .db3 files of rosbag2: SQLite databases with the tables `topics` and `messages`."""

from __future__ import annotations

import os
import sqlite3
import struct
from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import quote

from flagstone.bags.container import Bag, Message, Topic
from flagstone.bags.reports import MAX_LINES

_LIMIT = "LIMIT 65536"  # because reading damaged tables may never end
_MAX_TIME = 2**63
_TABLES = ("messages", "topics")
# Rows of other topics are not excluded in SQL, because SQLite would never end in pages that form a circle.
_ROWS = "SELECT id, topic_id, timestamp, CASE WHEN {} THEN data END FROM messages WHERE id > ? ORDER BY id"
_ROWS_WITHOUT_DATA = "SELECT id, topic_id, timestamp FROM messages WHERE id > ? ORDER BY id"


class Sqlite3File(Bag):
    """A .db3 file. Its messages are in the order of their row numbers, in which they were recorded."""

    def __init__(self, path: Path, report: Callable[[str], None]) -> None:
        """Reads the topics and counts the messages.

        Raises:
            ValueError: The file is not a database, or its tables cannot be read.
        """
        super().__init__(path, "sqlite3", report)
        self._topics: dict[int, Topic] = {}
        self._connection: sqlite3.Connection | None = None
        self._added: Path | None = None  # shared memory of SQLite, which it creates but does not delete
        try:
            self._connection = self._opened()
            self._read_topics()
            self._count()
        except sqlite3.Error as error:
            self.close()
            raise ValueError(f"{path}: cannot be read: {error} (expected a database of rosbag2)") from None
        except BaseException:
            self.close()
            raise

    def _opened(self) -> sqlite3.Connection:
        """Opens the database. Nothing in its directory changes."""
        log, journal = (self.path.with_name(self.path.name + end) for end in ("-wal", "-journal"))
        if log.exists() and log.stat().st_size > 0:
            self._reports(self.path, f"was not closed (the messages in {log.name} are read too)")
            try:
                return self._connected("mode=ro", is_truncated=False)
            except sqlite3.Error as error:
                self._reports(self.path, f"{log.name} cannot be read: {error} (the messages in it are missing)")
        elif journal.exists() and journal.stat().st_size > 0:
            self._reports(self.path, f"was not closed ({journal.name} is ignored; the last messages can be damaged)")
        size, expected = self.path.stat().st_size, _size_in_header(self.path)
        if size < expected:
            # SQLite reads the missing part of the last page as zeros.
            problem = f"is truncated: {size} of {expected} bytes (one message before the end can be damaged)"
            self._reports(self.path, problem)
        return self._connected("mode=ro&immutable=1", is_truncated=size < expected)

    def _connected(self, options: str, *, is_truncated: bool) -> sqlite3.Connection:
        shared = self.path.with_name(self.path.name + "-shm")
        had_shared = shared.exists()
        name = f"file:{quote(os.fsencode(self.path.absolute()))}?{options}"
        connection = sqlite3.connect(name, uri=True, isolation_level=None, check_same_thread=False)
        try:
            connection.text_factory = lambda text: text.decode(errors="surrogateescape")
            connection.execute("PRAGMA trusted_schema = OFF")
            if is_truncated:  # otherwise SQLite reads nothing; the database is read-only all the same
                connection.execute("PRAGMA writable_schema = ON")
            connection.execute("SELECT 1 FROM sqlite_master LIMIT 1").fetchone()
        except BaseException:
            connection.close()
            raise
        finally:
            self._added = shared if not had_shared and shared.exists() else None
        return connection

    def _rows(self, query: str, *values: Any) -> sqlite3.Cursor:
        if self._connection is None:
            raise ValueError(f"{self.path}: the bag is closed")
        return self._connection.execute(query, values)

    def _columns(self, table: str) -> frozenset[str]:
        """Names of the columns; empty if the database does not have the table."""
        is_table = self._rows("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?", table).fetchone()
        if not is_table:
            return frozenset()
        return frozenset(_text(row[1]) for row in self._rows(f"PRAGMA table_info({table})"))

    def _read_topics(self) -> None:
        for table in _TABLES:
            if not self._columns(table):
                raise ValueError(f"{self.path}: table {table!r} is missing (expected a database of rosbag2)")
        definitions = {}
        if self._columns("message_definitions"):
            query = f"SELECT topic_type, encoding, encoded_message_definition FROM message_definitions {_LIMIT}"
            for type_name, language, definition in self._rows(query):
                definitions[_text(type_name)] = (_text(language), _text(definition))
        columns = self._columns("topics")
        optional = [name if name in columns else "''" for name in ("offered_qos_profiles", "type_description_hash")]
        query = f"SELECT id, name, type, serialization_format, {', '.join(optional)} FROM topics ORDER BY id {_LIMIT}"
        for id, name, type_name, encoding, qos, type_hash in self._rows(query):
            if not isinstance(id, int):
                continue
            language, definition = definitions.get(_text(type_name), ("", ""))
            self._topics[id] = Topic(
                id=id,
                name=_text(name),
                type=_text(type_name),
                encoding=_text(encoding),
                definition=definition,
                definition_format=language,
                type_hash=_text(type_hash),
                qos=_text(qos),
            )

    def stored_metadata(self) -> str:
        """The metadata.yaml that newer versions of rosbag2 store in the database; "" if it does not contain it."""
        try:
            if not self._columns("metadata"):
                return ""
            row = self._rows("SELECT metadata FROM metadata ORDER BY id DESC LIMIT 1").fetchone()
        except sqlite3.Error as error:
            self._reports(self.path, f"table 'metadata' cannot be read: {error}")
            return ""
        return "" if row is None else _text(row[0])

    def _count(self) -> None:
        counts: dict[int, int] = {}
        start, end = _MAX_TIME, -_MAX_TIME
        for _, id, time in self._readable_rows(_ROWS_WITHOUT_DATA):
            if id in self._topics and isinstance(time, int):
                counts[id] = counts.get(id, 0) + 1
                start, end = min(start, time), max(end, time)
        if counts:
            self.start_time, self.end_time = start, end
        self.topics = tuple(replace(topic, message_count=counts.get(id, 0)) for id, topic in self._topics.items())
        self._topics = {topic.id: topic for topic in self.topics}

    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """See `Bag.messages`."""
        if self._connection is None:
            raise ValueError(f"{self.path}: the bag is closed")
        wanted = frozenset(topic.id for topic in self.topics if topics is None or topic.name in topics)
        condition = "1" if topics is None else f"topic_id IN ({','.join(map(str, wanted))})"
        return self._messages(_ROWS.format(condition), wanted)

    def _messages(self, query: str, wanted: frozenset[int]) -> Iterator[Message]:
        for row, id, time, data in self._readable_rows(query):
            topic = self._topics.get(id)
            if topic is None:
                self._reports(self.path, f"row {row} has the unknown topic {id} (it is skipped)")
            elif id not in wanted:
                continue
            elif not isinstance(time, int) or not isinstance(data, bytes):
                self._reports(self.path, f"row {row} is damaged (it is skipped)")
            else:
                yield Message(topic, time, time, data)

    def _readable_rows(self, query: str) -> Iterator[tuple[Any, ...]]:
        """The rows of a query, whose first value is the row number before the first row. Skips and reports damage."""
        last = -(2**63)
        for _ in range(MAX_LINES):
            try:
                for row in self._rows(query, last):
                    # Damaged pages can refer to each other in a circle, which would never end.
                    if not isinstance(row[0], int) or row[0] <= last:
                        raise sqlite3.DatabaseError("row numbers are not in order")
                    last = row[0]
                    yield row
                return
            except sqlite3.Error as error:
                following = self._next_readable(query, last)
                if following is None:
                    self._reports(self.path, f"rows after {max(last, 0)} cannot be read: {error}")
                    return
                first = max(last, 0) + 1
                rows = f"row {first}" if following == first + 1 else f"rows {first} to {following - 1}"
                self._reports(self.path, f"{rows}: {error} (the messages are skipped)")
                last = following - 1
        self._reports(self.path, f"rows after {max(last, 0)} are skipped because too many are damaged")

    def _next_readable(self, query: str, last: int) -> int | None:
        """Number of the first row after damaged ones that can be read; None if no row can."""

        def first_after(row: int) -> int | None:
            try:
                found = self._rows(query, row).fetchone()
            except sqlite3.Error:
                return -1
            if found is None:
                return None
            return found[0] if isinstance(found[0], int) and found[0] > row else -1

        # A query after `damaged` fails, a query after `readable` succeeds.
        damaged, step = max(last, 0), 1
        while first_after(damaged + step) == -1:
            damaged, step = damaged + step, 2 * step
            if damaged + step >= 2**62:
                return None
        readable = damaged + step
        while readable - damaged > 1:
            middle = (damaged + readable) // 2
            if first_after(middle) == -1:
                damaged = middle
            else:
                readable = middle
        following = first_after(readable)
        return following if following is not None and following > max(last, 0) else None

    def close(self) -> None:
        """See `Bag.close`."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None
        if self._added is not None:
            self._added.unlink(missing_ok=True)
            self._added = None


def _size_in_header(path: Path) -> int:
    """Bytes of a database by its header: pages times their size, in which 1 means 65536."""
    with path.open("rb") as file:
        header = file.read(32)
    if len(header) < 32:
        return 32
    (page_size,) = struct.unpack_from(">H", header, 16)
    (pages,) = struct.unpack_from(">I", header, 28)
    return int(pages * (65536 if page_size == 1 else page_size))


def _text(value: Any) -> str:
    """A value of a column; SQLite stores any type in any column."""
    if isinstance(value, bytes):
        return value.decode(errors="surrogateescape")
    return "" if value is None else str(value)
