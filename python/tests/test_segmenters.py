# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Segmenters: settings, sensors, mounting pose, pickling, threads."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Scan, random_scan, run_command

import flagstone
from flagstone import Patchwork, Surface, make_segmenter


def test_settings_have_the_requested_values() -> None:
    settings = Surface(sensor_height=1.5, point={"margin": 0.2}, max_range=60).settings
    assert settings["sensor_height"] == 1.5 and settings["point"]["margin"] == 0.2 and settings["max_range"] == 60
    assert settings["point"]["noise_depth"] == Surface().settings["point"]["noise_depth"]


def test_settings_can_be_passed_to_a_new_segmenter() -> None:
    segmenter = Patchwork(sensor="vlp-16", uprightness={"angle": 45}, flatness={"thresholds": [0.1, 0.2]})
    settings = segmenter.settings
    settings.pop("mount")
    assert Patchwork(**settings).settings == segmenter.settings


def test_settings_by_name_override_the_settings_file(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("distance_margin = 0.05\nseed_count = 7\n")
    settings = Patchwork(config=file, seed_count=9).settings
    assert settings["distance_margin"] == 0.05 and settings["seed_count"] == 9


def test_python_m_flagstone_runs_the_command() -> None:
    environment = {**os.environ, "PYTHONPATH": str(Path(flagstone.__file__).parents[1])}
    command = [sys.executable, "-m", "flagstone", "sensors"]
    assert subprocess.run(command, env=environment, capture_output=True, text=True).stdout == run_command("sensors")


def test_settings_printed_by_the_command_give_the_same_segmenter(tmp_path: Path) -> None:
    file = tmp_path / "printed.toml"
    file.write_text(run_command("config", "--method", "patchwork", "--sensor", "os0-128"))
    assert Patchwork(config=file).settings == Patchwork(sensor="os0-128").settings


def test_only_patchwork_has_presets() -> None:
    assert Patchwork(preset="paper").settings["evaluate_final_set"] is True
    assert make_segmenter("czm+u", preset="reference").method == "czm+u"
    with pytest.raises(ValueError, match="preset paper: surface has no presets"):
        make_segmenter("surface", preset="paper")


def test_a_custom_sensor_is_read_from_a_file(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text("beams = 16\nelevation_top = 15.0\nelevation_bottom = -15.0\nheight = 0.4\n")
    assert Patchwork(sensor=file).settings["sensor_height"] == 0.4
    assert Patchwork(sensor=file, sensor_height=0.5).settings["sensor_height"] == 0.5


def test_sensors_match_the_command() -> None:
    listed = run_command("sensors")
    for sensor in flagstone.sensors():
        assert sensor.name in listed and sensor.height > 0 and len(sensor.elevations) > 0
        assert Surface(sensor=sensor.name).settings["sensor_height"] == sensor.height


WRONG: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"colour": 1}, ValueError, "no setting 'colour'"),
    ({"point": {"margin": -1}}, ValueError, r"point\.margin = -1 is out of range \(expected 0 to 10 m"),
    ({"point": {"margin": "wide"}}, ValueError, r"point\.margin must be a number, got a string"),
    ({"point": {"margin": None}}, TypeError, r"point\.margin: NoneType is not a type of settings"),
    ({"point": 3}, ValueError, "point must be a table of settings, got an integer"),
    ({"sensor": "hdl-65e"}, ValueError, r"no sensor is named 'hdl-65e' \(expected .*; did you mean 'hdl-64e'"),
    ({"sensor_height": "guess"}, ValueError, "sensor_height: 'guess' is not a height"),
    ({"sensor_height": float("nan")}, ValueError, "sensor_height = nan is out of range"),
    ({"sensor_height": 1000}, ValueError, r"sensor_height = 1000 is out of range \(expected -100 to 100 m"),
    ({"tilt": "left"}, ValueError, "tilt: 'left' is not a tilt"),
    ({"tilt": (0, 0, 0)}, ValueError, "up"),
    ({"threads": 0}, ValueError, r"threads: 0 is out of range \(expected 1 to 1024\)"),
    ({"threads": -1}, ValueError, r"threads: -1 is out of range \(expected 1 to 1024\)"),
    ({"threads": "two"}, TypeError, r"threads: 'two' has the wrong type \(expected an integer\)"),
    ({"sensor_height": [1]}, TypeError, r"sensor_height: \[1\] has the wrong type \(expected a number"),
    ({"tilt": (1, 2)}, TypeError, r"tilt: \(1, 2\) has the wrong type \(expected three numbers"),
    ({"sensor": 64}, TypeError, r"sensor: 64 has the wrong type \(expected a name or path"),
    ({"config": 1}, TypeError, r"config: 1 has the wrong type \(expected a path"),
    ({"config": "nowhere.toml"}, ValueError, "nowhere.toml"),
]


@pytest.mark.parametrize(("arguments", "error", "message"), WRONG)
def test_invalid_settings_raise_one_line_errors(
    arguments: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message) as raised:
        Surface(**arguments)
    assert "\n" not in str(raised.value)


def test_an_unknown_method_is_rejected_with_the_known_names() -> None:
    with pytest.raises(ValueError, match=r"ransac.*patchwork"):
        make_segmenter("patchwerk")
    with pytest.raises(ValueError, match="threads = 2: method gpf supports only 1 thread"):
        make_segmenter("gpf", threads=2)


def test_the_sensor_height_is_estimated_from_a_scan() -> None:
    scan = random_scan()
    scan[:, 2] += 0.83  # the ground is now 0.9 m below the sensor
    result = Surface(sensor_height="estimate").segment(scan)
    assert result.mount.sensor_height == pytest.approx(0.9, abs=0.05)
    assert "0.90 m above the ground" in result.mount.decision


def test_reset_discards_the_estimated_height() -> None:
    low, high = random_scan(), random_scan(seed=2)
    low[:, 2] += 0.83
    segmenter = Surface(sensor_height="estimate")
    segmenter.segment(low)
    assert segmenter.segment(high).mount.sensor_height == pytest.approx(0.9, abs=0.05)
    segmenter.reset()
    assert segmenter.segment(high).mount.sensor_height == pytest.approx(1.73, abs=0.05)


def test_a_tilted_sensor_is_aligned_with_gravity(scan: Scan) -> None:
    angle = np.radians(25)
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    leaning = (scan[:, :3] @ turn.T).astype(np.float32)
    up = tuple(turn @ [0, 0, 1])
    straight = Surface().segment(scan).ground
    assert (Surface(tilt=up).segment(leaning).ground == straight).mean() > 0.99
    assert (Surface().segment(leaning).ground == straight).mean() < 0.95


@pytest.mark.parametrize(
    "segmenter",
    [
        Surface(sensor_height=1.6, point={"margin": 0.2}),
        Patchwork(sensor="vlp-16", preset="default"),
        make_segmenter("gpf", sensor_height=2),
    ],
    ids=repr,
)
def test_a_segmenter_can_be_pickled(segmenter: flagstone.Segmenter, scan: Scan) -> None:
    again = pickle.loads(pickle.dumps(segmenter))
    assert type(again) is type(segmenter) and again.settings == segmenter.settings
    assert np.array_equal(again.segment(scan).labels, segmenter.segment(scan).labels)


def test_repr_of_a_segmenter_is_the_call_that_creates_it() -> None:
    assert repr(Surface()) == "Surface()"
    assert (
        repr(Surface(sensor_height=1.5, point={"margin": 0.2})) == "Surface(sensor_height=1.5, point={'margin': 0.2})"
    )
    assert repr(Patchwork(preset="paper", threads=2)) == "Patchwork(preset='paper', threads=2)"
    assert repr(make_segmenter("gpf", tilt=np.array([0, 0, 1]))) == "make_segmenter('gpf', tilt=array([0, 0, 1]))"


FORKED = """
import os, signal, threading, numpy as np, flagstone
from conftest import random_scan

scan = random_scan(100_000)
segmenter = flagstone.Surface(threads=2)
expected = segmenter.segment(scan).labels.copy()
{before}
for _ in range(5):
    child = os.fork()
    if child == 0:
        signal.alarm(20)  # ends a child that hangs
        os._exit(0 if np.array_equal(segmenter.segment(scan).labels, expected) else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
assert np.array_equal(segmenter.segment(scan).labels, expected)
os._exit(0)
"""
OTHER_THREADS_SEGMENT = """
for _ in range(2):
    threading.Thread(target=lambda: [segmenter.segment(scan) for _ in range(100_000)], daemon=True).start()
"""


@pytest.mark.parametrize("before", ["", OTHER_THREADS_SEGMENT], ids=["idle", "while other threads segment"])
def test_parent_and_child_can_use_a_segmenter_after_a_fork(before: str) -> None:
    program = [sys.executable, "-W", "ignore", "-c", FORKED.format(before=before)]
    path = os.pathsep.join([str(Path(__file__).parent), str(Path(flagstone.__file__).parents[1])])
    done = subprocess.run(program, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, timeout=180)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("method", ["surface", "patchwork"])
def test_the_number_of_threads_does_not_change_the_labels(method: str, scan: Scan) -> None:
    assert np.array_equal(
        make_segmenter(method, threads=3).segment(scan).labels, make_segmenter(method).segment(scan).labels
    )


def test_threads_can_share_a_segmenter() -> None:
    scans = [random_scan(5000 + 1000 * i, seed=i) for i in range(6)]
    alone = [Surface().segment(scan).labels.copy() for scan in scans]
    shared = Surface()

    def labels_are_right(i: int) -> bool:
        return np.array_equal(shared.segment(scans[i % 6]).labels, alone[i % 6])

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(labels_are_right, range(300)))


def test_segment_releases_the_gil() -> None:
    scan = np.tile(random_scan(100_000), (20, 1))
    segmenter = Surface()
    thread = threading.Thread(target=segmenter.segment, args=(scan,))
    steps = 0
    thread.start()
    while thread.is_alive():
        steps += 1
    # Without releasing the GIL, the loop could only run before and after the segmentation.
    assert steps > 1000
