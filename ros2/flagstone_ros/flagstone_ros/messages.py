# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Conversion of the declaration to the types of rclpy and the message packages."""

from __future__ import annotations

import importlib
import math
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

from flagstone_ros import declaration

_TYPES = {
    "bool": Parameter.Type.BOOL,
    "integer": Parameter.Type.INTEGER,
    "double": Parameter.Type.DOUBLE,
    "string": Parameter.Type.STRING,
    "double_array": Parameter.Type.DOUBLE_ARRAY,
}


def descriptor_of(parameter: declaration.Parameter) -> ParameterDescriptor:
    """Description, range and constraints, as `ros2 param describe` prints them."""
    descriptor = ParameterDescriptor(
        name=parameter.name,
        description=parameter.description,
        additional_constraints=parameter.constraints,
        read_only=parameter.read_only,
        dynamic_typing=len(parameter.types) > 1,
    )
    low = -math.inf if parameter.low is None else parameter.low
    high = math.inf if parameter.high is None else parameter.high
    if parameter.types == ("double",):
        descriptor.floating_point_range = [FloatingPointRange(from_value=float(low), to_value=float(high))]
    elif parameter.types == ("integer",):
        descriptor.integer_range = [IntegerRange(from_value=int(low), to_value=int(high), step=1)]
    return descriptor


def default_of(parameter: declaration.Parameter) -> Any:
    """The second argument of declare_parameter: a value, or the type of a parameter without default."""
    if parameter.default is not None:
        return to_ros(parameter.default)
    return _TYPES[parameter.types[0]] if len(parameter.types) == 1 else None


def profile_of(quality: declaration.Quality) -> QoSProfile:
    """The default quality of service of a topic."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=quality.depth,
        reliability=ReliabilityPolicy[quality.reliability.upper()],
        durability=DurabilityPolicy[quality.durability.upper()],
    )


def overriding_of(quality: declaration.Quality) -> QoSOverridingOptions | None:
    """The policies that parameters can change, or None."""
    if not quality.is_overridable:
        return None
    return QoSOverridingOptions([QoSPolicyKind[name.upper()] for name in declaration.OVERRIDABLE_POLICIES])


def message_class(name: str) -> Any:
    """The class of a message type such as sensor_msgs/msg/Imu.

    Raises:
        ImportError: Its package is not installed; the message is one line.
    """
    package, kind, message = name.split("/")
    try:
        return getattr(importlib.import_module(f"{package}.{kind}"), message)
    except ImportError as error:
        raise ImportError(
            f"{name}: the package {package} is not installed "
            f"(expected in this environment; install it, and source its setup file)"
        ) from error


def to_ros(value: declaration.ParameterValue) -> Any:
    """A value as rclpy expects it."""
    return list(value) if isinstance(value, tuple) else value
