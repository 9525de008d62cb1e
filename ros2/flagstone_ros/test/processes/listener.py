# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Receives point clouds on ROS 2 topics. Runs in an environment with ROS 2, without flagstone.

Prints one line of JSON per message: topic, seconds and nanoseconds of its stamp, time of receipt in nanoseconds, and
the digest of the message without its stamp. Writes the first message with each digest to DIRECTORY/DIGEST.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import pathlib
import struct
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import PointCloud2


def main() -> None:
    """Listens until it is interrupted, or until every topic has received enough messages."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("topics", nargs="+")
    parser.add_argument("--count", type=int, default=1, help="number of messages per topic, without those of stamp 0")
    parser.add_argument("--best-effort", action="store_true")
    parser.add_argument("--depth", type=int, default=200)
    parser.add_argument("--ready", type=pathlib.Path, help="file to create when every topic has received a message")
    parser.add_argument("--seconds", type=float, default=40.0, help="time after which to give up")
    arguments = parser.parse_args()
    rclpy.init(args=[])
    node = rclpy.create_node("listener")
    quality = QoSProfile(depth=arguments.depth)
    if arguments.best_effort:
        quality.reliability = ReliabilityPolicy.BEST_EFFORT
    seen: set[str] = set()
    counts = dict.fromkeys(arguments.topics, 0)
    begun: set[str] = set()

    def receive(topic: str, message: bytes) -> None:
        now = time.time_ns()
        sec, nanosec = struct.unpack_from("<iI" if message[1] & 1 else ">iI", message, 4)
        begun.add(topic)
        if arguments.ready is not None and len(begun) == len(arguments.topics):
            arguments.ready.touch()
        if sec == 0:
            return
        digest = hashlib.blake2b(memoryview(message)[12:], digest_size=16).hexdigest()
        if digest not in seen:
            seen.add(digest)
            (arguments.directory / digest).write_bytes(message)
        counts[topic] += 1
        print(json.dumps([topic, sec, nanosec, now, digest]), flush=True)

    for topic in arguments.topics:
        node.create_subscription(PointCloud2, topic, lambda m, topic=topic: receive(topic, m), quality, raw=True)
    deadline = time.monotonic() + arguments.seconds
    try:
        while min(counts.values()) < arguments.count and time.monotonic() < deadline:
            rclpy.spin_once(node, timeout_sec=0.2)
        node.destroy_node()
        rclpy.shutdown()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
