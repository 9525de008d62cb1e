# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The index of a COPC file (Cloud Optimized Point Cloud 1.0): an octree whose nodes tell which chunk is theirs."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import BinaryIO

import numpy as np
import numpy.typing as npt

from flagstone._laz import BadFileError

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
