# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`segment` accepts any type of points, zero-copy if possible, and gives the same labels."""

from __future__ import annotations

import array
import enum
import subprocess
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pandas
import pytest
from conftest import Scan, random_scan
from hypothesis import given, settings
from hypothesis import strategies as st

import flagstone
from flagstone import _command, _core
from flagstone._points import columns_of

SURFACE = flagstone.Surface(sensor_height=1.73)


def structured(scan: Scan, dtype: npt.DTypeLike) -> npt.NDArray[np.void]:
    out = np.zeros(len(scan), dtype)
    for i, name in enumerate("xyz"):
        out[name] = scan[:, i]
    return out


def inside(scan: Scan, dtype: npt.DTypeLike = np.float32) -> npt.NDArray[np.float32]:
    """A view of columns 2 to 4 of a wider array."""
    wide = np.full((len(scan), 7), np.nan, dtype)
    wide[:, 2:5] = scan[:, :3]
    return wide[:, 2:5]


# float32 in any layout is zero-copy.
IN_PLACE: dict[str, Callable[[Scan], object]] = {
    "rows of four": lambda scan: scan,
    "rows of three": lambda scan: np.ascontiguousarray(scan[:, :3]),
    "columns one after the other": np.asfortranarray,
    "inside a wider array": inside,
    "from the last to the first": lambda scan: np.ascontiguousarray(scan[::-1])[::-1],
    "every other row of a larger array": lambda scan: np.repeat(scan, 2, axis=0)[::2],
    "read-only": lambda scan: np.frombuffer(scan.tobytes(), np.float32).reshape(-1, 4),
    "records": lambda scan: structured(scan, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("ring", "u2")]),
    "records in another order": lambda scan: structured(scan, [("ring", "u1"), ("z", "f4"), ("y", "f4"), ("x", "f4")]),
    "a memory view": lambda scan: memoryview(scan),
}
CONVERTED: dict[str, Callable[[Scan], object]] = {
    "float64": lambda scan: scan.astype(np.float64),
    "float64 inside a wider array": lambda scan: inside(scan, np.float64),
    "the other byte order": lambda scan: scan.astype(">f4"),
    "records of float64": lambda scan: structured(scan, [("x", "f8"), ("y", "f8"), ("z", "f8")]),
    "a frame": lambda scan: pandas.DataFrame(scan[:, [3, 0, 2, 1]], columns=["intensity", "x", "z", "y"]),
    "lists": lambda scan: scan.astype(np.float64).tolist(),
}


@pytest.fixture(scope="module")
def expected(scan: Scan) -> npt.NDArray[np.uint8]:
    return SURFACE.segment(scan).labels.copy()


@pytest.mark.parametrize("layout", IN_PLACE | CONVERTED)
def test_every_layout_gives_the_same_labels(layout: str, scan: Scan, expected: npt.NDArray[np.uint8]) -> None:
    points = (IN_PLACE | CONVERTED)[layout](scan)
    assert np.array_equal(SURFACE.segment(points).labels, expected)


@pytest.mark.parametrize("layout", IN_PLACE)
def test_float32_is_zero_copy(layout: str, scan: Scan) -> None:
    points = IN_PLACE[layout](scan)
    memory = points if isinstance(points, np.ndarray) else np.asarray(points)
    first_x = memory["x"] if memory.dtype.names else memory[:, 0]
    assert _core.address_of(*columns_of(points)) == first_x.__array_interface__["data"][0]


def test_rows_of_float32_take_the_fast_path(scan: Scan) -> None:
    for layout in ("rows of four", "columns one after the other", "inside a wider array", "a memory view"):
        points = IN_PLACE[layout](scan)
        assert _core.address_of_rows(points) == np.asarray(points).__array_interface__["data"][0], layout
    for layout in CONVERTED:
        assert _core.address_of_rows(CONVERTED[layout](scan)) == 0, layout
    for what in WRONG:
        assert _core.address_of_rows(WRONG[what][0]) == 0, what


def test_a_cpu_tensor_is_zero_copy(scan: Scan, expected: npt.NDArray[np.uint8]) -> None:
    torch = pytest.importorskip("torch")
    tensor = torch.from_numpy(scan)
    assert np.array_equal(SURFACE.segment(tensor).labels, expected)
    assert _core.address_of(*columns_of(tensor)) == tensor.data_ptr()


class DLPackOnly:
    """An array of another library that supports only DLPack."""

    def __init__(self, scan: Scan, device: object = 1) -> None:
        self._scan, self._device = scan, device

    def __dlpack__(self, **arguments: object) -> object:
        return self._scan.__dlpack__(**arguments)

    def __dlpack_device__(self) -> tuple[object, int]:
        return self._device, 0


def test_objects_with_dlpack_are_zero_copy(scan: Scan, expected: npt.NDArray[np.uint8]) -> None:
    points = DLPackOnly(scan)
    assert np.array_equal(SURFACE.segment(points).labels, expected)
    assert _core.address_of(*columns_of(points)) == scan.ctypes.data


class DeviceType(enum.Enum):
    """Device types as in Open3D: an enum without int()."""

    CPU = 1
    CUDA = 2


def test_dlpack_devices_can_be_enums(scan: Scan, expected: npt.NDArray[np.uint8]) -> None:
    assert np.array_equal(SURFACE.segment(DLPackOnly(scan, DeviceType.CPU)).labels, expected)
    assert np.array_equal(SURFACE.segment(DLPackOnly(scan, object())).labels, expected)
    with pytest.raises(TypeError, match=r"DLPackOnly is in the memory of another device.*\.cpu\(\)"):
        SURFACE.segment(DLPackOnly(scan, DeviceType.CUDA))


def test_a_table_of_pyarrow_is_read_by_its_columns(scan: Scan, expected: npt.NDArray[np.uint8]) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table({name: scan[:, i] for i, name in enumerate(("x", "y", "z", "intensity"))})
    assert np.array_equal(SURFACE.segment(table).labels, expected)
    with pytest.raises(
        ValueError, match=r"no field named z \(expected x, y and z, .*; found x, y, intensity\)"
    ) as raised:
        SURFACE.segment(table.drop_columns("z"))
    assert len(str(raised.value)) < 200


def test_laspy_data_is_rejected_with_a_hint() -> None:
    laspy = pytest.importorskip("laspy")
    with pytest.raises(
        TypeError, match=r"LasData of laspy contains map coordinates.*flagstone\.io\.read\(FILE, origin="
    ):
        SURFACE.segment(laspy.create())


@pytest.mark.parametrize("layout", ["rows of four", "inside a wider array", "float64", "records", "records of float64"])
def test_an_organized_cloud_has_labels_row_by_row(layout: str, scan: Scan, expected: npt.NDArray[np.uint8]) -> None:
    flat = (IN_PLACE | CONVERTED)[layout](scan)
    assert isinstance(flat, np.ndarray)
    organized = flat.reshape(100, len(scan) // 100, *flat.shape[1:])
    assert np.array_equal(SURFACE.segment(organized).labels, expected)
    if layout in IN_PLACE:
        first_x = flat["x"] if flat.dtype.names else flat[:, 0]
        assert _core.address_of(*columns_of(organized)) == first_x.__array_interface__["data"][0]


def test_a_scan_in_millimetres_causes_one_warning(scan: Scan) -> None:
    segmenter = flagstone.Surface()
    with pytest.warns(UserWarning, match=r"20000 of 20000 points are out of range.*flagstone doctor") as warned:
        segmenter.segment(scan * 1000)
        segmenter.segment(scan * 1000)
    assert len(warned) == 1 and warned[0].filename == __file__
    in_metres = flagstone.Surface(mount={"scale": 0.001}).segment(scan * 1000)
    assert np.mean(in_metres.labels == segmenter.segment(scan).labels) > 0.999


def test_small_clouds_and_scans_half_out_of_range_cause_no_warning(scan: Scan) -> None:
    far = scan.copy()
    far[::2, 0] += 1000
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        flagstone.Surface().segment(far)
        flagstone.Surface().segment(1000 * scan[:100])


@settings(deadline=None, max_examples=50)
@given(
    rows=st.slices(300),
    first=st.integers(0, 4),
    transposed=st.booleans(),
    seed=st.integers(0, 2**32 - 1),
)
def test_any_slice_gets_the_labels_of_its_copy(rows: slice, first: int, transposed: bool, seed: int) -> None:
    whole = np.random.default_rng(seed).normal(0, 10, (300, 8)).astype(np.float32)
    whole = whole.copy(order="F") if transposed else whole
    view = whole[rows, first : first + 3]
    ours, copied = SURFACE.segment(view), SURFACE.segment(view.copy())
    assert np.array_equal(ours.labels, copied.labels)
    assert np.array_equal(ours.heights, copied.heights, equal_nan=True)


WRONG: dict[str, tuple[object, type[Exception], str]] = {
    "three rows": (np.zeros((3, 5000), np.float32), ValueError, r"shape \(3, 5000\).*\(N, 3\).*pass points\.T"),
    "two columns": (np.zeros((9, 2), np.float32), ValueError, r"shape \(9, 2\).*\(N, 3\)"),
    "two coordinates of rows": (np.zeros((3, 2), np.float32), ValueError, r"shape \(3, 2\).*pass points\.T"),
    "one axis": (np.zeros(12, np.float32), ValueError, r"shape \(12,\).*\(N, 3\)"),
    "an image of two channels": (np.zeros((9, 9, 2), np.float32), ValueError, r"shape \(9, 9, 2\)"),
    "channels before rows": (np.zeros((5, 64, 99), np.float32), ValueError, r"shape \(5, 64, 99\).*numpy\.moveaxis"),
    "four axes": (np.zeros((2, 9, 9, 3), np.float32), ValueError, r"shape \(2, 9, 9, 3\)"),
    "integers": (np.zeros((9, 3), np.int32), TypeError, r"int32.*astype\(numpy\.float32\)"),
    "half precision": (np.zeros((9, 3), np.float16), TypeError, r"float16.*astype"),
    "booleans": (np.zeros((9, 3), bool), TypeError, r"bool.*float32 or float64"),
    "complex numbers": (np.zeros((9, 3), complex), TypeError, r"complex128.*float32 or float64"),
    "objects": (np.full((9, 3), None), TypeError, r"object.*float32 or float64"),
    "None": (None, ValueError, r"NoneType of shape \(\)"),
    "an empty list": ([], ValueError, r"list of shape \(0,\)"),
    "rows of different length": ([[1.0, 2, 3], [4.0]], TypeError, r"list is not an array"),
    "a path": ("scan.bin", TypeError, r"'scan\.bin' is a path.*segment\(flagstone\.io\.read\('scan\.bin'\)\)"),
    "bytes": (array.array("f", [1, 2, 3]), ValueError, r"array of shape \(3,\)"),
    "records of many fields": (
        np.zeros(9, [(f"c{i}", "f4") for i in range(20)]),
        ValueError,
        "found c0, c1, c2, c3, c4, c5, c6, c7 and 12 more",
    ),
    "records without z": (np.zeros(9, [("x", "f4"), ("y", "f4")]), ValueError, r"no field named z .*found x, y\)"),
    "records of integers": (np.zeros(9, [("x", "i4"), ("y", "i4"), ("z", "i4")]), TypeError, r"field x: .*int32"),
    "records of vectors": (np.zeros(9, [("x", "3f4"), ("y", "f4"), ("z", "f4")]), ValueError, r"field x has shape"),
    "a frame without names": (pandas.DataFrame(np.zeros((9, 3))), ValueError, r"no field named x or y or z "),
    "a frame of integers": (pandas.DataFrame({"x": [1], "y": [2], "z": [3]}), TypeError, r"field x: .*int64"),
    "a tensor on a GPU": (DLPackOnly(random_scan(9), device=2), TypeError, r"another device.*\.cpu\(\)"),
}


@pytest.mark.parametrize("what", WRONG)
def test_invalid_points_raise_one_line_errors(what: str) -> None:
    points, error, message = WRONG[what]
    with pytest.raises(error, match=message) as raised:
        SURFACE.segment(points)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_an_empty_scan_has_an_empty_result(dtype: npt.DTypeLike) -> None:
    result = SURFACE.segment(np.empty((0, 3), dtype))
    assert len(result) == len(result.labels) == len(result.ground) == len(result.heights) == 0
    assert len(result.patches) == 0


def test_points_that_are_not_finite_are_invalid_and_keep_their_index(scan: Scan) -> None:
    holed = scan.copy()
    holed[::7, 0] = np.nan
    holed[3::7, 2] = np.inf
    holed[5::7, :3] = 0
    invalid = ~np.isfinite(holed[:, :3]).all(1) | (holed[:, :3] == 0).all(1)
    result = SURFACE.segment(holed)
    assert np.array_equal(result.labels == flagstone.Label.INVALID, invalid)
    assert np.isnan(result.heights[invalid]).all()


def test_labels_are_identical_to_the_command(simulated: Path, tmp_path: Path) -> None:
    scans = simulated / "sequences" / "00" / "velodyne"
    for method in ("surface", "patchwork"):
        folder = tmp_path / method
        command = [_command.path(), "segment", scans, "--output", folder, "--method", method, "--sensor-height", "0.6"]
        subprocess.run(command, check=True, capture_output=True)
        segmenter = flagstone.make_segmenter(method, sensor_height=0.6)
        for file in sorted(scans.iterdir()):
            labels = segmenter.segment(flagstone.io.read(file)).labels
            assert labels.astype("<u4").tobytes() == (folder / file.with_suffix(".label").name).read_bytes()
