# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Results of `segment`: views that stay valid, patches, surface, counts."""

from __future__ import annotations

import copy
import gc
import multiprocessing
import pickle
from collections.abc import Callable

import numpy as np
import pytest
from conftest import Scan, random_scan

import flagstone
from flagstone import Label, Verdict


def test_every_point_has_one_label_and_the_counts_add_up(scan: Scan) -> None:
    result = flagstone.Surface().segment(scan)
    assert result.labels.shape == result.ground.shape == result.heights.shape == (len(scan),)
    assert (result.labels.dtype, result.ground.dtype, result.heights.dtype) == (np.uint8, np.bool_, np.float32)
    assert np.array_equal(result.ground, result.labels == Label.GROUND)
    assert result.counts == {label.name.lower(): int((result.labels == label).sum()) for label in Label}
    assert sum(result.counts.values()) == len(result) == len(scan)


def test_arrays_are_read_only_views_of_the_same_memory(scan: Scan) -> None:
    result = flagstone.Surface().segment(scan)
    for name in ("labels", "ground", "heights", "patches"):
        array = getattr(result, name)
        assert not array.flags.writeable and not array.flags.owndata, name
        assert np.shares_memory(array, getattr(result, name)), name


def test_arrays_outlive_the_result_the_segmenter_and_later_scans(scan: Scan) -> None:
    segmenter = flagstone.Surface()
    result = segmenter.segment(scan)
    held = [result.labels, result.ground, result.heights, result.patches, result.surface.grids[0].heights]
    expected = [array.tobytes() for array in held]
    surface = result.surface
    height = surface.height(5, 5)
    del result
    for seed in range(5):
        segmenter.segment(random_scan(30_000, seed))
    del segmenter
    gc.collect()
    assert [array.tobytes() for array in held] == expected
    assert surface.height(5, 5) == height


def test_a_later_scan_reuses_unreferenced_memory(scan: Scan) -> None:
    segmenter = flagstone.Surface()
    first = segmenter.segment(scan).labels.ctypes.data
    assert segmenter.segment(scan).labels.ctypes.data == first


def test_codes_match_the_library() -> None:
    assert [label.name.lower() for label in Label] == flagstone._core.label_names()
    assert [verdict.name.lower() for verdict in Verdict] == flagstone._core.verdict_names()
    assert [int(label) for label in Label] == list(range(5))


def test_patches_contain_the_planes_of_the_ground(scan: Scan) -> None:
    patches = flagstone.Patchwork().segment(scan).patches
    ground = patches[np.isin(patches["verdict"], [Verdict.GROUND, Verdict.GROUND_FLAT])]
    assert len(ground) > 100
    assert np.allclose(np.linalg.norm(ground["normal"], axis=1), 1, atol=1e-5)
    assert np.allclose((ground["normal"] * ground["mean"]).sum(1) + ground["d"], 0, atol=1e-4)
    wide_and_away_from_the_wall = (ground["eigenvalues"][:, 1] > 0.3) & (ground["mean"][:, 0] < 5)
    assert np.allclose(ground["normal"][wide_and_away_from_the_wall], [0, 0, 1], atol=0.05)
    assert np.allclose(np.median(ground["mean"][:, 2]), -1.73, atol=0.01)
    assert (ground["likelihood"] > 0.5).all() and (np.diff(ground["eigenvalues"], axis=1) <= 0).all()


def test_ground_counts_of_patchworks_patches_add_up_to_the_ground(scan: Scan) -> None:
    result = flagstone.Patchwork().segment(scan)
    assert result.patches["ground_count"].sum() == result.counts["ground"]


def test_patches_convert_to_a_data_frame_with_one_row_per_patch(scan: Scan) -> None:
    result = flagstone.Patchwork().segment(scan)
    frame = result.to_pandas()
    assert len(frame) == len(result.patches)
    assert np.array_equal(frame["normal_z"], result.patches["normal"][:, 2])
    assert np.array_equal(frame["eigenvalue_1"], result.patches["eigenvalues"][:, 0])
    assert list(frame["verdict"].cat.codes) == list(result.patches["verdict"])
    assert set(frame["verdict"]) <= set(flagstone._core.verdict_names())
    assert not np.shares_memory(frame["d"].to_numpy(), result.patches)


def test_the_surface_accepts_positions_of_any_shape(scan: Scan) -> None:
    surface = flagstone.Surface().segment(scan).surface
    assert surface and surface.extent > 50
    x, y = np.linspace(-8, 8, 5), np.linspace(-8, 8, 7)[:, None]
    assert surface.height(x, y).shape == (7, 5)
    for number in (surface.height(1, 2), surface.resolution(1.0, np.float32(2))):
        assert type(number) is float
    assert np.allclose(surface.height(x, y), -1.73, atol=0.05)
    at = surface.at(x, y)
    assert np.array_equal(at.height, surface.height(x, y))
    assert at.normal.shape == (7, 5, 3) and at.slope.shape == at.confidence.shape == (7, 5)
    assert np.allclose(at.normal[..., 2], np.cos(at.slope), atol=1e-4)
    assert set(np.unique(surface.resolution(x, y))) <= {grid.cell for grid in surface.grids}


def test_the_surface_is_unknown_outside_its_extent(scan: Scan) -> None:
    surface = flagstone.Surface().segment(scan).surface
    assert np.isnan(surface.height(1e4, 0)) and np.isnan(surface.height(np.nan, 0))
    assert np.isnan(surface.resolution(1e4, 0)) and surface.at(1e4, 0).confidence == 0


def test_grids_contain_the_heights_at_cell_centres(scan: Scan) -> None:
    surface = flagstone.Surface().segment(scan).surface
    cells = [grid.cell for grid in surface.grids]
    assert cells == sorted(cells, reverse=True)
    finest = surface.grids[-1]
    width = len(finest.heights)
    row, column = width // 2 + 3, width // 2 - 5
    x, y = (column + 0.5 - width / 2) * finest.cell, (row + 0.5 - width / 2) * finest.cell
    assert surface.height(x, y) == finest.heights[row, column]
    assert finest.extent == width * finest.cell / 2


def test_heights_of_points_are_above_the_surface(scan: Scan) -> None:
    result = flagstone.Surface().segment(scan)
    known = np.isfinite(result.heights)
    below = result.surface.height(scan[known, 0], scan[known, 1])
    assert np.allclose(result.heights[known], scan[known, 2] - below, atol=1e-4)


def test_a_method_without_a_surface_has_no_heights(scan: Scan) -> None:
    result = flagstone.Patchwork().segment(scan)
    assert not result.surface and result.surface.grids == () and result.surface.extent == 0
    assert result.heights.shape == (len(scan),) and np.isnan(result.heights).all()
    assert np.isnan(result.surface.height([0, 1], 0)).all()


def test_repr_of_a_result_shows_its_counts(scan: Scan) -> None:
    result = flagstone.Patchwork().segment(scan)
    assert repr(result).startswith(f"Segmentation({len(scan)} points: ")
    assert f"{result.counts['ground']} ground" in repr(result)


@pytest.mark.parametrize("method", flagstone.method_names())
def test_every_method_labels_every_point(method: str, scan: Scan) -> None:
    result = flagstone.make_segmenter(method).segment(scan[:4000])
    assert len(result.labels) == 4000 and result.counts["ground"] > 0


def test_a_result_contains_its_settings(scan: Scan) -> None:
    result = flagstone.Patchwork(distance_margin=0.25).segment(scan)
    assert result.settings["distance_margin"] == 0.25
    assert result.settings == flagstone.Patchwork(distance_margin=0.25).settings


@pytest.mark.parametrize("method", ["surface", "patchwork"])
@pytest.mark.parametrize("copied", [copy.deepcopy, copy.copy, lambda result: pickle.loads(pickle.dumps(result))])
def test_a_result_can_be_pickled_and_copied(
    method: str, copied: Callable[[flagstone.Segmentation], flagstone.Segmentation], scan: Scan
) -> None:
    result = flagstone.make_segmenter(method, sensor_height="estimate").segment(scan)
    other = copied(result)
    for name in ("labels", "ground", "heights", "patches"):
        ours, theirs = getattr(result, name), getattr(other, name)
        assert theirs.dtype == ours.dtype and theirs.tobytes() == ours.tobytes()
        assert not np.shares_memory(ours, theirs)
    assert (other.counts, other.mount, other.settings) == (result.counts, result.mount, result.settings)
    x, y = np.random.default_rng(1).uniform(-60, 60, (2, 500))
    for answer, expected in zip(other.surface.at(x, y), result.surface.at(x, y), strict=True):
        assert np.array_equal(answer, expected, equal_nan=True)


def test_parts_of_a_result_can_be_pickled(scan: Scan) -> None:
    result = flagstone.Surface(sensor_height="track").segment(scan)
    surface, grid, patches, mount = pickle.loads(
        pickle.dumps((result.surface, result.surface.grids[0], result.patches, result.mount))
    )
    assert surface.height(5, 0) == result.surface.height(5, 0) and surface.extent == result.surface.extent
    assert np.array_equal(grid.heights, result.surface.grids[0].heights, equal_nan=True)
    assert patches.tobytes() == result.patches.tobytes() and mount == result.mount


def test_an_invalid_pickle_is_rejected(scan: Scan) -> None:
    labels, heights, patches, grids, mount = flagstone.Surface().segment(scan)._result.state()
    side = np.zeros((4, 6), np.float32)
    for state in (
        (labels + np.uint8(5), heights, patches, grids, mount),
        (labels, heights[1:], patches, grids, mount),
        (labels, heights, patches[1:], grids, mount),
        (labels, heights, patches, [(1.0, side, side)], mount),
    ):
        with pytest.raises(ValueError, match="pickled result"):
            flagstone._core.restored_result(*state)


def segment_here(points: Scan) -> flagstone.Segmentation:
    return flagstone.Surface().segment(points)


def test_results_can_be_returned_from_other_processes(scan: Scan) -> None:
    scans = [scan, scan[:5000]]
    expected = [segment_here(points).labels.tobytes() for points in scans]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert [result.labels.tobytes() for result in pool.map(segment_here, scans)] == expected
    joblib = pytest.importorskip("joblib")
    results = joblib.Parallel(n_jobs=2)(joblib.delayed(flagstone.Surface().segment)(points) for points in scans)
    assert [result.labels.tobytes() for result in results] == expected
