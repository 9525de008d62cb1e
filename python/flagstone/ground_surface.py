# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The ground of a scan as one continuous surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from flagstone import _core


class GroundSample(NamedTuple):
    """The ground at several positions. S is the shape that x and y broadcast to."""

    height: npt.NDArray[np.float32]
    """S: z of the ground in the level frame, metres; NaN if unknown."""
    normal: npt.NDArray[np.float32]
    """(\\*S, 3): unit normal with z > 0; NaN if unknown."""
    slope: npt.NDArray[np.float32]
    """S: angle between the normal and the z axis, radians, 0 to pi/2; NaN if unknown."""
    confidence: npt.NDArray[np.float32]
    """S: probability that the height is within 10 cm of the ground, as found in simulated scenes; 0 if unknown."""


@dataclass(frozen=True, eq=False)
class Grid:
    """A square grid of ground heights, centred at the sensor.

    The centre of cell (row, column) is at x = (column + 0.5 - W / 2) * cell, y = (row + 0.5 - W / 2) * cell.
    """

    cell: float
    """Side length of a cell, metres."""
    heights: npt.NDArray[np.float32]
    """(W, W): z of the ground at the centre of each cell, metres; NaN if unknown. A read-only view."""
    confidences: npt.NDArray[np.float32]
    """(W, W): probability that the height is within 10 cm of the ground; 0 if unknown. A read-only view."""

    @property
    def extent(self) -> float:
        """The grid covers |x| <= extent and |y| <= extent, metres."""
        return len(self.heights) * self.cell / 2


class GroundSurface:
    """The ground as a function z = height(x, y), in metres, in the level frame of `Mount`.

    Only the method `surface` computes it. For other methods it is empty: it evaluates to False, and `height` returns
    NaN everywhere. The surface consists of nested square grids, which are finer closer to the sensor, and is bilinear
    between cell centres. It is immutable, so threads may share it.
    """

    def __init__(self, result: _core.Result) -> None:
        self._result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._result.grids(),)

    def __bool__(self) -> bool:
        """Whether there is a surface."""
        return self.extent > 0

    def __repr__(self) -> str:
        cells = ", ".join(f"{grid.cell:g}" for grid in self.grids)
        return f"GroundSurface(extent={self.extent:g} m, cells of {cells} m)" if self else "GroundSurface(none)"

    @property
    def extent(self) -> float:
        """The surface covers |x| <= extent and |y| <= extent, metres; 0 if there is no surface."""
        return self._result.extent()

    @property
    def grids(self) -> tuple[Grid, ...]:
        """The grids, coarsest and largest first."""
        return tuple(Grid(cell, heights, confidences) for cell, heights, confidences in self._result.grids())

    @overload
    def height(self, x: float, y: float) -> float: ...
    @overload
    def height(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.float32]: ...
    def height(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.float32] | float:
        """Elevation z of the ground at given positions.

        Args:
            x: Metres forward, any shape.
            y: Metres to the left, any shape that broadcasts with x.

        Returns:
            z in metres, in the shape that x and y broadcast to; NaN if unknown. A float if x and y are numbers.
        """
        flat_x, flat_y, shape = _flattened(x, y)
        return _shaped(self._result.height_at(flat_x, flat_y), shape)

    @overload
    def resolution(self, x: float, y: float) -> float: ...
    @overload
    def resolution(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.float32]: ...
    def resolution(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.float32] | float:
        """Side length of the grid cell at given positions, metres; NaN outside. See `height` for the arguments."""
        flat_x, flat_y, shape = _flattened(x, y)
        return _shaped(self._result.resolution_at(flat_x, flat_y), shape)

    def at(self, x: npt.ArrayLike, y: npt.ArrayLike) -> GroundSample:
        """Height, normal, slope and confidence at given positions. See `height` for the arguments."""
        flat_x, flat_y, shape = _flattened(x, y)
        table = self._result.ground_at(flat_x, flat_y)
        return GroundSample(
            height=table[:, 0].reshape(shape),
            normal=table[:, 1:4].reshape((*shape, 3)),
            slope=table[:, 4].reshape(shape),
            confidence=table[:, 5].reshape(shape),
        )


def _shaped(values: npt.NDArray[np.float32], shape: tuple[int, ...]) -> npt.NDArray[np.float32] | float:
    return values.reshape(shape) if shape else float(values[0])


def _restored(grids: list[Any]) -> GroundSurface:
    none = np.empty(0, np.uint8)
    return GroundSurface(_core.restored_result(none, None, none, grids, (0.0, (0.0, 0.0, 1.0), (0.0,) * 3, 1.0, "")))


def _flattened(
    x: npt.ArrayLike, y: npt.ArrayLike
) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32], tuple[int, ...]]:
    wide_x, wide_y = np.broadcast_arrays(np.asarray(x, np.float32), np.asarray(y, np.float32))
    return np.ascontiguousarray(wide_x).ravel(), np.ascontiguousarray(wide_y).ravel(), wide_x.shape
