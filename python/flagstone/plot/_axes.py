# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Axes of bird's-eye views, in metres: x points up, y points left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from flagstone._optional import needs
from flagstone._palette import PANEL, PANEL_TEXT, RANGE_RING, Color, rgb

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import LinearSegmentedColormap

_MAX_RINGS = 100


def birds_eye_axes(axes: Axes | None, range_: float, *, background: Color) -> Axes:
    """Sets up `axes`, or the axes of a new figure, to show |x|, |y| <= `range_` metres.

    Raises:
        ValueError: The range is not a finite number above 0.
    """
    if not (np.isfinite(range_) and range_ > 0):
        raise ValueError(f"range: {range_} is out of range (expected metres, above 0)")
    if axes is None:
        _, axes = needs("matplotlib.pyplot", extra="plot").subplots(figsize=(7, 7.4), layout="constrained")
    axes.set_aspect("equal")
    axes.set_xlim(range_, -range_)
    axes.set_ylim(-range_, range_)
    axes.set_xlabel("y, metres (left)")
    axes.set_ylabel("x, metres (forward)")
    axes.set_facecolor(rgb(background))
    return axes


def width_in_points(axes: Axes) -> float:
    """Width of the axes on paper, in points of 1/72 inch."""
    return 72 * axes.get_window_extent().width / axes.figure.dpi


def draw_rings(axes: Axes, range_: float) -> None:
    """Draws range rings. Their labels are on the diagonal, where a straight road has the fewest points."""
    patches, effects = needs("matplotlib.patches", extra="plot"), needs("matplotlib.patheffects", extra="plot")
    step = _ring_step(range_)
    for ring in range(1, min(int(1.42 * range_ / step), _MAX_RINGS) + 1):
        radius = ring * step
        axes.add_patch(
            patches.Circle(
                (0, 0), radius, fill=False, color=rgb(RANGE_RING), alpha=0.55, linewidth=0.6, linestyle=(0, (5, 5))
            )
        )
        along = radius / np.sqrt(2)
        if along < 0.93 * range_:
            axes.text(
                -along,
                along,
                f"{radius:g} m",
                color=rgb(PANEL_TEXT),
                fontsize=7,
                ha="center",
                va="center",
                zorder=5,
                path_effects=[effects.withStroke(linewidth=2, foreground=rgb(PANEL))],
            )


def draw_sensor(axes: Axes) -> None:
    """Draws an arrowhead at the sensor that points forward."""
    arrow = [(0, 0.9), (0.65, -0.75), (0, -0.42), (-0.65, -0.75), (0, 0.9)]
    axes.plot(
        [0],
        [0],
        marker=arrow,
        markersize=9,
        markerfacecolor="white",
        markeredgecolor=rgb(PANEL),
        markeredgewidth=0.8,
        linestyle="none",
        zorder=6,
    )


def color_map(stops: Sequence[tuple[float, Sequence[float]]]) -> LinearSegmentedColormap:
    """A colour map that interpolates between colours (red, green, blue, 0 to 1) at positions from 0 to 1."""
    colors = needs("matplotlib.colors", extra="plot")
    map_: LinearSegmentedColormap = colors.LinearSegmentedColormap.from_list("flagstone", list(stops))
    return map_


def add_color_bar(axes: Axes, map_: LinearSegmentedColormap, between: tuple[float, float], caption: str) -> None:
    """Adds a colour bar next to the axes, with their height, for values in the interval `between`."""
    cm, colors = needs("matplotlib.cm", extra="plot"), needs("matplotlib.colors", extra="plot")
    scale = cm.ScalarMappable(colors.Normalize(*between), map_)
    axes.figure.colorbar(scale, cax=axes.inset_axes((1.03, 0, 0.03, 1)), label=caption)


def _ring_step(range_: float) -> float:
    """Largest step of 1, 2 or 5 times a power of ten for which at least three rings fit."""
    largest = range_ / 3
    power = 10.0 ** np.floor(np.log10(largest))
    return float(next(factor * power for factor in (5, 2, 1) if factor * power <= largest))
