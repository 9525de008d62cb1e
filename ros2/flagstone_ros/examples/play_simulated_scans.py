# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Publishes simulated scans of a street on the topic points, as a driver does: 10 scans per second, frame lidar.

python examples/play_simulated_scans.py
"""

import contextlib
import tempfile

import numpy as np
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile
from sensor_msgs.msg import PointCloud2

import flagstone
from flagstone import ros


def main() -> None:
    with tempfile.TemporaryDirectory() as directory:
        frames = flagstone.simulate(directory, scene="urban_street", sensor="vlp-16", sensor_height=1.8, frames=20)
        scans = [np.fromfile(frame.scan, np.float32).reshape(-1, 4) for frame in frames]

    rclpy.init()
    node = rclpy.create_node("simulated_lidar")
    publisher = node.create_publisher(PointCloud2, "points", QoSProfile(depth=5))
    published = 0

    def publish() -> None:
        nonlocal published
        stamp = node.get_clock().now().seconds_nanoseconds()
        publisher.publish(ros.serialize(scans[published % len(scans)], frame_id="lidar", stamp=stamp))
        published += 1

    node.create_timer(0.1, publish)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


if __name__ == "__main__":
    main()
