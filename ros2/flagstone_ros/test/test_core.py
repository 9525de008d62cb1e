# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""From the bytes of a message to the bytes of the outputs."""

from __future__ import annotations

import numpy as np
import pytest
from clouds import message, ouster, scans

import flagstone
from flagstone import ros
from flagstone_ros import core
from flagstone_ros.frames import Transform, shortest_rotation_to_z

TILTED = np.array([np.sin(0.6), 0.0, np.cos(0.6)])


def test_outputs_contain_all_fields_of_the_labelled_points() -> None:
    (points,) = scans()
    result = flagstone.Surface().segment(points)
    segmented = core.segment(ros.parse(message(points, "lidar")), flagstone.Surface(), core.OUTPUTS)
    original = ouster(points)
    labelled = ros.parse(segmented.messages["labelled"])
    assert labelled.header.frame_id == "lidar"
    assert (labelled.points["label"] == result.labels).all()
    assert labelled.points["height"].tobytes() == result.heights.tobytes()
    assert (labelled.points["ring"] == original["ring"]).all()
    for name, kept in (("ground", result.ground), ("nonground", result.labels == flagstone.Label.NONGROUND)):
        output = ros.parse(segmented.messages[name]).points
        assert output.dtype.names == original.dtype.names
        for field in original.dtype.names or ():
            assert output[field].tobytes() == original[kept][field].tobytes()


def test_only_wanted_outputs_are_written() -> None:
    (points,) = scans()
    segmented = core.segment(ros.parse(message(points)), flagstone.Surface(), ["ground"])
    assert list(segmented.messages) == ["ground"]
    assert core.segment(ros.parse(message(points)), flagstone.Surface(), []).messages == {}


def test_a_cloud_in_another_frame_gets_the_labels_of_the_sensor_frame_and_keeps_its_points() -> None:
    (points,) = scans()
    in_base = points.copy()
    to_base = Transform.from_quaternion((1.5, -0.5, 1.73), (0, 0, np.sin(0.5), np.cos(0.5)))
    in_base[:, :3] = to_base.apply(points[:, :3])
    cloud = ros.parse(message(in_base))
    segmented = core.segment(cloud, flagstone.Surface(), ["labelled"], to_base.inverse())
    output = ros.parse(segmented.messages["labelled"])
    expected = flagstone.Surface().segment(points).labels
    assert (output.points["label"] == expected).mean() > 0.999
    assert output.xyz.tobytes() == cloud.xyz.tobytes()


def test_gravity_levels_the_cloud_as_a_tilt_of_flagstone_does() -> None:
    (points,) = scans()
    tilted = points.copy()
    tilted[:, :3] = points[:, :3] @ shortest_rotation_to_z(TILTED).astype(np.float32)
    to_level = Transform(shortest_rotation_to_z(TILTED), np.zeros(3))
    segmented = core.segment(ros.parse(message(tilted)), flagstone.Surface(), ["labelled"], to_level)
    labels = ros.parse(segmented.messages["labelled"]).points["label"]
    assert (labels == flagstone.Surface(tilt=tuple(TILTED)).segment(tilted).labels).mean() > 0.999
    assert (labels != flagstone.Surface().segment(tilted).labels).mean() > 0.1


def test_a_cloud_in_millimetres_causes_the_warning_of_flagstone() -> None:
    (points,) = scans()
    points = points * np.float32([1000, 1000, 1000, 1])
    segmented = core.segment(ros.parse(message(points)), flagstone.Surface(), core.OUTPUTS)
    assert segmented.out_of_range > 0.9
    assert segmented.warning is not None
    assert "set mount.scale to 0.001" in segmented.warning
    assert core.segment(ros.parse(message(points[:50])), flagstone.Surface(), []).warning is None, "few points"


def test_a_cloud_of_invalid_points_is_segmented() -> None:
    points = np.full((50, 4), np.nan, np.float32)
    segmented = core.segment(ros.parse(message(points)), flagstone.Surface(), core.OUTPUTS)
    assert segmented.out_of_range == 0
    assert (ros.parse(segmented.messages["labelled"]).points["label"] == flagstone.Label.INVALID).all()
    assert len(ros.parse(segmented.messages["ground"])) == 0


def test_a_cloud_without_coordinates_is_an_error_of_one_line() -> None:
    cloud = ros.parse(ros.serialize(np.zeros(3, [("x", "f4"), ("intensity", "f4")])))
    with pytest.raises(ValueError, match="y") as raised:
        core.segment(cloud, flagstone.Surface(), core.OUTPUTS)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(("up", "degrees"), [((0, 0, 1), 0), ((0, 1, 1), 45), ((0, 0, -2), 180)])
def test_the_tilt_is_the_angle_to_the_z_axis(up: tuple[float, ...], degrees: float) -> None:
    assert core.tilt_of(up) == pytest.approx(degrees)
