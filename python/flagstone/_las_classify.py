# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Sets the classification of a LAS or LAZ file and touches nothing else of it."""

from __future__ import annotations

import os
import zlib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from flagstone._las import BadFileError, opened, points_at_once
from flagstone._las_classes import checked_labels, class_table, default_may_change
from flagstone._optional import needs
from flagstone._progress import Progress
from flagstone._whole_file import written_whole

Rows = npt.NDArray[np.uint8]

# Bytes of the public header block that say where things behind the points begin.
_start_of_waveforms = slice(227, 235)
_start_of_extended_records = slice(235, 243)


def classify_las(
    source: str | os.PathLike[str],
    destination: str | os.PathLike[str],
    labels: npt.ArrayLike,
    *,
    may_change: Iterable[int] = default_may_change,
) -> dict[int, int]:
    """Copies a LAS or LAZ file with the classification of its points set from labels.

    Points labelled ground become class 2 (ground), noise 7 (low point); nonground ones that were 0 (never classified),
    2 or 7 become 1 (unclassified) and keep any other class. Points that no method judges (out of range, invalid)
    keep theirs. Only points of classes in `may_change` are changed at all.

    Everything else is kept bit for bit: header, variable length records, all other dimensions, the flags beside the
    class, what stands behind the points. A LAZ file is compressed anew with its own parameters and read back before it
    takes its place. Memory holds the labels and a million points at a time.

    Args:
        source: The file, LAS 1.0 to 1.4, point formats 0 to 10. Point formats 0 to 5 have 5 bits for the class.
        destination: The file to write, with the ending of the source; it may be the source. It is there whole or not
            at all.
        labels: Codes of `flagstone.Label`, shape (N,), one a point in the file's order.
        may_change: Classes that may be changed, 0 to 255. The default leaves what says more than ground or not, such
            as plants (3 to 5), buildings (6), water (9), overlap (12), bridges (17) and high noise (18).
            `range(256)` allows all.

    Returns:
        How many points of each class the new file has, by class.

    Raises:
        FileNotFoundError: There is no such source.
        OSError: The destination cannot be written.
        TypeError: The labels are no integers.
        ValueError: The source is damaged, or of a kind that cannot be kept as it is (COPC); labels are not one a point
            or not 0 to 4; endings differ.
        ImportError: laspy is not installed.
    """
    codes = checked_labels(labels)
    table = class_table(may_change)
    ending = Path(source).suffix.lower()
    if Path(destination).suffix.lower() != ending:
        raise ValueError(f"destination: {os.fspath(destination)} must end with {ending}, as the source does")
    counts = np.zeros(256, np.int64)
    with written_whole(destination) as copy, opened(source) as reader, Path(source).open("rb") as file:
        layout = _Layout.of(reader, os.fstat(file.fileno()).st_size)
        if len(codes) != layout.count:
            raise BadFileError(f"has {layout.count:,} points, but there are {len(codes):,} labels; give one a point")
        with Progress(layout.count, "points") as progress:

            def classify(rows: Rows, first: int) -> None:
                _set_classes(rows, codes[first : first + len(rows)], layout, table, counts)
                progress.add(len(rows))

            if layout.compressed_as is None or layout.count == 0:
                _copy_uncompressed(file, copy, layout, classify)
            else:
                _copy_compressed(file, copy, layout, layout.compressed_as, classify)
    return {code: int(count) for code, count in enumerate(counts) if count > 0}


@dataclass(frozen=True)
class _Layout:
    """Where the points of a file are, and where in them the class is."""

    begin: int  # of the points
    count: int
    row: int  # bytes a point
    class_byte: int  # in a point
    class_bits: int  # mask
    compressed_as: bytes | None  # the parameters of LASzip
    behind: int  # begin of what stands behind compressed points, 0 where nothing does

    @staticmethod
    def of(reader: Any, size: int) -> _Layout:
        header = reader.header
        for record in header.vlrs:
            if record.user_id == "copc":
                raise BadFileError("is COPC, whose index tells where each compressed chunk is; convert it to plain LAZ")
            if record.user_id == "lascompatible":
                raise BadFileError(
                    "is LAS 1.4 in compatibility mode, with classes in two places; convert it to plain LAZ"
                )
        has_long_class = header.point_format.id >= 6
        starts = (header.start_of_waveform_data_packet_record, header.start_of_first_evlr)
        behind = min((start for start in starts if start > header.offset_to_point_data), default=0)
        if behind > size:
            raise BadFileError(f"says that records begin at byte {behind:,} of its {size:,}: it is cut off or damaged")
        return _Layout(
            begin=header.offset_to_point_data,
            count=header.point_count,
            row=header.point_format.size,
            class_byte=16 if has_long_class else 15,
            class_bits=0xFF if has_long_class else 0x1F,
            compressed_as=_compression(header),
            behind=behind,
        )


def _compression(header: Any) -> bytes | None:
    if not header.are_points_compressed:
        return None
    parameters = bytes(header.vlrs.get("LasZipVlr")[0].record_data)
    if int.from_bytes(parameters[:2], "little") not in (2, 3):
        raise BadFileError("was compressed by a LASzip of before 2011, without chunks; compress it anew")
    return parameters


def _set_classes(rows: Rows, codes: Rows, layout: _Layout, table: Rows, counts: npt.NDArray[np.int64]) -> None:
    packed = rows[:, layout.class_byte]
    after = table[codes, packed & layout.class_bits]
    counts += np.bincount(after, minlength=256)
    rows[:, layout.class_byte] = (packed & ~np.uint8(layout.class_bits)) | after


def _copy_uncompressed(file: BinaryIO, copy: BinaryIO, layout: _Layout, classify: Callable[[Rows, int], None]) -> None:
    copy.write(file.read(layout.begin))
    for first in range(0, layout.count, points_at_once):
        count = min(points_at_once, layout.count - first)
        rows = np.frombuffer(bytearray(file.read(count * layout.row)), np.uint8).reshape(-1, layout.row)
        classify(rows, first)
        copy.write(rows.data)
    _copy_rest(file, copy)


def _copy_compressed(
    file: BinaryIO, copy: BinaryIO, layout: _Layout, parameters: bytes, classify: Callable[[Rows, int], None]
) -> None:
    lazrs = needs("lazrs", "las")
    file.seek(0)
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
        classify(rows, first)
        first += len(rows)
        checksum = zlib.crc32(rows.data, checksum)
        compressor.compress_many(rows.reshape(-1))
    compressor.done()

    end_of_points = copy.seek(0, os.SEEK_END)
    if layout.behind > 0:
        for start in (_start_of_waveforms, _start_of_extended_records):
            _move(head, start, layout, end_of_points - layout.behind)
        file.seek(layout.behind)
        _copy_rest(file, copy)
        copy.seek(0)
        copy.write(head)
    _check_copy(copy, layout, parameters, checksum)


# Rows of points, and whether a chunk of the compressed file begins with them.
def _decompressed(file: BinaryIO, layout: _Layout, parameters: bytes) -> Iterator[tuple[Rows, bool]]:
    lazrs = needs("lazrs", "las")
    kind = lazrs.LazVlr(parameters)
    chunks = [layout.count]
    if kind.uses_variable_size_chunks():
        file.seek(layout.begin)
        chunks = [points for points, _ in lazrs.read_chunk_table(file, kind)]
    file.seek(layout.begin)
    decompressor = lazrs.ParLasZipDecompressor(file, parameters)
    for chunk in chunks:
        for first in range(0, chunk, points_at_once):
            count = min(points_at_once, chunk - first)
            points = bytearray(count * layout.row)
            decompressor.decompress_many(points)
            yield np.frombuffer(points, np.uint8).reshape(-1, layout.row), first == 0


def _move(head: bytearray, start: slice, layout: _Layout, shift: int) -> None:
    if start.stop > int.from_bytes(head[94:96], "little"):  # header of a version that did not know it
        return
    before = int.from_bytes(head[start], "little")
    if before >= layout.behind:
        head[start] = (before + shift).to_bytes(8, "little")


# What a compressor made wrong would be lost for good.
def _check_copy(copy: BinaryIO, layout: _Layout, parameters: bytes, checksum: int) -> None:
    copy.flush()
    again = 0
    for rows, _ in _decompressed(copy, layout, parameters):
        again = zlib.crc32(rows.data, again)
    if again != checksum:
        raise BadFileError("cannot be compressed by lazrs without loss; uncompress it to LAS, and give that")


def _copy_rest(file: BinaryIO, copy: BinaryIO) -> None:
    while block := file.read(1 << 24):
        copy.write(block)
