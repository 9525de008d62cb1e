# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Writing bags of ROS 2: an MCAP file or database, or a directory of them with metadata.yaml."""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from flagstone.bags import yaml
from flagstone.bags.compression import compress_file, compressor
from flagstone.bags.container import BagWriter, Compression, Data, Format, Message, Topic
from flagstone.bags.definitions import new_topic
from flagstone.bags.mcap import QOS, ROSBAG2_METADATA, TYPE_HASH, McapFile
from flagstone.bags.mcap_writer import McapStorage
from flagstone.bags.output_file import Staging
from flagstone.bags.rosbag2 import INFORMATION, METADATA_FILE, SERIALIZED_METADATA, Information, Rosbag2
from flagstone.bags.sqlite3_writer import Sqlite3Storage

_EXTENSIONS: dict[Format, str] = {"mcap": ".mcap", "sqlite3": ".db3"}
_NEW_VERSION = 8  # of metadata.yaml, if the input has none: all versions of ROS 2 since Jazzy read it
_EMPTY_START = 2**63 - 1  # as rosbag2 writes it for bags without messages


@dataclass
class _File:
    """Name and contents of a file of the bag."""

    name: str
    count: int = 0
    start: int = _EMPTY_START
    end: int = 0

    @property
    def duration(self) -> int:
        return max(0, self.end - self.start)


class Rosbag2Writer(BagWriter):
    """A bag of ROS 2. If the input consists of several files, the output is split at the same messages."""

    def __init__(self, path: Path, like: Rosbag2, format: Format) -> None:
        """Creates the temporary file or directory and declares the topics of `like`."""
        super().__init__(path, format)
        self._like = like
        self._is_compressed = path.suffix == ".zstd"
        self._is_directory = _extension(path) not in _EXTENSIONS.values()
        if self._is_directory:
            self._is_compressed = like.compression_mode == "file"
        self._check_convertible()
        # Only metadata.yaml specifies that messages are compressed, so that a single file gets them decompressed.
        self._is_message_compressed = like.compression_mode == "message" and self._is_directory
        self._compress = compressor("zstd" if self._is_message_compressed else "none")
        self._chunk_compression: Compression = like.compression if like.compression_mode == "chunk" else "none"
        self._topics = {topic.id: topic for topic in like.topics}
        self._like_of: dict[int, Topic] = {}
        self._counts = dict.fromkeys(self._topics, 0)
        self._files: list[_File] = []
        self._input_file = like.first_file
        self._storage: McapStorage | Sqlite3Storage | None = None
        self._staging = Staging(path, is_directory=self._is_directory)
        try:
            self._open_file()
        except BaseException:
            self.discard()
            raise

    def _check_convertible(self) -> None:
        if self.format == self._like.format:
            return
        other = next((topic for topic in self._like.topics if topic.encoding != "cdr"), None)
        if other is not None:
            raise ValueError(
                f"{self.path}: topic {other.name} has the encoding {other.encoding!r}, which cannot be written as "
                f"{self.format!r} (expected 'cdr'; keep the format {self._like.format!r})"
            )

    # Topics and messages

    def add_topic(
        self,
        name: str,
        type: str,
        definition: str | None = None,
        *,
        like: Topic | None = None,
    ) -> Topic:
        """See `BagWriter.add_topic`."""
        topic = _with_metadata(new_topic(self.path, self._topics, name, type, definition, like, is_ros1=False))
        self._topics[topic.id] = topic
        self._counts[topic.id] = 0
        if like is not None:
            self._like_of[topic.id] = like
        self._open_storage.add_topic(topic)
        return topic

    def copy(self, message: Message) -> None:
        """See `BagWriter.copy`."""
        topic = message.topic
        if self._topics.get(topic.id) is not topic:
            raise ValueError(f"{self.path}: a message of topic {topic.name} is not from {self._like.path}")
        if message.file != self._input_file and self._is_directory:
            self._input_file = message.file
            if self._files[-1].count:
                self._close_file()
                self._open_file()
        data = message.stored if self._is_message_compressed and message.stored is not None else message.data
        self._add(topic, message.log_time, message.publish_time, data, message.sequence, message.chunk)

    def write(self, topic: Topic, log_time: int, data: Data, *, publish_time: int | None = None) -> None:
        """See `BagWriter.write`."""
        if self._topics.get(topic.id) is not topic:
            raise ValueError(f"{self.path}: topic {topic.name} is not of this bag (create it with add_topic)")
        if self._is_message_compressed:
            data = self._compress(bytes(data))
        self._add(topic, log_time, log_time if publish_time is None else publish_time, data, None, -1)

    def _add(
        self, topic: Topic, log_time: int, publish_time: int, data: Data, sequence: int | None, chunk: int
    ) -> None:
        self._open_storage.add(topic, log_time, publish_time, data, sequence, chunk)
        self._counts[topic.id] += 1
        file = self._files[-1]
        file.count += 1
        if log_time < file.start:
            file.start = log_time
        if log_time > file.end:
            file.end = log_time

    # Files

    @property
    def _open_storage(self) -> McapStorage | Sqlite3Storage:
        if self._storage is None:
            raise ValueError(f"{self.path}: the bag is finished or discarded")
        return self._storage

    def _open_file(self) -> None:
        """Starts the next file of the bag."""
        extension = _EXTENSIONS[self.format]
        if self._is_directory:
            name = f"{self._staging.target.name}_{len(self._files)}{extension}"
            path = self._staging.path / name
        else:
            name, path = self._staging.target.name, self._staging.path
        if self._is_compressed and self._is_directory:
            name += ".zstd"
        self._files.append(_File(name))
        self._path = path
        if self.format == "mcap":
            part = self._like_part()
            self._storage = McapStorage(path, part, self._chunk_compression)
        else:
            self._storage = Sqlite3Storage(path, str((self._like.information or {}).get("ros_distro") or ""))
        for topic in self._topics.values():
            is_converted = self._like.format == "sqlite3"
            self._storage.add_topic(_with_metadata(topic) if is_converted else topic)

    def _like_part(self) -> McapFile | None:
        """The MCAP file of the input that corresponds to the current file."""
        if self._like.format != "mcap":
            return None
        part = self._like.part(self._input_file)
        return part if isinstance(part, McapFile) else None

    def _close_file(self) -> None:
        """Completes the current file."""
        storage, self._storage = self._storage, None
        information = self._information()
        text = yaml.dump(information) if information is not None else ""
        if isinstance(storage, McapStorage):
            part = self._like_part()
            records = list(part.metadata()) if part is not None else []
            if information is not None and (part is None or any(name == ROSBAG2_METADATA for name, _ in records)):
                records = [record for record in records if record[0] != ROSBAG2_METADATA]
                records.append((ROSBAG2_METADATA, {SERIALIZED_METADATA: text}))
            try:
                storage.close(records)
            except BaseException:
                storage.discard()
                raise
        elif storage is not None:
            try:
                storage.close(int((information or {}).get("version", _NEW_VERSION)), text)
            except BaseException:
                storage.discard()
                raise
        if self._is_compressed:
            self._compress_file()

    def _compress_file(self) -> None:
        source = self._path
        target = source.with_name(source.name + ".zstd")
        if not self._is_directory:  # the temporary name must not change
            target = source.with_name(source.name + "-zstd")
        try:
            with source.open("rb") as file, target.open("wb") as compressed:
                compress_file(file, compressed)
            if self._is_directory:
                source.unlink()
            else:
                target.replace(source)
        except BaseException:
            target.unlink(missing_ok=True)
            raise

    # Metadata

    def _information(self) -> Information | None:
        """metadata.yaml of the files so far; None if input and output are MCAP files without it."""
        base = self._like.information
        if base is None and not self._is_directory and self.format == "mcap" and self._like.format == "mcap":
            return None
        information: dict[str, Any] = copy.deepcopy(base) if base is not None else {"version": _NEW_VERSION}
        version = information.get("version")
        is_new = not isinstance(version, int)
        version = version if isinstance(version, int) else _NEW_VERSION
        if is_new:
            information["version"] = version
        files = self._files
        start = min((file.start for file in files), default=_EMPTY_START)
        duration = max(0, max((file.end for file in files), default=0) - start)
        information["storage_identifier"] = self.format
        information["relative_file_paths"] = [file.name for file in files]
        information["duration"] = {"nanoseconds": duration}
        information["starting_time"] = {"nanoseconds_since_epoch": start}
        information["message_count"] = sum(self._counts.values())
        information["topics_with_message_count"] = self._topic_entries(information, version)
        mode = "FILE" if self._is_compressed else "MESSAGE" if self._is_message_compressed else ""
        if str(information.get("compression_mode") or "").upper() != mode:
            information["compression_mode"] = mode
            information["compression_format"] = "zstd" if mode else ""
        information.setdefault("compression_format", "")
        information.setdefault("compression_mode", "")
        if version >= 5:
            information["files"] = [
                {
                    "path": file.name,
                    "starting_time": {"nanoseconds_since_epoch": file.start},
                    "duration": {"nanoseconds": file.duration},
                    "message_count": file.count,
                }
                for file in files
            ]
        if version >= 6:
            information.setdefault("custom_data", None)
        if version >= 8:
            information.setdefault("ros_distro", "")
        return information

    def _topic_entries(self, information: Information, version: int) -> list[Any]:
        """The members of `topics_with_message_count`: the entries of the input with new counts, and new entries."""
        entries: dict[str, Any] = {}
        for entry in information.get("topics_with_message_count") or ():
            metadata = entry.get("topic_metadata") if isinstance(entry, dict) else None
            if isinstance(metadata, dict) and isinstance(metadata.get("name"), str):
                entries[metadata["name"]] = entry
        counts: dict[str, int] = {}
        for id, topic in self._topics.items():
            counts[topic.name] = counts.get(topic.name, 0) + self._counts[id]
            if topic.name in entries:
                continue
            like = self._like_of.get(id)
            metadata = {
                "name": topic.name,
                "type": topic.type,
                "serialization_format": topic.encoding,
                "offered_qos_profiles": topic.qos,
            }
            if like is not None and like.name in entries:
                metadata = {**copy.deepcopy(entries[like.name]["topic_metadata"]), "name": topic.name}
                metadata["type"] = topic.type
            elif version >= 9:
                metadata["offered_qos_profiles"] = []
            if version >= 7:
                metadata["type_description_hash"] = topic.type_hash
            entries[topic.name] = {"topic_metadata": metadata, "message_count": 0}
        for name, entry in entries.items():
            entry["message_count"] = counts.get(name, 0)
        return list(entries.values())

    # End

    def finish(self) -> None:
        """See `BagWriter.finish`."""
        try:
            self._close_file()
            if self._is_directory:
                text = yaml.dump({INFORMATION: self._information()})
                (self._staging.path / METADATA_FILE).write_bytes(text.encode(errors="surrogateescape"))
            self._staging.finish()
        except BaseException:
            self.discard()
            raise

    def discard(self) -> None:
        """See `BagWriter.discard`."""
        if self._storage is not None:
            self._storage.discard()
            self._storage = None
        self._staging.discard()


def _with_metadata(topic: Topic) -> Topic:
    """The topic with the channel metadata that rosbag2 writes to MCAP."""
    metadata = {QOS: topic.qos, TYPE_HASH: topic.type_hash}
    return replace(topic, metadata={key: value for key, value in metadata.items() if value})


def _extension(path: Path) -> str:
    """The file extension, without .zstd."""
    return Path(path.stem).suffix if path.suffix == ".zstd" else path.suffix
