# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The declaration of the node is complete, and the component and the documentation follow it."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import flagstone

PACKAGE = Path(__file__).resolve().parents[1]
SCRIPTS = PACKAGE.parents[1] / "scripts"
sys.path.insert(0, str(PACKAGE))

from flagstone_ros import declaration  # noqa: E402

PYTHON_TYPES: dict[str, type] = {"bool": bool, "integer": int, "double": float, "string": str}


def check(script: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, SCRIPTS / script, "--check"], capture_output=True, text=True)


def value_of(settings: dict[str, Any], name: str) -> Any:
    value: Any = settings
    for key in name.split("."):
        value = value[key]
    return value


def test_header_of_the_component_is_current() -> None:
    done = check("component-declaration")
    assert done.returncode == 0, done.stdout + done.stderr


def test_names_are_unique() -> None:
    for method in declaration.METHODS:
        parameters = [*declaration.PARAMETERS, *declaration.setting_parameters(method)]
        names = [parameter.name for parameter in parameters]
        assert len(names) == len(set(names))
    topics = [topic.name for topic in declaration.TOPICS]
    assert len(topics) == len(set(topics))


@pytest.mark.parametrize("parameter", declaration.PARAMETERS, ids=lambda parameter: parameter.name)
def test_default_has_the_type_and_the_range_of_the_parameter(parameter: declaration.Parameter) -> None:
    if parameter.default is None:
        return
    assert isinstance(parameter.default, PYTHON_TYPES[parameter.types[0]])
    if parameter.low is not None and parameter.high is not None:
        assert isinstance(parameter.default, (int, float))
        assert parameter.low <= parameter.default <= parameter.high


@pytest.mark.parametrize("method", declaration.METHODS)
def test_settings_are_all_settings_of_the_method_except_those_with_their_own_parameter(method: str) -> None:
    settings = flagstone.make_segmenter(method).settings
    expected = {
        f"{table}.{key}" if isinstance(entry, dict) else table
        for table, entry in settings.items()
        for key in (entry if isinstance(entry, dict) else [table])
    } - {"zones", "sensor_height", "mount.height", "mount.tilt", "mount.up"}

    assert {parameter.name for parameter in declaration.setting_parameters(method)} == expected


@pytest.mark.parametrize("method", declaration.METHODS)
def test_default_settings_have_the_declared_type_and_range(method: str) -> None:
    settings = flagstone.make_segmenter(method).settings
    for parameter in declaration.setting_parameters(method):
        value = value_of(settings, parameter.name)
        (kind,) = parameter.types
        if kind == "double_array":
            assert all(isinstance(number, float) for number in value), parameter.name
            continue
        assert isinstance(value, PYTHON_TYPES[kind]), parameter.name
        if kind in ("integer", "double"):
            assert parameter.low is not None and parameter.high is not None
            assert parameter.low <= value <= parameter.high, parameter.name


def test_settings_that_can_be_infinite_have_no_maximum() -> None:
    settings = {parameter.name: parameter for parameter in declaration.setting_parameters("surface")}
    assert settings["acceptance.max_step"].high == math.inf
    assert settings["point.margin"].high == 10


def test_input_types_are_those_that_flagstone_reads() -> None:
    assert set(declaration.INPUT_TYPES) == set(flagstone.ros.POINT_CLOUD_TYPES)
