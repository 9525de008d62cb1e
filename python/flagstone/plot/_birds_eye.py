# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A scan from above."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._geometry import level_frame, outline, patch_bins
from flagstone._optional import needs
from flagstone._palette import LABELS, PANEL, TINT, VERDICTS, ZONE_LINE, Color, in_words, rgb
from flagstone._points import Column, PointsLike, columns_of
from flagstone.codes import Label, Verdict
from flagstone.plot._axes import add_color_bar, color_map, draw_rings, draw_sensor, view_from_above, width_in_points
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

_Floats = npt.NDArray[np.floating]

_HEIGHTS_ABOVE_GROUND = (-0.5, 3.5)  # metres
# From the lowest height to the highest: below the ground, on it, standing on it, high above it.
_HEIGHT_COLORS: tuple[tuple[float, Color], ...] = (
    (0, (214, 104, 158)),
    (0.125, (246, 201, 58)),
    (0.5, (58, 196, 226)),
    (1, (190, 170, 245)),
)
_UNKNOWN_HEIGHT: Color = (112, 121, 133)
_LEVELS = 64  # colours of heights


def birds_eye(
    points: PointsLike,
    result: Segmentation | npt.ArrayLike | None = None,
    *,
    axes: Axes | None = None,
    color: Literal["labels", "heights", "z"] | None = None,
    reference: npt.ArrayLike | None = None,
    range: float | None = None,
    patches: bool = False,
) -> Axes:
    """Draws a scan from above: x, forward, points up and y, left, points left.

    Points that have no place (a coordinate is not finite, or the label is `invalid`) are not drawn.

    Args:
        points: (N, >=3), as `Segmenter.segment` takes them, metres.
        result: What segmenting them gave; or what another program says of them: (N,) codes of `Label`, or a mask that
            is true for ground.
        axes: What to draw on; without it, a new figure.
        color: What colours mean. "labels": the label, yellow for ground; "heights": the height above the ground, of
            methods that know it; "z": the z of the points. Without it the labels, or z where there is no result.
        reference: (N,) mask, true for what really is ground. Colours then say where labels are right: true positives
            green, false positives red, false negatives blue. Whatever is not labelled ground counts as not ground. Of
            a masked array (`numpy.ma`), what is masked is not scored, and grey.
        range: Half the side of the picture, metres. Without it the distance that holds 98 % of the points, rounded up
            to 10 m.
        patches: Tint the bin of each patch by its verdict. Needs a method whose patches are squares (`surface`) or
            sectors of rings (`patchwork`).

    Returns:
        The axes: metres, y from right to left and x upward. Draw more on them with `axes.plot(y, x)`, save the figure
        with `axes.figure.savefig("scan.pdf")`.

    Raises:
        ImportError: Matplotlib is not installed.
        TypeError: These are no points.
        ValueError: The result or the reference does not belong to these points, or lacks what is to be drawn.
    """
    x, y, z = columns_of(points)
    labels = None if result is None else labels_of(result, len(x))
    placed = np.isfinite(x) & np.isfinite(y) & np.isfinite(z)
    if labels is not None:
        placed &= labels != Label.INVALID
    color = color or ("z" if labels is None else "labels")
    # Everything that can be wrong is found out before anything is drawn.
    kinds = _kinds(labels, reference, color)
    values = None if kinds is not None else _values(result, z, color)
    bins = _bins(result) if patches else []

    axes = view_from_above(axes, _suitable_range(x[placed], y[placed]) if range is None else range, background=PANEL)
    draw_rings(axes, axes.get_ylim()[1])
    legends: list[tuple[str, list[Artist]]] = []
    if patches and isinstance(result, Segmentation):
        legends.append(("Patches", _tint(axes, bins, result.patches["verdict"])))
    size = _marker_size(axes, int(placed.sum()))
    if kinds is not None:
        legends.insert(0, ("Points", _draw_kinds(axes, x, y, placed, kinds, size)))
    elif values is not None:
        _draw_values(axes, x[placed], y[placed], values[placed], color, size)
    draw_sensor(axes)
    _add_legends(axes, legends)
    return axes


def _kinds(labels: npt.NDArray[np.uint8] | None, reference: npt.ArrayLike | None, color: str) -> list[Kind] | None:
    """The kinds of points; None where colours are values."""
    if color not in ("labels", "heights", "z"):
        raise ValueError(f"color: {color!r}; allowed are 'labels', 'heights' and 'z'")
    if color != "labels":
        if reference is not None:
            raise ValueError(f"reference: colours compare labels with it, so color={color!r} cannot be had too")
        return None
    if labels is None:
        raise ValueError("result: there is none, and colours are to be labels; pass what segmenting these points gave")
    return by_label(labels) if reference is None else by_truth(labels, reference)


def _values(result: Segmentation | npt.ArrayLike | None, z: Column, color: str) -> _Floats:
    if color == "z":
        return z
    if not isinstance(result, Segmentation) or np.isnan(result.heights).all():
        raise ValueError("result: no heights in it, its method knows none; segment with flagstone.Surface")
    return result.heights


def _bins(result: Segmentation | npt.ArrayLike | None) -> list[npt.NDArray[np.float64]]:
    """The outline of each patch's bin, (K, 2) of y and x, in the frame of the scan."""
    bins = patch_bins(result) if isinstance(result, Segmentation) else []
    if not isinstance(result, Segmentation) or len(bins) != len(result.patches):
        raise ValueError("patches: their bins are not known; segment with flagstone.Surface or flagstone.Patchwork")
    frame = level_frame(result.mount)
    # Of a sensor that leans it matters how high a bin is drawn: where its ground is, if that is known.
    heights = frame.to_level(result.patches["mean"])[:, 2]
    heights[~result.patches["normal"].any(axis=1)] = -result.mount.sensor_height
    corners = [np.insert(outline(bin_), 2, z, axis=1) for bin_, z in zip(bins, heights, strict=True)]
    return [frame.to_scan(places)[:, 1::-1] for places in corners]


def _suitable_range(x: _Floats, y: _Floats) -> float:
    if not len(x):
        return 50
    return max(10.0, 10 * float(np.ceil(np.quantile(np.hypot(x, y), 0.98, method="higher") / 10)))


def _marker_size(axes: Axes, count: int) -> float:
    """Few points are drawn larger, or they could not be seen. Points of 1/72 inch."""
    sparse = (120_000 / max(count, 1)) ** 0.25
    return max(0.7, width_in_points(axes) / 720 * float(np.clip(sparse, 0.8, 5)))


def _draw(axes: Axes, x: _Floats, y: _Floats, color: Sequence[float], size: float) -> None:
    # Markers of one look are drawn far faster than a scatter plot of as many points.
    axes.plot(
        y,
        x,
        linestyle="none",
        marker="o",
        markersize=size,
        markeredgewidth=0,
        color=color,
        rasterized=True,
        zorder=3,
    )


def _draw_kinds(
    axes: Axes, x: _Floats, y: _Floats, placed: npt.NDArray[np.bool_], kinds: list[Kind], size: float
) -> list[Artist]:
    """Draws the points of each kind; returns the entries for the legend."""
    lines = needs("matplotlib.lines", extra="plot")
    entries: list[Artist] = []
    for kind in kinds:
        shown = kind.mask & placed
        _draw(axes, x[shown], y[shown], rgb(kind.color), kind.size * size)
        if count := int(kind.mask.sum()):
            label = f"{kind.name} {_percent(count, len(kind.mask))}"
            look = {"marker": "o", "markersize": 6, "markeredgewidth": 0, "color": rgb(kind.color)}
            entries.append(lines.Line2D([], [], linestyle="none", label=label, **look))
    return [*entries[1:], entries[0]] if kinds[0].mask.any() else entries  # what lies undermost comes last


def _draw_values(axes: Axes, x: _Floats, y: _Floats, values: _Floats, color: str, size: float) -> None:
    """Draws points coloured by a height, the highest on top, with a bar that says which colour is which."""
    between, caption = _HEIGHTS_ABOVE_GROUND, "height above the ground, metres"
    if color == "z":
        low, high = np.quantile(values, (0.02, 0.98)) if len(values) else (0, 1)
        between, caption = (float(low), float(max(high, low + 0.1))), "z, metres"
    map_ = color_map([(share, rgb(stop)) for share, stop in _HEIGHT_COLORS])
    known = np.isfinite(values)
    _draw(axes, x[~known], y[~known], rgb(_UNKNOWN_HEIGHT), size)
    share = (values[known] - between[0]) / (between[1] - between[0])
    level = np.clip(share * _LEVELS, 0, _LEVELS - 1).astype(int)
    x, y = x[known], y[known]
    for i in np.unique(level):
        _draw(axes, x[level == i], y[level == i], map_((i + 0.5) / _LEVELS), size)
    add_color_bar(axes, map_, between, caption)


def _tint(axes: Axes, bins: list[npt.NDArray[np.float64]], verdicts: npt.NDArray[np.uint16]) -> list[Artist]:
    """Fills bins with the colours of their verdicts; returns the entries for the legend."""
    collections, patches = needs("matplotlib.collections", extra="plot"), needs("matplotlib.patches", extra="plot")
    entries: list[Artist] = []
    for verdict in Verdict:
        chosen = [bin_ for bin_, given in zip(bins, verdicts, strict=True) if given == verdict]
        if not chosen:
            continue
        look = {"facecolor": (*rgb(VERDICTS[verdict]), TINT), "edgecolor": (*rgb(ZONE_LINE), 0.35)}
        axes.add_collection(collections.PolyCollection(chosen, linewidths=0.4, zorder=2, **look), autolim=False)
        label = f"{in_words(verdict)} {_percent(len(chosen), len(bins))}"
        on_panel = [
            (1 - TINT) * under + TINT * over for under, over in zip(rgb(PANEL), rgb(VERDICTS[verdict]), strict=True)
        ]
        entries.append(patches.Patch(facecolor=on_panel, edgecolor=rgb(VERDICTS[verdict]), label=label))
    return entries


def _add_legends(axes: Axes, legends: list[tuple[str, list[Artist]]]) -> None:
    """One below the other, under the axes and their labels."""
    transforms = needs("matplotlib.transforms", extra="plot")
    columns = int(np.clip(width_in_points(axes) / 90, 1, 5))
    below = 34  # points of 1/72 inch
    for title, entries in legends:
        down = transforms.ScaledTranslation(0, -below / 72, axes.figure.dpi_scale_trans)
        legend = axes.legend(
            handles=entries,
            loc="upper center",
            bbox_to_anchor=(0.5, 0),
            bbox_transform=axes.transAxes + down,
            borderaxespad=0,
            ncols=columns,
            frameon=False,
            fontsize=7.5,
            title=title if len(legends) > 1 else None,
            title_fontsize=8,
            handletextpad=0.3,
            columnspacing=1.2,
        )
        if title != legends[-1][0]:
            axes.add_artist(legend)  # or the next one would take its place
            legend.set_clip_on(False)  # so that it counts where figures are laid out
        below += 12 * (1 + -(-len(entries) // columns)) + 6


def _percent(part: int, whole: int) -> str:
    if 0 < part < 0.0005 * whole:
        return "<0.1 %"
    return f"{100 * part / max(whole, 1):.1f} %"


class Kind(NamedTuple):
    """Which points look so."""

    name: str
    color: Color
    mask: npt.NDArray[np.bool_]
    """(N,): true for its points."""
    size: float = 1
    """Diameter relative to that of ordinary points."""


def labels_of(result: Segmentation | npt.ArrayLike, points: int) -> npt.NDArray[np.uint8]:
    """(N,): codes of labels, from a result or from what another program says.

    Raises:
        ValueError: They are not as many as the points, or other codes.
    """
    labels = result.labels if isinstance(result, Segmentation) else np.asarray(result)
    if labels.shape != (points,):
        raise ValueError(
            f"result: labels of shape {labels.shape} for {points} points; pass what segmenting these points gave"
        )
    if labels.dtype.kind not in "bui" or not np.isin(labels, list(Label)).all():
        raise ValueError(f"result: {labels.dtype} that are no labels; wanted are codes of 0 to 4, or a mask of ground")
    return labels.astype(np.uint8)


def by_label(labels: npt.NDArray[np.uint8]) -> list[Kind]:
    """Kinds by label, in the order of drawing: what comes later lies on top."""
    order = (Label.OUT_OF_RANGE, Label.GROUND, Label.NONGROUND, Label.NOISE)
    sizes = {Label.NOISE: 1.3}
    return [Kind(in_words(label), LABELS[label], labels == label, sizes.get(label, 1)) for label in order]


def by_truth(labels: npt.NDArray[np.uint8], reference: npt.ArrayLike) -> list[Kind]:
    """Kinds by comparing labels and reference, in the order of drawing.

    Errors are larger, so that they show among many right points and without telling red from green.

    Raises:
        ValueError: The reference is no mask of as many points.
    """
    truth: np.ma.MaskedArray[Any, np.dtype[Any]] = np.ma.asarray(reference)
    if truth.shape != labels.shape or truth.dtype.kind != "b":
        raise ValueError(
            f"reference: {truth.dtype} of shape {truth.shape} for {len(labels)} points; wanted is a mask (N,), "
            "true for ground"
        )
    scored = ~np.ma.getmaskarray(truth)
    is_ground, said = np.ma.getdata(truth), labels == Label.GROUND
    return [
        Kind("not scored", (70, 77, 87), ~scored),
        Kind("true positive", (44, 166, 96), scored & is_ground & said),
        Kind("true negative", (140, 148, 158), scored & ~is_ground & ~said),
        Kind("false negative", (66, 140, 255), scored & is_ground & ~said, 1.5),
        Kind("false positive", (255, 72, 56), scored & ~is_ground & said, 1.5),
    ]
