# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Sets the classification of a LAS or LAZ file and keeps everything else unchanged."""

from __future__ import annotations

import os
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from flagstone._atomic_file import atomic_write
from flagstone._las import DEFAULT_OVERWRITE_CLASSES, BadFileError, checked_labels, class_table, opened, points_at_once
from flagstone._optional import needs
from flagstone._progress import Progress


def classify_las(
    source: str | os.PathLike[str],
    destination: str | os.PathLike[str],
    labels: npt.ArrayLike,
    *,
    overwrite_classes: Iterable[int] = DEFAULT_OVERWRITE_CLASSES,
) -> dict[int, int]:
    """Copies a LAS or LAZ file and sets the classification of its points from labels.

    Only points with a class in `overwrite_classes` are changed:

    - Points labelled `ground` get class 2 (ground).
    - Points labelled `noise` get class 7 (low point).
    - Points labelled `nonground` get class 1 (unclassified) if they had class 0 (never classified), 2 or 7.
    - Points labelled `out_of_range` or `invalid` keep their class.

    The rest of the file is bit-identical: the header, variable length records, all other dimensions, the flags
    stored with the class, and all data after the points. A LAZ file is compressed again with the same parameters and
    verified before it replaces the destination. Offsets of the data after the points and the index of a COPC file are
    updated. Memory use is limited to the labels and one million points.

    Args:
        source: LAS or LAZ file, version 1.0 to 1.4, point formats 0 to 10. In point formats 0 to 5 the class has 5
            bits.
        destination: File to write, atomically. It must have the extension of the source and must not be the source.
        labels: (N,) codes of `flagstone.Label`, one per point in the order of the file.
        overwrite_classes: Classes that may be changed, 0 to 255. The default keeps all classes that mean more than
            ground or not ground, such as vegetation (3 to 5), buildings (6), water (9), overlap (12), bridges (17) and
            high noise (18). `range(256)` allows all.

    Returns:
        Number of points per class in the new file.

    Raises:
        FileNotFoundError: The source does not exist.
        OSError: The destination cannot be written.
        TypeError: The labels are not integers.
        ValueError: The source is damaged or cannot be copied without loss; the number of labels differs from the number
            of points; a label is not 0 to 4; the extensions differ; the destination is the source.
        ImportError: laspy is not installed.
    """
    codes = checked_labels(labels)
    table = class_table(overwrite_classes)
    extension = Path(source).suffix.lower()
    if Path(destination).suffix.lower() != extension:
        raise ValueError(
            f"destination: {os.fspath(destination)} has another extension than the source (expected {extension})"
        )
    if Path(destination).exists() and Path(destination).samefile(source):
        raise ValueError(f"destination: {os.fspath(destination)} is the source (choose another file)")
    counts = np.zeros(256, np.int64)
    with atomic_write(destination) as copy, opened(source) as reader, Path(source).open("rb") as file:
        layout = Layout.of(reader, os.fstat(file.fileno()).st_size)
        class_byte, class_bits = (16, 0xFF) if reader.header.point_format.id >= 6 else (15, 0x1F)
        if len(codes) != layout.count:
            raise BadFileError(
                f"{len(codes):,} labels do not match {layout.count:,} points (expected one label per point)"
            )
        with Progress(layout.count, "points") as progress:

            def classify(rows: Rows, first: int) -> None:
                packed = rows[:, class_byte]
                after = table[codes[first : first + len(rows)], packed & class_bits]
                rows[:, class_byte] = (packed & ~np.uint8(class_bits)) | after
                counts[:] += np.bincount(after, minlength=256)
                progress.add(len(rows))

            copy_points(file, copy, layout, classify)
    return {code: int(count) for code, count in enumerate(counts) if count > 0}


Rows = npt.NDArray[np.uint8]  # (points, bytes per point)
Change = Callable[[Rows, int], None]  # changes rows in place; the second argument is the index of the first row

# Bytes of the public header block that contain the offsets of data after the points.
_start_of_waveforms = slice(227, 235)
_start_of_extended_records = slice(235, 243)


@dataclass(frozen=True)
class Layout:
    """Positions of the points and of other data in a file."""

    begin: int  # offset of the points, bytes
    count: int  # number of points
    row: int  # bytes per point
    compressed_as: bytes | None  # parameters of LASzip
    behind: int  # offset of the data after compressed points, 0 if there is none
    has_index: bool  # the index of COPC

    @staticmethod
    def of(reader: Any, size: int) -> Layout:
        """Layout of a file of `size` bytes, opened by laspy.

        Raises:
            BadFileError: The file cannot be copied without loss.
        """
        header = reader.header
        users = {record.user_id for record in header.vlrs}
        if "lascompatible" in users:
            raise BadFileError(
                "LAS 1.4 in compatibility mode is not supported: it stores classes twice (convert it to plain LAZ)"
            )
        starts = (header.start_of_waveform_data_packet_record, header.start_of_first_evlr)
        behind = min((start for start in starts if start > header.offset_to_point_data), default=0)
        if behind > size:
            raise BadFileError(
                f"records start at byte {behind:,} of a file of {size:,} bytes (the file is truncated or damaged)"
            )
        return Layout(
            begin=header.offset_to_point_data,
            count=header.point_count,
            row=header.point_format.size,
            compressed_as=_compression(header),
            behind=behind,
            has_index="copc" in users,
        )


def copy_points(file: BinaryIO, copy: BinaryIO, layout: Layout, change: Change) -> None:
    """Copies the file and calls `change` on all points, in order, in blocks.

    Raises:
        BadFileError: The copy would differ in more than the changes.
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
        raise BadFileError("LASzip without chunks (before 2011) is not supported (compress the file again)")
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
        move_index(head, copy, _chunks(file, layout, kind), _chunks(copy, layout, kind), shift)
    copy.seek(0)
    copy.write(head)
    _check_copy(copy, layout, parameters, checksum)


# Number of points and of bytes of each chunk.
def _chunks(file: BinaryIO, layout: Layout, kind: Any) -> list[tuple[int, int]]:
    file.flush()
    file.seek(layout.begin)
    chunks: list[tuple[int, int]] = needs("lazrs", "las").read_chunk_table(file, kind)
    return chunks


# Blocks of points, each with a flag that is true if the block starts a chunk of the compressed file.
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
    if start.stop > int.from_bytes(head[94:96], "little"):  # the header is of an older version without this field
        return
    before = int.from_bytes(head[start], "little")
    if before >= layout.behind:
        head[start] = (before + shift).to_bytes(8, "little")


# Detects errors of the compressor before the copy replaces an older file.
def _check_copy(copy: BinaryIO, layout: Layout, parameters: bytes, checksum: int) -> None:
    copy.flush()
    again = 0
    for rows, _ in _decompressed(copy, layout, parameters):
        again = zlib.crc32(rows.data, again)
    if again != checksum:
        raise BadFileError("lazrs cannot compress this file without loss (convert it to LAS first)")


def _copy_rest(file: BinaryIO, copy: BinaryIO) -> None:
    while block := file.read(1 << 24):
        copy.write(block)


Chunks = Sequence[tuple[int, int]]  # number of points and of bytes of each chunk

_begin_of_root_page = slice(469, 477)  # bytes of the file; the COPC record is the first record, at a fixed offset
_record_head = 60  # bytes of an extended record before its data
_hierarchy = 1000  # ID of the record that contains the index
_entry = np.dtype([("voxel", "<i4", 4), ("begin", "<u8"), ("bytes", "<i4"), ("points", "<i4")])
_page_elsewhere = -1  # number of points of an entry that refers to another page


def move_index(head: bytearray, copy: BinaryIO, before: Chunks, after: Chunks, shift: int) -> None:
    """Updates the offsets in the COPC index of a copy.

    Args:
        head: Bytes of the copy up to the points; changed in place.
        copy: The copy, including the records after the points; the index is changed in the file.
        before: Chunks of the source.
        after: Chunks of the copy, with the same points in each chunk.
        shift: Number of bytes by which the records after the points have moved.

    Raises:
        BadFileError: The index does not match the chunks.
    """
    begin_of_points = int.from_bytes(head[96:100], "little")
    begin_of_records = int.from_bytes(head[235:243], "little")
    root = int.from_bytes(head[_begin_of_root_page], "little")
    if root + shift < begin_of_records:
        raise BadFileError("the COPC index is not after the points (the file is damaged)")
    head[_begin_of_root_page] = (root + shift).to_bytes(8, "little")
    positions = dict(zip(_positions(begin_of_points, before), _positions(begin_of_points, after), strict=True))

    end = copy.seek(0, os.SEEK_END)
    at = begin_of_records
    for _ in range(int.from_bytes(head[243:247], "little")):
        copy.seek(at)
        record = copy.read(_record_head)
        size = int.from_bytes(record[20:28], "little")
        at += _record_head
        if at + size > end:
            raise BadFileError("a COPC record extends beyond the end of the file (the file is truncated or damaged)")
        if record[2:18].rstrip(b"\0") == b"copc" and int.from_bytes(record[18:20], "little") == _hierarchy:
            entries = np.frombuffer(bytearray(copy.read(size)), _entry)
            _move_entries(entries, positions, shift)
            copy.seek(at)
            copy.write(entries.tobytes())
        at += size


# Offset and size of every chunk with points. The 8 bytes before the first chunk contain the offset of the chunk table.
def _positions(begin_of_points: int, chunks: Chunks) -> list[tuple[int, int]]:
    positions = []
    at = begin_of_points + 8
    for points, size in chunks:
        if points > 0:
            positions.append((at, size))
        at += size
    return positions


def _move_entries(
    entries: npt.NDArray[np.void], positions: Mapping[tuple[int, int], tuple[int, int]], shift: int
) -> None:
    for entry in entries:
        if entry["points"] == _page_elsewhere:
            entry["begin"] = int(entry["begin"]) + shift
        elif entry["points"] > 0:
            position = positions.get((int(entry["begin"]), int(entry["bytes"])))
            if position is None:
                raise BadFileError("the COPC index does not match the chunks (the file is damaged)")
            entry["begin"], entry["bytes"] = position
