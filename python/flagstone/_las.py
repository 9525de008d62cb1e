# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""LAS and LAZ files as structured arrays, through laspy, and the classes that labels stand for in them."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from flagstone._atomic_file import atomic_write
from flagstone._optional import needs
from flagstone._progress import Progress

Points = npt.NDArray[Any]

points_at_once = 1_000_000
"""How many points are held in more than one form at a time."""

_axes = ("x", "y", "z")
_scale = 0.001  # metres; what surveys write, and finer than any LiDAR measures
_least_header = 227  # bytes, of LAS 1.0 to 1.2
_least_record = 54  # bytes, a variable length record that holds nothing


def is_las(path: str | os.PathLike[str]) -> bool:
    """Whether a file's name says LAS or LAZ."""
    return os.fspath(path).lower().endswith((".las", ".laz"))


def read(path: str | os.PathLike[str]) -> Points:
    """Reads all points of a LAS or LAZ file.

    Args:
        path: A file of LAS 1.0 to 1.4, point formats 0 to 10, compressed or not.

    Returns:
        A structured array with a field for each dimension of the file: `x`, `y`, `z` (float64, in the file's units,
        metres as a rule), then the others by their names in laspy: `intensity`, `return_number`, `classification`,
        `gps_time` and so on, flags as 0 and 1, then the extra bytes, scaled where the file says how.

    Raises:
        FileNotFoundError: There is no such file.
        ValueError: The file is damaged or no LAS file.
        MemoryError: It has more points than the memory holds, or says so.
        ImportError: laspy is not installed.
    """
    with opened(path) as reader:
        count = reader.header.point_count
        names = [name for name in reader.header.point_format.dimension_names if name not in ("X", "Y", "Z")]
        points = np.empty(count, _dtype(reader, names))
        done = 0
        with Progress(count, "points") as progress:
            for chunk in reader.chunk_iterator(points_at_once):
                rows = points[done : done + len(chunk)]
                for name in (*_axes, *names):
                    rows[name] = np.asarray(chunk[name])
                done += len(chunk)
                progress.add(len(chunk))
    return points


def write(
    path: str | os.PathLike[str],
    points: Points,
    *,
    labels: npt.ArrayLike | None = None,
    heights: npt.ArrayLike | None = None,
) -> None:
    """Writes points as LAS 1.4, compressed where the name ends with `.laz`.

    The point format is 6, 7 with fields `red`, `green`, `blue`, 8 with `nir` too. Coordinates are rounded to a
    millimetre. Fields that LAS knows are written as such, all others as extra bytes. A floating `intensity` of 0 to 1
    is spread over the 16 bits that LAS has for it.

    Args:
        path: The file to write; it is there whole or not at all.
        points: A structured array of shape (N,) with fields x, y, z, metres.
        labels: Codes of `flagstone.Label`, shape (N,): `classification` is set from them as `classify_las` does it.
        heights: Metres above the ground, shape (N,): extra bytes `height`, float32.

    Raises:
        ValueError: A field does not fit LAS: its name, the value and the range are said.
        OSError: The file cannot be written.
        ImportError: laspy is not installed.
    """
    laspy = _laspy()
    fields = {name: points[name] for name in points.dtype.names or ()}
    for axis in _axes:
        if axis not in fields:
            raise ValueError(f"points: field {axis} is missing; wanted are x, y and z")
        if axis.upper() in fields:
            raise ValueError(f"points: field {axis.upper()} is what LAS makes of {axis}; leave it out, or rename it")
    count = len(fields["x"])
    if labels is not None:
        before = np.asarray(fields.get("classification", np.zeros(count, np.uint8)))
        fields["classification"] = classes_from_labels(before, _one_a_point("labels", labels, count))
    if heights is not None:
        fields["height"] = _one_a_point("heights", heights, count).astype(np.float32)

    header = laspy.LasHeader(version="1.4", point_format=_point_format(fields))
    header.generating_software = "flagstone"
    header.scales = np.full(3, _scale)
    header.offsets = _offsets(fields)
    standard = set(header.point_format.dimension_names)
    for name, values in fields.items():
        if name in _axes:
            continue
        if name in standard:
            fields[name] = _fitting(header, name, values)
        else:
            header.add_extra_dim(_extra_bytes(name, values))

    with atomic_write(path) as file:
        compressed = os.fspath(path).lower().endswith(".laz")
        with (
            laspy.open(file, mode="w", header=header, do_compress=compressed, closefd=False) as writer,
            Progress(count, "points") as progress,
        ):
            for first in range(0, count, points_at_once):
                some = slice(first, first + points_at_once)
                record = laspy.ScaleAwarePointRecord.zeros(len(fields["x"][some]), header=header)
                for name, values in fields.items():
                    record[name] = values[some]
                writer.write_points(record)
                progress.add(len(record))


@contextmanager
def opened(path: str | os.PathLike[str]) -> Iterator[Any]:
    """A reader of the file. Whatever its bytes make laspy raise in the block becomes one line of ValueError."""
    laspy = _laspy()
    try:
        with Path(path).open("rb") as file:
            size = os.fstat(file.fileno()).st_size
            _check_header(file.read(_least_header), size)
            file.seek(0)
            with laspy.open(file, closefd=False, read_evlrs=False) as reader:
                _check_size(reader, file, size)
                yield reader
    except BadFileError as error:
        raise ValueError(f"{os.fspath(path)}: {error}") from None
    except OSError as error:
        if error.errno is not None:
            raise
        raise ValueError(_damaged(path, error)) from error
    except (KeyboardInterrupt, SystemExit, GeneratorExit, ImportError, MemoryError):
        raise
    except BaseException as error:  # lazrs panics are no Exception
        raise ValueError(_damaged(path, error)) from error


def _damaged(path: str | os.PathLike[str], error: BaseException) -> str:
    reason = " ".join(str(error).split()) or type(error).__name__
    return f"{os.fspath(path)}: is no LAS or LAZ file that can be read ({reason}); it may be cut off or damaged"


def _laspy() -> Any:
    needs("lazrs", "las")  # laspy needs it for LAZ, and says so too late
    return needs("laspy", "las")


# laspy believes a header that is damaged, and looks for four billion records in a small file.
def _check_header(header: bytes, size: int) -> None:
    if len(header) < _least_header or header[:4] != b"LASF":
        raise BadFileError("does not begin with the header of a LAS file, LASF; name a .las or .laz file")
    header_size = int.from_bytes(header[94:96], "little")
    begin_of_points = int.from_bytes(header[96:100], "little")
    records = int.from_bytes(header[100:104], "little")
    if begin_of_points > size or header_size + records * _least_record > begin_of_points:
        raise BadFileError(
            f"a header of {header_size} bytes, {records} records and points from byte {begin_of_points} on do not fit "
            f"each other and its {size:,} bytes: it is cut off or damaged"
        )


# No more is allocated than the file's own size can justify.
def _check_size(reader: Any, file: BinaryIO, size: int) -> None:
    header = reader.header
    begin, count, row = header.offset_to_point_data, header.point_count, header.point_format.size
    if header.are_points_compressed:
        parameters = header.vlrs.get("LasZipVlr")
        if not parameters:
            raise BadFileError("is compressed, but has no record of LASzip that says how: it is damaged")
        check_chunks(file, size, begin, count, row, bytes(parameters[0].record_data))
        file.seek(begin)
    elif begin + count * row > size:
        raise BadFileError(
            f"{count:,} points of {row} bytes need {begin + count * row:,} bytes, the file has {size:,}: it is cut off"
        )


def _dtype(reader: Any, names: Sequence[str]) -> np.dtype[Any]:
    none = _laspy().ScaleAwarePointRecord.zeros(0, header=reader.header)
    fields: list[tuple[str, Any, tuple[int, ...]]] = [(axis, np.float64, ()) for axis in _axes]
    for name in names:
        values = np.asarray(none[name])
        fields.append((name, values.dtype, values.shape[1:]))
    return np.dtype(fields)


def _one_a_point(what: str, values: npt.ArrayLike, count: int) -> Points:
    array = np.asarray(values)
    if array.shape != (count,):
        raise ValueError(f"{what}: an array of shape {array.shape} came for {count} points; wanted ({count},)")
    return array


def _point_format(fields: Mapping[str, Points]) -> int:
    if not {"red", "green", "blue"} <= fields.keys():
        return 6
    return 8 if "nir" in fields else 7


def _offsets(fields: Mapping[str, Points]) -> Points:
    offsets = np.zeros(3)
    for i, axis in enumerate(_axes):
        values = np.asarray(fields[axis], np.float64)
        if not np.isfinite(values).all():
            first = int(np.argmin(np.isfinite(values)))
            raise ValueError(
                f"points: {axis} of point {first} is {values[first]}; LAS holds finite coordinates only: leave such "
                "points out"
            )
        if len(values) == 0:
            continue
        offsets[i] = np.floor(values.min())
        if values.max() - offsets[i] > np.iinfo(np.int32).max * _scale:
            raise ValueError(
                f"points: {axis} reaches from {values.min():g} to {values.max():g} m; in millimetres LAS holds 2147 km"
            )
    return offsets


def _fitting(header: Any, name: str, values: Points) -> Points:
    if name == "gps_time":
        return values
    dimension = header.point_format.dimension_by_name(name)
    if name == "intensity" and values.dtype.kind == "f" and ((values >= 0) & (values <= 1)).all():
        values = np.rint(values * dimension.max)
    wrong = ~((values >= dimension.min) & (values <= dimension.max) & (values == np.rint(values)))
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(
            f"points: {name} of point {first} is {values[first]}; LAS holds whole numbers of {dimension.min} to "
            f"{dimension.max} there: round it, or give the field another name"
        )
    return values


def _extra_bytes(name: str, values: Points) -> Any:
    shape = values.shape[1:]
    if values.dtype.kind not in "iuf" or values.dtype.itemsize > 8 or values.dtype == np.float16 or len(shape) > 1:
        raise ValueError(f"points: field {name} is of type {values.dtype}; LAS holds integers and floats of 4, 8 bytes")
    if len(name.encode()) > 32 or (shape and shape[0] > 3):
        raise ValueError(f"points: field {name}: LAS holds names of 32 bytes and fields of 3 numbers at most")
    kind = values.dtype.newbyteorder("<").str[1:]
    return _laspy().ExtraBytesParams(name=name, type=f"{shape[0]}{kind}" if shape else kind)


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


NEVER_CLASSIFIED = 0
UNCLASSIFIED = 1
GROUND = 2
LOW_POINT = 7

DEFAULT_OVERWRITE_CLASSES = (NEVER_CLASSIFIED, UNCLASSIFIED, GROUND, LOW_POINT)
"""All that says nothing but ground, noise or neither: what others found (plants, buildings, water) stays."""

_nonground, _ground, _noise = 0, 1, 2  # codes of flagstone.Label that judge a point
_label_count = 5


def class_table(overwrite_classes: Iterable[int]) -> npt.NDArray[np.uint8]:
    """Which class a point gets by its label and the class it has: a table of shape (5, 256).

    Raises:
        ValueError: A class is not 0 to 255.
    """
    table = np.tile(np.arange(256, dtype=np.uint8), (_label_count, 1))
    for changeable in overwrite_classes:
        code = _class_code(changeable)
        table[_ground, code] = GROUND
        table[_noise, code] = LOW_POINT
        if code in (NEVER_CLASSIFIED, GROUND, LOW_POINT):
            table[_nonground, code] = UNCLASSIFIED
    return table


def classes_from_labels(
    classes: npt.NDArray[Any], labels: npt.NDArray[Any], overwrite_classes: Iterable[int] = DEFAULT_OVERWRITE_CLASSES
) -> npt.NDArray[np.uint8]:
    """The classes of points after a segmentation; both arrays of shape (N,)."""
    wrong = (classes < 0) | (classes > 255) | (classes != np.rint(classes))
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(f"classification of point {first} is {classes[first]}; LAS holds whole numbers of 0 to 255")
    after: npt.NDArray[np.uint8] = class_table(overwrite_classes)[checked_labels(labels), classes.astype(np.uint8)]
    return after


def checked_labels(labels: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """Codes of `flagstone.Label` as uint8.

    Raises:
        TypeError: They are no integers.
        ValueError: One is not 0 to 4, or they are not in one row.
    """
    array = np.asarray(labels)
    if array.dtype.kind not in "iu":
        raise TypeError(f"labels: an array of {array.dtype} came; wanted codes of flagstone.Label, integers of 0 to 4")
    if array.ndim != 1:
        raise ValueError(f"labels: an array of shape {array.shape} came; wanted (N,), one code a point")
    wrong = (array < 0) | (array >= _label_count)
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(f"labels: that of point {first} is {array[first]}; wanted codes of flagstone.Label, 0 to 4")
    return array.astype(np.uint8, copy=False)


def _class_code(value: int) -> int:
    try:
        code = operator.index(value)
    except TypeError:
        code = -1
    if not 0 <= code <= 255:
        raise ValueError(f"overwrite_classes: {value!r} is no class of LAS; wanted whole numbers of 0 to 255")
    return code
