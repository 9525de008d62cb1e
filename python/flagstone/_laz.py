# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Whether the chunks of a LAZ file can be what it says, asked before a decompressor allocates on its word."""

from __future__ import annotations

from typing import BinaryIO

from flagstone._optional import needs

_without_chunks = 1  # LASzip before 2011
_largest_chunk = 10_000_000  # points; of files that have fewer. Writers take 50,000


class BadFileError(Exception):
    """What is wrong with a file, without its name."""


def check_chunks(file: BinaryIO, size: int, begin: int, count: int, row: int, parameters: bytes) -> None:
    """Compares chunk table, parameters and file size.

    Args:
        file: The file.
        size: Its bytes.
        begin: Where the points begin.
        count: How many there are.
        row: Bytes of a point.
        parameters: Those of LASzip, from its record.

    Raises:
        BadFileError: They contradict each other.
    """
    lazrs = needs("lazrs", "las")
    kind = lazrs.LazVlr(parameters)
    if kind.item_size() != row:
        raise BadFileError(f"has points of {row} bytes, but was compressed with {kind.item_size()}: it is damaged")
    if count == 0 or int.from_bytes(parameters[:2], "little") == _without_chunks:
        return
    is_free = kind.uses_variable_size_chunks()
    if not is_free and kind.chunk_size() > max(count, _largest_chunk):
        raise BadFileError(f"says that a chunk has {kind.chunk_size():,} points, of {count:,}: it is damaged")

    table = _begin_of_table(file, size, begin)
    compressed = table - begin - 8  # bytes of all chunks
    if not 0 <= compressed <= size - begin - 16:
        raise BadFileError(f"says that its chunk table is at byte {table:,} of {size:,}: it is cut off or damaged")
    file.seek(table + 4)
    chunks = int.from_bytes(file.read(4), "little")
    if chunks > compressed:
        raise BadFileError(f"says that it has {chunks:,} chunks in {compressed:,} bytes: it is damaged")
    file.seek(begin)
    entries = lazrs.read_chunk_table(file, kind)
    points = sum(points for points, _ in entries) if is_free else chunks * kind.chunk_size()
    if sum(used for _, used in entries) > compressed or points < count or (is_free and points > count):
        raise BadFileError("has a chunk table that does not fit its points: it is damaged")


# Writers that could not seek put it at the end of the file.
def _begin_of_table(file: BinaryIO, size: int, begin: int) -> int:
    file.seek(begin)
    table = int.from_bytes(file.read(8), "little", signed=True)
    if table == -1:
        file.seek(size - 8)
        table = int.from_bytes(file.read(8), "little", signed=True)
    return table
