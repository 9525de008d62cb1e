# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Outlines and triangles of patches and of the ground surface, for plots."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._relief import relief, suitable_look, suitable_range
from flagstone.ground_surface import GroundSurface
from flagstone.segmentation import Mount, Segmentation

Floats = npt.NDArray[np.float64]


class LevelFrame(NamedTuple):
    """Gravity-aligned frame in metres, origin at the sensor, z up. Bins and surface grids are defined in it."""

    axes: Floats
    """(3, 3): x, y and z axes as rows, unit length, in the frame of the scan."""
    origin: Floats
    """(3,): position of the sensor in the frame of the scan, metres."""
    scale: float
    """Metres per unit of the scan."""

    def to_scan(self, positions: npt.ArrayLike) -> Floats:
        """Transforms positions (..., 3) from this frame, in metres, to the frame and units of the scan."""
        scan: Floats = (np.asarray(positions, np.float64) @ self.axes + self.origin) / self.scale
        return scan

    def to_level(self, positions: npt.ArrayLike) -> Floats:
        """Transforms positions (..., 3) from the frame and units of the scan to this frame, in metres."""
        level: Floats = (np.asarray(positions, np.float64) * self.scale - self.origin) @ self.axes.T
        return level


def level_frame(mount: Mount) -> LevelFrame:
    """The level frame of a scan. The shortest rotation that maps `up` to z also turns x and y."""
    x, y, z = np.asarray(mount.up) / np.linalg.norm(mount.up)
    if z < -0.999999:
        axes = np.diag([1.0, -1.0, -1.0])
    else:
        shrink = 1 / (1 + z)
        axes = np.array(
            [[1 - x * x * shrink, -x * y * shrink, -x], [-x * y * shrink, 1 - y * y * shrink, -y], [x, y, z]]
        )
    return LevelFrame(axes, np.asarray(mount.origin, np.float64), mount.scale)


_ARC_STEP = np.radians(4)  # longest segment of an arc


def patch_bins(result: Segmentation, *, inset: float = 0) -> list[Floats]:
    """The bin of each patch, in the order of `result.patches`.

    Args:
        result: Result of a method whose patches are squares or ring sectors.
        inset: Distance in metres by which each bin is shrunk, so that a gap separates neighbours.

    Returns:
        One array (2, S, 2) of x and y per patch, in metres, in the level frame: S positions along the near edge and
        the S opposite positions along the far edge. The list is empty for methods with other patches.
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
    """(2 S, 2): the closed outline of a bin."""
    return np.concatenate([bin_[0], bin_[1][::-1]])


def _square(patch: Any, extent: float, inset: float) -> Floats:
    """Squares of 4 m, and of 8 m farther out. Rows and columns start at the corner with the smallest x and y."""
    side = 4.0 if patch["zone"] == 0 else 8.0
    x, y = patch["sector"] * side - extent, patch["ring"] * side - extent
    near, far = inset, side - inset
    return np.array([[[x + near, y + near], [x + near, y + far]], [[x + far, y + near], [x + far, y + far]]])


def _sector(patch: Any, settings: dict[str, Any], inset: float) -> Floats:
    """Eqs. (2) and (3) of the paper: rings by distance, sectors by angle, counter-clockwise."""
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
    count = 2 + int(width / _ARC_STEP)
    return np.stack([_arc(radius, begin, width, count, inset) for radius in (inner + inset, outer - inset)])


def _arc(radius: float, begin: float, width: float, count: int, inset: float) -> Floats:
    margin = min(inset / radius, width / 4) if radius > 0 else 0.0
    angles = np.linspace(begin + margin, begin + width - margin, count)
    arc: npt.NDArray[np.float64] = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return arc


_INSET = 0.06  # metres; leaves a dark line between neighbours
_MIN_REACH = 1.0  # metres above and below the mean that a quad always covers


def patch_quads(result: Segmentation) -> list[Floats]:
    """The bin of each patch, projected onto its plane. Steep planes are cut above and below their points.

    Returns:
        One array (T, 3, 3) per patch, in the order of `result.patches`: T triangles with three corners x, y, z in the
        frame and units of the scan. T is 0 for a patch without a plane, and for methods whose patches are neither
        squares nor ring sectors.
    """
    frame = level_frame(result.mount)
    bins = patch_bins(result, inset=_INSET)
    if not bins:
        return [np.empty((0, 3, 3))] * len(result.patches)
    return [_quad(patch, bin_, frame) for patch, bin_ in zip(result.patches, bins, strict=True)]


def _quad(patch: Any, bin_: Floats, frame: LevelFrame) -> Floats:
    normal = frame.axes @ patch["normal"].astype(np.float64)
    if not normal.any():
        return np.empty((0, 3, 3))
    mean = frame.to_level(patch["mean"])
    steepness = max(normal[2], 1e-3)
    heights = mean[2] - ((bin_ - mean[:2]) @ normal[:2]) / steepness
    near, far = np.concatenate([bin_, heights[..., None]], axis=-1)
    reach = max(_MIN_REACH, 2 * _max_std_along_z(patch["eigenvalues"], normal[2]))
    triangles: list[Floats] = []
    for i in range(len(near) - 1):
        cell = np.stack([near[i], far[i], far[i + 1], near[i + 1]])
        piece = _cut(_cut(cell, mean[2] - reach, above=True), mean[2] + reach, above=False)
        triangles += [piece[[0, k, k + 1]] for k in range(1, len(piece) - 1)]
    return frame.to_scan(np.array(triangles)) if triangles else np.empty((0, 3, 3))


def _max_std_along_z(eigenvalues: Floats, upright: float) -> float:
    """Upper bound of the standard deviation along z of the points in a plane, metres."""
    along, _, across = eigenvalues
    return float(np.sqrt(max(along * (1 - upright * upright) + across * upright * upright, 0)))


def _cut(corners: Floats, height: float, *, above: bool) -> Floats:
    """The part of a convex polygon (K, 3) above or below a height."""
    side = corners[:, 2] - height if above else height - corners[:, 2]
    if (side >= 0).all():
        return corners
    kept: list[Floats] = []
    for i in range(len(corners)):
        j = (i + 1) % len(corners)
        if side[i] >= 0:
            kept.append(corners[i])
        if (side[i] >= 0) != (side[j] >= 0):
            kept.append(corners[i] + side[i] / (side[i] - side[j]) * (corners[j] - corners[i]))
    return np.array(kept).reshape(-1, 3)


class Mesh(NamedTuple):
    """Triangle mesh with shared corners."""

    corners: npt.NDArray[np.float32]
    """(C, 3): x, y, z in the frame and units of the scan."""
    triangles: npt.NDArray[np.uint32]
    """(T, 3): indices into `corners`."""
    colors: npt.NDArray[np.uint8]
    """(C, 3): sRGB colour by height, shaded."""


def surface_mesh(result: Segmentation) -> Mesh:
    """Mesh of the known part of the surface, as fine as its grids; empty if there is no surface.

    The mesh lines pass through the centres of the cells and extend over the whole grid. The mesh therefore has no gaps
    or steps where grids meet.
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
    """Coordinates of the mesh lines: centres of the cells of each grid, outside the next finer grid."""
    lines = np.empty(0)
    for grid in reversed(ground.grids):  # finest first
        centres = (np.arange(len(grid.heights)) + 0.5) * grid.cell - grid.extent
        reach = lines[-1] + grid.cell / 2 if len(lines) else 0
        outside = centres[centres > reach]
        lines = np.concatenate([-outside[::-1], lines, outside])
    return lines
