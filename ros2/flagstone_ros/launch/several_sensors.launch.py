# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Several sensors, with one node each. Copy this file and change SENSORS.

ros2 launch flagstone_ros several_sensors.launch.py
"""

from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

# Namespace of the node and its outputs: topic of the clouds, file in config/sensors, parameters of this vehicle.
SENSORS = {
    "front": ("/front/points", "vlp-16", {"sensor_height": 1.1}),
    "rear": ("/rear/points", "vlp-16", {"sensor_height": 0.9, "tilt": [0.17, 0.0, 0.98]}),
    "roof": ("/roof/points", "os1-64", {"sensor_height": "track"}),
}


def generate_launch_description() -> LaunchDescription:
    """Starts one node per sensor, so that the sensors are segmented in parallel."""
    share = FindPackageShare("flagstone_ros")
    return LaunchDescription(
        [
            Node(
                package="flagstone_ros",
                executable="ground_segmentation",
                namespace=namespace,
                parameters=[PathJoinSubstitution([share, "config", "sensors", f"{sensor}.yaml"]), parameters],
                remappings=[("points", points)],
                output="screen",
            )
            for namespace, (points, sensor, parameters) in SENSORS.items()
        ]
    )
