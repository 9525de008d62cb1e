# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The up direction at any time, from the accelerations that an IMU measured."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

HALF_WINDOW_NS = 500_000_000
"""Half of the time over which accelerations are averaged: braking and bumps are shorter than this."""


class Gravity:
    """Low-passed accelerations: the mean of all samples within 0.5 s before and after a time.

    The mean of a sensor at rest, or at constant speed, points up (REP 145). Thread-safe.
    """

    def __init__(self, times: npt.ArrayLike, accelerations: npt.ArrayLike) -> None:
        """Sorts the samples by time.

        Args:
            times: (N,) nanoseconds, N >= 1.
            accelerations: (N, 3) in any unit; only directions are used. Samples that are not finite are ignored.

        Raises:
            ValueError: No sample is finite.
        """
        when = np.asarray(times, np.int64).reshape(-1)
        what = np.asarray(accelerations, np.float64).reshape(-1, 3)
        kept = np.isfinite(what).all(axis=1)
        if not kept.any():
            raise ValueError("no acceleration is finite (expected linear_acceleration of sensor_msgs/Imu)")
        order = np.argsort(when[kept], kind="stable")
        self._times: npt.NDArray[np.int64] = when[kept][order]
        self._sums: npt.NDArray[np.float64] = np.concatenate([np.zeros((1, 3)), np.cumsum(what[kept][order], axis=0)])

    def up(self, time: int) -> npt.NDArray[np.float64]:
        """(3,): up direction at a time in nanoseconds, with unit length, in the frame of the IMU.

        If no sample is within 0.5 s, the nearest sample determines it.

        Raises:
            ValueError: The mean acceleration is zero.
        """
        first = int(np.searchsorted(self._times, time - HALF_WINDOW_NS, "left"))
        last = int(np.searchsorted(self._times, time + HALF_WINDOW_NS, "right"))
        if first == last:  # both neighbours are outside of the window
            candidates = [index for index in (first - 1, first) if 0 <= index < len(self._times)]
            first = min(candidates, key=lambda index: abs(int(self._times[index]) - time))
            last = first + 1
        mean = (self._sums[last] - self._sums[first]) / (last - first)
        length = float(np.linalg.norm(mean))
        if length == 0:
            raise ValueError("the mean acceleration is zero (expected the acceleration of gravity)")
        return np.asarray(mean / length)
