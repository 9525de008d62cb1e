# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""An animation of a run: the ground becomes known scan by scan, with moving points in red."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._atomic_file import atomic_write
from flagstone._optional import needs
from flagstone._palette import MOVING, NONMOVING, PAGE, PATH, Color
from flagstone.codes import Label
from flagstone.ground_map import MapGrid
from flagstone.maps._growth import GrowingGround, grid_look, grid_relief, stride
from flagstone.maps._run_files import MappedRun, MappedScan, read_run
from flagstone.maps._tiles import PathLike, read_ground_map

_LARGEST_WHOLE = 250.0  # metres: longer runs are shown around the sensor
_REACH = 80.0  # metres shown to each side of the sensor
_MARGIN = 30.0  # metres around the path of a shorter run
_LAST_FRAME = 2.0  # seconds that the finished map is shown

_FIXED: tuple[Color, ...] = (PAGE, NONMOVING, MOVING, PATH)
_PALETTE = 256


class _View(NamedTuple):
    """A rectangle of the world, and the image of it: x to the right, y up."""

    center_x: float
    """Metres."""
    center_y: float
    """Metres."""
    scale: float
    """Pixels per metre."""
    width: int
    """Pixels."""
    height: int
    """Pixels."""

    def pixels(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Columns and rows of positions, pixels."""
        return self.width / 2 + self.scale * (x - self.center_x), self.height / 2 - self.scale * (y - self.center_y)


def write_animation(
    directory: PathLike,
    path: PathLike,
    *,
    scans: Sequence[PathLike] | None = None,
    size: int = 640,
    frames_per_second: float = 12,
    max_frames: int = 200,
) -> None:
    """Writes an animation of a mapped run as a GIF file, atomically.

    The bird's-eye view shows the ground as shaded relief where the scans so far have measured it, the points of the
    present scan that are not ground in grey, moving points in red, and the path of the sensor in blue. A run of up to
    250 m is shown as a whole. For a longer run, the view follows the sensor. The last frame is the finished map.

    Args:
        directory: Output directory of `flagstone map`.
        path: File to write, `.gif`.
        scans: Paths of the scans in order, if they have moved since. By default those in `run.json`.
        size: The longer side of the image, pixels, 64 to 2,048.
        frames_per_second: 1 to 50. One scan per frame, unless there are more scans than `max_frames`.
        max_frames: Largest number of frames, 2 to 2,000; of a longer run every second, third, ... scan is shown.

    Raises:
        FileNotFoundError: A file of the run, a scan or its labels do not exist.
        ImportError: Pillow is not installed: pip install 'flagstone[plot]'.
        OSError: The file cannot be written.
        ValueError: An argument is out of its range, a file is damaged, or no scan has a pose and labels.
    """
    _check("size", size, 64, 2048, "pixels")
    _check("frames_per_second", frames_per_second, 1, 50, "frames per second")
    _check("max_frames", max_frames, 2, 2000, "frames")
    name = os.fspath(path)
    if not name.lower().endswith(".gif"):
        raise ValueError(f"{name}: unknown extension of an animation (expected .gif)")
    needs("PIL", extra="plot")
    frames = _Frames(read_run(directory, scans=scans), read_ground_map(directory), size)
    images = frames.draw(max_frames)
    period = round(1000 / frames_per_second)
    with atomic_write(path) as file:
        images[0].save(
            file,
            format="GIF",
            save_all=True,
            append_images=images[1:],
            duration=[period] * (len(images) - 1) + [round(1000 * _LAST_FRAME)],
            loop=0,
            disposal=1,
        )


class _Frames:
    """Draws the frames of one animation, all with the same palette, so that colours do not flicker."""

    def __init__(self, run: MappedRun, grid: MapGrid, size: int) -> None:
        self._run = run
        self._growing = GrowingGround(grid)
        self._relief = grid_relief(grid, grid_look(grid))
        self._size = size
        self._image = needs("PIL.Image", extra="plot")
        self._draw = needs("PIL.ImageDraw", extra="plot")
        self._font = needs("PIL.ImageFont", extra="plot").load_default(max(11, size // 40))
        self._palette = self._palette_of(grid)
        self._whole = _view_of(run.path, size)

    def draw(self, max_frames: int) -> list[Any]:
        """At most `max_frames` images with a palette; the last one shows the finished map."""
        images = []
        passed: list[npt.NDArray[np.float64]] = []
        last: MappedScan | None = None
        for scan in self._run.scans(stride(len(self._run), max_frames - 1)):
            self._growing.add(scan)
            passed.append(scan.pose[:2, 3])
            images.append(self._frame(scan, np.array(passed), f"scan {scan.number + 1} of {len(self._run)}"))
            last = scan
        if last is None:
            raise ValueError(f"{self._run.directory}: no scan has a pose and labels (expected at least one)")
        self._growing.known[:] = np.isfinite(self._growing.grid.height)
        images.append(self._frame(None, np.array(passed), "all scans"))
        return images

    def _frame(self, scan: MappedScan | None, passed: npt.NDArray[np.float64], text: str) -> Any:
        x, y = passed[-1]
        view = self._whole or _View(float(x), float(y), self._size / (2 * _REACH), self._size, self._size)
        pixels = self._ground(view)
        if scan is not None:
            world = scan.world
            standing = (scan.labels == Label.NONGROUND) & ~scan.moving
            _plot(pixels, view, world[standing], NONMOVING, width=1)
            _plot(pixels, view, world[scan.moving], MOVING, width=3)
        image = self._image.fromarray(pixels)
        draw = self._draw.Draw(image)
        self._draw_path(draw, view, passed)
        self._draw_text(draw, view, text)
        return image.quantize(palette=self._palette, dither=self._image.Dither.NONE)

    def _ground(self, view: _View) -> npt.NDArray[np.uint8]:
        """(height, width, 3): the relief of known cells."""
        grid = self._growing.grid
        rows, columns = grid.height.shape
        x = view.center_x + (np.arange(view.width) + 0.5 - view.width / 2) / view.scale
        y = view.center_y - (np.arange(view.height) + 0.5 - view.height / 2) / view.scale
        column = np.floor((x - grid.min_x) / grid.cell).astype(np.int64)
        row = np.floor((y - grid.min_y) / grid.cell).astype(np.int64)
        pixels = np.full((view.height, view.width, 3), PAGE, np.uint8)
        (to_columns,) = np.nonzero((column >= 0) & (column < columns))
        (to_rows,) = np.nonzero((row >= 0) & (row < rows))
        if not len(to_columns) or not len(to_rows):
            return pixels
        cells = np.ix_(row[to_rows], column[to_columns])
        page = np.array(PAGE, np.uint8)
        pixels[np.ix_(to_rows, to_columns)] = np.where(self._growing.known[cells][..., None], self._relief[cells], page)
        return pixels

    def _draw_path(self, draw: Any, view: _View, passed: npt.NDArray[np.float64]) -> None:
        column, row = view.pixels(passed[:, 0], passed[:, 1])
        width = max(2, self._size // 250)
        if len(passed) > 1:
            draw.line(list(zip(column.tolist(), row.tolist(), strict=True)), fill=PATH, width=width)
        x, y, radius = float(column[-1]), float(row[-1]), 2.5 * width
        draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=PATH, outline=PAGE)

    def _draw_text(self, draw: Any, view: _View, text: str) -> None:
        gap = self._size // 40
        draw.text((gap, gap), text, font=self._font, fill=PATH, stroke_width=2, stroke_fill=PAGE)
        metres = _round_length(view.width / view.scale / 4)
        right, line = view.width - gap, view.height - gap
        left = right - metres * view.scale
        draw.line((left, line, right, line), fill=PATH, width=2)
        draw.text(
            (left, line - gap // 3),
            f"{metres:g} m",
            font=self._font,
            fill=PATH,
            anchor="ls",
            stroke_width=2,
            stroke_fill=PAGE,
        )

    def _palette_of(self, grid: MapGrid) -> Any:
        """An image with the palette of all frames: the colours of the relief, and those of points and path."""
        known = self._relief[np.isfinite(grid.height)]
        relief = known[:: stride(max(1, len(known)), 500_000)].reshape(1, -1, 3)
        if not relief.size:
            relief = np.array([[PAGE]], np.uint8)
        reduced = self._image.fromarray(relief).quantize(colors=_PALETTE - len(_FIXED))
        colors = reduced.getpalette()[: 3 * (_PALETTE - len(_FIXED))] + [part for color in _FIXED for part in color]
        palette = self._image.new("P", (1, 1))
        palette.putpalette(colors)
        return palette


def _view_of(path: npt.NDArray[np.float64], size: int) -> _View | None:
    """A view of the whole run; None if it is too long for one, or if no position is known."""
    known = path[np.isfinite(path).all(axis=1)]
    if not len(known):
        return None
    low, high = known.min(axis=0), known.max(axis=0)
    if (high - low).max() > _LARGEST_WHOLE:
        return None
    width, height = (high - low + 2 * _MARGIN).tolist()
    x, y = ((low + high) / 2).tolist()
    scale = size / max(width, height)
    return _View(x, y, scale, round(scale * width), round(scale * height))


def _plot(pixels: npt.NDArray[np.uint8], view: _View, world: npt.NDArray[np.float64], color: Color, width: int) -> None:
    """Draws a square of `width` pixels, an odd number, at each point."""
    column, row = (np.floor(place).astype(np.int64) for place in view.pixels(world[:, 0], world[:, 1]))
    half = width // 2
    for down in range(-half, half + 1):
        for right in range(-half, half + 1):
            c, r = column + right, row + down
            inside = (c >= 0) & (c < view.width) & (r >= 0) & (r < view.height)
            pixels[r[inside], c[inside]] = color


def _round_length(most: float) -> float:
    """The largest 1, 2 or 5 times a power of ten that is at most `most`."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(factor * power for factor in (5, 2, 1) if factor * power <= most))


def _check(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not low <= value <= high:
        raise ValueError(f"{name}: {value!r} is out of range (expected {low:,} to {high:,} {unit})")
