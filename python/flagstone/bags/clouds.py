# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Selects the point cloud topics of a bag."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from flagstone import ros
from flagstone.bags.container import Bag, Topic

LABELLED, GROUND, NONGROUND = "labelled", "ground", "nonground"
"""The last part of the names of added topics."""

OUTPUTS: dict[str, tuple[str, ...]] = {
    "labelled": (LABELLED,),
    "split": (GROUND, NONGROUND),
    "both": (LABELLED, GROUND, NONGROUND),
}
"""The topics that each output format adds."""


def cloud_topics(bag: Bag) -> dict[str, int]:
    """The topics with point clouds that flagstone can read, and their numbers of messages, sorted by name."""
    counts: dict[str, int] = {}
    for topic in sorted(bag.topics, key=lambda topic: topic.name):
        if _is_cloud(topic):
            counts[topic.name] = counts.get(topic.name, 0) + topic.message_count
    return counts


def choose_topics(bag: Bag, names: Collection[str]) -> list[str]:
    """The topics to process: those named, otherwise the only point cloud topic of the bag.

    Raises:
        ValueError: A name is not a point cloud topic; or nothing is named, and the bag has none or several. One line
            that lists the topics.
    """
    known = cloud_topics(bag)
    if not known:
        others = sorted({f"{topic.name} ({topic.type})" for topic in bag.topics})
        raise ValueError(
            f"{bag.path}: contains no topic of point clouds (expected {ros.POINT_CLOUD2} or CustomMsg of Livox; "
            f"its topics are {', '.join(others) or 'none'})"
        )
    for name in names:
        if name not in known:
            raise ValueError(f"{bag.path}: '{name}' is not a topic of point clouds (expected one of {_listed(known)})")
    if names:
        return list(dict.fromkeys(names))
    originals = {name: count for name, count in known.items() if not _is_derived(name, known)}
    if len(originals) != 1:
        raise ValueError(
            f"{bag.path}: contains {len(originals)} topics of point clouds (expected a --topic; "
            f"choose from {_listed(originals)})"
        )
    return list(originals)


def check_outputs(bag: Bag, topics: Sequence[str], format: str) -> None:
    """Checks that the bag does not contain the topics to add.

    Raises:
        ValueError: The bag contains a topic of that name. One line.
    """
    names = {topic.name for topic in bag.topics}
    for topic in topics:
        for suffix in OUTPUTS[format]:
            if f"{topic}/{suffix}" in names:
                raise ValueError(
                    f"{bag.path}: contains {topic}/{suffix} already (expected a bag without it; use the bag from "
                    "which this one was made, or another --format)"
                )


def _is_cloud(topic: Topic) -> bool:
    package, _, name = topic.type.partition("/")
    full = topic.type if name.startswith("msg/") else f"{package}/msg/{name}"
    return full in ros.POINT_CLOUD_TYPES and topic.encoding in ("cdr", "ros1")


def _is_derived(name: str, known: Collection[str]) -> bool:
    original, _, last = name.rpartition("/")
    return last in OUTPUTS["both"] and original in known


def _listed(topics: dict[str, int]) -> str:
    return ", ".join(f"{name} ({count} messages)" for name, count in topics.items())
