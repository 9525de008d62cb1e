# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reading bags of ROS 1, version 2.0: http://wiki.ros.org/Bags/Format/2.0.

A bag is a sequence of records, each with a header of named fields and with data. Chunks contain the messages and the
connections (a topic of one publisher), and may be compressed. The index follows the last chunk; `rosbag` omits it if
it is killed.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from flagstone.bags.compression import decompressed
from flagstone.bags.container import Bag, Compression, Data, Message, Topic
from flagstone.bags.input_file import InputFile
from flagstone.bags.reports import DamagedError

MAGIC = b"#ROSBAG V2.0\n"

MESSAGE, BAG_HEADER, INDEX, CHUNK, CHUNK_INFO, CONNECTION = 2, 3, 4, 5, 6, 7
_OPERATIONS = frozenset((MESSAGE, BAG_HEADER, INDEX, CHUNK, CHUNK_INFO, CONNECTION))
COMPRESSIONS: dict[bytes, Compression] = {b"none": "none", b"lz4": "lz4", b"bz2": "bz2"}

U32 = struct.Struct("<I")
U64 = struct.Struct("<Q")
TIME = struct.Struct("<II")  # seconds, nanoseconds
PAIR = struct.Struct("<II")

CONNECTION_FIELD = b"\x09\x00\x00\x00conn="
OPERATION_FIELD = b"\x04\x00\x00\x00op=\x02"
TIME_FIELD = b"\x0d\x00\x00\x00time="
MESSAGE_HEADER_SIZE = 38
_CONNECTION_FIELDS = ("type", "md5sum", "message_definition")  # in addition to the topic, ROS requires these
_CHUNK_FIELD = b"\x04\x00\x00\x00op=\x05"
# The header of a message as the C++ and the Python library write it, with its length and that of the data.
SORTED_MESSAGE = struct.Struct("<I9sI17sIII")
_UNSORTED_MESSAGE = struct.Struct("<I17sI9sIII")
_SORTED_FIELDS = (CONNECTION_FIELD, OPERATION_FIELD + TIME_FIELD)
_UNSORTED_FIELDS = (OPERATION_FIELD + CONNECTION_FIELD, TIME_FIELD)


class Record(NamedTuple):
    """The fields of a record, and the limits of its data."""

    fields: dict[bytes, bytes]
    begin: int
    end: int

    @property
    def operation(self) -> int:
        """Kind of the record; -1 if it has none."""
        value = self.fields.get(b"op", b"")
        return value[0] if len(value) == 1 else -1

    def u32(self, name: bytes) -> int:
        """Value of a field of 4 bytes."""
        return int(U32.unpack(self._value(name, 4))[0])

    def u64(self, name: bytes) -> int:
        """Value of a field of 8 bytes."""
        return int(U64.unpack(self._value(name, 8))[0])

    def time(self, name: bytes) -> int:
        """A time in nanoseconds."""
        seconds, nanoseconds = TIME.unpack(self._value(name, 8))
        return int(seconds * 10**9 + nanoseconds)

    def _value(self, name: bytes, size: int) -> bytes:
        value = self.fields.get(name)
        if value is None or len(value) != size:
            raise DamagedError(f"field {name.decode()!r} is missing or does not have {size} bytes")
        return value


def fields_of(data: Data) -> dict[bytes, bytes]:
    """The fields of a header: each is a length, a name, "=" and a value.

    Raises:
        DamagedError: The fields do not fill the header.
    """
    fields = {}
    position = 0
    while position < len(data):
        if position + 4 > len(data):
            raise DamagedError("the header is damaged")
        (size,) = U32.unpack_from(data, position)
        position += 4
        if position + size > len(data):
            raise DamagedError("the header is damaged")
        name, separator, value = bytes(data[position : position + size]).partition(b"=")
        if not separator:
            raise DamagedError("the header is damaged")
        fields[name] = value
        position += size
    return fields


def record_at(view: Data, position: int) -> Record:
    """The record at a position.

    Raises:
        DamagedError: It extends beyond the end, or its header is damaged.
    """
    if position + 4 > len(view):
        raise DamagedError("the record is truncated")
    (size,) = U32.unpack_from(view, position)
    begin = position + 4
    if begin + size + 4 > len(view):
        raise DamagedError(f"a header of {size} bytes extends beyond the end")
    fields = fields_of(view[begin : begin + size])
    (length,) = U32.unpack_from(view, begin + size)
    begin += size + 4
    if begin + length > len(view):
        raise TruncatedError(Record(fields, begin, len(view)), length)
    return Record(fields, begin, begin + length)


class TruncatedError(DamagedError):
    """Data that extend beyond the end. `record` contains those that exist."""

    def __init__(self, record: Record, length: int) -> None:
        super().__init__(f"data of {length} bytes extend beyond the end")
        self.record = record


@dataclass(frozen=True)
class _Chunk:
    """An entry of the index."""

    connections: frozenset[int]
    begin: int
    end: int


class Rosbag1(Bag):
    """A bag of ROS 1."""

    def __init__(self, path: Path, report: Callable[[str], None]) -> None:
        """Reads the index, or every chunk if the index is missing or damaged.

        Raises:
            ValueError: The bag is of another version, is encrypted, or contains nothing that can be read.
        """
        super().__init__(path, "rosbag1", report)
        self.connections: dict[int, bytes] = {}
        """The record of each connection, as it is in the file."""
        self._topics: dict[int, Topic] = {}
        self._chunks: dict[int, _Chunk] = {}
        self._damaged_connections: set[int] = set()
        self._file = InputFile(path)
        try:
            self._open()
        except BaseException:
            self._file.close()
            raise

    def _open(self) -> None:
        view = self._file.view
        if bytes(view[: len(MAGIC)]) != MAGIC:
            version = re.match(rb"#ROSBAG V([\d.]+)\n", bytes(view[:32]))
            if version is None:
                raise ValueError(f"{self.path}: is not a bag of ROS 1 (expected '#ROSBAG V2.0')")
            raise ValueError(
                f"{self.path}: version {version[1].decode()} is not supported (expected 2.0; run 'rosbag fix')"
            )
        self._begin, index = self._read_bag_header()
        self._end = self._file.size
        if not self._read_index(index):
            self._topics.clear()
            self.connections.clear()
            self._chunks.clear()
            self._count()
        else:
            self._end = index
        self.topics = tuple(topic for _, topic in sorted(self._topics.items()))
        if not self.topics and self._is_damaged:
            raise ValueError(f"{self.path}: the bag has no part that can be read")

    def _read_bag_header(self) -> tuple[int, int]:
        """Position of the first record after the bag header, and of the index; 0 if the index is missing."""
        begin = len(MAGIC)
        self._is_damaged = False
        try:
            record = record_at(self._file.view, begin)
            if record.operation != BAG_HEADER:
                raise DamagedError("the bag header is missing")
            if record.fields.get(b"encryptor"):
                name = record.fields[b"encryptor"].decode(errors="replace")
                raise ValueError(f"{self.path}: the bag is encrypted with {name!r} (decrypt it first)")
            return record.end, record.u64(b"index_pos")
        except DamagedError as error:
            self._report(begin, f"{error} (the first chunk is searched)")
            self._is_damaged = True
            return self._next_chunk(begin), 0

    def _report(self, position: int, problem: str) -> None:
        self._reports(self.path, f"byte {position}: {problem}")

    def _read_index(self, begin: int) -> bool:
        """Reads connections and chunk infos. Returns False if they are missing or damaged, which is reported."""
        if self._is_damaged:
            return False
        if begin == 0:
            self._reports(self.path, "the index is missing because the bag was not closed (every chunk is read)")
            return False
        if begin < self._begin or begin > self._file.size:
            problem = f"byte {begin}: the index is missing because the bag is truncated (every chunk is read)"
            self._reports(self.path, problem)
            return False
        position = begin
        counts: dict[int, int] = {}
        try:
            while position < self._file.size:
                record = record_at(self._file.view, position)
                if record.operation == CONNECTION:
                    self._add_connection(position, record)
                elif record.operation == CHUNK_INFO:
                    self._add_chunk_info(record, counts)
                position = record.end
            if not counts.keys() <= self._topics.keys():
                raise DamagedError("a connection is missing")
            for position in sorted(self._chunks):
                self._check_chunk(position)
        except DamagedError as error:
            self._report(position, f"the index is damaged: {error} (every chunk is read)")
            return False
        self._set_counts(counts)
        self.start_time = min((chunk.begin for chunk in self._chunks.values()), default=None)
        self.end_time = max((chunk.end for chunk in self._chunks.values()), default=None)
        return True

    def _add_connection(self, position: int, record: Record, view: Data | None = None) -> None:
        source = self._file.view if view is None else view
        id = record.u32(b"conn")
        if id in self._topics:
            return
        header = fields_of(source[record.begin : record.end])
        text = {name.decode(errors="surrogateescape"): _text(value) for name, value in header.items()}
        name = record.fields.get(b"topic", header.get(b"topic"))
        missing = [field for field in _CONNECTION_FIELDS if field not in text]
        if name is None or missing:
            raise DamagedError(f"connection {id} has no {(missing or ['topic'])[0]}")
        self.connections[id] = bytes(source[position : record.end])
        self._topics[id] = Topic(
            id=id,
            name=_text(name),
            type=type_of_ros2(text["type"]),
            encoding="ros1",
            definition=text["message_definition"],
            definition_format="ros1msg",
            type_hash=text["md5sum"],
            is_latched=text.get("latching") == "1",
            caller_id=text.get("callerid", ""),
            metadata=text,
        )

    def _add_chunk_info(self, record: Record, counts: dict[int, int]) -> None:
        position = record.u64(b"chunk_pos")
        if record.u32(b"ver") != 1 or not self._begin <= position < self._file.size:
            raise DamagedError("a chunk info is damaged")
        count = record.u32(b"count")
        if record.end - record.begin != count * PAIR.size:
            raise DamagedError("a chunk info is damaged")
        connections = []
        for id, number in PAIR.iter_unpack(self._file.view[record.begin : record.end]):
            counts[id] = counts.get(id, 0) + number
            connections.append(id)
        self._chunks[position] = _Chunk(frozenset(connections), record.time(b"start_time"), record.time(b"end_time"))

    def _check_chunk(self, position: int) -> None:
        record = record_at(self._file.view, position)
        if record.operation != CHUNK:
            raise DamagedError("is not a chunk")
        if record.fields.get(b"compression") in COMPRESSIONS:
            self._set_compression(record)

    def _set_compression(self, record: Record) -> Compression:
        name = record.fields.get(b"compression", b"")
        compression = COMPRESSIONS.get(name)
        if compression is None:
            raise DamagedError(f"compression {_text(name[:20])!r} is not supported (expected none, lz4 or bz2)")
        if self.compression == "none":
            self.compression = compression
            self.compression_mode = "" if compression == "none" else "chunk"
        return compression

    def _count(self) -> None:
        """Finds connections, counts and times in the chunks."""
        self._set_counts(self._counted(self._walk(None, self._file.size)))

    def _set_counts(self, counts: dict[int, int]) -> None:
        for id, topic in self._topics.items():
            self._topics[id] = replace(topic, message_count=counts.get(id, 0))

    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """See `Bag.messages`."""
        self._file.check()
        wanted = None
        if topics is not None:
            wanted = frozenset(id for id, topic in self._topics.items() if topic.name in topics)
        return self._walk(wanted, self._end)

    def _walk(self, wanted: frozenset[int] | None, end: int) -> Iterator[Message]:
        """Reads the records from the first to `end`. `wanted` are the connections, None for all."""
        view = self._file.view
        position = self._begin
        chunks = iter([*sorted(self._chunks), end])
        next_chunk = next(chunks)
        while position < end:
            self._file.check()
            while next_chunk < position:
                next_chunk = next(chunks, end)
            if wanted is not None and position in self._chunks and not wanted & self._chunks[position].connections:
                position = self._after(position, end)
                continue
            try:
                record = record_at(view, position)
                operation = record.operation
                if operation not in _OPERATIONS:
                    raise DamagedError(f"a record of unknown kind {operation}")
                if position < next_chunk < record.end:
                    raise DamagedError("a record overlaps the next chunk")
                if position in self._chunks and operation != CHUNK:
                    raise DamagedError("is not a chunk")
                message = self._message(record, view, -1) if operation == MESSAGE else None
            except TruncatedError as error:
                self._is_damaged = True
                record = error.record
                if record.operation == CHUNK and self._next_chunk(position + 1) >= end:
                    self._report(position, f"the bag is truncated in a chunk: {error} (the rest of it is missing)")
                    yield from self._chunk(position, record, wanted, is_partial=True)
                    return
                position = self._skip_damage(position, error, end)
                continue
            except DamagedError as error:
                self._is_damaged = True
                position = self._skip_damage(position, error, end)
                continue
            if operation == CHUNK:
                yield from self._chunk(position, record, wanted)
            elif operation == CONNECTION:
                self._keep_connection(position, record, view)
            elif message is not None and (wanted is None or message.topic.id in wanted):
                yield message
            position = record.end

    def _after(self, position: int, end: int) -> int:
        """Position after a chunk that is not read; the next chunk if its header is damaged."""
        try:
            after = record_at(self._file.view, position).end
        except DamagedError:
            after = end
        return min((chunk for chunk in self._chunks if position < chunk < after), default=after)

    def _skip_damage(self, position: int, error: DamagedError, end: int) -> int:
        following = self._next_chunk(position + 1)
        if following >= end:
            self._report(position, f"{error} (the rest of the bag is skipped)")
            return end
        self._report(position, f"{error} ({following - position} bytes are skipped, up to the next chunk)")
        return following

    def _next_chunk(self, position: int) -> int:
        """Position of the next record that looks like a chunk; the size of the file if none follows."""
        while True:
            found = self._file.find(_CHUNK_FIELD, position)
            if found < 0:
                return self._file.size
            # The field can be the first, second or third of the header, whose begin is therefore searched.
            for begin in range(max(position, found - 80), found - 3):
                try:
                    if record_at(self._file.view, begin).operation == CHUNK:
                        return begin
                except TruncatedError as error:
                    if error.record.operation == CHUNK:
                        return begin
                except DamagedError:
                    pass
            position = found + 1

    def _chunk(
        self, position: int, record: Record, wanted: frozenset[int] | None, *, is_partial: bool = False
    ) -> Iterator[Message]:
        """The messages of a chunk."""
        try:
            compression = self._set_compression(record)
            size = record.u32(b"size")
            data = decompressed(compression, self._file.view[record.begin : record.end], size, is_partial=is_partial)
        except DamagedError as error:
            self._is_damaged = True
            self._report(position, f"chunk: {error} (the messages in it are skipped)")
            return
        data = memoryview(data)
        offset = 0
        try:
            while offset < len(data):
                fast = self._fast_message(data, offset, position)
                if fast is not None:
                    message, offset = fast
                    if wanted is None or message.topic.id in wanted:
                        yield message
                    continue
                inner = record_at(data, offset)
                if inner.operation == CONNECTION:
                    self._keep_connection(offset, inner, data)
                elif inner.operation == MESSAGE:
                    found = self._message(inner, data, position)
                    if found is not None and (wanted is None or found.topic.id in wanted):
                        yield found
                else:
                    raise DamagedError(f"a record of unknown kind {inner.operation}")
                offset = inner.end
        except DamagedError as error:
            self._is_damaged = True
            if not is_partial:
                self._report(position, f"chunk: {error} (the messages after byte {offset} of it are skipped)")

    def _fast_message(self, data: memoryview, offset: int, chunk: int) -> tuple[Message, int] | None:
        """The message at `offset` and the end of its record; None if its header has another layout than usual."""
        begin = offset + SORTED_MESSAGE.size
        if begin > len(data):
            return None
        size, first, id, second, seconds, nanoseconds, length = SORTED_MESSAGE.unpack_from(data, offset)
        if size != MESSAGE_HEADER_SIZE:
            return None
        if (first, second) != _SORTED_FIELDS:
            _, first, id, second, seconds, nanoseconds, length = _UNSORTED_MESSAGE.unpack_from(data, offset)
            if (first, second) != _UNSORTED_FIELDS:
                return None
        end = begin + length
        topic = self._topics.get(id)
        if end > len(data) or topic is None:
            return None
        time = seconds * 1_000_000_000 + nanoseconds
        return Message(topic, time, time, data[begin:end], 0, chunk), end

    def _message(self, record: Record, view: Data, chunk: int) -> Message | None:
        """The message in a record; None if its connection is unknown, which is reported."""
        id = record.u32(b"conn")
        time = record.time(b"time")
        topic = self._topics.get(id)
        if topic is None:
            self._reports(self.path, f"messages of the unknown connection {id} are skipped")
            return None
        return Message(topic, time, time, memoryview(view)[record.begin : record.end], 0, chunk)

    def _keep_connection(self, position: int, record: Record, view: Data) -> None:
        if self._chunks:  # the index contains all connections
            return
        try:
            self._add_connection(position, record, view)
        except DamagedError as error:
            self._report(position, f"{error} (its messages are skipped)")

    def close(self) -> None:
        """See `Bag.close`."""
        self._file.close()


def type_of_ros2(name: str) -> str:
    """The name of a message type with "/msg/", as ROS 2 writes it."""
    package, separator, type_name = name.partition("/")
    return f"{package}/msg/{type_name}" if separator and "/" not in type_name else name


def type_of_ros1(name: str) -> str:
    """The name of a message type without "/msg/", as ROS 1 writes it."""
    return name.replace("/msg/", "/", 1)


def _text(value: bytes) -> str:
    return value.decode(errors="surrogateescape")
