# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A stand-in for the used part of launch and launch_ros, which no package registry for Python contains.

Each class records its arguments. `evaluate` replaces substitutions by their values.
"""

from __future__ import annotations

import importlib.util
import sys
import types
from pathlib import Path
from typing import Any

SHARE = Path(__file__).resolve().parents[1]
"""The directories launch, config and layouts are installed without changes."""


class Recorded:
    """An object that keeps its arguments."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self.arguments = arguments
        self.options = options


class LaunchDescription(Recorded): ...


class DeclareLaunchArgument(Recorded): ...


class IncludeLaunchDescription(Recorded): ...


class PythonLaunchDescriptionSource(Recorded): ...


class LaunchConfiguration(Recorded): ...


class PathJoinSubstitution(Recorded): ...


class FindPackageShare(Recorded): ...


class ParameterValue(Recorded): ...


class Node(Recorded): ...


MODULES = {
    "launch": [LaunchDescription],
    "launch.actions": [DeclareLaunchArgument, IncludeLaunchDescription],
    "launch.launch_description_sources": [PythonLaunchDescriptionSource],
    "launch.substitutions": [LaunchConfiguration, PathJoinSubstitution],
    "launch_ros": [],
    "launch_ros.actions": [Node],
    "launch_ros.parameter_descriptions": [ParameterValue],
    "launch_ros.substitutions": [FindPackageShare],
}


def evaluate(value: Any, given: dict[str, Any]) -> Any:
    """The value of substitutions, in lists and parameters too; `given`: values of the launch arguments."""
    if isinstance(value, LaunchConfiguration):
        return evaluate(given[value.arguments[0]], given)
    if isinstance(value, FindPackageShare):
        assert value.arguments == ("flagstone_ros",)
        return str(SHARE)
    if isinstance(value, PathJoinSubstitution):
        parts = [evaluate(part, given) for part in value.arguments[0]]
        return str(Path(*("".join(part) if isinstance(part, list) else part for part in parts)))
    if isinstance(value, ParameterValue):
        text = evaluate(value.arguments[0], given)
        return text == "true" if value.options["value_type"] is bool else value.options["value_type"](text)
    if isinstance(value, (list, tuple)):
        return type(value)(evaluate(part, given) for part in value)
    if isinstance(value, dict):
        return {key: evaluate(part, given) for key, part in value.items()}
    return value


def nodes(file: Path, arguments: dict[str, Any] | None = None) -> list[dict[str, Any]]:
    """The nodes that a launch file starts, with the values of their options."""
    for name, classes in MODULES.items():
        module = types.ModuleType(name)
        module.__dict__.update({recorded.__name__: recorded for recorded in classes})
        sys.modules[name] = module
    try:
        spec = importlib.util.spec_from_file_location(file.stem.replace(".", "_"), file)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        (entities,) = module.generate_launch_description().arguments
    finally:
        for name in MODULES:
            del sys.modules[name]
    given = dict(arguments or {})
    declared = [entity for entity in entities if isinstance(entity, DeclareLaunchArgument)]
    for entity in declared:
        assert entity.options["description"], "each argument has a description"
        given.setdefault(entity.arguments[0], entity.options["default_value"])
    unknown = set(given) - {entity.arguments[0] for entity in declared}
    found = []
    for entity in entities:
        if isinstance(entity, IncludeLaunchDescription):
            (source,) = entity.arguments
            passed = {**given, **dict(entity.options["launch_arguments"])}
            found += nodes(Path(evaluate(source.arguments[0], given)), passed)
            unknown = set()
        elif isinstance(entity, Node):
            found.append(evaluate(entity.options, given))
    assert not unknown, f"unknown arguments: {unknown}"
    return found
