# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""From the level frame, in which methods work, back to the frame of the scan."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone.segmentation import Mount

Floats = npt.NDArray[np.float64]


class LevelFrame(NamedTuple):
    """Metres, the origin in the sensor, z up; where patches have their bins, and the surface its grids."""

    axes: Floats
    """(3, 3): its axes x, y and z, rows, in the frame of the scan; unit length."""
    origin: Floats
    """(3,): where the sensor is in the frame of the scan, metres."""
    scale: float
    """Metres a unit of the scan."""

    def to_scan(self, places: npt.ArrayLike) -> Floats:
        """Places of shape (..., 3), metres, in the frame and the units of the scan."""
        scan: Floats = (np.asarray(places, np.float64) @ self.axes + self.origin) / self.scale
        return scan

    def to_level(self, places: npt.ArrayLike) -> Floats:
        """Places of shape (..., 3) of the scan, in metres in this frame."""
        level: Floats = (np.asarray(places, np.float64) * self.scale - self.origin) @ self.axes.T
        return level


def level_frame(mount: Mount) -> LevelFrame:
    """The level frame of a scan: its z axis is up, x and y are turned with it the shortest way."""
    x, y, z = np.asarray(mount.up) / np.linalg.norm(mount.up)
    if z < -0.999999:
        axes = np.diag([1.0, -1.0, -1.0])
    else:
        shrink = 1 / (1 + z)
        axes = np.array(
            [[1 - x * x * shrink, -x * y * shrink, -x], [-x * y * shrink, 1 - y * y * shrink, -y], [x, y, z]]
        )
    return LevelFrame(axes, np.asarray(mount.origin, np.float64), mount.scale)
