# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labelling folders of scans with Ray: one Ray, started for all of these tests."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from ray_scans import files, label_with_command, street, write_scans

import flagstone

ray = pytest.importorskip("ray", reason="needs flagstone[ray]")
pytest.importorskip("ray.data", reason="needs flagstone[ray]")
fsspec = pytest.importorskip("fsspec", reason="needs flagstone[ray]")

import fsspec.implementations.dirfs  # noqa: E402
import fsspec.implementations.local  # noqa: E402

import flagstone.ray  # noqa: E402

SCANS = ["a.bin", "00/a.bin", "00/b.pcd", "00/deep/c.ply", "01/d.npy", "01/e.pcd.bin", "01/f.v2.bin", "02/g.bin"]
NO_SCANS = ["00/a.label.npy", "00/.hidden.bin", "00/readme.txt", "01/x_lidarseg.bin"]


@pytest.fixture(scope="module", autouse=True)
def one_ray() -> Iterator[None]:
    """Two cores, as little memory as Ray takes, and workers that find the package where this process found it."""
    package = str(Path(flagstone.__file__).parents[1])
    ray.init(
        address="local",
        num_cpus=2,
        object_store_memory=100 * 2**20,
        include_dashboard=False,
        log_to_driver=False,
        runtime_env={"env_vars": {"PYTHONPATH": os.pathsep.join([package, str(Path(__file__).parent)])}},
    )
    yield
    ray.shutdown()


@pytest.fixture
def scans(tmp_path: Path) -> Path:
    """Scans of all formats in folders, and files beside them that are no scans."""
    folder = tmp_path / "scans"
    write_scans(folder, SCANS)
    for name in NO_SCANS:
        (folder / name).write_bytes(b"no scan")
    return folder


@pytest.mark.parametrize("format", ["label", "u8"])
def test_labels_are_those_of_the_command_byte_for_byte(scans: Path, tmp_path: Path, format: str) -> None:
    summary = flagstone.ray.segment(scans, tmp_path / "labels", format=format)
    label_with_command(scans, tmp_path / "expected", "--format", format)
    assert files(tmp_path / "labels") == files(tmp_path / "expected")
    assert len(files(tmp_path / "labels")) == len(SCANS) == summary.labelled
    assert summary.failures == ()

    frame = flagstone.ray.statistics(tmp_path / "labels")
    assert sorted(frame["path"]) == sorted(SCANS)
    assert (frame[["nonground", "ground", "noise", "out_of_range", "invalid"]].sum(axis=1) == frame["points"]).all()
    assert (frame["invalid"] == 3).all()
    assert summary.points == frame["points"].sum()
    assert summary.bytes == frame["bytes"].sum() == sum((scans / name).stat().st_size for name in SCANS)
    assert (frame[["read_ms", "segment_ms", "write_ms"]] > 0).all(axis=None)


def test_settings_and_label_map_are_those_asked_for(scans: Path, tmp_path: Path) -> None:
    segmenter = flagstone.Patchwork(sensor="hdl-32e", sensor_height=1.6, uprightness={"angle": 50})
    flagstone.ray.segment(scans, tmp_path / "labels", segmenter=segmenter, label_map="semantic_kitti")
    options = "--method patchwork --sensor hdl-32e --sensor-height 1.6 --set uprightness.angle=50".split()
    label_with_command(scans, tmp_path / "expected", *options, "--label-map", "semantic-kitti")
    assert files(tmp_path / "labels") == files(tmp_path / "expected")


def test_labels_may_lie_beside_their_scans(scans: Path, tmp_path: Path) -> None:
    before = files(scans)
    flagstone.ray.segment(scans)
    label_with_command(scans, tmp_path / "expected")
    assert files(scans) == before | files(tmp_path / "expected")
    assert flagstone.ray.segment(scans).finished_before == len(SCANS)  # labels are not taken for scans


def test_a_single_scan_will_do(scans: Path, tmp_path: Path) -> None:
    flagstone.ray.segment(scans / "00" / "b.pcd", tmp_path / "labels")
    label_with_command(scans / "00" / "b.pcd", tmp_path / "expected")
    assert files(tmp_path / "labels") == files(tmp_path / "expected")


def test_only_what_is_left_is_done(scans: Path, tmp_path: Path) -> None:
    labels = tmp_path / "labels"
    flagstone.ray.segment(scans, labels)
    expected = files(labels)
    assert flagstone.ray.segment(scans, labels).finished_before == len(SCANS)

    (labels / "a.label").unlink()
    os.truncate(labels / "00" / "b.label", 400)
    (labels / "02" / "g.label").write_bytes(bytes(len(expected["02/g.label"])))  # of the right size: not looked into
    kept = {path: path.stat().st_mtime_ns for path in labels.rglob("*.label")}
    summary = flagstone.ray.segment(scans, labels)
    assert (summary.labelled, summary.finished_before) == (2, len(SCANS) - 2)
    assert files(labels) == expected | {"02/g.label": bytes(len(expected["02/g.label"]))}
    assert [path.stem for path, time in kept.items() if path.stat().st_mtime_ns != time] == ["b"]

    assert flagstone.ray.segment(scans, labels, again=True).labelled == len(SCANS)
    assert files(labels) == expected


def test_a_bad_scan_costs_itself_alone(scans: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from flagstone.ray import command

    good = (scans / "00" / "b.pcd").read_bytes()
    (scans / "00" / "b.pcd").write_bytes(good[:-100])
    (scans / "01" / "d.npy").write_bytes(b"")
    labels = tmp_path / "labels"
    assert command.main([str(scans), "--output", str(labels)]) == 1
    printed = capsys.readouterr().out
    assert f"{len(SCANS) - 2} of {len(SCANS)} scans labelled" in printed
    assert f"2 failed:\n  {scans}/00/b.pcd: byte " in printed
    assert len(files(labels)) == len(SCANS) - 2
    frame = flagstone.ray.statistics(labels).set_index("path")
    assert list(frame.index[frame["error"].notna()]) == ["00/b.pcd", "01/d.npy"]

    (scans / "00" / "b.pcd").write_bytes(good)
    flagstone.io.write(scans / "01" / "d.npy", street(9))
    assert command.main([str(scans), "--output", str(labels)]) == 0
    assert capsys.readouterr().out.startswith(f"2 of {len(SCANS)} scans labelled")
    assert flagstone.ray.statistics(labels)["error"].isna().all()


def test_a_folder_that_cannot_be_written_is_an_error_a_scan(scans: Path, tmp_path: Path) -> None:
    labels = tmp_path / "labels"
    labels.mkdir()
    (labels / "00").write_text("a file where a folder should be")
    summary = flagstone.ray.segment(scans, labels)
    assert [failure.path for failure in summary.failures] == ["00/a.bin", "00/b.pcd", "00/deep/c.ply"]
    assert summary.labelled == len(SCANS) - 3


def test_other_filesystems_get_the_same_bytes(scans: Path, tmp_path: Path) -> None:
    (scans / "02" / "bad.bin").write_bytes(b"torn")
    bucket = fsspec.implementations.dirfs.DirFileSystem(str(tmp_path), fsspec.filesystem("file"))
    summary = flagstone.ray.segment("scans", "labels", filesystem=bucket, format="u8")
    assert [failure.error.partition(":")[0] for failure in summary.failures] == ["scans/02/bad.bin"]
    (scans / "02" / "bad.bin").unlink()
    label_with_command(scans, tmp_path / "expected", "--format", "u8")
    assert files(tmp_path / "labels") == files(tmp_path / "expected")
    assert flagstone.ray.segment("scans", "labels", filesystem=bucket, format="u8").finished_before == len(SCANS)
    assert len(flagstone.ray.statistics("labels", filesystem=bucket)) == len(SCANS) + 1


class DeadlyFiles(fsspec.implementations.local.LocalFileSystem):
    """Whoever opens a file named deadly is killed, as by a system that is out of memory."""

    protocol = "deadly"

    def _open(self, path: str, *arguments: Any, **options: Any) -> Any:
        if "deadly" in path and path.endswith(".bin"):
            os.kill(os.getpid(), signal.SIGKILL)
        return super()._open(path, *arguments, **options)


def test_a_scan_that_kills_workers_costs_itself_alone(scans: Path, tmp_path: Path) -> None:
    ray.cloudpickle.register_pickle_by_value(sys.modules[DeadlyFiles.__module__])
    label_with_command(scans, tmp_path / "expected")
    (scans / "00" / "deadly.bin").write_bytes(b"")
    summary = flagstone.ray.segment(str(scans), str(tmp_path / "labels"), filesystem=DeadlyFiles())
    assert [failure.path for failure in summary.failures] == ["00/deadly.bin"]
    assert "2 workers died while they had it under work" in summary.failures[0].error
    assert files(tmp_path / "labels") == files(tmp_path / "expected")
