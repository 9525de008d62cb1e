# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.evaluate` returns the results of the command as data frames."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import run_command

import flagstone

pandas = pytest.importorskip("pandas", reason="pandas is not installed: pip install 'flagstone[pandas]'")

HEIGHT = 0.6  # metres; height of the simulated sensor


@pytest.fixture(scope="module")
def evaluation(simulated: Path) -> flagstone.Evaluation:
    return flagstone.evaluate(simulated, protocol="simulation", sensor_height=HEIGHT, threads=1)


def test_metrics_are_identical_to_the_command(
    evaluation: flagstone.Evaluation, simulated: Path, tmp_path: Path
) -> None:
    options = ["--protocol", "simulation", "--sensor-height", str(HEIGHT), "--threads", "1"]
    run_command("eval", simulated, *options, "--json", tmp_path / "a.json", "--csv", tmp_path / "a.csv")
    results = json.loads((tmp_path / "a.json").read_text())
    for method in results["methods"]:
        row = evaluation.methods.loc[method["name"]]
        for share in ("precision", "recall", "f1", "accuracy", "iou"):
            assert row[share] == method[share]["mean"]
            assert row[f"{share}_std"] == method[share]["std"]
            assert row[f"{share}_ci95"] == method[share]["ci95"]
        assert row["f1_pooled"] == method["pooled"]["f1"]
        bands = evaluation.ranges[evaluation.ranges["method"] == method["name"]]
        assert bands["f1"].tolist() == [band["f1"] for band in method["by_range"]] + [method["pooled"]["f1"]]
    with (tmp_path / "a.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for column in ("method", "scan", "tp", "f1", "height_median_0_20m"):
        assert evaluation.scans[column].astype(object).where(evaluation.scans[column].notna(), "").tolist() == [
            row[column] if column in ("method", "scan") else float(row[column]) if row[column] else "" for row in rows
        ]


def test_methods_have_one_row_each_in_the_requested_order(evaluation: flagstone.Evaluation) -> None:
    assert evaluation.methods.index.tolist() == ["surface", "patchwork"]
    assert evaluation.methods["scans"].tolist() == [2, 2]
    assert (evaluation.methods["hz"] > 0).all()


def test_scans_have_one_row_per_method_and_scan(evaluation: flagstone.Evaluation, simulated: Path) -> None:
    scans = evaluation.scans
    assert scans[["method", "scan"]].apply(tuple, axis=1).tolist() == [
        (method, f"00/{frame:06}") for method in ("surface", "patchwork") for frame in range(2)
    ]
    points = {path.stem: path.stat().st_size // 16 for path in (simulated / "sequences/00/velodyne").iterdir()}
    counted = scans[["tp", "fp", "fn", "tn"]].sum(axis=1)
    assert counted.tolist() == [points[scan.removeprefix("00/")] for scan in scans["scan"]]


def test_the_last_range_interval_covers_all_points(evaluation: flagstone.Evaluation) -> None:
    for _, rows in evaluation.ranges.groupby("method", sort=False):
        assert rows["from"].tolist() == [0, 10, 20, 40, 0]
        assert rows["to"].tolist() == [10, 20, 40, 80, np.inf]
        *bands, everywhere = rows["points"].tolist()
        assert 0.99 * everywhere < sum(bands) <= everywhere  # few points are beyond 80 m


def test_heights_are_scored_if_the_dataset_has_true_heights(evaluation: flagstone.Evaluation) -> None:
    heights = evaluation.heights
    assert set(heights["method"]) == {"surface"}  # Patchwork computes no heights
    assert heights["points"].tolist() == ["ground"] * 4 + ["all"] * 4
    near = heights.iloc[0]
    assert (near["from"], near["to"]) == (0, 20)
    assert 0 < near["median"] < 0.05


def test_heights_are_empty_if_the_dataset_has_no_true_heights(simulated: Path, tmp_path: Path) -> None:
    folder = simulated / "sequences" / "00"
    for name in ("velodyne", "labels"):
        (tmp_path / name).symlink_to(folder / name)
    evaluation = flagstone.evaluate(tmp_path, methods=["surface"])
    assert evaluation.heights.empty
    assert "median" in evaluation.heights.columns
    assert not any(name.startswith("height") for name in evaluation.scans.columns)


def test_one_scan_has_no_interval(simulated: Path) -> None:
    evaluation = flagstone.evaluate(simulated, methods="surface", every=2)
    assert evaluation.methods["scans"].tolist() == [1]
    assert np.isnan(evaluation.methods.loc["surface", "f1_ci95"])


def test_settings_are_passed_to_their_method(simulated: Path) -> None:
    def recall(**settings: Any) -> float:
        evaluation = flagstone.evaluate(simulated, methods=["surface"], sensor_height=HEIGHT, settings=settings)
        return float(evaluation.methods.loc["surface", "recall"])

    assert recall(surface={"point": {"margin": 0.01}}) < recall() == recall(surface={}) == recall(mount={})


def test_labels_of_other_programs_are_scored_like_a_method(simulated: Path, tmp_path: Path) -> None:
    truth = simulated / "sequences" / "00" / "labels"
    (tmp_path / "00").symlink_to(truth)
    evaluation = flagstone.evaluate(
        simulated, protocol="simulation", methods=[], labels={"truth": tmp_path}, label_map="semantic-kitti"
    )
    assert evaluation.methods.index.tolist() == ["truth"]
    assert evaluation.methods.loc["truth", "f1"] == 1
    assert np.isnan(evaluation.methods.loc["truth", "hz"])


def test_an_unreadable_scan_is_listed_as_failed_with_a_warning(simulated: Path, tmp_path: Path) -> None:
    for name in ("velodyne", "labels"):
        (tmp_path / name).mkdir()
        for file in (simulated / "sequences" / "00" / name).iterdir():
            (tmp_path / name / file.name).write_bytes(file.read_bytes())
    damaged = tmp_path / "velodyne" / "000001.bin"
    damaged.write_bytes(damaged.read_bytes()[:-1])
    with pytest.warns(RuntimeWarning, match=r"1 failure, listed in `failed`: .*000001\.bin: byte .*columns"):
        evaluation = flagstone.evaluate(tmp_path)
    assert evaluation.failed["scan"].tolist() == ["000001"]
    assert evaluation.methods["scans"].tolist() == [1, 1]
    (tmp_path / "velodyne" / "000000.bin").unlink()
    with pytest.raises(OSError, match=r"000001\.bin: byte"):
        flagstone.evaluate(tmp_path)


def test_a_scan_without_ground_has_only_an_accuracy(simulated: Path, tmp_path: Path) -> None:
    for name in ("velodyne", "labels"):
        (tmp_path / name).mkdir()
        for file in (simulated / "sequences" / "00" / name).iterdir():
            (tmp_path / name / file.name).write_bytes(file.read_bytes())
    labels = tmp_path / "labels" / "000001.label"
    np.full(labels.stat().st_size // 4, 50, np.uint32).tofile(labels)
    evaluation = flagstone.evaluate(tmp_path, methods=["surface"], sensor_height=HEIGHT)
    assert evaluation.without_ground == 1
    first, second = (evaluation.scans.iloc[row] for row in range(2))
    assert np.isnan(second[["precision", "recall", "f1", "iou"]].to_numpy(float)).all()
    assert evaluation.methods.loc["surface", "f1"] == pytest.approx(first["f1"], abs=1e-6)
    assert 0 < second["accuracy"] <= 1


def test_repr_is_a_table(evaluation: flagstone.Evaluation, simulated: Path) -> None:
    heading = f"2 scans of {simulated.name}, protocol simulation"
    assert repr(evaluation).startswith(f"{heading}\n")
    assert f"{evaluation.methods.loc['surface', 'f1']:.4f}" in repr(evaluation)
    assert f"<p>{heading}</p><table" in evaluation._repr_html_()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"protocol": "kitti"}, "no protocol is named 'kitti' .expected patchwork"),
        ({"methods": "surfaces"}, "no method is named 'surfaces'"),
        ({"sensor_height": "high"}, "sensor_height: 'high' is not a height"),
        ({"tilt": "left"}, "tilt: 'left' is not a tilt"),
        ({"sensor": "hdl-65"}, "sensor: "),
        ({"every": 0}, "every: 0 is out of range \\(expected 1 to 1000000\\)"),
        ({"every": -1}, "every: -1 is out of range"),
        ({"threads": 2**70}, "threads: 1180591620717411303424 is out of range"),
        ({"label_map": "kitti"}, "label_map: 'kitti' is not a label map"),
        ({"sequences": ["77"]}, "77"),
        ({"settings": {"surface": {"margin": 1}}}, "no setting 'margin' .did you mean 'point.margin'"),
        ({"settings": {"roof": {"margin": 1}}}, "settings: no method is named 'roof'"),
    ],
)
def test_an_invalid_argument_raises_a_one_line_error_with_its_name(
    simulated: Path, arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        flagstone.evaluate(simulated, **arguments)
    assert "\n" not in str(caught.value)


def test_a_missing_or_empty_dataset_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="none: this dataset does not exist"):
        flagstone.evaluate(tmp_path / "none")
    with pytest.raises(ValueError, match=r"not a dataset \(expected a directory with"):
        flagstone.evaluate(tmp_path)


def test_a_dataset_name_can_start_with_a_dash(simulated: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "-scans").symlink_to(simulated)
    monkeypatch.chdir(tmp_path)
    assert flagstone.evaluate("-scans", methods=["patchwork"]).datasets == ("-scans",)


@pytest.fixture(scope="module")
def moving_scans(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A simulated sequence with traffic, and in `map` and `shifted` its moving points."""
    folder = tmp_path_factory.mktemp("moving")
    flagstone.simulate(folder, scene="urban_street", sensor="vlp-16", frames=3)
    for name in ("map", "shifted"):
        (folder / name / "moving").mkdir(parents=True)
    for file in (folder / "sequences" / "00" / "labels").iterdir():
        moves = np.isin(np.fromfile(file, np.uint32), np.arange(252, 260))
        for name, marks in (("map", moves), ("shifted", np.roll(moves, 5))):
            np.save(folder / name / "moving" / f"{file.stem}.moving.npy", marks.astype(np.uint16))
    return folder


def test_moving_points_are_scored_by_range(moving_scans: Path) -> None:
    sources = {name: moving_scans / name for name in ("map", "shifted")}
    evaluation = flagstone.evaluate(moving_scans, methods="none", moving=sources)

    moving = evaluation.moving
    assert moving["name"].tolist() == ["map"] * 5 + ["shifted"] * 5
    assert moving["from"].tolist() == [0, 10, 20, 40, 0] * 2
    assert moving["to"].tolist() == [10, 20, 40, 80, 80] * 2
    exact = moving.iloc[4]
    assert (exact["iou"], exact["recall"], exact["precision"], exact["kept"]) == (1, 1, 1, 1)
    assert exact["iou_mean"] == 1
    assert exact["moving_points"] == exact["marked_points"] > 0
    assert moving.iloc[:4]["moving_points"].sum() == exact["moving_points"]
    assert 0 < moving.iloc[9]["iou"] < 1
    assert evaluation.methods.empty
    assert evaluation.scans.empty
    assert repr(evaluation).startswith(f"3 scans of {moving_scans.name}, ")


def test_moving_metrics_match_an_independent_count(moving_scans: Path) -> None:
    evaluation = flagstone.evaluate(moving_scans, methods="none", moving={"shifted": moving_scans / "shifted"})

    tp = fp = fn = kept = obstacles = 0
    for file in sorted((moving_scans / "sequences" / "00" / "labels").iterdir()):
        classes = np.fromfile(file, np.uint32)
        points = np.fromfile(file.parents[1] / "velodyne" / f"{file.stem}.bin", np.float32).reshape(-1, 4)
        marked = np.load(moving_scans / "shifted" / "moving" / f"{file.stem}.moving.npy") != 0
        scored = (classes > 1) & (np.hypot(points[:, 0], points[:, 1]) < 80)
        moves = (classes >= 251) & (classes <= 259)
        obstacle = scored & ~moves & ~np.isin(classes, [40, 44, 48, 49, 60, 72])
        tp += (scored & moves & marked).sum()
        fp += (scored & ~moves & marked).sum()
        fn += (scored & moves & ~marked).sum()
        obstacles += obstacle.sum()
        kept += (obstacle & ~marked).sum()
    everything = evaluation.moving.iloc[-1]
    assert everything["iou"] == tp / (tp + fp + fn)
    assert everything["recall"] == tp / (tp + fn)
    assert everything["precision"] == tp / (tp + fp)
    assert everything["kept"] == kept / obstacles


def test_moving_is_empty_without_the_argument(evaluation: flagstone.Evaluation) -> None:
    assert evaluation.moving.empty
    assert "iou" in evaluation.moving.columns


def test_missing_moving_points_are_listed_as_failed(moving_scans: Path, tmp_path: Path) -> None:
    with pytest.warns(RuntimeWarning, match=r"3 failures.*moving points map: .*000000\.npy"):
        evaluation = flagstone.evaluate(moving_scans, methods="none", moving={"map": tmp_path})
    assert len(evaluation.failed) == 3
    assert np.isnan(evaluation.moving["iou"]).all()
    with pytest.raises(ValueError, match=r"moving map=.*nowhere is not a directory"):
        flagstone.evaluate(moving_scans, moving={"map": tmp_path / "nowhere"})
