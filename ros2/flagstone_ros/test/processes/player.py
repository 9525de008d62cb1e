# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Publishes serialized messages from files, on a ROS 2 topic. Runs in an environment with ROS 2, without flagstone.

The time stamp of each message becomes the time of publishing, so that listeners can measure the latency and can match
their messages with the sent ones. Prints one line of JSON per message: [file, seconds, nanoseconds].
"""

from __future__ import annotations

import argparse
import importlib
import json
import pathlib
import struct
import sys
import time

import rclpy
from rclpy.duration import Duration
from rclpy.qos import QoSProfile, ReliabilityPolicy

STAMP = 4  # the header is the first member, after the four bytes of the encapsulation


def stamped(message: bytearray, now: int) -> bytes:
    """The message with another time stamp, nanoseconds since the epoch, in its own byte order."""
    if len(message) >= STAMP + 8:
        order = "<" if message[1] & 1 else ">"
        struct.pack_into(f"{order}iI", message, STAMP, *divmod(now, 1_000_000_000))
    return bytes(message)


def main() -> None:
    """Waits for a subscriber, publishes, and waits until the transport has sent everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("topic")
    parser.add_argument("files", nargs="+", type=pathlib.Path, help="messages, published in turn")
    parser.add_argument("--type", default="sensor_msgs/msg/PointCloud2")
    parser.add_argument("--count", type=int, help="number of messages (default: each file once)")
    parser.add_argument("--rate", type=float, default=20.0, help="messages per second")
    parser.add_argument("--best-effort", action="store_true")
    parser.add_argument("--transient-local", action="store_true")
    parser.add_argument("--depth", type=int, default=200)
    parser.add_argument("--until", type=pathlib.Path, help="publish the first file until this file exists, then begin")
    parser.add_argument("--keep-stamps", action="store_true", help="for messages that do not begin with a header")
    parser.add_argument("--linger", type=float, default=1.0, help="seconds to live after the last message")
    arguments = parser.parse_args()
    package, kind, name = arguments.type.split("/")
    message_type = getattr(importlib.import_module(f"{package}.{kind}"), name)
    rclpy.init(args=[])
    node = rclpy.create_node("player")
    quality = QoSProfile(depth=arguments.depth)
    if arguments.best_effort:
        quality.reliability = ReliabilityPolicy.BEST_EFFORT
    if arguments.transient_local:
        quality.durability = rclpy.qos.DurabilityPolicy.TRANSIENT_LOCAL
    publisher = node.create_publisher(message_type, arguments.topic, quality)
    messages = [bytearray(file.read_bytes()) for file in arguments.files]
    deadline = time.monotonic() + 30
    while publisher.get_subscription_count() == 0 and not arguments.transient_local:
        if time.monotonic() > deadline:
            sys.exit(f"no subscriber of {arguments.topic}")
        time.sleep(0.02)
    while arguments.until is not None and not arguments.until.exists():
        if time.monotonic() > deadline:
            sys.exit(f"{arguments.until} does not exist")
        publisher.publish(stamped(messages[0], 0))
        time.sleep(0.2)
    time.sleep(0.5 if arguments.until is not None else 0)
    start = time.monotonic()
    for i in range(arguments.count or len(messages)):
        time.sleep(max(0.0, start + i / arguments.rate - time.monotonic()))
        now = time.time_ns()
        file = i % len(messages)
        publisher.publish(bytes(messages[file]) if arguments.keep_stamps else stamped(messages[file], now))
        print(json.dumps([file, *divmod(now, 1_000_000_000)]), flush=True)
    if not arguments.best_effort:
        publisher.wait_for_all_acked(Duration(seconds=30))  # the messages end with their publisher
    time.sleep(arguments.linger)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
