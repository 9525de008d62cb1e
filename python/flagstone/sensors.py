# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Sensors that you can select by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from flagstone import _core

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class Sensor:
    """Properties of a LiDAR sensor: beams, field of view, range and usual height."""

    name: str
    """Short name, as `sensor=` accepts it: "hdl-64e"."""
    title: str
    """Manufacturer and model."""
    elevations: Sequence[float]
    """Elevation of each beam, highest first, degrees above the horizontal. For a rosette, its vertical limits."""
    firings: int
    """Number of firings per beam and scan. For a rosette, the number of points per scan."""
    azimuth_begin: float
    """Right edge of the field of view, degrees counter-clockwise from straight ahead."""
    azimuth_end: float
    """Left edge of the field of view, in the same unit, at most 360 more than `azimuth_begin`."""
    rosette: Sequence[float]
    """Rotations per scan of each of the two prisms; empty for sensors with beams."""
    min_range: float
    """Minimum range of a return, metres."""
    max_range: float
    """Maximum range of a return, metres."""
    range_sigma: float
    """Standard deviation of a measured range, metres."""
    height: float
    """Default height h_s of the sensor above the ground, metres."""


def sensors() -> tuple[Sensor, ...]:
    """The sensors that `sensor=` accepts by name, as `flagstone sensors` lists them."""
    return tuple(Sensor(**fields) for fields in _core.sensors())
