# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The ground along a run: one map from all scans that saw it."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._points import PointsLike, columns_of
from flagstone.segmentation import Segmentation

Extent = tuple[float, float, float, float]
"""min_x, max_x, min_y, max_y in metres: the order of Matplotlib's `imshow(extent=)`."""


class Levelling(NamedTuple):
    """The correction of a pose in height, pitch and roll that fits a scan to the map.

    The plane to subtract from heights in the world frame is offset + slope_x (x - X) + slope_y (y - Y), where (X, Y) is
    the position of the sensor.
    """

    applied: bool = False
    """False if there are too few common cells, or if the scan and the map differ by more than `max_correction`. The
    plane is then the plane of the scan before."""
    cells: int = 0
    """Number of cells that are known in both the scan and the map."""
    offset: float = 0.0
    """Metres."""
    slope_x: float = 0.0
    """m/m."""
    slope_y: float = 0.0
    """m/m."""

    def corrected(self, pose: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The pose with this correction: z, pitch and roll change, x and y do not.

        Args:
            pose: (4, 4) or (3, 4), as `GroundMap.add` accepts it.

        Returns:
            (3, 4): rotation and position.

        Raises:
            ValueError: The pose has another shape or is not finite.
        """
        rows = pose_rows(pose)
        normal = np.array([-self.slope_x, -self.slope_y, 1]) / math.hypot(self.slope_x, self.slope_y, 1)
        rows[:, :3] = _shortest_rotation_to_z(normal) @ rows[:, :3]
        rows[2, 3] -= self.offset
        return rows


class MapSample(NamedTuple):
    """The ground of a map at several positions. S is the shape that x and y broadcast to."""

    height: npt.NDArray[np.float64]
    """S: z of the ground, metres, world frame; NaN if unknown."""
    normal: npt.NDArray[np.float32]
    """(\\*S, 3): unit normal with z > 0; NaN if unknown."""
    slope: npt.NDArray[np.float32]
    """S: angle between the normal and the z axis, radians, 0 to pi/2; NaN if unknown."""
    deviation: npt.NDArray[np.float32]
    """S: expected error of the height (standard deviation), metres; NaN if unknown."""
    scans: npt.NDArray[np.uint32]
    """S: number of scans that agree on the height of the nearest cell."""
    contradictions: npt.NDArray[np.uint32]
    """S: number of scans that measured another height in the nearest cell."""
    age: npt.NDArray[np.uint32]
    """S: number of scans added since the nearest cell was measured last."""


@dataclass(frozen=True, eq=False)
class MapGrid:
    """A rectangle of a map as arrays of R rows, from the smallest y, and C columns, from the smallest x.

    The centre of cell (row, column) is at x = min_x + (column + 0.5) * cell, y = min_y + (row + 0.5) * cell, world
    frame. Matplotlib draws it with `imshow(grid.height, origin="lower", extent=grid.extent)`.
    """

    cell: float
    """Side of a cell, metres."""
    min_x: float
    """Outer edge of the first column, metres."""
    min_y: float
    """Outer edge of the first row, metres."""
    total_scans: int
    """Number of scans of the map."""
    height: npt.NDArray[np.float32]
    """(R, C): z of the ground at the centre of each cell, metres; NaN if unknown."""
    deviation: npt.NDArray[np.float32]
    """(R, C): expected error of the height (standard deviation), metres; NaN if unknown."""
    scans: npt.NDArray[np.uint16]
    """(R, C): number of scans that agree on the height; 0 if unknown."""
    contradictions: npt.NDArray[np.uint16]
    """(R, C): number of scans that measured another height."""
    last_scan: npt.NDArray[np.uint32]
    """(R, C): number of the scan that measured the cell last, at least 1; 0 if unknown."""

    @property
    def extent(self) -> Extent:
        """min_x, max_x, min_y, max_y: outer edges, metres."""
        rows, columns = self.height.shape
        return self.min_x, self.min_x + columns * self.cell, self.min_y, self.min_y + rows * self.cell

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """(C,): x of the centres of the columns, metres."""
        return _centres(self.min_x, self.cell, self.height.shape[1])

    @property
    def y(self) -> npt.NDArray[np.float64]:
        """(R,): y of the centres of the rows, metres."""
        return _centres(self.min_y, self.cell, self.height.shape[0])

    @property
    def age(self) -> npt.NDArray[np.uint32]:
        """(R, C): number of scans added since the cell was measured last; `total_scans` if unknown."""
        return np.uint32(self.total_scans) - self.last_scan


class GroundMap:
    """The ground along a run, in the world frame: one height per cell, from all scans that saw the cell.

    Each scan is levelled to the map before it is added, which removes the errors of its pose in height, pitch and roll.
    A cell keeps two heights, so a wrong one from one scan, such as a car roof, gives way to the height that more scans
    measured. If a run returns to the same ground, later scans are levelled to the heights of the first pass.

    The map depends on the order of the scans, but not on the order of the points in a scan. Thread-safe: scans are
    added one at a time, and queries from several threads run in parallel. All methods release the GIL.

    Args:
        cell: Size of a cell, metres, 0.1 to 2.
        max_range: Points farther from the sensor than this are not added, metres, 5 to 100.
        window: After each scan, tiles farther from the sensor than this are removed, metres, 50 to 1e6. None: the map
            keeps everything.
        max_correction: Largest height difference between a scan and the map that is treated as an error of the pose,
            metres, 0 to 100, beyond the correction of the scan before. Scans that differ more are added with the
            correction of the scan before.
        max_memory: Largest memory of the cells, bytes. Beyond it, the tiles that were not measured for the longest time
            are kept in files in `directory`. The limit does not change any result. None: no limit.
        directory: Directory for these files, created if it does not exist. The files belong to this map: use another
            directory for each map, and remove it after the map.

    A map can be pickled, unless it has a memory limit.

    Raises:
        ValueError: A value is out of its range, or only one of `max_memory` and `directory` is given.
        OSError: The directory cannot be created.
    """

    def __init__(
        self,
        *,
        cell: float = 0.5,
        max_range: float = 40,
        window: float | None = None,
        max_correction: float = 1,
        max_memory: int | None = None,
        directory: str | os.PathLike[str] | None = None,
    ) -> None:
        if (max_memory is None) != (directory is None):
            raise ValueError("max_memory: needs a directory for tiles (expected both or neither)")
        if max_memory is not None and max_memory < 1:
            raise ValueError(f"max_memory: {max_memory} is out of range (expected at least 1 byte, or None)")
        self._cell = float(cell)
        self._settings: dict[str, Any] = {
            "cell": cell,
            "max_range": max_range,
            "window": window,
            "max_correction": max_correction,
        }
        self._directory = directory
        self._core = _core.GroundMap(
            cell=cell,
            max_range=max_range,
            window=none_as_zero("window", window),
            max_correction=max_correction,
            max_memory=max_memory or 0,
            directory=os.fspath(directory) if directory is not None else "",
        )
        if directory is not None:
            Path(directory).mkdir(parents=True, exist_ok=True)

    def __repr__(self) -> str:
        return f"GroundMap({self.scans} scans, {self.cells} cells of {self._cell:g} m)"

    def __reduce__(self) -> tuple[Any, ...]:
        if self._directory is not None:
            raise TypeError("a map with a memory limit cannot be pickled (use to_bytes)")
        return restored, (GroundMap, self._settings, self.to_bytes())

    def add(self, points: PointsLike, result: Segmentation, pose: npt.ArrayLike) -> Levelling:
        """Levels a scan to the map and adds it.

        Args:
            points: (N, >=3), the scan, as `Segmenter.segment` accepts it.
            result: Result of segmenting the points by a method that computes heights, such as `Surface`.
            pose: (4, 4) or (3, 4): rotation and position, metres, that transform the frame of the scan to the world
                frame, whose z axis points up. The tilt, origin and scale of `result.mount` are taken into account; a
                scan in other units is scaled to metres before the pose applies.

        Returns:
            The correction of the pose.

        Raises:
            TypeError: The points are not floats, or not in CPU memory.
            ValueError: The result has no heights of these points, or the pose is not a finite rotation and position.
                The map does not change.
            MemoryError: There is not enough memory.
        """
        return Levelling(*self._core.add(*columns_of(points), result._result, pose_rows(pose)))

    def level(self, points: PointsLike, result: Segmentation, pose: npt.ArrayLike) -> Levelling:
        """Levels a scan to the map without adding it. See `add` for arguments and errors."""
        return Levelling(*self._core.level(*columns_of(points), result._result, pose_rows(pose)))

    @overload
    def height(self, x: float, y: float) -> float: ...
    @overload
    def height(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.float64]: ...
    def height(self, x: npt.ArrayLike, y: npt.ArrayLike) -> npt.NDArray[np.float64] | float:
        """Height z of the ground at given positions, interpolated between the four nearest cells.

        Args:
            x: Metres, world frame, any shape.
            y: Metres, any shape that broadcasts with x.

        Returns:
            z in metres, in the shape that x and y broadcast to; NaN if unknown. A float if x and y are numbers.
        """
        flat_x, flat_y, shape = _flattened(x, y)
        heights = self._core.height_at(flat_x, flat_y)
        return heights.reshape(shape) if shape else float(heights[0])

    def heights(
        self, points: PointsLike, result: Segmentation, pose: npt.ArrayLike, levelling: Levelling
    ) -> npt.NDArray[np.float32]:
        """Heights of the points of a scan above the ground.

        A height is the mean of the height above the surface of the scan and the height above the map, weighted by their
        expected errors. In cells in which the scan has points on the ground, this is nearly the height of the scan. In
        other cells, it is the height above the map. If one of them is unknown, it is the other one.

        Args:
            points: (N, >=3), the scan, as `Segmenter.segment` accepts it.
            result: Result of segmenting the points by a method that computes heights, such as `Surface`.
            pose: (4, 4) or (3, 4), as `add` accepts it.
            levelling: What `add` or `level` returned for this scan.

        Returns:
            (N,): metres; NaN if both are unknown, and for points that are invalid or out of range.

        Raises:
            TypeError: The points are not floats, or not in CPU memory.
            ValueError: The result has no heights of these points, or the pose is not a finite rotation and position.
            MemoryError: There is not enough memory.
        """
        return self._core.heights(*columns_of(points), result._result, pose_rows(pose), levelling)

    def relabel(
        self,
        points: PointsLike,
        result: Segmentation,
        pose: npt.ArrayLike,
        levelling: Levelling,
        labels: npt.ArrayLike | None = None,
    ) -> npt.NDArray[np.uint8]:
        """The labels of a scan after a comparison with the map.

        Points that are labelled ground but are too far above the map become `nonground`. Far away, a scan has few
        points on the ground, and its surface can follow the points on objects; the map has the ground from nearer
        scans. The margin is 0.24 m, or 0.06 m in cells that contain an obstacle in this scan, plus the expected error
        of the map, at most 0.06 m. If the map is unknown at a point, its label stays. See `heights` for the other
        arguments and errors.

        Args:
            points: The scan.
            result: Its result.
            pose: Its pose.
            levelling: Its levelling.
            labels: (N,): code of each point, such as from `LabelVote.relabel`. By default, the labels of the result.

        Returns:
            (N,): a new array.

        Raises:
            ValueError: `labels` has another length than the points.
        """
        changed = np.array(result.labels if labels is None else labels, dtype=np.uint8, order="C")
        self._core.relabel(*columns_of(points), result._result, pose_rows(pose), levelling, changed)
        return changed

    def at(self, x: npt.ArrayLike, y: npt.ArrayLike) -> MapSample:
        """Height, normal, slope, deviation and counts at given positions. See `height` for the arguments."""
        flat_x, flat_y, shape = _flattened(x, y)
        height, normal, slope, deviation, scans, contradictions, age = self._core.at(flat_x, flat_y)
        return MapSample(
            height=height.reshape(shape),
            normal=normal.reshape((*shape, 3)),
            slope=slope.reshape(shape),
            deviation=deviation.reshape(shape),
            scans=scans.reshape(shape),
            contradictions=contradictions.reshape(shape),
            age=age.reshape(shape),
        )

    def grid(self, extent: Sequence[float] | None = None) -> MapGrid:
        """A rectangle of the map as arrays.

        Args:
            extent: min_x, max_x, min_y, max_y in metres; the rectangle contains every cell that it touches. By default
                the whole map, in whole tiles of 64 x 64 cells.

        Returns:
            A copy of the cells: 16 bytes per cell. An empty map without `extent` gives an array of (0, 0).

        Raises:
            ValueError: The extent is not four finite numbers in this order.
            MemoryError: There is not enough memory.
        """
        width = _core.ground_map_tile_width
        if extent is None:
            first_column, first_row, columns, rows = tile_limits(self._core.tiles(), width)
        else:
            first_column, first_row, columns, rows = cell_limits(extent, self._cell)
        scans = self._core.scans()
        height, deviation, agreeing, contradictions, last_scan = self._core.grid(first_column, first_row, columns, rows)
        return MapGrid(
            cell=self._cell,
            min_x=first_column * self._cell,
            min_y=first_row * self._cell,
            total_scans=scans,
            height=height,
            deviation=deviation,
            scans=agreeing,
            contradictions=contradictions,
            last_scan=last_scan,
        )

    def to_bytes(self) -> bytes:
        """The state of the map as bytes, without the settings.

        Raises:
            OSError: A tile beyond `max_memory` cannot be read.
        """
        return self._core.to_bytes()

    def from_bytes(self, data: bytes) -> None:
        """Replaces the map by that of `to_bytes`. Scans that are added later give the same map as without a break.

        Raises:
            ValueError: The bytes are damaged, or of a map with another `cell`. The map does not change.
        """
        self._core.from_bytes(data)

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes the map as one NumPy file per tile and `map.json`, as `flagstone map` does.

        `flagstone.maps.read_ground_map` reads them. Each file is written atomically, `map.json` last.

        Args:
            directory: Directory for the files, created if it does not exist.

        Raises:
            OSError: A file cannot be written.
        """
        self._core.write(os.fspath(directory))

    @property
    def cell(self) -> float:
        """Size of a cell, metres."""
        return self._cell

    @property
    def scans(self) -> int:
        """Number of scans added."""
        return self._core.scans()

    @property
    def cells(self) -> int:
        """Number of cells with a height."""
        return self._core.cells()

    @property
    def nbytes(self) -> int:
        """Memory in use, bytes."""
        return self._core.nbytes()


def restored(kind: Any, settings: dict[str, Any], data: bytes) -> Any:
    """A map, vote or finder of moving points from a pickle."""
    state = kind(**settings)
    state.from_bytes(data)
    return state


def pose_rows(pose: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """A copy of the rows of a pose: (3, 4), rotation and position.

    Raises:
        ValueError: The pose has another shape, its last row is not (0, 0, 0, 1), or it is not finite.
    """
    matrix = np.array(pose, np.float64)
    if matrix.shape not in ((4, 4), (3, 4)):
        raise ValueError(f"pose: shape {matrix.shape} is not supported (expected (4, 4) or (3, 4))")
    if not np.isfinite(matrix).all():
        raise ValueError("pose: a number is not finite (expected rotation and position in metres)")
    if matrix.shape == (4, 4) and not np.array_equal(matrix[3], (0, 0, 0, 1)):
        raise ValueError(f"pose: the last row is {matrix[3].tolist()} (expected [0, 0, 0, 1]; is it transposed?)")
    return np.ascontiguousarray(matrix[:3])


def tile_limits(tiles: Sequence[tuple[int, int]], width: int) -> tuple[int, int, int, int]:
    """First column, first row, columns and rows of the cells that contain all tiles; zeros without tiles."""
    if not tiles:
        return 0, 0, 0, 0
    columns, rows = zip(*tiles, strict=True)
    return (
        width * min(columns),
        width * min(rows),
        width * (max(columns) - min(columns) + 1),
        width * (max(rows) - min(rows) + 1),
    )


def cell_limits(extent: Sequence[float], cell: float) -> tuple[int, int, int, int]:
    """First column, first row, columns and rows of the cells that a rectangle touches.

    Raises:
        ValueError: The extent is not four finite numbers in the right order.
    """
    numbers = np.asarray(extent, np.float64)
    is_rectangle = numbers.shape == (4,) and bool(np.isfinite(numbers).all())
    if not is_rectangle or not (numbers[0] < numbers[1] and numbers[2] < numbers[3]):
        raise ValueError(f"extent: {extent!r} is not a rectangle (expected min_x, max_x, min_y, max_y in metres)")
    rounding = 1e-9  # cells, so that an edge between two cells does not add a column
    min_x, max_x, min_y, max_y = (numbers / cell).tolist()
    first_column, first_row = math.floor(min_x + rounding), math.floor(min_y + rounding)
    return (
        first_column,
        first_row,
        max(1, math.ceil(max_x - rounding) - first_column),
        max(1, math.ceil(max_y - rounding) - first_row),
    )


def none_as_zero(name: str, value: float | None) -> float:
    """The number by which the core keeps everything if no window is given."""
    if value == 0:
        raise ValueError(f"{name}: 0 is out of range (expected a distance in metres, or None to keep everything)")
    return 0 if value is None else value


def _centres(first: float, cell: float, count: int) -> npt.NDArray[np.float64]:
    centres: npt.NDArray[np.float64] = first + (np.arange(count, dtype=np.float64) + 0.5) * cell
    return centres


def _shortest_rotation_to_z(up: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    x, y, z = up
    k = 1 / (1 + z)
    return np.array([[1 - x * x * k, -x * y * k, -x], [-x * y * k, 1 - y * y * k, -y], [x, y, z]])


def _flattened(
    x: npt.ArrayLike, y: npt.ArrayLike
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], tuple[int, ...]]:
    wide_x, wide_y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    return np.ascontiguousarray(wide_x).ravel(), np.ascontiguousarray(wide_y).ravel(), wide_x.shape
