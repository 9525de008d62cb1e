# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Writing MCAP files. The format is described in `flagstone.bags.mcap`."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from pathlib import Path

from flagstone.bags.chunk import ChunkPacker, NewChunk, PackedChunk
from flagstone.bags.container import Compression, Data, Topic
from flagstone.bags.mcap import (
    ATTACHMENT,
    ATTACHMENT_INDEX,
    CHANNEL,
    CHUNK,
    CHUNK_HEADER,
    CHUNK_INDEX,
    COMPRESSIONS,
    DATA_END,
    FOOTER,
    FOOTER_CONTENT,
    HEADER,
    MAGIC,
    MESSAGE,
    MESSAGE_INDEX,
    MESSAGE_RECORD,
    METADATA,
    METADATA_INDEX,
    RECORD,
    SCHEMA,
    STATISTICS,
    SUMMARY_OFFSET,
    U16,
    U32,
    U64,
    Cursor,
    McapFile,
)
from flagstone.bags.output_file import OutputFile

CHUNK_SIZE = 1 << 20
"""Bytes after which a chunk ends. Copied messages end a chunk with that of the input."""
_SMALL = 8192  # bytes of a message that is joined with its header
_COMPRESSION_NAMES = {compression: name for name, compression in COMPRESSIONS.items()}
_INDEX_ENTRY = struct.Struct("<QQ")  # log time, offset in the chunk
_MAX_TIME = 2**64
_MAX_ID = 2**16 - 1


class McapStorage:
    """One MCAP file that is being written."""

    def __init__(self, path: Path, like: McapFile | None, compression: Compression) -> None:
        """Creates the file.

        Args:
            path: The file.
            like: The file whose profile, attachments, metadata and kind of chunks the new file gets; None for those of
                rosbag2.
            compression: Compression of the chunks.
        """
        self._compression = compression
        self._has_chunks = like is None or like.has_chunks or not like.message_count
        self._packer = ChunkPacker(compression, has_crcs=self._has_chunks and (like is None or like.has_crcs))
        self._schemas: dict[tuple[str, str, str], int] = {}
        self._channels: dict[int, bytes] = {}
        self._schema_of: dict[int, int] = {}
        self._schema_records: dict[int, bytes] = {}
        self._counts: dict[int, int] = {}
        self._sequences: dict[int, int] = {}
        self._declared: set[int] = set()
        self._declared_schemas: set[int] = set()
        self._start, self._end = _MAX_TIME, 0
        self._chunk_indexes: list[bytes] = []
        self._attachment_indexes: list[bytes] = []
        self._metadata_indexes: list[bytes] = []
        self._file = OutputFile(path)
        profile, library = (like.profile, like.library) if like is not None else ("ros2", "flagstone")
        self._write(MAGIC + _record(HEADER, _text(profile) + _text(library)))
        for content in like.attachments() if like is not None else ():
            self._write_attachment(content)
        self._chunk = NewChunk(-1)

    def add_topic(self, topic: Topic) -> None:
        """Declares a channel with the number of the topic."""
        if not 0 <= topic.id <= _MAX_ID:
            raise ValueError(f"{topic.name}: number {topic.id} is out of range (expected 0 to {_MAX_ID})")
        schema = (topic.type, topic.definition_format, topic.definition)
        id = 0
        if any(schema):
            id = self._schemas.setdefault(schema, len(self._schemas) + 1)
            content = U16.pack(id) + _text(topic.type) + _text(topic.definition_format) + _text(topic.definition)
            self._schema_records[id] = _record(SCHEMA, content)
        self._schema_of[topic.id] = id
        content = U16.pack(topic.id) + U16.pack(id) + _text(topic.name) + _text(topic.encoding) + _map(topic.metadata)
        self._channels[topic.id] = _record(CHANNEL, content)
        self._counts[topic.id] = 0

    def add(
        self, topic: Topic, log_time: int, publish_time: int, data: Data, sequence: int | None = None, chunk: int = -1
    ) -> None:
        """Writes a message. `chunk` identifies the chunk of the input, whose end ends the chunk."""
        id = topic.id
        if not (0 <= log_time < _MAX_TIME and 0 <= publish_time < _MAX_TIME):
            raise ValueError(f"{topic.name}: time {log_time} is out of range (expected 0 to {_MAX_TIME - 1})")
        if chunk >= 0 and chunk != self._chunk.source:
            if self._chunk.source >= 0:
                self._end_chunk()
            self._chunk.source = chunk
        if id not in self._declared:
            self._declare(id)
        if sequence is None:
            sequence = self._sequences.get(id, 0)
        self._sequences[id] = (sequence + 1) & 0xFFFFFFFF
        self._counts[id] += 1
        self._start, self._end = min(self._start, log_time), max(self._end, log_time)
        if self._has_chunks:
            self._chunk.add_to_index(id, log_time, _INDEX_ENTRY.pack(log_time, self._chunk.size))
        header = MESSAGE_RECORD.pack(MESSAGE, len(data) + 22, id, sequence, log_time, publish_time)
        pieces: list[Data] = [header + data] if len(data) < _SMALL else [header, data]
        self._append(pieces, len(header) + len(data))
        if self._chunk.is_full(CHUNK_SIZE):
            self._end_chunk()

    def _declare(self, id: int) -> None:
        self._declared.add(id)
        records = self._channels[id]
        schema = self._schema_of[id]
        if schema and schema not in self._declared_schemas:
            self._declared_schemas.add(schema)
            records = self._schema_records[schema] + records
        self._append([records], len(records))

    def _append(self, pieces: list[Data], size: int) -> None:
        (self._chunk.append if self._has_chunks else self._file.write)(pieces, size)

    def _end_chunk(self) -> None:
        chunk, self._chunk = self._chunk, NewChunk(self._chunk.source)
        if chunk.index:
            for packed in self._packer.put(chunk):
                self._write_chunk(packed)

    def _write_chunk(self, packed: PackedChunk) -> None:
        chunk = packed.chunk
        name = _COMPRESSION_NAMES[self._compression].encode()
        header = CHUNK_HEADER.pack(chunk.start, chunk.end, chunk.size, packed.crc, len(name)) + name
        header += U64.pack(packed.size)
        position, length = self._file.position, RECORD.size + len(header) + packed.size
        self._file.write([RECORD.pack(CHUNK, length - RECORD.size) + header, *packed.pieces], length)
        offsets = bytearray()
        for id, entries in chunk.index.items():
            offsets += U16.pack(id) + U64.pack(self._file.position)
            self._write(_record(MESSAGE_INDEX, U16.pack(id) + _sized(bytes(entries))))
        index_length = self._file.position - position - length
        members = (
            struct.pack("<QQQQ", chunk.start, chunk.end, position, length),
            _sized(bytes(offsets)),
            U64.pack(index_length),
            _sized(name),
            U64.pack(packed.size),
            U64.pack(chunk.size),
        )
        self._chunk_indexes.append(b"".join(members))

    # The rest of the file

    def _write(self, data: Data) -> None:
        self._file.write([data], len(data))

    def _write_attachment(self, content: memoryview) -> None:
        members = Cursor(content, 0, len(content))
        times = bytes(members.bytes(16))
        name, media_type = members.text(), members.text()
        size = members.number(U64)
        position = self._file.position
        header = RECORD.pack(ATTACHMENT, len(content))
        self._file.write([header, content], len(header) + len(content))
        self._attachment_indexes.append(
            struct.pack("<QQ", position, len(header) + len(content))
            + times
            + U64.pack(size)
            + _text(name)
            + _text(media_type)
        )

    def close(self, metadata: list[tuple[str, dict[str, str]]]) -> None:
        """Writes metadata records, the summary and the footer, and closes the file."""
        self._end_chunk()
        for packed in self._packer.rest():
            self._write_chunk(packed)
        self._packer.close()
        for id in self._channels:
            if id not in self._declared:
                self._has_chunks = False
                self._declare(id)
        for name, content in metadata:
            record = _record(METADATA, _text(name) + _map(content))
            self._metadata_indexes.append(struct.pack("<QQ", self._file.position, len(record)) + _text(name))
            self._write(record)
        self._write(_record(DATA_END, U32.pack(0)))
        self._write_summary()
        self._file.flush()
        self._file.close()

    def discard(self) -> None:
        """Closes the file as it is."""
        self._packer.close()
        self._file.close()

    def _write_summary(self) -> None:
        begin = self._file.position
        count = sum(self._counts.values())
        start, end = (self._start, self._end) if count else (0, 0)
        statistics = struct.pack(
            "<QHIIIIQQ",
            count,
            len(self._schema_records),
            len(self._channels),
            len(self._attachment_indexes),
            len(self._metadata_indexes),
            len(self._chunk_indexes),
            start,
            end,
        ) + _sized(b"".join(U16.pack(id) + U64.pack(number) for id, number in self._counts.items()))
        groups = {
            SCHEMA: list(self._schema_records.values()),
            CHANNEL: list(self._channels.values()),
            STATISTICS: [_record(STATISTICS, statistics)],
            CHUNK_INDEX: [_record(CHUNK_INDEX, content) for content in self._chunk_indexes],
            ATTACHMENT_INDEX: [_record(ATTACHMENT_INDEX, content) for content in self._attachment_indexes],
            METADATA_INDEX: [_record(METADATA_INDEX, content) for content in self._metadata_indexes],
        }
        summary = bytearray()
        offsets = bytearray()
        for operation, records in groups.items():
            if records:
                group = b"".join(records)
                offsets += _record(SUMMARY_OFFSET, struct.pack("<BQQ", operation, begin + len(summary), len(group)))
                summary += group
        offsets_begin = begin + len(summary)
        summary += offsets
        summary += RECORD.pack(FOOTER, FOOTER_CONTENT.size)
        summary += struct.pack("<QQ", begin, offsets_begin)
        summary += U32.pack(zlib.crc32(summary))
        self._write(bytes(summary) + MAGIC)


def _record(operation: int, content: bytes) -> bytes:
    return RECORD.pack(operation, len(content)) + content


def _sized(data: bytes) -> bytes:
    return U32.pack(len(data)) + data


def _text(text: str) -> bytes:
    return _sized(text.encode(errors="surrogateescape"))


def _map(content: Mapping[str, str]) -> bytes:
    return _sized(b"".join(_text(key) + _text(value) for key, value in content.items()))
