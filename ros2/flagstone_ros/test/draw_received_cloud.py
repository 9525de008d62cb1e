# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Plays simulated scans through the node and draws the cloud that a listener receives, by label and by height.

    build-python/environment-3.11/bin/python ros2/flagstone_ros/test/draw_received_cloud.py docs/images/ros-2-node.png

The scans, the node and the listener are separate processes of ROS 2 Kilted and Jazzy.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import matplotlib  # noqa: E402

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import ListedColormap  # noqa: E402
from ros_processes import PACKAGE, Ros, free_domain, temporary_directory  # noqa: E402

import flagstone  # noqa: E402
from flagstone import ros as codec  # noqa: E402

COLORS = ["#3b6fb5", "#d9a520", "#c0392b", "#bbbbbb", "#000000"]
EXTENT = 25.0  # metres in each direction


def received_cloud() -> codec.PointCloud2:
    """A labelled cloud from a listener."""
    directory = temporary_directory()
    ros = Ros(directory, free_domain())
    try:
        ros.node("kilted", parameters={"sensor": "vlp-16", "sensor_height": 1.8})
        ros.start("kilted", PACKAGE / "examples" / "play_simulated_scans.py")
        line = ros.listener("jazzy", "labelled").finish()[-1]
        return codec.parse((directory / line[4]).read_bytes())
    finally:
        ros.close()
        shutil.rmtree(directory)


def draw(cloud: codec.PointCloud2, file: Path) -> None:
    """Draws the top view of the cloud twice."""
    x, y = cloud.xyz[:, 0], cloud.xyz[:, 1]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.4), dpi=100, layout="constrained")
    names = [label.name.lower() for label in flagstone.Label]
    labels = cloud.points["label"]
    points = left.scatter(x, y, c=labels, s=0.6, cmap=ListedColormap(COLORS), vmin=-0.5, vmax=4.5, linewidths=0)
    bar = figure.colorbar(points, ax=left, ticks=range(5))
    bar.ax.set_yticklabels(names)
    left.set_title("label")
    heights = np.clip(cloud.points["height"], -0.2, 3)
    order = np.argsort(heights)
    points = right.scatter(x[order], y[order], c=heights[order], s=0.6, cmap="viridis", vmin=-0.2, vmax=3, linewidths=0)
    figure.colorbar(points, ax=right, label="metres above the ground")
    right.set_title("height")
    for axes in (left, right):
        axes.set(xlim=(-EXTENT, EXTENT), ylim=(-EXTENT, EXTENT), aspect="equal", xlabel="x, metres", ylabel="y, metres")
    figure.savefig(file)


if __name__ == "__main__":
    draw(received_cloud(), Path(sys.argv[1]))
