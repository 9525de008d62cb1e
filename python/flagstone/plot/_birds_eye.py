# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Bird's-eye view of a scan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._geometry import level_frame, outline, patch_bins
from flagstone._optional import needs
from flagstone._palette import LABELS, PANEL, TINT, VERDICTS, ZONE_LINE, Color, in_words, rgb
from flagstone._points import Column, PointsLike, columns_of
from flagstone.codes import Label, Verdict
from flagstone.plot._axes import add_color_bar, birds_eye_axes, color_map, draw_rings, draw_sensor, width_in_points
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

_Floats = npt.NDArray[np.floating]

_HEIGHTS_ABOVE_GROUND = (-0.5, 3.5)  # metres
# From the lowest height to the highest: below the ground, ground, objects on the ground, high above the ground.
_HEIGHT_COLORS: tuple[tuple[float, Color], ...] = (
    (0, (214, 104, 158)),
    (0.125, (246, 201, 58)),
    (0.5, (58, 196, 226)),
    (1, (190, 170, 245)),
)
_UNKNOWN_HEIGHT: Color = (112, 121, 133)
_LEVELS = 64  # number of colours for heights


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
    """Draws a scan in bird's-eye view: x (forward) points up, y (left) points left.

    Points without a position (a coordinate is not finite, or the label is `invalid`) are not drawn.

    Args:
        points: (N, >=3) in metres, as `Segmenter.segment` accepts them.
        result: Result of segmenting these points. Or the output of another program: (N,) codes of `Label`, or a mask
            that is true for ground.
        axes: Axes to draw on; by default the axes of a new figure.
        color: "labels" colours points by label, "heights" by height above the ground, "z" by z. The default is
            "labels", or "z" if there is no result. "heights" requires a method that computes heights, such as
            `surface`.
        reference: (N,) ground-truth mask, true for ground. Colours then show correct and wrong labels: true positives
            are green, false positives red, false negatives blue. Every label except ground counts as not ground.
            Masked elements of a masked array (`numpy.ma`) are not scored and are grey.
        range: Half the side of the plot, metres. By default the distance within which 98 % of the points lie, rounded
            up to 10 m.
        patches: Tint each patch by its status (see `Verdict`). Requires a method whose patches are squares (`surface`)
            or ring sectors (`patchwork`).

    Returns:
        The axes, in metres: y increases to the left, x upward. Add to the plot with `axes.plot(y, x)`, save it with
        `axes.figure.savefig("scan.pdf")`.

    Raises:
        ImportError: Matplotlib is not installed.
        TypeError: The points are not floats in CPU memory.
        ValueError: The result or the reference does not match the points, or lacks the data to draw.
    """
    x, y, z = columns_of(points)
    labels = None if result is None else labels_of(result, len(x))
    placed = np.isfinite(x) & np.isfinite(y) & np.isfinite(z)
    if labels is not None:
        placed &= labels != Label.INVALID
    color = color or ("z" if labels is None else "labels")
    # All arguments are checked before anything is drawn.
    kinds = _kinds(labels, reference, color)
    values = None if kinds is not None else _values(result, z, color)
    bins = _bins(result) if patches else []

    axes = birds_eye_axes(axes, _suitable_range(x[placed], y[placed]) if range is None else range, background=PANEL)
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
    """The kinds of points, or None if colours show values."""
    if color not in ("labels", "heights", "z"):
        raise ValueError(f"color: {color!r} is not a colouring (expected 'labels', 'heights' or 'z')")
    if color != "labels":
        if reference is not None:
            raise ValueError(
                f"reference: cannot be combined with color={color!r} (with a reference, colours show correct and wrong "
                "labels)"
            )
        return None
    if labels is None:
        raise ValueError("result: missing, but color='labels' needs it (pass the result of segmenting these points)")
    return by_label(labels) if reference is None else by_truth(labels, reference)


def _values(result: Segmentation | npt.ArrayLike | None, z: Column, color: str) -> _Floats:
    if color == "z":
        return z
    if not isinstance(result, Segmentation) or np.isnan(result.heights).all():
        raise ValueError("result: contains no heights (segment with flagstone.Surface)")
    return result.heights


def _bins(result: Segmentation | npt.ArrayLike | None) -> list[npt.NDArray[np.float64]]:
    """Outline of the bin of each patch, (K, 2) of y and x, in the frame of the scan."""
    bins = patch_bins(result) if isinstance(result, Segmentation) else []
    if not isinstance(result, Segmentation) or len(bins) != len(result.patches):
        raise ValueError("patches: their outlines are unknown (segment with flagstone.Surface or flagstone.Patchwork)")
    frame = level_frame(result.mount)
    # For a tilted sensor, the position in the plot depends on z: bins are drawn at the height of their ground.
    heights = frame.to_level(result.patches["mean"])[:, 2]
    heights[~result.patches["normal"].any(axis=1)] = -result.mount.sensor_height
    corners = [np.insert(outline(bin_), 2, z, axis=1) for bin_, z in zip(bins, heights, strict=True)]
    return [frame.to_scan(positions)[:, 1::-1] for positions in corners]


def _suitable_range(x: _Floats, y: _Floats) -> float:
    if not len(x):
        return 50
    return max(10.0, 10 * float(np.ceil(np.quantile(np.hypot(x, y), 0.98, method="higher") / 10)))


def _marker_size(axes: Axes, count: int) -> float:
    """Diameter of a point, in points of 1/72 inch; larger for sparse scans, so that points stay visible."""
    sparse = (120_000 / max(count, 1)) ** 0.25
    return max(0.7, width_in_points(axes) / 720 * float(np.clip(sparse, 0.8, 5)))


def _draw(axes: Axes, x: _Floats, y: _Floats, color: Sequence[float], size: float) -> None:
    # `plot` draws identical markers much faster than `scatter`.
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
    """Draws the points of each kind and returns the legend entries."""
    lines = needs("matplotlib.lines", extra="plot")
    entries: list[Artist] = []
    for kind in kinds:
        shown = kind.mask & placed
        _draw(axes, x[shown], y[shown], rgb(kind.color), kind.size * size)
        if count := int(kind.mask.sum()):
            label = f"{kind.name} {_percent(count, len(kind.mask))}"
            look = {"marker": "o", "markersize": 6, "markeredgewidth": 0, "color": rgb(kind.color)}
            entries.append(lines.Line2D([], [], linestyle="none", label=label, **look))
    return [*entries[1:], entries[0]] if kinds[0].mask.any() else entries  # the kind drawn first is listed last


def _draw_values(axes: Axes, x: _Floats, y: _Floats, values: _Floats, color: str, size: float) -> None:
    """Draws points coloured by height, the highest on top, and a colour bar."""
    between, caption = _HEIGHTS_ABOVE_GROUND, "height above the ground, metres"
    if color == "z":
        low, high = np.quantile(values, (0.02, 0.98)) if len(values) else (0, 1)
        between, caption = (float(low), float(max(high, low + 0.1))), "z, metres"
    map_ = color_map([(position, rgb(stop)) for position, stop in _HEIGHT_COLORS])
    known = np.isfinite(values)
    _draw(axes, x[~known], y[~known], rgb(_UNKNOWN_HEIGHT), size)
    fraction = (values[known] - between[0]) / (between[1] - between[0])
    level = np.clip(fraction * _LEVELS, 0, _LEVELS - 1).astype(int)
    x, y = x[known], y[known]
    for i in np.unique(level):
        _draw(axes, x[level == i], y[level == i], map_((i + 0.5) / _LEVELS), size)
    add_color_bar(axes, map_, between, caption)


def _tint(axes: Axes, bins: list[npt.NDArray[np.float64]], verdicts: npt.NDArray[np.uint16]) -> list[Artist]:
    """Fills bins with the colours of their status and returns the legend entries."""
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
    """Places the legends one below the other, under the axes and their labels."""
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
            axes.add_artist(legend)  # otherwise the next legend replaces it
            legend.set_clip_on(False)  # so that the layout of the figure includes it
        below += 12 * (1 + -(-len(entries) // columns)) + 6


def _percent(part: int, whole: int) -> str:
    if 0 < part < 0.0005 * whole:
        return "<0.1 %"
    return f"{100 * part / max(whole, 1):.1f} %"


class Kind(NamedTuple):
    """Points that are drawn in the same style."""

    name: str
    color: Color
    mask: npt.NDArray[np.bool_]
    """(N,): true for the points of this kind."""
    size: float = 1
    """Diameter relative to ordinary points."""


def labels_of(result: Segmentation | npt.ArrayLike, points: int) -> npt.NDArray[np.uint8]:
    """(N,): label codes of a result, or those from another program.

    Raises:
        ValueError: The number of labels differs from the number of points, or a code is invalid.
    """
    labels = result.labels if isinstance(result, Segmentation) else np.asarray(result)
    if labels.shape != (points,):
        raise ValueError(
            f"result: labels of shape {labels.shape} do not match {points} points (pass the result of segmenting these "
            "points)"
        )
    if labels.dtype.kind not in "bui" or not np.isin(labels, list(Label)).all():
        raise ValueError(f"result: {labels.dtype} values are not labels (expected codes 0 to 4, or a ground mask)")
    return labels.astype(np.uint8)


def by_label(labels: npt.NDArray[np.uint8]) -> list[Kind]:
    """Kinds by label, in drawing order: later kinds are on top."""
    order = (Label.OUT_OF_RANGE, Label.GROUND, Label.NONGROUND, Label.NOISE)
    sizes = {Label.NOISE: 1.3}
    return [Kind(in_words(label), LABELS[label], labels == label, sizes.get(label, 1)) for label in order]


def by_truth(labels: npt.NDArray[np.uint8], reference: npt.ArrayLike) -> list[Kind]:
    """Kinds by comparison of labels with ground truth, in drawing order.

    Errors are drawn larger, so that they are visible among many correct points, also to colour-blind readers.

    Raises:
        ValueError: The reference is not a mask with one element per point.
    """
    truth: np.ma.MaskedArray[Any, np.dtype[Any]] = np.ma.asarray(reference)
    if truth.shape != labels.shape or truth.dtype.kind != "b":
        raise ValueError(
            f"reference: {truth.dtype} array of shape {truth.shape} does not match {len(labels)} points (expected a "
            "bool mask (N,), true for ground)"
        )
    scored = ~np.ma.getmaskarray(truth)
    is_ground, labelled = np.ma.getdata(truth), labels == Label.GROUND
    return [
        Kind("not scored", (70, 77, 87), ~scored),
        Kind("true positive", (44, 166, 96), scored & is_ground & labelled),
        Kind("true negative", (140, 148, 158), scored & ~is_ground & ~labelled),
        Kind("false negative", (66, 140, 255), scored & is_ground & ~labelled, 1.5),
        Kind("false positive", (255, 72, 56), scored & ~is_ground & labelled, 1.5),
    ]
