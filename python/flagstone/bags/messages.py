# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The parts of messages that poses need, from serialized messages: accelerations, transforms and odometry."""

from __future__ import annotations

import struct
from typing import Any, NamedTuple

Vector = tuple[float, float, float]


class ImuSample(NamedTuple):
    """A part of sensor_msgs/Imu."""

    frame: str
    acceleration: Vector
    """linear_acceleration in the frame. At rest it points up (REP 145)."""


class FrameTransform(NamedTuple):
    """geometry_msgs/TransformStamped, without its time. Maps coordinates in `child` to coordinates in `parent`."""

    parent: str
    child: str
    translation: Vector
    """Metres."""
    rotation: tuple[float, float, float, float]
    """Quaternion x, y, z, w; may have any length."""


class StampedPose(NamedTuple):
    """A part of nav_msgs/Odometry, geometry_msgs/PoseStamped or geometry_msgs/PoseWithCovarianceStamped."""

    time: int
    """Nanoseconds; 0 if the message has no time."""
    frame: str
    """Frame in which the pose is measured."""
    body: str | None
    """Frame that the pose describes; None if the message does not name it."""
    position: Vector
    """Metres."""
    rotation: tuple[float, float, float, float]
    """Quaternion x, y, z, w; may have any length."""


def parse_imu(message: Any, encoding: str) -> ImuSample:
    """Reads a serialized sensor_msgs/Imu, "cdr" or "ros1".

    Raises:
        ValueError: The message is too short or has an unknown encoding. One line with the byte.
    """
    reader = _Reader(message, encoding)
    _, frame = reader.header()
    reader.numbers("d", 4 + 9 + 3 + 9)  # orientation, angular velocity, covariances
    x, y, z = reader.numbers("d", 3)
    return ImuSample(frame, (x, y, z))


def parse_transforms(message: Any, encoding: str) -> list[FrameTransform]:
    """Reads a serialized tf2_msgs/TFMessage, "cdr" or "ros1".

    Raises:
        ValueError: The message is too short or has an unknown encoding. One line with the byte.
    """
    return [transform for _, transform in parse_timed_transforms(message, encoding)]


def parse_timed_transforms(message: Any, encoding: str) -> list[tuple[int, FrameTransform]]:
    """As `parse_transforms`, with the time of each transform in nanoseconds."""
    reader = _Reader(message, encoding)
    transforms = []
    for _ in range(reader.numbers("I", 1)[0]):
        time, parent = reader.header()
        child = reader.frame()
        tx, ty, tz, x, y, z, w = reader.numbers("d", 7)
        transforms.append((time, FrameTransform(parent, child, (tx, ty, tz), (x, y, z, w))))
    return transforms


def parse_pose(message: Any, encoding: str, *, names_body: bool) -> StampedPose:
    """Reads the time and the pose of a serialized message, "cdr" or "ros1".

    Args:
        message: The message.
        encoding: Its serialization.
        names_body: Whether the frame of the body follows the header, as in nav_msgs/Odometry.

    Raises:
        ValueError: The message is too short or has an unknown encoding. One line with the byte.
    """
    reader = _Reader(message, encoding)
    time, frame = reader.header()
    body = reader.frame() if names_body else None
    px, py, pz, x, y, z, w = reader.numbers("d", 7)
    return StampedPose(time, frame, body, (px, py, pz), (x, y, z, w))


class _Reader:
    """Reads members of a message one after the other."""

    def __init__(self, message: Any, encoding: str) -> None:
        self._bytes = memoryview(message).cast("B")
        self._aligns = encoding == "cdr"
        self._order = "<"
        self._at = 0
        if self._aligns:
            kind = bytes(self._take(4))[:2]
            if kind not in (b"\0\0", b"\0\1"):
                raise ValueError(f"byte 0: encapsulation {kind.hex()} is not supported (expected 0000 or 0001)")
            self._order = "<" if kind[1] else ">"

    def numbers(self, kind: str, count: int) -> tuple[Any, ...]:
        """`count` numbers of one type of the module struct."""
        size = struct.calcsize(kind)
        if self._aligns:  # relative to the end of the encapsulation header
            self._at += -(self._at - 4) % size
        return struct.unpack(f"{self._order}{count}{kind}", self._take(size * count))

    def header(self) -> tuple[int, str]:
        """The time in nanoseconds and the frame of a std_msgs/Header."""
        if not self._aligns:
            self.numbers("I", 1)  # the sequence number of ROS 1
        seconds, nanoseconds = self.numbers("I", 2)
        return seconds * 10**9 + nanoseconds, self.frame()

    def frame(self) -> str:
        """The name of a frame, without the slash that ROS 1 permits before it."""
        (length,) = self.numbers("I", 1)
        return bytes(self._take(length)).rstrip(b"\0").decode("utf-8", "replace").removeprefix("/")

    def _take(self, size: int) -> memoryview:
        begin, end = self._at, self._at + size
        if end > len(self._bytes):
            raise ValueError(
                f"byte {begin}: {size} bytes are expected, but the message ends at byte {len(self._bytes)} "
                "(it may be truncated or of another type)"
            )
        self._at = end
        return self._bytes[begin:end]
