# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The path of a sensor, from the odometry, poses or transforms in a bag."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone.bags.container import Bag, Topic
from flagstone.bags.frames import Array, FrameTree, RigidTransform, rotation_of
from flagstone.bags.messages import FrameTransform, StampedPose, parse_pose, parse_timed_transforms
from flagstone.bags.poses import TRANSFORMS_TYPE, read_frames

ODOMETRY_TYPES = ("nav_msgs/msg/Odometry",)
POSE_TYPES = ("geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped")

Times = npt.NDArray[np.int64]


class Trajectory(NamedTuple):
    """Poses of the sensor in a fixed frame, by time."""

    times: Times
    """(N,) nanoseconds, increasing."""
    positions: Array
    """(N, 3) metres."""
    quaternions: Array
    """(N, 4): x, y, z, w, of unit length."""


def read_trajectory(bag: Bag, topic: str | None, sensor_frame: str, report: Callable[[str], None]) -> Trajectory:
    """Reads where the sensor was.

    Args:
        bag: The bag.
        topic: A topic of nav_msgs/Odometry, geometry_msgs/PoseStamped or geometry_msgs/PoseWithCovarianceStamped;
            "/tf" for the transforms from the sensor to the frame at the root of its tree, or "/tf:FRAME" to the frame
            FRAME. Default: the only topic of Odometry, otherwise the only topic of poses, otherwise "/tf".
        sensor_frame: Frame of the clouds.
        report: Receives one line per message that cannot be read, and per decision.

    Raises:
        ValueError: The topic is missing, has another type, or contains no pose; or transforms do not connect its frame
            with the frame of the sensor. One line.
    """
    chosen = topic if topic is not None else _choose_topic(bag)
    name, _, fixed = chosen.partition(":")
    topics = bag.topics_named(name)
    if not topics:
        raise ValueError(f"{bag.path}: {name}: is not a topic of this bag (expected {_expected(bag)})")
    kind = _full_type(topics[0])
    if kind == TRANSFORMS_TYPE:
        return _TransformPath(bag, name, report).trajectory(sensor_frame, fixed.removeprefix("/") or None)
    if kind not in (*ODOMETRY_TYPES, *POSE_TYPES):
        raise ValueError(f"{bag.path}: {name}: has type {topics[0].type} (expected {_expected(bag)})")
    return _read_poses(bag, name, kind in ODOMETRY_TYPES, sensor_frame, report)


def _full_type(topic: Topic) -> str:
    package, _, name = topic.type.partition("/")
    return topic.type if name.startswith("msg/") else f"{package}/msg/{name}"


def _topics_of(bag: Bag, kinds: Sequence[str]) -> list[str]:
    return sorted({topic.name for topic in bag.topics if _full_type(topic) in kinds})


def _dynamic_transforms(bag: Bag) -> list[str]:
    return [name for name in _topics_of(bag, [TRANSFORMS_TYPE]) if not name.endswith("/tf_static")]


def _expected(bag: Bag) -> str:
    names = [*_topics_of(bag, [*ODOMETRY_TYPES, *POSE_TYPES]), *_dynamic_transforms(bag)]
    return f"a topic of Odometry, PoseStamped or transforms: {', '.join(names) or 'the bag has none'}"


def _choose_topic(bag: Bag) -> str:
    for names in (_topics_of(bag, ODOMETRY_TYPES), _topics_of(bag, POSE_TYPES), _dynamic_transforms(bag)):
        if len(names) == 1:
            return names[0]
        if names:
            break
    raise ValueError(f"{bag.path}: the topic of the poses is not unique or missing (expected {_expected(bag)})")


def _read_poses(bag: Bag, name: str, names_body: bool, sensor_frame: str, report: Callable[[str], None]) -> Trajectory:
    samples: list[tuple[int, RigidTransform]] = []
    frames = set()
    to_body: dict[str | None, RigidTransform] = {}
    tree: FrameTree | None = None
    for index, message in enumerate(bag.messages([name])):
        try:
            found: StampedPose = parse_pose(message.data, message.topic.encoding, names_body=names_body)
            pose = _transform_of(found.position, found.rotation)
        except ValueError as error:
            report(f"{bag.path}: {name}: message {index}: {error}")
            continue
        if found.body not in to_body:
            if not found.body:
                report(
                    f"{bag.path}: {name}: does not name the frame that its poses describe "
                    f"(they are used as poses of '{sensor_frame}')"
                )
                to_body[found.body] = RigidTransform()
            elif found.body == sensor_frame:
                to_body[found.body] = RigidTransform()
            else:
                tree = tree or read_frames(bag, report)
                to_body[found.body] = _between(bag, tree, sensor_frame, found.body)
        frames.add(found.frame)
        samples.append((found.time or message.log_time, pose @ to_body[found.body]))
    if len(frames) > 1:
        raise ValueError(f"{bag.path}: {name}: has poses in several frames: {', '.join(sorted(frames))} (expected one)")
    return _trajectory(f"{bag.path}: {name}", samples)


def _between(bag: Bag, tree: FrameTree, source: str, target: str) -> RigidTransform:
    try:
        return tree.between(source, target)
    except ValueError as error:
        raise ValueError(f"{bag.path}: {error}") from None


def _transform_of(translation: Sequence[float], rotation: Sequence[float]) -> RigidTransform:
    position = np.array(translation, np.float64)
    if not np.isfinite(position).all():
        raise ValueError(f"position {tuple(translation)} is not finite (expected metres)")
    return RigidTransform(rotation_of(rotation), position)


def _trajectory(where: str, samples: list[tuple[int, RigidTransform]]) -> Trajectory:
    """The samples in the order of their times; the first one of each time."""
    if not samples:
        raise ValueError(f"{where}: contains no pose that can be read")
    times, first = np.unique(np.array([time for time, _ in samples], np.int64), return_index=True)
    transforms = [samples[index][1] for index in first]
    positions = np.array([transform.translation for transform in transforms])
    quaternions = np.array([quaternion_of(transform.rotation) for transform in transforms])
    return Trajectory(times, positions, quaternions)


def quaternion_of(rotation: Array) -> Array:
    """(4,): x, y, z, w >= 0 of unit length, of a rotation (3, 3)."""
    m = rotation
    # The row of the largest diagonal element is the most precise multiple of the quaternion.
    products = np.array(
        [
            [1 + m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
            [m[1, 0] + m[0, 1], 1 - m[0, 0] + m[1, 1] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
            [m[0, 2] + m[2, 0], m[2, 1] + m[1, 2], 1 - m[0, 0] - m[1, 1] + m[2, 2], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1 + m[0, 0] + m[1, 1] + m[2, 2]],
        ]
    )
    row = products[int(np.argmax(products.diagonal()))]
    quaternion: Array = row / np.linalg.norm(row) * (-1.0 if row[3] < 0 else 1.0)
    return quaternion


class _TransformPath:
    """The transforms of a bag over time: each frame has one parent."""

    def __init__(self, bag: Bag, name: str, report: Callable[[str], None]) -> None:
        self._bag = bag
        self._parents: dict[str, str] = {}
        self._moving: dict[str, list[tuple[int, RigidTransform]]] = {}
        self._fixed: dict[str, RigidTransform] = {}
        fixed = {topic for topic in _topics_of(bag, [TRANSFORMS_TYPE]) if topic.endswith("/tf_static")}
        for index, message in enumerate(bag.messages({name, *fixed})):
            try:
                for time, transform in parse_timed_transforms(message.data, message.topic.encoding):
                    self._add(transform, time or message.log_time, message.topic.name == name)
            except ValueError as error:
                report(f"{bag.path}: {message.topic.name}: message {index}: {error}")

    def _add(self, transform: FrameTransform, time: int, moves: bool) -> None:
        to_parent = _transform_of(transform.translation, transform.rotation)
        self._parents[transform.child] = transform.parent
        if moves:
            self._moving.setdefault(transform.child, []).append((time, to_parent))
        else:
            self._fixed[transform.child] = to_parent

    def trajectory(self, sensor_frame: str, fixed_frame: str | None) -> Trajectory:
        """The path from the sensor up to a fixed frame, by default to the root."""
        chain = self._chain(sensor_frame, fixed_frame)
        moving = [child for child in chain if child in self._moving]
        paths = {child: _trajectory(str(self._bag.path), self._moving[child]) for child in moving}
        if not paths:
            target = self._parents[chain[-1]] if chain else sensor_frame
            raise ValueError(
                f"{self._bag.path}: the transforms from '{sensor_frame}' to '{target}' do not change "
                "(expected a fixed frame such as odom or map, as in /tf:odom)"
            )
        # The odometry has the most transforms; a correction by a map has fewer.
        times = max((path.times for path in paths.values()), key=len)
        begin = max(path.times[0] for path in paths.values())
        end = min(path.times[-1] for path in paths.values())
        times = times[(times >= begin) & (times <= end)]
        if not len(times):
            raise ValueError(f"{self._bag.path}: the transforms to '{sensor_frame}' have no common time")
        at_times = {child: interpolated(path, times) for child, path in paths.items()}
        samples = []
        for index, time in enumerate(times):
            pose = RigidTransform()
            for child in chain:
                if child in at_times:
                    path = at_times[child]
                    step = RigidTransform(rotation_of(path.quaternions[index]), path.positions[index])
                else:
                    step = self._fixed[child]
                pose = step @ pose
            samples.append((int(time), pose))
        return _trajectory(str(self._bag.path), samples)

    def _chain(self, sensor_frame: str, fixed_frame: str | None) -> list[str]:
        """The frames from the sensor up to the one below the fixed frame."""
        chain: list[str] = []
        frame = sensor_frame
        while frame != fixed_frame and frame in self._parents and frame not in chain:
            chain.append(frame)
            frame = self._parents[frame]
        if fixed_frame is not None and frame != fixed_frame:
            above = ", ".join([*chain[1:], frame]) or "none"
            raise ValueError(
                f"{self._bag.path}: no transforms lead from '{sensor_frame}' to '{fixed_frame}' "
                f"(the frames above it: {above})"
            )
        return chain


def interpolated(path: Trajectory, times: Times) -> Trajectory:
    """The path at other times within its own: positions linearly, rotations along the shorter way.

    Rotations are normalised linear combinations. If neighbours differ by 10 degrees, this is within 0.01 degrees of a
    constant angular velocity.
    """
    after = np.clip(np.searchsorted(path.times, times), 1, max(1, len(path.times) - 1))
    before = after - 1
    after = np.minimum(after, len(path.times) - 1)
    span = np.maximum(path.times[after] - path.times[before], 1)
    fraction = ((times - path.times[before]) / span)[:, None]
    first, second = path.quaternions[before], path.quaternions[after]
    second = np.where((first * second).sum(axis=1, keepdims=True) < 0, -second, second)
    quaternions = (1 - fraction) * first + fraction * second
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    positions = (1 - fraction) * path.positions[before] + fraction * path.positions[after]
    return Trajectory(times, positions, quaternions)
