# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Scores of methods on labelled scans, as data frames."""

from __future__ import annotations

import io
import json
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from flagstone import _core
from flagstone._optional import needs
from flagstone._runs import listed, run

if TYPE_CHECKING:
    import pandas

    from flagstone.segmenters import SensorHeight, Tilt

PathLike = str | os.PathLike[str]

_ratios = ("precision", "recall", "f1", "accuracy", "iou")
_height_metrics = ("median", "percentile95", "bias")
_moving_ratios = ("iou", "recall", "precision", "kept")
_moving_counts = ("points", "moving_points", "marked_points")


@dataclass(frozen=True, repr=False, eq=False)
class Evaluation:
    """Results of `evaluate`. Ratios are 0 to 1, lengths are in metres, and undefined values are NaN.

    Attributes:
        methods: One row per method, in the order requested; the index is `method`. `title`; `scans`, the number of
            scans scored. For each of `precision`, `recall`, `f1`, `accuracy` and `iou`: the mean over scans, `..._std`
            (sample standard deviation) and `..._ci95` (half-width of the 95 % confidence interval of the mean,
            Student's t). `f1_pooled`, where each point counts once, and `f1_by_area`, where each 0.5 m cell of each
            scan counts once. `hz` and `hz_slowest_1_percent`, scans per second of `segment` alone.
        scans: One row per method and scan: `method`, `scan`, the five ratios, the numbers of points `tp`, `fp`, `fn`
            and `tn`, F1 by horizontal range (`f1_0_10m` ...) and per cell, `milliseconds`. If the dataset has
            ground-truth heights, also `height_median_0_20m` and so on: metres, over ground points.
        ranges: One row per method and range interval, with the points of all scans together: `method`, `from` and `to`
            (horizontal range, metres; the row up to infinity covers all points), the five ratios, `points`.
        heights: One row per method, `points` and range interval. `points` is `ground`, or `all`, which includes points
            over hidden ground. If several methods have heights, it is also `common ground` and `common all`: the
            points for which every method provides a height. `count` of points, `with_height` (fraction that has a
            height), and means over scans of the `median` and `percentile95` of the absolute error and of the `bias`,
            in metres. Each has `..._std` and `..._ci95`. Empty if the dataset has no ground-truth heights.
        moving: One row per entry of the argument `moving` and range interval: `name`, `from` and `to` (horizontal
            range, metres; the row from 0 to 80 m covers all scored points), `iou`, `recall` and `precision` of the
            moving points of all scans together; `kept`, the fraction of the static points that are not ground and
            not marked; `iou_mean` over the scans with moving points, `iou_mean_std` and `iou_mean_ci95`; and the
            numbers `points`, `moving_points` (in the ground truth) and `marked_points`. Empty without the argument.
        failed: One row per scan that could not be read, or that a method or an entry of `moving` failed on: `scan`,
            `error`.
        unscored: Scans omitted because none of their points is scored.
        without_ground: Number of scans whose ground truth contains no ground. Only their accuracy is defined. Their
            precision, recall, F1 and IoU are NaN and are excluded from the means.
        protocol: Name of the protocol, which defines the ground classes.
        datasets: Names of the datasets.
        threads: Number of scans processed in parallel; `hz` depends on it.
        machine: CPU and number of cores.
        date: Day of the run, YYYY-MM-DD.
        scan_count: Number of scans that were read and scored.
    """

    methods: pandas.DataFrame
    scans: pandas.DataFrame
    ranges: pandas.DataFrame
    heights: pandas.DataFrame
    moving: pandas.DataFrame
    failed: pandas.DataFrame
    unscored: tuple[str, ...]
    without_ground: int
    protocol: str
    datasets: tuple[str, ...]
    threads: int
    machine: str
    date: str
    scan_count: int

    def _heading(self) -> str:
        count = self.scan_count
        scans = "1 scan" if count == 1 else f"{count} scans"
        return f"{scans} of {', '.join(self.datasets)}, protocol {self.protocol}"

    def _brief(self) -> pandas.DataFrame:
        if self.methods.empty:
            return self.moving
        columns = ["scans", "precision", "recall", "f1", "f1_ci95", "accuracy", "iou", "hz"]
        brief: pandas.DataFrame = self.methods[columns]
        return brief

    def __repr__(self) -> str:
        return f"{self._heading()}\n{self._brief().to_string(float_format='{:.4f}'.format)}"

    def _repr_html_(self) -> str:
        from html import escape

        return f"<p>{escape(self._heading())}</p>{self._brief().to_html(float_format='{:.4f}'.format)}"


def evaluate(
    dataset: PathLike | Iterable[PathLike],
    *,
    methods: str | Sequence[str] = ("surface", "patchwork"),
    protocol: PathLike = "patchwork",
    sequences: str | Sequence[str] | None = None,
    every: int = 1,
    columns: int | None = None,
    sensor: PathLike | None = None,
    sensor_height: SensorHeight | None = None,
    tilt: Tilt | None = None,
    preset: Literal["default", "paper", "reference"] = "default",
    config: PathLike | None = None,
    settings: Mapping[str, Mapping[str, Any]] | None = None,
    labels: Mapping[str, PathLike] | None = None,
    label_map: Literal["flagstone", "semantic-kitti"] = "flagstone",
    moving: Mapping[str, PathLike] | None = None,
    threads: int | None = None,
) -> Evaluation:
    """Scores methods on labelled scans, as `flagstone eval` does.

    Args:
        dataset: One or more datasets. Each is a SemanticKITTI tree (`sequences/NN`, which `simulate` also writes), a
            directory with `velodyne/` and `labels/`, or a directory of nuScenes-lidarseg files.
        methods: Names from `flagstone.method_names()`, or `"table1"`, `"all"` or `"none"`.
        protocol: `"patchwork"`, `"patchwork++"`, `"simulation"`, `"lidarseg"`, or a `.toml` or `.json` file.
        sequences: Sequences to use, for example `["05", "10"]`; all by default.
        every: Use every N-th scan of each sequence, 1 to 1,000,000.
        columns: Floats per point in `.bin` files, 3 to 1,024; by default 5 for `.pcd.bin`, otherwise 4.
        sensor: Sensor to derive settings from: a name from `flagstone.sensors()`, or a `.toml` file.
        sensor_height: Height of the sensor above the ground in metres, `"estimate"` or `"track"`.
        tilt: Up direction (x, y, z) in the sensor frame, `"off"` or `"estimate"`.
        preset: Settings that Patchwork starts from: `"default"`, `"paper"` or `"reference"`.
        config: TOML file of Patchwork settings, as `flagstone config` prints them.
        settings: Settings by method name: `{"surface": {"point": {"margin": 0.2}}, "gpf": {"segments": 5}}`.
        labels: Labels written by other programs or by `flagstone.map`, each scored like a method: a name and its
            directory.
        label_map: Codes in `labels`: `"flagstone"` (1 is ground) or `"semantic-kitti"` (classes of the protocol).
        moving: Moving points to score: a name and its directory, the output of `flagstone.map` or one file per scan:
            `NAME.npy` (not 0: moves) or `NAME.label` (SemanticKITTI classes; 251 to 259 move).
        threads: Number of scans to process in parallel, 1 to 1,024; all cores by default. Use 1 to compare `hz`.

    Returns:
        Data frames with one row per method, per method and scan, and per method and range interval. Scans
        that fail are listed in `failed`, with a RuntimeWarning.

    Raises:
        FileNotFoundError: A dataset does not exist.
        ValueError: An argument is invalid, or a dataset has no labelled scans.
        OSError: No scan could be read.
        ImportError: pandas is not installed.
        KeyboardInterrupt: You pressed Ctrl-C.
    """
    needs("pandas", "pandas")
    datasets = [dataset] if isinstance(dataset, (str, os.PathLike)) else list(dataset)
    for each in datasets:
        if not Path(each).exists():
            raise FileNotFoundError(f"{os.fspath(each)}: this dataset does not exist")
    if label_map not in ("flagstone", "semantic-kitti"):
        raise ValueError(f"label_map: {label_map!r} is not a label map (expected flagstone or semantic-kitti)")
    with run() as (draw, terminal_columns):
        results, table, errors = _core.evaluate(
            [os.fspath(each) for each in datasets],
            listed(methods),
            os.fspath(protocol),
            [] if sequences is None else listed(sequences),
            every,
            columns,
            "" if sensor is None else os.fspath(sensor),
            sensor_height,
            tilt if tilt is None or isinstance(tilt, str) else tuple(tilt),
            preset,
            "" if config is None else os.fspath(config),
            dict(settings or {}),
            [f"{name}={os.fspath(folder)}" for name, folder in (labels or {}).items()],
            label_map == "semantic-kitti",
            [f"{name}={os.fspath(folder)}" for name, folder in (moving or {}).items()],
            threads,
            draw,
            terminal_columns,
        )
    reason = (
        errors[0] + (f" (and {len(errors) - 1} more)" if len(errors) > 1 else "") if errors else "no scan was scored"
    )
    if not results:
        raise OSError(reason)
    evaluation = _read(results, table)
    if len(evaluation.failed) > 0:
        count = len(evaluation.failed)
        failures = "1 failure" if count == 1 else f"{count} failures"
        warnings.warn(f"{failures}, listed in `failed`: {reason}", RuntimeWarning, stacklevel=2)
    return evaluation


def _read(results_json: str, table: bytes) -> Evaluation:
    pd = needs("pandas", "pandas")
    results = json.loads(results_json)
    methods = results["methods"]
    names = {"method": str, "scan": str}
    return Evaluation(
        methods=pd.DataFrame([_method_row(method) for method in methods], columns=_method_columns).set_index("method"),
        scans=pd.read_csv(io.BytesIO(table), dtype=names, keep_default_na=False, na_values=[""]),
        ranges=pd.DataFrame([row for method in methods for row in _range_rows(method)], columns=_range_columns),
        heights=pd.DataFrame([row for method in methods for row in _height_rows(method)], columns=_height_columns),
        moving=pd.DataFrame(
            [row for source in results.get("moving", []) for row in _moving_rows(source)], columns=_moving_columns
        ),
        failed=pd.DataFrame(results["failed"], columns=["scan", "error"]),
        unscored=tuple(results["unscored"]),
        without_ground=results["without_ground"],
        protocol=results["protocol"],
        datasets=tuple(results["datasets"]),
        threads=results["threads"],
        machine=results["machine"],
        date=results["date"],
        scan_count=results["scans"],
    )


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def _mean_std_ci95(name: str, metric: Mapping[str, float | None]) -> dict[str, float]:
    return {
        name: _number(metric["mean"]),
        f"{name}_std": _number(metric["std"]),
        f"{name}_ci95": _number(metric["ci95"]),
    }


_method_columns = [
    *("method", "title", "scans"),
    *(f"{ratio}{kind}" for ratio in _ratios for kind in ("", "_std", "_ci95")),
    *("f1_pooled", "f1_by_area", "hz", "hz_slowest_1_percent"),
]


def _method_row(method: Mapping[str, Any]) -> dict[str, Any]:
    row: dict[str, Any] = {key: method[key] for key in ("title", "scans")}
    for ratio in _ratios:
        row.update(_mean_std_ci95(ratio, method[ratio]))
    row["f1_pooled"] = _number(method["pooled"]["f1"])
    row["f1_by_area"] = _number(method["by_area"]["f1"])
    row["hz"] = _number(method["hz"])
    row["hz_slowest_1_percent"] = _number(method["hz_slowest_1_percent"])
    return {"method": method["name"], **row}


_range_columns = ["method", "from", "to", *_ratios, "points"]


def _range_rows(method: Mapping[str, Any]) -> list[dict[str, Any]]:
    everything = {"from": 0.0, "to": float("inf"), **method["pooled"]}
    return [
        {
            "method": method["name"],
            "from": band["from"],
            "to": band["to"],
            **{ratio: _number(band[ratio]) for ratio in _ratios},
            "points": int(band["points"]),
        }
        for band in (*method["by_range"], everything)
    ]


_height_columns = [
    *("method", "points", "from", "to", "count", "with_height"),
    *(f"{metric}{kind}" for metric in _height_metrics for kind in ("", "_std", "_ci95")),
]


_height_points = (
    ("ground", "ground"),
    ("all", "everywhere"),
    ("common ground", "common_ground"),
    ("common all", "common_everywhere"),
)


def _height_rows(method: Mapping[str, Any]) -> list[dict[str, Any]]:
    rows = []
    for points, key in _height_points:
        heights = method.get("heights", {}).get(key)
        if heights is None:
            continue
        for band in (*heights["by_range"], {"from": 0.0, "to": float("inf"), **heights}):
            row = {"method": method["name"], "points": points, "from": band["from"], "to": band["to"]}
            row.update(count=band["points"], with_height=_number(band["with_height"]))
            for metric in _height_metrics:
                row.update(_mean_std_ci95(metric, band[metric]))
            rows.append(row)
    return rows


_moving_columns = [
    *("name", "from", "to", *_moving_ratios),
    *("iou_mean", "iou_mean_std", "iou_mean_ci95"),
    *_moving_counts,
]


def _moving_rows(source: Mapping[str, Any]) -> list[dict[str, Any]]:
    everything = {**source, "from": 0.0, "to": source["by_range"][-1]["to"]}
    return [
        {
            "name": source["name"],
            "from": band["from"],
            "to": band["to"],
            **{ratio: _number(band[ratio]) for ratio in _moving_ratios},
            **_mean_std_ci95("iou_mean", band["mean_iou"]),
            **{count: int(band[count]) for count in _moving_counts},
        }
        for band in (*source["by_range"], everything)
    ]
