# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Colours of the ground: by height, shaded with light from the front left."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone.ground_surface import GroundSurface

Floats = npt.NDArray[np.float64]

# Greens, yellows and browns, as in atlases. All are light, so that shading and lines are clearly visible.
TONES = np.array(
    [
        [0.53, 0.70, 0.61],
        [0.69, 0.81, 0.64],
        [0.89, 0.89, 0.68],
        [0.93, 0.82, 0.60],
        [0.83, 0.66, 0.49],
        [0.73, 0.55, 0.46],
    ]
)
_SHADOW = np.array([0.16, 0.17, 0.30])  # bluish, as under an open sky
_SUNLIGHT = np.array([1, 0.99, 0.93])
_DARKEST = 0.72  # fraction of shadow colour in full shade
_BRIGHTEST = 1.5  # fraction of sunlight colour per unit of brightness above that of level ground
_FAINTEST = 0.25  # opacity of ground with confidence 0

_SAMPLES = 200  # along a side
_MIN_SPAN = 1.0  # metres; prevents a level road from looking mountainous
_WELL_SHADED = 0.3  # slope in m/m that is shaded clearly
_MAX_EXAGGERATION = 5.0
_MAX_LINES = 14
_STEPS = ((0.25, 2), (0.5, 2), (1.0, 2), (2.0, 5), (5.0, 2), (10.0, 2), (20.0, 5), (50.0, 2), (100.0, 2))


class Look(NamedTuple):
    """Style in which a surface is drawn."""

    lowest: float
    """Height of the first colour, metres; lower ground has the same colour."""
    highest: float
    """Height of the last colour, metres; higher ground has the same colour."""
    step: float
    """Height difference between contour lines, metres."""
    per_index: int
    """Every N-th contour line is bold and labelled with its height."""
    exaggeration: float
    """Factor by which slopes are exaggerated for shading."""


def suitable_range(surface: GroundSurface) -> float:
    """Half the side of the square that contains 98 % of the ground, rounded up to 10 m, metres."""
    samples = _samples(surface, surface.extent)
    range_ = 10 * np.ceil(_quantile(samples.distance, samples.weight, 0.98, surface.extent) / 10)
    return float(min(max(range_, 1), surface.extent))


def suitable_look(surface: GroundSurface, range_: float) -> Look:
    """A style for the ground within `range_` metres: about ten contour lines, and shading that shows gentle slopes."""
    samples = _samples(surface, range_)
    return look_for(
        lowest=_quantile(samples.height, samples.weight, 0.02, -1),
        highest=_quantile(samples.height, samples.weight, 0.98, 1),
        steep=_quantile(samples.steepness, samples.weight, 0.85, 0),
    )


def look_for(lowest: float, highest: float, steep: float) -> Look:
    """A style for ground from `lowest` to `highest`, metres, with few slopes above `steep`, m/m."""
    step, per_index = next((s for s in _STEPS if highest - lowest <= _MAX_LINES * s[0]), _STEPS[-1])
    middle, half = (lowest + highest) / 2, max(highest - lowest, _MIN_SPAN) / 2
    return Look(
        lowest=float(step * np.floor((middle - half) / step)),
        highest=float(step * np.ceil((middle + half) / step)),
        step=step,
        per_index=per_index,
        exaggeration=float(np.clip(round(_WELL_SHADED / max(steep, 1e-3)), 1, _MAX_EXAGGERATION)),
    )


def relief(surface: GroundSurface, x: npt.ArrayLike, y: npt.ArrayLike, look: Look) -> Floats:
    """The colour of the ground at positions of shape S: (*S, 4), red, green, blue and opacity, 0 to 1.

    The colour is paler where the confidence is lower, and transparent where the ground is unknown.
    """
    x, y = np.broadcast_arrays(np.asarray(x, np.float32), np.asarray(y, np.float32))
    ground = surface.at(x, y)
    height = ground.height.astype(np.float64)
    cell = surface.resolution(x, y)
    along_x = _slope(surface.height(x - cell, y), height, surface.height(x + cell, y), cell)
    along_y = _slope(surface.height(x, y - cell), height, surface.height(x, y + cell), cell)
    color = shaded(height, look, rise_up=along_x, rise_left=along_y)
    confidence = np.clip(ground.confidence, 0, 1)
    opacity = np.where(np.isnan(height), 0, _FAINTEST + (1 - _FAINTEST) * np.sqrt(confidence))
    return np.concatenate([color, opacity[..., None]], axis=-1)


def tones(fraction: npt.ArrayLike) -> Floats:
    """Colours (*S, 3) of heights of shape S, from 0 (lowest) to 1 (highest); NaN has the lowest colour."""
    position = np.nan_to_num(np.clip(fraction, 0, 1)) * (len(TONES) - 1)
    stops = np.arange(len(TONES))
    return np.stack([np.interp(position, stops, TONES[:, part]) for part in range(3)], axis=-1)


def shaded(height: Floats, look: Look, *, rise_up: Floats, rise_left: Floats) -> Floats:
    """The colour (*S, 3) of ground of shape S, 0 to 1, with light from the upper left, 45 degrees high.

    Args:
        height: S, metres; NaN has the lowest colour.
        look: Style of the ground.
        rise_up: S, slope towards the upper edge of the image, m/m.
        rise_left: S, slope towards the left edge of the image, m/m.
    """
    color = tones((height - look.lowest) / (look.highest - look.lowest))
    up, left = look.exaggeration * rise_up, look.exaggeration * rise_left
    bright = ((1 - (up + left) / np.sqrt(2)) / np.sqrt(1 + up**2 + left**2))[..., None]  # level ground: 1
    dark = _DARKEST * (1 - np.clip(bright, 0, 1))
    light = np.clip(_BRIGHTEST * (bright - 1), 0, 1)
    lit: Floats = np.where(bright < 1, color + dark * (_SHADOW - color), color + light * (_SUNLIGHT - color))
    return lit


def _slope(before: npt.ArrayLike, here: Floats, after: npt.ArrayLike, cell: npt.ArrayLike) -> Floats:
    """Central difference of the heights one cell to either side; one-sided at the edge of the known ground."""
    before, after = np.asarray(before, np.float64), np.asarray(after, np.float64)
    sides = 2.0 - np.isnan(before) - np.isnan(after)
    before, after = np.where(np.isnan(before), here, before), np.where(np.isnan(after), here, after)
    slope: Floats = np.nan_to_num((after - before) / (np.maximum(sides, 1) * cell))
    return slope


class _Samples(NamedTuple):
    distance: Floats  # from the sensor, the larger of |x| and |y|, metres
    height: Floats
    steepness: Floats  # m/m
    weight: Floats  # by confidence


def _samples(surface: GroundSurface, range_: float) -> _Samples:
    line = range_ * ((2 * np.arange(_SAMPLES) + 1) / _SAMPLES - 1)
    x, y = np.meshgrid(line, line)
    ground = surface.at(x, y)
    known = np.isfinite(ground.height) & np.isfinite(ground.slope)
    return _Samples(
        distance=np.maximum(np.abs(x), np.abs(y))[known],
        height=ground.height[known].astype(np.float64),
        steepness=np.tan(ground.slope[known].astype(np.float64)),
        weight=1e-3 + ground.confidence[known].astype(np.float64),
    )


def _quantile(values: Floats, weights: Floats, fraction: float, none: float) -> float:
    """Weighted quantile: the smallest value with `fraction` of the weight at or below it; `none` without values."""
    if not len(values):
        return none
    order = np.argsort(values)
    sums = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(sums, fraction * sums[-1])])
