# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""From the bytes of a message to the bytes of the outputs, without ROS."""

from __future__ import annotations

import time
import warnings
from collections.abc import Collection
from typing import NamedTuple

import numpy as np

import flagstone
from flagstone import ros
from flagstone_ros import declaration
from flagstone_ros.frames import Transform

OUTPUTS = ("ground", "nonground", "labelled")

_MIN_POINTS = 1000  # all points of a small cloud may be far away


class Segmented(NamedTuple):
    """The outputs of a cloud, and the facts that the diagnostics report."""

    messages: dict[str, bytes]
    """A serialized sensor_msgs/msg/PointCloud2 for each wanted output."""
    points: int
    """Number of points."""
    out_of_range: float
    """Fraction of the finite points that are out of range."""
    mount: flagstone.Mount
    """Mounting pose that the cloud was segmented with."""
    seconds: float
    """Time of the segmentation alone."""
    warning: str | None
    """One line if most points are out of range."""


def segment(
    cloud: ros.PointCloud2, segmenter: flagstone.Segmenter, wanted: Collection[str], to_level: Transform | None = None
) -> Segmented:
    """Segments a cloud and writes the wanted outputs, with all fields of the cloud and its header.

    Args:
        cloud: The message, from `flagstone.ros.parse`.
        segmenter: The method. Its estimates may change.
        wanted: Names from `OUTPUTS`.
        to_level: Transform from the frame of the cloud to the frame of the sensor, in the units of the cloud. It only
            affects the segmentation: the outputs contain the original points.

    Raises:
        ValueError: The cloud has no coordinates; the message is one line.
        MemoryError: There is not enough memory.
    """
    points = cloud.xyz
    if to_level is not None and not to_level.is_identity():
        points = to_level.apply(points)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the hint of flagstone's warning is for Python; see `_warning`
        start = time.perf_counter()
        result = segmenter.segment(points)
        seconds = time.perf_counter() - start
    messages = {}
    if "ground" in wanted:
        messages["ground"] = cloud.select(result.ground)
    if "nonground" in wanted:
        messages["nonground"] = cloud.select(result.labels == flagstone.Label.NONGROUND)
    if "labelled" in wanted:
        messages["labelled"] = cloud.append({"label": result.labels, "height": result.heights})
    counts = result.counts
    finite = len(result) - counts["invalid"]
    return Segmented(
        messages,
        len(result),
        counts["out_of_range"] / finite if finite else 0.0,
        result.mount,
        seconds,
        _warning(counts["out_of_range"], len(result), finite),
    )


def _warning(out_of_range: int, points: int, finite: int) -> str | None:
    if finite < _MIN_POINTS or out_of_range <= declaration.MOSTLY_OUT_OF_RANGE * finite:
        return None
    return (
        f"points: {out_of_range} of {points} points are out of range "
        "(expected metres, origin at the sensor; for millimetres set mount.scale to 0.001)"
    )


def tilt_of(up: object) -> float:
    """Angle in degrees between an up direction (x, y, z) and the z axis."""
    x, y, z = np.asarray(up, np.float64)
    return float(np.degrees(np.arctan2(np.hypot(x, y), z)))
