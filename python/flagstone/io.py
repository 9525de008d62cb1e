# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Readers and writers of scan files and label files, the same as in the command.

docs/reference/file-formats.md describes the formats.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
import numpy.lib.recfunctions
import numpy.typing as npt

from flagstone import _core, _las
from flagstone._las_classify import classify_las
from flagstone._points import PointsLike, records_of

__all__ = [
    "classify_las",
    "format_of",
    "is_scan_name",
    "parse",
    "read",
    "read_labels",
    "write",
    "write_labels",
]

Path = str | os.PathLike[str]

_NPY_OF = {"float32": "<f4", "float64": "<f8"} | {
    f"{sign}int{8 * size}": f"<{sign or 'i'}{size}" for sign in ("", "u") for size in (1, 2, 4, 8)
}


def read(
    path: Path, *, columns: int | None = None, origin: Sequence[float] | npt.NDArray[np.floating[Any]] | None = None
) -> npt.NDArray[np.void]:
    """Reads a scan with all its fields.

    Args:
        path: Scan file. The extension selects the format: .bin, .pcd.bin, .pcd, .ply, .npy, .las or .laz.
        columns: Floats per point in raw files (.bin), 3 to 1,024; by default 5 for .pcd.bin, otherwise 4.
        origin: Position x, y, z of the sensor in the coordinates of the file, which is subtracted from all points. Use
            it for files in map coordinates, which 32-bit floats would round to decimetres. x, y and z are then
            float64.

    Returns:
        (N,) structured array with the fields x, y, z and all other fields, in the order of the file. `segment` accepts
        it as it is. For LAS and LAZ: x, y and z are float64, followed by the dimensions under the names that laspy
        uses (`intensity`, `return_number`, `classification`, `gps_time` and so on; flags are 0 or 1) and the extra
        bytes.

    Raises:
        FileNotFoundError: The file does not exist.
        ImportError: laspy, which LAS and LAZ need, is not installed: pip install 'flagstone[las]'.
        OSError: The operating system cannot read the file.
        ValueError: The contents are invalid (the message is one line with file, byte and reason), the extension is
            unknown, or `origin` is not three finite numbers.
        MemoryError: The points do not fit in memory.
    """
    shift = None if origin is None else _three_finite("origin", origin)
    rows = _las.read(path) if _las.is_las(path) else _read_by_core(path, columns)
    return rows if shift is None else _moved(rows, shift)


def _read_by_core(path: Path, columns: int | None) -> npt.NDArray[np.void]:
    if columns is not None and not isinstance(columns, int):
        raise TypeError(f"columns: {columns!r} is not an integer")
    return _structured(*_core.read_cloud(os.fspath(path), 0 if columns is None else columns))


def parse(data: bytes | bytearray | memoryview, format: str, *, columns: int = 4) -> npt.NDArray[np.void]:
    """Reads a scan from the bytes of a file in memory.

    Args:
        data: Contents of the file.
        format: "raw", "pcd", "ply" or "npy". `format_of` returns it for a file name.
        columns: Floats per point in raw files, 3 to 1,024.

    Returns:
        (N,) structured array, as `read` returns it.

    Raises:
        ValueError: The contents are invalid, or the format is unknown.
        MemoryError: The points do not fit in memory.
    """
    return _structured(*_core.parse_cloud(np.frombuffer(data, np.uint8), format, columns))


def write(
    path: Path,
    points: PointsLike,
    *,
    labels: npt.ArrayLike | None = None,
    heights: npt.ArrayLike | None = None,
) -> None:
    """Writes a scan atomically.

    LAS and LAZ files have version 1.4 and point format 6; 7 if there are fields `red`, `green` and `blue`; 8 if there
    is also `nir`. Their coordinates are rounded to millimetres, and a floating-point `intensity` from 0 to 1 is scaled
    to 16 bits. Fields that are not dimensions of LAS become extra bytes.

    Args:
        path: File to write. The extension selects the format: .bin, .pcd, .ply, .npy, .las or .laz.
        points: (N,) structured array with fields x, y and z; or (N, >=3) numbers, whose columns become x, y, z,
            intensity, ring, c5, c6, ... Organized clouds, (H, W) and (H, W, >=3), are written row by row.
        labels: (N,) codes, written as a field `label`, uint8. In LAS and LAZ files they set `classification` by the
            rule of `classify_las`.
        heights: (N,) heights above the ground in metres, written as a field `height`, float32.

    Raises:
        ImportError: laspy, which LAS and LAZ need, is not installed: pip install 'flagstone[las]'.
        OSError: The operating system cannot write the file.
        TypeError: No format can store the type of a field.
        ValueError: The format cannot store a field, or the lengths differ.
    """
    rows = _rows(points)
    if _las.is_las(path):
        _las.write(path, rows, labels=labels, heights=heights)
        return
    if labels is not None:
        rows = _with_field(rows, "label", labels, np.uint8)
    if heights is not None:
        rows = _with_field(rows, "height", heights, np.float32)
    packed = np.ascontiguousarray(numpy.lib.recfunctions.repack_fields(rows))
    _core.write_cloud(os.fspath(path), packed.view(np.uint8).reshape(-1), _fields_of(packed.dtype))


def read_labels(path: Path, points: int) -> npt.NDArray[np.uint32]:
    """Reads one class per point: labels written by flagstone, or ground-truth labels of a dataset.

    Args:
        path: .label (SemanticKITTI: uint32, the class in the low 16 bits), .bin (nuScenes-lidarseg: uint8) or .npy.
        points: Number of points of the scan.

    Returns:
        (points,) classes, without the instance IDs of .label files.

    Raises:
        FileNotFoundError: The file does not exist.
        OSError: The operating system cannot read the file.
        ValueError: The file contains another number of labels, or is not a label file.
    """
    return _core.read_classes(os.fspath(path), points)


def write_labels(
    path: Path, labels: npt.ArrayLike, *, label_map: Literal["flagstone", "semantic-kitti"] = "flagstone"
) -> None:
    """Writes one label per point, atomically.

    Args:
        path: File to write. The extension selects the format: .label (uint32, the layout of SemanticKITTI) or .npy
            (uint8).
        labels: (N,) codes of `Label`, integers 0 to 4.
        label_map: Codes in the file: "flagstone" (0 to 4) or "semantic-kitti" (40, road, for ground; 0, unlabelled,
            otherwise).

    Raises:
        OSError: The operating system cannot write the file.
        ValueError: The extension is unknown, or a label is not 0 to 4.
    """
    name = os.fspath(path)
    if not name.lower().endswith((".label", ".npy")):
        raise ValueError(f"{name}: unknown extension of a label file (expected .label or .npy)")
    if label_map not in ("flagstone", "semantic-kitti"):
        raise ValueError(f"label_map: {label_map!r} is not a label map (expected flagstone or semantic-kitti)")
    codes = np.asarray(labels)
    if codes.ndim != 1 or codes.dtype.kind not in "ui" or (codes.size and not 0 <= codes.min() <= codes.max() <= 4):
        raise ValueError(
            f"labels: {codes.dtype} array of shape {codes.shape} is not supported (expected (N,) integers from 0 to 4)"
        )
    compact = np.ascontiguousarray(codes, np.uint8)
    _core.write_labels(name, compact, label_map == "semantic-kitti", name.lower().endswith(".npy"))


def format_of(path: Path) -> str | None:
    """The format for a file name: "raw", "pcd", "ply" or "npy"; None for other extensions."""
    return _core.format_of(os.fspath(path))


def is_scan_name(path: Path) -> bool:
    """Whether a file found in a directory is treated as a scan.

    Hidden files, label files, height files and files with other extensions are not scans.
    """
    return _core.is_scan_name(os.fspath(path))


def _three_finite(name: str, values: Sequence[float] | npt.NDArray[np.floating[Any]]) -> npt.NDArray[np.float64]:
    numbers = np.asarray(values, np.float64)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise ValueError(f"{name}: {values!r} is not a position (expected three finite numbers x, y, z)")
    return numbers


def _moved(rows: npt.NDArray[np.void], shift: npt.NDArray[np.float64]) -> npt.NDArray[np.void]:
    doubles = {axis: np.dtype(np.float64) for axis in "xyz"}
    moved = np.empty(rows.shape, [(name, doubles.get(name, rows.dtype[name])) for name in rows.dtype.names or ()])
    for name in rows.dtype.names or ():
        moved[name] = rows[name]
    for axis, value in zip("xyz", shift, strict=True):
        moved[axis] -= value
    return moved


def _structured(
    rows: npt.NDArray[np.uint8], fields: list[tuple[str, str, int, int]], stride: int
) -> npt.NDArray[np.void]:
    named = [field for field in fields if field[0] != "_"]  # padding
    dtype = np.dtype(
        {
            "names": [name for name, _, _, _ in named],
            "formats": [(_NPY_OF[kind], (count,)) if count > 1 else _NPY_OF[kind] for _, kind, count, _ in named],
            "offsets": [offset for _, _, _, offset in named],
            "itemsize": stride,
        }
    )
    return rows.view(dtype)


def _rows(points: PointsLike) -> npt.NDArray[np.void]:
    array = np.asarray(points)
    if array.dtype.names is not None:
        return array.reshape(-1)
    if array.ndim == 3:
        array = array.reshape(-1, array.shape[2])
    if array.ndim != 2 or array.shape[1] < 3:
        raise ValueError(
            f"points: shape {array.shape} is not supported (expected (N, 3) or more columns, or fields x, y and z)"
        )
    return records_of(array)


def _with_field(rows: npt.NDArray[np.void], name: str, values: npt.ArrayLike, dtype: Any) -> npt.NDArray[np.void]:
    column = np.asarray(values)
    if column.shape != rows.shape:
        count = rows.shape[0]
        raise ValueError(f"{name}s: shape {column.shape} does not match {count} points (expected ({count},))")
    others = [field for field in rows.dtype.names or () if field != name]
    together = np.empty(rows.shape, [(field, rows.dtype[field]) for field in others] + [(name, dtype)])
    for field in others:
        together[field] = rows[field]
    together[name] = column
    return together


def _fields_of(dtype: np.dtype[np.void]) -> list[tuple[str, str, int, int]]:
    fields = []
    for name in dtype.names or ():
        base, shape = dtype[name].base, dtype[name].shape
        if not base.isnative:
            raise TypeError(f"points: field {name} has dtype {base} (expected native byte order)")
        fields.append((name, base.name, int(np.prod(shape, dtype=int)), 0))
    return fields
