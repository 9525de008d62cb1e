# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The interface of bag files, the same for every format."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Literal, NamedTuple, TypeAlias

from flagstone.bags.reports import Reports

Format: TypeAlias = Literal["rosbag1", "sqlite3", "mcap"]
"""A container: ROS 1 bag of version 2.0, rosbag2 with SQLite, or MCAP."""

Compression: TypeAlias = Literal["none", "lz4", "bz2", "zstd"]

Data: TypeAlias = bytes | memoryview
"""The bytes of a message; a memoryview is read-only and has the format "B"."""


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic of a bag, or one of several connections if several publishers of a topic are recorded separately."""

    id: int
    """Identifies the topic in its bag."""
    name: str
    """For example "/points"."""
    type: str
    """For example "sensor_msgs/msg/PointCloud2", also for ROS 1."""
    encoding: str = "cdr"
    """Serialization of the messages: "cdr" for ROS 2, "ros1" for ROS 1, or any other name in MCAP."""
    definition: str = ""
    """Text of the message definition; "" if the bag does not contain it. Bytes that are not UTF-8 are surrogates."""
    definition_format: str = ""
    """Language of the definition: "ros1msg", "ros2msg", "ros2idl", or any other name in MCAP."""
    type_hash: str = ""
    """MD5 sum of the definition in ROS 1, type description hash (RIHS01) in ROS 2; "" if unknown."""
    qos: str = ""
    """QoS profiles that the publishers offered, as YAML; "" in ROS 1."""
    is_latched: bool = False
    """Whether the publisher latched its last message (ROS 1)."""
    caller_id: str = ""
    """Node that published (ROS 1)."""
    message_count: int = 0
    """Messages by the index of the bag. Messages that are damaged are included."""
    metadata: Mapping[str, str] = field(default_factory=dict)
    """All fields of the connection header (ROS 1) or of the channel metadata (MCAP)."""


class Message(NamedTuple):
    """A message of a bag."""

    topic: Topic
    log_time: int
    """When the message was recorded: nanoseconds since the epoch."""
    publish_time: int
    """When the message was published, in nanoseconds; the log time if the format does not store it."""
    data: Data
    """The serialized message. A memoryview is valid as long as it exists, also after the bag is closed."""
    sequence: int = 0
    """Sequence number of the channel (MCAP)."""
    chunk: int = -1
    """Identifies the chunk that contains the message; -1 if the bag has no chunks."""
    file: int = 0
    """Index of the file of a split bag."""
    stored: Data | None = None
    """The compressed message, if messages are compressed one by one."""


class Bag(ABC):
    """An open bag. Create one with `open_bag`.

    Not thread-safe: use one instance per thread. Uncompressed messages are views of the memory-mapped file. The file
    must not be truncated while it is read: the bag checks its size before each chunk and raises OSError, but a file
    that shrinks between this check and the use of the data ends the process with SIGBUS, as for any mapped file.
    """

    def __init__(self, path: Path, format: Format, report: Callable[[str], None]) -> None:
        self.path = path
        self.format: Format = format
        self.files: tuple[Path, ...] = (path,)
        """Every file that belongs to the bag."""
        self.topics: tuple[Topic, ...] = ()
        self.start_time: int | None = None
        """First log time in nanoseconds; None if the bag has no messages."""
        self.end_time: int | None = None
        """Last log time in nanoseconds; None if the bag has no messages."""
        self.compression: Compression = "none"
        self.compression_mode: Literal["", "chunk", "message", "file"] = ""
        """Which part of the bag is compressed at a time; "" if the bag is not compressed."""
        self._reports = Reports(report)

    @property
    def message_count(self) -> int:
        """Messages of all topics by the index of the bag."""
        return sum(topic.message_count for topic in self.topics)

    def topics_named(self, name: str) -> tuple[Topic, ...]:
        """The connections of a topic; () if the bag does not have it."""
        return tuple(topic for topic in self.topics if topic.name == name)

    @abstractmethod
    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """Iterates over the messages in the order of the bag, which is usually the order of the log times.

        Can be called repeatedly. Damaged parts are skipped, with one line each to `report`, once per bag.

        Args:
            topics: Names of the topics to read (default: all).

        Raises:
            OSError: The file cannot be read or was truncated since it was opened.
            ValueError: The bag is closed.
        """

    def _counted(self, messages: Iterator[Message]) -> dict[int, int]:
        """Sets the first and the last log time, and returns the number of messages by the id of their topic."""
        counts: dict[int, int] = {}
        for message in messages:
            counts[message.topic.id] = counts.get(message.topic.id, 0) + 1
            time = message.log_time
            self.start_time = time if self.start_time is None else min(self.start_time, time)
            self.end_time = time if self.end_time is None else max(self.end_time, time)
        return counts

    @abstractmethod
    def close(self) -> None:
        """Closes the files. Data of messages that still exist remain valid."""

    def __enter__(self) -> Bag:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class BagWriter(ABC):
    """A bag that is being written. Create one with `create_bag`.

    The bag is written to a temporary file (or directory) next to its path, which `finish` renames. As a context
    manager, it is discarded if the block raises or does not call `finish`. Not thread-safe.
    """

    def __init__(self, path: Path, format: Format) -> None:
        self.path = path
        self.format: Format = format

    @abstractmethod
    def add_topic(
        self,
        name: str,
        type: str,
        definition: str | None = None,
        *,
        like: Topic | None = None,
    ) -> Topic:
        """Adds a topic.

        Args:
            name: For example "/points/labelled".
            type: For example "sensor_msgs/msg/PointCloud2", also for ROS 1.
            definition: Text of the message definition. Default: that of `like`, of any other topic of this type in the
                bag, or for point clouds the definition that flagstone contains.
            like: A topic whose encoding, QoS profiles, latching and node the new topic gets.

        Returns:
            The topic to pass to `write`.

        Raises:
            ValueError: The bag has this topic already, or no definition is known for the type.
        """

    @abstractmethod
    def copy(self, message: Message) -> None:
        """Writes a message of the bag that was passed to `create_bag`, unchanged, to the same topic.

        Times, sequence number and bytes are kept. `message.data` must not change until `finish` returns.

        Raises:
            ValueError: The message belongs to another bag, or the bag is finished or discarded.
            OSError: The disk is full, or another error of the file system.
        """

    @abstractmethod
    def write(self, topic: Topic, log_time: int, data: Data, *, publish_time: int | None = None) -> None:
        """Writes a message.

        Args:
            topic: Result of `add_topic`.
            log_time: Nanoseconds since the epoch.
            data: The serialized message. Must not change until `finish` returns.
            publish_time: Nanoseconds since the epoch (default: `log_time`).

        Raises:
            ValueError: The topic belongs to another bag, or the format cannot store the time or the size.
            OSError: The disk is full, or another error of the file system.
        """

    @abstractmethod
    def finish(self) -> None:
        """Writes the index and renames the temporary file to the path.

        Raises:
            OSError: The disk is full, or another error of the file system. The temporary file is deleted.
        """

    @abstractmethod
    def discard(self) -> None:
        """Deletes the temporary file. Does nothing after `finish`."""

    def __enter__(self) -> BagWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.discard()


def open_bag(path: str | os.PathLike[str], *, report: Callable[[str], None] | None = None) -> Bag:
    """Opens a bag for reading. Its content, not its file extension, determines the format.

    Args:
        path: A ROS 1 .bag, an .mcap, a .db3 (either may be compressed as a whole: .zstd), or a directory of rosbag2.
        report: Receives one line for each damaged or missing part of the bag (default: discards them). The rest of the
            bag is read.

    Returns:
        The bag.

    Raises:
        FileNotFoundError: The file does not exist.
        OSError: The file cannot be read.
        ValueError: The file is not a bag, or nothing in it can be read; the error is one line with file and reason.
        ImportError: The bag is compressed, or is a directory, and the extra `bag` is not installed.
    """
    from flagstone.bags import formats

    return formats.open_bag(Path(path), report or (lambda line: None))


def create_bag(
    path: str | os.PathLike[str],
    *,
    like: Bag,
    format: Format | None = None,
) -> BagWriter:
    """Creates a bag that gets the topics, compression, chunk size, metadata and attachments of another bag.

    Nothing appears at `path` before `finish`, which replaces an existing file. An existing directory is an error,
    unless it is empty. A temporary file that a killed process left next to `path` is deleted.

    Args:
        path: Bag to write. With the extension .bag, .db3 or .mcap, one file; otherwise a directory of rosbag2.
        like: The bag to copy from. Its messages are written with `copy`.
        format: Container of the output (default: by the extension, or that of `like`). Bags of ROS 2 can be converted
            between "sqlite3" and "mcap".

    Returns:
        The writer.

    Raises:
        ValueError: The output is, contains or is inside the input; the extension contradicts the format; or the
            conversion is not possible.
        FileExistsError: The output is a directory that is not empty.
        OSError: The temporary file cannot be created.
        ImportError: The bag is compressed, or is a directory, and the extra `bag` is not installed.
    """
    from flagstone.bags import formats

    return formats.create_bag(Path(path), like, format)
