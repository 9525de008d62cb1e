# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The bins of patches on their planes, as triangles to draw."""

from __future__ import annotations

from typing import Any

import numpy as np

from flagstone._level_frame import Floats, LevelFrame, level_frame
from flagstone._patch_bins import patch_bins
from flagstone.segmentation import Segmentation

_INSET = 0.06  # metres; leaves a dark line between neighbours
_LEAST_REACH = 1.0  # metres above and below the mean that a quad may always have


def patch_quads(result: Segmentation) -> list[Floats]:
    """Each patch's bin on its plane, cut off above and below where a steep plane leaves its points.

    Returns:
        Of each patch, in the order of `result.patches`, an array (T, 3, 3) of T triangles of three corners x, y, z in
        the frame and the units of the scan. None (T = 0) for a patch without a plane, nor of methods whose patches
        are neither squares nor sectors of rings.
    """
    frame = level_frame(result.mount)
    bins = patch_bins(result, inset=_INSET)
    if not bins:
        return [np.empty((0, 3, 3))] * len(result.patches)
    return [_quad(patch, bin_, frame) for patch, bin_ in zip(result.patches, bins, strict=True)]


def _quad(patch: Any, bin_: Floats, frame: LevelFrame) -> Floats:
    normal = frame.axes @ patch["normal"].astype(np.float64)
    if not normal.any():
        return np.empty((0, 3, 3))
    mean = frame.to_level(patch["mean"])
    steepness = max(normal[2], 1e-3)
    heights = mean[2] - ((bin_ - mean[:2]) @ normal[:2]) / steepness
    near, far = np.concatenate([bin_, heights[..., None]], axis=-1)
    reach = max(_LEAST_REACH, 2 * _spread_upward(patch["eigenvalues"], normal[2]))
    triangles: list[Floats] = []
    for i in range(len(near) - 1):
        cell = np.stack([near[i], far[i], far[i + 1], near[i + 1]])
        piece = _cut(_cut(cell, mean[2] - reach, above=True), mean[2] + reach, above=False)
        triangles += [piece[[0, k, k + 1]] for k in range(1, len(piece) - 1)]
    return frame.to_scan(np.array(triangles)) if triangles else np.empty((0, 3, 3))


def _spread_upward(eigenvalues: Floats, upright: float) -> float:
    """How far the points of the plane can spread along z, metres: a bound of their standard deviation."""
    along, _, across = eigenvalues
    return float(np.sqrt(max(along * (1 - upright * upright) + across * upright * upright, 0)))


def _cut(corners: Floats, height: float, *, above: bool) -> Floats:
    """What of a convex polygon (K, 3) lies above, or below, a height."""
    side = corners[:, 2] - height if above else height - corners[:, 2]
    if (side >= 0).all():
        return corners
    kept: list[Floats] = []
    for i in range(len(corners)):
        j = (i + 1) % len(corners)
        if side[i] >= 0:
            kept.append(corners[i])
        if (side[i] >= 0) != (side[j] >= 0):
            kept.append(corners[i] + side[i] / (side[i] - side[j]) * (corners[j] - corners[i]))
    return np.array(kept).reshape(-1, 3)
