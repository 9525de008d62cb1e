# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The types of the package are complete and correct, and help users who check their code."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import flagstone

PACKAGE = Path(flagstone.__file__).parent
REPOSITORY = Path(__file__).parents[2]

pytest.importorskip("mypy")

USER = """
import numpy as np
import numpy.typing as npt
from typing_extensions import assert_type

import flagstone

points: npt.NDArray[np.float32] = np.zeros((5, 3), np.float32)
segmenter = flagstone.Surface(sensor_height="estimate", point={"margin": 0.2})
result = segmenter.segment(points)
assert_type(result.labels, npt.NDArray[np.uint8])
assert_type(result.ground, npt.NDArray[np.bool_])
assert_type(result.heights, npt.NDArray[np.float32])
assert_type(result.counts, dict[str, int])
assert_type(result.surface.height(1, 2), float)
assert_type(result.surface.height(points[:, 0], 2), npt.NDArray[np.float32])
assert_type(flagstone.make_segmenter("gpf"), flagstone.Segmenter)
"""

MISTAKEN = """
import flagstone

flagstone.Surface(sensor_height="guess")
flagstone.Surface(point={"margins": 0.2})
flagstone.Patchwork(colour=1)
flagstone.Surface(preset="paper")
flagstone.io.write_labels("a.label", [1], label_map="kitti")
"""


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("mypy-cache")


def run(*arguments: str | Path, folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs a Python module in a directory without packages, so that only the installed package is found."""
    environment = dict(os.environ)
    if "site-packages" not in PACKAGE.parts:
        environment["MYPYPATH"] = str(PACKAGE.parent)
    command = [sys.executable, "-m", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment)


def mypy(cache: Path, *arguments: str | Path, folder: Path) -> subprocess.CompletedProcess[str]:
    return run("mypy", "--strict", f"--cache-dir={cache}", *arguments, folder=folder)


def test_the_package_passes_mypy_strict(tmp_path: Path, cache: Path) -> None:
    done = mypy(cache, f"--config-file={REPOSITORY / 'pyproject.toml'}", "-p", "flagstone", folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_ros_2_package_passes_mypy_strict(tmp_path: Path, cache: Path) -> None:
    sources = REPOSITORY / "ros2" / "flagstone_ros" / "flagstone_ros"
    done = mypy(cache, f"--config-file={REPOSITORY / 'pyproject.toml'}", sources, folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_user_code_passes_mypy_strict(tmp_path: Path, cache: Path) -> None:
    (tmp_path / "user.py").write_text(USER)
    done = mypy(cache, "--config-file=", "user.py", folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy_finds_mistakes_in_user_code(tmp_path: Path, cache: Path) -> None:
    (tmp_path / "mistaken.py").write_text(MISTAKEN)
    found = mypy(cache, "--config-file=", "mistaken.py", folder=tmp_path).stdout
    lines = {int(line.split(":")[1]) for line in found.splitlines() if "error:" in line}
    assert lines == {4, 5, 6, 7, 8}, found


def test_the_stub_of_the_compiled_module_is_up_to_date(tmp_path: Path) -> None:
    stubgen = pytest.importorskip("nanobind.stubgen")
    patterns = REPOSITORY / "python" / "src" / "stub_patterns.txt"
    stubgen.main(["-q", "-m", "flagstone._core", "-p", str(patterns), "-o", str(tmp_path / "_core.pyi")])
    assert (tmp_path / "_core.pyi").read_text() == (PACKAGE / "_core.pyi").read_text()


def test_stubtest_finds_only_known_differences_of_nanobind(tmp_path: Path) -> None:
    options = ["--concise", "--mypy-config-file", "", "--ignore-disjoint-bases"]
    found = run("mypy.stubtest", *options, "flagstone._core", folder=tmp_path).stdout.splitlines()
    # nanobind has its own types of functions and classes, and only segment() creates a Result.
    of_nanobind = ("is not a function", "metaclass differs", 'does not have *args parameter "args"')
    assert len(found) > 10
    assert [line for line in found if not line.endswith(of_nanobind)] == []


def test_typed_settings_are_up_to_date() -> None:
    script = REPOSITORY / "scripts" / "python-settings"
    printed = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True).stdout
    assert printed == (PACKAGE / "settings.py").read_text()
