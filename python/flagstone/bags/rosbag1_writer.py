# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Writing bags of ROS 1, version 2.0. The format is described in `flagstone.bags.rosbag1`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from flagstone.bags.chunk import ChunkPacker, NewChunk, PackedChunk
from flagstone.bags.container import BagWriter, Data, Message, Topic
from flagstone.bags.definitions import new_topic
from flagstone.bags.output_file import OutputFile, Staging
from flagstone.bags.rosbag1 import (
    BAG_HEADER,
    CHUNK,
    CHUNK_INFO,
    CONNECTION,
    CONNECTION_FIELD,
    INDEX,
    MAGIC,
    MESSAGE_HEADER_SIZE,
    OPERATION_FIELD,
    PAIR,
    SORTED_MESSAGE,
    TIME,
    TIME_FIELD,
    U32,
    U64,
    Rosbag1,
    type_of_ros1,
)

CHUNK_SIZE = 768 << 10
"""Bytes after which a chunk ends, as in `rosbag`. Copied messages end a chunk with that of the input."""
MAX_MESSAGE = 1 << 29
"""Bytes of a message that a chunk can contain."""
_MAX_SECONDS = 2**32
_INDEX_ENTRY_SIZE = 12
_SMALL = 8192  # bytes of a message that is joined with its header
_BAG_HEADER_SIZE = 4096  # bytes of the record, so that it can be replaced


class Rosbag1Writer(BagWriter):
    """A bag of ROS 1."""

    def __init__(self, path: Path, like: Rosbag1) -> None:
        """Creates the temporary file and declares the topics of `like`."""
        super().__init__(path, "rosbag1")
        self._like = like
        self._is_closed = False
        self._compression = like.compression
        self._packer = ChunkPacker(like.compression, has_crcs=False)
        self._topics = {topic.id: topic for topic in like.topics}
        self._connections = {topic.id: like.connections[topic.id] for topic in like.topics}
        self._staging = Staging(path, is_directory=False)
        try:
            self._file = OutputFile(self._staging.path)
            self._declared: set[int] = set()
            self._infos: list[tuple[int, int, int, dict[int, int]]] = []
            self._chunk = NewChunk(-1)
            self._write(MAGIC + bytes(_BAG_HEADER_SIZE))
        except BaseException:
            self.discard()
            raise

    def add_topic(
        self,
        name: str,
        type: str,
        definition: str | None = None,
        *,
        like: Topic | None = None,
    ) -> Topic:
        """See `BagWriter.add_topic`."""
        topic = new_topic(self.path, self._topics, name, type, definition, like, is_ros1=True)
        header = {
            "topic": name,
            "type": type_of_ros1(type),
            "md5sum": topic.type_hash,
            "message_definition": topic.definition,
        }
        if topic.caller_id:
            header["callerid"] = topic.caller_id
        if topic.is_latched:
            header["latching"] = "1"
        topic = replace(topic, metadata=header)
        fields = {key: value.encode(errors="surrogateescape") for key, value in header.items()}
        data = _header(fields)
        self._connections[topic.id] = _record(
            {"conn": U32.pack(topic.id), "op": bytes([CONNECTION]), "topic": fields["topic"]}, data
        )
        self._topics[topic.id] = topic
        return topic

    def copy(self, message: Message) -> None:
        """See `BagWriter.copy`."""
        topic = message.topic
        if self._topics.get(topic.id) is not topic:
            raise ValueError(f"{self.path}: a message of topic {topic.name} is not from {self._like.path}")
        if message.chunk != self._chunk.source:
            if self._chunk.source >= 0:
                self._end_chunk()
            self._chunk.source = message.chunk
        self._add(topic.id, message.log_time, message.data)

    def write(self, topic: Topic, log_time: int, data: Data, *, publish_time: int | None = None) -> None:
        """See `BagWriter.write`."""
        if self._topics.get(topic.id) is not topic:
            raise ValueError(f"{self.path}: topic {topic.name} is not of this bag (create it with add_topic)")
        self._add(topic.id, log_time, data)

    def _add(self, id: int, time: int, data: Data) -> None:
        if self._is_closed:
            raise ValueError(f"{self.path}: the bag is finished or discarded")
        seconds, nanoseconds = divmod(time, 1_000_000_000)
        if not 0 <= seconds < _MAX_SECONDS:
            raise ValueError(f"{self.path}: time {time} is out of range (expected 0 to {_MAX_SECONDS * 10**9 - 1})")
        if len(data) > MAX_MESSAGE:
            raise ValueError(f"{self.path}: a message has {len(data)} bytes (expected at most {MAX_MESSAGE})")
        if id not in self._declared:
            self._declared.add(id)
            connection = self._connections[id]
            self._chunk.append([connection], len(connection))
        stamp = TIME.pack(seconds, nanoseconds)
        self._chunk.add_to_index(id, time, stamp + U32.pack(self._chunk.size))
        header = SORTED_MESSAGE.pack(
            MESSAGE_HEADER_SIZE, CONNECTION_FIELD, id, OPERATION_FIELD + TIME_FIELD, seconds, nanoseconds, len(data)
        )
        pieces: list[Data] = [header + data] if len(data) < _SMALL else [header, data]
        self._chunk.append(pieces, len(header) + len(data))
        if self._chunk.is_full(CHUNK_SIZE):
            self._end_chunk()

    def _end_chunk(self) -> None:
        chunk, self._chunk = self._chunk, NewChunk(self._chunk.source)
        if chunk.index:
            for packed in self._packer.put(chunk):
                self._write_chunk(packed)

    def _write_chunk(self, packed: PackedChunk) -> None:
        chunk = packed.chunk
        fields = {
            "compression": self._compression.encode(),
            "op": bytes([CHUNK]),
            "size": U32.pack(chunk.size),
        }
        counts = {id: len(index) // _INDEX_ENTRY_SIZE for id, index in chunk.index.items()}
        self._infos.append((self._file.position, chunk.start, chunk.end, counts))
        header = _header(fields)
        begin = U32.pack(len(header)) + header + U32.pack(packed.size)
        self._file.write([begin, *packed.pieces], len(begin) + packed.size)
        for id, index in chunk.index.items():
            fields = {"conn": U32.pack(id), "count": U32.pack(counts[id]), "op": bytes([INDEX]), "ver": U32.pack(1)}
            self._write(_record(fields, bytes(index)))

    def _write(self, data: bytes) -> None:
        self._file.write([data], len(data))

    def finish(self) -> None:
        """See `BagWriter.finish`."""
        try:
            self._end_chunk()
            for packed in self._packer.rest():
                self._write_chunk(packed)
            index = self._file.position
            for _, record in sorted(self._connections.items()):
                self._write(record)
            for position, start, end, counts in self._infos:
                fields = {
                    "chunk_pos": U64.pack(position),
                    "count": U32.pack(len(counts)),
                    "end_time": _time(end),
                    "op": bytes([CHUNK_INFO]),
                    "start_time": _time(start),
                    "ver": U32.pack(1),
                }
                self._write(_record(fields, b"".join(PAIR.pack(*pair) for pair in counts.items())))
            header = {
                "chunk_count": U32.pack(len(self._infos)),
                "conn_count": U32.pack(len(self._connections)),
                "index_pos": U64.pack(index),
                "op": bytes([BAG_HEADER]),
            }
            size = len(_header(header))
            padding = b" " * (_BAG_HEADER_SIZE - size - 8)
            self._file.overwrite(len(MAGIC), _record(header, padding))
            self._file.close()
            self._packer.close()
            self._staging.finish()
            self._is_closed = True
        except BaseException:
            self.discard()
            raise

    def discard(self) -> None:
        """See `BagWriter.discard`."""
        self._is_closed = True
        self._packer.close()
        if hasattr(self, "_file"):
            self._file.close()
        self._staging.discard()


def _header(fields: dict[str, bytes]) -> bytes:
    parts = []
    for name, value in fields.items():
        field = name.encode(errors="surrogateescape") + b"=" + value
        parts += [U32.pack(len(field)), field]
    return b"".join(parts)


def _record(fields: dict[str, bytes], data: bytes) -> bytes:
    header = _header(fields)
    return b"".join((U32.pack(len(header)), header, U32.pack(len(data)), data))


def _time(nanoseconds: int) -> bytes:
    return TIME.pack(*divmod(nanoseconds, 10**9))
