# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Static transforms between frames."""

from __future__ import annotations

import numpy as np
import pytest

from flagstone_ros.frames import StaticTransforms, Transform, shortest_rotation_to_z

QUARTER_TURN_LEFT = (0, 0, np.sqrt(0.5), np.sqrt(0.5))  # about z
IDENTITY = (0, 0, 0, 1)


def moved(transform: Transform | None, point: tuple[float, float, float]) -> list[float]:
    assert transform is not None
    return [float(value) for value in np.round(transform.apply(np.array([point], np.float32))[0], 5)]


def test_a_transform_rotates_and_then_translates() -> None:
    assert moved(Transform.from_quaternion((1, 2, 3), QUARTER_TURN_LEFT), (1, 0, 0)) == [1, 3, 3]


def test_a_quaternion_of_any_length_is_a_rotation() -> None:
    assert moved(Transform.from_quaternion((0, 0, 0), (0, 0, 3, 3)), (1, 0, 0)) == [0, 1, 0]


def test_the_inverse_restores_the_point() -> None:
    transform = Transform.from_quaternion((1, 2, 3), (0.1, 0.2, 0.3, 0.9))
    assert moved(transform.inverse().after(transform), (4, 5, 6)) == [4, 5, 6]


@pytest.mark.parametrize("quaternion", [(0, 0, 0, 0), (np.nan, 0, 0, 1)])
def test_an_invalid_rotation_is_an_error_of_one_line(quaternion: tuple[float, ...]) -> None:
    with pytest.raises(ValueError, match="is not a transform") as raised:
        Transform.from_quaternion((0, 0, 0), quaternion)
    assert "\n" not in str(raised.value)


def test_frames_are_connected_through_their_common_ancestor() -> None:
    transforms = StaticTransforms()
    transforms.add("base", "mast", Transform.from_quaternion((0, 0, 1), IDENTITY))
    transforms.add("mast", "lidar", Transform.from_quaternion((0, 0, 0.5), QUARTER_TURN_LEFT))
    transforms.add("base", "imu", Transform.from_quaternion((1, 0, 0), IDENTITY))
    assert moved(transforms.between("lidar", "base"), (1, 0, 0)) == [0, 1, 1.5]
    assert moved(transforms.between("base", "lidar"), (0, 1, 1.5)) == [1, 0, 0]
    assert moved(transforms.between("lidar", "imu"), (1, 0, 0)) == [-1, 1, 1.5]


def test_the_transform_to_the_same_frame_needs_no_message() -> None:
    transform = StaticTransforms().between("lidar", "/lidar")
    assert transform is not None
    assert transform.is_identity()


def test_frames_without_a_connection_have_no_transform() -> None:
    transforms = StaticTransforms()
    transforms.add("base", "lidar", Transform.identity())
    transforms.add("map", "other", Transform.identity())
    assert transforms.between("lidar", "map") is None
    assert transforms.frames() == ["base", "lidar", "map", "other"]


def test_frames_in_a_cycle_are_not_connected() -> None:
    transforms = StaticTransforms()
    transforms.add("a", "b", Transform.identity())
    transforms.add("b", "a", Transform.identity())
    transforms.add("b", "c", Transform.identity())
    assert transforms.between("a", "b") is None
    assert transforms.between("c", "a") is None


def test_missing_returns_stay_missing_in_another_frame() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [np.nan, 0, 0]], np.float32)
    result = Transform.from_quaternion((5, 0, 0), IDENTITY).apply(points)
    assert np.isnan(result[0]).all()
    assert result[1].tolist() == [6, 0, 0]
    assert np.isnan(result[2]).any()


@pytest.mark.parametrize("up", [(0, 0, 1), (0.6, 0, 0.8), (0, 1, 0), (0, 0, -1), (0.48, 0.6, -0.64)])
def test_the_shortest_rotation_maps_up_to_z_and_keeps_the_axis(up: tuple[float, float, float]) -> None:
    rotation = shortest_rotation_to_z(np.array(up, float))
    np.testing.assert_allclose(rotation @ up, [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(rotation) == pytest.approx(1)
    axis = np.cross(up, [0, 0, 1])
    np.testing.assert_allclose(rotation @ axis, axis, atol=1e-12)
