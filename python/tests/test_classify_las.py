# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.io.classify_las` sets the classes of a LAS file and changes nothing else."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from las_files import laspy, point_formats, set_classes, write_copc, write_random_las

from flagstone import _las_classify
from flagstone.io import classify_las

GROUND, NONGROUND, NOISE, OUT_OF_RANGE, INVALID = 1, 0, 2, 3, 4
endings = ("las", "laz")


def random_labels(count: int, seed: int = 2) -> np.ndarray[Any, Any]:
    return np.random.default_rng(seed).integers(0, 5, count, np.uint8)


def class_of(before: int, label: int, overwrite_classes: set[int]) -> int:
    """The rule for one point."""
    if before not in overwrite_classes or label in (OUT_OF_RANGE, INVALID):
        return before
    if label == GROUND:
        return 2
    if label == NOISE:
        return 7
    return 1 if before in (0, 2, 7) else before


@pytest.mark.parametrize("ending", endings)
@pytest.mark.parametrize("point_format", point_formats)
def test_points_get_the_class_of_the_rule(tmp_path: Path, point_format: int, ending: str) -> None:
    source, copy = tmp_path / f"a.{ending}", tmp_path / f"b.{ending}"
    write_random_las(source, point_format)
    before = np.asarray(laspy.read(source).classification)
    labels = random_labels(len(before))
    random = np.random.default_rng(point_format)
    for overwrite_classes in ({0, 1, 2, 7}, set(), set(range(256)), set(random.integers(0, 32, 9).tolist())):
        counts = classify_las(source, copy, labels, overwrite_classes=overwrite_classes)
        after = np.asarray(laspy.read(copy).classification)
        assert after.tolist() == [
            class_of(*each, overwrite_classes) for each in zip(before.tolist(), labels.tolist(), strict=True)
        ]
        assert counts == dict(zip(*(each.tolist() for each in np.unique(after, return_counts=True)), strict=True))


@pytest.mark.parametrize("point_format", point_formats)
def test_only_the_class_bits_of_a_las_file_change(tmp_path: Path, point_format: int) -> None:
    source, copy = tmp_path / "a.las", tmp_path / "b.las"
    write_random_las(source, point_format)
    labels = random_labels(1000)
    classify_las(source, copy, labels, overwrite_classes=range(256))
    before, after = (np.frombuffer(file.read_bytes(), np.uint8) for file in (source, copy))
    with laspy.open(source) as reader:
        begin, row = reader.header.offset_to_point_data, reader.header.point_format.size
    class_byte, class_bits = (15, 0x1F) if point_format < 6 else (16, 0xFF)
    allowed = np.zeros(len(before), np.uint8)
    allowed[begin + class_byte : begin + 1000 * row : row] = class_bits
    assert len(after) == len(before)
    assert (before ^ after).any()
    assert not ((before ^ after) & ~allowed).any()


@pytest.mark.parametrize("point_format", point_formats)
def test_a_laz_file_keeps_everything_else(tmp_path: Path, point_format: int) -> None:
    source, copy = tmp_path / "a.laz", tmp_path / "b.laz"
    write_random_las(source, point_format)
    classify_las(source, copy, random_labels(1000), overwrite_classes=range(256))
    with laspy.open(source) as before, laspy.open(copy) as after:
        begin = before.header.offset_to_point_data
        moved = slice(227, 243) if str(before.header.version) == "1.4" else slice(0, 0)
        heads = [bytearray(file.read_bytes()[:begin]) for file in (source, copy)]
        for head in heads:  # offsets of the records after the points
            head[moved] = b""
        assert heads[0] == heads[1]
        assert [record.record_data for record in before.header.evlrs or []] == [
            record.record_data for record in after.header.evlrs or []
        ]
        points, others = before.read().points, after.read().points
    set_aside = {"classification", "raw_classification"}
    assert not np.array_equal(points.classification, others.classification)
    for name in points.point_format.dimension_names:
        if name not in set_aside:
            assert np.asarray(points[name]).tobytes() == np.asarray(others[name]).tobytes(), name


def test_other_classes_are_kept_unless_overwriting_is_allowed(tmp_path: Path) -> None:
    file, copy = tmp_path / "a.las", tmp_path / "b.las"
    write_random_las(file, 6)
    others = np.setdiff1d(np.arange(256, dtype=np.uint8), [0, 1, 2, 7])
    set_classes(file, np.resize(others, 1000))
    before = file.read_bytes()
    for label in (GROUND, NONGROUND, NOISE):
        classify_las(file, copy, np.full(1000, label))
        assert copy.read_bytes() == before
    classify_las(file, copy, np.full(1000, GROUND), overwrite_classes=range(256))
    assert (laspy.read(copy).classification == 2).all()


@pytest.mark.parametrize("ending", endings)
def test_many_points_are_processed_in_blocks(tmp_path: Path, ending: str, monkeypatch: pytest.MonkeyPatch) -> None:
    source, whole, parts = (tmp_path / f"{name}.{ending}" for name in "abc")
    write_random_las(source, 6, count=1003)
    labels = random_labels(1003)
    classify_las(source, whole, labels)
    monkeypatch.setattr(_las_classify, "points_at_once", 100)
    classify_las(source, parts, labels)
    assert whole.read_bytes() == parts.read_bytes()


def test_laz_chunks_of_variable_size_are_kept(tmp_path: Path) -> None:
    import lazrs

    source, copy = tmp_path / "a.laz", tmp_path / "b.laz"
    write_random_las(source, 6, count=1000)
    las = laspy.read(source)
    with source.open("wb") as file:
        kind = lazrs.LazVlr.new_for_compression(6, las.point_format.num_extra_bytes, True)
        header = las.header
        header.are_points_compressed, header.number_of_evlrs, header.start_of_first_evlr = True, 0, 0
        header.vlrs.append(laspy.vlrs.known.LasZipVlr(kind.record_data()))
        header.write_to(file)
        compressor = lazrs.LasZipCompressor(file, kind)
        for part in (slice(0, 10), slice(10, 700), slice(700, 1000)):
            if part.start > 0:
                compressor.finish_current_chunk()
            compressor.compress_many(np.frombuffer(las.points.array[part].tobytes(), np.uint8))
        compressor.done()
    labels = random_labels(1000)
    classify_las(source, copy, labels)
    with laspy.open(copy) as reader:
        parameters = reader.header.vlrs.get("LasZipVlr")[0].record_data
        begin = reader.header.offset_to_point_data
    with copy.open("rb") as file:
        file.seek(begin)
        chunks = lazrs.read_chunk_table(file, lazrs.LazVlr(parameters))
    assert [points for points, _ in chunks] == [10, 690, 300]
    assert np.array_equal(laspy.read(copy).gps_time, las.gps_time, equal_nan=True)


@pytest.mark.parametrize("ending", endings)
def test_a_file_without_points_is_copied(tmp_path: Path, ending: str) -> None:
    source, copy = tmp_path / f"a.{ending}", tmp_path / f"b.{ending}"
    write_random_las(source, 6, count=0)
    assert classify_las(source, copy, np.zeros(0, np.uint8)) == {}
    assert copy.read_bytes() == source.read_bytes()


def test_a_lossy_compression_is_detected_and_the_destination_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import lazrs

    class Careless:
        def __init__(self, *arguments: Any) -> None:
            self.compressor = careful(*arguments)

        def compress_many(self, points: np.ndarray[Any, Any]) -> None:
            self.compressor.compress_many(points ^ (np.arange(len(points)) == 12_345).astype(np.uint8))

        def done(self) -> None:
            self.compressor.done()

    careful = lazrs.ParLasZipCompressor
    file, copy = tmp_path / "a.laz", tmp_path / "b.laz"
    write_random_las(file, 6)
    copy.write_bytes(b"before")
    monkeypatch.setattr(lazrs, "ParLasZipCompressor", Careless)
    with pytest.raises(ValueError, match=r"a\.laz: lazrs cannot compress this file without loss .convert it to LAS"):
        classify_las(file, copy, np.full(1000, GROUND))
    assert copy.read_bytes() == b"before"


def test_labels_that_do_not_match_raise_one_line_errors(tmp_path: Path) -> None:
    source, copy = tmp_path / "a.las", tmp_path / "b.las"
    write_random_las(source, 6)
    with pytest.raises(ValueError, match=r"a\.las: 999 labels do not match 1,000 points"):
        classify_las(source, copy, np.zeros(999, np.uint8))
    with pytest.raises(ValueError, match=r"labels: point 3 has 5 \(expected codes of flagstone.Label, 0 to 4"):
        classify_las(source, copy, np.array([0, 1, 2, 5]))
    with pytest.raises(TypeError, match=r"labels: dtype float64 is not supported"):
        classify_las(source, copy, np.zeros(1000))
    with pytest.raises(ValueError, match=r"labels: shape \(10, 100\) is not supported \(expected \(N,\)"):
        classify_las(source, copy, np.zeros((10, 100), np.uint8))
    with pytest.raises(ValueError, match=r"b\.other has another extension than the source \(expected \.las"):
        classify_las(source, tmp_path / "b.other", np.zeros(1000, np.uint8))
    with pytest.raises(
        ValueError, match=r"overwrite_classes: 256 is not a LAS class \(expected integers from 0 to 255"
    ):
        classify_las(source, copy, np.zeros(1000, np.uint8), overwrite_classes=[256])
    assert not copy.exists()


def test_the_index_of_a_copied_copc_file_finds_the_same_points(tmp_path: Path) -> None:
    source, copy = tmp_path / "a.copc.laz", tmp_path / "b.copc.laz"
    write_copc(source)
    classify_las(source, copy, np.full(len(laspy.read(source)), GROUND), overwrite_classes=range(256))
    assert (laspy.read(copy).classification == 2).all()
    places = []
    for file in (source, copy):
        in_order = laspy.read(file).points.array
        with laspy.CopcReader.open(file) as reader:
            by_index = [reader.query(level=level).array for level in range(3)]
            places.append([entry.offset for entry in reader.root_page.entries.values()])
        assert sum(map(len, by_index)) == len(in_order)
        for found in by_index:
            assert len(found) > 0
            assert found.tobytes() == in_order[found["gps_time"].astype(int)].tobytes()
    assert places[0] != places[1]  # otherwise the test shows nothing


def test_a_copc_file_with_a_damaged_index_is_rejected(tmp_path: Path) -> None:
    source = tmp_path / "a.copc.laz"
    write_copc(source)
    damaged = bytearray(source.read_bytes())
    damaged[-16] ^= 1  # offset of the chunk of the last node
    source.write_bytes(damaged)
    with pytest.raises(ValueError, match=r"a\.copc\.laz: the COPC index does not match the chunks"):
        classify_las(source, tmp_path / "b.copc.laz", random_labels(laspy.open(source).header.point_count))
    assert [path.name for path in tmp_path.iterdir()] == ["a.copc.laz"]


@pytest.mark.parametrize("link", [None, Path.hardlink_to, Path.symlink_to])
def test_the_source_is_not_overwritten(tmp_path: Path, link: Callable[[Path, Path], None] | None) -> None:
    source, other = tmp_path / "a.copc.laz", tmp_path / "b.laz"
    write_copc(source)
    before = source.read_bytes()
    if link is not None:
        link(other, source)
    with pytest.raises(ValueError, match=r"destination: .*\.laz is the source \(choose another file"):
        classify_las(source, source if link is None else other, random_labels(laspy.open(source).header.point_count))
    assert source.read_bytes() == before


def test_a_damaged_chunk_table_is_rejected_before_memory_is_allocated(tmp_path: Path) -> None:
    source = tmp_path / "a.copc.laz"
    write_copc(source)
    whole = source.read_bytes()
    with laspy.open(source) as reader:
        begin, count = reader.header.offset_to_point_data, reader.header.point_count
    table = int.from_bytes(whole[begin : begin + 8], "little")
    random = np.random.default_rng(4)
    refused = 0
    for _ in range(60):
        damaged = bytearray(whole)
        damaged[random.integers(table, table + 30)] = random.integers(0, 256)
        source.write_bytes(damaged)
        try:
            classify_las(source, tmp_path / "b.laz", random_labels(count))
        except ValueError as error:
            assert "\n" not in str(error)
            refused += 1
    assert refused > 10


def test_las_in_compatibility_mode_is_rejected(tmp_path: Path) -> None:
    source = tmp_path / "a.laz"
    write_random_las(source, 6)
    las = laspy.read(source)
    las.header.vlrs.append(laspy.VLR("lascompatible", 22204, "", b"\0" * 156))
    las.write(source)
    with pytest.raises(ValueError, match=r"LAS 1.4 in compatibility mode is not supported"):
        classify_las(source, tmp_path / "b.laz", np.zeros(1000, np.uint8))


@pytest.mark.parametrize("ending", endings)
def test_a_truncated_source_leaves_the_destination_unchanged(tmp_path: Path, ending: str) -> None:
    source, destination = tmp_path / f"a.{ending}", tmp_path / f"b.{ending}"
    write_random_las(source, 6)
    destination.write_bytes(b"what was there")
    whole = source.read_bytes()
    for size in (0, 100, 300, 1000, len(whole) // 2):
        source.write_bytes(whole[:size])
        with pytest.raises(ValueError, match=rf"a\.{ending}: .*") as caught:
            classify_las(source, destination, np.zeros(1000, np.uint8))
        assert "\n" not in str(caught.value)
        assert destination.read_bytes() == b"what was there"
        assert {file.name for file in tmp_path.iterdir()} == {source.name, destination.name}


def test_directories_and_missing_files_are_errors(tmp_path: Path) -> None:
    write_random_las(tmp_path / "a.las", 6)
    labels = np.zeros(1000, np.uint8)
    with pytest.raises(FileNotFoundError, match=r"none\.las"):
        classify_las(tmp_path / "none.las", tmp_path / "b.las", labels)
    with pytest.raises(FileNotFoundError, match=r"no/b\.las"):
        classify_las(tmp_path / "a.las", tmp_path / "no" / "b.las", labels)
    (tmp_path / "directory.las").mkdir()
    with pytest.raises(OSError, match=r"is not a regular file.*directory\.las"):
        classify_las(tmp_path / "a.las", tmp_path / "directory.las", labels)


def test_a_symbolic_link_is_followed(tmp_path: Path) -> None:
    file, copy, link = (tmp_path / f"{name}.las" for name in ("a", "b", "link"))
    write_random_las(file, 6)
    copy.touch()
    link.symlink_to(copy)
    classify_las(file, link, np.full(1000, GROUND), overwrite_classes=range(256))
    assert link.is_symlink()
    assert (laspy.read(copy).classification == 2).all()
