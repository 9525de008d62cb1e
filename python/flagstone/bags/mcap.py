# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reading MCAP files: https://mcap.dev/spec.

A file is a sequence of records, each with an opcode and a length. Schemas, channels and messages are in chunks, which
may be compressed, or directly in the file. A summary of all chunks follows the data; recorders that are killed do not
write it.
"""

from __future__ import annotations

import re
import struct
import zlib
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from flagstone.bags.compression import decompressed
from flagstone.bags.container import Bag, Compression, Data, Message, Topic
from flagstone.bags.input_file import InputFile
from flagstone.bags.reports import DamagedError

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
ATTACHMENT, ATTACHMENT_INDEX, STATISTICS, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END = range(9, 16)

COMPRESSIONS: dict[str, Compression] = {"": "none", "lz4": "lz4", "zstd": "zstd"}
QOS = "offered_qos_profiles"
TYPE_HASH = "topic_type_hash"
ROSBAG2_METADATA = "rosbag2"
"""Name of the metadata record in which rosbag2 stores its metadata.yaml."""

RECORD = struct.Struct("<BQ")  # opcode, length
MESSAGE_RECORD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
CHUNK_HEADER = struct.Struct("<QQQII")  # start, end, size, CRC, length of the compression's name
FOOTER_CONTENT = struct.Struct("<QQI")  # start of the summary, start of its offsets, CRC
U16 = struct.Struct("<H")
U32 = struct.Struct("<I")
U64 = struct.Struct("<Q")
_FOOTER_SIZE = RECORD.size + FOOTER_CONTENT.size + len(MAGIC)
# A chunk of less than 2^40 bytes, to find the next one after damage.
_CHUNK_PATTERN = re.compile(
    rb"\x06(?=.{5}\x00{3}.{28}(?:\x00{4}.{5}\x00{3}|\x03\x00{3}lz4|\x04\x00{3}zstd))", re.DOTALL
)


class Cursor:
    """Reads the members of a record in their order. Raises DamagedError at its end."""

    def __init__(self, view: Data, begin: int, end: int) -> None:
        self._view = view
        self.position = begin
        self.end = end

    def number(self, kind: struct.Struct) -> int:
        """One integer."""
        return int(kind.unpack(self.bytes(kind.size))[0])

    def bytes(self, size: int) -> Data:
        """The next bytes, without copying them."""
        if size > self.end - self.position:
            raise DamagedError(f"{size} bytes at byte {self.position} extend beyond their record")
        self.position += size
        return self._view[self.position - size : self.position]

    def text(self) -> str:
        """A string after its length."""
        return bytes(self.bytes(self.number(U32))).decode(errors="surrogateescape")

    def map(self) -> dict[str, str]:
        """Strings by strings."""
        size = self.number(U32)
        members = Cursor(self._view, self.position, self.position + size)
        self.bytes(size)
        result = {}
        while members.position < members.end:
            key = members.text()
            result[key] = members.text()
        return result


class Record(NamedTuple):
    """Opcode of a record, and the limits of its content."""

    operation: int
    begin: int
    end: int


class Schema(NamedTuple):
    """A message definition."""

    name: str
    encoding: str
    data: str


class ChunkHeader(NamedTuple):
    """The members of a chunk before its records, and the limits of the records."""

    size: int
    crc: int
    compression: str
    begin: int
    end: int


@dataclass(frozen=True)
class _Chunk:
    """An entry of the summary."""

    channels: frozenset[int]
    """Empty if the summary does not list them."""


class McapFile(Bag):
    """An MCAP file."""

    def __init__(self, path: Path, report: Callable[[str], None]) -> None:
        """Reads the summary, or every chunk if the summary is missing or damaged.

        Raises:
            ValueError: The file is of another version, or contains nothing that can be read.
        """
        super().__init__(path, "mcap", report)
        self.profile = ""
        self.library = ""
        self.has_chunks = False
        self.has_crcs = True
        """Whether the chunks contain check sums."""
        self._schemas: dict[int, Schema] = {}
        self._topics: dict[int, Topic] = {}
        self._chunks: dict[int, _Chunk] = {}
        self._attachments: list[int] = []
        self._metadata: list[int] = []
        self._is_damaged = False
        self._file = InputFile(path)
        try:
            self._open()
        except BaseException:
            self._file.close()
            raise

    def _open(self) -> None:
        view = self._file.view
        if bytes(view[: len(MAGIC)]) != MAGIC:
            raise ValueError(f"{self.path}: is not an MCAP file of version 0")
        self._end = self._file.size
        try:
            header = self._record(len(MAGIC))
            if header.operation != HEADER:
                raise DamagedError("the header is missing")
            members = Cursor(view, header.begin, header.end)
            self.profile, self.library = members.text(), members.text()
        except DamagedError as error:
            self._report(len(MAGIC), f"{error}")
        if not self._read_summary():
            self._schemas.clear()
            self._topics.clear()
            self._chunks.clear()
            self._attachments.clear()
            self._metadata.clear()
            self._count()
            if not self._topics and self._is_damaged:
                raise ValueError(f"{self.path}: the bag has no part that can be read")
        self.topics = tuple(topic for _, topic in sorted(self._topics.items()))

    def _report(self, position: int, problem: str) -> None:
        self._reports(self.path, f"byte {position}: {problem}")

    def _record(self, position: int) -> Record:
        view = self._file.view
        if position + RECORD.size > len(view):
            raise DamagedError("a record is truncated")
        operation, length = RECORD.unpack_from(view, position)
        begin = position + RECORD.size
        if operation == 0:
            raise DamagedError("is not a record")
        if length > len(view) - begin:
            raise DamagedError(f"a record of {length} bytes extends beyond the end of the file")
        return Record(operation, begin, begin + length)

    # Summary

    def _read_summary(self) -> bool:
        """Returns False if the summary is missing or damaged, which is reported."""
        position = self._file.size - _FOOTER_SIZE
        try:
            begin, crc = self._read_footer(position)
            if begin == 0:
                self._reports(self.path, "the summary is missing (every chunk is read)")
                return False
            crc_end = self._file.size - len(MAGIC) - U32.size
            if crc and zlib.crc32(self._file.view[begin:crc_end]) != crc:
                raise DamagedError("the check sum of the summary is wrong")
            self._read_summary_records(begin, position, is_trusted=crc != 0)
        except DamagedError as error:
            self._report(max(0, position), f"{error} (every chunk is read)")
            return False
        self._end = begin
        return True

    def _read_footer(self, position: int) -> tuple[int, int]:
        view = self._file.view
        if position < len(MAGIC) or bytes(view[-len(MAGIC) :]) != MAGIC:
            raise DamagedError("the end is missing because the bag was not closed or is truncated")
        footer = self._record(position)
        if footer.operation != FOOTER or footer.end - footer.begin != FOOTER_CONTENT.size:
            raise DamagedError("the footer is damaged")
        begin, _, crc = FOOTER_CONTENT.unpack_from(view, footer.begin)
        if begin and not len(MAGIC) < begin <= position:
            raise DamagedError("the footer is damaged")
        return int(begin), int(crc)

    def _read_summary_records(self, position: int, end: int, *, is_trusted: bool) -> None:
        statistics = None
        while position < end:
            record = self._record(position)
            members = Cursor(self._file.view, record.begin, record.end)
            if record.operation == SCHEMA:
                self._add_schema(members)
            elif record.operation == CHANNEL:
                self._add_channel(members)
            elif record.operation == CHUNK_INDEX:
                self._add_chunk(members, is_trusted=is_trusted)
            elif record.operation == ATTACHMENT_INDEX:
                self._attachments.append(members.number(U64))
            elif record.operation == METADATA_INDEX:
                self._metadata.append(members.number(U64))
            elif record.operation == STATISTICS:
                statistics = members
            position = record.end
        if statistics is None:
            raise DamagedError("the summary has no statistics")
        self._read_statistics(statistics)

    def _add_schema(self, members: Cursor) -> None:
        id = members.number(U16)
        name, encoding = members.text(), members.text()
        data = bytes(members.bytes(members.number(U32))).decode(errors="surrogateescape")
        self._schemas.setdefault(id, Schema(name, encoding, data))

    def _add_channel(self, members: Cursor) -> None:
        id, schema_id = members.number(U16), members.number(U16)
        name, encoding, metadata = members.text(), members.text(), members.map()
        if id in self._topics:
            return
        schema = self._schemas.get(schema_id)
        if schema is None:
            if schema_id:
                raise DamagedError(f"schema {schema_id} of channel {id} is missing")
            schema = Schema("", "", "")
        self._topics[id] = Topic(
            id=id,
            name=name,
            type=schema.name,
            encoding=encoding,
            definition=schema.data,
            definition_format=schema.encoding,
            type_hash=metadata.get(TYPE_HASH, ""),
            qos=metadata.get(QOS, ""),
            is_latched=metadata.get("latching") == "1",
            caller_id=metadata.get("callerid", ""),
            metadata=metadata,
        )

    def _add_chunk(self, members: Cursor, *, is_trusted: bool) -> None:
        members.bytes(16)  # times
        position, length = members.number(U64), members.number(U64)
        end = members.position + 4 + members.number(U32)
        channels = frozenset(U16.unpack_from(members.bytes(10))[0] for _ in range((end - members.position) // 10))
        try:
            record = self._record(position)
            if record.operation != CHUNK or record.end - position != length:
                raise DamagedError(f"the summary lists a chunk at byte {position}, which is not a chunk")
            self._set_compression(self._chunk_header(record))
        except DamagedError:
            if not is_trusted:
                raise
        self._chunks[position] = _Chunk(channels)

    def _read_statistics(self, members: Cursor) -> None:
        count = members.number(U64)
        members.bytes(2)
        channel_count = members.number(U32)
        listed = (members.number(U32), members.number(U32), members.number(U32))
        start, end = members.number(U64), members.number(U64)
        counts = {}
        for _ in range(members.number(U32) // 10):
            id = members.number(U16)
            counts[id] = members.number(U64)
        # Writers may omit channels or their counts from the summary.
        if (
            channel_count != len(self._topics)
            or sum(counts.values()) != count
            or not counts.keys() <= set(self._topics)
        ):
            raise DamagedError("the summary is not complete")
        if listed != (len(self._attachments), len(self._metadata), len(self._chunks)):
            self._find_unlisted()
        if count:
            self.start_time, self.end_time = start, end
        for id, topic in self._topics.items():
            self._topics[id] = replace(topic, message_count=counts.get(id, 0))

    def _find_unlisted(self) -> None:
        """Finds the records that the summary counts but does not list."""
        self._attachments.clear()
        self._metadata.clear()
        position = len(MAGIC)
        while position < self._file.size:
            record = self._record(position)
            if record.operation == ATTACHMENT:
                self._attachments.append(position)
            elif record.operation == METADATA:
                self._metadata.append(position)
            elif record.operation == CHUNK:
                self._set_compression(self._chunk_header(record))
                self._chunks.setdefault(position, _Chunk(frozenset()))
            elif record.operation in (DATA_END, FOOTER):
                return
            position = record.end

    # Chunks

    def _chunk_header(self, record: Record, *, is_partial: bool = False) -> ChunkHeader:
        members = Cursor(self._file.view, record.begin, record.end)
        _, _, size, crc, length = CHUNK_HEADER.unpack(members.bytes(CHUNK_HEADER.size))
        compression = bytes(members.bytes(length)).decode(errors="replace")
        stored = members.number(U64)
        if not is_partial and stored != record.end - members.position:
            raise DamagedError(f"{stored} bytes of records do not match the length of the chunk")
        return ChunkHeader(size, crc, compression, members.position, record.end)

    def _set_compression(self, chunk: ChunkHeader) -> Compression:
        compression = COMPRESSIONS.get(chunk.compression)
        if compression is None:
            problem = f"compression {chunk.compression[:20]!r} is not supported (expected lz4 or zstd)"
            raise DamagedError(problem)
        if not self.has_chunks:
            self.has_crcs = chunk.crc != 0
        self.has_chunks = True
        if self.compression == "none":
            self.compression = compression
            self.compression_mode = "" if compression == "none" else "chunk"
        return compression

    def _count(self) -> None:
        """Finds channels, counts and times in the data."""
        counts = self._counted(self._walk(None, self._file.size))
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
        """Reads the records from the first to `end`. `wanted` are the channels, None for all."""
        view = self._file.view
        position = len(MAGIC)
        is_counting = not self.topics
        chunks = iter([*sorted(self._chunks), end])
        next_chunk = next(chunks)
        while position < end:
            self._file.check()
            while next_chunk < position:
                next_chunk = next(chunks, end)
            try:
                record = self._record(position)
                if position < next_chunk < record.end:
                    raise DamagedError("a record overlaps the next chunk")
                if position in self._chunks and record.operation != CHUNK:
                    raise DamagedError("is not a chunk")
            except DamagedError as error:
                self._is_damaged = True
                following = self._next_chunk(position, next_chunk, end)
                if following >= end and view[position] == CHUNK:
                    problem = f"the file is truncated in a chunk: {error} (the rest of it is missing)"
                    self._report(position, problem)
                    record = Record(CHUNK, min(position + RECORD.size, self._file.size), self._file.size)
                    yield from self._chunk(position, record, wanted, is_counting, is_partial=True)
                    return
                skipped = f"{following - position} bytes are skipped, up to the next chunk"
                self._report(position, f"{error} ({'the rest is skipped' if following >= end else skipped})")
                position = following
                continue
            operation = record.operation
            if operation == CHUNK:
                chunk = self._chunks.get(position)
                if wanted is None or chunk is None or not chunk.channels or wanted & chunk.channels:
                    yield from self._chunk(position, record, wanted, is_counting)
            elif operation == MESSAGE:
                message = self._message(position, record)
                if message is not None and (wanted is None or message.topic.id in wanted):
                    yield message
            elif operation in (DATA_END, FOOTER):
                return
            elif operation > DATA_END:
                self._reports(self.path, f"records of the unknown kind 0x{operation:02x} are skipped")
            elif is_counting:
                self._keep(position, record)
            position = record.end

    def _keep(self, position: int, record: Record) -> None:
        """Keeps what the summary would list."""
        try:
            members = Cursor(self._file.view, record.begin, record.end)
            if record.operation == SCHEMA:
                self._add_schema(members)
            elif record.operation == CHANNEL:
                self._add_channel(members)
            elif record.operation == ATTACHMENT:
                self._attachments.append(position)
            elif record.operation == METADATA:
                self._metadata.append(position)
        except DamagedError as error:
            self._report(position, f"{error} (the record is skipped)")

    def _next_chunk(self, position: int, expected: int, end: int) -> int:
        """Position of the next chunk by the summary, or otherwise of the next record that looks like a chunk."""
        if self._chunks:
            return expected if expected > position else end
        for found in self._file.finditer(_CHUNK_PATTERN, position + 1):
            try:
                record = self._record(found)
                self._chunk_header(record)
                return found
            except DamagedError:
                pass
        return end

    def _chunk(
        self,
        position: int,
        record: Record,
        wanted: frozenset[int] | None,
        is_counting: bool,
        *,
        is_partial: bool = False,
    ) -> Iterator[Message]:
        """The messages of a chunk."""
        try:
            header = self._chunk_header(record, is_partial=is_partial)
            compression = self._set_compression(header)
            stored = self._file.view[header.begin : header.end]
            data = decompressed(compression, stored, header.size, is_partial=is_partial)
            if header.crc and not is_partial and zlib.crc32(data) != header.crc:
                raise DamagedError("the check sum is wrong")
        except DamagedError as error:
            self._is_damaged = True
            self._report(position, f"chunk: {error} (the messages in it are skipped)")
            return
        data = memoryview(data)
        size = len(data)
        unpack = MESSAGE_RECORD.unpack_from
        topics = self._topics
        offset = 0
        while offset + RECORD.size <= size:
            operation, length = RECORD.unpack_from(data, offset)
            begin = offset + RECORD.size
            if length > size - begin:
                break
            if operation == MESSAGE and length >= 22:
                _, _, id, sequence, log_time, publish_time = unpack(data, offset)
                topic = topics.get(id)
                if topic is None:
                    self._report(position, f"chunk: a message of the unknown channel {id} (it is skipped)")
                elif wanted is None or id in wanted:
                    content = data[offset + MESSAGE_RECORD.size : begin + length]
                    yield Message(topic, log_time, publish_time, content, sequence, position)
            elif is_counting and operation in (SCHEMA, CHANNEL):
                try:
                    members = Cursor(data, begin, begin + length)
                    (self._add_schema if operation == SCHEMA else self._add_channel)(members)
                except DamagedError as error:
                    self._report(position, f"chunk: {error} (the record is skipped)")
            offset = begin + length
        if offset < size and not is_partial:
            self._is_damaged = True
            self._report(position, f"chunk: is damaged (the messages after byte {offset} of it are skipped)")

    def _message(self, position: int, record: Record) -> Message | None:
        """A message that is not in a chunk."""
        if record.end - record.begin < MESSAGE_RECORD.size - RECORD.size:
            self._report(position, "a message is too short (it is skipped)")
            return None
        _, _, id, sequence, log_time, publish_time = MESSAGE_RECORD.unpack_from(self._file.view, position)
        topic = self._topics.get(id)
        if topic is None:
            self._report(position, f"a message of the unknown channel {id} (it is skipped)")
            return None
        data = self._file.view[position + MESSAGE_RECORD.size : record.end]
        return Message(topic, log_time, publish_time, data, sequence)

    # Attachments and metadata

    def attachments(self) -> Iterator[memoryview]:
        """The attachments: the content of each record. Damaged ones are skipped and reported."""
        for position in self._attachments:
            try:
                record = self._record(position)
                content = self._file.view[record.begin : record.end]
                members = Cursor(content, 16, len(content))
                members.text(), members.text()
                members.bytes(members.number(U64))
                crc_begin = members.position
                crc = members.number(U32)
                if record.operation != ATTACHMENT or (crc and zlib.crc32(content[:crc_begin]) != crc):
                    raise DamagedError("the check sum is wrong")
                yield content
            except DamagedError as error:
                self._report(position, f"attachment: {error} (it is skipped)")

    def metadata(self) -> Iterator[tuple[str, dict[str, str]]]:
        """Name and content of the metadata records. Damaged ones are skipped and reported."""
        for position in self._metadata:
            try:
                record = self._record(position)
                if record.operation != METADATA:
                    raise DamagedError("is not metadata")
                members = Cursor(self._file.view, record.begin, record.end)
                yield members.text(), members.map()
            except DamagedError as error:
                self._report(position, f"metadata: {error} (it is skipped)")

    def close(self) -> None:
        """See `Bag.close`."""
        self._file.close()
