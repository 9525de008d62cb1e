# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A segmenter from the values of the parameters, and the values that follow from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import flagstone
from flagstone_ros import declaration
from flagstone_ros.declaration import ParameterValue

Values = Mapping[str, ParameterValue]

_ARGUMENTS = ("sensor", "preset", "config", "sensor_height", "tilt", "threads")
_NODE_ONLY = {parameter.name for parameter in declaration.PARAMETERS} - {"method", *_ARGUMENTS}


@dataclass(frozen=True)
class Configuration:
    """The segmenter in use and the parameters that it was made from."""

    given: Values
    """Values that the user has set, by name. Settings in tables have names such as point.margin."""
    segmenter: flagstone.Segmenter
    values: Values
    """Values of all parameters: the given ones, and those that follow from them."""

    @property
    def uses_imu(self) -> bool:
        """Whether the up direction comes from an IMU."""
        return self.values["tilt"] == "imu"

    @property
    def estimates_mount(self) -> bool:
        """Whether the segmenter estimates its mounting pose, so that every cloud matters."""
        return self.values["sensor_height"] in ("estimate", "track") or self.values["tilt"] == "estimate"

    @property
    def metres_per_unit(self) -> float:
        """The setting mount.scale."""
        return float(self.segmenter.settings["mount"]["scale"])


def configure(given: Values, previous: Configuration | None = None) -> Configuration:
    """Makes a segmenter.

    Args:
        given: Values that the user has set, by the names of `declaration.PARAMETERS` and of the settings.
        previous: A configuration whose segmenter, with its estimates, is kept if only other parameters have changed.

    Raises:
        ValueError, TypeError, OSError: A value is invalid. The message is one line with the reason.
    """
    _check_node_parameters(given)
    kept = previous if previous is not None and _of_segmenter(previous.given) == _of_segmenter(given) else None
    segmenter = kept.segmenter if kept else _make_segmenter(given)
    values: dict[str, ParameterValue] = {
        parameter.name: parameter.default for parameter in declaration.PARAMETERS if parameter.default is not None
    }
    values.update(_values_in_use(segmenter))
    values.update(given)
    return Configuration(dict(given), segmenter, values)


def _of_segmenter(given: Values) -> Values:
    return {name: value for name, value in given.items() if name not in _NODE_ONLY}


def _make_segmenter(given: Values) -> flagstone.Segmenter:
    arguments: dict[str, Any] = {}
    for name, value in _of_segmenter(given).items():
        table, _, key = name.rpartition(".")
        (arguments.setdefault(table, {}) if table else arguments)[key] = value
    method = arguments.pop("method", declaration.METHODS[0])
    if method not in declaration.METHODS:
        raise ValueError(f"method: {method!r} is unknown (expected {' or '.join(declaration.METHODS)})")
    if method != "patchwork" and arguments.get("preset") == declaration.PRESETS[0]:
        del arguments["preset"]
    for name in ("sensor", "config"):
        if arguments.get(name) == "":
            del arguments[name]
    if arguments.get("tilt") == "imu":
        arguments["tilt"] = "off"  # the node levels the clouds
    return flagstone.make_segmenter(method, **arguments)


def _check_node_parameters(given: Values) -> None:
    """Checks the parameters that flagstone itself does not have."""
    limits = {parameter.name: parameter for parameter in declaration.PARAMETERS}
    for name in _NODE_ONLY & set(given):
        low, high, value = limits[name].low, limits[name].high, given[name]
        if low is not None and high is not None and not (isinstance(value, (int, float)) and low <= value <= high):
            raise ValueError(f"{name}: {value!r} is out of range (expected {limits[name].constraints})")
    if given.get("input_type", declaration.INPUT_TYPES[0]) not in declaration.INPUT_TYPES:
        raise ValueError(
            f"input_type: {given['input_type']!r} is not supported (expected {limits['input_type'].constraints})"
        )


def _values_in_use(segmenter: flagstone.Segmenter) -> dict[str, ParameterValue]:
    """The settings of a segmenter by the names of the parameters."""
    settings = segmenter.settings
    mount = settings["mount"]
    values: dict[str, ParameterValue] = {}
    for parameter in declaration.setting_parameters(segmenter.method):
        value: Any = settings
        for key in parameter.name.split("."):
            value = value[key]
        values[parameter.name] = tuple(value) if isinstance(value, (list, tuple)) else value
    values["sensor_height"] = settings["sensor_height"] if mount["height"] == "fixed" else mount["height"]
    values["tilt"] = tuple(mount["up"]) if mount["tilt"] == "fixed" else mount["tilt"]
    return values
