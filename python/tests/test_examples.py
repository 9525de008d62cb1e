# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The programs in examples/python run, and the comparison with other packages reports correct results."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import flagstone

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"
NUMBERED = sorted(EXAMPLES.glob("0*.py"))


def run(program: Path, *arguments: str, folder: Path) -> str:
    """Runs a program in a directory, without access to real scans, and returns its output."""
    environment = {name: value for name, value in os.environ.items() if name != "FLAGSTONE_DATA"}
    environment["PYTHONPATH"] = str(Path(flagstone.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, program, *arguments], cwd=folder, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def side_by_side() -> ModuleType:
    spec = importlib.util.spec_from_file_location("side_by_side", EXAMPLES / "side_by_side.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # inspect.getsource needs it
    spec.loader.exec_module(module)
    return module


def test_there_are_five_numbered_examples() -> None:
    assert [path.name[:2] for path in NUMBERED] == ["01", "02", "03", "04", "05"]


WITHOUT_OTHER_PACKAGES = """
import runpy, sys
sys.modules |= dict.fromkeys(("pandas", "matplotlib", "pyarrow", "laspy", "ray", "rerun"))
runpy.run_path(sys.argv[1], run_name="__main__")
"""


@pytest.mark.parametrize("example", NUMBERED, ids=lambda path: path.stem)
def test_an_example_has_at_most_40_lines_and_needs_only_numpy(example: Path, tmp_path: Path) -> None:
    assert len(example.read_text().splitlines()) <= 40
    program = tmp_path / "program.py"
    program.write_text(WITHOUT_OTHER_PACKAGES)
    assert run(program, str(example), folder=tmp_path)


def test_all_types_of_points_give_the_same_labels(tmp_path: Path) -> None:
    printed = run(EXAMPLES / "03_your_own_points.py", folder=tmp_path)

    assert re.findall("(records|bytes|organized): (True|False)", printed) == [
        ("records", "True"),
        ("bytes", "True"),
        ("organized", "True"),
    ]


def test_an_example_with_threads_writes_the_labels_of_one_thread(tmp_path: Path) -> None:
    run(EXAMPLES / "05_a_folder_of_scans.py", folder=tmp_path)

    segmenter = flagstone.Surface(sensor="hdl-64e")
    scans = sorted((tmp_path / "scans").glob("*.bin"))
    assert len(scans) == 3
    for scan in scans:
        labels = np.fromfile(tmp_path / "labels" / f"{scan.stem}.label", np.uint32)
        assert np.array_equal(labels, segmenter.segment(flagstone.io.read(scan)).labels)


@pytest.mark.parametrize("protocol", ["patchwork", "patchwork++"])
def test_side_by_side_scores_like_the_package(side_by_side: ModuleType, simulated: Path, protocol: str) -> None:
    sequence = simulated / "sequences" / "00"
    scan = side_by_side.read_scan(sequence / "velodyne" / "000000.bin", sequence / "labels" / "000000.label")
    labels = flagstone.Surface(sensor="vlp-16").segment(scan.points).labels

    f1 = side_by_side.f1_of(labels == 1, *side_by_side.truth_of(scan, protocol))

    assert f1 == pytest.approx(flagstone.score(labels, scan.classes, scan.points, protocol=protocol).f1)
    assert 0.5 < f1 < 1


def test_side_by_side_compares_installed_packages_and_names_missing_ones(
    side_by_side: ModuleType, tmp_path: Path
) -> None:
    printed = run(EXAMPLES / "side_by_side.py", "--quick", folder=tmp_path)

    for contender in side_by_side.CONTENDERS:
        if importlib.util.find_spec(contender.package):
            assert printed.count(f"| {contender.title} |") == 2, "a row of time and accuracy, one of behaviour"
        else:
            assert f"skipped: {contender.package} is not installed" in printed
    assert (
        printed.count("none labelled ground; no other label changes | none labelled ground; no other label changes |")
        >= 2
    )
    assert "skipped: real scans" in printed


def test_side_by_side_fills_the_tables_of_a_page(side_by_side: ModuleType) -> None:
    page = "before\n<!-- table kitti -->\nold\n<!-- end -->\nafter <!-- table other --> kept <!-- end -->"

    assert side_by_side.filled(page, {"kitti": "new"}) == (
        "before\n<!-- table kitti -->\n\nnew\n\n<!-- end -->\nafter <!-- table other --> kept <!-- end -->"
    )


def test_side_by_side_reports_crashes_and_errors(side_by_side: ModuleType) -> None:
    scan = side_by_side.Scan(np.zeros((10, 4), np.float32), np.zeros(10, np.uint32))

    crash = side_by_side.Contender("", "", crashing, "")
    error = side_by_side.Contender("", "", refusing, "")

    assert side_by_side.what_happens(crash, scan, "empty") == "crashes (SIGSEGV)"
    assert side_by_side.what_happens(error, scan, "empty") == "`ValueError`: no points"


def crashing(_sensor_height: float) -> None:
    import os
    import signal

    os.kill(os.getpid(), signal.SIGSEGV)


def refusing(_sensor_height: float) -> None:
    raise ValueError("no points")
