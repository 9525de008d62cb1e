# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Where the bins of patches lie, seen from above: squares, or sectors of rings."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from flagstone._level_frame import Floats
from flagstone.segmentation import Segmentation

_ARC_STEP = np.radians(4)  # no piece of an arc is longer


def patch_bins(result: Segmentation, *, inset: float = 0) -> list[Floats]:
    """The bin of each patch, in the order of `result.patches`.

    Args:
        result: Of a method whose patches are squares or sectors of rings.
        inset: How far within its edges each bin ends, metres, so that neighbours can be told apart.

    Returns:
        Of each patch an array (2, S, 2) of x and y, metres, in the level frame: S places along its nearer edge and S
        along its farther one, facing each other. Empty for methods whose patches have no such bins.
    """
    patches = result.patches
    if not len(patches):
        return []
    if extent := result.surface.extent:
        return [_square(patch, extent, inset) for patch in patches]
    settings = result.settings
    if "zones" not in settings:
        return []
    return [_sector(patch, settings, inset) for patch in patches]


def outline(bin_: Floats) -> Floats:
    """(2 S, 2): the edge of a bin, once around."""
    return np.concatenate([bin_[0], bin_[1][::-1]])


def _square(patch: Any, extent: float, inset: float) -> Floats:
    """Squares of 4 m, and of 8 m farther out, are counted from the corner at the smallest x and y."""
    side = 4.0 if patch["zone"] == 0 else 8.0
    x, y = patch["sector"] * side - extent, patch["ring"] * side - extent
    near, far = inset, side - inset
    return np.array([[[x + near, y + near], [x + near, y + far]], [[x + far, y + near], [x + far, y + far]]])


def _sector(patch: Any, settings: dict[str, Any], inset: float) -> Floats:
    """The paper's eqs. (1) and (2): rings by distance, sectors by angle, counter-clockwise."""
    zones, view = settings["zones"], settings["field_of_view"]
    zone, ring, sector = int(patch["zone"]), int(patch["ring"]), int(patch["sector"])
    if ring > 0:
        inner = zones[zone]["ring_radii"][ring - 1]
    else:
        inner = zones[zone - 1]["ring_radii"][-1] if zone > 0 else settings["min_range"]
    outer = zones[zone]["ring_radii"][ring]
    width = np.radians(view["width"]) / zones[zone]["sectors"]
    begin = np.radians(view["begin"]) + sector * width
    inset = min(inset, (outer - inner) / 4)
    places = 2 + int(width / _ARC_STEP)
    return np.stack([_arc(radius, begin, width, places, inset) for radius in (inner + inset, outer - inset)])


def _arc(radius: float, begin: float, width: float, places: int, inset: float) -> Floats:
    within = min(inset / radius, width / 4) if radius > 0 else 0.0
    angles = np.linspace(begin + within, begin + width - within, places)
    arc: npt.NDArray[np.float64] = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return arc
