# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Methods scored on labelled scans, as data frames."""

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

_shares = ("precision", "recall", "f1", "accuracy", "iou")
_height_figures = ("median", "percentile95", "bias")


@dataclass(frozen=True, repr=False, eq=False)
class Evaluation:
    """What `evaluate` found. Shares are 0 to 1, lengths metres; NaN where the scans allow no figure.

    Attributes:
        methods: A row a method, in the order asked for; index `method`. `title`, `scans` (how many it stands on), then
            of `precision`, `recall`, `f1`, `accuracy` and `iou` the mean over scans, `..._std` (sample standard
            deviation) and `..._ci95` (half width of the 95 % interval of the mean, Student's t); `f1_pooled` (each
            point counts once), `f1_by_area` (each 0.5 m cell of each scan counts once), `hz` and
            `hz_slowest_1_percent` (scans a second, `segment` alone).
        scans: A row a method and scan: `method`, `scan`, the five shares, counts of points `tp`, `fp`, `fn`, `tn`, F1
            by horizontal range (`f1_0_10m` ...) and area, `milliseconds`; with true heights `height_median_0_20m` and
            so on, metres, over points of the ground.
        ranges: A row a method and band of horizontal range, points pooled over scans: `method`, `from`, `to` (metres;
            the row to infinity is over all points), the five shares, `points`.
        heights: A row a method, `points` (`ground`, or `all` of them, also where the ground is hidden) and band:
            `count` of points, `with_height` (the share that has one), means over scans of the `median` and
            `percentile95` of the absolute error and of the `bias`, metres, each with `..._std` and `..._ci95`. Empty
            where the dataset has no true heights.
        failed: A row a scan that could not be read, or that a method failed on: `scan`, `error`.
        unscored: Scans left out, since no point of them is scored.
        without_ground: Number of scans without ground in the ground truth. They have an accuracy alone: their
            precision, recall, F1 and IoU are NaN, and the means leave them out.
        protocol: Which classes were ground.
        datasets: Their names.
        threads: Scans worked on at once; `hz` depends on it.
        machine: Processor and cores.
        date: Day of the run, YYYY-MM-DD.
    """

    methods: pandas.DataFrame
    scans: pandas.DataFrame
    ranges: pandas.DataFrame
    heights: pandas.DataFrame
    failed: pandas.DataFrame
    unscored: tuple[str, ...]
    without_ground: int
    protocol: str
    datasets: tuple[str, ...]
    threads: int
    machine: str
    date: str

    def _heading(self) -> str:
        count = self.scans["scan"].nunique()
        scans = "1 scan" if count == 1 else f"{count} scans"
        return f"{scans} of {', '.join(self.datasets)}, protocol {self.protocol}"

    def _brief(self) -> pandas.DataFrame:
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
    threads: int | None = None,
) -> Evaluation:
    """Scores methods on labelled scans, as `flagstone eval` does.

    Args:
        dataset: One or several of: a SemanticKITTI tree (`sequences/NN`; also what `simulate` writes), a folder with
            `velodyne/` and `labels/`, a folder of nuScenes-lidarseg files.
        methods: Names of `flagstone.method_names()`, or `"table1"`, `"all"`, `"none"`.
        protocol: `"patchwork"`, `"patchwork++"`, `"simulation"`, `"lidarseg"`, or a `.toml` or `.json` file.
        sequences: Those to take, such as `["05", "10"]`; all by default.
        every: Take one scan in so many of each sequence, 1 to 1,000,000.
        columns: Floats a point in `.bin` files, 3 to 1024; 5 for `.pcd.bin`, else 4.
        sensor: Derive settings from this sensor: a name, or a `.toml` file.
        sensor_height: Metres above the ground, `"estimate"` or `"track"`.
        tilt: `"off"`, `"estimate"`, or where up is in the sensor's frame: x, y, z.
        preset: Patchwork's settings to start from: `"default"`, `"paper"`, `"reference"`.
        config: A TOML file of Patchwork's settings, as `flagstone config` prints.
        settings: Of methods, by name: `{"surface": {"point": {"margin": 0.2}}, "gpf": {"segments": 5}}`.
        labels: Labels that other programs made, scored like a method: its name, and the folder.
        label_map: Codes in `labels`: `"flagstone"` (1 is ground), or `"semantic-kitti"` (the protocol's classes).
        threads: Scans worked on at once, 1 to 1024; all cores by default. `hz` is comparable with 1.

    Returns:
        Data frames of a row a method, a row a method and scan, and by range. Scans that failed are in `failed`, with
        a warning.

    Raises:
        FileNotFoundError: A dataset is not there.
        ValueError: An argument is wrong, or the dataset has no scans with labels.
        OSError: No scan could be read.
        ImportError: pandas is not installed.
        KeyboardInterrupt: Ctrl-C.
    """
    needs("pandas", "pandas")
    datasets = [dataset] if isinstance(dataset, (str, os.PathLike)) else list(dataset)
    for each in datasets:
        if not Path(each).exists():
            raise FileNotFoundError(f"{os.fspath(each)}: no such dataset")
    if label_map not in ("flagstone", "semantic-kitti"):
        raise ValueError(f"label_map = {label_map!r} is not known (expected flagstone or semantic-kitti)")
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
            threads,
            draw,
            terminal_columns,
        )
    reason = (
        errors[0] + (f" (and {len(errors) - 1} more)" if len(errors) > 1 else "") if errors else "no scan is scored"
    )
    if not results:
        raise OSError(reason)
    evaluation = _read(results, table)
    if len(evaluation.failed) > 0:
        warnings.warn(f"{len(evaluation.failed)} failed, see `failed`: {reason}", RuntimeWarning, stacklevel=2)
    return evaluation


def _read(results_json: str, table: bytes) -> Evaluation:
    pd = needs("pandas", "pandas")
    results = json.loads(results_json)
    methods = results["methods"]
    names = {"method": str, "scan": str}
    return Evaluation(
        methods=pd.DataFrame([_method_row(method) for method in methods]).set_index("method"),
        scans=pd.read_csv(io.BytesIO(table), dtype=names, keep_default_na=False, na_values=[""]),
        ranges=pd.DataFrame([row for method in methods for row in _range_rows(method)]),
        heights=pd.DataFrame([row for method in methods for row in _height_rows(method)], columns=_height_columns),
        failed=pd.DataFrame(results["failed"], columns=["scan", "error"]),
        unscored=tuple(results["unscored"]),
        without_ground=results["without_ground"],
        protocol=results["protocol"],
        datasets=tuple(results["datasets"]),
        threads=results["threads"],
        machine=results["machine"],
        date=results["date"],
    )


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def _spread(name: str, figure: Mapping[str, float | None]) -> dict[str, float]:
    return {
        name: _number(figure["mean"]),
        f"{name}_std": _number(figure["std"]),
        f"{name}_ci95": _number(figure["ci95"]),
    }


def _method_row(method: Mapping[str, Any]) -> dict[str, Any]:
    row: dict[str, Any] = {key: method[key] for key in ("title", "scans")}
    for share in _shares:
        row.update(_spread(share, method[share]))
    row["f1_pooled"] = _number(method["pooled"]["f1"])
    row["f1_by_area"] = _number(method["by_area"]["f1"])
    row["hz"] = _number(method["hz"])
    row["hz_slowest_1_percent"] = _number(method["hz_slowest_1_percent"])
    return {"method": method["name"], **row}


def _range_rows(method: Mapping[str, Any]) -> list[dict[str, Any]]:
    everything = {"from": 0.0, "to": float("inf"), **method["pooled"]}
    return [
        {
            "method": method["name"],
            "from": band["from"],
            "to": band["to"],
            **{share: _number(band[share]) for share in _shares},
            "points": int(band["points"]),
        }
        for band in (*method["by_range"], everything)
    ]


_height_columns = [
    *("method", "points", "from", "to", "count", "with_height"),
    *(f"{figure}{kind}" for figure in _height_figures for kind in ("", "_std", "_ci95")),
]


def _height_rows(method: Mapping[str, Any]) -> list[dict[str, Any]]:
    rows = []
    for points, key in (("ground", "ground"), ("all", "everywhere")):
        heights = method.get("heights", {}).get(key)
        if heights is None:
            continue
        for band in (*heights["by_range"], {"from": 0.0, "to": float("inf"), **heights}):
            row = {"method": method["name"], "points": points, "from": band["from"], "to": band["to"]}
            row.update(count=band["points"], with_height=_number(band["with_height"]))
            for figure in _height_figures:
                row.update(_spread(figure, band[figure]))
            rows.append(row)
    return rows
