# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The numbers that labels and patches hold."""

from enum import IntEnum


class Label(IntEnum):
    """What a point is. The codes are part of the data contract: label files hold them, and they will not change."""

    NONGROUND = 0
    """Stands on the ground, hangs above it, or lies in a patch that is not ground."""
    GROUND = 1
    """Belongs to the ground."""
    NOISE = 2
    """Below any ground there can be at that place: multipath, reflections."""
    OUT_OF_RANGE = 3
    """Too far, too near or out of view for the method, or over 10 km above or below the sensor."""
    INVALID = 4
    """A coordinate is not finite, or all three are zero ("no echo")."""


class Verdict(IntEnum):
    """Why a patch was taken for ground, or was not; the paper's section III-D."""

    GROUND = 0
    """Passed every term of the ground likelihood."""
    GROUND_FLAT = 1
    """Too high for the elevation term, brought back by its flatness, eq. (11)."""
    TOO_FEW_POINTS = 2
    """Not enough points to fit a plane."""
    NO_PLANE = 3
    """Fewer than three points survived the fit."""
    NOT_UPRIGHT = 4
    """The normal leans too far, eq. (9): a wall, a hedge, a trunk."""
    TOO_HIGH = 5
    """Lies above where ground can be at that range, eq. (10), and is not flat enough."""
    MIXED = 6
    """Method `surface`: as many points just above the plane as in it: a wall, a bush."""
    OFF_SURFACE = 7
    """Method `surface`: above or below what ground nearer to the sensor lets expect."""
