# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Compression of chunks, messages and files, with bounded memory."""

from __future__ import annotations

import bz2
import sys
from collections.abc import Callable
from typing import Any, BinaryIO

from flagstone._optional import needs
from flagstone.bags.container import Compression, Data
from flagstone.bags.reports import DamagedError

MAX_CHUNK = 1 << 30
"""Bytes of a chunk or message after decompression."""
_ZSTD_LEVEL = 1  # as in rosbag2 and in the C++ library of MCAP
_BLOCK_SIZE = 4 << 20  # bytes of a file that are processed at a time
_MIN_LIMIT = 64 << 20  # bytes that any input may expand to
_MAX_RATIO = 1024  # above _MIN_LIMIT


def zstd() -> Any:
    """The module for Zstandard: part of Python since 3.14."""
    return needs("compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd", "bag")


def _lz4() -> Any:
    return needs("lz4.frame", "bag")


def _decompressor(compression: Compression) -> Any:
    if compression == "bz2":
        return bz2.BZ2Decompressor()
    return _lz4().LZ4FrameDecompressor() if compression == "lz4" else zstd().ZstdDecompressor()


def _errors(compression: Compression) -> tuple[type[Exception], ...]:
    """The exceptions that decompressors raise for damaged data."""
    errors: tuple[type[Exception], ...] = (OSError, EOFError, ValueError, RuntimeError, MemoryError)
    return (*errors, zstd().ZstdError) if compression == "zstd" else errors


def compressor(compression: Compression) -> Callable[[bytes], bytes]:
    """The function that compresses a chunk."""
    if compression == "bz2":
        return bz2.compress
    if compression == "lz4":
        # The frame options that ROS 1 can read: independent blocks, without the content size.
        compress, block_size = _lz4().compress, _lz4().BLOCKSIZE_MAX1MB
        return lambda data: bytes(
            compress(data, 0, block_size=block_size, block_linked=False, content_checksum=True, store_size=False)
        )
    if compression == "zstd":
        fast = zstd().compress
        return lambda data: bytes(fast(data, _ZSTD_LEVEL))
    return lambda data: data


def decompressed(compression: Compression, data: Data, size: int | None, *, is_partial: bool = False) -> Data:
    """Decompresses a chunk or message.

    Args:
        compression: Format of the data.
        data: The compressed data.
        size: Expected size in bytes, if known.
        is_partial: Whether the end of the data is missing; the beginning is then decompressed.

    Raises:
        DamagedError: The data are damaged, or do not have this size.
    """
    if compression == "none":
        if size is not None and size != len(data) and not is_partial:
            raise DamagedError(f"has {len(data)} bytes (expected {size})")
        return data
    limit = min(MAX_CHUNK, max(_MIN_LIMIT, _MAX_RATIO * len(data)))
    if size is not None:
        if size > limit:
            raise DamagedError(f"{len(data)} bytes would expand to {size} (expected at most {limit})")
        limit = size
    decompressor = _decompressor(compression)
    try:
        # One byte more than expected, to find data that expand to more.
        result: bytes = decompressor.decompress(data, limit + 1)
    except _errors(compression) as error:
        raise DamagedError(f"cannot be decompressed: {error}") from None
    if len(result) > limit:
        raise DamagedError(f"expands to more than {limit} bytes")
    if not is_partial:
        if not decompressor.eof:
            raise DamagedError("compressed data end too early")
        if size is not None and len(result) != size:
            raise DamagedError(f"expands to {len(result)} bytes (expected {size})")
    return result


def compress_file(source: BinaryIO, target: BinaryIO) -> None:
    """Compresses a file with Zstandard."""
    stream = zstd().ZstdCompressor(_ZSTD_LEVEL)
    while block := source.read(_BLOCK_SIZE):
        target.write(stream.compress(block))
    target.write(stream.flush())


def decompress_file(source: BinaryIO, target: BinaryIO) -> str:
    """Decompresses a file in the format of Zstandard.

    Returns:
        The problem if the file is damaged or truncated; the data before it are written. Otherwise "".
    """
    block = source.read(_BLOCK_SIZE)
    while block:
        stream = zstd().ZstdDecompressor()
        while not stream.eof:
            if stream.needs_input and not block:
                return "is truncated"
            try:
                result = stream.decompress(block, _BLOCK_SIZE)
            except _errors("zstd") as error:
                return f"is damaged: {error}"
            target.write(result)
            block = source.read(_BLOCK_SIZE) if stream.needs_input else b""
        block = stream.unused_data or source.read(_BLOCK_SIZE)
    return ""
