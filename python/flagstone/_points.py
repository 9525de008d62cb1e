# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Conversion of points of any supported type to three columns, zero-copy if possible."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.lib.recfunctions
import numpy.typing as npt

# A NumPy array, or any object that DLPack, the buffer protocol or NumPy can convert to one. The type cannot be
# narrower, because the classes of pandas, PyArrow, torch and others have no common base class.
PointsLike = Any

Column = npt.NDArray[np.float32] | npt.NDArray[np.float64]

_EXPECTED = "expected (N, 3) or more columns, float32 or float64: x, y, z in metres"
_CPU_DEVICES = (1, 3)  # kDLCPU and kDLCUDAHost of DLPack; both are host memory
# Up to this many rows with more than this many columns: the array is probably transposed.
_FEW_ROWS, _MANY_COLUMNS = 8, 8
_MAX_FIELDS_NAMED = 8  # in an error message
_COLUMN_NAMES = ("x", "y", "z", "intensity", "ring")  # of arrays without field names


def columns_of(points: PointsLike) -> tuple[Column, Column, Column]:
    """Returns x, y and z of every point: views of the caller's memory if the type allows it, otherwise copies.

    Args:
        points: An array of shape (N, >=3) or (H, W, >=3); or a structured array, data frame or table with columns
            x, y and z. Organized clouds (H, W) become N = H * W points, row by row.

    Returns:
        Three arrays of shape (N,), each float32 or float64 in native byte order.

    Raises:
        TypeError: The points are not floats, or not in CPU memory.
        ValueError: The shape is not supported, or a column is missing.
    """
    names = _column_names(points)
    if names is not None:
        return _named_columns(points, names)
    array = _array_of(points)
    if array.dtype.names is not None:
        return _named_columns(array, array.dtype.names)
    kind = f"{type(points).__name__} of shape {array.shape}"
    if array.ndim == 3 and array.shape[2] >= 3:
        if array.shape[0] <= _FEW_ROWS and array.shape[2] > _MANY_COLUMNS:
            raise ValueError(f"points: {kind} ({_EXPECTED} in the last axis; pass numpy.moveaxis(points, 0, -1))")
        array = array.reshape(-1, array.shape[2])
    if array.ndim != 2 or array.shape[1] < 3:
        hint = "; if each row is a coordinate, pass points.T" if array.ndim == 2 and array.shape[0] == 3 else ""
        raise ValueError(f"points: {kind} ({_EXPECTED}{hint})")
    if array.shape[0] <= _FEW_ROWS and array.shape[1] > _MANY_COLUMNS:
        raise ValueError(f"points: {kind} ({_EXPECTED}, one point per row; pass points.T)")
    array = _floats(array, "points")
    return array[:, 0], array[:, 1], array[:, 2]


def records_of(array: npt.NDArray[Any]) -> npt.NDArray[np.void]:
    """The last axis as fields x, y, z, intensity, ring, c5, c6, ... of a structured array."""
    count = array.shape[-1]
    names = [*_COLUMN_NAMES, *(f"c{i}" for i in range(len(_COLUMN_NAMES), count))][:count]
    return numpy.lib.recfunctions.unstructured_to_structured(array, np.dtype([(name, array.dtype) for name in names]))


def _column_names(points: PointsLike) -> Sequence[str] | None:
    """Column names of a data frame (pandas, polars) or table (PyArrow), otherwise None."""
    if isinstance(points, np.ndarray):
        return None
    for attribute in ("column_names", "columns"):
        names = getattr(points, attribute, None)
        if names is not None and hasattr(points, "__getitem__"):
            return [str(name) for name in names]
    return None


def _named_columns(points: PointsLike, names: Sequence[str]) -> tuple[Column, Column, Column]:
    missing = [name for name in ("x", "y", "z") if name not in names]
    if missing:
        others = f" and {len(names) - _MAX_FIELDS_NAMED} more" if len(names) > _MAX_FIELDS_NAMED else ""
        raise ValueError(
            f"points: no field named {' or '.join(missing)} (expected x, y and z, float32 or float64, in metres; "
            f"found {', '.join(names[:_MAX_FIELDS_NAMED])}{others})"
        )
    columns = [np.asarray(points[name]) for name in ("x", "y", "z")]
    shape = points.shape if isinstance(points, np.ndarray) else columns[0].shape[:1]
    for name, column in zip("xyz", columns, strict=True):
        if column.shape != shape or len(shape) not in (1, 2):
            raise ValueError(f"points: field {name} has shape {column.shape} (expected (N,), one number per point)")
    x, y, z = (
        _floats(column.reshape(-1), f"points: field {name}") for name, column in zip("xyz", columns, strict=True)
    )
    return x, y, z


def _array_of(points: PointsLike) -> npt.NDArray[Any]:
    if isinstance(points, np.ndarray):
        return points
    if isinstance(points, (str, os.PathLike)):
        path = os.fspath(points)
        raise TypeError(f"points: {path!r} is a path (read the file first: segment(flagstone.io.read({path!r})))")
    if type(points).__module__.partition(".")[0] == "laspy":
        raise TypeError(
            f"points: {type(points).__name__} of laspy contains map coordinates (expected coordinates relative to the "
            "sensor; for a sensor at x, y, z: segment(flagstone.io.read(FILE, origin=(x, y, z))))"
        )
    if hasattr(points, "__dlpack__"):
        return _from_dlpack(points)
    try:
        return np.asarray(points)
    except ValueError as error:
        if hasattr(points, "__array__"):  # the object explains its own error, as flagstone.ros.PointCloud2 does
            raise
        raise TypeError(f"points: {type(points).__name__} is not an array: {error} ({_EXPECTED})") from error


def _from_dlpack(points: PointsLike) -> npt.NDArray[Any]:
    try:
        device = points.__dlpack_device__()[0]
        number = getattr(device, "value", device)  # Open3D returns an enum that int() does not accept
        if not isinstance(number, int) or number in _CPU_DEVICES:
            return np.from_dlpack(points)
    except (BufferError, RuntimeError, TypeError, ValueError) as error:
        reason = " ".join(str(error).split())
        raise TypeError(f"points: {type(points).__name__} cannot be read: {reason} ({_EXPECTED})") from error
    raise TypeError(
        f"points: {type(points).__name__} is in the memory of another device, DLPack type {number} "
        "(copy it to the CPU first; with torch: points.cpu())"
    )


def _floats(array: npt.NDArray[Any], what: str) -> Column:
    if array.dtype.kind != "f" or array.dtype.itemsize not in (4, 8):
        raise TypeError(
            f"{what}: dtype {array.dtype} is not supported (expected float32 or float64, in metres; "
            "convert with points.astype(numpy.float32))"
        )
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))
