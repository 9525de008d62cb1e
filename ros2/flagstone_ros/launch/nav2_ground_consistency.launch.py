# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The topics of Nav2's tutorial for its Ground Consistency Layer.

ros2 launch flagstone_ros nav2_ground_consistency.launch.py points:=/velodyne_points sensor:=vlp-16

The layer transforms the clouds to the frame of the costmap; until then they keep the frame of the input.
"""

from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

TOPICS = {
    "ground": "/ground_segmentation/ground_points",
    "nonground": "/ground_segmentation/obstacle_points",
}


def generate_launch_description() -> LaunchDescription:
    """Starts the node with other topic names. Its arguments are those of ground_segmentation.launch.py."""
    file = PathJoinSubstitution([FindPackageShare("flagstone_ros"), "launch", "ground_segmentation.launch.py"])
    return LaunchDescription(
        [IncludeLaunchDescription(PythonLaunchDescriptionSource(file), launch_arguments=TOPICS.items())]
    )
