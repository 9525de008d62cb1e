# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Files of points and of labels: the readers and writers of the command.

Which formats there are, and what each may hold, says docs/reference/file-formats.md.
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
from flagstone._points import PointsLike

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
_NAMES_OF_COLUMNS = ("x", "y", "z", "intensity", "ring")  # as files without names have them


def read(
    path: Path, *, columns: int | None = None, origin: Sequence[float] | npt.NDArray[np.floating[Any]] | None = None
) -> npt.NDArray[np.void]:
    """Reads a scan with every field its file has.

    Args:
        path: .bin, .pcd.bin, .pcd, .ply, .npy, .las or .laz; the name says the format.
        columns: Floats a point of raw files (.bin), 3 to 1,024; without it 5 for .pcd.bin, else 4.
        origin: x, y, z in the file's coordinates that become 0: where the sensor stood, for files in coordinates of a
            map, which 32-bit floats would round to decimetres. x, y and z are float64 then.

    Returns:
        (N,) structured array with the fields x, y, z and whatever else there is, in the file's order. It can be handed
        to `segment` as it is. Of LAS and LAZ: x, y, z as float64, then the dimensions by their names in laspy, such as
        `intensity`, `return_number`, `classification`, `gps_time`; flags as 0 and 1; then the extra bytes.

    Raises:
        FileNotFoundError: There is no such file.
        ImportError: LAS and LAZ need laspy: pip install 'flagstone[las]'.
        OSError: The system would not read it.
        ValueError: Its contents are not what its format allows, or its ending is not known; one line with file, byte
            and reason. Or `origin` is not three finite numbers.
        MemoryError: It is larger than the memory.
    """
    shift = None if origin is None else _three_finite("origin", origin)
    rows = _las.read(path) if _las.is_las(path) else _read_by_core(path, columns)
    return rows if shift is None else _moved(rows, shift)


def _read_by_core(path: Path, columns: int | None) -> npt.NDArray[np.void]:
    if columns is not None and not isinstance(columns, int):
        raise TypeError(f"columns = {columns!r} is not a whole number")
    return _structured(*_core.read_cloud(os.fspath(path), 0 if columns is None else columns))


def parse(data: bytes | bytearray | memoryview, format: str, *, columns: int = 4) -> npt.NDArray[np.void]:
    """The same for a file's bytes in memory.

    Args:
        data: The bytes of the file.
        format: "raw", "pcd", "ply" or "npy"; `format_of` says which from a name.
        columns: Floats a point of raw files.

    Returns:
        As `read`.

    Raises:
        ValueError: As `read`, without the file's name.
    """
    return _structured(*_core.parse_cloud(np.frombuffer(data, np.uint8), format, columns))


def write(
    path: Path,
    points: PointsLike,
    *,
    labels: npt.ArrayLike | None = None,
    heights: npt.ArrayLike | None = None,
) -> None:
    """Writes a scan; the file is there whole or not at all.

    Args:
        path: .bin, .pcd, .ply, .npy, .las or .laz; the name says the format. LAS and LAZ are of version 1.4, point
            format 6, 7 with fields `red`, `green`, `blue`, 8 with `nir` too; coordinates are rounded to a millimetre,
            a floating `intensity` of 0 to 1 is spread over 16 bits, fields that LAS does not know are extra bytes.
        points: (N,) structured array with fields x, y and z, or (N, >=3) numbers, whose columns become x, y, z,
            intensity, ring, c5, c6, ...; organized clouds, (H, W) and (H, W, >=3), are written row by row.
        labels: (N,) codes; become a field `label`, uint8. In LAS and LAZ they set `classification` as `classify_las`
            does.
        heights: (N,) metres; become a field `height`, float32.

    Raises:
        ImportError: LAS and LAZ need laspy: pip install 'flagstone[las]'.
        OSError: The system would not write it.
        TypeError: A field is of a type that no format holds.
        ValueError: The format cannot hold a field, or lengths differ.
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
    """Reads one class a point: labels of this program, or a data set's truth.

    Args:
        path: .label (SemanticKITTI: uint32, the class in the low 16 bits), .bin (nuScenes-lidarseg: uint8) or .npy.
        points: How many points the scan has that they belong to.

    Returns:
        (points,) classes, without the instances of .label files.

    Raises:
        FileNotFoundError: There is no such file.
        ValueError: It holds another number of labels, or is no such file.
    """
    return _core.read_classes(os.fspath(path), points)


def write_labels(
    path: Path, labels: npt.ArrayLike, *, label_map: Literal["flagstone", "semantic-kitti"] = "flagstone"
) -> None:
    """Writes one label a point; the file is there whole or not at all.

    Args:
        path: .label (SemanticKITTI's layout: uint32) or .npy (uint8); the name says the format.
        labels: (N,) codes, 0 to 4.
        label_map: What number stands for a label: "flagstone", its own code; "semantic-kitti", 40 (road) for ground
            and 0 (unlabelled) for all else.

    Raises:
        OSError: The system would not write it.
        ValueError: The ending is another, or a code is none.
    """
    name = os.fspath(path)
    if not name.lower().endswith((".label", ".npy")):
        raise ValueError(f"{name}: labels are written as .label or .npy")
    if label_map not in ("flagstone", "semantic-kitti"):
        raise ValueError(f"label_map = {label_map!r} is not known; there are flagstone and semantic-kitti")
    codes = np.asarray(labels)
    if codes.ndim != 1 or codes.dtype.kind not in "ui" or (codes.size and not 0 <= codes.min() <= codes.max() <= 4):
        raise ValueError(f"{name}: labels are whole numbers from 0 to 4 in one row; came {codes.dtype} {codes.shape}")
    compact = np.ascontiguousarray(codes, np.uint8)
    _core.write_labels(name, compact, label_map == "semantic-kitti", name.lower().endswith(".npy"))


def format_of(path: Path) -> str | None:
    """The format that a name stands for, "raw", "pcd", "ply" or "npy"; None for other endings."""
    return _core.format_of(os.fspath(path))


def is_scan_name(path: Path) -> bool:
    """Whether a file met in a folder is taken for a scan: by its ending, not hidden, not one of labels or heights."""
    return _core.is_scan_name(os.fspath(path))


def _three_finite(name: str, values: Sequence[float] | npt.NDArray[np.floating[Any]]) -> npt.NDArray[np.float64]:
    numbers = np.asarray(values, np.float64)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise ValueError(f"{name} = {values!r}; wanted are x, y, z, three finite numbers in the file's coordinates")
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
        raise ValueError(f"points: shape {array.shape}; wanted is (N, 3) or more columns, or fields x, y and z")
    names = [*_NAMES_OF_COLUMNS, *(f"c{i}" for i in range(len(_NAMES_OF_COLUMNS), array.shape[1]))]
    dtype = np.dtype([(name, array.dtype) for name in names[: array.shape[1]]])
    return numpy.lib.recfunctions.unstructured_to_structured(array, dtype)


def _with_field(rows: npt.NDArray[np.void], name: str, values: npt.ArrayLike, dtype: Any) -> npt.NDArray[np.void]:
    column = np.asarray(values)
    if column.shape != rows.shape:
        raise ValueError(f"{name}s of shape {column.shape} for {rows.shape[0]} points; wanted is one a point")
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
            raise TypeError(f"field {name} is of type {base}; wanted are numbers in this machine's byte order")
        fields.append((name, base.name, int(np.prod(shape, dtype=int)), 0))
    return fields
