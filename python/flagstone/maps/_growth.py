# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The ground of a run as it becomes known, scan by scan."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from flagstone._relief import Look, look_for, shaded
from flagstone.codes import Label
from flagstone.ground_map import MapGrid
from flagstone.maps._run_files import MappedScan

Mask = npt.NDArray[np.bool_]


class GrowingGround:
    """The cells of a finished map that scans have measured so far.

    A cell becomes known with the first scan that has a ground point in it. Its height is that in the finished map.

    Args:
        grid: The finished map.
    """

    def __init__(self, grid: MapGrid) -> None:
        self.grid = grid
        self.known: Mask = np.zeros(grid.height.shape, np.bool_)
        self._has_height: Mask = np.isfinite(grid.height)

    def add(self, scan: MappedScan) -> Mask:
        """Adds a scan and returns the cells that become known with it."""
        ground = scan.world[scan.labels == Label.GROUND]
        column = np.floor((ground[:, 0] - self.grid.min_x) / self.grid.cell).astype(np.int64)
        row = np.floor((ground[:, 1] - self.grid.min_y) / self.grid.cell).astype(np.int64)
        rows, columns = self.known.shape
        inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
        seen = np.zeros_like(self.known)
        seen[row[inside], column[inside]] = True
        new: Mask = seen & self._has_height & ~self.known
        self.known |= new
        return new


def grid_look(grid: MapGrid) -> Look:
    """Colours that span nearly all heights of a map, and shading that shows gentle slopes."""
    height = grid.height[np.isfinite(grid.height)].astype(np.float64)
    if not len(height):
        return look_for(-1, 1, 0)
    steepness = np.hypot(*_slopes(grid))
    low, high = np.quantile(height, (0.02, 0.98))
    return look_for(float(low), float(high), float(np.quantile(steepness[np.isfinite(grid.height)], 0.85)))


def grid_relief(grid: MapGrid, look: Look) -> npt.NDArray[np.uint8]:
    """(R, C, 3): sRGB colour of each cell by height, shaded with light from the upper left (-x, +y)."""
    along_x, along_y = _slopes(grid)
    color = shaded(grid.height.astype(np.float64), look, rise_up=along_y, rise_left=-along_x)
    return np.round(255 * color).astype(np.uint8)


def _slopes(grid: MapGrid) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Slopes along x and y, m/m; 0 where a neighbour is unknown."""
    height = grid.height.astype(np.float64)
    slopes = []
    for axis in (1, 0):
        if height.shape[axis] < 2:
            slopes.append(np.zeros_like(height))
            continue
        slopes.append(np.nan_to_num(np.gradient(height, grid.cell, axis=axis)))
    return slopes[0], slopes[1]


def stride(count: int, most: int) -> int:
    """The smallest step with which at most `most` of `count` elements are left."""
    return max(1, math.ceil(count / most))
