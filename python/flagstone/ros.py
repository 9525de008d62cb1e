# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Serialized point clouds of ROS 1 and ROS 2, without a ROS installation.

The functions read and write the bytes of messages, as raw subscriptions and bags contain them:

    cloud = flagstone.ros.parse(message)  # bytes of a sensor_msgs/msg/PointCloud2
    result = segmenter.segment(cloud)
    labelled = cloud.append({"label": result.labels, "height": result.heights})  # bytes
    ground = cloud.select(result.ground)  # bytes

docs/reference/point-cloud2.md describes the messages and the fields of drivers.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._points import PointsLike, records_of

__all__ = [
    "POINT_CLOUD2",
    "POINT_CLOUD_TYPES",
    "FieldConvention",
    "Header",
    "PointCloud2",
    "PointField",
    "parse",
    "serialize",
]

Buffer = bytes | bytearray | memoryview | npt.NDArray[np.uint8]
Encoding = Literal["cdr", "ros1"]

POINT_CLOUD2 = "sensor_msgs/msg/PointCloud2"
"""The default message type of `parse`."""

_LIVOX_TYPES = tuple(
    f"{package}/msg/CustomMsg" for package in ("livox_ros_driver", "livox_interfaces", "livox_ros_driver2")
)

POINT_CLOUD_TYPES = (POINT_CLOUD2, *_LIVOX_TYPES)
"""The message types that `parse` supports. Names of ROS 1, without `/msg/`, are equivalent."""

# Codes of sensor_msgs/PointField and their NumPy types.
_DTYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8", 9: "i8", 10: "u8", 11: "u1"}
_DATATYPES = {np.dtype(dtype): code for code, dtype in _DTYPES.items() if code != 11} | {np.dtype(np.bool_): 2}


class Header(NamedTuple):
    """std_msgs/Header."""

    seq: int
    """Sequence number of ROS 1; 0 in ROS 2."""
    sec: int
    """Seconds of the time stamp."""
    nanosec: int
    """Nanoseconds of the time stamp, in addition to the seconds."""
    frame_id: str
    """Coordinate frame of the points."""


@dataclass(frozen=True, slots=True)
class PointField:
    """sensor_msgs/PointField: one field of every point."""

    name: str
    offset: int
    """Bytes from the start of a point."""
    datatype: int
    """Code of the type, 1 to 11: int8, uint8, int16, uint16, int32, uint32, float32, float64, int64, uint64, bool."""
    count: int
    """Numbers per point. 0 means 1."""


class FieldConvention(NamedTuple):
    """The convention that the fields of a cloud match, and the fields that it describes."""

    name: str
    """One of "velodyne", "ouster", "hesai" (also RoboSense), "livox", "autoware", "xyz" (any other cloud) and "none"
    (x, y or z is missing)."""
    time: str | None
    """Field with the time of each point."""
    seconds_per_unit: float
    """Seconds per unit of the time: 1 or 1e-9; 0 without such a field."""
    time_reference: str
    """Zero of the time: "header_stamp" (the time stamp of the message) or "clock" (the epoch of the sensor's clock)."""
    ring: str | None
    """Field with the index of the beam."""
    intensity: str | None
    """Field with the strength of the return; its scale depends on the sensor."""


class PointCloud2:
    """A point cloud in a serialized message. Create one with `parse`.

    The arrays are views of the message, which must not change while they are used. `Segmenter.segment` accepts the
    object: NumPy converts it to `xyz`. Threads may share it; `xyz`, `transformed`, `append` and
    `select` release the GIL.
    """

    def __init__(self, core: _core.RosMessage, message: Buffer, encoding: Encoding, is_livox: bool) -> None:
        self._core = core
        self._message = message
        self._encoding: Encoding = encoding
        self._is_livox = is_livox

    def __len__(self) -> int:
        """Number of points, N = height * width."""
        return self.height * self.width

    def __repr__(self) -> str:
        names = ", ".join(field.name for field in self.fields)
        return f"PointCloud2({self.height} x {self.width} points in {self.header.frame_id!r}: {names})"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """`xyz`, for functions that convert their arguments to arrays."""
        array = self.xyz if dtype is None else self.xyz.astype(dtype, copy=False)
        return array.copy() if copy else array

    @property
    def encoding(self) -> Encoding:
        """Serialization of the message, as passed to `parse`."""
        return self._encoding

    @cached_property
    def header(self) -> Header:
        """Time stamp and coordinate frame."""
        return Header(*self._core.header())

    @cached_property
    def fields(self) -> tuple[PointField, ...]:
        """The fields in the order of the message."""
        return tuple(PointField(*field) for field in self._core.fields())

    @property
    def height(self) -> int:
        """Number of rows; 1 if the cloud is not organized."""
        return self._core.height

    @property
    def width(self) -> int:
        """Number of points per row."""
        return self._core.width

    @property
    def point_step(self) -> int:
        """Size of a point in bytes."""
        return self._core.point_step

    @property
    def row_step(self) -> int:
        """Distance between rows in bytes, as the message specifies it."""
        return self._core.row_step

    @property
    def is_bigendian(self) -> bool:
        """Byte order of the numbers in the points. The byte order of the message can differ."""
        return self._core.is_bigendian

    @property
    def is_dense(self) -> bool:
        """Whether the message specifies that all points are valid."""
        return self._core.is_dense

    @property
    def timebase(self) -> int | None:
        """Time of the first point in nanoseconds, for messages of Livox; otherwise None."""
        return self._core.timebase if self._is_livox else None

    @property
    def lidar_id(self) -> int | None:
        """Number of the device, for messages of Livox; otherwise None."""
        return self._core.lidar_id if self._is_livox else None

    @cached_property
    def convention(self) -> FieldConvention:
        """The driver convention of the fields, with the units of the times."""
        return FieldConvention(*self._core.convention())

    @cached_property
    def points(self) -> npt.NDArray[np.void]:
        """(N,), or (height, width) if height is not 1: all fields, as a read-only view of the message.

        Booleans are uint8. Fields without a name, with the name of an earlier field or of an unknown type are omitted.
        """
        offset, row_stride, point_stride = self._core.data_layout()
        order = ">" if self.is_bigendian else "<"
        fields: dict[str, PointField] = {}
        for field in self.fields:
            if field.name and field.datatype in _DTYPES:
                fields.setdefault(field.name, field)
        formats = [
            np.dtype(f"({field.count},){order}{_DTYPES[field.datatype]}")
            if field.count > 1
            else np.dtype(order + _DTYPES[field.datatype])
            for field in fields.values()
        ]
        if not len(self):  # the layout of a cloud without points is not checked
            empty = np.empty(0, list(zip(fields, formats, strict=True)))
            return empty.reshape(self.height, self.width) if self.height != 1 else empty
        dtype = np.dtype(
            {
                "names": list(fields),
                "formats": formats,
                "offsets": [field.offset for field in fields.values()],
                "itemsize": self.point_step,
            }
        )
        is_organized = self.height != 1
        array: npt.NDArray[np.void] = np.ndarray(
            (self.height, self.width) if is_organized else (self.width,),
            dtype,
            self._message,
            offset,
            (row_stride, point_stride) if is_organized else (point_stride,),
        )
        array.flags.writeable = False
        return array

    @cached_property
    def xyz(self) -> npt.NDArray[np.float32]:
        """(N, 3): x, y and z of every point, row by row, in the units of the message (metres by convention of ROS).

        A read-only view of the message if x, y and z are float32, in native byte order and evenly spaced, and rows are
        not padded. Otherwise a copy, converted to float32.

        Raises:
            ValueError: x, y or z is missing, or is not one integer or float per point.
            MemoryError: There is not enough memory.
        """
        layout = self._core.zero_copy_layout() if len(self) else None
        if layout is None:
            return self._core.copied_coordinates()
        data, _, point_stride = self._core.data_layout()
        x, axis_stride = layout
        array: npt.NDArray[np.float32] = np.ndarray(
            (len(self), 3),
            np.float32,
            self._message,
            data + x,
            (point_stride, axis_stride),
        )
        array.flags.writeable = False
        return array

    def transformed(self, rotation: npt.ArrayLike, translation: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """(N, 3): `rotation` @ (x, y, z) + `translation` of every point, row by row, computed in double precision.

        Missing returns, which are all zero, stay all zero; no other point becomes all zero.

        Args:
            rotation: (3, 3) matrix.
            translation: (3,) in the units of the message.

        Raises:
            ValueError: As `xyz`, or an argument has another shape.
            MemoryError: There is not enough memory.
        """
        matrix, shift = np.asarray(rotation, np.float64), np.asarray(translation, np.float64)
        for name, array, shape in (("rotation", matrix, (3, 3)), ("translation", shift, (3,))):
            if array.shape != shape:
                raise ValueError(f"{name}: shape {array.shape} is not supported (expected {shape})")
        return self._core.transformed_coordinates(matrix.reshape(-1).tolist(), shift.tolist())

    def append(self, fields: Mapping[str, npt.ArrayLike]) -> bytes:
        """Returns the message with added fields, and all existing fields unchanged.

        Header, serialization, byte orders, height and width are kept; padding between rows is removed. Added fields
        follow the existing ones in the order of `fields`, each at a multiple of its size. A field that exists already
        is replaced: in its position if it has the same type, otherwise it is removed and its bytes remain unused.

        Args:
            fields: One number per point for each name, (N,) or (height, width): integers, float32 or float64. Booleans
                become uint8. For example {"label": result.labels, "height": result.heights}.

        Returns:
            The serialized sensor_msgs/PointCloud2. For messages of Livox too.

        Raises:
            TypeError: A PointField cannot have the type of an array.
            ValueError: An array does not have one number per point, or the message would exceed 4 GiB.
            MemoryError: There is not enough memory.
        """
        return self._core.append(self._added(fields))

    def select(self, mask: npt.ArrayLike, fields: Mapping[str, npt.ArrayLike] | None = None) -> bytes:
        """Returns the message with some of its points, in their order, and all existing fields unchanged.

        The result has height 1. Header, serialization and byte orders are kept.

        Args:
            mask: (N,) or (height, width) booleans: which points to keep. For example result.ground.
            fields: Fields to add, with one number per point of this cloud, as in `append`.

        Returns:
            The serialized sensor_msgs/PointCloud2. For messages of Livox too.

        Raises:
            TypeError: The mask does not contain booleans, or a PointField cannot have the type of an array.
            ValueError: An array does not have one value per point.
            MemoryError: There is not enough memory.
        """
        kept = np.asarray(mask)
        if kept.dtype != np.bool_:
            raise TypeError(f"mask: dtype {kept.dtype} is not supported (expected bool, such as labels == 1)")
        kept = np.ascontiguousarray(self._one_per_point("mask", kept))
        return self._core.select(kept.view(np.uint8), self._added(fields or {}))

    def _one_per_point(self, name: str, array: npt.NDArray[Any]) -> npt.NDArray[Any]:
        if array.shape not in ((len(self),), (self.height, self.width)):
            raise ValueError(
                f"{name}: shape {array.shape} does not match {self.height} x {self.width} points "
                f"(expected ({len(self)},))"
            )
        return array.reshape(-1)

    def _added(self, fields: Mapping[str, npt.ArrayLike]) -> list[tuple[str, int, npt.NDArray[np.uint8]]]:
        added = []
        for name, values in fields.items():
            column = self._one_per_point(name, np.asarray(values))
            datatype = _datatype_of(name, column.dtype)
            column = np.ascontiguousarray(column, column.dtype.newbyteorder("="))
            added.append((name, datatype, column.view(np.uint8)))
        return added


def parse(message: Buffer, *, encoding: Encoding = "cdr", message_type: str = POINT_CLOUD2) -> PointCloud2:
    """Reads a serialized point cloud without copying its points.

    Args:
        message: Bytes of the message, in any object that supports the buffer protocol. The result keeps a reference.
        encoding: Serialization: "cdr" for ROS 2 (raw subscriptions, rosbag2, MCAP), "ros1" for ROS 1 bags.
        message_type: One of `POINT_CLOUD_TYPES`.

    Returns:
        A view of the message.

    Raises:
        ValueError: The message is truncated, contradicts itself or is of another type; the error is one line with the
            byte and the reason. Or the encoding or the type of the message is unknown.
        MemoryError: There is not enough memory.
    """
    package, _, name = message_type.partition("/")
    full_name = message_type if name.startswith("msg/") else f"{package}/msg/{name}"
    if full_name not in POINT_CLOUD_TYPES:
        raise ValueError(
            f"message_type: {message_type!r} is not a point cloud (expected one of {', '.join(POINT_CLOUD_TYPES)})"
        )
    is_livox = full_name in _LIVOX_TYPES
    return PointCloud2(_core.RosMessage(message, encoding, is_livox), message, encoding, is_livox)


def serialize(
    points: PointsLike,
    *,
    frame_id: str = "",
    stamp: tuple[int, int] = (0, 0),
    seq: int = 0,
    is_dense: bool = False,
    encoding: Encoding = "cdr",
) -> bytes:
    """Serializes points as a little-endian sensor_msgs/PointCloud2.

    Args:
        points: (N,) or (H, W) structured array, whose fields, offsets and padding are kept; or (N, >=3) or
            (H, W, >=3) numbers, whose columns become x, y, z, intensity, ring, c5, c6, ...
        frame_id: Coordinate frame of the points.
        stamp: Seconds and nanoseconds of the time stamp.
        seq: Sequence number; only for "ros1".
        is_dense: Whether all points are valid.
        encoding: "cdr" for ROS 2, "ros1" for ROS 1.

    Returns:
        The serialized message.

    Raises:
        TypeError: A PointField cannot have the type of a field.
        ValueError: The shape is not supported, or a number is out of range.
    """
    rows = _records(points)
    if rows.ndim not in (1, 2):
        raise ValueError(f"points: shape {rows.shape} is not supported (expected (N,) or (H, W) records)")
    sec, nanosec = stamp
    limits = ("int32", -(2**31), 2**31) if encoding == "cdr" else ("uint32", 0, 2**32)
    for name, value, (kind, low, high) in (
        ("stamp", sec, limits),
        ("stamp", nanosec, ("uint32", 0, 2**32)),
        ("seq", seq, ("uint32", 0, 2**32)),
    ):
        if not low <= value < high:
            raise ValueError(f"{name}: {value} is out of range (expected {kind})")
    fields = []
    offsets: Mapping[str, Any] = rows.dtype.fields or {}
    for name in rows.dtype.names or ():
        dtype = rows.dtype[name]
        count = math.prod(dtype.shape)
        fields.append((name, offsets[name][1], _datatype_of(name, dtype.base), count))
    height, width = rows.shape if rows.ndim == 2 else (1, len(rows))
    step = rows.dtype.itemsize
    if height * width * step >= 2**32:
        raise ValueError(
            f"points: {height * width} points of {step} bytes do not fit in a message (expected below 4 GiB)"
        )
    data = rows.reshape(-1).view(np.uint8)
    return _core.serialize_cloud(encoding, (seq, sec, nanosec, frame_id), height, width, fields, step, is_dense, data)


def _records(points: PointsLike) -> npt.NDArray[np.void]:
    array = np.asarray(points)
    if array.dtype.names is None:
        if array.ndim not in (2, 3) or array.shape[-1] < 3:
            raise ValueError(f"points: shape {array.shape} is not supported (expected (N, 3) or more columns)")
        array = records_of(array)
    little = array.dtype.newbyteorder("<")
    if array.dtype == little and array.flags.c_contiguous:
        return array
    copy = np.zeros(array.shape, little)  # NumPy does not copy padding
    copy[...] = array
    return copy


def _datatype_of(name: str, dtype: np.dtype[Any]) -> int:
    datatype = _DATATYPES.get(dtype.newbyteorder("="))
    if datatype is None:
        raise TypeError(f"{name}: dtype {dtype} is not supported (expected integers, float32, float64 or bool)")
    return datatype
