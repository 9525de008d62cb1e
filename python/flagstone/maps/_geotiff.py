# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Writes a ground map as a GeoTIFF file, for geographic information systems."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from flagstone._optional import needs
from flagstone.maps._tiles import PathLike, TileFiles

_BANDS = {
    "height": "z of the ground, metres",
    "deviation": "expected error of the height (standard deviation), metres",
    "scans": "number of scans that agree on the height",
    "contradictions": "number of scans that measured another height",
}


def write_geotiff(directory: PathLike, path: PathLike, *, crs: str | int | None = None) -> None:
    """Writes the ground map of a run as a GeoTIFF file, atomically.

    The four bands are float32: height, deviation, scans and contradictions. They are NaN where the ground is unknown.
    The file is compressed, and the memory in use does not depend on the size of the map.

    Args:
        directory: Output directory of `flagstone map`, or its directory `ground`.
        path: File to write.
        crs: Coordinate reference system of the poses, as `rasterio` accepts it: "EPSG:25832", 25832 or WKT. By default
            the file has none, as is right for poses that start at 0.

    Raises:
        FileNotFoundError: The directory contains no map, or a tile is missing.
        ImportError: rasterio is not installed: pip install 'flagstone[geotiff]'.
        OSError: The file cannot be written.
        ValueError: A file does not belong to a ground map, the map is empty, or `crs` is unknown.
    """
    rasterio = needs("rasterio", extra="geotiff")
    system = system_of(rasterio, crs)
    files = TileFiles(directory)
    column, row, columns, rows = files.limits(None)
    if not files.tiles:
        raise ValueError(f"{os.fspath(directory)}: the map has no tiles (expected at least one)")
    target = Path(path)
    if target.is_dir():
        raise IsADirectoryError(f"{target}: is a directory (expected a file)")
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    top = (row + rows) * files.cell
    try:
        with warnings.catch_warnings():
            # Poses without a coordinate reference system are not an error.
            warnings.simplefilter("ignore", rasterio.errors.NotGeoreferencedWarning)
            with rasterio.open(
                part,
                "w",
                driver="GTiff",
                width=columns,
                height=rows,
                count=len(_BANDS),
                dtype="float32",
                nodata=float("nan"),
                crs=system,
                transform=rasterio.Affine(files.cell, 0, column * files.cell, 0, -files.cell, top),
                tiled=True,
                blockxsize=files.tile_width,
                blockysize=files.tile_width,
                interleave="band",
                compress="deflate",
                predictor=3,
                SPARSE_OK=True,
                BIGTIFF="IF_SAFER",
            ) as file:
                for band, text in enumerate(_BANDS, start=1):
                    file.set_band_description(band, text)
                    file.update_tags(band, description=_BANDS[text])
                _write_tiles(rasterio, file, files, (column, row, columns, rows))
        part.replace(target)
    except rasterio.errors.RasterioIOError as error:
        raise OSError(f"{target}: cannot be written: {' '.join(str(error).split())}") from error
    finally:
        part.unlink(missing_ok=True)


def _write_tiles(rasterio: Any, file: Any, files: TileFiles, limits: tuple[int, int, int, int]) -> None:
    rows = limits[3]
    for cells, to_rows, to_columns in files.cells_in(*limits):
        known = np.isfinite(cells["height"])
        # The first row of the file has the largest y.
        window = rasterio.windows.Window(
            to_columns.start, rows - to_rows.stop, to_columns.stop - to_columns.start, to_rows.stop - to_rows.start
        )
        for band, name in enumerate(_BANDS, start=1):
            values = np.where(known, cells[name].astype(np.float32), np.float32(np.nan))
            file.write(values[::-1], band, window=window)


def system_of(rasterio: Any, crs: str | int | None) -> Any:
    """The coordinate reference system; None for None.

    Raises:
        ValueError: It is unknown.
    """
    if crs is None:
        return None
    try:
        return rasterio.crs.CRS.from_user_input(crs)
    except (rasterio.errors.CRSError, TypeError, ValueError) as error:
        raise ValueError(
            f"crs: {crs!r} is not a coordinate reference system (expected for example 'EPSG:25832')"
        ) from error
