# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Options and fixtures of the tests of the ROS 2 package.

The tests with ROS 2 run several processes with the wheels of ROS 2 Jazzy and Kilted; see scripts/ros-environment.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import ros_processes  # noqa: E402


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--clouds", type=int, default=60, help="clouds per combination of distributions (default: 60)")


@pytest.fixture
def ros() -> Iterator[ros_processes.Ros]:
    for distribution in ros_processes.DISTRIBUTIONS:
        ros_processes.python_of(distribution)  # creating an environment takes longer than a process may wait
    directory = ros_processes.temporary_directory()
    ros = ros_processes.Ros(directory, ros_processes.free_domain())
    yield ros
    ros.close()
    shutil.rmtree(directory)
