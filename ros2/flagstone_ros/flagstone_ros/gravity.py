# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The up direction from the accelerations of an IMU."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

MAX_GAP = 1.0
"""Seconds without a sample after which the filter starts again."""


class Gravity:
    """Low-pass filter of accelerations. Not thread-safe.

    An accelerometer at rest measures the force that supports it, so `linear_acceleration` of sensor_msgs/Imu points up,
    as REP 145 specifies. The unit does not matter: drivers publish m/s² or multiples of g.
    """

    def __init__(self, time_constant: float = 1.0) -> None:
        """Creates a filter. `time_constant`: see the attribute."""
        self.time_constant = time_constant
        """Seconds in which an earlier acceleration decays to 1/e; 0 for no filter. Longer values suppress more of the
        vehicle's own acceleration; shorter values follow its rotations faster."""
        self._mean: npt.NDArray[np.float64] | None = None
        self._stamp = 0.0
        self.frame_id = ""
        """Frame of the last sample."""

    def add(self, acceleration: Sequence[float], stamp: float, frame_id: str) -> bool:
        """Adds a sample.

        Args:
            acceleration: x, y, z of the measured acceleration.
            stamp: Time of the measurement in seconds, of any epoch. Samples that are older than the previous one are
                ignored, unless the clock went back by more than `MAX_GAP`.
            frame_id: Frame of the acceleration.

        Returns:
            Whether the sample was used. Zero and values that are not finite are not.
        """
        sample = np.asarray(acceleration, np.float64)
        if not np.isfinite(sample).all() or not sample.any():
            return False
        step = stamp - self._stamp
        if self._mean is None or abs(step) > MAX_GAP or frame_id != self.frame_id:
            self._mean = sample
        elif step < 0:
            return False
        else:
            weight = 1 - math.exp(-step / self.time_constant) if self.time_constant > 0 else 1.0
            self._mean = self._mean + weight * (sample - self._mean)
        self._stamp = stamp
        self.frame_id = frame_id
        return True

    @property
    def up(self) -> npt.NDArray[np.float64] | None:
        """(3,): up direction in `frame_id`, of length 1; None before the first sample."""
        if self._mean is None:
            return None
        length = float(np.linalg.norm(self._mean))
        return self._mean / length if length > 0 else None
