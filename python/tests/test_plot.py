# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Plots on Matplotlib axes: contents, positions and colours."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Scan

import flagstone
from flagstone._palette import LABELS, VERDICTS, rgb
from flagstone.plot import birds_eye, surface

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
matplotlib.use("Agg")
plt = pytest.importorskip("matplotlib.pyplot")

LEGEND = {"ground": "ground", "non-ground": "nonground"}
GREEN, RED, BLUE = (44, 166, 96), (255, 72, 56), (66, 140, 255)


@pytest.fixture(autouse=True)
def closed_figures() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def result(scan: Scan) -> flagstone.Segmentation:
    return flagstone.Surface().segment(scan)


def places_by_color(axes: Any) -> dict[tuple[float, float, float], Any]:
    """x and y (N, 2) of the drawn points, by colour."""
    drawn: dict[tuple[float, float, float], Any] = {}
    for line in axes.get_lines():
        if line.get_rasterized():
            places = np.stack([line.get_ydata(), line.get_xdata()], axis=1)
            drawn[tuple(matplotlib.colors.to_rgb(line.get_color()))] = places
    return drawn


def legend_texts(axes: Any) -> list[str]:
    legends = axes.figure.findobj(matplotlib.legend.Legend)
    return [text.get_text() for legend in legends for text in legend.get_texts()]


def pixels(axes: Any) -> Any:
    """(H, W, 3), 0 to 255: the pixels of the axes in the rendered figure."""
    axes.figure.canvas.draw()
    whole = np.asarray(axes.figure.canvas.buffer_rgba())[..., :3]
    box = axes.get_window_extent()
    top, bottom = (len(whole) - int(y) for y in (box.y1, box.y0))
    return whole[top:bottom, int(box.x0) : int(box.x1)]


def test_x_points_up_and_y_points_left() -> None:
    ahead_and_left = np.array([[15.0, 5.0, -1.7]])
    picture = pixels(birds_eye(ahead_and_left, [1], range=20))
    yellow = np.abs(picture.astype(int) - LABELS[flagstone.Label.GROUND]).sum(axis=2) < 60
    row, column = np.argwhere(yellow).mean(axis=0) / len(picture)
    assert row == pytest.approx((20 - 15) / 40, abs=0.02)
    assert column == pytest.approx((20 - 5) / 40, abs=0.02)


def test_axes_are_in_metres_with_equal_scales(scan: Scan, result: flagstone.Segmentation) -> None:
    axes = birds_eye(scan, result, range=30)
    assert axes.get_xlim() == (30, -30)
    assert axes.get_ylim() == (-30, 30)
    assert axes.get_aspect() == 1


def test_the_default_range_shows_98_percent_of_the_points(scan: Scan, result: flagstone.Segmentation) -> None:
    far = birds_eye(scan, result).get_ylim()[1]
    assert far % 10 == 0
    assert (np.hypot(scan[:, 0], scan[:, 1]) <= far).mean() >= 0.98


def test_each_point_has_the_colour_of_its_label(scan: Scan, result: flagstone.Segmentation) -> None:
    drawn = places_by_color(birds_eye(scan, result))
    for label in (flagstone.Label.GROUND, flagstone.Label.NONGROUND, flagstone.Label.NOISE):
        np.testing.assert_array_equal(drawn[rgb(LABELS[label])], scan[result.labels == label, :2])


def test_the_legend_lists_labels_with_percentages(scan: Scan, result: flagstone.Segmentation) -> None:
    counts = result.counts
    expected = [f"{name} {100 * counts[label] / len(scan):.1f} %" for name, label in LEGEND.items()]
    assert legend_texts(birds_eye(scan, result))[:2] == expected


def test_a_mask_of_another_program_can_be_drawn(scan: Scan) -> None:
    mask = scan[:, 2] < -1.5
    drawn = places_by_color(birds_eye(scan, mask))
    np.testing.assert_array_equal(drawn[rgb(LABELS[flagstone.Label.GROUND])], scan[mask, :2])


def test_a_reference_colours_correct_and_wrong_labels() -> None:
    points = np.array([[1.0, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0], [5, 0, 0]])
    truth = np.ma.array([True, False, True, False, True], mask=[False] * 4 + [True])
    drawn = places_by_color(birds_eye(points, [1, 1, 0, 2, 1], reference=truth))
    x_of = {color: places[:, 0].tolist() for color, places in drawn.items()}
    assert x_of[rgb(GREEN)] == [1], "true positive"
    assert x_of[rgb(RED)] == [2], "false positive"
    assert x_of[rgb(BLUE)] == [3], "false negative"
    assert x_of[rgb((140, 148, 158))] == [4], "true negative: noise counts as not ground"
    assert x_of[rgb((70, 77, 87))] == [5], "not scored"


def test_heights_above_ground_are_yellow_to_cyan(scan: Scan, result: flagstone.Segmentation) -> None:
    axes = birds_eye(scan, result, color="heights")
    drawn = places_by_color(axes)
    assert sum(map(len, drawn.values())) == (result.labels != flagstone.Label.INVALID).sum()
    most = max(drawn, key=lambda color: len(drawn[color]))
    np.testing.assert_allclose(most, rgb(LABELS[flagstone.Label.GROUND]), atol=0.05)
    assert "height above the ground" in axes.child_axes[0].get_ylabel()


def test_points_without_a_position_are_omitted() -> None:
    points = np.array([[5.0, 1, 0], [np.nan, 1, 0], [6, np.inf, 0], [7, 1, -np.inf], [0, 0, 0]], np.float32)
    result = flagstone.Surface().segment(points)
    for color in ("labels", "z"):
        drawn = places_by_color(birds_eye(points, result, color=color))
        assert np.concatenate(list(drawn.values())).tolist() == [[5, 1]]


@pytest.mark.parametrize("color", ["labels", "z"])
def test_an_empty_scan_gives_an_empty_plot(color: Any) -> None:
    empty = np.empty((0, 3), np.float32)
    axes = birds_eye(empty, flagstone.Surface().segment(empty), color=color)
    assert not np.concatenate([*places_by_color(axes).values(), np.empty((0, 2))]).size
    axes.figure.canvas.draw()


@pytest.mark.parametrize("method", ["surface", "patchwork"])
def test_patches_are_tinted_by_status(scan: Scan, method: str) -> None:
    result = flagstone.make_segmenter(method).segment(scan)
    axes = birds_eye(scan, result, patches=True)
    tinted = {
        tuple(collection.get_facecolor()[0][:3]): len(collection.get_paths())
        for collection in axes.collections
        if isinstance(collection, matplotlib.collections.PolyCollection)
    }
    verdicts, counts = np.unique(result.patches["verdict"], return_counts=True)
    assert tinted == {rgb(VERDICTS[v]): n for v, n in zip(map(flagstone.Verdict, verdicts), counts, strict=True)}


@pytest.mark.parametrize("method", ["surface", "patchwork", "r_gpf"])
@pytest.mark.parametrize("tilt", [None, (0.2, -0.1, 1.0)])
def test_patches_are_drawn_around_their_points(scan: Scan, method: str, tilt: Any) -> None:
    ahead_and_left = scan[(scan[:, 1] > 0) & (scan[:, 1] < scan[:, 0] / 2)]
    result = flagstone.make_segmenter(method, tilt=tilt).segment(ahead_and_left)
    axes = birds_eye(ahead_and_left, result, patches=True)
    outlines = [path for collection in axes.collections for path in collection.get_paths()]
    with_plane = result.patches[result.patches["normal"].any(axis=1)]
    assert len(with_plane) > 10
    for patch in with_plane:
        x, y, _ = patch["mean"]
        assert any(path.contains_point((y, x)) for path in outlines), f"no bin around {patch}"


def test_the_known_part_of_the_surface_is_drawn(scan: Scan, result: flagstone.Segmentation) -> None:
    axes = surface(result, range=60)
    opacity = np.asarray(axes.get_images()[0].get_array())[..., 3]
    line = 60 * (1 - (2 * np.arange(len(opacity)) + 1) / len(opacity))
    known = np.isfinite(result.surface.height(line[:, None], line[None, :]))
    np.testing.assert_array_equal(opacity > 0, known)
    assert known.any()
    assert not known.all()


def test_surface_has_contour_lines_where_the_ground_rises() -> None:
    random = np.random.default_rng(1)
    xy = random.uniform(-30, 30, (20_000, 2))
    slope = np.column_stack([xy, 0.1 * xy[:, 0] - 1.73]).astype(np.float32)
    axes = surface(flagstone.Surface().segment(slope), range=20)
    contours = [c for c in axes.collections if isinstance(c, matplotlib.contour.ContourSet)]
    levels = np.concatenate([c.levels for c in contours])
    for level in (-2.5, -1.0):
        lines = next(c for c in contours if level in c.levels)
        line = lines.get_paths()[list(lines.levels).index(level)].vertices
        assert line[:, 1] == pytest.approx((level + 1.73) / 0.1, abs=0.5), "x of the line"
    assert len(set(levels)) == len(levels)


def test_plots_use_the_given_axes(scan: Scan, result: flagstone.Segmentation) -> None:
    _, (left, right) = plt.subplots(1, 2)
    assert birds_eye(scan, result, axes=left) is left
    assert surface(result, axes=right) is right


def test_points_are_raster_graphics_in_a_pdf(scan: Scan, result: flagstone.Segmentation, tmp_path: Path) -> None:
    birds_eye(scan, result)
    plt.savefig(tmp_path / "scan.pdf")
    document = (tmp_path / "scan.pdf").read_bytes()
    assert b"/Subtype /Image" in document
    assert len(document) < 2_000_000


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"result": [0, 1]}, r"result: labels of shape \(2,\) do not match 3 points"),
        ({"result": [0, 1, 7]}, "expected codes 0 to 4"),
        ({"result": [0.0, 1.0, 1.0]}, "expected codes 0 to 4"),
        ({"color": "labels"}, "result: missing, but color='labels' needs it"),
        ({"color": "rainbow"}, "expected 'labels', 'heights' or 'z'"),
        ({"result": [0, 1, 1], "color": "heights"}, "segment with flagstone.Surface"),
        ({"result": [0, 1, 1], "reference": [True]}, r"reference: bool array of shape \(1,\) does not match 3 points"),
        ({"result": [0, 1, 1], "reference": [40, 40, 1]}, "expected a bool mask"),
        ({"result": [0, 1, 1], "reference": [True] * 3, "color": "z"}, "reference: cannot be combined with color='z'"),
        ({"result": [0, 1, 1], "patches": True}, "patches: their outlines are unknown"),
        ({"range": 0}, r"range: 0 is out of range \(expected metres, above 0\)"),
        ({"range": float("nan")}, "range: nan"),
    ],
)
def test_invalid_arguments_raise_one_line_errors(arguments: dict[str, Any], message: str) -> None:
    points = np.array([[1.0, 0, 0], [2, 0, 0], [3, 0, 0]])
    with pytest.raises(ValueError, match=message) as error:
        birds_eye(points, **arguments)
    assert "\n" not in str(error.value)
    assert not plt.get_fignums() or "range" in arguments, "no empty figure is left behind"


def test_a_result_without_a_surface_is_an_error(scan: Scan) -> None:
    with pytest.raises(ValueError, match="contains no surface"):
        surface(flagstone.Patchwork().segment(scan))


def test_without_matplotlib_the_error_names_the_extra(scan: Scan, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("matplotlib", "matplotlib.pyplot"):
        monkeypatch.setitem(__import__("sys").modules, name, None)
    with pytest.raises(ImportError, match=r"pip install 'flagstone\[plot\]'"):
        birds_eye(scan)
