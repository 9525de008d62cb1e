# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Static transforms between coordinate frames, as /tf_static publishes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]

_MIN_QUATERNION_NORM = 1e-6


@dataclass(frozen=True)
class Transform:
    """A rigid transform: p in the target frame is rotation @ p + translation, metres."""

    rotation: Matrix
    """(3, 3) rotation matrix."""
    translation: Vector
    """(3,) metres."""

    @staticmethod
    def identity() -> Transform:
        """The transform of a frame to itself."""
        return Transform(np.eye(3), np.zeros(3))

    @staticmethod
    def from_quaternion(translation: Sequence[float], quaternion: Sequence[float]) -> Transform:
        """A transform as geometry_msgs/Transform contains it.

        Args:
            translation: x, y, z in metres.
            quaternion: x, y, z, w, of any length above 0.

        Raises:
            ValueError: A value is not finite, or the quaternion is zero.
        """
        offset = np.asarray(translation, np.float64)
        unit = np.asarray(quaternion, np.float64)
        norm = np.linalg.norm(unit)
        if not (np.isfinite(offset).all() and np.isfinite(norm) and norm > _MIN_QUATERNION_NORM):
            raise ValueError(
                f"translation {tuple(translation)}, rotation {tuple(quaternion)} "
                "is not a transform (expected finite numbers and a rotation other than zero)"
            )
        x, y, z, w = unit / norm
        return Transform(
            np.array(
                [
                    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
                ]
            ),
            offset,
        )

    def after(self, first: Transform) -> Transform:
        """The transform that applies `first` and then this one."""
        return Transform(self.rotation @ first.rotation, self.rotation @ first.translation + self.translation)

    def inverse(self) -> Transform:
        """The transform in the other direction."""
        return Transform(self.rotation.T, -self.rotation.T @ self.translation)

    def is_identity(self) -> bool:
        """Whether the transform changes nothing."""
        return bool((self.rotation == np.eye(3)).all() and (self.translation == 0).all())

    def apply(self, points: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Transforms points.

        Args:
            points: (N, 3) metres.

        Returns:
            (N, 3). Points that are all zero, which drivers write for missing returns, become NaN: they have no
            position that a transform could change.
        """
        moved = points @ self.rotation.T.astype(np.float32)
        moved += self.translation.astype(np.float32)
        moved[~points.any(axis=1)] = np.nan
        return moved


def shortest_rotation_to_z(up: Vector) -> Matrix:
    """The shortest rotation that maps the unit vector `up` to z, as for `flagstone.Mount`."""
    x, y, z = up
    if z < -1 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    skew = np.array([[0, 0, -x], [0, 0, -y], [x, y, 0]])
    rotation: Matrix = np.eye(3) + skew + skew @ skew / (1 + z)
    return rotation


@dataclass
class StaticTransforms:
    """The static transforms that have been published so far. Not thread-safe."""

    _parents: dict[str, tuple[str, Transform]] = field(default_factory=dict)

    def add(self, parent: str, child: str, to_parent: Transform) -> None:
        """Adds or replaces the transform of a frame.

        Args:
            parent: Frame that the transform leads to (`header.frame_id` of the message).
            child: Frame of the points (`child_frame_id` of the message).
            to_parent: Transforms points of the child frame to the parent frame.
        """
        self._parents[_name(child)] = (_name(parent), to_parent)

    def between(self, source: str, target: str) -> Transform | None:
        """The transform of points from one frame to another, or None if no chain of transforms connects them."""
        from_source, from_target = self._ancestors(_name(source)), self._ancestors(_name(target))
        common = next((frame for frame in from_source if frame in from_target), None)
        if common is None:
            return None
        return from_target[common].inverse().after(from_source[common])

    def frames(self) -> list[str]:
        """Names of all frames, sorted."""
        return sorted({*self._parents, *(parent for parent, _ in self._parents.values())})

    def _ancestors(self, frame: str) -> dict[str, Transform]:
        """The frame, its parent and so on, each with the transform from the frame. A frame in a cycle has none."""
        first = frame
        found = {frame: Transform.identity()}
        while frame in self._parents:
            parent, to_parent = self._parents[frame]
            if parent in found:
                return {first: Transform.identity()}
            found[parent] = to_parent.after(found[frame])
            frame = parent
        return found


def _name(frame: str) -> str:
    """The name as ROS 2 writes it: ROS 1 allowed a slash in front."""
    return frame.removeprefix("/")
