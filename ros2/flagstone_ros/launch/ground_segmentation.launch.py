# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""One sensor.

ros2 launch flagstone_ros ground_segmentation.launch.py points:=/velodyne_points sensor:=hdl-64e

The outputs are in the namespace: `/ground`, `/nonground` and `/labelled` by default.
"""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

ARGUMENTS = {
    "points": ("points", "Topic of the clouds"),
    "ground": ("ground", "Topic of the ground points"),
    "nonground": ("nonground", "Topic of the other points"),
    "labelled": ("labelled", "Topic of all points with label and height"),
    "imu": ("imu", "Topic of the IMU, for tilt:=imu"),
    "namespace": ("", "Namespace of the node and its outputs"),
    "sensor": ("hdl-64e", "Name of a file in config/sensors, which contains the parameters of the sensor"),
    "params_file": (
        PathJoinSubstitution(
            [FindPackageShare("flagstone_ros"), "config", "sensors", [LaunchConfiguration("sensor"), ".yaml"]]
        ),
        "File of parameters (default: the file of the sensor)",
    ),
    "sensor_frame": ("", "Frame of the sensor, if the clouds are in another frame"),
    "use_sim_time": ("false", "Whether to use the time of a simulation or of a bag"),
}
TOPICS = ("points", "ground", "nonground", "labelled", "imu")


def generate_launch_description() -> LaunchDescription:
    """Starts the node."""
    node = Node(
        package="flagstone_ros",
        executable="ground_segmentation",
        namespace=LaunchConfiguration("namespace"),
        parameters=[
            LaunchConfiguration("params_file"),
            {
                "sensor_frame": ParameterValue(LaunchConfiguration("sensor_frame"), value_type=str),
                "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
            },
        ],
        remappings=[(name, LaunchConfiguration(name)) for name in TOPICS],
        output="screen",
    )
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, (default, description) in ARGUMENTS.items()
    ]
    return LaunchDescription([*declared, node])
