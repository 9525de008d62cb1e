# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The points of a run that move, found by comparing scans."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._points import PointsLike, columns_of
from flagstone.ground_map import Levelling, none_as_zero, pose_rows, restored
from flagstone.segmentation import Segmentation


class MovingObject(NamedTuple):
    """Connected moving points of one scan, such as a vehicle or a person."""

    points: int
    """Number of its points."""
    confidence: float
    """Fraction of the looks from other scans that saw through its points, of those that measured something, 0 to 1."""
    min: tuple[float, float, float]
    """Smallest x, y and z, metres, in the frame of the scan; for a tilted sensor, in its gravity-aligned frame."""
    max: tuple[float, float, float]
    """Largest x, y and z, metres."""


@dataclass(frozen=True, eq=False)
class MovingMask:
    """The moving points of a scan of N points."""

    objects_of_points: npt.NDArray[np.uint32]
    """(N,): 0 for a point that is not known to move, otherwise the number of its object, from 1."""
    objects: tuple[MovingObject, ...]
    """The objects, number 1 first."""

    @property
    def moving(self) -> npt.NDArray[np.bool_]:
        """(N,): whether each point moves."""
        moving: npt.NDArray[np.bool_] = self.objects_of_points != 0
        return moving

    def __repr__(self) -> str:
        return f"MovingMask({np.count_nonzero(self.objects_of_points)} moving points, {len(self.objects)} objects)"


class MovingPoints:
    """Finds the points of a run that move, by comparing scans.

    If another scan measured something behind a point, the point was not there at that time. Several such looks make a
    point moving, and moving points close to each other an object. A scan is compared with those 0.3 to 8 s before and
    after it, as far as they have been added. `add` finds the points that are known to move at once; `find` finds nearly
    all of them 2 s later.

    The result does not depend on the order of the points in a scan; it depends on the order of the calls. Thread-safe:
    one call at a time. All methods release the GIL. An object can be pickled with its scans.

    Args:
        beam_spacing: Angle between neighbouring beams of the sensor, degrees, 0.1 to 5. None: measured in the first
            scan.
        max_range: Points farther from the sensor than this are never moving, metres, 5 to 100.
        min_height: Points lower than this above the ground are never moving, metres, 0 to 2.
        max_height: Points higher than this above the ground are never moving, metres, 1 to 100.
        delay: Time after which `find` is called at the latest, seconds, 0 to 10: how long scans are kept longer than
            `add` needs them.
        window: After each scan, static objects farther from the sensor than this are forgotten, metres, 100 to 1e6.
            None: nothing is forgotten.

    Raises:
        ValueError: A value is out of its range.
    """

    def __init__(
        self,
        *,
        beam_spacing: float | None = None,
        max_range: float = 80,
        min_height: float = 0.1,
        max_height: float = 4.5,
        delay: float = 2,
        window: float | None = None,
    ) -> None:
        self._settings: dict[str, Any] = {
            "beam_spacing": beam_spacing,
            "max_range": max_range,
            "min_height": min_height,
            "max_height": max_height,
            "delay": delay,
            "window": window,
        }
        if beam_spacing == 0:
            raise ValueError("beam_spacing: 0 is out of range (expected an angle in degrees, or None to measure it)")
        self._core = _core.MovingPoints(
            beam_spacing=0 if beam_spacing is None else beam_spacing,
            max_range=max_range,
            min_height=min_height,
            max_height=max_height,
            delay=delay,
            window=none_as_zero("window", window),
        )

    def __repr__(self) -> str:
        return f"MovingPoints({self.scans} scans)"

    def __reduce__(self) -> tuple[Any, ...]:
        return restored, (MovingPoints, self._settings, self.to_bytes())

    def add(
        self, points: PointsLike, result: Segmentation, pose: npt.ArrayLike, levelling: Levelling, time: float
    ) -> MovingMask:
        """Finds the moving points of a scan with the help of earlier scans, and adds the scan.

        Args:
            points: (N, >=3), the scan, as `Segmenter.segment` accepts it.
            result: Result of segmenting the points by a method that computes heights, such as `Surface`.
            pose: (4, 4) or (3, 4), as `GroundMap.add` accepts it.
            levelling: What `GroundMap.add` returned for this scan.
            time: Time of the scan in seconds, later than that of the scan before.

        Returns:
            The points that are known to move.

        Raises:
            TypeError: The points are not floats, or not in CPU memory.
            ValueError: The result has no heights of these points, the pose is not a finite rotation and position, or
                the time is not later. Nothing is added.
            MemoryError: There is not enough memory.
        """
        return _mask(self._core.add(*columns_of(points), result._result, pose_rows(pose), levelling, time))

    def find(
        self, points: PointsLike, result: Segmentation, pose: npt.ArrayLike, levelling: Levelling, time: float
    ) -> MovingMask:
        """Finds the moving points of a scan that was added before, with the help of all scans around it.

        See `add` for arguments and errors. It is also a ValueError if the scan of this time is not in memory any more.
        """
        return _mask(self._core.find(*columns_of(points), result._result, pose_rows(pose), levelling, time))

    def to_bytes(self) -> bytes:
        """The scans in memory and the static objects as bytes, without the settings."""
        return self._core.to_bytes()

    def from_bytes(self, data: bytes) -> None:
        """Replaces the scans and static objects by those of `to_bytes`. Later results are the same as without a break.

        Raises:
            ValueError: The bytes are damaged, or of another `beam_spacing`. Nothing changes.
        """
        self._core.from_bytes(data)

    @property
    def beam_spacing(self) -> float | None:
        """The angle between beams in use, degrees; None before the first scan."""
        return self._core.beam_spacing() or None

    @property
    def scans(self) -> int:
        """Number of scans in memory."""
        return self._core.scans()

    @property
    def nbytes(self) -> int:
        """Memory in use, bytes."""
        return self._core.nbytes()


def _mask(found: tuple[Any, ...]) -> MovingMask:
    objects_of_points, points, confidences, smallest, largest = found
    rows = zip(points.tolist(), confidences.tolist(), smallest.tolist(), largest.tolist(), strict=True)
    objects = tuple(MovingObject(count, confidence, tuple(low), tuple(high)) for count, confidence, low, high in rows)
    return MovingMask(objects_of_points, objects)
