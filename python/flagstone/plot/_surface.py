# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Relief map of the ground surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from flagstone._palette import CONTOUR, rgb
from flagstone._relief import TONES, Look, relief, suitable_look, suitable_range
from flagstone.ground_surface import GroundSurface
from flagstone.plot._axes import add_color_bar, birds_eye_axes, color_map, draw_sensor
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PIXELS = 800  # along a side
_SAMPLES = 400  # along a side, for contour lines


def surface(result: Segmentation, *, axes: Axes | None = None, range: float | None = None) -> Axes:
    """Draws a relief map of the ground surface: coloured by height, shaded, with contour lines.

    Colours are paler where the confidence is lower. Unknown ground is blank. The light comes from the front left.

    Args:
        result: Result of a method that computes a surface.
        axes: Axes to draw on; by default the axes of a new figure.
        range: Half the side of the plot, metres. By default the plot contains 98 % of the ground.

    Returns:
        The axes, in metres, in the level frame of `Mount`: y increases to the left, x upward.

    Raises:
        ImportError: Matplotlib is not installed.
        ValueError: The result contains no surface, or the range is invalid.
    """
    ground = result.surface
    if not ground:
        raise ValueError("result: contains no surface (segment with flagstone.Surface)")
    shown = suitable_range(ground) if range is None else range
    axes = birds_eye_axes(axes, shown, background=(255, 255, 255))
    look = suitable_look(ground, shown)
    x, y = _lines(shown, _PIXELS)
    image = relief(ground, x, y, look)
    axes.imshow(image, extent=(shown, -shown, -shown, shown), origin="upper", interpolation="bilinear", zorder=1)
    _draw_contours(axes, ground, shown, look)
    tones = [(float(position), tone) for position, tone in zip(np.linspace(0, 1, len(TONES)), TONES, strict=True)]
    add_color_bar(axes, color_map(tones), (look.lowest, look.highest), "z of the ground, metres")
    draw_sensor(axes)
    return axes


def _lines(range_: float, count: int) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Centres of the pixels: x as a column, farthest ahead first, and y as a row, leftmost first."""
    line = (range_ * (1 - (2 * np.arange(count) + 1) / count)).astype(np.float32)
    return line[:, None], line[None, :]


def _draw_contours(axes: Axes, ground: GroundSurface, range_: float, look: Look) -> None:
    x, y = _lines(range_, _SAMPLES)
    half = ground.resolution(x, y) / 2
    # The mean of four positions half a cell away, otherwise the contour lines would follow the cells.
    heights = np.mean([ground.height(x + i * half, y + j * half) for i in (-1, 1) for j in (-1, 1)], axis=0)
    span = look.highest - look.lowest  # limits the number of lines
    numbers = np.arange(np.ceil((look.lowest - span) / look.step), np.floor((look.highest + span) / look.step) + 1)
    if not np.isfinite(heights).any():
        return
    for bold in (False, True):
        lines = axes.contour(
            y.ravel(),
            x.ravel(),
            np.ma.masked_invalid(heights),
            levels=look.step * numbers[(numbers % look.per_index == 0) == bold],
            colors=[rgb(CONTOUR)],
            linewidths=1.0 if bold else 0.5,
            linestyles="solid",
            alpha=0.8,
            zorder=2,
        )
        if bold:
            axes.clabel(lines, fontsize=7, fmt="%.1f" if look.step < 1 else "%.0f")
