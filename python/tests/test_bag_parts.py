# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The parts of `flagstone bag`: messages, frames, gravity, order of results."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import flagstone
from flagstone.bags.frames import FrameTree, RigidTransform, looks_like_sensor_frame, rotation_of, rotation_to_z
from flagstone.bags.gravity import Gravity
from flagstone.bags.messages import FrameTransform, parse_imu, parse_transforms
from flagstone.bags.order import in_order
from flagstone.bags.summary import FailureLines

rosbags = pytest.importorskip("rosbags", reason="needs rosbags, of the test dependencies")

from bag_scenes import imu, transforms  # noqa: E402

numbers = st.floats(-1e6, 1e6)
triples = st.tuples(numbers, numbers, numbers)
names = st.text(st.characters(codec="utf-8", exclude_characters="\0/"), max_size=20)
formats = st.sampled_from(["rosbag1", "mcap"])


def encoding_of(format: str) -> str:
    return "ros1" if format == "rosbag1" else "cdr"


@settings(deadline=None)
@given(formats, names, triples)
def test_accelerations_are_those_that_rosbags_serialized(format: str, frame: str, acceleration: Any) -> None:
    sample = parse_imu(imu(format, 5, frame, acceleration), encoding_of(format))
    assert sample == (frame, acceleration)


quaternions = st.tuples(numbers, numbers, numbers, numbers)


@settings(deadline=None)
@given(formats, st.lists(st.tuples(names, names, triples, quaternions), max_size=4))
def test_transforms_are_those_that_rosbags_serialized(format: str, entries: list[Any]) -> None:
    found = parse_transforms(transforms(format, 5, entries), encoding_of(format))
    assert found == [FrameTransform(*entry) for entry in entries]


@pytest.mark.parametrize("format", ["rosbag1", "mcap"])
def test_truncated_messages_are_one_line_errors(format: str) -> None:
    entries = [("a", "b", (1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0))]
    whole = transforms(format, 5, entries), imu(format, 5)
    for message, parse in zip(whole, (parse_transforms, parse_imu), strict=True):
        needed = len(message) - (72 if parse is parse_imu else 0)  # the last covariance is not read
        for size in range(needed):
            with pytest.raises(ValueError, match=r"^byte \d+: .*(ends at byte|is not supported)"):
                parse(message[:size], encoding_of(format))


@settings(deadline=None)
@given(st.binary(max_size=200), st.sampled_from(["cdr", "ros1"]))
def test_any_bytes_are_read_or_rejected(message: bytes, encoding: str) -> None:
    for parse in (parse_imu, parse_transforms):
        try:
            parse(message, encoding)
        except ValueError as error:
            assert "\n" not in str(error)


class TestFrames:
    """Chains of static transforms."""

    tree = FrameTree()
    tree.add(FrameTransform("map", "base", (10, 0, 0), (0, 0, 1, 0)))  # half a turn about z
    tree.add(FrameTransform("base", "mast", (0, 0, 2), (0, 0, 0, 2)))
    tree.add(FrameTransform("mast", "lidar", (1, 0, 0), (1, 0, 0, 0)))  # half a turn about x

    def test_chains_are_composed(self) -> None:
        to_map = self.tree.between("lidar", "map")
        np.testing.assert_allclose(to_map.rotation @ [1, 2, 3] + to_map.translation, [8, 2, -1], atol=1e-12)

    def test_the_other_direction_is_the_inverse(self) -> None:
        there, back = self.tree.between("map", "lidar"), self.tree.between("lidar", "map")
        both = there @ back
        np.testing.assert_allclose(both.rotation, np.eye(3), atol=1e-12)
        np.testing.assert_allclose(both.translation, 0, atol=1e-12)

    def test_a_later_transform_replaces_an_earlier_one(self) -> None:
        tree = FrameTree()
        for height in (1.0, 2.0):
            tree.add(FrameTransform("base", "lidar", (0, 0, height), (0, 0, 0, 1)))
        assert tree.between("lidar", "base").translation[2] == 2

    def test_cycles_end(self) -> None:
        tree = FrameTree()
        for parent, child in (("a", "b"), ("b", "c"), ("c", "a")):
            tree.add(FrameTransform(parent, child, (0, 0, 0), (0, 0, 0, 1)))
        assert tree.between("a", "c").is_identity
        with pytest.raises(ValueError, match="does not connect frame 'a' with frame 'd'"):
            tree.between("a", "d")

    @pytest.mark.parametrize("rotation", [(0, 0, 0, 0), (np.nan, 0, 0, 1), (np.inf, 0, 0, 1)])
    def test_rotations_without_direction_are_rejected(self, rotation: Any) -> None:
        with pytest.raises(ValueError, match="is not a quaternion"):
            FrameTree().add(FrameTransform("a", "b", (0, 0, 0), rotation))

    @settings(deadline=None)
    @given(st.tuples(numbers, numbers, numbers, numbers).filter(lambda q: np.linalg.norm(q) > 1e-3))
    def test_quaternions_of_any_length_are_rotations(self, quaternion: Any) -> None:
        rotation = rotation_of(quaternion)
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
        assert np.linalg.det(rotation) == pytest.approx(1)

    @settings(deadline=None)
    @given(st.tuples(numbers, numbers, numbers).filter(lambda v: np.linalg.norm(v) > 1e-3))
    def test_up_is_rotated_to_z(self, up: Any) -> None:
        rotation = rotation_to_z(np.array(up))
        np.testing.assert_allclose(rotation @ np.array(up), [0, 0, np.linalg.norm(up)], atol=1e-4 * np.linalg.norm(up))
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-4)

    def test_frames_of_vehicles_and_maps_are_known(self) -> None:
        assert not any(map(looks_like_sensor_frame, ["base_link", "/car/odom", "map", "robot1/base_footprint"]))
        assert all(map(looks_like_sensor_frame, ["velodyne", "os_sensor", "base_link_lidar", "livox_frame"]))

    def test_identity_is_exact(self) -> None:
        assert RigidTransform().is_identity
        assert not RigidTransform(translation=np.array([0, 0, 1e-9])).is_identity


class TestGravity:
    """Means of accelerations."""

    def test_vibration_is_averaged_out(self) -> None:
        times = np.arange(0, 4_000_000_000, 10_000_000)
        shaken = np.tile([[3.0, 0, 9.81], [-3.0, 0, 9.81]], (len(times) // 2, 1))
        np.testing.assert_allclose(Gravity(times, shaken).up(2_000_000_000), [0, 0, 1], atol=0.01)

    def test_a_turn_of_the_sensor_is_followed(self) -> None:
        times = np.arange(0, 4_000_000_000, 10_000_000)
        values = np.where(times[:, None] < 2_000_000_000, [0, 0, 9.81], [0, 9.81, 0])
        gravity = Gravity(times, values)
        np.testing.assert_allclose(gravity.up(1_000_000_000), [0, 0, 1], atol=1e-9)
        np.testing.assert_allclose(gravity.up(3_000_000_000), [0, 1, 0], atol=1e-9)

    def test_far_from_all_samples_the_nearest_one_is_used(self) -> None:
        gravity = Gravity([10**10, 2 * 10**10], [[0, 0, 1], [0, 1, 0]])
        np.testing.assert_array_equal(gravity.up(0), [0, 0, 1])
        np.testing.assert_array_equal(gravity.up(12 * 10**9), [0, 0, 1])
        np.testing.assert_array_equal(gravity.up(19 * 10**9), [0, 1, 0])
        np.testing.assert_array_equal(gravity.up(10**12), [0, 1, 0])

    def test_samples_that_are_not_finite_are_ignored(self) -> None:
        gravity = Gravity([1, 2], [[np.nan, 0, 0], [0, 0, 5]])
        np.testing.assert_array_equal(gravity.up(1), [0, 0, 1])
        with pytest.raises(ValueError, match="no acceleration is finite"):
            Gravity([1], [[np.inf, 0, 0]])


class TestOrder:
    """Results of several threads."""

    @settings(deadline=None)
    @given(st.lists(st.booleans(), max_size=60), st.integers(1, 4))
    def test_results_are_in_the_order_of_the_items(self, works: list[bool], threads: int) -> None:
        items = list(enumerate(works))
        found = list(in_order(items, lambda item: (lambda done: done[0] * 2) if item[1] else None, threads))
        assert found == [((index, works), 2 * index if works else None) for index, works in items]

    def test_no_more_items_are_read_than_threads_need(self) -> None:
        read = 0
        may_end = threading.Event()

        def items() -> Any:
            nonlocal read
            for index in range(100):
                read += 1
                if index == 8:
                    may_end.set()
                yield index

        def wait(item: int) -> int:
            assert may_end.wait(60)
            return item

        results = in_order(items(), lambda item: wait, 4)
        assert next(results)[0] == 0
        assert read <= 12
        results.close()

    def test_an_exception_of_the_work_is_raised(self) -> None:
        def fail(item: int) -> int:
            raise OSError("no")

        with pytest.raises(OSError, match="no"):
            list(in_order([1, 2], lambda item: fail, 2))


def test_failures_of_a_kind_are_counted_after_ten() -> None:
    lines: list[str] = []
    failures = FailureLines(lines.append)
    for index in range(12):
        failures.add(f"a: {index}", f"byte {index}: torn")
    failures.add("a: 12", "no fields")
    failures.finish("a")
    assert lines == [
        *(f"a: {i}: byte {i}: torn" for i in range(10)),
        "a: 12: no fields",
        "a: 2 more messages with the error: byte N: torn",
    ]


class TestTransformed:
    """`PointCloud2.transformed`."""

    @settings(deadline=None)
    @given(st.lists(st.tuples(*[st.floats(-100, 100, width=32)] * 3), max_size=20))
    def test_points_are_rotated_and_moved(self, points: Any) -> None:
        scan = np.array(points, np.float32).reshape(-1, 3)
        cloud = flagstone.ros.parse(flagstone.ros.serialize(scan))
        rotation, shift = rotation_of((1, 2, 3, 4)), np.array([1.0, -2.0, 3.0])
        moved = cloud.transformed(rotation, shift)
        expected = scan.astype(np.float64) @ rotation.T + shift
        expected[(scan == 0).all(axis=1)] = 0  # missing returns
        np.testing.assert_allclose(moved, expected, atol=1e-4)

    def test_points_that_are_not_finite_stay_so(self) -> None:
        scan = np.float32([[np.nan, 0, 0], [1, np.inf, 0], [0, 0, 0], [1, 2, 3]])
        moved = flagstone.ros.parse(flagstone.ros.serialize(scan)).transformed(np.eye(3), (-1, -2, -3))
        assert not np.isfinite(moved[:2]).all(axis=1).any()
        assert (moved[2] == 0).all()
        assert moved[3].any()  # not a missing return, although it is at the origin

    def test_other_shapes_are_errors(self) -> None:
        cloud = flagstone.ros.parse(flagstone.ros.serialize(np.zeros((2, 3), np.float32)))
        with pytest.raises(ValueError, match="rotation: shape"):
            cloud.transformed(np.eye(4), (0, 0, 0))
        with pytest.raises(ValueError, match="translation: shape"):
            cloud.transformed(np.eye(3), (0, 0))
