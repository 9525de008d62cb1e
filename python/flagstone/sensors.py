# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The sensors that are known by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from flagstone import _core

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class Sensor:
    """A LiDAR as data: where its beams point, how far they reach, how high it usually stands."""

    name: str
    """Short, as `sensor=` takes it: "hdl-64e"."""
    title: str
    """Maker and model."""
    elevations: Sequence[float]
    """Degrees above the horizontal, highest first, one a beam; of a rosette the edges of its field of view."""
    firings: int
    """Firings of every beam in one scan; points of one scan for a rosette."""
    azimuth_begin: float
    """Right edge of the field of view, degrees counter-clockwise from straight ahead."""
    azimuth_end: float
    """Left edge, likewise; at most 360 more."""
    rosette: Sequence[float]
    """Turns that each of two prisms makes in a scan; empty for sensors with beams."""
    min_range: float
    """Nearer echoes are not reported, metres."""
    max_range: float
    """Farther echoes are not reported, metres."""
    range_sigma: float
    """Standard deviation of a measured range, metres."""
    height: float
    """h_s where nobody says otherwise: above the ground, metres."""


def sensors() -> tuple[Sensor, ...]:
    """The sensors that `sensor=` knows by name, as `flagstone sensors` lists them."""
    return tuple(Sensor(**fields) for fields in _core.sensors())
