# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Better labels for the scans of a run, by a vote of all scans that saw the same ground."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._points import PointsLike, columns_of
from flagstone.codes import Label
from flagstone.ground_map import Levelling, none_as_zero, pose_rows, restored
from flagstone.segmentation import Segmentation


class LabelVote:
    """Votes of the scans of a run on whether a voxel is ground.

    Voxels are in the world frame after levelling; see `GroundMap`. A scan votes with the fraction of its points in the
    voxel that it labelled ground; votes from nearby count more. With the scans so far, better labels are available at
    once; with later scans, they are better still.

    The labels do not depend on the order of the points or of the scans. Thread-safe: scans are added one at a time, and
    `relabel` runs in parallel in several threads. All methods release the GIL. A vote can be pickled.

    Args:
        voxel: Width of a voxel, metres, 0.05 to 2.
        voxel_height: Height of a voxel, metres, 0.01 to 1.
        min_height: Points lower than this above the ground of their scan keep their labels, metres, -10 to 10.
        max_height: Points higher than this keep their labels, metres, -10 to 10.
        max_range: Points farther from the sensor keep their labels, metres, 5 to 200.
        window: After each scan, voxels farther from the sensor than this are removed, metres, 100 to 1e6. None: the
            vote keeps everything.

    Raises:
        ValueError: A value is out of its range.
    """

    def __init__(
        self,
        *,
        voxel: float = 0.25,
        voxel_height: float = 0.06,
        min_height: float = -0.4,
        max_height: float = 1,
        max_range: float = 100,
        window: float | None = None,
    ) -> None:
        self._settings: dict[str, Any] = {
            "voxel": voxel,
            "voxel_height": voxel_height,
            "min_height": min_height,
            "max_height": max_height,
            "max_range": max_range,
            "window": window,
        }
        self._core = _core.LabelVote(
            voxel=voxel,
            voxel_height=voxel_height,
            min_height=min_height,
            max_height=max_height,
            max_range=max_range,
            window=none_as_zero("window", window),
        )

    def __repr__(self) -> str:
        return f"LabelVote({self.voxels} voxels)"

    def __reduce__(self) -> tuple[Any, ...]:
        return restored, (LabelVote, self._settings, self.to_bytes())

    def add(
        self,
        points: PointsLike,
        result: Segmentation,
        pose: npt.ArrayLike,
        levelling: Levelling,
        moving: npt.ArrayLike | None = None,
    ) -> None:
        """Adds the votes of a scan.

        Args:
            points: (N, >=3), the scan, as `Segmenter.segment` accepts it.
            result: Result of segmenting the points by a method that computes heights, such as `Surface`.
            pose: (4, 4) or (3, 4), as `GroundMap.add` accepts it.
            levelling: What `GroundMap.add` returned for this scan.
            moving: (N,) bool: points that move, such as `MovingMask.moving`. They do not vote.

        Raises:
            TypeError: The points are not floats, or not in CPU memory.
            ValueError: The result has no heights of these points, the pose is not a finite rotation and position, or
                `moving` has another length.
            MemoryError: There is not enough memory.
        """
        flags = _flags(moving, len(result.labels))
        self._core.add(*columns_of(points), result._result, pose_rows(pose), levelling, flags)

    def relabel(
        self,
        points: PointsLike,
        result: Segmentation,
        pose: npt.ArrayLike,
        levelling: Levelling,
        moving: npt.ArrayLike | None = None,
    ) -> npt.NDArray[np.uint8]:
        """The labels of a scan after the votes so far.

        A point keeps its own label if its voxel has no votes or a tie. Labels other than `ground` and `nonground` never
        change. Points that move are `nonground`. See `add` for arguments and errors.

        Returns:
            (N,): code of each point, in input order; see `Label`.
        """
        flags = _flags(moving, len(result.labels))
        labels = self._core.relabel(*columns_of(points), result._result, pose_rows(pose), levelling)
        if flags.size:
            labels[flags] = Label.NONGROUND
        return labels

    def to_bytes(self) -> bytes:
        """The votes as bytes, without the settings."""
        return self._core.to_bytes()

    def from_bytes(self, data: bytes) -> None:
        """Replaces the votes by those of `to_bytes`.

        Raises:
            ValueError: The bytes are damaged, or of other voxels. The votes do not change.
        """
        self._core.from_bytes(data)

    @property
    def voxels(self) -> int:
        """Number of voxels with votes."""
        return self._core.voxels()

    @property
    def nbytes(self) -> int:
        """Memory in use, bytes."""
        return self._core.nbytes()


def _flags(moving: npt.ArrayLike | None, points: int) -> npt.NDArray[np.bool_]:
    """One flag per point, or none if no point moves."""
    if moving is None:
        return np.zeros(0, np.bool_)
    flags = np.ascontiguousarray(moving)
    if flags.dtype != np.bool_ or flags.shape != (points,):
        raise ValueError(
            f"moving: {flags.dtype} of shape {flags.shape} is not supported (expected {points} booleans, one per point)"
        )
    return flags
