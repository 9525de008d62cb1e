# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Chunks that are being written."""

from __future__ import annotations

import zlib
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import NamedTuple

from flagstone.bags.compression import compressor
from flagstone.bags.container import Compression, Data

MAX_SIZE = 1 << 29
"""Bytes after which any chunk ends; the formats allow up to 2^32 - 1."""

_THREADS = 2
_MAX_WAITING = 3  # chunks, which bounds the memory


@dataclass(slots=True)
class NewChunk:
    """Records that are written together. Their data are not copied."""

    source: int
    """The chunk of the input that is being copied; -1 if none is."""
    pieces: list[Data] = field(default_factory=list)
    size: int = 0
    index: dict[int, bytearray] = field(default_factory=dict)
    """Entries of the index by topic."""
    start: int = 2**64
    """First log time."""
    end: int = 0
    """Last log time."""

    def append(self, pieces: list[Data], size: int) -> None:
        """Adds a record of `size` bytes."""
        self.pieces += pieces
        self.size += size

    def add_to_index(self, topic: int, log_time: int, entry: bytes) -> None:
        """Adds a message to the index."""
        entries = self.index.get(topic)
        if entries is None:
            entries = self.index[topic] = bytearray()
        entries += entry
        if log_time < self.start:
            self.start = log_time
        if log_time > self.end:
            self.end = log_time

    def is_full(self, usual_size: int) -> bool:
        """Whether the chunk must end. Chunks of the input have any size, other chunks the usual one."""
        return self.size >= (usual_size if self.source < 0 else MAX_SIZE)


class PackedChunk(NamedTuple):
    """A chunk that can be written to the file."""

    chunk: NewChunk
    pieces: list[Data]
    """The records, compressed if the bag is."""
    size: int
    """Bytes of `pieces`."""
    crc: int
    """Check sum of the records before compression; 0 if the bag has none."""


class ChunkPacker:
    """Compresses chunks and computes their check sums, in two threads, and returns the chunks in their order."""

    def __init__(self, compression: Compression, *, has_crcs: bool) -> None:
        """Starts no thread if nothing is to compute."""
        self._is_compressed = compression != "none"
        self._compress = compressor(compression)
        self._has_crcs = has_crcs
        self._packing: deque[Future[PackedChunk]] = deque()
        self._threads = ThreadPoolExecutor(_THREADS) if self._is_compressed or has_crcs else None

    def put(self, chunk: NewChunk) -> Iterator[PackedChunk]:
        """Adds a chunk, and returns those that must be written first. The chunk must not change any more."""
        if self._threads is None:
            yield self._pack(chunk)
            return
        self._packing.append(self._threads.submit(self._pack, chunk))
        while len(self._packing) > _MAX_WAITING:
            yield self._packing.popleft().result()

    def rest(self) -> Iterator[PackedChunk]:
        """Waits for the chunks that were added and not yet returned."""
        while self._packing:
            yield self._packing.popleft().result()

    def close(self) -> None:
        """Stops the threads. Chunks that were not returned are lost."""
        if self._threads is not None:
            self._threads.shutdown(cancel_futures=True)

    def _pack(self, chunk: NewChunk) -> PackedChunk:
        pieces, size, crc = chunk.pieces, chunk.size, 0
        if self._has_crcs:
            for piece in pieces:
                crc = zlib.crc32(piece, crc)
        if self._is_compressed:
            pieces = [self._compress(b"".join(pieces))]
            size = len(pieces[0])
        return PackedChunk(chunk, pieces, size, crc)
