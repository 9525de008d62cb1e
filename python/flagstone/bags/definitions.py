# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Message definitions of added topics."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from flagstone.bags.container import Topic

POINT_CLOUD2 = "sensor_msgs/msg/PointCloud2"


class Definition(NamedTuple):
    """A message definition with the definitions of the types that it uses."""

    text: str
    type_hash: str
    """MD5 sum in ROS 1, type description hash in ROS 2."""


_SEPARATOR = "=" * 80
_CLOUD_FIELDS = """
uint32 height
uint32 width
{field}[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
"""
_FIELD_FIELDS = """
uint8 INT8=1
uint8 UINT8=2
uint8 INT16=3
uint8 UINT16=4
uint8 INT32=5
uint8 UINT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
string name
uint32 offset
uint8 datatype
uint32 count
"""


def _cloud(header: str, field: str, header_fields: str) -> str:
    parts = (
        f"{header} header{_CLOUD_FIELDS.format(field=field)}",
        f"MSG: {header}\n{header_fields}",
        f"MSG: {field}{_FIELD_FIELDS}",
    )
    return f"{_SEPARATOR}\n".join(parts)


POINT_CLOUD2_OF_ROS1 = Definition(
    _cloud("std_msgs/Header", "sensor_msgs/PointField", "uint32 seq\ntime stamp\nstring frame_id\n"),
    "1158d486dd51d683ce2f1be655c3c181",
)
POINT_CLOUD2_OF_ROS2 = Definition(
    _cloud(
        "std_msgs/Header",
        "sensor_msgs/PointField",
        "builtin_interfaces/Time stamp\nstring frame_id\n"
        f"{_SEPARATOR}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n",
    ),
    "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
)


def new_topic(
    path: Path,
    topics: Mapping[int, Topic],
    name: str,
    type: str,
    definition: str | None,
    like: Topic | None,
    *,
    is_ros1: bool,
) -> Topic:
    """The topic that `BagWriter.add_topic` adds to the topics of a bag.

    Raises:
        ValueError: The bag has this topic already, or no definition is known for the type.
    """
    if any(topic.name == name for topic in topics.values()):
        raise ValueError(f"{path}: topic {name} exists already (choose another name)")
    known = [topic for topic in (like, *topics.values()) if topic is not None and topic.type == type]
    source = next((topic for topic in known if topic.definition), None)
    language = "ros1msg" if is_ros1 else "ros2msg"
    type_hash = next((topic.type_hash for topic in known if topic.type_hash), "")
    if definition is None and source is not None:
        definition, language = source.definition, source.definition_format
    elif definition is None and type == POINT_CLOUD2:
        definition, own_hash = POINT_CLOUD2_OF_ROS1 if is_ros1 else POINT_CLOUD2_OF_ROS2
        type_hash = type_hash or own_hash
    elif definition is None:
        raise ValueError(f"{path}: the definition of {type} is unknown (pass it to add_topic)")
    if is_ros1 and not type_hash:
        type_hash = "*"  # any definition
    return Topic(
        id=next(id for id in itertools.count(1) if id not in topics),
        name=name,
        type=type,
        encoding="ros1" if is_ros1 else like.encoding if like is not None else "cdr",
        definition=definition,
        definition_format=language,
        type_hash=type_hash,
        qos=like.qos if like is not None else "",
        is_latched=like is not None and like.is_latched,
        caller_id=like.caller_id if like is not None else "",
    )
