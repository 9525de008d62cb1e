# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reading and writing LAS and LAZ files with laspy, and the mapping from labels to LAS classes."""

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
"""Number of points processed at a time, which limits the memory of conversions."""

_axes = ("x", "y", "z")
_scale = 0.001  # metres; the usual resolution in surveying, finer than any LiDAR measures
_min_header = 227  # bytes, LAS 1.0 to 1.2
_min_record = 54  # bytes, an empty variable length record


def is_las(path: str | os.PathLike[str]) -> bool:
    """Whether a file has the extension .las or .laz."""
    return os.fspath(path).lower().endswith((".las", ".laz"))


def read(path: str | os.PathLike[str]) -> Points:
    """Reads all points of a LAS or LAZ file.

    Args:
        path: A file of LAS 1.0 to 1.4, point formats 0 to 10, compressed or not.

    Returns:
        A structured array with one field per dimension of the file. `x`, `y` and `z` are float64, in the units of the
        file (usually metres). The other fields have the names that laspy uses: `intensity`, `return_number`,
        `classification`, `gps_time` and so on. Flags are 0 or 1. Extra bytes come last, scaled if the file defines a
        scale.

    Raises:
        FileNotFoundError: The file does not exist.
        ValueError: The file is damaged or not a LAS file.
        MemoryError: The points, by the count in the header, do not fit in memory.
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
    """Writes points as LAS 1.4, compressed if the extension is `.laz`.

    The point format is 6; 7 if there are fields `red`, `green` and `blue`; 8 if there is also `nir`. Coordinates are
    rounded to millimetres. Fields that are not dimensions of LAS are written as extra bytes. A floating-point
    `intensity` from 0 to 1 is scaled to 16 bits.

    Args:
        path: File to write, atomically.
        points: Structured array of shape (N,) with fields x, y and z in metres.
        labels: (N,) codes of `flagstone.Label`. They set `classification` by the rule of `classify_las`.
        heights: (N,) heights above the ground in metres, written as extra bytes `height`, float32.

    Raises:
        ValueError: LAS cannot store a field. The message names the field, the value and the range.
        OSError: The file cannot be written.
        ImportError: laspy is not installed.
    """
    laspy = _laspy()
    fields = {name: points[name] for name in points.dtype.names or ()}
    for axis in _axes:
        if axis not in fields:
            raise ValueError(f"points: no field named {axis} (expected x, y and z)")
        if axis.upper() in fields:
            raise ValueError(
                f"points: field {axis.upper()} is reserved (LAS stores {axis} under this name; remove or rename it)"
            )
    count = len(fields["x"])
    if labels is not None:
        before = np.asarray(fields.get("classification", np.zeros(count, np.uint8)))
        fields["classification"] = classes_from_labels(before, _one_per_point("labels", labels, count))
    if heights is not None:
        fields["height"] = _one_per_point("heights", heights, count).astype(np.float32)

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
    """Opens a laspy reader. Any exception that laspy raises for the file's contents becomes a one-line ValueError."""
    laspy = _laspy()
    try:
        with Path(path).open("rb") as file:
            size = os.fstat(file.fileno()).st_size
            _check_header(file.read(_min_header), size)
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
    except BaseException as error:  # panics of lazrs are not subclasses of Exception
        raise ValueError(_damaged(path, error)) from error


def _damaged(path: str | os.PathLike[str], error: BaseException) -> str:
    reason = " ".join(str(error).split()) or type(error).__name__
    return f"{os.fspath(path)}: cannot be read as LAS or LAZ: {reason} (the file may be truncated or damaged)"


def _laspy() -> Any:
    needs("lazrs", "las")  # for LAZ; laspy checks for it too late
    return needs("laspy", "las")


# laspy trusts damaged headers: it may search for four billion records in a small file.
def _check_header(header: bytes, size: int) -> None:
    if len(header) < _min_header or header[:4] != b"LASF":
        raise BadFileError("no LAS header (expected the signature LASF at byte 0; choose a .las or .laz file)")
    header_size = int.from_bytes(header[94:96], "little")
    begin_of_points = int.from_bytes(header[96:100], "little")
    records = int.from_bytes(header[100:104], "little")
    if begin_of_points > size or header_size + records * _min_record > begin_of_points:
        raise BadFileError(
            f"the header contradicts itself: {header_size} bytes, {records} records, points from byte "
            f"{begin_of_points}, in a file of {size:,} bytes (the file is truncated or damaged)"
        )


# Allocates no more than the size of the file justifies.
def _check_size(reader: Any, file: BinaryIO, size: int) -> None:
    header = reader.header
    begin, count, row = header.offset_to_point_data, header.point_count, header.point_format.size
    if header.are_points_compressed:
        parameters = header.vlrs.get("LasZipVlr")
        if not parameters:
            raise BadFileError("the points are compressed, but the LASzip record is missing (the file is damaged)")
        check_chunks(file, size, begin, count, row, bytes(parameters[0].record_data))
        file.seek(begin)
    elif begin + count * row > size:
        raise BadFileError(
            f"{count:,} points of {row} bytes need {begin + count * row:,} bytes, but the file has {size:,} "
            "(the file is truncated)"
        )


def _dtype(reader: Any, names: Sequence[str]) -> np.dtype[Any]:
    none = _laspy().ScaleAwarePointRecord.zeros(0, header=reader.header)
    fields: list[tuple[str, Any, tuple[int, ...]]] = [(axis, np.float64, ()) for axis in _axes]
    for name in names:
        values = np.asarray(none[name])
        fields.append((name, values.dtype, values.shape[1:]))
    return np.dtype(fields)


def _one_per_point(name: str, values: npt.ArrayLike, count: int) -> Points:
    array = np.asarray(values)
    if array.shape != (count,):
        raise ValueError(f"{name}: shape {array.shape} does not match {count} points (expected ({count},))")
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
                f"points: {axis} of point {first} is {values[first]} (LAS stores only finite coordinates; remove such "
                "points)"
            )
        if len(values) == 0:
            continue
        offsets[i] = np.floor(values.min())
        if values.max() - offsets[i] > np.iinfo(np.int32).max * _scale:
            raise ValueError(
                f"points: {axis} ranges from {values.min():g} to {values.max():g} m (in millimetres LAS can span at "
                "most 2147 km)"
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
            f"points: {name} of point {first} is {values[first]} (expected an integer from {dimension.min} to "
            f"{dimension.max}; round the values or rename the field)"
        )
    return values


def _extra_bytes(name: str, values: Points) -> Any:
    shape = values.shape[1:]
    if values.dtype.kind not in "iuf" or values.dtype.itemsize > 8 or values.dtype == np.float16 or len(shape) > 1:
        raise ValueError(
            f"points: field {name} has dtype {values.dtype}, which LAS cannot store (expected integers, float32 or "
            "float64)"
        )
    if len(name.encode()) > 32 or (shape and shape[0] > 3):
        raise ValueError(
            f"points: field {name} does not fit into LAS (expected a name of at most 32 bytes, 1 to 3 numbers)"
        )
    kind = values.dtype.newbyteorder("<").str[1:]
    return _laspy().ExtraBytesParams(name=name, type=f"{shape[0]}{kind}" if shape else kind)


_without_chunks = 1  # LASzip before 2011
_max_chunk = 10_000_000  # points; writers use 50,000


class BadFileError(Exception):
    """A problem with the contents of a file. The message does not name the file."""


def check_chunks(file: BinaryIO, size: int, begin: int, count: int, row: int, parameters: bytes) -> None:
    """Checks that the chunk table, the LASzip parameters and the file size are consistent.

    Args:
        file: The file.
        size: Size of the file, bytes.
        begin: Offset of the points, bytes.
        count: Number of points.
        row: Bytes per point.
        parameters: LASzip parameters, from the LASzip record.

    Raises:
        BadFileError: They are inconsistent.
    """
    lazrs = needs("lazrs", "las")
    kind = lazrs.LazVlr(parameters)
    if kind.item_size() != row:
        raise BadFileError(
            f"points have {row} bytes in the header, but {kind.item_size()} in the LASzip record (the file is damaged)"
        )
    if count == 0 or int.from_bytes(parameters[:2], "little") == _without_chunks:
        return
    is_free = kind.uses_variable_size_chunks()
    if not is_free and kind.chunk_size() > max(count, _max_chunk):
        raise BadFileError(
            f"the chunk size is {kind.chunk_size():,} points, but the file has {count:,} points (the file is damaged)"
        )

    table = _begin_of_table(file, size, begin)
    compressed = table - begin - 8  # bytes of all chunks
    if not 0 <= compressed <= size - begin - 16:
        raise BadFileError(
            f"the chunk table is at byte {table:,} of a file of {size:,} bytes (the file is truncated or damaged)"
        )
    file.seek(table + 4)
    chunks = int.from_bytes(file.read(4), "little")
    if chunks > compressed:
        raise BadFileError(f"{chunks:,} chunks do not fit into {compressed:,} bytes (the file is damaged)")
    file.seek(begin)
    entries = lazrs.read_chunk_table(file, kind)
    points = sum(points for points, _ in entries) if is_free else chunks * kind.chunk_size()
    if sum(used for _, used in entries) > compressed or points < count or (is_free and points > count):
        raise BadFileError("the chunk table does not match the points (the file is damaged)")


# Writers that cannot seek store -1 here and the offset at the end of the file.
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
"""Classes that only distinguish ground, noise and the rest. Other classes, such as buildings or water, are kept."""

_nonground, _ground, _noise = 0, 1, 2  # codes of flagstone.Label that change a class
_label_count = 5


def class_table(overwrite_classes: Iterable[int]) -> npt.NDArray[np.uint8]:
    """New class of a point by its label and its old class: a table of shape (5, 256).

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
    """New classes (N,) of points, from their old classes (N,) and labels (N,)."""
    wrong = (classes < 0) | (classes > 255) | (classes != np.rint(classes))
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(
            f"points: classification of point {first} is {classes[first]} (expected an integer from 0 to 255)"
        )
    after: npt.NDArray[np.uint8] = class_table(overwrite_classes)[checked_labels(labels), classes.astype(np.uint8)]
    return after


def checked_labels(labels: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """Codes of `flagstone.Label` as uint8.

    Raises:
        TypeError: The codes are not integers.
        ValueError: A code is not 0 to 4, or the array is not one-dimensional.
    """
    array = np.asarray(labels)
    if array.dtype.kind not in "iu":
        raise TypeError(f"labels: dtype {array.dtype} is not supported (expected codes of flagstone.Label, 0 to 4)")
    if array.ndim != 1:
        raise ValueError(f"labels: shape {array.shape} is not supported (expected (N,), one code per point)")
    wrong = (array < 0) | (array >= _label_count)
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(f"labels: point {first} has {array[first]} (expected codes of flagstone.Label, 0 to 4)")
    return array.astype(np.uint8, copy=False)


def _class_code(value: int) -> int:
    try:
        code = operator.index(value)
    except TypeError:
        code = -1
    if not 0 <= code <= 255:
        raise ValueError(f"overwrite_classes: {value!r} is not a LAS class (expected integers from 0 to 255)")
    return code
