# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The ground's surface as triangles to draw."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._level_frame import level_frame
from flagstone._relief import relief, suitable_look, suitable_range
from flagstone.ground_surface import GroundSurface
from flagstone.segmentation import Segmentation


class Mesh(NamedTuple):
    """Triangles with common corners."""

    corners: npt.NDArray[np.float32]
    """(C, 3): x, y, z in the frame and the units of the scan."""
    triangles: npt.NDArray[np.uint32]
    """(T, 3): indices into corners."""
    colors: npt.NDArray[np.uint8]
    """(C, 3): by height, shaded."""


def surface_mesh(result: Segmentation) -> Mesh:
    """The surface where it is known, as fine as its grids; no triangles where there is none.

    Lines at the middles of cells, finer towards the sensor, cross everywhere, so that the mesh has neither gaps nor
    steps where grids meet.
    """
    ground = result.surface
    if not ground:
        return Mesh(np.empty((0, 3), np.float32), np.empty((0, 3), np.uint32), np.empty((0, 3), np.uint8))
    lines = _lines(ground)
    x, y = np.meshgrid(lines, lines)
    z = ground.height(x, y)
    known = np.isfinite(z)
    whole = known[:-1, :-1] & known[1:, :-1] & known[:-1, 1:] & known[1:, 1:]
    number = np.arange(x.size, dtype=np.uint32).reshape(x.shape)
    a, b, c, d = (n[whole] for n in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]))
    triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    used, triangles = np.unique(triangles, return_inverse=True)
    x, y, z = x.ravel()[used], y.ravel()[used], z.ravel()[used]
    colors = relief(ground, x, y, suitable_look(ground, suitable_range(ground)))[:, :3]
    return Mesh(
        corners=level_frame(result.mount).to_scan(np.stack([x, y, z], axis=1)).astype(np.float32),
        triangles=triangles.reshape(-1, 3).astype(np.uint32),
        colors=np.round(255 * colors).astype(np.uint8),
    )


def _lines(ground: GroundSurface) -> npt.NDArray[np.float64]:
    """Where lines run along x and y: the middles of cells, each grid's outside the next finer one."""
    lines = np.empty(0)
    for grid in reversed(ground.grids):  # finest first
        middles = (np.arange(len(grid.heights)) + 0.5) * grid.cell - grid.extent
        reach = lines[-1] + grid.cell / 2 if len(lines) else 0
        outside = middles[middles > reach]
        lines = np.concatenate([-outside[::-1], lines, outside])
    return lines
