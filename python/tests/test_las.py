# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.io` reads and writes LAS and LAZ."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from las_files import laspy, point_formats, write_random_las

from flagstone.io import read, write

endings = ("las", "laz")


@pytest.mark.parametrize("ending", endings)
@pytest.mark.parametrize("point_format", point_formats)
def test_every_dimension_of_every_point_format_is_read(tmp_path: Path, point_format: int, ending: str) -> None:
    file = tmp_path / f"a.{ending}"
    write_random_las(file, point_format)
    las = laspy.read(file)
    points = read(file)
    names = [name for name in las.point_format.dimension_names if name not in ("X", "Y", "Z")]
    assert points.dtype.names == ("x", "y", "z", *names)
    assert len(points) == 1000
    for name in points.dtype.names:
        assert np.asarray(las[name]).tobytes() == np.ascontiguousarray(points[name]).tobytes(), name


def test_the_origin_is_subtracted_in_double_precision(tmp_path: Path) -> None:
    file = tmp_path / "a.las"
    sensor = np.array([690_123.4, 5_336_789.1, 519.9])
    near = np.array([[1.234, -2.345, -1.73], [80.001, 0.004, -1.5]])
    write(file, near + sensor)
    points = read(file, origin=sensor)
    assert points["x"].dtype == np.float64
    for i, axis in enumerate("xyz"):
        assert np.abs(points[axis].astype(np.float32) - near[:, i]).max() < 0.00052  # half a millimetre, plus rounding


def test_scaled_extra_bytes_are_read_as_scaled_values(tmp_path: Path) -> None:
    file = tmp_path / "a.las"
    header = laspy.LasHeader(point_format=6)
    header.add_extra_dim(laspy.ExtraBytesParams("range", "u2", scales=np.array([0.01]), offsets=np.array([5.0])))
    las = laspy.LasData(header)
    las.x = las.y = las.z = np.zeros(3)
    las["range"] = np.array([5.0, 6.25, 300.0])
    las.write(file)
    assert read(file)["range"].tolist() == pytest.approx([5.0, 6.25, 300.0])


@pytest.mark.parametrize("ending", endings)
def test_a_file_without_points_is_an_empty_array(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"a.{ending}"
    write_random_las(file, 6, count=0)
    assert len(read(file)) == 0


@pytest.mark.parametrize("ending", endings)
def test_fields_survive_a_round_trip(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"a.{ending}"
    random = np.random.default_rng(1)
    kind = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "u2"), ("gps_time", "f8"), ("ring", "u1")]
    points = np.zeros(500, [*kind, ("velocity", "f4", (3,))])
    for name in points.dtype.names or ():
        points[name] = random.uniform(0, 100, points[name].shape)
    write(file, points, labels=np.resize([0, 1, 2, 3, 4], 500), heights=np.where(points["x"] < 50, points["z"], np.nan))
    again = read(file)
    for axis in "xyz":
        assert np.abs(again[axis] - points[axis]).max() <= 0.0005 + 1e-6
    for name in ("intensity", "gps_time", "ring", "velocity"):
        assert np.array_equal(again[name], points[name]), name
    assert again["classification"].tolist() == np.resize([1, 2, 7, 0, 0], 500).tolist()
    assert np.array_equal(again["height"], np.where(points["x"] < 50, points["z"], np.nan), equal_nan=True)


@pytest.mark.parametrize("point_format", point_formats)
def test_all_fields_of_a_file_can_be_written(tmp_path: Path, point_format: int) -> None:
    write_random_las(tmp_path / "a.las", point_format)
    points = read(tmp_path / "a.las")
    for axis in "xyz":
        points[axis] = 0  # the range of random coordinates is too large for millimetres
    write(tmp_path / "b.las", points)
    again = read(tmp_path / "b.las")
    for name in set(points.dtype.names or ()) - set("xyz"):
        assert np.array_equal(points[name], again[name], equal_nan=points[name].dtype.kind == "f"), name


def test_colours_choose_the_point_format(tmp_path: Path) -> None:
    file = tmp_path / "a.las"
    colours = [(name, "u2") for name in ("red", "green", "blue", "nir")]
    for fields, point_format in ((colours[:0], 6), (colours[:3], 7), (colours, 8)):
        write(file, np.zeros(2, [("x", "f8"), ("y", "f8"), ("z", "f8"), *fields]))
        with laspy.open(file) as reader:
            assert reader.header.point_format.id == point_format
            assert str(reader.header.version) == "1.4"


def test_intensity_from_0_to_1_is_scaled_to_16_bits(tmp_path: Path) -> None:
    file = tmp_path / "a.las"
    write(file, np.array([[1, 2, 3, 0.0], [1, 2, 3, 0.5], [1, 2, 3, 1.0]], np.float32))
    assert read(file)["intensity"].tolist() == [0, 32768, 65535]


def test_labels_change_an_existing_classification_by_the_rule(tmp_path: Path) -> None:
    file = tmp_path / "a.las"
    points = np.zeros(4, [("x", "f8"), ("y", "f8"), ("z", "f8"), ("classification", "u1")])
    points["classification"] = [6, 2, 1, 7]
    write(file, points)
    assert read(file)["classification"].tolist() == [6, 2, 1, 7]
    write(file, points, labels=np.array([1, 0, 1, 3]))
    assert read(file)["classification"].tolist() == [6, 1, 2, 7]


def structured(**fields: Any) -> np.ndarray[Any, Any]:
    kinds = [(name, np.asarray(values).dtype, np.asarray(values).shape[1:]) for name, values in fields.items()]
    points = np.zeros(len(fields["x"]), kinds)
    for name, values in fields.items():
        points[name] = values
    return points


xyz = {axis: np.zeros(2) for axis in "xyz"}


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.zeros((3, 2)), r"points: shape \(3, 2\) is not supported \(expected \(N, 3\) or more columns"),
        (structured(x=[1.0], y=[1.0]), r"points: no field named z \(expected x, y and z"),
        (np.array([[0, 0, 0], [0, np.nan, 0]]), r"points: y of point 1 is nan \(LAS stores only finite coordinates"),
        (
            np.array([[0, 0, 0], [1e9, 0, 0]]),
            r"points: x ranges from 0 to 1e.09 m \(in millimetres LAS can span at most 2147 km",
        ),
        (structured(**xyz, X=[1, 2]), r"points: field X is reserved \(LAS stores x under this name"),
        (structured(**xyz, intensity=[1, 70_000]), r"intensity of point 1 is 70000 \(expected an integer from 0 to 65"),
        (
            structured(**xyz, return_number=[16, 1]),
            r"return_number of point 0 is 16 \(expected an integer from 0 to 15",
        ),
        (structured(**xyz, user_data=[0.5, 1.0]), r"user_data of point 0 is 0.5 \(expected an integer from 0 to 255"),
        (structured(**xyz, name=["a", "b"]), "field name has dtype <U1, which LAS cannot store"),
        (structured(**xyz, beams=np.zeros((2, 4))), "field beams does not fit into LAS"),
    ],
)
def test_fields_that_las_cannot_store_raise_one_line_errors(tmp_path: Path, points: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        write(tmp_path / "a.las", points)
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_labels_and_heights_must_match_the_points(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"labels: shape \(2,\) does not match 3 points \(expected \(3,\)"):
        write(tmp_path / "a.las", np.zeros((3, 3)), labels=np.zeros(2, np.uint8))
    with pytest.raises(ValueError, match=r"heights: shape \(3, 1\) does not match 3 points \(expected \(3,\)"):
        write(tmp_path / "a.las", np.zeros((3, 3)), heights=np.zeros((3, 1)))


def test_an_origin_must_be_three_finite_numbers(tmp_path: Path) -> None:
    write_random_las(tmp_path / "a.las", 6)
    for origin in ([1, 2], [1, 2, float("nan")]):
        with pytest.raises(ValueError, match=r"origin: .* is not a position \(expected three finite numbers"):
            read(tmp_path / "a.las", origin=origin)


def test_missing_files_and_other_formats_are_errors(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.las"):
        read(tmp_path / "none.las")
    (tmp_path / "a.las").write_bytes(b"ply\n" * 1000)
    with pytest.raises(ValueError, match=r"a\.las: no LAS header \(expected the signature LASF"):
        read(tmp_path / "a.las")


def test_a_truncated_las_file_is_an_error_with_both_sizes(tmp_path: Path) -> None:
    file = tmp_path / "a.las"
    write_random_las(file, 0)
    file.write_bytes(file.read_bytes()[:20_000])
    with pytest.raises(
        ValueError, match=r"1,000 points of 27 bytes need .* bytes, but the file has 20,000 \(the file is truncated"
    ):
        read(file)


@pytest.mark.parametrize("ending", endings)
def test_damaged_files_raise_one_line_errors_or_are_read(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"a.{ending}"
    random = np.random.default_rng(5)
    refused = 0
    for point_format in point_formats:
        write_random_las(file, point_format, count=50)
        whole = file.read_bytes()
        for _ in range(10):
            damaged = bytearray(
                whole if random.random() < 0.5 else whole[: random.integers(len(whole) // 2, len(whole))]
            )
            for at in (*random.integers(0, 400, 2), *random.integers(-400, 0, 2)):  # header, records, chunk table
                damaged[at] = random.integers(0, 256)
            file.write_bytes(damaged)
            try:
                read(file)
            except ValueError as error:
                assert str(error).startswith(f"{file}: ") and "\n" not in str(error)
                refused += 1
            except MemoryError:  # the damaged number of points is valid for LAZ
                refused += 1
    assert refused > 20


@pytest.mark.parametrize("ending", endings)
def test_a_full_disk_leaves_no_file(tmp_path: Path, ending: str) -> None:
    program = (
        "import numpy, resource, signal, sys, flagstone.io\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))\n"
        "try: flagstone.io.write(sys.argv[1], numpy.random.default_rng(1).random((50_000, 3)))\n"
        "except OSError as error: print(error)\n"
    )
    file = tmp_path / f"a.{ending}"
    done = subprocess.run([sys.executable, "-c", program, file], capture_output=True, text=True)
    assert done.stdout == f"[Errno 27] File too large: '{file}'\n", done.stderr
    assert list(tmp_path.iterdir()) == []


def test_without_laspy_the_error_names_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_random_las(tmp_path / "a.las", 6)
    monkeypatch.setitem(sys.modules, "laspy", None)
    with pytest.raises(
        ImportError, match=r"laspy is not installed, but this function needs it: pip install 'flagstone\[las\]'"
    ):
        read(tmp_path / "a.las")
