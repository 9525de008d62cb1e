# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone bag`."""

from __future__ import annotations

import json
import warnings
from typing import Any

from flagstone._progress import Progress
from flagstone._python_commands import SOME_FAILED, SUCCESS, failed, print_error, print_line, segmenter_of
from flagstone.bags.container import Message, open_bag
from flagstone.bags.job import label_bag
from flagstone.bags.summary import BagSummary
from flagstone.bags.worker import LabelledCloud


def run(options: dict[str, Any], paths: list[str]) -> int:
    """Runs the command.

    Args:
        options: The options of the program, by name. 0 and "" are unset.
        paths: Source and destination.

    Returns:
        Exit code: 0, success; 1, some clouds failed or the bag is damaged.
    """
    source, destination = paths
    prints_json = options["json"]
    problems: list[str] = []
    bar: Progress | None = None
    out_of_range = 0

    def notify(line: str) -> None:
        if bar is not None:
            bar.clear()
        print_error(line)

    def inform(line: str) -> None:
        if not prints_json:
            print_line(line)

    def on_problem(line: str) -> None:
        problems.append(line)
        notify(line)

    def on_cloud(message: Message, index: int, cloud: LabelledCloud) -> None:
        nonlocal out_of_range
        out_of_range += 2 * (cloud.counts or {}).get("out_of_range", 0) > cloud.points
        if prints_json:
            if bar is not None:
                bar.clear()
            print_line(json.dumps(_record(source, message, index, cloud)))

    warnings.simplefilter("ignore", UserWarning)  # points out of range: one line for all clouds, below
    segmenter = segmenter_of(options)
    try:
        opened = open_bag(source, report=on_problem)
    except (OSError, ValueError) as error:
        return failed(error, SOME_FAILED)
    bar = Progress(opened.message_count, "messages")
    with opened, bar:
        summary = label_bag(
            opened,
            destination,
            segmenter=segmenter,
            topics=options["topics"],
            tf=options["sensor_frame"] or None,
            imu=options["imu"] or None,
            format=options["format"],
            threads=options["threads"] or None,
            bar=bar,
            problems=problems,
            notify=notify,
            inform=inform,
            on_cloud=on_cloud,
        )
    if out_of_range:
        print_error(
            f"{source}: in {out_of_range} of {summary.clouds} clouds, most points are out of range (expected metres "
            "and an origin at the sensor; 'flagstone doctor' finds the cause)"
        )
    print_line(json.dumps(_summary_record(summary)) if prints_json else summary)
    return SUCCESS if summary.ok else SOME_FAILED


def _record(source: str, message: Message, index: int, cloud: LabelledCloud) -> dict[str, Any]:
    record: dict[str, Any] = {
        "file": source,
        "topic": message.topic.name,
        "message": index,
        "log_time": message.log_time,
    }
    if cloud.error:
        return {**record, "error": cloud.error}
    record |= {
        "points": cloud.points,
        "counts": cloud.counts,
        "patches": cloud.patches,
        "milliseconds": {"segment": cloud.segment_ms, "encode": cloud.encode_ms},
    }
    if cloud.mount is not None:
        mount = cloud.mount
        record["mount"] = {"sensor_height": mount.sensor_height, "up": mount.up, "why": mount.decision}
    record["outputs"] = [f"{message.topic.name}/{suffix}" for suffix, _ in cloud.outputs]
    return record


def _summary_record(summary: BagSummary) -> dict[str, Any]:
    times = summary.times
    return {
        "bag": summary.destination,
        "messages": summary.messages,
        "clouds": summary.clouds,
        "failed": len(summary.failures),
        "problems": list(summary.problems),
        "points": summary.points,
        "counts": summary.counts,
        "bytes": summary.bytes,
        "threads": summary.threads,
        "seconds": {
            "total": times.total,
            "read": times.read,
            "write": times.write,
            "wait": times.wait,
            "segment": times.segment,
            "encode": times.encode,
        },
        "bottleneck": times.bottleneck,
    }
