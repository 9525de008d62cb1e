# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reads the tiles of a ground map."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone.ground_map import MapGrid, cell_limits, tile_limits

PathLike = str | os.PathLike[str]

LAYERS = {"height": "<f4", "deviation": "<f4", "last_scan": "<u4", "scans": "<u2", "contradictions": "<u2"}
"""The fields of a cell in a tile, with their types."""

_FORMAT, _VERSION = "flagstone ground map", 1


class Tile(NamedTuple):
    """A square of cells in a file."""

    file: Path
    column: int
    """x of the first cell, in cells."""
    row: int
    """y of the first cell, in cells."""


class TileFiles:
    """The tiles of a map, listed by map.json.

    Args:
        directory: The output directory of a run, or the directory of its tiles.

    Raises:
        FileNotFoundError: The directory has no map.json.
        ValueError: map.json does not describe a ground map.
    """

    def __init__(self, directory: PathLike) -> None:
        folder = Path(directory)
        if not (folder / "map.json").is_file() and (folder / "ground" / "map.json").is_file():
            folder = folder / "ground"
        self._path = folder / "map.json"
        geometry = read_json(self._path)
        if geometry.get("format") != _FORMAT or geometry.get("version") != _VERSION:
            raise ValueError(f"{self._path}: not a ground map (expected format {_FORMAT!r}, version {_VERSION})")
        try:
            self.cell = float(geometry["cell"])
            self.tile_width = int(geometry["tile_width"])
            self.scans = int(geometry["scans"])
            self.indices = [(int(tile["x"]), int(tile["y"])) for tile in geometry["tiles"]]
            names = [Path(tile["file"]).name for tile in geometry["tiles"]]
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"{self._path}: invalid geometry: {type(error).__name__} {error}") from error
        if not (self.cell > 0 and self.tile_width > 0):
            raise ValueError(f"{self._path}: cells of {self.cell} m in tiles of {self.tile_width} (expected above 0)")
        width = self.tile_width
        self.tiles = [
            Tile(folder / name, x * width, y * width) for name, (x, y) in zip(names, self.indices, strict=True)
        ]

    def limits(self, extent: Sequence[float] | None) -> tuple[int, int, int, int]:
        """First column, first row, columns and rows of the cells within `extent`; of all tiles by default."""
        return tile_limits(self.indices, self.tile_width) if extent is None else cell_limits(extent, self.cell)

    def cells_in(
        self, column: int, row: int, columns: int, rows: int
    ) -> Iterator[tuple[npt.NDArray[np.void], slice, slice]]:
        """The cells of every tile that overlaps a rectangle of cells.

        Yields:
            The cells, and their rows and columns in the rectangle.

        Raises:
            FileNotFoundError: A tile is missing.
            ValueError: A tile has another shape or other fields.
        """
        width = self.tile_width
        for tile in self.tiles:
            left, below = tile.column - column, tile.row - row
            first_column, first_row = max(0, -left), max(0, -below)
            last_column, last_row = min(width, columns - left), min(width, rows - below)
            if first_column >= last_column or first_row >= last_row:
                continue
            cells = self._read(tile)[first_row:last_row, first_column:last_column]
            yield (
                cells,
                slice(below + first_row, below + last_row),
                slice(left + first_column, left + last_column),
            )

    def _read(self, tile: Tile) -> npt.NDArray[np.void]:
        try:
            cells: npt.NDArray[np.void] = np.load(tile.file, allow_pickle=False)
        except FileNotFoundError:
            raise FileNotFoundError(f"{tile.file}: tile is missing (expected every tile of {self._path})") from None
        except (ValueError, EOFError, OSError) as error:
            reason = " ".join(str(error).split())
            raise ValueError(f"{tile.file}: not a NumPy array: {reason} (the file may be damaged)") from error
        expected = (self.tile_width, self.tile_width)
        if cells.shape != expected or any(
            name not in (cells.dtype.names or ()) or cells.dtype[name] != np.dtype(kind)
            for name, kind in LAYERS.items()
        ):
            raise ValueError(
                f"{tile.file}: array of shape {cells.shape} and type {cells.dtype} is not a tile (expected {expected}, "
                f"fields {', '.join(LAYERS)})"
            )
        return cells


def read_ground_map(directory: PathLike, *, extent: Sequence[float] | None = None) -> MapGrid:
    """Reads the ground map of a run.

    Args:
        directory: Output directory of `flagstone map`, or its directory `ground`.
        extent: min_x, max_x, min_y, max_y in metres, to read only a part: every cell that the rectangle touches. By
            default the whole map, in whole tiles.

    Returns:
        The layers as arrays, 16 bytes per cell.

    Raises:
        FileNotFoundError: The directory contains no map, or a tile is missing.
        ValueError: A file does not belong to a ground map, or the extent is not four finite numbers in this order.
        MemoryError: There is not enough memory.
    """
    files = TileFiles(directory)
    column, row, columns, rows = files.limits(extent)
    grid = MapGrid(
        cell=files.cell,
        min_x=column * files.cell,
        min_y=row * files.cell,
        total_scans=files.scans,
        height=np.full((rows, columns), np.nan, np.float32),
        deviation=np.full((rows, columns), np.nan, np.float32),
        scans=np.zeros((rows, columns), np.uint16),
        contradictions=np.zeros((rows, columns), np.uint16),
        last_scan=np.zeros((rows, columns), np.uint32),
    )
    for cells, to_rows, to_columns in files.cells_in(column, row, columns, rows):
        for name in LAYERS:
            getattr(grid, name)[to_rows, to_columns] = cells[name]
    return grid


def read_json(path: Path) -> dict[str, Any]:
    """The object in a JSON file.

    Raises:
        FileNotFoundError: The file does not exist.
        ValueError: The file does not contain a JSON object.
    """
    try:
        contents = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise FileNotFoundError(f"{path}: file does not exist (expected the output of flagstone map)") from None
    except ValueError as error:
        raise ValueError(f"{path}: not JSON: {error} (the file may be damaged)") from error
    if not isinstance(contents, dict):
        raise ValueError(f"{path}: not a JSON object")
    return contents
