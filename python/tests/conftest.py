# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Shared by several tests: random scans, simulated scans and the command."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from flagstone import _command

Scan = npt.NDArray[np.float32]


def random_scan(points: int = 20_000, seed: int = 1) -> Scan:
    """(points, 4): flat ground 1.73 m below the sensor and a wall, in random order."""
    random = np.random.default_rng(seed)
    ground = random.uniform([-40, -40, -1.75, 0], [40, 40, -1.71, 1], (points * 8 // 10, 4))
    wall = random.uniform([10, -20, -1.7, 0], [10.1, 20, 1, 1], (points - len(ground), 4))
    scan = np.concatenate([ground, wall]).astype(np.float32)
    random.shuffle(scan)
    return scan


@pytest.fixture(scope="session")
def scan() -> Scan:
    return random_scan()


def run_command(*arguments: str | Path) -> str:
    """Runs the command of the package and returns its output."""
    done = subprocess.run([_command.path(), *arguments], check=True, capture_output=True, text=True)
    return done.stdout


@pytest.fixture(scope="session")
def simulated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Directory of a simulated sequence of two scans: sequences/00/velodyne/000000.bin and so on."""
    folder = tmp_path_factory.mktemp("simulated")
    run_command("simulate", "--scene", "flat_street", "--sensor", "vlp-16", "--frames", "2", "--output", folder)
    return folder
