# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Bags for tests: written and read by rosbags, and with damage."""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from flagstone.bags import Bag, Message, create_bag, open_bag

for package in ("rosbags", "ruamel.yaml"):
    pytest.importorskip(package, reason="rosbags is not installed (pip install 'flagstone[bag]')")
rosbag1 = importlib.import_module("rosbags.rosbag1")
rosbag2 = importlib.import_module("rosbags.rosbag2")
interfaces = importlib.import_module("rosbags.interfaces")
typesys = importlib.import_module("rosbags.typesys")

CLOUD = "sensor_msgs/msg/PointCloud2"
IMU = "sensor_msgs/msg/Imu"


class Row(NamedTuple):
    """A message, to compare bags."""

    topic: str
    time: int
    data: bytes


@dataclass(frozen=True)
class Kind:
    """A format with a compression."""

    format: str
    mode: str = ""
    """Unit of compression in rosbag2, name of the compression in ROS 1."""

    def __str__(self) -> str:
        return f"{self.format}-{self.mode}" if self.mode else self.format

    @property
    def types(self) -> Any:
        stores = typesys.Stores
        return typesys.get_typestore(stores.ROS1_NOETIC if self.format == "rosbag1" else stores.LATEST)

    def path(self, folder: Path, name: str) -> Path:
        """Path of a bag of this kind."""
        return folder / (f"{name}.bag" if self.format == "rosbag1" else name)


KINDS = [
    Kind("rosbag1"),
    Kind("rosbag1", "lz4"),
    Kind("rosbag1", "bz2"),
    Kind("sqlite3"),
    Kind("sqlite3", "message"),
    Kind("sqlite3", "file"),
    Kind("mcap"),
    Kind("mcap", "storage"),
    Kind("mcap", "message"),
    Kind("mcap", "file"),
]
ROS2_KINDS = [kind for kind in KINDS if kind.format != "rosbag1"]
QOS = interfaces.Qos(
    interfaces.QosHistory.KEEP_LAST,
    7,
    interfaces.QosReliability.BEST_EFFORT,
    interfaces.QosDurability.VOLATILE,
    interfaces.QosTime(1, 2),
    interfaces.QosTime(3, 4),
    interfaces.QosLiveliness.AUTOMATIC,
    interfaces.QosTime(5, 6),
    False,
)


def some_rows(count: int = 12, size: int = 900) -> list[Row]:
    """Messages of two topics in the order of their times."""
    rows = []
    for i in range(count):
        rows.append(Row("/imu", 10**18 + 2 * i * 10**7, os.urandom(30)))
        rows.append(Row("/points", 10**18 + (2 * i + 1) * 10**7, os.urandom(size // 2) + bytes(size // 2)))
    return rows


def write_by_rosbags(folder: Path, kind: Kind, rows: Iterable[Row], *, name: str = "in", version: int = 9) -> Path:
    """Writes a bag with rosbags. Topics that contain "points" are clouds, all others IMU data."""
    path = kind.path(folder, name)
    if kind.format == "rosbag1":
        writer = rosbag1.Writer(path)
        if kind.mode:
            writer.set_compression(rosbag1.Writer.CompressionFormat[kind.mode.upper()])
    else:
        writer = rosbag2.Writer(path, version=version, storage_plugin=rosbag2.StoragePlugin[kind.format.upper()])
        if kind.mode:
            writer.set_compression(rosbag2.CompressionMode[kind.mode.upper()], rosbag2.CompressionFormat.ZSTD)
        writer.set_custom_data("vehicle", "12")
    types = kind.types
    with writer:
        connections: dict[str, Any] = {}
        for topic, time, data in rows:
            if topic not in connections:
                options = (
                    {"callerid": "/driver", "latching": 1}
                    if kind.format == "rosbag1"
                    else {"offered_qos_profiles": [QOS]}
                )
                type_name = CLOUD if "points" in topic else IMU
                connections[topic] = writer.add_connection(topic, type_name, typestore=types, **options)
            writer.write(connections[topic], time, data)
    return path


def read_by_rosbags(path: Path) -> list[Row]:
    """All messages in the order of their times, by rosbags."""
    with (rosbag1 if path.suffix == ".bag" else rosbag2).Reader(path) as reader:
        return [Row(connection.topic, time, bytes(data)) for connection, time, data in reader.messages()]


def connections_by_rosbags(path: Path) -> dict[str, Any]:
    """The connections by topic, by rosbags."""
    with (rosbag1 if path.suffix == ".bag" else rosbag2).Reader(path) as reader:
        return {connection.topic: connection for connection in reader.connections}


def rows_of(messages: Iterable[Message]) -> list[Row]:
    """Messages of flagstone."""
    return [Row(message.topic.name, message.log_time, bytes(message.data)) for message in messages]


def read(path: Path) -> tuple[list[Row], list[str]]:
    """All messages and the reported lines."""
    lines: list[str] = []
    with open_bag(path, report=lines.append) as bag:
        return rows_of(bag.messages()), lines


def copied(source: Path | Bag, target: Path, added: str = "", **options: Any) -> Path:
    """Copies a bag. If `added` is set, a topic of this name gets a message for each cloud."""
    if isinstance(source, Path):
        with open_bag(source) as bag:
            return copied(bag, target, added, **options)
    with create_bag(target, like=source, **options) as writer:
        points = source.topics_named("/points")
        new = writer.add_topic(added, CLOUD, like=points[0] if points else None) if added else None
        for message in source.messages():
            writer.copy(message)
            if new is not None and message.topic.name == "/points":
                writer.write(new, message.log_time, added_data(message.data))
        writer.finish()
    return target


def added_data(data: bytes | memoryview) -> bytes:
    """The message that `copied` adds for a cloud."""
    return bytes(data)[::-1] + b"labels"


def main_file(path: Path) -> Path:
    """The file with the messages."""
    return path if path.is_file() else next(file for file in path.iterdir() if file.name != "metadata.yaml")


def changed(path: Path, position: int, data: bytes) -> None:
    """Overwrites bytes of a file."""
    with path.open("r+b") as file:
        file.seek(position)
        file.write(data)


def files_in(folder: Path) -> dict[str, bytes]:
    """All files in a directory and below, with their content."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
