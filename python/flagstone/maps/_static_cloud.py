# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Writes the static points of a mapped run in other formats, such as LAS."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from flagstone import io
from flagstone._points import columns_of
from flagstone.maps._tiles import PathLike


def write_static_cloud(directory: PathLike, path: PathLike) -> None:
    """Writes the static points of a run to another file, atomically.

    In LAS and LAZ files, coordinates are rounded to millimetres, `classification` is 2 for ground and 1 otherwise, and
    heights above the ground are extra bytes `height`. The file has no coordinate system.

    Args:
        directory: Output directory of `flagstone map`.
        path: File to write. The extension selects the format, as for `flagstone.io.write`: .las, .laz, .pcd, .ply or
            .npy.

    Raises:
        FileNotFoundError: The directory has no `static.ply`: the run was mapped without this cloud, or is not finished.
        ImportError: laspy, which LAS and LAZ need, is not installed: pip install 'flagstone[las]'.
        OSError: The file cannot be written.
        ValueError: `static.ply` is damaged, or the format cannot store the points.
    """
    file = Path(directory) / "static.ply"
    if not file.is_file():
        raise FileNotFoundError(
            f"{file}: file does not exist (expected the output of flagstone map with a voxel size above 0)"
        )
    cloud = io.read(file)
    missing = [name for name in ("height", "label") if name not in (cloud.dtype.names or ())]
    if missing:
        raise ValueError(f"{file}: no property {missing[0]} (expected the output of flagstone map)")
    x, y, z = columns_of(cloud)
    points = np.empty(len(cloud), [(axis, np.float64) for axis in "xyz"])
    points["x"], points["y"], points["z"] = x, y, z
    io.write(path, points, labels=cloud["label"], heights=cloud["height"])
