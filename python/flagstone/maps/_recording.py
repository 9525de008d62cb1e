# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A recording of a mapped run for the viewer of Rerun."""

from __future__ import annotations

import uuid
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._optional import needs
from flagstone._palette import LABELS, MOVING, PANEL, PATH
from flagstone.codes import Label
from flagstone.ground_map import MapGrid
from flagstone.maps._growth import GrowingGround, Mask, grid_look, grid_relief, stride
from flagstone.maps._run_files import MappedScan, read_run
from flagstone.maps._tiles import PathLike, read_ground_map
from flagstone.viewer import TIMELINE, save_recording

if TYPE_CHECKING:
    import rerun
    import rerun.blueprint

_SHOWN = (Label.GROUND, Label.NONGROUND, Label.NOISE, Label.OUT_OF_RANGE)
_ORIGIN_STEP = 1000.0  # metres


def write_recording(
    directory: PathLike,
    path: PathLike,
    *,
    scans: Sequence[PathLike] | None = None,
    every: int = 1,
    max_points: int = 50_000,
) -> None:
    """Writes a recording of a mapped run (`.rrd`), atomically. Open it with `rerun FILE.rrd`.

    On the timeline `scan`, the ground grows by the cells that each scan measures first. The points of the scan are
    coloured by label, moving points are red, and a line shows the path of the sensor. The ground has the heights of the
    finished map. Coordinates are relative to the position of the first scan, rounded to whole kilometres, because the
    viewer computes with 32-bit floats.

    Args:
        directory: Output directory of `flagstone map`.
        path: File to write.
        scans: Paths of the scans in order, if they have moved since. By default those in `run.json`.
        every: Records every N-th scan, 1 or more. The ground contains only what these scans measured.
        max_points: Largest number of points per scan, 1 or more; of larger scans every second, third, ... point is
            recorded. Moving points are all recorded.

    Raises:
        FileNotFoundError: A file of the run, a scan or its labels, or the directory of `path` do not exist.
        ImportError: Rerun is not installed: pip install 'flagstone[viewer]'.
        OSError: The file cannot be written.
        ValueError: An argument is out of its range, or a file is damaged.
    """
    for name, value in (("every", every), ("max_points", max_points)):
        if value < 1:
            raise ValueError(f"{name}: {value!r} is out of range (expected 1 or more)")
    rr = needs("rerun", extra="viewer")
    run = read_run(directory, scans=scans)
    grid = read_ground_map(directory)
    recording = rr.RecordingStream("flagstone", recording_id=str(uuid.uuid4()))
    log = _Log(recording, grid, _origin_of(run.path), max_points)

    def log_all() -> None:
        for scan in run.scans(every):
            log.add(scan)

    save_recording(recording, Path(path), _blueprint(log.eye_target(run.path)), log_all)


class _Log:
    """Adds scans to a recording."""

    def __init__(
        self, recording: rerun.RecordingStream, grid: MapGrid, origin: npt.NDArray[np.float64], max_points: int
    ) -> None:
        self._recording = recording
        self._growing = GrowingGround(grid)
        self._colors = grid_relief(grid, grid_look(grid))
        self._origin = origin
        self._max_points = max_points
        self._path: list[npt.NDArray[np.float64]] = []

    def add(self, scan: MappedScan) -> None:
        self._recording.set_time(TIMELINE, sequence=scan.number)
        self._log_ground(scan.number, self._growing.add(scan))
        self._log_points(scan)
        self._log_path(scan)

    def eye_target(self, path: npt.NDArray[np.float64]) -> tuple[float, float, float]:
        """The first position of the sensor, in the coordinates of the recording."""
        known = path[np.isfinite(path).all(axis=1)]
        x, y = (known[0] - self._origin[:2]).tolist() if len(known) else (0.0, 0.0)
        heights = self._growing.grid.height
        return x, y, float(np.nanmedian(heights)) if np.isfinite(heights).any() else 0.0

    def _log_ground(self, number: int, new: Mask) -> None:
        """Logs one entity per scan, because an entity that is logged again replaces the earlier one."""
        rr = needs("rerun", extra="viewer")
        if not new.any():
            return
        mesh = cell_mesh(self._growing.grid, new, self._origin)
        self._recording.log(
            f"ground/scan_{number:06}",
            rr.Mesh3D(
                vertex_positions=mesh.corners,
                triangle_indices=mesh.triangles,
                vertex_colors=np.repeat(self._colors[new], 4, axis=0),
            ),
            strict=True,
        )

    def _log_points(self, scan: MappedScan) -> None:
        rr = needs("rerun", extra="viewer")
        world = scan.world
        finite = np.isfinite(scan.points).all(axis=1)
        world = np.where(np.isfinite(world), world - self._origin, 0).astype(np.float32)
        thin = np.zeros(len(world), np.bool_)
        thin[:: stride(len(world), self._max_points)] = True
        for label in _SHOWN:
            shown = finite & thin & (scan.labels == label) & ~scan.moving
            self._recording.log(
                f"points/{label.name.lower()}",
                rr.Points3D(world[shown], colors=[LABELS[label]], radii=[rr.Radius.ui_points(1.2)]),
                strict=True,
            )
        self._recording.log(
            "points/moving",
            rr.Points3D(world[finite & scan.moving], colors=[MOVING], radii=[rr.Radius.ui_points(2.5)]),
            strict=True,
        )

    def _log_path(self, scan: MappedScan) -> None:
        rr = needs("rerun", extra="viewer")
        self._path.append(scan.pose[:, 3] - self._origin)
        most = 1000  # vertices, so that the path of a long run does not dominate the recording
        line = np.array([*self._path[:: stride(len(self._path), most)], self._path[-1]], np.float32)
        self._recording.log("path", rr.LineStrips3D([line], colors=[PATH], radii=[rr.Radius.ui_points(2)]), strict=True)
        self._recording.log(
            "sensor", rr.Points3D([line[-1]], colors=[PATH], radii=[rr.Radius.ui_points(6)]), strict=True
        )


class CellMesh(NamedTuple):
    """Two triangles per cell. The cells do not share corners, so that each has one colour."""

    corners: npt.NDArray[np.float32]
    """(4 K, 3): x, y, z, metres: the corners of each cell, counter-clockwise."""
    triangles: npt.NDArray[np.uint32]
    """(2 K, 3): indices into `corners`."""


def cell_mesh(grid: MapGrid, cells: Mask, origin: npt.NDArray[np.float64]) -> CellMesh:
    """The surface of some cells of a map, in the order of `numpy.nonzero(cells)`.

    The height of a corner is the mean height of the known cells around it, so that neighbours meet.
    """
    row, column = np.nonzero(cells)
    corners = np.empty((len(row), 4, 3), np.float64)
    for k, (right, up) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
        corners[:, k, 0] = grid.min_x + (column + right) * grid.cell - origin[0]
        corners[:, k, 1] = grid.min_y + (row + up) * grid.cell - origin[1]
        corners[:, k, 2] = _corner_heights(grid, row + up, column + right) - origin[2]
    first = 4 * np.arange(len(row), dtype=np.uint32)
    triangles = first[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
    return CellMesh(corners.reshape(-1, 3).astype(np.float32), triangles.reshape(-1, 3))


def _corner_heights(
    grid: MapGrid, row: npt.NDArray[np.int64], column: npt.NDArray[np.int64]
) -> npt.NDArray[np.float64]:
    """Mean height of the known cells around the lower left corner of each cell; at least one must be known."""
    rows, columns = grid.height.shape
    total = np.zeros(len(row))
    known = np.zeros(len(row))
    for down in (1, 0):
        for left in (1, 0):
            r, c = row - down, column - left
            inside = (r >= 0) & (r < rows) & (c >= 0) & (c < columns)
            height = np.full(len(row), np.nan)
            height[inside] = grid.height[r[inside], c[inside]]
            known += np.isfinite(height)
            total += np.nan_to_num(height)
    mean: npt.NDArray[np.float64] = total / known
    return mean


def _origin_of(path: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    known = path[np.isfinite(path).all(axis=1)]
    x, y = np.round(known[0] / _ORIGIN_STEP) * _ORIGIN_STEP if len(known) else (0.0, 0.0)
    return np.array([x, y, 0.0])


def _blueprint(target: tuple[float, float, float]) -> rerun.blueprint.Blueprint:
    """The initial view of a recording: the beginning of the run, from behind and above."""
    rrb: Any = needs("rerun.blueprint", extra="viewer")
    x, y, z = target
    made: rerun.blueprint.Blueprint = rrb.Blueprint(
        rrb.Spatial3DView(
            name="Map",
            contents=["/**"],
            background=PANEL,
            line_grid=False,
            eye_controls=rrb.EyeControls3D(position=(x - 40, y - 25, z + 40), look_target=(x, y, z), eye_up=(0, 0, 1)),
        ),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed"),
    )
    return made
