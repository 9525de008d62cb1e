# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The pose in which each cloud of a bag is segmented, from the bag's transforms and accelerations."""

from __future__ import annotations

from collections.abc import Callable

from flagstone.bags.container import Bag
from flagstone.bags.frames import FrameTree, RigidTransform, rotation_to_z
from flagstone.bags.gravity import Gravity
from flagstone.bags.messages import parse_imu, parse_transforms

IMU_TYPE = "sensor_msgs/msg/Imu"
TRANSFORMS_TYPE = "tf2_msgs/msg/TFMessage"


class CloudPoses:
    """Transforms from the frames of clouds to the frame in which they are segmented. Thread-safe.

    That frame is `sensor_frame`, otherwise the frame of the cloud. With an IMU, it is also rotated, so that z is up.
    """

    def __init__(
        self, tree: FrameTree, sensor_frame: str | None = None, gravity: Gravity | None = None, imu_frame: str = ""
    ) -> None:
        self._tree = tree
        self._sensor_frame = sensor_frame
        self._gravity = gravity
        self._imu_frame = imu_frame
        self._found: dict[tuple[str, str], RigidTransform] = {}

    def of(self, frame: str, time: int) -> RigidTransform | None:
        """The transform for a cloud in a frame, recorded at a time in nanoseconds; None if nothing changes.

        Raises:
            ValueError: A transform is missing. One line that lists the known frames.
        """
        target = self._sensor_frame if self._sensor_frame is not None else frame
        pose = self._between(frame, target)
        if self._gravity is not None:
            up = self._between(self._imu_frame, target).rotation @ self._gravity.up(time)
            pose = RigidTransform(rotation_to_z(up)) @ pose
        return None if pose.is_identity else pose

    def _between(self, source: str, target: str) -> RigidTransform:
        key = source, target
        if key not in self._found:
            self._found[key] = RigidTransform() if source == target else self._tree.between(source, target)
        return self._found[key]


def read_poses(bag: Bag, tf: str | None, imu: str | None, report: Callable[[str], None]) -> CloudPoses:
    """Reads the transforms and accelerations that the options need.

    Args:
        bag: The bag.
        tf: Frame of the sensor; None for the frame of the cloud.
        imu: Topic of accelerations; None for no IMU.
        report: Receives one line per message that cannot be read.

    Raises:
        ValueError: The topic is missing, has another type, or no message of it can be read. One line.
    """
    gravity, imu_frame = None, ""
    if imu is not None:
        gravity, imu_frame = _read_imu(bag, imu, report)
    tree = read_frames(bag, report) if tf is not None or imu is not None else FrameTree()
    return CloudPoses(tree, tf, gravity, imu_frame)


def read_frames(bag: Bag, report: Callable[[str], None]) -> FrameTree:
    """The static transforms of a bag: topics named tf_static, in any namespace."""
    tree = FrameTree()
    names = {topic.name for topic in bag.topics if topic.name.endswith("/tf_static") and topic.type == TRANSFORMS_TYPE}
    for index, message in enumerate(bag.messages(names) if names else ()):
        try:
            for transform in parse_transforms(message.data, message.topic.encoding):
                tree.add(transform)
        except ValueError as error:
            report(f"{bag.path}: {message.topic.name}: message {index}: {error}")
    return tree


def _read_imu(bag: Bag, name: str, report: Callable[[str], None]) -> tuple[Gravity, str]:
    topics = bag.topics_named(name)
    imus = sorted({topic.name for topic in bag.topics if topic.type == IMU_TYPE})
    if not topics or any(topic.type != IMU_TYPE for topic in topics):
        problem = f"has type {topics[0].type}" if topics else "is not a topic of this bag"
        raise ValueError(
            f"{bag.path}: {name}: {problem} (expected a topic of {IMU_TYPE}: {', '.join(imus) or 'the bag has none'})"
        )
    times, accelerations, frame = [], [], ""
    for index, message in enumerate(bag.messages([name])):
        try:
            sample = parse_imu(message.data, message.topic.encoding)
        except ValueError as error:
            report(f"{bag.path}: {name}: message {index}: {error}")
            continue
        times.append(message.log_time)
        accelerations.append(sample.acceleration)
        frame = sample.frame
    if not times:
        raise ValueError(f"{bag.path}: {name}: contains no message that can be read (expected {IMU_TYPE})")
    try:
        return Gravity(times, accelerations), frame
    except ValueError as error:
        raise ValueError(f"{bag.path}: {name}: {error}") from None
