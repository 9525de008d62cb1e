# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Copies of LAS and LAZ files with something changed in the points, and all the rest as it was."""

from __future__ import annotations

import os
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from flagstone import _copc
from flagstone._las import points_at_once
from flagstone._laz import BadFileError
from flagstone._optional import needs

Rows = npt.NDArray[np.uint8]  # (points, bytes a point)
Change = Callable[[Rows, int], None]  # some rows, in place, and the number of the first

# Bytes of the public header block that say where things behind the points begin.
_start_of_waveforms = slice(227, 235)
_start_of_extended_records = slice(235, 243)


@dataclass(frozen=True)
class Layout:
    """Where the points of a file are."""

    begin: int  # of the points
    count: int
    row: int  # bytes a point
    compressed_as: bytes | None  # the parameters of LASzip
    behind: int  # begin of what stands behind compressed points, 0 where nothing does
    has_index: bool  # of COPC

    @staticmethod
    def of(reader: Any, size: int) -> Layout:
        """That of a file of so many bytes that laspy reads.

        Raises:
            BadFileError: No copy could be true to it.
        """
        header = reader.header
        users = {record.user_id for record in header.vlrs}
        if "lascompatible" in users:
            raise BadFileError("is LAS 1.4 in compatibility mode, with classes in two places; convert it to plain LAZ")
        starts = (header.start_of_waveform_data_packet_record, header.start_of_first_evlr)
        behind = min((start for start in starts if start > header.offset_to_point_data), default=0)
        if behind > size:
            raise BadFileError(f"says that records begin at byte {behind:,} of its {size:,}: it is cut off or damaged")
        return Layout(
            begin=header.offset_to_point_data,
            count=header.point_count,
            row=header.point_format.size,
            compressed_as=_compression(header),
            behind=behind,
            has_index="copc" in users,
        )


def copy_points(file: BinaryIO, copy: BinaryIO, layout: Layout, change: Change) -> None:
    """Copies the file; `change` sees all points in their order, some at a time.

    Raises:
        BadFileError: It would not come out as it was.
    """
    if layout.compressed_as is None or layout.count == 0:
        _copy_uncompressed(file, copy, layout, change)
    else:
        _copy_compressed(file, copy, layout, layout.compressed_as, change)


def _compression(header: Any) -> bytes | None:
    if not header.are_points_compressed:
        return None
    parameters = bytes(header.vlrs.get("LasZipVlr")[0].record_data)
    if int.from_bytes(parameters[:2], "little") not in (2, 3):
        raise BadFileError("was compressed by a LASzip of before 2011, without chunks; compress it anew")
    return parameters


def _copy_uncompressed(file: BinaryIO, copy: BinaryIO, layout: Layout, change: Change) -> None:
    copy.write(file.read(layout.begin))
    for first in range(0, layout.count, points_at_once):
        count = min(points_at_once, layout.count - first)
        rows = np.frombuffer(bytearray(file.read(count * layout.row)), np.uint8).reshape(-1, layout.row)
        change(rows, first)
        copy.write(rows.data)
    _copy_rest(file, copy)


def _copy_compressed(file: BinaryIO, copy: BinaryIO, layout: Layout, parameters: bytes, change: Change) -> None:
    lazrs = needs("lazrs", "las")
    head = bytearray(file.read(layout.begin))
    copy.write(head)
    kind = lazrs.LazVlr(parameters)
    has_free_chunks = kind.uses_variable_size_chunks()
    compressor = (lazrs.LasZipCompressor if has_free_chunks else lazrs.ParLasZipCompressor)(copy, kind)
    checksum = 0
    first = 0
    for rows, begins_chunk in _decompressed(file, layout, parameters):
        if has_free_chunks and begins_chunk and first > 0:
            compressor.finish_current_chunk()
        change(rows, first)
        first += len(rows)
        checksum = zlib.crc32(rows.data, checksum)
        compressor.compress_many(rows.reshape(-1))
    compressor.done()

    shift = copy.seek(0, os.SEEK_END) - layout.behind
    if layout.behind > 0:
        for start in (_start_of_waveforms, _start_of_extended_records):
            _move(head, start, layout, shift)
        file.seek(layout.behind)
        _copy_rest(file, copy)
    if layout.has_index:
        _copc.move_index(head, copy, _chunks(file, layout, kind), _chunks(copy, layout, kind), shift)
    copy.seek(0)
    copy.write(head)
    _check_copy(copy, layout, parameters, checksum)


# Points and bytes of each chunk.
def _chunks(file: BinaryIO, layout: Layout, kind: Any) -> list[tuple[int, int]]:
    file.flush()
    file.seek(layout.begin)
    chunks: list[tuple[int, int]] = needs("lazrs", "las").read_chunk_table(file, kind)
    return chunks


# Rows of points, and whether a chunk of the compressed file begins with them.
def _decompressed(file: BinaryIO, layout: Layout, parameters: bytes) -> Iterator[tuple[Rows, bool]]:
    lazrs = needs("lazrs", "las")
    kind = lazrs.LazVlr(parameters)
    sizes = [layout.count]
    if kind.uses_variable_size_chunks():
        sizes = [points for points, _ in _chunks(file, layout, kind)]
    file.seek(layout.begin)
    decompressor = lazrs.ParLasZipDecompressor(file, parameters)
    for size in sizes:
        for first in range(0, size, points_at_once):
            count = min(points_at_once, size - first)
            points = bytearray(count * layout.row)
            decompressor.decompress_many(points)
            yield np.frombuffer(points, np.uint8).reshape(-1, layout.row), first == 0


def _move(head: bytearray, start: slice, layout: Layout, shift: int) -> None:
    if start.stop > int.from_bytes(head[94:96], "little"):  # header of a version that did not know it
        return
    before = int.from_bytes(head[start], "little")
    if before >= layout.behind:
        head[start] = (before + shift).to_bytes(8, "little")


# What a compressor made wrong would be lost for good.
def _check_copy(copy: BinaryIO, layout: Layout, parameters: bytes, checksum: int) -> None:
    copy.flush()
    again = 0
    for rows, _ in _decompressed(copy, layout, parameters):
        again = zlib.crc32(rows.data, again)
    if again != checksum:
        raise BadFileError("cannot be compressed by lazrs without loss; uncompress it to LAS, and give that")


def _copy_rest(file: BinaryIO, copy: BinaryIO) -> None:
    while block := file.read(1 << 24):
        copy.write(block)
