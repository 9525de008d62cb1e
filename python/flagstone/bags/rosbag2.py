# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reading bags of ROS 2: an MCAP file or database, or a directory of them with metadata.yaml."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from pathlib import Path, PurePath
from typing import Any

from flagstone.bags import yaml
from flagstone.bags.compression import decompress_file, decompressed
from flagstone.bags.container import Bag, Format, Message, Topic
from flagstone.bags.formats import format_by_magic, is_zstd
from flagstone.bags.mcap import ROSBAG2_METADATA, McapFile
from flagstone.bags.reports import DamagedError
from flagstone.bags.sqlite3_file import Sqlite3File

INFORMATION = "rosbag2_bagfile_information"
METADATA_FILE = "metadata.yaml"
SERIALIZED_METADATA = "serialized_metadata"
"""Key of the metadata in a metadata record of MCAP."""

Part = McapFile | Sqlite3File
"""One file of a bag."""
_Key = tuple[str, ...]
Information = dict[str, Any]
"""Content of metadata.yaml: the members of `rosbag2_bagfile_information`."""


class Rosbag2(Bag):
    """A bag of ROS 2."""

    def __init__(self, path: Path, report: Callable[[str], None]) -> None:
        """Opens the files of the bag.

        Raises:
            ValueError: None of its files can be read.
        """
        super().__init__(path, "mcap", report)
        self.information: Information | None = None
        """Content of metadata.yaml, of the directory or as stored in the file; None if it is missing."""
        self._parts: dict[int, Part] = {}
        self._is_closed = False
        self._topics: dict[_Key, Topic] = {}
        self._keys: list[dict[int, _Key]] = []
        self._ignored: set[int] = set()
        if path.is_dir():
            self._read_metadata_file()
        else:
            self.files = (path,)
        try:
            self._open_parts()
        except BaseException:
            self.close()
            raise
        if self.information is None and not path.is_dir():
            self.information = self._stored_information()
        self._add_type_hashes()
        mode = str((self.information or {}).get("compression_mode") or "").lower()
        if mode == "message":
            self.compression, self.compression_mode = "zstd", "message"

    # Files

    def _read_metadata_file(self) -> None:
        """Sets `information` and `files`."""
        file = self.path / METADATA_FILE
        try:
            text = file.read_text(errors="surrogateescape")
            self.information = information_of(yaml.load(text))
        except FileNotFoundError:
            self._reports(file, "is missing because the bag was not closed (the files of the directory are read)")
        except (OSError, DamagedError) as error:
            self._reports(file, f"{error} (the files of the directory are read)")
        if self.information is not None:
            # Up to version 3, the paths contain the directory.
            names = [PurePath(name).name for name in self.information["relative_file_paths"]]
            self.files = tuple(self.path / name for name in names)
        else:
            pattern = re.compile(r".*\.(mcap|db3)(\.zstd)?")
            found = [file for file in self.path.iterdir() if pattern.fullmatch(file.name)]
            self.files = tuple(sorted(found, key=lambda file: (_numbers(file.name), file.name)))
        if not self.files:
            raise ValueError(f"{self.path}: contains no .mcap or .db3 file (expected a bag of rosbag2)")

    def _open_parts(self) -> None:
        errors = []
        start: list[int] = []
        end: list[int] = []
        formats: list[Format] = []
        for index, file in enumerate(self.files):
            self._keys.append({})
            try:
                part = self.part(index)
            except (OSError, ValueError) as error:
                if len(self.files) == 1:
                    raise
                problem = f"{error.strerror}" if isinstance(error, OSError) else str(error).removeprefix(f"{file}: ")
                self._reports(file, f"{problem} (the file is skipped)")
                errors.append(error)
                self._ignored.add(index)
                continue
            formats.append(part.format)
            self._merge_topics(index, part)
            start += [] if part.start_time is None else [part.start_time]
            end += [] if part.end_time is None else [part.end_time]
            if part.compression != "none":
                self.compression, self.compression_mode = part.compression, part.compression_mode
            if is_zstd(file):
                self.compression, self.compression_mode = "zstd", "file"
        if not formats:
            raise ValueError(f"{self.path}: the bag has no part that can be read: {errors[0]}")
        self.format = formats[0]
        self.start_time, self.end_time = min(start, default=None), max(end, default=None)
        self.topics = tuple(self._topics.values())

    def part(self, index: int) -> Part:
        """A file of the bag. Of compressed files, only one is open at a time, decompressed to a temporary file."""
        if self._is_closed:
            raise ValueError(f"{self.path}: the bag is closed")
        if index in self._parts:
            return self._parts[index]
        file = self.files[index]
        if not is_zstd(file):
            self._parts[index] = self._opened(file)
            return self._parts[index]
        for other in [other for other in self._parts if is_zstd(self.files[other])]:
            self._parts.pop(other).close()
        with tempfile.TemporaryDirectory(prefix="flagstone-") as folder:
            copy = Path(folder) / file.stem
            self._decompress(file, copy)
            self._parts[index] = self._opened(copy, file)
        return self._parts[index]

    @property
    def first_file(self) -> int:
        """Index of the first file that can be read."""
        return min(index for index in range(len(self.files)) if index not in self._ignored)

    def _opened(self, file: Path, name: Path | None = None) -> Part:
        """Opens a file; messages name the file `name`."""

        def report(line: str) -> None:
            where, _, problem = line.removeprefix(str(file)).partition(": ")
            self._reports(f"{name or file}{where}", problem)

        format_of_file = format_by_magic(file)
        try:
            if format_of_file == "mcap":
                return McapFile(file, report)
            if format_of_file == "sqlite3":
                return Sqlite3File(file, report)
        except ValueError as error:
            raise ValueError(str(error).replace(str(file), str(name or file))) from None
        problem = "is not a bag"
        if not file.is_file():
            problem = "is not a regular file"
        elif file.stat().st_size == 0:
            problem = "is empty"
        expected = "a .bag of ROS 1, .mcap, .db3 or a directory of rosbag2"
        raise ValueError(f"{name or file}: {problem} (expected {expected})")

    def _decompress(self, file: Path, target: Path) -> None:
        """Decompresses a file; if it is truncated or damaged, up to there."""
        with file.open("rb") as source, target.open("wb") as copy:
            problem = decompress_file(source, copy)
        if problem:
            self._reports(file, f"{problem} (the part before it is read)")

    # Topics

    def _merge_topics(self, index: int, part: Part) -> None:
        """Adds the topics of a file. A topic has one number in the bag, but may have another in each file."""
        for topic, key in zip(part.topics, _keys(part.topics), strict=True):
            known = self._topics.get(key)
            if known is not None:
                count = known.message_count + topic.message_count
                self._topics[key] = replace(known, message_count=count)
            else:
                id = topic.id if len(self.files) == 1 else len(self._topics) + 1
                self._topics[key] = replace(topic, id=id)
            self._keys[index][topic.id] = key

    # Metadata

    def _stored_information(self) -> Information | None:
        part = self.part(0)
        if isinstance(part, McapFile):
            records = [content for name, content in part.metadata() if name == ROSBAG2_METADATA]
            text = records[-1].get(SERIALIZED_METADATA, "") if records else ""
        else:
            text = part.stored_metadata()
        if not text:
            return None
        try:
            return information_of({INFORMATION: yaml.load(text)})
        except DamagedError as error:
            self._reports(self.path, f"metadata of rosbag2: {error} (it is replaced in copies)")
            return None

    def _add_type_hashes(self) -> None:
        """Adds the hashes that metadata.yaml contains and the files do not."""
        hashes: dict[str, str] = {}
        for entry in (self.information or {}).get("topics_with_message_count") or ():
            metadata = entry.get("topic_metadata") if isinstance(entry, dict) else None
            if isinstance(metadata, dict):
                hashes[str(metadata.get("name"))] = str(metadata.get("type_description_hash") or "")
        for key, topic in self._topics.items():
            if not topic.type_hash:
                self._topics[key] = replace(topic, type_hash=hashes.get(topic.name, ""))
        self.topics = tuple(self._topics.values())

    # Messages

    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """See `Bag.messages`."""
        if self._is_closed:
            raise ValueError(f"{self.path}: the bag is closed")
        return self._messages(topics)

    def _messages(self, topics: Collection[str] | None) -> Iterator[Message]:
        for index in range(len(self.files)):
            if index in self._ignored:
                continue
            try:
                part = self.part(index)
            except ValueError as error:
                self._reports(self.files[index], f"{error} (the file is skipped)")
                continue
            topics_by_id = {id: self._topics[key] for id, key in self._keys[index].items()}
            for message in part.messages(topics):
                topic, log_time, publish_time, data, sequence, chunk, _, _ = message
                stored = None
                if self.compression_mode == "message":
                    stored = data
                    try:
                        data = decompressed("zstd", stored, None)
                    except DamagedError as error:
                        self._reports(self.files[index], f"{topic.name} at {log_time}: {error} (it is skipped)")
                        continue
                yield Message(topics_by_id[topic.id], log_time, publish_time, data, sequence, chunk, index, stored)

    def close(self) -> None:
        """See `Bag.close`."""
        self._is_closed = True
        for part in self._parts.values():
            part.close()
        self._parts.clear()


def information_of(document: Any) -> Information:
    """The members of metadata.yaml.

    Raises:
        DamagedError: The file list or a member that every version has is missing.
    """
    information = document.get(INFORMATION) if isinstance(document, dict) else None
    if not isinstance(information, dict):
        raise DamagedError(f"{INFORMATION} is missing")
    names = information.get("relative_file_paths")
    if not isinstance(names, list) or not all(isinstance(name, str) and PurePath(name).name for name in names):
        raise DamagedError("relative_file_paths is missing or damaged")
    return information


def _keys(topics: tuple[Topic, ...]) -> Iterator[_Key]:
    """What identifies each topic of a file in all files. Equal topics of a file are numbered."""
    seen: dict[_Key, int] = {}
    for topic in topics:
        metadata = str(sorted(topic.metadata.items()))
        key = (topic.name, topic.type, topic.encoding, topic.qos, topic.definition, metadata)
        seen[key] = seen.get(key, 0) + 1
        yield (*key, str(seen[key]))


def _numbers(name: str) -> tuple[int, ...]:
    """The numbers in a file name, so that bag_10 follows bag_9."""
    return tuple(int(digits) for digits in re.findall(r"\d{1,18}", os.fsdecode(name)))
