# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Shared by the tests of `flagstone bag`: bags of scans with five other topics, written and read by rosbags."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from conftest import random_scan
from rosbags.rosbag1 import Reader as Reader1
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import Reader as Reader2
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from flagstone import _command, ros

FORMATS = ("rosbag1", "sqlite3", "mcap")
START = 1_700_000_000_000_000_000
PERIOD = 100_000_000  # nanoseconds between clouds
FRAME = "lidar"
IMU_PER_CLOUD = 5
UNKNOWN_TYPE = "acme_msgs/msg/Telemetry"
Points = npt.NDArray[np.float32]
Record = tuple[str, int, bytes]
"""Topic, log time and bytes of a message."""


@cache
def typestore(format: str) -> Any:
    """The message types of ROS, and one that only its bag defines."""
    store = get_typestore(Stores.ROS1_NOETIC if format == "rosbag1" else Stores.ROS2_HUMBLE)
    store.register(get_types_from_msg("uint32 counter\nstring text\nfloat64[] values\n", UNKNOWN_TYPE))
    if "tf2_msgs/msg/TFMessage" not in store.types:
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", "tf2_msgs/msg/TFMessage"))
    return store


def serialized(format: str, message: Any) -> bytes:
    """The message in the encoding of the format."""
    store = typestore(format)
    serialize = store.serialize_ros1 if format == "rosbag1" else store.serialize_cdr
    return bytes(serialize(message, message.__msgtype__))


def header(format: str, time: int, frame: str) -> Any:
    """std_msgs/Header."""
    store = typestore(format)
    stamp = store.types["builtin_interfaces/msg/Time"](sec=time // 10**9, nanosec=time % 10**9)
    values = {"seq": 0} if format == "rosbag1" else {}
    return store.types["std_msgs/msg/Header"](**values, stamp=stamp, frame_id=frame)


def imu(format: str, time: int, frame: str = "imu", acceleration: Iterable[float] = (0, 0, 9.81)) -> bytes:
    """sensor_msgs/Imu."""
    types = typestore(format).types
    x, y, z = acceleration
    vector = types["geometry_msgs/msg/Vector3"]
    nine = np.zeros(9)
    message = types["sensor_msgs/msg/Imu"](
        header=header(format, time, frame),
        orientation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
        orientation_covariance=nine,
        angular_velocity=vector(x=0.0, y=0.0, z=0.0),
        angular_velocity_covariance=nine,
        linear_acceleration=vector(x=float(x), y=float(y), z=float(z)),
        linear_acceleration_covariance=nine,
    )
    return serialized(format, message)


Transform = tuple[str, str, tuple[float, float, float], tuple[float, float, float, float]]
"""Parent, child, translation, quaternion x, y, z, w."""


def transforms(format: str, time: int, entries: Iterable[Transform]) -> bytes:
    """tf2_msgs/TFMessage."""
    types = typestore(format).types
    stamped = []
    for parent, child, (tx, ty, tz), (x, y, z, w) in entries:
        transform = types["geometry_msgs/msg/Transform"](
            translation=types["geometry_msgs/msg/Vector3"](x=tx, y=ty, z=tz),
            rotation=types["geometry_msgs/msg/Quaternion"](x=x, y=y, z=z, w=w),
        )
        stamped.append(
            types["geometry_msgs/msg/TransformStamped"](
                header=header(format, time, parent), child_frame_id=child, transform=transform
            )
        )
    return serialized(format, types["tf2_msgs/msg/TFMessage"](transforms=stamped))


def image(format: str, time: int, random: np.random.Generator) -> bytes:
    """sensor_msgs/Image."""
    message = typestore(format).types["sensor_msgs/msg/Image"](
        header=header(format, time, "camera"),
        height=8,
        width=16,
        encoding="mono8",
        is_bigendian=0,
        step=16,
        data=random.integers(0, 256, 128, np.uint8),
    )
    return serialized(format, message)


def odometry(format: str, time: int) -> bytes:
    """nav_msgs/Odometry."""
    types = typestore(format).types
    pose = types["geometry_msgs/msg/Pose"](
        position=types["geometry_msgs/msg/Point"](x=1.0, y=2.0, z=0.0),
        orientation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
    )
    zero = types["geometry_msgs/msg/Vector3"](x=0.0, y=0.0, z=0.0)
    message = types["nav_msgs/msg/Odometry"](
        header=header(format, time, "odom"),
        child_frame_id="base_link",
        pose=types["geometry_msgs/msg/PoseWithCovariance"](pose=pose, covariance=np.zeros(36)),
        twist=types["geometry_msgs/msg/TwistWithCovariance"](
            twist=types["geometry_msgs/msg/Twist"](linear=zero, angular=zero), covariance=np.zeros(36)
        ),
    )
    return serialized(format, message)


def telemetry(format: str, counter: int) -> bytes:
    """A type that only the bag defines."""
    message = typestore(format).types[UNKNOWN_TYPE](
        counter=counter, text="x" * counter, values=np.arange(counter, dtype=float)
    )
    return serialized(format, message)


TYPES = {
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/imu": "sensor_msgs/msg/Imu",
    "/camera": "sensor_msgs/msg/Image",
    "/odom": "nav_msgs/msg/Odometry",
    "/telemetry": UNKNOWN_TYPE,
}


def scans(count: int, points: int = 3000) -> list[Points]:
    """(points, 4) scans that differ."""
    return [random_scan(points, seed) for seed in range(count)]


def cloud(format: str, points: npt.NDArray[Any], time: int, frame: str = FRAME) -> bytes:
    """sensor_msgs/PointCloud2."""
    stamp = time // 10**9, time % 10**9
    return ros.serialize(points, frame_id=frame, stamp=stamp, encoding="ros1" if format == "rosbag1" else "cdr")


def scene(
    format: str,
    clouds: list[Points],
    *,
    topic: str = "/points",
    frame: str = FRAME,
    static: Iterable[Transform] = (("base_link", "lidar", (0.0, 0.0, 1.73), (0.0, 0.0, 0.0, 1.0)),),
    imu_frame: str = FRAME,
    acceleration: Iterable[float] = (0, 0, 9.81),
) -> list[Record]:
    """Messages of a recording: one cloud every 100 ms among five other topics."""
    random = np.random.default_rng(1)
    records: list[Record] = [("/tf_static", START, transforms(format, START, static))]
    for index, points in enumerate(clouds):
        time = START + index * PERIOD
        records.append((topic, time, cloud(format, points, time, frame)))
        for part in range(IMU_PER_CLOUD):
            when = time + part * PERIOD // IMU_PER_CLOUD + 1
            records.append(("/imu", when, imu(format, when, imu_frame, acceleration)))
        records.append(("/camera", time + 3, image(format, time, random)))
        records.append(("/odom", time + 4, odometry(format, time)))
        records.append(("/telemetry", time + 5, telemetry(format, index)))
    return sorted(records, key=lambda record: record[1])


def bag_name(format: str, stem: str = "drive") -> str:
    """A name for a bag; rosbag2 writes directories."""
    return f"{stem}.bag" if format == "rosbag1" else stem


def write_bag(path: Path, format: str, records: Iterable[Record], types: dict[str, str] | None = None) -> Path:
    """Writes messages with rosbags. `types`: of topics that TYPES does not contain (default: PointCloud2)."""
    store = typestore(format)
    kinds = {**TYPES, **(types or {})}
    if format == "rosbag1":
        writer: Any = Writer1(path)
    else:
        writer = Writer2(
            path, version=9, storage_plugin=StoragePlugin.MCAP if format == "mcap" else StoragePlugin.SQLITE3
        )
    with writer:
        connections: dict[str, Any] = {}
        for topic, time, data in records:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kinds.get(topic, ros.POINT_CLOUD2), typestore=store)
            writer.write(connections[topic], time, data)
    return path


def read_bag(path: Path) -> list[Record]:
    """All messages in the order of the bag, read with rosbags."""
    reader: Any = Reader1(path) if path.suffix == ".bag" else Reader2(path)
    with reader:
        return [(connection.topic, time, bytes(data)) for connection, time, data in reader.messages()]


def of_topic(records: Iterable[Record], topic: str) -> list[Record]:
    """The messages of one topic."""
    return [record for record in records if record[0] == topic]


def parse(format: str, data: bytes) -> ros.PointCloud2:
    """The cloud in a message."""
    return ros.parse(data, encoding="ros1" if format == "rosbag1" else "cdr")


def run(
    *arguments: str | Path, before: Callable[[], None] | None = None, timeout: float = 120
) -> subprocess.CompletedProcess[str]:
    """Runs the command as an installation does."""
    command = [str(_command.path()), *map(str, arguments)]
    return subprocess.run(
        command,
        capture_output=True,
        text=True,
        timeout=timeout,
        env=_command.environment(),
        preexec_fn=before,
        check=False,
    )
