# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.score` compares the labels of one scan with its classes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import flagstone

ROAD, CAR, OUTLIER, VEGETATION = 40, 10, 1, 70


def test_points_are_counted_by_label_and_class() -> None:
    labels = [1, 1, 1, 0, 2, 3, 4, 0]
    classes = [ROAD, ROAD, CAR, ROAD, ROAD, CAR, CAR, CAR]
    score = flagstone.score(labels, classes, np.zeros((8, 3), np.float32))
    assert score == flagstone.Score(2, 1, 2, 3)
    assert (score.precision, score.recall, score.accuracy, score.iou) == (2 / 3, 1 / 2, 5 / 8, 2 / 5)
    assert score.f1 == pytest.approx(4 / 7)


def test_without_ground_only_the_accuracy_is_defined() -> None:
    for label, accuracy in ((0, 1.0), (1, 0.0)):
        score = flagstone.score([label], [CAR], np.zeros((1, 3), np.float32))
        assert np.isnan([score.precision, score.recall, score.f1, score.iou]).all() and score.accuracy == accuracy
    missed = flagstone.score([0], [ROAD], np.zeros((1, 3), np.float32))
    assert np.isnan(missed.precision) and (missed.recall, missed.f1, missed.iou) == (0, 0, 0)


def test_protocols_differ_in_vegetation_and_scored_classes() -> None:
    points = np.array([[5, 0, -1.7], [5, 0, 1], [5, 0, 0]], np.float32)
    classes, labels = [VEGETATION, VEGETATION, OUTLIER], [1, 0, 0]
    assert flagstone.score(labels, classes, points) == flagstone.Score(1, 0, 0, 2)
    assert flagstone.score(labels, classes, points, protocol="patchwork++") == flagstone.Score(0, 0, 0, 0)
    assert flagstone.score(labels, classes, points, protocol="simulation") == flagstone.Score(0, 1, 0, 2)


@pytest.mark.parametrize("protocol", ["patchwork", "patchwork++", "simulation"])
def test_scores_are_identical_to_evaluate(simulated: Path, protocol: str) -> None:
    pytest.importorskip("pandas")
    rows = flagstone.evaluate(simulated, methods=["surface"], protocol=protocol, sensor_height=0.6).scans
    for row in rows.itertuples():
        folder, name = simulated / "sequences" / "00", row.scan.removeprefix("00/")
        points = flagstone.io.read(folder / "velodyne" / f"{name}.bin")
        labels = flagstone.Surface(sensor_height=0.6).segment(points).labels
        classes = flagstone.io.read_labels(folder / "labels" / f"{name}.label", len(points))
        score = flagstone.score(labels, classes, points, protocol=protocol)
        assert score == flagstone.Score(row.tp, row.fp, row.fn, row.tn)
        assert score.f1 == pytest.approx(row.f1, abs=1e-6)


def test_inputs_that_do_not_match_raise_one_line_errors() -> None:
    points = np.zeros((2, 3), np.float32)
    with pytest.raises(ValueError, match="1 labels and 2 classes do not match 2 points"):
        flagstone.score([1], [ROAD, ROAD], points)
    with pytest.raises(ValueError, match=r"labels: 5 is out of range \(expected integers from 0 to 4"):
        flagstone.score([0, 5], [ROAD, ROAD], points)
    with pytest.raises(ValueError, match=r"classes: -1 is out of range \(expected integers from 0 to 65,535"):
        flagstone.score([0, 1], [-1, 40], points)
    with pytest.raises(TypeError, match="labels: dtype float64 is not supported"):
        flagstone.score([0.0, 1.0], [ROAD, ROAD], points)
    with pytest.raises(ValueError, match=r"protocol: no protocol is named 'kitti' \(expected patchwork"):
        flagstone.score([0, 1], [ROAD, ROAD], points, protocol="kitti")
