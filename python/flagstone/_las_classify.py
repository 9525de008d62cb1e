# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Sets the classification of a LAS or LAZ file and keeps everything else in it."""

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
    """Copies a LAS or LAZ file with the classification of its points set from labels.

    Points labelled ground become class 2 (ground), noise 7 (low point); nonground ones that were 0 (never classified),
    2 or 7 become 1 (unclassified) and keep any other class. Points that no method judges (out of range, invalid)
    keep theirs. Only points of classes in `overwrite_classes` are changed at all.

    Everything else is kept bit for bit: header, variable length records, all other dimensions, the flags beside the
    class, what stands behind the points. A LAZ file is compressed anew with its own parameters and read back before it
    takes its place; offsets of what stands behind the points, and the index of a COPC file, follow the chunks to where
    they come to lie. Memory holds the labels and a million points at a time.

    Args:
        source: The file, LAS 1.0 to 1.4, point formats 0 to 10. Point formats 0 to 5 have 5 bits for the class.
        destination: The file to write, with the ending of the source, but not the source itself. It is there whole or
            not at all.
        labels: Codes of `flagstone.Label`, shape (N,), one a point in the file's order.
        overwrite_classes: Classes that may be changed, 0 to 255. The default keeps classes that say more than ground or
            not, such as plants (3 to 5), buildings (6), water (9), overlap (12), bridges (17) and high noise (18).
            `range(256)` allows all.

    Returns:
        How many points of each class the new file has, by class.

    Raises:
        FileNotFoundError: There is no such source.
        OSError: The destination cannot be written.
        TypeError: The labels are no integers.
        ValueError: The source is damaged, or of a kind that cannot be kept as it is; labels are not one a point or not
            0 to 4; endings differ; the destination is the source.
        ImportError: laspy is not installed.
    """
    codes = checked_labels(labels)
    table = class_table(overwrite_classes)
    ending = Path(source).suffix.lower()
    if Path(destination).suffix.lower() != ending:
        raise ValueError(f"destination: {os.fspath(destination)} must end with {ending}, as the source does")
    if Path(destination).exists() and Path(destination).samefile(source):
        raise ValueError(f"destination: {os.fspath(destination)} is the source; choose another file")
    counts = np.zeros(256, np.int64)
    with atomic_write(destination) as copy, opened(source) as reader, Path(source).open("rb") as file:
        layout = Layout.of(reader, os.fstat(file.fileno()).st_size)
        class_byte, class_bits = (16, 0xFF) if reader.header.point_format.id >= 6 else (15, 0x1F)
        if len(codes) != layout.count:
            raise BadFileError(f"has {layout.count:,} points, but there are {len(codes):,} labels; give one a point")
        with Progress(layout.count, "points") as progress:

            def classify(rows: Rows, first: int) -> None:
                packed = rows[:, class_byte]
                after = table[codes[first : first + len(rows)], packed & class_bits]
                rows[:, class_byte] = (packed & ~np.uint8(class_bits)) | after
                counts[:] += np.bincount(after, minlength=256)
                progress.add(len(rows))

            copy_points(file, copy, layout, classify)
    return {code: int(count) for code, count in enumerate(counts) if count > 0}


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
        move_index(head, copy, _chunks(file, layout, kind), _chunks(copy, layout, kind), shift)
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


Chunks = Sequence[tuple[int, int]]  # points and bytes of each

_begin_of_root_page = slice(469, 477)  # in the file: the first record is COPC's own, at a fixed place
_record_head = 60  # bytes of an extended record before its data
_hierarchy = 1000  # the number of the record that holds the index
_entry = np.dtype([("voxel", "<i4", 4), ("begin", "<u8"), ("bytes", "<i4"), ("points", "<i4")])
_page_elsewhere = -1  # in the place of a number of points


def move_index(head: bytearray, copy: BinaryIO, before: Chunks, after: Chunks, shift: int) -> None:
    """Lets the index in a copy tell where its chunks are.

    Args:
        head: The copy's bytes up to the points; changed in place.
        copy: The copy, with the records behind the points; the index is changed in the file.
        before: The chunks of the file that was copied.
        after: The chunks of the copy, the same points in each.
        shift: How many bytes farther the records behind the points are.

    Raises:
        BadFileError: The index does not fit the chunks.
    """
    begin_of_points = int.from_bytes(head[96:100], "little")
    begin_of_records = int.from_bytes(head[235:243], "little")
    root = int.from_bytes(head[_begin_of_root_page], "little")
    if root + shift < begin_of_records:
        raise BadFileError("is COPC with an index that does not stand behind the points: it is damaged")
    head[_begin_of_root_page] = (root + shift).to_bytes(8, "little")
    places = dict(zip(_places(begin_of_points, before), _places(begin_of_points, after), strict=True))

    end = copy.seek(0, os.SEEK_END)
    at = begin_of_records
    for _ in range(int.from_bytes(head[243:247], "little")):
        copy.seek(at)
        record = copy.read(_record_head)
        size = int.from_bytes(record[20:28], "little")
        at += _record_head
        if at + size > end:
            raise BadFileError("is COPC with a record that reaches beyond its end: it is cut off or damaged")
        if record[2:18].rstrip(b"\0") == b"copc" and int.from_bytes(record[18:20], "little") == _hierarchy:
            entries = np.frombuffer(bytearray(copy.read(size)), _entry)
            _move_entries(entries, places, shift)
            copy.seek(at)
            copy.write(entries.tobytes())
        at += size


# Begin and size of every chunk that holds points; the first stands behind the place of the chunk table's own offset.
def _places(begin_of_points: int, chunks: Chunks) -> list[tuple[int, int]]:
    places = []
    at = begin_of_points + 8
    for points, size in chunks:
        if points > 0:
            places.append((at, size))
        at += size
    return places


def _move_entries(entries: npt.NDArray[np.void], places: Mapping[tuple[int, int], tuple[int, int]], shift: int) -> None:
    for entry in entries:
        if entry["points"] == _page_elsewhere:
            entry["begin"] = int(entry["begin"]) + shift
        elif entry["points"] > 0:
            place = places.get((int(entry["begin"]), int(entry["bytes"])))
            if place is None:
                raise BadFileError("is COPC with an index that does not fit its chunks: it is damaged")
            entry["begin"], entry["bytes"] = place
