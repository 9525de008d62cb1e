# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone doctor` for bags."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._atomic_file import atomic_write
from flagstone._python_commands import SOME_FAILED, SUCCESS, print_error, print_line, segmenter_of
from flagstone.bags.clouds import choose_topics
from flagstone.bags.container import open_bag
from flagstone.bags.worker import parse
from flagstone.ros import PointCloud2


def run(options: dict[str, Any], paths: list[str]) -> int:
    """Examines clouds of bags and prints findings and recommended settings.

    Args:
        options: The options of the program, by name.
        paths: File for the settings, "" for none; then the bags.

    Returns:
        Exit code: 0, no problem found; 1, a problem was found or a cloud cannot be read.
    """
    output, *bags = paths
    segmenter = segmenter_of(options)
    examiner = _core.ScanExaminer(segmenter.method, segmenter.settings)
    problems = 0

    def report(line: str) -> None:
        nonlocal problems
        problems += 1
        print_error(line)

    for path in bags:
        examine_bag(path, [options["topic"]] if options["topic"] else [], options["max_scans"], examiner, report)
    prints_text = not options["json"] and not options["toml"]
    text, json, toml, examined, is_fine = examiner.report(prints_text and sys.stdout.isatty())
    if options["json"]:
        print_line(json, end="")
    elif examined:
        if prints_text:
            print_line(text, end="" if output else "\n")
        if not output:
            print_line(toml, end="")
    if output and examined:
        with atomic_write(output) as file:
            file.write(toml.encode())
    return SUCCESS if is_fine and not problems else SOME_FAILED


def examine_bag(
    path: str, topics: list[str], most: int, examiner: _core.ScanExaminer, report: Callable[[str], None]
) -> None:
    """Examines at most `most` clouds of a topic, evenly spaced over the bag.

    Raises:
        ValueError: The topic is missing, or the bag has several topics of point clouds and none is given.
    """
    with open_bag(path, report=report) as bag:
        topics = choose_topics(bag, topics)
        for topic in topics:
            count = sum(connection.message_count for connection in bag.topics_named(topic))
            chosen = {index * count // min(most, count) for index in range(min(most, count))}
            for index, message in enumerate(bag.messages([topic])):
                if index not in chosen:
                    continue
                name = f"{path}: {topic}: message {index}"
                try:
                    examiner.examine(name, columns_of(parse(message)))
                except ValueError as error:
                    report(f"{name}: {error}")
                    examiner.fail(name, f"{name}: {error}")


def columns_of(cloud: PointCloud2) -> npt.NDArray[np.float32]:
    """(N, 3): x, y and z; or (N, 5) with intensity 0 and the beam, if the cloud has a field for the beam."""
    ring = cloud.convention.ring
    if ring is None or ring not in (cloud.points.dtype.names or ()):
        return np.ascontiguousarray(cloud.xyz)
    columns = np.zeros((len(cloud), 5), np.float32)
    columns[:, :3] = cloud.xyz
    columns[:, 4] = cloud.points[ring].reshape(-1)
    return columns
