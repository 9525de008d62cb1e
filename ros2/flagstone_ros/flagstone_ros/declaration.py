# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The parameters, topics, qualities of service and diagnostics of the node and of the component.

This is the only declaration of them. The rclpy node reads it at run time. `scripts/component-declaration` writes it as
the C++ header of the rclcpp component, and `scripts/ros-parameters` writes it as tables for the documentation. The
settings of the methods are not repeated here: `setting_parameters` reads them from flagstone, as the component does.

The module needs neither ROS nor, except for `setting_parameters`, flagstone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

ParameterType = Literal["bool", "integer", "double", "string", "double_array"]
ParameterValue = bool | int | float | str | tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of the node."""

    name: str
    types: tuple[ParameterType, ...]
    """Allowed types. With more than one, the parameter is declared with dynamic typing."""
    default: ParameterValue | None
    """None: the value follows from the other parameters; the value of the segmenter in use."""
    description: str
    low: float | None = None
    """Minimum of a number; None for other types. A value at an exclusive minimum is rejected by flagstone."""
    high: float | None = None
    """Maximum of a number; may be infinite."""
    constraints: str = ""
    """The allowed values in words, for the parameter's description and the documentation."""
    read_only: bool = False
    """Whether the parameter can only be set when the node starts."""


@dataclass(frozen=True, slots=True)
class Quality:
    """Quality of service of a topic; the history is always the last `depth` messages."""

    reliability: Literal["reliable", "best_effort"]
    durability: Literal["volatile", "transient_local"]
    depth: int
    is_overridable: bool
    """Whether parameters named qos_overrides.TOPIC.(subscription or publisher).POLICY change it."""


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic that the node subscribes to or publishes."""

    name: str
    """Relative names are in the namespace of the node, and can be remapped."""
    direction: Literal["in", "out"]
    type: str
    quality: Quality
    description: str


@dataclass(frozen=True, slots=True)
class DiagnosticValue:
    """A value of the diagnostics."""

    key: str
    decimals: int
    """Number of decimals; 0 also for integers and texts."""
    description: str


INPUT_TYPES = (
    "sensor_msgs/msg/PointCloud2",
    "livox_ros_driver2/msg/CustomMsg",
    "livox_interfaces/msg/CustomMsg",
    "livox_ros_driver/msg/CustomMsg",
)
"""The values of the parameter `input_type`."""

NODE_NAME = "ground_segmentation"
"""The default name of the node."""

METHODS = ("surface", "patchwork")
PRESETS = ("default", "paper", "reference")

PARAMETERS = (
    Parameter(
        "method",
        ("string",),
        "surface",
        "Method of segmentation. Its settings are parameters too.",
        constraints="surface or patchwork",
        read_only=True,
    ),
    Parameter(
        "input_type",
        ("string",),
        INPUT_TYPES[0],
        "Type of the messages on the topic points. The types of Livox need the package of their driver.",
        constraints=", ".join(INPUT_TYPES[:-1]) + " or " + INPUT_TYPES[-1],
        read_only=True,
    ),
    Parameter(
        "sensor",
        ("string",),
        "",
        "Sensor whose height and range to use; patchwork derives more settings from it.",
        constraints="a name that `flagstone sensors` prints, the path of a .toml file, or empty",
    ),
    Parameter(
        "preset",
        ("string",),
        PRESETS[0],
        "Settings of patchwork to start from if sensor is empty.",
        constraints="default, paper or reference",
    ),
    Parameter(
        "config",
        ("string",),
        "",
        "File of settings, as `flagstone config` prints them. Other parameters override it.",
        constraints="the path of a .toml file, or empty",
    ),
    Parameter(
        "sensor_height",
        ("double", "integer", "string"),
        None,
        "Height of the sensor above the ground in metres. estimate: from the first scan that determines it; "
        "track: updated with every scan. By default the height of the sensor, otherwise 1.73.",
        constraints="-100 to 100 m, estimate or track",
    ),
    Parameter(
        "tilt",
        ("string", "double_array"),
        None,
        "Up direction of a tilted sensor, in the frame of the sensor. off: the z axis; estimate: from the scans; "
        "imu: from the gravity that the topic imu measures. By default that of config, otherwise off.",
        constraints="off, estimate, imu or three numbers [x, y, z]",
    ),
    Parameter(
        "sensor_frame",
        ("string",),
        "",
        "Frame of the sensor: x forward, y left, z up, origin in the sensor. Clouds in other frames are transformed to "
        "it for segmentation, with the static transforms of /tf_static. Empty: the frame of each cloud.",
    ),
    Parameter(
        "imu_time_constant",
        ("double",),
        1.0,
        "Time constant of the low-pass filter of the gravity, in seconds. 0: no filter.",
        low=0.0,
        high=60.0,
        constraints="0 to 60 s",
    ),
    Parameter(
        "queue_depth",
        ("integer",),
        5,
        "Maximum number of clouds that wait for segmentation. If one more arrives, the oldest is dropped.",
        low=1,
        high=1000,
        constraints="1 to 1000",
        read_only=True,
    ),
    Parameter(
        "threads",
        ("integer",),
        1,
        "Number of threads per cloud. The result does not depend on it.",
        low=1,
        high=1024,
        constraints="1 to 1024",
    ),
    Parameter(
        "diagnostics_period",
        ("double",),
        1.0,
        "Time between diagnostics, in seconds.",
        low=0.1,
        high=60.0,
        constraints="0.1 to 60 s",
        read_only=True,
    ),
)
"""The parameters of the node itself, in the order in which they are declared."""

SENSOR_DATA = Quality("best_effort", "volatile", 5, is_overridable=True)
OUTPUT = Quality("reliable", "volatile", 5, is_overridable=True)
POINT_CLOUD2 = INPUT_TYPES[0]

TOPICS = (
    Topic("points", "in", POINT_CLOUD2, SENSOR_DATA, "Clouds to segment; another type if input_type selects it."),
    Topic(
        "imu",
        "in",
        "sensor_msgs/msg/Imu",
        SENSOR_DATA,
        "Acceleration at rest, which points up. Only subscribed to if tilt is imu.",
    ),
    Topic(
        "/tf_static",
        "in",
        "tf2_msgs/msg/TFMessage",
        Quality("reliable", "transient_local", 100, is_overridable=False),
        "Static transforms between the frames of clouds, sensor and IMU.",
    ),
    Topic("ground", "out", POINT_CLOUD2, OUTPUT, "The points with the label `ground`, with all their fields."),
    Topic("nonground", "out", POINT_CLOUD2, OUTPUT, "The points with the label `nonground`, with all their fields."),
    Topic(
        "labelled",
        "out",
        POINT_CLOUD2,
        OUTPUT,
        "All points with all their fields, and the fields label (uint8) and height (float32, metres above the ground).",
    ),
    Topic(
        "/diagnostics",
        "out",
        "diagnostic_msgs/msg/DiagnosticArray",
        Quality("reliable", "volatile", 10, is_overridable=False),
        "State of the node.",
    ),
)
"""The topics. An output is only computed while it has subscribers."""

OVERRIDABLE_POLICIES = ("reliability", "depth", "durability")
"""The policies that QoS override parameters can change."""

DIAGNOSTICS = (
    DiagnosticValue("method", 0, "the parameter method"),
    DiagnosticValue("clouds", 0, "number of segmented clouds since the node started"),
    DiagnosticValue("rate (Hz)", 1, "segmented clouds per second since the previous diagnostics"),
    DiagnosticValue("latency, median (ms)", 2, "from the receipt of a cloud to the end of publishing, same period"),
    DiagnosticValue("latency, worst (ms)", 2, "maximum in the same period"),
    DiagnosticValue("dropped", 0, "clouds dropped since the node started, because the node fell behind"),
    DiagnosticValue("skipped", 0, "clouds skipped since the node started: invalid, or without a transform"),
    DiagnosticValue("out of range (%)", 1, "points of the last cloud that are out of range"),
    DiagnosticValue("sensor height (m)", 3, "height of the sensor in use"),
    DiagnosticValue("tilt (degrees)", 2, "angle between the up direction in use and the z axis of the sensor"),
    DiagnosticValue("mount", 0, "the result of the estimate from the last cloud, or fixed"),
)
"""The values of the only status, in their order. Values that are not known yet are omitted."""

DIAGNOSTICS_NAME = "ground segmentation"
"""The name of the status is the name of the node with its namespace, a colon, a space and this."""

THROTTLE_SECONDS = 5.0
"""Minimum time between two log lines about the same problem."""

SILENCE_SECONDS = 2.0
"""Without a cloud for this long, the diagnostics warn."""

MOSTLY_OUT_OF_RANGE = 0.9
"""Above this fraction of points out of range (of at least 1,000 finite points), a warning is logged once."""

_SEPARATE = {"sensor_height", "mount.height", "mount.tilt", "mount.up"}
_TYPES: dict[str, ParameterType] = {
    "float": "double",
    "int": "integer",
    "bool": "bool",
    "str": "string",
    "Sequence[float]": "double_array",
}


def setting_parameters(method: str) -> tuple[Parameter, ...]:
    """The settings of a method and of the mounting pose, as parameters under their own names, such as point.margin.

    They are declared without a default: they show the value in use. The parameters sensor_height and tilt set the
    height and the up direction. Patchwork's zones, which are tables, can only be set in a file (parameter config).

    Args:
        method: One of `METHODS`.

    Returns:
        The parameters in the order of `flagstone config`.
    """
    from flagstone import _core

    return tuple(
        Parameter(name, (_TYPES[kind],), None, meaning, low, high, allowed)
        for name, kind, meaning, allowed, low, high in (*_core.settings(method), *_core.mount_settings())
        if name not in _SEPARATE
    )
