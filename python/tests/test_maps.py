# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The output directory of a mapped run is read, and written as GeoTIFF, recording and animation."""

from __future__ import annotations

import importlib
import json
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from recordings import Row, packed, rows_of
from simulated_run import Run, simulated_run, write_map

import flagstone
from flagstone import maps
from flagstone._palette import LABELS, MOVING, PAGE, PATH, Color

LAYERS = ("height", "deviation", "scans", "contradictions", "last_scan")
FRAMES = 5


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return simulated_run(tmp_path_factory.mktemp("run"), frames=FRAMES)


@pytest.fixture(scope="module")
def directory(run: Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_map(run, tmp_path_factory.mktemp("map") / "out")


@pytest.fixture
def damaged(directory: Path, tmp_path: Path) -> Path:
    """A copy that a test may damage."""
    return Path(shutil.copytree(directory, tmp_path / "damaged"))


def test_a_map_that_is_read_has_the_cells_that_were_written(run: Run, directory: Path) -> None:
    read, written = maps.read_ground_map(directory), run.map.grid()
    assert (read.cell, read.extent, read.total_scans) == (written.cell, written.extent, FRAMES)
    for layer in LAYERS:
        np.testing.assert_array_equal(getattr(read, layer), getattr(written, layer))
        assert getattr(read, layer).dtype == getattr(written, layer).dtype


def test_the_directory_of_the_tiles_can_be_given(directory: Path) -> None:
    assert maps.read_ground_map(directory / "ground").extent == maps.read_ground_map(directory).extent


def test_a_part_of_a_map_can_be_read(run: Run, directory: Path) -> None:
    extent = (-5.2, 33.0, -7.0, 2.3)
    read, expected = maps.read_ground_map(directory, extent=extent), run.map.grid(extent)
    assert read.extent == expected.extent
    for layer in LAYERS:
        np.testing.assert_array_equal(getattr(read, layer), getattr(expected, layer))


def test_a_tile_can_be_read_with_numpy_alone(run: Run, directory: Path) -> None:
    geometry = json.loads((directory / "ground" / "map.json").read_text())
    name, x, y = (geometry["tiles"][0][key] for key in ("file", "x", "y"))
    tile = np.load(directory / "ground" / name)
    size = 64 * geometry["cell"]
    expected = run.map.grid((x * size, (x + 1) * size, y * size, (y + 1) * size))
    np.testing.assert_array_equal(tile["height"], expected.height)


def test_a_run_has_the_scans_and_poses_of_its_directory(run: Run, directory: Path) -> None:
    mapped = maps.read_run(directory)
    assert len(mapped) == FRAMES
    assert mapped.path.shape == (FRAMES, 2)
    for scan, points, pose, levelling, moving in zip(
        mapped.scans(), run.scans, run.poses, run.levellings, run.moving, strict=True
    ):
        np.testing.assert_array_equal(scan.points, points[:, :3])
        np.testing.assert_allclose(scan.pose, levelling.corrected(pose), atol=1e-9)
        np.testing.assert_array_equal(scan.moving, moving)
        assert len(scan.labels) == len(points)


def test_scans_that_were_moved_can_be_given(run: Run, directory: Path, tmp_path: Path) -> None:
    moved = [Path(shutil.copy(file, tmp_path)) for file in run.files]
    scan = maps.read_run(directory, scans=moved).scan(2)
    np.testing.assert_array_equal(scan.points, run.scans[2][:, :3])


def test_scans_without_pose_or_labels_are_skipped(damaged: Path) -> None:
    rows = np.loadtxt(damaged / "poses.txt")
    rows[1] = np.nan
    np.savetxt(damaged / "poses.txt", rows)
    (damaged / "labels" / "000003.label").unlink()
    assert [scan.number for scan in maps.read_run(damaged).scans()] == [0, 2, 4]


def test_a_run_without_files_of_moving_points_has_none(damaged: Path) -> None:
    shutil.rmtree(damaged / "moving")
    assert not maps.read_run(damaged).scan(0).moving.any()


# GeoTIFF


@pytest.fixture
def rasterio() -> Any:
    pytest.importorskip("rasterio", reason="rasterio reads GeoTIFF files")
    return importlib.import_module("rasterio")


def test_a_geotiff_has_the_values_of_the_map(run: Run, directory: Path, tmp_path: Path, rasterio: Any) -> None:
    maps.write_geotiff(directory, tmp_path / "ground.tif", crs="EPSG:25832")
    grid = run.map.grid()
    known = np.isfinite(grid.height)
    with rasterio.open(tmp_path / "ground.tif") as file:
        assert file.descriptions == ("height", "deviation", "scans", "contradictions")
        assert file.crs.to_epsg() == 25832
        assert file.dtypes == ("float32",) * 4
        assert np.isnan(file.nodata)
        for band, layer in enumerate(file.descriptions, start=1):
            expected = np.where(known, getattr(grid, layer), np.nan)
            np.testing.assert_array_equal(file.read(band)[::-1], expected.astype(np.float32))


def test_a_geotiff_has_the_position_of_the_map(run: Run, directory: Path, tmp_path: Path, rasterio: Any) -> None:
    maps.write_geotiff(directory, tmp_path / "ground.tif")
    grid = run.map.grid()
    min_x, _, _, max_y = grid.extent
    with rasterio.open(tmp_path / "ground.tif") as file:
        assert file.transform.to_gdal() == (min_x, grid.cell, 0, max_y, 0, -grid.cell)
        assert file.crs is None
        row, column = np.argwhere(grid.scans == grid.scans.max())[0]
        x, y = grid.x[column], grid.y[row]
        (sample,) = file.sample([(x, y)])
    assert sample[0] == pytest.approx(run.map.height(x, y), abs=1e-4)


def test_an_existing_geotiff_is_kept_if_writing_fails(damaged: Path, tmp_path: Path, rasterio: Any) -> None:
    target = tmp_path / "ground.tif"
    target.write_bytes(b"earlier")
    next((damaged / "ground").glob("*_*.npy")).unlink()
    with pytest.raises(FileNotFoundError, match="tile is missing"):
        maps.write_geotiff(damaged, target)
    assert target.read_bytes() == b"earlier"
    assert [file.name for file in tmp_path.iterdir() if file.is_file()] == ["ground.tif"]


def test_an_unknown_coordinate_reference_system_is_an_error(directory: Path, tmp_path: Path, rasterio: Any) -> None:
    with pytest.raises(ValueError, match="crs: 'EPSG:0' is not a coordinate reference system"):
        maps.write_geotiff(directory, tmp_path / "ground.tif", crs="EPSG:0")
    assert not any(tmp_path.iterdir())


def test_a_missing_directory_of_a_geotiff_is_an_error(directory: Path, tmp_path: Path, rasterio: Any) -> None:
    with pytest.raises(OSError, match="cannot be written"):
        maps.write_geotiff(directory, tmp_path / "missing" / "ground.tif")


# Animation


@pytest.fixture
def pillow() -> Any:
    pytest.importorskip("PIL", reason="Pillow reads animations")
    return importlib.import_module("PIL.Image")


def frames_of(pillow: Any, path: Path) -> list[Any]:
    """(height, width, 3) per frame."""
    with pillow.open(path) as animation:
        frames = []
        for number in range(animation.n_frames):
            animation.seek(number)
            frames.append(np.array(animation.convert("RGB")))
        return frames


def pixels_of(frame: Any, color: Color) -> int:
    return int((frame == color).all(axis=-1).sum())


def ground_pixels(frame: Any) -> int:
    """Pixels of the relief, in the part without text."""
    quarter = len(frame) // 4
    frame = frame[quarter:-quarter]
    return int(((frame != PAGE).any(axis=-1) & (frame.max(axis=-1) > 120) & (frame.min(axis=-1) > 60)).sum())


def test_an_animation_shows_the_ground_growing(directory: Path, tmp_path: Path, pillow: Any) -> None:
    maps.write_animation(directory, tmp_path / "run.gif", size=320)
    frames = frames_of(pillow, tmp_path / "run.gif")
    assert len(frames) == FRAMES + 1
    assert max(frames[0].shape) == 320
    grown = [ground_pixels(frame) for frame in frames]
    assert grown[0] > 1000
    assert grown[-1] > 1.2 * grown[0]


def test_an_animation_shows_moving_points_in_red_and_the_path(
    run: Run, directory: Path, tmp_path: Path, pillow: Any
) -> None:
    maps.write_animation(directory, tmp_path / "run.gif", size=320)
    frames = frames_of(pillow, tmp_path / "run.gif")
    assert run.moving[0].any()
    for frame in frames[:-1]:
        assert pixels_of(frame, MOVING) >= 9
    assert pixels_of(frames[-1], MOVING) == 0
    assert pixels_of(frames[-1], PATH) > pixels_of(frames[0], PATH)


def test_an_animation_has_at_most_the_requested_frames(directory: Path, tmp_path: Path, pillow: Any) -> None:
    maps.write_animation(directory, tmp_path / "run.gif", size=128, max_frames=3, frames_per_second=20)
    with pillow.open(tmp_path / "run.gif") as animation:
        assert animation.n_frames <= 3
        assert animation.info["duration"] == 50


def test_an_animation_of_a_long_run_follows_the_sensor(damaged: Path, tmp_path: Path, pillow: Any) -> None:
    rows = np.loadtxt(damaged / "poses.txt")
    rows[-1, 3] += 1000
    np.savetxt(damaged / "poses.txt", rows)
    maps.write_animation(damaged, tmp_path / "run.gif", size=320)
    frames = frames_of(pillow, tmp_path / "run.gif")
    assert frames[0].shape == (320, 320, 3)
    assert ground_pixels(frames[3]) > 300
    assert ground_pixels(frames[-2]) < 50


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"size": 10}, r"size: 10 is out of range \(expected 64 to 2,048 pixels\)"),
        ({"frames_per_second": 0}, "frames_per_second: 0 is out of range"),
        ({"max_frames": 1}, "max_frames: 1 is out of range"),
    ],
)
def test_an_invalid_option_of_an_animation_is_an_error(
    arguments: dict[str, Any], message: str, directory: Path, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=message):
        maps.write_animation(directory, tmp_path / "run.gif", **arguments)


def test_another_extension_of_an_animation_is_an_error(directory: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"unknown extension of an animation \(expected \.gif\)"):
        maps.write_animation(directory, tmp_path / "run.mp4")


def test_an_animation_of_a_run_without_labels_is_an_error(damaged: Path, tmp_path: Path, pillow: Any) -> None:
    shutil.rmtree(damaged / "labels")
    with pytest.raises(ValueError, match="no scan has a pose and labels"):
        maps.write_animation(damaged, tmp_path / "run.gif")
    assert not (tmp_path / "run.gif").exists()


# Recording


@pytest.fixture(scope="module")
def recorded(directory: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Row]]:
    pytest.importorskip("rerun", reason="rerun-sdk writes recordings")
    path = tmp_path_factory.mktemp("recorded") / "run.rrd"
    maps.write_recording(directory, path, max_points=10_000)
    return rows_of(path)


def test_a_recording_has_the_ground_that_each_scan_adds(recorded: dict[str, list[Row]], run: Run) -> None:
    cells = []
    for number in range(FRAMES):
        (row,) = recorded[f"/ground/scan_{number:06}"]
        assert row["scan"] == number
        corners = np.array(row["Mesh3D:vertex_positions"]).reshape(-1, 4, 3)
        assert len(row["Mesh3D:triangle_indices"]) == 2 * len(corners)
        cells.append(corners)
    middles = np.concatenate(cells).mean(axis=1)
    assert len(np.unique(middles[:, :2], axis=0)) == len(middles)
    assert len(middles) > 0.8 * run.map.cells
    errors = np.abs(middles[:, 2] - run.map.height(middles[:, 0], middles[:, 1]))
    assert np.nanmedian(errors) < 0.02


def test_a_recording_has_the_points_by_label_and_moving_points_in_red(recorded: dict[str, list[Row]], run: Run) -> None:
    for number, moving in enumerate(run.moving):
        row = recorded["/points/moving"][number]
        assert len(row["Points3D:positions"]) == moving.sum()
        assert row["Points3D:colors"] == [packed(MOVING)]
    ground = recorded["/points/ground"]
    assert len(ground) == FRAMES
    assert ground[0]["Points3D:colors"] == [packed(LABELS[flagstone.Label.GROUND])]
    assert sum(len(recorded[f"/points/{name}"][0]["Points3D:positions"]) for name in ("ground", "nonground")) <= 10_000


def test_points_of_a_recording_are_in_the_world_frame(
    recorded: dict[str, list[Row]], run: Run, directory: Path
) -> None:
    scan = maps.read_run(directory).scan(FRAMES - 1)
    positions = np.array(recorded["/points/moving"][-1]["Points3D:positions"]).reshape(-1, 3)
    np.testing.assert_allclose(positions, scan.world[scan.moving], atol=1e-3)


def test_the_path_of_a_recording_grows(recorded: dict[str, list[Row]]) -> None:
    lengths = [np.array(row["LineStrips3D:strips"][0]).shape[0] for row in recorded["/path"]]
    assert len(lengths) == FRAMES
    assert lengths == sorted(lengths)
    assert lengths[-1] > lengths[0]


@pytest.mark.parametrize("option", ["every", "max_points"])
def test_an_invalid_option_of_a_recording_is_an_error(option: str, directory: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=f"{option}: 0 is out of range"):
        maps.write_recording(directory, tmp_path / "run.rrd", **{option: 0})


# Faults of the directory


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-100])


def fewer_poses(folder: Path) -> None:
    lines = (folder / "poses.txt").read_text().splitlines()
    (folder / "poses.txt").write_text("\n".join(lines[:-1]))


def first_tile(folder: Path) -> Path:
    return min((folder / "ground").glob("*_*.npy"))


@pytest.mark.parametrize(
    ("damage", "error", "message"),
    [
        (lambda folder: shutil.rmtree(folder / "ground"), FileNotFoundError, "map.json: file does not exist"),
        (lambda folder: first_tile(folder).unlink(), FileNotFoundError, "tile is missing"),
        (lambda folder: cut(first_tile(folder)), ValueError, "not a NumPy array: .*may be damaged"),
        (lambda folder: np.save(first_tile(folder), np.zeros((64, 64))), ValueError, "is not a tile"),
        (lambda folder: cut(folder / "ground" / "map.json"), ValueError, "map.json: not JSON"),
        (lambda folder: (folder / "ground" / "map.json").write_text("{}"), ValueError, "not a ground map"),
        (
            lambda folder: (folder / "ground" / "map.json").write_text(
                '{"format": "flagstone ground map", "version": 1, "cell": "wide"}'
            ),
            ValueError,
            "map.json: invalid geometry",
        ),
    ],
)
def test_a_damaged_map_is_one_line(
    damage: Callable[[Path], Any], error: type[Exception], message: str, damaged: Path
) -> None:
    damage(damaged)
    with pytest.raises(error, match=message) as raised:
        maps.read_ground_map(damaged)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("damage", "error", "message"),
    [
        (lambda folder: (folder / "run.json").unlink(), FileNotFoundError, "run.json: file does not exist"),
        (lambda folder: (folder / "run.json").write_text("[]"), ValueError, "run.json: not a JSON object"),
        (lambda folder: (folder / "run.json").write_text("{}"), ValueError, "run.json: no list of scans"),
        (lambda folder: (folder / "poses.txt").unlink(), FileNotFoundError, "poses.txt: file does not exist"),
        (lambda folder: (folder / "poses.txt").write_text("1 2\n3\n"), ValueError, "poses.txt: .*12 numbers per line"),
        (fewer_poses, ValueError, "poses.txt: 4 rows of 12 numbers .expected 5 rows of 12"),
        (lambda folder: cut(folder / "labels" / "000000.label"), ValueError, "000000.label"),
        (lambda folder: cut(folder / "moving" / "000000.moving.npy"), ValueError, "000000.moving.npy"),
    ],
)
def test_a_damaged_run_is_one_line(
    damage: Callable[[Path], Any], error: type[Exception], message: str, damaged: Path
) -> None:
    damage(damaged)
    with pytest.raises(error, match=message) as raised:
        maps.read_run(damaged).scan(0)
    assert "\n" not in str(raised.value)


# Static cloud


@pytest.fixture
def with_cloud(damaged: Path) -> Path:
    """A mapped run with four static points far from the origin."""
    points = np.zeros(4, [(axis, np.float64) for axis in "xyz"])
    points["x"] = 689_000.123 + np.arange(4)
    points["y"] = 5_335_000.25
    points["z"] = [510.0, 510.5, 511.0, 520.25]
    heights = np.array([0.0, 0.5, 1.0, np.nan], np.float32)
    flagstone.io.write(damaged / "static.ply", points, labels=np.array([1, 1, 0, 0]), heights=heights)
    return damaged


@pytest.mark.parametrize("extension", ["las", "laz"])
def test_static_points_are_written_as_las(extension: str, with_cloud: Path, tmp_path: Path) -> None:
    pytest.importorskip("laspy", reason="needs laspy, of the extra las")
    path = tmp_path / f"static.{extension}"

    maps.write_static_cloud(with_cloud, path)

    written, expected = flagstone.io.read(path), flagstone.io.read(with_cloud / "static.ply")
    assert written["classification"].tolist() == [2, 2, 1, 1]
    for axis in "xyz":
        np.testing.assert_allclose(written[axis], expected[axis], atol=0.0005)
    np.testing.assert_array_equal(written["height"], expected["height"])


def test_static_points_are_written_in_other_formats(with_cloud: Path, tmp_path: Path) -> None:
    maps.write_static_cloud(with_cloud, tmp_path / "static.pcd")
    written, expected = flagstone.io.read(tmp_path / "static.pcd"), flagstone.io.read(with_cloud / "static.ply")
    for name in ("x", "y", "z", "height", "label"):
        np.testing.assert_array_equal(written[name], expected[name])


def test_a_run_without_static_points_is_one_line(directory: Path, with_cloud: Path, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"static.ply: file does not exist \(expected .* voxel size above 0"):
        maps.write_static_cloud(directory, tmp_path / "static.las")
    points = np.zeros(1, [(axis, np.float64) for axis in "xyz"])
    flagstone.io.write(with_cloud / "static.ply", points)
    with pytest.raises(ValueError, match=r"static.ply: no property height"):
        maps.write_static_cloud(with_cloud, tmp_path / "static.las")
    assert list(tmp_path.glob("static*")) == []


@pytest.mark.parametrize(
    ("module", "extra", "write"),
    [
        ("rasterio", "geotiff", maps.write_geotiff),
        ("PIL", "plot", maps.write_animation),
        ("rerun", "viewer", maps.write_recording),
    ],
)
def test_a_missing_package_is_named(
    module: str,
    extra: str,
    write: Callable[[Path, Path], None],
    directory: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=rf"{module} is not installed, .* pip install 'flagstone\[{extra}\]'"):
        write(directory, tmp_path / "run.gif")
