# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.io` writes and reads every format, and rejects invalid files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import Scan

import flagstone
from flagstone import io


@pytest.mark.parametrize("name", ["scan.bin", "scan.pcd", "scan.ply", "scan.npy"])
def test_points_survive_a_round_trip(name: str, scan: Scan, tmp_path: Path) -> None:
    io.write(tmp_path / name, scan)
    read = io.read(tmp_path / name)
    assert read.dtype.names == ("x", "y", "z", "intensity")
    for i, field in enumerate(read.dtype.names):
        assert np.array_equal(read[field], scan[:, i])


@pytest.mark.parametrize("name", ["scan.pcd", "scan.ply", "scan.npy"])
def test_fields_of_every_type_survive_a_round_trip(name: str, tmp_path: Path) -> None:
    kinds = ["i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8"]
    rows = np.zeros(100, [("x", "f8"), ("y", "f8"), ("z", "f8"), *((kind, kind) for kind in kinds)])
    for field in rows.dtype.names or ():
        rows[field] = np.arange(100)
    io.write(tmp_path / name, rows)
    read = io.read(tmp_path / name)
    assert read.dtype.names == rows.dtype.names
    assert all(read[field].dtype == rows[field].dtype and np.array_equal(read[field], rows[field]) for field in kinds)


def test_labels_and_heights_become_fields(scan: Scan, tmp_path: Path) -> None:
    result = flagstone.Surface().segment(scan)
    io.write(tmp_path / "scan.ply", scan, labels=result.labels, heights=result.heights)
    read = io.read(tmp_path / "scan.ply")
    assert np.array_equal(read["label"], result.labels)
    assert np.array_equal(read["height"], result.heights, equal_nan=True)


def test_points_from_a_file_are_zero_copy(scan: Scan, tmp_path: Path) -> None:
    io.write(tmp_path / "scan.bin", scan)
    read = io.read(tmp_path / "scan.bin")
    segmenter = flagstone.Surface()
    assert np.array_equal(segmenter.segment(read).labels, segmenter.segment(scan).labels.copy())
    assert flagstone._core.address_of(read["x"], read["y"], read["z"]) == read.ctypes.data
    assert read.flags.writeable


def test_raw_files_are_read_with_the_given_number_of_columns(tmp_path: Path) -> None:
    (tmp_path / "scan.bin").write_bytes(np.arange(30, dtype="<f4").tobytes())
    assert io.read(tmp_path / "scan.bin", columns=6).dtype.names == ("x", "y", "z", "intensity", "ring", "c5")
    with pytest.raises(ValueError, match=r"scan\.bin: .*16"):
        io.read(tmp_path / "scan.bin")


@pytest.mark.parametrize("name", ["scan.bin", "scan.pcd", "scan.ply", "scan.npy"])
def test_bytes_are_parsed_like_the_file(name: str, scan: Scan, tmp_path: Path) -> None:
    io.write(tmp_path / name, scan)
    parsed = io.parse((tmp_path / name).read_bytes(), io.format_of(name) or "")
    assert np.array_equal(parsed, io.read(tmp_path / name))


def test_file_errors_are_one_line_with_the_file_name(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"nowhere\.pcd"):
        io.read(tmp_path / "nowhere.pcd")
    (tmp_path / "bad.pcd").write_text("VERSION 0.7\nFIELDS x y\n")
    with pytest.raises(ValueError, match=r"bad\.pcd: ") as raised:
        io.read(tmp_path / "bad.pcd")
    assert "\n" not in str(raised.value)
    with pytest.raises(ValueError, match=r"scan\.xyz"):
        io.read(tmp_path / "scan.xyz")
    with pytest.raises(OSError, match="nowhere"):
        io.write(tmp_path / "nowhere" / "scan.ply", np.zeros((1, 3), np.float32))


def test_a_field_that_a_format_cannot_store_is_an_error(scan: Scan, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="label"):
        io.write(tmp_path / "scan.bin", scan, labels=np.zeros(len(scan), np.uint8))
    with pytest.raises(TypeError, match="complex128"):
        io.write(tmp_path / "scan.ply", scan.astype(complex))
    with pytest.raises(ValueError, match=r"labels: shape \(3,\) does not match"):
        io.write(tmp_path / "scan.ply", scan, labels=[1, 2, 3])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["scan.label", "scan.npy"])
def test_labels_survive_a_round_trip(name: str, scan: Scan, tmp_path: Path) -> None:
    labels = flagstone.Surface().segment(scan).labels
    io.write_labels(tmp_path / name, labels)
    assert np.array_equal(io.read_labels(tmp_path / name, len(scan)), labels)
    with pytest.raises(ValueError, match=str(len(scan))):
        io.read_labels(tmp_path / name, len(scan) + 1)


def test_labels_can_be_written_as_semantickitti_classes(tmp_path: Path) -> None:
    io.write_labels(tmp_path / "scan.label", [0, 1, 2, 3, 4], label_map="semantic-kitti")
    assert list(io.read_labels(tmp_path / "scan.label", 5)) == [0, 40, 0, 0, 0]


@pytest.mark.parametrize("labels", [[0, 5], [-1], [0.5], [[0]]])
def test_invalid_labels_are_not_written(labels: list[object], tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="integers from 0 to 4"):
        io.write_labels(tmp_path / "scan.label", labels)
    assert not (tmp_path / "scan.label").exists()


def test_names_determine_formats_and_scans() -> None:
    assert [io.format_of(name) for name in ("a.BIN", "a.pcd.bin", "a.pcd", "a.ply", "a.npy", "a.txt")] == [
        "raw",
        "raw",
        "pcd",
        "ply",
        "npy",
        None,
    ]
    assert io.is_scan_name("a.bin") and not io.is_scan_name("a_lidarseg.bin") and not io.is_scan_name(".a.bin")


def test_errors_name_the_columns_and_no_option(tmp_path: Path) -> None:
    file = tmp_path / "a.bin"
    file.write_bytes(bytes(28))
    with pytest.raises(ValueError, match=r"number of columns, and whether the file is truncated\)$") as raised:
        io.read(file)
    assert "--columns" not in str(raised.value)
    with pytest.raises(ValueError, match=r"2000 floats per point \(expected 3 to 1024 columns, or 0"):
        io.read(file, columns=2000)
    with pytest.raises(TypeError, match=r"^columns: 'x' is not an integer$"):
        io.read(file, columns="x")  # type: ignore[arg-type]


def test_organized_clouds_are_written_row_by_row(tmp_path: Path) -> None:
    flat = np.arange(120, dtype=np.float32).reshape(30, 4)
    records = np.zeros((5, 6), [("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4")])
    for i, name in enumerate(records.dtype.names or ()):
        records[name] = flat[:, i].reshape(5, 6)
    for points in (flat.reshape(5, 6, 4), records):
        io.write(tmp_path / "a.bin", points)
        assert np.array_equal(np.fromfile(tmp_path / "a.bin", np.float32).reshape(-1, 4), flat)
