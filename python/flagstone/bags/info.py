# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone info` for bags."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from datetime import datetime, timezone
from typing import Any

from flagstone._python_commands import SOME_FAILED, SUCCESS, failed, print_error, print_line
from flagstone.bags.clouds import cloud_topics
from flagstone.bags.container import Bag, open_bag
from flagstone.bags.frames import looks_like_sensor_frame
from flagstone.bags.poses import read_frames
from flagstone.bags.worker import parse
from flagstone.ros import PointCloud2

_TYPES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64", "int64", "uint64", "bool")
_FORMATS = {"rosbag1": "ROS 1 bag", "sqlite3": "rosbag2, SQLite", "mcap": "MCAP"}


def run(options: dict[str, Any], paths: list[str]) -> int:
    """Prints the topics of each bag and the fields of the first cloud of each point cloud topic.

    Returns:
        Exit code: 0, success; 1, a bag cannot be read or is damaged.
    """
    code = SUCCESS
    for path in paths:
        problems: list[str] = []
        try:
            with open_bag(path, report=problems.append) as bag:
                print_line("\n".join(info_lines(bag, problems.append)) + "\n")
        except (OSError, ValueError) as error:
            code = failed(error, SOME_FAILED)
        for problem in problems:
            print_error(problem)
            code = SOME_FAILED
    return code


def info_lines(bag: Bag, report: Callable[[str], None]) -> Iterator[str]:
    """The description of a bag, line by line."""
    yield str(bag.path)
    compression = f", {bag.compression} by {bag.compression_mode}" if bag.compression_mode else ", not compressed"
    yield _entry("format", _FORMATS[bag.format] + compression)
    yield _entry("size", f"{sum(file.stat().st_size for file in bag.files) / 1e6:.1f} MB")
    if bag.start_time is not None and bag.end_time is not None:
        duration = (bag.end_time - bag.start_time) / 1e9
        yield _entry("duration", f"{duration:.1f} s, from {_utc(bag.start_time)} to {_utc(bag.end_time)} UTC")
    yield _entry("messages", str(bag.message_count))
    yield ""
    yield from _topic_lines(bag)
    for topic in cloud_topics(bag):
        yield ""
        yield from _cloud_lines(bag, topic, report)
    if frames := read_frames(bag, report).frames:
        yield ""
        yield _entry("frames in /tf_static", ", ".join(frames))


def _topic_lines(bag: Bag) -> Iterator[str]:
    counts: dict[tuple[str, str], int] = {}
    for topic in bag.topics:
        counts[topic.name, topic.type] = counts.get((topic.name, topic.type), 0) + topic.message_count
    width = max((len(name) for name, _ in counts), default=0)
    yield f"{'topics':<{width + 2}} {'messages':>10}  type"
    for (name, kind), count in sorted(counts.items()):
        yield f"  {name:<{width}} {count:>10}  {kind}"


def _cloud_lines(bag: Bag, topic: str, report: Callable[[str], None]) -> Iterator[str]:
    cloud: PointCloud2 | None = None
    for index, message in enumerate(bag.messages([topic])):
        try:
            cloud = parse(message)
        except ValueError as error:
            report(f"{bag.path}: {topic}: message {index}: {error}")
            continue
        yield f"first cloud of {topic}" if index == 0 else f"message {index} of {topic}"
        break
    if cloud is None:
        yield f"{topic}: no cloud can be read"
        return
    frame = cloud.header.frame_id
    yield _entry(
        "  frame", frame if looks_like_sensor_frame(frame) else f"{frame} (usually not the frame of a sensor: --tf)"
    )
    yield _entry("  points", f"{len(cloud)} ({cloud.height} x {cloud.width}), {cloud.point_step} bytes each")
    convention = cloud.convention
    known = {"time": convention.time, "beam": convention.ring, "intensity": convention.intensity}
    fields = [f"{meaning} in '{field}'" for meaning, field in known.items() if field is not None]
    yield _entry("  convention", ", ".join([convention.name, *fields]))
    yield "  fields               type       offset"
    for field in cloud.fields:
        name = _TYPES[field.datatype - 1] if 1 <= field.datatype <= len(_TYPES) else f"type {field.datatype}"
        yield f"    {field.name:<18} {name + (f'[{field.count}]' if field.count > 1 else ''):<10} {field.offset}"


def _entry(name: str, value: str) -> str:
    return f"{name:<20} {value}"


def _utc(time: int) -> str:
    return f"{datetime.fromtimestamp(time / 1e9, timezone.utc):%Y-%m-%d %H:%M:%S}"
