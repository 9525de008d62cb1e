# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Parts of flagstone.ray that do not need a running Ray."""

from __future__ import annotations

import errno
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import flagstone

pytest.importorskip("ray", reason="needs flagstone[ray]")
pa = pytest.importorskip("pyarrow")

import pyarrow.fs  # noqa: E402

import flagstone.ray  # noqa: E402
from flagstone import _command  # noqa: E402
from flagstone.ray import plan  # noqa: E402
from flagstone.ray.job import in_batches  # noqa: E402
from flagstone.ray.location import File, Location, is_object_store, location_of  # noqa: E402
from flagstone.ray.plan import label_bytes, label_name  # noqa: E402
from flagstone.ray.statistics import StatisticsWriter, read_rows, schema  # noqa: E402
from flagstone.ray.summary import Failure, Summary  # noqa: E402
from flagstone.ray.worker import InProgressLog, Task, label_file, one_line  # noqa: E402

HERE = pyarrow.fs.LocalFileSystem()


def rows_of(*rows: dict[str, object]) -> pa.Table:
    return pa.Table.from_pylist([{"error": None, **row} for row in rows], schema=schema())


@pytest.mark.parametrize(
    ("scan", "label"),
    [
        ("000000.bin", "000000.label"),
        ("a/b.v2.pcd", "a/b.v2.label"),
        ("a.b/c.pcd.bin", "a.b/c.label"),
        ("C.PCD.BIN", "C.label"),
    ],
)
def test_labels_are_named_after_their_scan(scan: str, label: str) -> None:
    assert label_name(scan, "label") == label
    assert label_name(scan, "u8") == label + ".npy"


@pytest.mark.parametrize("format", ["label", "u8"])
@pytest.mark.parametrize("label_map", ["flagstone", "semantic-kitti"])
@pytest.mark.parametrize("points", [0, 1, 9, 123_456])
def test_label_files_in_memory_are_identical_to_those_of_io(
    tmp_path: Path, format: str, label_map: str, points: int
) -> None:
    labels = np.random.default_rng(1).integers(0, 5, points, np.uint8)
    path = tmp_path / label_name("scan.bin", format)
    flagstone.io.write_labels(path, labels, label_map=label_map)
    assert label_file(labels, format, label_map) == path.read_bytes()
    assert label_bytes(points, format) == path.stat().st_size


@pytest.mark.parametrize("method", flagstone.method_names())
def test_workers_use_the_settings_of_the_segmenter(method: str) -> None:
    given = flagstone.make_segmenter(method, sensor="os0-128", sensor_height=1.5)
    task = Task(given.method, given.settings, Location("/a"), Location("/b"), "label", "flagstone", None)
    assert task.segmenter().settings == given.settings


class TestLocation:
    def test_a_path_is_local_and_absolute(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.chdir(tmp_path)
        assert (
            location_of("scans/")
            == location_of(tmp_path / "scans")
            == location_of(f"file://{tmp_path}/scans")
            == Location(str(tmp_path / "scans"))
        )

    def test_an_unknown_url_raises_a_one_line_error(self) -> None:
        with pytest.raises(ValueError, match=r"^nowhere://a/b: no filesystem supports this URL") as caught:
            location_of("nowhere://a/b")
        assert "\n" not in str(caught.value)

    @pytest.mark.parametrize("filesystem", [None, HERE])
    def test_lists_files_recursively(self, tmp_path: Path, filesystem: pyarrow.fs.FileSystem | None) -> None:
        (tmp_path / "a" / "b").mkdir(parents=True)
        (tmp_path / "a" / "b" / "c.bin").write_bytes(bytes(7))
        (tmp_path / "d.bin").write_bytes(b"")
        here = Location(str(tmp_path), filesystem)
        assert sorted(file[:2] for file in here.files()) == [("a/b/c.bin", 7), ("d.bin", 0)]
        assert all(file.modified == (tmp_path / file.name).stat().st_mtime_ns / 1e9 for file in here.files())
        assert list(here.below("none").files()) == []

    def test_does_not_follow_links_to_directories(self, tmp_path: Path) -> None:
        (tmp_path / "loop").symlink_to(tmp_path)
        (tmp_path / "a.bin").write_bytes(b"")
        (tmp_path / "b.bin").symlink_to(tmp_path / "a.bin")
        assert sorted(file.name for file in Location(str(tmp_path)).files()) == ["a.bin", "b.bin"]

    @pytest.mark.parametrize("filesystem", [None, HERE])
    def test_writes_files_atomically(self, tmp_path: Path, filesystem: pyarrow.fs.FileSystem | None) -> None:
        here = Location(str(tmp_path), filesystem)
        for data in (b"first", b"second, longer"):
            here.write("a/b/c.label", data)
            assert here.read("a/b/c.label") == data
        assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["c.label"]

    @pytest.mark.parametrize("filesystem", [None, HERE])
    def test_leaves_no_file_if_writing_fails(self, tmp_path: Path, filesystem: pyarrow.fs.FileSystem | None) -> None:
        (tmp_path / "c.label").mkdir()
        (tmp_path / "c.label" / "full").touch()
        with pytest.raises(OSError, match=r"c\.label"):
            Location(str(tmp_path), filesystem).write("c.label", b"data")
        assert [path.name for path in tmp_path.iterdir()] == ["c.label"]

    def test_recognises_object_stores_which_write_atomically(self) -> None:
        fsspec = pytest.importorskip("fsspec")
        assert is_object_store(pyarrow.fs.S3FileSystem(anonymous=True, region="eu-west-1"))
        assert not is_object_store(HERE)
        local = fsspec.filesystem("file")
        assert not is_object_store(pyarrow.fs.PyFileSystem(pyarrow.fs.FSSpecHandler(local)))
        local.protocol = ("gs", "gcs")
        assert is_object_store(pyarrow.fs.PyFileSystem(pyarrow.fs.FSSpecHandler(local)))


class TestInProgressLog:
    def test_counts_crashes_per_scan(self, tmp_path: Path) -> None:
        held = []
        for _ in range(2):  # the worker dies twice, each time while it processes scan b
            killed = InProgressLog(tmp_path / "notes")
            with killed.on("a"):
                pass
            held.append(killed.on("b\nc"))
            held[-1].__enter__()
        successor = InProgressLog(tmp_path / "notes")
        assert [successor.deaths(scan) for scan in ("a", "b\nc", "c")] == [0, 2, 0]

    def test_starts_without_crashes(self, tmp_path: Path) -> None:
        assert InProgressLog(tmp_path / "notes").deaths("a") == 0


class TestStatistics:
    def test_rows_are_read_in_the_order_in_which_they_were_written(self, tmp_path: Path) -> None:
        for error in ("torn", None):
            writer = StatisticsWriter(Location(str(tmp_path / "flagstone-statistics")), {"version": "1"})
            writer.add(rows_of({"path": "a.bin", "error": error}))
            writer.add(rows_of({"path": "b.bin"}))
            writer.flush()
            writer.flush()  # writes nothing
        frame = flagstone.ray.statistics(tmp_path)
        assert list(frame["path"]) == ["a.bin", "b.bin"]
        assert frame["error"].isna().all()  # the last row of each scan

    def test_missing_statistics_are_an_error_with_the_path(self, tmp_path: Path) -> None:
        with pytest.raises(FileNotFoundError, match="flagstone-statistics: no statistics"):
            flagstone.ray.statistics(tmp_path)

    def test_a_foreign_file_is_an_error_with_its_name(self, tmp_path: Path) -> None:
        (tmp_path / "x.parquet").write_bytes(b"torn")
        with pytest.raises(ValueError, match=r"x\.parquet: not a statistics file"):
            read_rows(Location(str(tmp_path)))


class TestFindScans:
    def test_finds_scans_in_subdirectories_sorted_by_name(self, tmp_path: Path) -> None:
        for name in ("b.bin", "a/c.npy", "a/c.label.npy", ".hidden.bin", "note.txt"):
            (tmp_path / name).parent.mkdir(exist_ok=True)
            (tmp_path / name).write_bytes(b"123")
        source, scans = plan.find_scans(Location(str(tmp_path)))
        assert source == Location(str(tmp_path))
        assert [(name, file.size) for name, file in scans.items()] == [("a/c.npy", 3), ("b.bin", 3)]

    def test_accepts_a_single_scan(self, tmp_path: Path) -> None:
        (tmp_path / "b.bin").write_bytes(b"123")
        source, scans = plan.find_scans(Location(str(tmp_path / "b.bin")))
        assert source == Location(str(tmp_path)) and scans["b.bin"].size == 3


class TestFinishedScans:
    """The statistics contain one row: a.bin, 160 bytes, 10 points."""

    def finished(self, tmp_path: Path, scans: dict[str, int], **row: object) -> set[str]:
        writer = StatisticsWriter(Location(str(tmp_path / "flagstone-statistics")), {})
        writer.add(rows_of({"path": "a.bin", "bytes": 160, "points": 10, **row}))
        writer.flush()
        return self.found(tmp_path, scans).scans

    def found(self, tmp_path: Path, scans: dict[str, int], modified: float = 0) -> plan.Finished:
        files = {name: File(name, size, modified) for name, size in scans.items()}
        return plan.finished_scans(files, Location(str(tmp_path)), "label", {})

    def test_have_a_row_and_a_label_file_of_the_right_size(self, tmp_path: Path) -> None:
        (tmp_path / "a.label").write_bytes(bytes(40))
        (tmp_path / "b.label").write_bytes(bytes(40))
        assert self.finished(tmp_path, {"a.bin": 160, "b.bin": 160}) == {"a.bin"}

    @pytest.mark.parametrize("size", [None, 0, 36, 44])
    def test_exclude_scans_with_missing_or_truncated_labels(self, tmp_path: Path, size: int | None) -> None:
        if size is not None:
            (tmp_path / "a.label").write_bytes(bytes(size))
        assert self.finished(tmp_path, {"a.bin": 160}) == set()

    def test_exclude_changed_and_failed_scans(self, tmp_path: Path) -> None:
        (tmp_path / "a.label").write_bytes(bytes(40))
        assert self.finished(tmp_path, {"a.bin": 176}) == set()
        assert self.finished(tmp_path, {"a.bin": 160}, error="torn", points=None) == set()

    def test_are_empty_after_the_statistics_are_removed(self, tmp_path: Path) -> None:
        (tmp_path / "a.label").write_bytes(bytes(40))
        assert self.finished(tmp_path, {"a.bin": 160}) == {"a.bin"}
        plan.forget(Location(str(tmp_path)))
        assert self.found(tmp_path, {"a.bin": 160}).scans == set()
        assert (tmp_path / "a.label").exists()

    def test_include_scans_whose_rows_a_killed_run_lost(self, tmp_path: Path) -> None:
        for name in ("before", "other"):
            (tmp_path / f"{name}.label").write_bytes(bytes(40))
        os.utime(tmp_path / "before.label", (1, 1))
        StatisticsWriter(Location(str(tmp_path / "flagstone-statistics")), {}).begin()
        (tmp_path / "a.label").write_bytes(bytes(40))
        (tmp_path / "torn.label").write_bytes(bytes(41))
        scans = {"a.bin": 160, "before.bin": 160, "torn.bin": 160, "missing.bin": 160}
        assert self.found(tmp_path, scans) == ({"a.bin"}, {"a.bin": 10})
        assert self.found(tmp_path, scans, modified=(tmp_path / "a.label").stat().st_mtime + 1) == (set(), {})

    def test_temporary_files_of_killed_runs_are_removed(self, tmp_path: Path) -> None:
        self.finished(tmp_path, {})
        dead = subprocess.Popen(["true"])
        dead.wait()
        kept = [f".flagstone-{os.getpid()}-0.tmp", ".flagstone-mine.tmp", "a.tmp"]
        for name in [f".flagstone-{dead.pid}-12.tmp", f".flagstone-{dead.pid}-py3.tmp", *kept]:
            (tmp_path / name).touch()
        self.found(tmp_path, {})
        assert sorted(path.name for path in tmp_path.iterdir() if path.is_file()) == sorted(kept)


def test_errors_are_one_line_and_name_the_scan_once() -> None:
    assert one_line(ValueError("/s/a.bin: byte 3: torn"), "/s/a.bin") == "/s/a.bin: byte 3: torn"
    assert one_line(ValueError("byte 3:\n torn"), "b/a.bin") == "b/a.bin: byte 3: torn"
    missing = FileNotFoundError(errno.ENOENT, "No such file or directory", "/s/a.bin")
    assert one_line(missing, "/s/a.bin") == "/s/a.bin: No such file or directory"
    assert one_line(MemoryError(), "a.bin") == "a.bin: MemoryError"


def test_a_summary_lists_failures_with_reasons() -> None:
    failures = tuple(Failure(f"{i:02}.bin", f"/s/{i:02}.bin: torn") for i in range(25))
    text = str(Summary(30, 2, 3, failures, 30, 480, 0.5, 2, 3.0, 6.0, 1.5, "/d/flagstone-statistics"))
    assert text.startswith("3 of 30 scans labelled, 30 points; 2 already labelled\n6.0 scans per second")
    assert "25 failed:\n  /s/00.bin: torn\n" in text
    assert "/s/19.bin" in text
    assert "/s/20.bin" not in text
    assert "and 5 more, listed in the statistics" in text


def run_ray(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Runs `flagstone ray`."""
    command = [str(_command.path()), "ray", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=_command.environment(), check=False)


class TestUsage:
    """Usage errors are one line, before Ray is started."""

    @pytest.fixture
    def scan(self, tmp_path: Path) -> Path:
        flagstone.io.write(tmp_path / "a.bin", np.zeros((5, 4), np.float32))
        return tmp_path

    @pytest.mark.parametrize(
        ("options", "message"),
        [
            (["--format", "pcd"], "--format: no format is named 'pcd'"),
            (["--label-map", "x"], "--label-map: no label map is named 'x'"),
            (["--columns", "2"], "--columns: 2 is out of range (expected 3 to 1024)"),
            (["--workers", "0"], "--workers: 0 is out of range (expected 1 to 100000)"),
            (["--method", "magic"], "magic"),
            (["--set", "point.margin"], "--set point.margin"),
            (["--set", "point.margin=nan"], "point.margin"),
            (["--tilt", "1,2"], "--tilt: '1,2' is not a tilt"),
            (["--tilt", "estimate"], "tilt: 'estimate' is not supported here"),
            (["--adress", "auto"], "--adress: is not an option of this command (did you mean '--address'?"),
            (["--in-place"], "cannot be combined with"),
        ],
    )
    def test_invalid_options_are_rejected(self, scan: Path, options: list[str], message: str) -> None:
        done = run_ray(scan, "--output", scan / "out", *options)
        assert done.returncode == 2
        assert message in done.stderr
        assert done.stderr.count("\n") == 1
        assert not (scan / "out").exists()

    def test_a_destination_is_required(self, scan: Path) -> None:
        done = run_ray(scan)
        assert done.returncode == 2
        assert done.stderr == "flagstone: ray: --output DIR is missing (or --in-place; see 'flagstone ray --help')\n"

    @pytest.mark.parametrize("word", ["estimate", "track"])
    def test_estimated_heights_are_rejected(self, scan: Path, word: str) -> None:
        with pytest.raises(ValueError, match=f"sensor_height: '{word}' is not supported here"):
            flagstone.ray.segment(scan, segmenter=flagstone.Surface(sensor_height=word))  # type: ignore[arg-type]

    def test_a_source_without_scans_is_rejected(self, tmp_path: Path) -> None:
        for source in (tmp_path, tmp_path / "missing"):
            with pytest.raises(FileNotFoundError, match="no scans in this directory or its subdirectories"):
                flagstone.ray.segment(source, tmp_path / "out")

    def test_scans_with_the_same_label_file_are_rejected(self, scan: Path) -> None:
        flagstone.io.write(scan / "a.npy", np.zeros((5, 4), np.float32))
        with pytest.raises(ValueError, match=r"a\.bin and .*a\.npy would both write to a\.label"):
            flagstone.ray.segment(scan)

    def test_a_scan_with_the_name_of_its_label_file_is_rejected(self, scan: Path) -> None:
        (scan / "a.bin").rename(scan / "a.label")
        with pytest.raises(ValueError, match=r"a\.label: has the name of its label file"):
            flagstone.ray.segment(scan / "a.label")

    def test_names_that_are_not_utf8_are_rejected(self, scan: Path) -> None:
        Path(os.fsdecode(bytes(scan) + b"/\xe9.bin")).write_bytes(b"")
        with pytest.raises(ValueError, match=r"the file name '\\udce9\.bin' is not UTF-8"):
            flagstone.ray.segment(scan)

    def test_a_destination_with_other_settings_is_rejected(self, scan: Path) -> None:
        settings = json.loads(json.dumps(flagstone.Surface(sensor_height=2.5).settings))
        made_with = {"version": flagstone.__version__, "method": "surface", "settings": settings}
        writer = StatisticsWriter(Location(str(scan / "flagstone-statistics")), made_with)
        writer.add(rows_of({"path": "a.bin"}))
        writer.flush()
        with pytest.raises(
            ValueError, match=r"existing labels were written with settings\.sensor_height = 2\.5, not 1\.73"
        ):
            flagstone.ray.segment(scan)

    def test_a_missing_cluster_is_a_one_line_error(self, scan: Path) -> None:
        done = run_ray(scan, "--in-place", "--address", "127.0.0.1:1")
        assert done.returncode == 2
        assert done.stderr.splitlines()[-1].startswith("flagstone: Ray at 127.0.0.1:1: cannot connect: ")


@pytest.mark.parametrize(("scans", "workers"), [(1, 8), (17, 2), (2000, 2), (50_000, 3)])
def test_batches_contain_every_scan_once_and_get_smaller(scans: int, workers: int) -> None:
    todo = [(f"{i}.bin", 16) for i in range(scans)]
    batches = list(in_batches(todo, workers))
    assert [scan for batch in batches for scan in batch] == todo
    sizes = [len(batch) for batch in batches]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[0] <= 256 and sizes[-1] <= 16
