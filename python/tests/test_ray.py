# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels of directories of scans with Ray. All tests use the same Ray instance."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

import flagstone

ray = pytest.importorskip("ray", reason="needs flagstone[ray]")

from ray_scans import DeadlyFiles, files, label_with_command, write_scans  # noqa: E402

import flagstone.ray  # noqa: E402
from flagstone.ray import command  # noqa: E402

SCANS = ["a.bin", "00/a.bin", "00/b.pcd", "00/deep/c.ply", "01/d.npy", "01/e.pcd.bin", "01/f.v2.bin", "02/g.bin"]
NO_SCANS = ["00/a.label.npy", "00/.hidden.bin", "00/readme.txt", "01/x_lidarseg.bin"]


@pytest.fixture(scope="module", autouse=True)
def one_ray() -> Iterator[None]:
    """Ray with two cores and little memory. Its workers import the same modules as this process."""
    found = [str(Path(flagstone.__file__).parents[1]), str(Path(__file__).parent)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join([*found, os.environ.get("PYTHONPATH", "")]))
        patch.setenv("RAY_USAGE_STATS_ENABLED", "0")
        ray.init(
            address="local",
            num_cpus=2,
            object_store_memory=100 * 2**20,
            include_dashboard=False,
            log_to_driver=False,
        )
        yield
        ray.shutdown()


@pytest.fixture
def scans(tmp_path: Path) -> Path:
    """Scans of all formats in subdirectories, and other files next to them."""
    folder = tmp_path / "scans"
    write_scans(folder, SCANS)
    for name in NO_SCANS:
        (folder / name).write_bytes(b"no scan")
    return folder


def test_labels_are_bit_identical_to_the_command(scans: Path, tmp_path: Path) -> None:
    summary = flagstone.ray.segment(scans, tmp_path / "labels")
    label_with_command(scans, tmp_path / "expected")
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


def test_settings_formats_and_destinations_are_used(scans: Path, tmp_path: Path) -> None:
    segmenter = flagstone.Patchwork(sensor="hdl-32e", sensor_height=1.6, uprightness={"angle": 50})
    asked = {"segmenter": segmenter, "format": "u8", "label_map": "semantic-kitti", "workers": 1}
    before = files(scans)
    flagstone.ray.segment(scans, None, **asked)  # next to the scans
    options = "--method patchwork --sensor hdl-32e --sensor-height 1.6 --set uprightness.angle=50 --format u8"
    label_with_command(scans, tmp_path / "expected", *options.split(), "--label-map", "semantic-kitti")
    assert files(scans) == before | files(tmp_path / "expected")
    assert flagstone.ray.segment(scans, None, **asked).already_labelled == len(
        SCANS
    )  # label files are not treated as scans


def run_command(scans: Path, labels: Path) -> int:
    """Runs the Python part of `flagstone ray` in this process, which has joined Ray already."""
    options = {
        "method": "surface",
        "settings": flagstone.Surface().settings,
        "columns": 0,
        "format": "label",
        "label_map": "flagstone",
        "overwrite": False,
        "address": "",
        "workers": 1,
    }
    return command.run(options, [str(scans), str(labels)])


def test_failures_do_not_affect_other_scans_and_a_second_run_retries_them(
    scans: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    label_with_command(scans, tmp_path / "expected")
    good = (scans / "00" / "b.pcd").read_bytes()
    (scans / "00" / "b.pcd").write_bytes(good[:-100])
    labels = tmp_path / "labels"
    labels.mkdir()
    (labels / "01").write_text("a file with the name of a directory")
    assert run_command(scans, labels) == 1
    printed = capsys.readouterr().out
    assert f"4 of {len(SCANS)} scans labelled" in printed
    assert f"4 failed:\n  {scans}/00/b.pcd: byte " in printed
    assert f"{labels}/01: File exists" in printed
    assert sorted(files(labels)) == ["00/a.label", "00/deep/c.label", "01", "02/g.label", "a.label"]
    frame = flagstone.ray.statistics(labels).set_index("path")
    assert list(frame.index[frame["error"].notna()]) == ["00/b.pcd", "01/d.npy", "01/e.pcd.bin", "01/f.v2.bin"]

    (scans / "00" / "b.pcd").write_bytes(good)
    (labels / "01").unlink()
    (labels / "a.label").unlink()
    os.truncate(labels / "00" / "a.label", 400)
    kept = {path: path.stat().st_ino for path in (labels / "02" / "g.label", labels / "00" / "deep" / "c.label")}
    assert run_command(scans, labels) == 0
    assert f"6 of {len(SCANS)} scans labelled" in capsys.readouterr().out
    assert files(labels) == files(tmp_path / "expected")
    assert all(path.stat().st_ino == number for path, number in kept.items())
    assert flagstone.ray.statistics(labels)["error"].isna().all()


def test_other_filesystems_get_identical_labels_despite_a_scan_that_crashes_workers(
    scans: Path, tmp_path: Path
) -> None:
    label_with_command(scans, tmp_path / "expected")
    (scans / "00" / "deadly.bin").write_bytes(b"")
    (scans / "02" / "torn.bin").write_bytes(b"torn")
    where = {"source": str(scans), "destination": str(tmp_path / "labels"), "filesystem": DeadlyFiles()}
    summary = flagstone.ray.segment(**where, workers=1)
    deadly, torn = summary.failures
    assert deadly.error.startswith(f"{scans}/00/deadly.bin: 2 workers crashed while processing this scan")
    assert torn.error.startswith(f"{scans}/02/torn.bin: byte 0: ")
    # A worker that is killed while it writes the labels of another scan leaves their temporary file.
    written = {name: data for name, data in files(tmp_path / "labels").items() if "/.flagstone-" not in f"/{name}"}
    assert written == files(tmp_path / "expected")
    for path in (scans / "00" / "deadly.bin", scans / "02" / "torn.bin"):
        path.unlink()
    assert flagstone.ray.segment(**where).already_labelled == len(SCANS)


def test_labels_are_not_written_through_a_link_to_a_scan(scans: Path, tmp_path: Path) -> None:
    before = files(scans)
    (tmp_path / "labels").mkdir()
    (tmp_path / "labels" / "a.label").symlink_to(scans / "02" / "g.bin")
    summary = flagstone.ray.segment(scans, tmp_path / "labels", workers=1)
    assert [failure.error for failure in summary.failures] == [
        f"{scans}/a.bin: {tmp_path}/labels/a.label: is a link to a scan (remove it, or choose another destination)"
    ]
    assert files(scans) == before


def test_progress_is_logged_in_lines_without_a_terminal(
    scans: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    flagstone.ray.segment(scans, tmp_path / "labels", workers=1)
    assert capsys.readouterr().err.startswith(f"listing scans\nstarting Ray for {len(SCANS)} scans\nstarting workers\n")
    flagstone.ray.segment(scans, tmp_path / "labels", overwrite=True, workers=1, progress=False)
    assert capsys.readouterr().err == ""


def test_scans_whose_rows_were_lost_are_not_labelled_again(scans: Path, tmp_path: Path) -> None:
    labels = tmp_path / "labels"
    flagstone.ray.segment(scans, labels, workers=1)
    _, *rows = sorted((labels / "flagstone-statistics").iterdir())
    for part in rows:  # as if the driver had been killed before it wrote them
        part.unlink()
    (labels / "a.label").unlink()
    kept = {path: path.stat().st_ino for path in labels.rglob("*.label")}
    summary = flagstone.ray.segment(scans, labels, workers=1)
    assert (summary.labelled, summary.already_labelled) == (1, len(SCANS) - 1)
    assert all(path.stat().st_ino == number for path, number in kept.items())
    frame = flagstone.ray.statistics(labels)
    assert len(frame) == len(SCANS) and frame["points"].notna().all() and frame["ground"].notna().sum() == 1
    assert flagstone.ray.segment(scans, labels).already_labelled == len(SCANS)
