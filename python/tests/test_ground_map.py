# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""GroundMap and LabelVote combine the scans of a run."""

from __future__ import annotations

import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import Scan
from simulated_run import Run, simulated_run

import flagstone

GROUND_CLASSES = (40, 44, 48, 49, 60, 72)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return simulated_run(tmp_path_factory.mktemp("run"), scene="parked_cars")


def level_scan(reach: float = 30) -> Scan:
    """Ground at z = -1.8 in a grid with 0.25 m between points."""
    line = np.arange(-reach, reach, 0.25, dtype=np.float32)
    x, y = np.meshgrid(line, line)
    return np.stack([x.ravel(), y.ravel(), np.full(x.size, -1.8, np.float32)], axis=1)


def pose_at(x: float, y: float, z: float) -> np.ndarray:  # type: ignore[type-arg]
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def turned(scan: Scan, degrees: float) -> Scan:
    """The scan of a sensor that is tilted about its y axis."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return (scan @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])).astype(np.float32)


@pytest.fixture(scope="module")
def flat() -> tuple[Scan, flagstone.Segmentation]:
    scan = level_scan()
    return scan, flagstone.Surface(sensor_height=1.8).segment(scan)


def flat_map(flat: tuple[Scan, flagstone.Segmentation], **settings: float) -> flagstone.GroundMap:
    ground = flagstone.GroundMap(**settings)
    ground.add(*flat, pose_at(1000, -500, 21.8))
    return ground


def test_a_map_is_in_the_world_frame(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat)
    assert ground.scans == 1
    assert ground.height(1003.2, -507.1) == pytest.approx(20, abs=0.02)
    assert np.isnan(ground.height(0, 0))


def test_heights_have_the_shape_that_the_positions_broadcast_to(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat)
    heights = ground.height(np.full((3, 1), 1001.0), np.full((1, 4), -499.0))
    assert heights.shape == (3, 4)
    assert isinstance(ground.height(1001.0, -499.0), float)
    assert ground.height([], []).shape == (0,)


def test_a_sample_has_the_values_of_the_ground_and_the_counts(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat)
    ground.add(*flat, pose_at(1000, -500, 21.8))
    ground.add(*flat, pose_at(5000, -500, 21.8))
    at = ground.at([1004.25, 0], [-495.25, 0])
    np.testing.assert_allclose(at.height, [20, np.nan], atol=0.02)
    np.testing.assert_allclose(at.normal[0], [0, 0, 1], atol=0.02)
    assert at.slope[0] < 0.02
    assert 0 < at.deviation[0] < 0.1
    assert at.scans.tolist() == [2, 0]
    assert at.contradictions.tolist() == [0, 0]
    assert at.age[0] == 1
    assert np.isnan([at.deviation[1], at.slope[1], *at.normal[1]]).all()


def test_a_scan_is_levelled_to_the_map(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat)
    wrong = pose_at(1002, -500, 22.1)
    levelling = ground.add(*flat, wrong)
    assert levelling.applied
    assert levelling.cells > 1000
    assert levelling.offset == pytest.approx(0.3, abs=0.01)
    assert ground.height(1002, -500) == pytest.approx(20, abs=0.02)
    assert levelling.corrected(wrong)[2, 3] == pytest.approx(21.8, abs=0.01)


def test_a_corrected_pose_brings_the_points_of_a_scan_onto_the_map(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat)
    pitch = np.radians(1)
    wrong = pose_at(1000, -500, 21.9)
    wrong[:3, :3] = [[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]]
    corrected = ground.level(*flat, wrong).corrected(wrong)
    near = flat[0][np.hypot(flat[0][:, 0], flat[0][:, 1]) < 20]
    before = (near @ wrong[:3, :3].T + wrong[:3, 3])[:, 2]
    after = (near @ corrected[:, :3].T + corrected[:, 3])[:, 2]
    assert np.abs(before - 20).max() > 0.3
    assert np.abs(after - 20).max() < 0.03


def test_levelling_alone_does_not_change_the_map(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat)
    assert ground.level(*flat, pose_at(1000, -500, 21.9)).applied
    assert ground.scans == 1


def test_a_difference_above_max_correction_is_not_corrected(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat, max_correction=0.1)
    assert not ground.add(*flat, pose_at(1000, -500, 22.1)).applied


def test_a_tilted_sensor_gives_the_same_map_as_a_level_one(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    scan = turned(flat[0], 10)
    up = (np.sin(np.radians(-10)), 0.0, np.cos(np.radians(10)))
    result = flagstone.Surface(sensor_height=1.8, tilt=up).segment(scan)
    pose = pose_at(1000, -500, 21.8)
    c, s = np.cos(np.radians(10)), np.sin(np.radians(10))
    pose[:3, :3] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    ground = flagstone.GroundMap()
    ground.add(scan, result, pose)
    x, y = np.meshgrid(np.linspace(985, 1015, 20), np.linspace(-515, -485, 20))
    np.testing.assert_allclose(ground.height(x, y), 20, atol=0.03)


def test_a_scan_in_millimetres_is_scaled(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    scan = 1000 * flat[0]
    result = flagstone.Surface(sensor_height=1.8, mount={"scale": 0.001}).segment(scan)
    ground = flagstone.GroundMap()
    ground.add(scan, result, pose_at(1000, -500, 21.8))
    assert ground.height(1005, -500) == pytest.approx(20, abs=0.02)


def test_the_window_removes_distant_tiles(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flat_map(flat, window=50)
    ground.add(*flat, pose_at(2000, -500, 21.8))
    assert np.isnan(ground.height(1000, -500))
    assert not np.isnan(ground.height(2000, -500))


def test_a_grid_has_the_cells_of_the_map(run: Run) -> None:
    grid = run.map.grid()
    assert np.isfinite(grid.height).sum() == run.map.cells
    assert grid.total_scans == run.map.scans
    assert grid.scans.max() > 5
    assert (grid.last_scan[np.isfinite(grid.height)] > 0).all()
    row, column = np.argwhere(grid.scans == grid.scans.max())[0]
    at = run.map.at(grid.x[column], grid.y[row])
    assert at.height == pytest.approx(float(grid.height[row, column]), abs=1e-4)
    assert (at.scans, at.contradictions, at.age) == (
        grid.scans[row, column],
        grid.contradictions[row, column],
        grid.age[row, column],
    )


def test_a_part_of_a_grid_has_the_same_cells(run: Run) -> None:
    whole = run.map.grid()
    part = run.map.grid((-3.2, 10, 1, 7.5))
    assert part.extent == (-3.5, 10, 1, 7.5)
    columns = np.searchsorted(whole.x, part.x)
    rows = np.searchsorted(whole.y, part.y)
    for name in ("height", "deviation", "scans", "contradictions", "last_scan"):
        np.testing.assert_array_equal(getattr(part, name), getattr(whole, name)[np.ix_(rows, columns)])


def test_a_grid_far_from_the_map_is_unknown(run: Run) -> None:
    grid = run.map.grid((1e5, 1e5 + 2, 0, 1))
    assert grid.height.shape == (2, 4)
    assert np.isnan(grid.height).all()
    assert not grid.last_scan.any()


def test_an_empty_map_has_an_empty_grid() -> None:
    assert flagstone.GroundMap().grid().height.shape == (0, 0)


def test_a_map_is_close_to_the_true_ground(run: Run) -> None:
    errors = []
    for scan, pose, truth, classes, levelling in zip(
        run.scans, run.poses, run.true_heights, run.classes, run.levellings, strict=True
    ):
        ground = np.isin(classes & 0xFFFF, GROUND_CLASSES) & (np.hypot(scan[:, 0], scan[:, 1]) < 20)
        feet = np.column_stack([scan[ground, :2], truth[ground]]).astype(np.float64)
        corrected = levelling.corrected(pose)
        world = feet @ corrected[:, :3].T + corrected[:, 3]
        errors.append(run.map.height(world[:, 0], world[:, 1]) - world[:, 2])
    assert np.nanmedian(np.abs(np.concatenate(errors))) < 0.05


def test_the_vote_corrects_labels(run: Run) -> None:
    own = voted = 0
    for scan, result, pose, levelling, classes in zip(
        run.scans, run.results, run.poses, run.levellings, run.classes, strict=True
    ):
        truth = np.isin(classes & 0xFFFF, GROUND_CLASSES)
        labels = run.vote.relabel(scan, result, pose, levelling)
        assert labels.dtype == np.uint8
        own += int((truth != result.ground).sum())
        voted += int((truth != (labels == flagstone.Label.GROUND)).sum())
    assert voted < own


def test_the_vote_does_not_change_other_labels(run: Run) -> None:
    scan, result = run.scans[3], run.results[3]
    labels = run.vote.relabel(scan, result, run.poses[3], run.levellings[3])
    kept = ~np.isin(result.labels, (flagstone.Label.GROUND, flagstone.Label.NONGROUND))
    np.testing.assert_array_equal(labels[kept], result.labels[kept])


def test_the_map_corrects_labels_after_the_vote(run: Run) -> None:
    voted = corrected = 0
    for scan, result, pose, levelling, classes in zip(
        run.scans, run.results, run.poses, run.levellings, run.classes, strict=True
    ):
        truth = np.isin(classes & 0xFFFF, GROUND_CLASSES)
        labels = run.vote.relabel(scan, result, pose, levelling)
        after = run.map.relabel(scan, result, pose, levelling, labels)
        voted += int((truth != (labels == flagstone.Label.GROUND)).sum())
        corrected += int((truth != (after == flagstone.Label.GROUND)).sum())
    assert corrected < voted


def test_only_labels_above_the_map_change(run: Run) -> None:
    arguments = (run.scans[3], run.results[3], run.poses[3], run.levellings[3])
    labels = run.results[3].labels
    changed = run.map.relabel(*arguments) != labels
    assert changed.any()
    assert (labels[changed] == flagstone.Label.GROUND).all()
    assert (run.map.relabel(*arguments)[changed] == flagstone.Label.NONGROUND).all()
    world = run.levellings[3].corrected(run.poses[3])
    x, y, z = (run.scans[3][changed, :3] @ world[:, :3].T + world[:, 3]).T
    assert (z - run.map.height(x, y) > 0.06 - 0.02).all()  # the corrected pose turns the scan, x and y too


def test_heights_are_between_the_height_in_the_scan_and_the_height_above_the_map(run: Run) -> None:
    points, result, pose, levelling = run.scans[3], run.results[3], run.poses[3], run.levellings[3]
    heights = run.map.heights(points, result, pose, levelling)
    dx, dy, dz = pose[:3, :3] @ points[:, :3].T
    z = pose[2, 3] + dz - levelling.offset - levelling.slope_x * dx - levelling.slope_y * dy
    above_map = z - run.map.height(pose[0, 3] + dx, pose[1, 3] + dy)
    assert heights.dtype == np.float32
    known = np.isfinite(above_map) & np.isfinite(result.heights)
    lower, higher = np.minimum(above_map, result.heights), np.maximum(above_map, result.heights)
    assert ((heights >= lower - 1e-3) & (heights <= higher + 1e-3))[known].all()
    both = known & (np.abs(above_map - result.heights) > 0.1)
    assert (np.abs(heights - above_map) < 0.02)[both].any()
    unknown = np.isnan(above_map)
    np.testing.assert_array_equal(heights[unknown], result.heights[unknown])


def test_labels_of_another_length_are_an_error(run: Run) -> None:
    with pytest.raises(ValueError, match="the number of labels differs from the number of points"):
        run.map.relabel(run.scans[3], run.results[3], run.poses[3], run.levellings[3], [1, 2])


def test_threads_can_share_a_map_and_a_vote(run: Run) -> None:
    ground, vote = flagstone.GroundMap(), flagstone.LabelVote()
    failures: list[BaseException] = []

    def add(number: int) -> None:
        try:
            scan, result, pose = run.scans[number], run.results[number], run.poses[number]
            levelling = ground.add(scan, result, pose)
            vote.add(scan, result, pose, levelling)
            ground.at(*np.meshgrid(np.linspace(-20, 20, 50), np.linspace(-20, 20, 50)))
            ground.grid((-20, 20, -20, 20))
            vote.relabel(scan, result, pose, levelling)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=add, args=(number,)) for number in range(len(run.scans))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    assert ground.scans == len(run.scans)


def test_the_same_scans_give_bit_identical_maps(run: Run) -> None:
    again = flagstone.GroundMap()
    for scan, result, pose in zip(run.scans, run.results, run.poses, strict=True):
        again.add(scan.astype(np.float64), result, pose[:3])
    for name in ("height", "deviation", "scans", "contradictions", "last_scan"):
        np.testing.assert_array_equal(getattr(again.grid(), name), getattr(run.map.grid(), name))


@pytest.mark.parametrize(
    ("pose", "message"),
    [
        (np.eye(3), r"pose: shape \(3, 3\) is not supported \(expected \(4, 4\) or \(3, 4\)\)"),
        (np.full((4, 4), np.nan), "pose: a number is not finite"),
        (pose_at(1, 2, 3).T, "pose: the last row is .* is it transposed"),
        (2 * np.eye(4)[:3], "pose"),
        (pose_at(1e9, 0, 0), "pose"),
    ],
)
def test_an_invalid_pose_is_an_error_and_changes_nothing(
    pose: object, message: str, flat: tuple[Scan, flagstone.Segmentation]
) -> None:
    ground, vote = flagstone.GroundMap(), flagstone.LabelVote()
    with pytest.raises(ValueError, match=message):
        ground.add(*flat, pose)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=message):
        vote.add(*flat, pose, flagstone.Levelling())  # type: ignore[arg-type]
    assert ground.scans == ground.cells == vote.voxels == 0


def test_a_result_without_heights_is_an_error(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    result = flagstone.Patchwork(sensor_height=1.8).segment(flat[0])
    with pytest.raises(ValueError, match="the result has no heights of this cloud"):
        flagstone.GroundMap().add(flat[0], result, np.eye(4))


def test_a_result_of_another_scan_is_an_error(flat: tuple[Scan, flagstone.Segmentation]) -> None:
    with pytest.raises(ValueError, match="the result has no heights of this cloud"):
        flagstone.GroundMap().add(flat[0][:-1], flat[1], np.eye(4))
    with pytest.raises(ValueError, match="the result has no heights of this cloud"):
        flagstone.LabelVote().relabel(flat[0][:-1], flat[1], np.eye(4), flagstone.Levelling())


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"cell": 5}, r"cell.*\(expected 0.1 to 2"),
        ({"max_range": 1}, "max_range"),
        ({"window": 3}, "window"),
        ({"window": 0}, "window: 0 is out of range .*None to keep everything"),
        ({"max_correction": -1}, "max_correction"),
    ],
)
def test_an_invalid_setting_is_an_error(settings: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        flagstone.GroundMap(**settings)


@pytest.mark.parametrize("extent", [(0, 0, 0, 1), (1, 0, 0, 1), (0, 1, 0), (0, np.inf, 0, 1)])
def test_an_invalid_extent_is_an_error(extent: tuple[float, ...]) -> None:
    with pytest.raises(ValueError, match=r"extent: .* is not a rectangle"):
        flagstone.GroundMap().grid(extent)


def test_positions_that_do_not_broadcast_are_an_error() -> None:
    with pytest.raises(ValueError, match="broadcast"):
        flagstone.GroundMap().height([1, 2], [1, 2, 3])


def test_objects_describe_themselves(run: Run) -> None:
    assert repr(run.map) == f"GroundMap({run.map.scans} scans, {run.map.cells} cells of 0.5 m)"
    assert repr(run.vote) == f"LabelVote({run.vote.voxels} voxels)"
    assert run.map.nbytes > 16 * run.map.cells
    assert run.vote.nbytes > 4 * run.vote.voxels


def test_a_run_can_be_mapped_in_five_lines(tmp_path: Path, flat: tuple[Scan, flagstone.Segmentation]) -> None:
    ground = flagstone.GroundMap()
    for number in range(3):
        ground.add(*flat, pose_at(number, 0, 1.8))
    assert ground.height(1, 0) == pytest.approx(0, abs=0.02)
