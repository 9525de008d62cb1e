# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Coordinate frames and the static transforms between them."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from flagstone.bags.messages import FrameTransform

Array = npt.NDArray[np.float64]

NOT_SENSOR_FRAMES = ("base_link", "base_footprint", "base", "chassis", "map", "odom", "world", "earth", "gps", "utm")
"""Frames of vehicles and maps (REP 105), without namespaces. Clouds in these frames were transformed."""


@dataclass(frozen=True)
class RigidTransform:
    """Maps coordinates p to rotation @ p + translation."""

    rotation: Array = field(default_factory=lambda: np.eye(3))
    """(3, 3)."""
    translation: Array = field(default_factory=lambda: np.zeros(3))
    """(3,) metres."""

    def __matmul__(self, first: RigidTransform) -> RigidTransform:
        """The transform that applies `first`, and then this one."""
        return RigidTransform(self.rotation @ first.rotation, self.rotation @ first.translation + self.translation)

    def inverse(self) -> RigidTransform:
        """The transform in the other direction."""
        return RigidTransform(self.rotation.T, -self.rotation.T @ self.translation)

    @property
    def is_identity(self) -> bool:
        """Whether coordinates do not change."""
        return bool((self.rotation == np.eye(3)).all() and (self.translation == 0).all())


def rotation_of(quaternion: Iterable[float]) -> Array:
    """(3, 3) rotation of a quaternion x, y, z, w of any length.

    Raises:
        ValueError: A number is not finite, or all are zero.
    """
    values = np.array(list(quaternion))
    length = float(np.linalg.norm(values))
    if not np.isfinite(length) or length == 0:
        raise ValueError(f"rotation {tuple(values.tolist())} is not a quaternion (expected a finite length above 0)")
    x, y, z, w = values / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def rotation_to_z(up: Array) -> Array:
    """(3, 3): the shortest rotation that brings a direction to z. `up`: (3,), of any length above 0."""
    x, y, z = up / np.linalg.norm(up)
    if z < -1 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    c = 1 / (1 + z)
    return np.array([[1 - x * x * c, -x * y * c, -x], [-x * y * c, 1 - y * y * c, -y], [x, y, z]])


class FrameTree:
    """Frames that static transforms connect, in chains of any length."""

    def __init__(self) -> None:
        self._neighbours: dict[str, dict[str, RigidTransform]] = {}

    @property
    def frames(self) -> list[str]:
        """The names of all frames, sorted."""
        return sorted(self._neighbours)

    def add(self, transform: FrameTransform) -> None:
        """Adds a transform, or replaces the transform between the same frames.

        Raises:
            ValueError: A number is not finite, or the rotation is zero.
        """
        translation = np.array(transform.translation)
        if not np.isfinite(translation).all():
            raise ValueError(f"translation {transform.translation} is not finite (expected metres)")
        to_parent = RigidTransform(rotation_of(transform.rotation), translation)
        self._neighbours.setdefault(transform.child, {})[transform.parent] = to_parent
        self._neighbours.setdefault(transform.parent, {})[transform.child] = to_parent.inverse()

    def between(self, source: str, target: str) -> RigidTransform:
        """The transform that maps coordinates in `source` to coordinates in `target`.

        Raises:
            ValueError: No chain of transforms connects the frames. One line that lists the known frames.
        """
        found = {source: RigidTransform()}
        waiting = deque([source])
        while waiting and target not in found:
            frame = waiting.popleft()
            for neighbour, transform in self._neighbours.get(frame, {}).items():
                if neighbour not in found:
                    found[neighbour] = transform @ found[frame]
                    waiting.append(neighbour)
        if target not in found:
            known = ", ".join(self.frames) or "none"
            raise ValueError(
                f"/tf_static does not connect frame '{source}' with frame '{target}' (the frames in it: {known})"
            )
        return found[target]


def looks_like_sensor_frame(frame: str) -> bool:
    """Whether a frame can belong to a sensor: its name is not usual for the frame of a vehicle or a map."""
    return frame.rpartition("/")[2] not in NOT_SENSOR_FRAMES
