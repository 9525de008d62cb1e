# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The topics of the node of patchwork-plusplus, so that its subscribers need no change.

ros2 launch flagstone_ros patchworkpp_topics.launch.py points:=/velodyne_points sensor:=hdl-64e

The clouds keep their frame and all their fields; patchwork-plusplus drops all fields except x, y and z.
"""

from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

TOPICS = {
    "ground": "/patchworkpp/ground",
    "nonground": "/patchworkpp/nonground",
    "labelled": "/patchworkpp/cloud",
}


def generate_launch_description() -> LaunchDescription:
    """Starts the node with other topic names. Its arguments are those of ground_segmentation.launch.py."""
    file = PathJoinSubstitution([FindPackageShare("flagstone_ros"), "launch", "ground_segmentation.launch.py"])
    return LaunchDescription(
        [IncludeLaunchDescription(PythonLaunchDescriptionSource(file), launch_arguments=TOPICS.items())]
    )
