# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Codes of point labels and of the status of patches."""

from enum import IntEnum


class Label(IntEnum):
    """Label of a point. Label files contain these codes; they are part of the data contract and will not change."""

    NONGROUND = 0
    """Not ground: an object on the ground or above it."""
    GROUND = 1
    """Ground."""
    NOISE = 2
    """Below any possible ground: a ghost point, caused by a reflection (multipath)."""
    OUT_OF_RANGE = 3
    """Too far from the sensor, too close, outside the field of view, or more than 10 km above or below the sensor."""
    INVALID = 4
    """A coordinate is not finite, or all three are zero, which drivers write for a missing return."""


class Verdict(IntEnum):
    """Status of a patch: ground, or the reason why not. Section III-D of the paper."""

    GROUND = 0
    """Passed every term of the ground likelihood."""
    GROUND_FLAT = 1
    """Failed the elevation term, but accepted because it is flat, eq. (11)."""
    TOO_FEW_POINTS = 2
    """Too few points to fit a plane."""
    NO_PLANE = 3
    """Fewer than three points remained during the fit."""
    NOT_UPRIGHT = 4
    """The normal is tilted too far, eq. (9): a wall, a hedge, a trunk."""
    TOO_HIGH = 5
    """Higher than the ground can be at that range, eq. (10), and not flat enough."""
    MIXED = 6
    """Method `surface`: as many points just above the plane as in it, as in a wall or bush."""
    OFF_SURFACE = 7
    """Method `surface`: above or below the height that ground closer to the sensor predicts."""
