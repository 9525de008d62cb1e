# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Any points people have, as three columns that the compiled part reads where they lie."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

# What the points of a scan are given as: a NumPy array, or what DLPack, the buffer protocol or NumPy's own
# conversion make one of. Nothing narrower says it, since pandas, torch and others share no base class.
PointsLike = Any

Column = npt.NDArray[np.float32] | npt.NDArray[np.float64]

_WANTED = "wanted is (N, 3) or more columns, float32 or float64: x, y, z in metres"
_CPU_DEVICES = (1, 3)  # DLPack's kDLCPU, and kDLCUDAHost: host memory too
# No scan has so few points with so many columns: rows and columns were exchanged.
_FEW_ROWS, _MANY_COLUMNS = 8, 8


def columns_of(points: PointsLike) -> tuple[Column, Column, Column]:
    """x, y and z of every point: views of the caller's memory, or a conversion where the type asks for one.

    Args:
        points: An array of shape (N, >=3), or an array with fields or a frame with columns x, y and z.

    Returns:
        Three arrays of shape (N,), each float32 or float64 in this machine's byte order.

    Raises:
        TypeError: These are no points in the processor's memory, or not of floats.
        ValueError: The shape is another.
    """
    if _has_named_columns(points):
        return _named_columns(points)
    array = _array_of(points)
    if array.dtype.names is not None:
        return _named_columns(array)
    kind = f"{type(points).__name__} of shape {array.shape}"
    if array.ndim != 2 or array.shape[1] < 3:
        hint = "; pass points.T if coordinates go down the rows" if array.ndim == 2 and array.shape[0] == 3 else ""
        raise ValueError(f"points: {kind}; {_WANTED}{hint}")
    if array.shape[0] <= _FEW_ROWS and array.shape[1] > _MANY_COLUMNS:
        raise ValueError(f"points: {kind}; {_WANTED}, a point a row: pass points.T")
    array = _floats(array, "points")
    return array[:, 0], array[:, 1], array[:, 2]


def _has_named_columns(points: PointsLike) -> bool:
    """Whether it is a frame: of pandas, polars or alike."""
    return hasattr(points, "columns") and hasattr(points, "__getitem__") and not isinstance(points, np.ndarray)


def _named_columns(points: PointsLike) -> tuple[Column, Column, Column]:
    names = list(points.dtype.names) if isinstance(points, np.ndarray) else [str(name) for name in points.columns]
    missing = [name for name in ("x", "y", "z") if name not in names]
    if missing:
        raise ValueError(f"points: no {' and no '.join(missing)} among the fields {', '.join(names)}; {_WANTED}")
    x, y, z = (_floats(np.asarray(points[name]), f"points: field {name}") for name in ("x", "y", "z"))
    for name, column in (("x", x), ("y", y), ("z", z)):
        if column.ndim != 1:
            raise ValueError(f"points: field {name} of shape {column.shape}; wanted is one number a point, (N,)")
    return x, y, z


def _array_of(points: PointsLike) -> npt.NDArray[Any]:
    if isinstance(points, np.ndarray):
        return points
    if hasattr(points, "__dlpack__"):
        try:
            device = int(points.__dlpack_device__()[0])
            if device in _CPU_DEVICES:
                return np.from_dlpack(points)
        except (BufferError, RuntimeError, TypeError, ValueError) as error:
            reason = " ".join(str(error).split())
            raise TypeError(f"points: {type(points).__name__} cannot be read: {reason}; {_WANTED}") from error
        raise TypeError(
            f"points: {type(points).__name__} in the memory of another device (DLPack's type {device}); "
            "flagstone reads the processor's: copy them there first, with torch points.cpu()"
        )
    try:
        return np.asarray(points)
    except ValueError as error:
        raise TypeError(f"points: {type(points).__name__} is no array: {error}; {_WANTED}") from error


def _floats(array: npt.NDArray[Any], what: str) -> Column:
    if array.dtype.kind != "f" or array.dtype.itemsize not in (4, 8):
        raise TypeError(
            f"{what}: numbers of type {array.dtype}; wanted is float32 or float64 in metres: "
            "convert with points.astype(numpy.float32)"
        )
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))
