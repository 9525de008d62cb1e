# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Simulated clouds with the fields of a driver."""

from __future__ import annotations

import functools
import tempfile

import numpy as np
import numpy.typing as npt

import flagstone
from flagstone import ros

OUSTER = np.dtype(
    {
        "names": ["x", "y", "z", "intensity", "t", "reflectivity", "ring", "ambient", "range"],
        "formats": ["<f4", "<f4", "<f4", "<f4", "<u4", "<u2", "<u2", "<u2", "<u4"],
        "offsets": [0, 4, 8, 16, 20, 24, 26, 28, 32],
        "itemsize": 48,
    }
)
"""The original fields of Ouster's driver, with its padding."""


@functools.cache
def scans(count: int = 1, sensor: str = "vlp-16") -> tuple[npt.NDArray[np.float32], ...]:
    """Simulated scans of a street, (N, 4) each: x, y, z, intensity."""
    with tempfile.TemporaryDirectory() as directory:
        frames = flagstone.simulate(directory, scene="urban_street", sensor=sensor, frames=count)
        return tuple(np.fromfile(frame.scan, np.float32).reshape(-1, 4) for frame in frames)


def ouster(points: npt.NDArray[np.float32]) -> npt.NDArray[np.void]:
    """The points as records of Ouster's driver; all bytes of the other fields are distinct."""
    cloud = np.zeros(len(points), OUSTER)
    index = np.arange(len(points))
    cloud["x"], cloud["y"], cloud["z"], cloud["intensity"] = points[:, :4].T
    cloud["t"] = 1000 * index
    cloud["reflectivity"] = index % 65521
    cloud["ring"] = index % 64
    cloud["ambient"] = 65535 - index % 65521
    cloud["range"] = np.nan_to_num(1000 * np.linalg.norm(points[:, :3], axis=1)).astype(np.uint32)
    return cloud


def large(points: npt.NDArray[np.float32], count: int = 60_000) -> npt.NDArray[np.float32]:
    """The points, repeated with small offsets until there are `count`."""
    times = -(-count // len(points))
    offsets = np.linspace(0, 0.02, times, dtype=np.float32)
    repeated = np.concatenate([points + np.array([offset, offset, 0, 0], np.float32) for offset in offsets])
    return repeated[:count]


def message(points: npt.NDArray[np.float32], frame_id: str = "lidar") -> bytes:
    """The points as a serialized cloud of Ouster's driver."""
    return ros.serialize(ouster(points), frame_id=frame_id)
