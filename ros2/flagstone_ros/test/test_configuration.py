# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Segmenters from parameters, and the values that follow from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import flagstone
from flagstone_ros import declaration
from flagstone_ros.configuration import configure

DEFAULTS = {p.name: p.default for p in declaration.PARAMETERS if p.default is not None}


def test_every_parameter_has_a_value() -> None:
    for method in declaration.METHODS:
        names = {p.name for p in (*declaration.PARAMETERS, *declaration.setting_parameters(method))}
        assert set(configure({"method": method}).values) == names


def test_the_defaults_are_those_of_flagstone() -> None:
    configuration = configure(DEFAULTS)
    assert configuration.segmenter.settings == flagstone.Surface().settings
    assert configuration.values["point.margin"] == flagstone.Surface().settings["point"]["margin"]
    assert configuration.values["sensor_height"] == pytest.approx(1.73)
    assert configuration.values["tilt"] == "off"


def test_settings_have_their_own_names() -> None:
    settings = configure({**DEFAULTS, "point.margin": 0.5, "max_range": 50.0}).segmenter.settings
    assert settings["point"]["margin"] == 0.5
    assert settings["max_range"] == 50


def test_values_follow_from_the_sensor_unless_they_are_given() -> None:
    given = {**DEFAULTS, "method": "patchwork", "sensor": "vlp-16"}
    expected = flagstone.Patchwork(sensor="vlp-16").settings
    configuration = configure(given)
    assert configuration.values["sensor_height"] == expected["sensor_height"]
    assert configuration.values["min_range"] == expected["min_range"]
    taller = configure({**given, "sensor_height": 3.0}, configuration)
    expected = flagstone.Patchwork(sensor="vlp-16", sensor_height=3.0).settings
    assert taller.values["elevation.range"] == expected["elevation"]["range"]
    assert taller.values["distance_margin"] == expected["distance_margin"]


def test_a_file_of_settings_provides_values_that_others_override(tmp_path: Path) -> None:
    file = tmp_path / "settings.toml"
    file.write_text('sensor_height = 2.5\nmax_range = 60\n[mount]\nheight = "track"\n')
    values = configure({**DEFAULTS, "config": str(file), "max_range": 70.0}).values
    assert values["max_range"] == 70
    assert values["sensor_height"] == "track"


@pytest.mark.parametrize(
    ("given", "uses_imu", "estimates"),
    [
        ({}, False, False),
        ({"sensor_height": "track"}, False, True),
        ({"sensor_height": "estimate"}, False, True),
        ({"tilt": "estimate"}, False, True),
        ({"tilt": (0.1, 0.0, 1.0)}, False, False),
        ({"tilt": "imu"}, True, False),
        ({"tilt": "imu", "sensor_height": "track"}, True, True),
    ],
)
def test_height_and_tilt_have_the_sources_of_the_parameters(
    given: dict[str, Any], uses_imu: bool, estimates: bool
) -> None:
    configuration = configure({**DEFAULTS, **given})
    assert configuration.uses_imu == uses_imu
    assert configuration.estimates_mount == estimates


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"point.margin": -1.0}, "point.margin = -1 is out of range"),
        ({"point.margins": 1.0}, "margins"),
        ({"sensor": "nope"}, "no sensor is named 'nope'"),
        ({"config": "/nowhere.toml"}, "/nowhere.toml"),
        ({"sensor_height": "high"}, "sensor_height"),
        ({"sensor_height": 1000.0}, "sensor_height"),
        ({"tilt": "sideways"}, "tilt"),
        ({"tilt": (0.0, 0.0, 0.0)}, "up"),
        ({"tilt": (0.0, 1.0)}, "tilt"),
        ({"preset": "paper"}, "preset"),
        ({"method": "other"}, "method"),
        ({"method": "patchwork", "preset": "other"}, "other"),
        ({"threads": 0}, "threads"),
        ({"imu_time_constant": -1.0}, "imu_time_constant"),
        ({"queue_depth": 0}, "queue_depth"),
        ({"input_type": "sensor_msgs/msg/LaserScan"}, "input_type"),
    ],
)
def test_an_invalid_value_is_an_error_of_one_line_with_its_name(given: dict[str, Any], reason: str) -> None:
    with pytest.raises((ValueError, TypeError, OSError)) as raised:
        configure({**DEFAULTS, **given})
    assert reason in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_change_of_another_parameter_keeps_the_segmenter_and_its_estimates() -> None:
    first = configure({**DEFAULTS, "sensor_height": "track"})
    second = configure({**first.given, "sensor_frame": "lidar"}, first)
    assert second.segmenter is first.segmenter
    third = configure({**second.given, "point.margin": 0.3}, second)
    assert third.segmenter is not first.segmenter
