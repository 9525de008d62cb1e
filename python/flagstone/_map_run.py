# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Maps of runs: labels from all scans, points that move, and the ground as one map."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from flagstone import _core
from flagstone._map_input import InputRequest, prepare_input
from flagstone._runs import run as running
from flagstone.maps._exports import Exports
from flagstone.maps._run_files import MappedRun, read_run
from flagstone.maps._tiles import read_json
from flagstone.segmenters import Surface

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from flagstone.segmenters import SensorHeight, Tilt
    from flagstone.settings import SurfaceSettings

PathLike = str | os.PathLike[str]


@dataclass(frozen=True)
class MapSummary:
    """Result of `map`: counts, and where the files are."""

    directory: Path
    """The output directory."""
    scans: int
    """Number of scans of the run."""
    mapped: int
    """Scans that are part of the map."""
    alone: int
    """Scans without a usable pose, or whose ground does not fit the map: labelled alone."""
    failed: int
    """Scans that could not be read or segmented. They have no labels."""
    moving_points: int
    """Points that move, of all scans."""
    static_points: int
    """Points of `static.ply`."""
    path: float
    """Length of the path through the mapped scans, metres."""
    area: float
    """Area of the map, square metres."""
    map_bytes: int
    """Memory of the map, bytes."""
    vote_bytes: int
    """Memory of the votes of labels, bytes."""
    seconds: float
    """Time for mapping, without preparation and exports."""
    problems: tuple[str, ...] = ()
    """One line per decision and problem: scans that were labelled alone or failed, poses that do not fit."""
    exports: tuple[Path, ...] = ()
    """The files of `geotiff`, `las`, `recording` and `animation` that were written."""

    def open(self) -> MappedRun:
        """Opens the output directory, as `flagstone.maps.read_run` does."""
        return read_run(self.directory)


def map(
    run: PathLike,
    poses: PathLike,
    output: PathLike,
    *,
    labels: Literal["live", "delayed", "offline"] = "offline",
    delay: float = 2.0,
    heights: bool = False,
    voxel: float = 0.2,
    rate: float | None = None,
    map_memory: int = 1000,
    columns: int | None = None,
    topic: str | None = None,
    pose_topic: str | None = None,
    geotiff: bool = False,
    crs: str | int | None = None,
    las: bool = False,
    recording: bool = False,
    animation: bool = False,
    sensor: PathLike | None = None,
    sensor_height: SensorHeight | None = None,
    tilt: Tilt | None = None,
    config: PathLike | None = None,
    threads: int | None = None,
    **settings: Unpack[SurfaceSettings],
) -> MapSummary:
    """Maps a run, as `flagstone map` does: labels from all its scans, points that move, and one ground.

    Poses are checked. A scan without a usable pose is labelled alone, and `problems` contains the reason. The output
    does not depend on the number of threads. The same call resumes an interrupted one. docs/reference/file-formats.md
    describes the files. `ground.png` is drawn by the command only.

    Args:
        run: Directory with the scans of a run, or with `velodyne`; or a bag of ROS 1 or ROS 2 with its clouds.
        poses: Poses of the sensor: a file (KITTI, with calib.txt if they are of the camera, TUM or CSV); a bag, whose
            odometry or transforms are read; or `"kiss-icp"`, which finds them from the scans (install
            `flagstone[odometry]`). Clouds and poses that are not files yet are written to `output/input`.
        output: Output directory, created if it does not exist. It must be empty or contain a map of the same run.
        labels: Scans that determine the labels and the moving points of a scan: `"live"`, the scans before it;
            `"delayed"`, also those of `delay` seconds after it; `"offline"`, all scans.
        delay: For `"delayed"`, 0 to 10 seconds.
        heights: Write the height of each point above the ground to `heights/NAME.heights.npy`.
        voxel: Voxel size of `static.ply`, 0.01 to 10 metres; 0 for no cloud.
        rate: Scans per second, 0.01 to 1,000, if no file contains the times of the scans; 10 by default.
        map_memory: Memory of the map in megabytes, beyond which its tiles are kept in files; 0 for no limit.
        columns: Floats per point in `.bin` files, 3 to 1,024; by default 5 for `.pcd.bin`, otherwise 4.
        topic: Topic of the clouds, if `run` is a bag with several.
        pose_topic: Topic of the poses, if `poses` is a bag: of Odometry, PoseStamped or
            PoseWithCovarianceStamped, `"/tf"`, or `"/tf:FRAME"` for the poses in frame FRAME.
        geotiff: Write the map as `ground.tif` (install `flagstone[geotiff]`).
        crs: Coordinate reference system of the poses for `ground.tif`, for example `"EPSG:25832"`.
        las: Write the static points as `static.las` (install `flagstone[las]`); needs `voxel`.
        recording: Write `recording.rrd` for the viewer of Rerun (install `flagstone[viewer]`).
        animation: Write `animation.gif` (install `flagstone[plot]`).
        sensor: Sensor to derive settings from: a name from `flagstone.sensors()`, or a `.toml` file.
        sensor_height: Height of the sensor above the ground in metres, or `"estimate"`.
        tilt: Up direction (x, y, z) in the sensor frame, `"off"` or `"estimate"`.
        config: TOML file of settings, as `flagstone config --method surface` prints them.
        threads: Number of scans to label in parallel, 1 to 1,024; all cores by default.
        **settings: Settings of `Surface` by name, tables as dictionaries, for example `point={"margin": 0.2}`.

    Returns:
        Counts and problems. Its `open()` reads the files scan by scan.

    Raises:
        FileNotFoundError: The run or the poses do not exist.
        ValueError: An argument is invalid, the output directory contains other files, or an output would overwrite an
            input.
        OSError: A file cannot be read or written.
        ImportError: An optional package is not installed.
        KeyboardInterrupt: You pressed Ctrl-C; the same call resumes the mapping.

    Warns:
        RuntimeWarning: Some scans failed or were labelled alone, or an export was not written.
    """
    exports = Exports(geotiff=geotiff, crs=crs, las=las, recording=recording, animation=animation)
    exports.check()
    if las and voxel == 0:
        raise ValueError("las: needs the static points (expected voxel above 0)")
    problems: list[str] = []
    given = InputRequest(os.fspath(run), os.fspath(poses), os.fspath(output), topic, pose_topic, columns)

    def request_of(scans: PathLike, file: PathLike) -> _core.MapRequest:
        return _core.map_request(
            run=os.fspath(scans),
            poses=os.fspath(file),
            output=given.output,
            labels=labels,
            delay=float(delay),
            heights=heights,
            voxel=float(voxel),
            rate=None if rate is None else float(rate),
            map_memory=map_memory,
            columns=columns,
            sensor="" if sensor is None else os.fspath(sensor),
            sensor_height=sensor_height,
            tilt=tilt if tilt is None or isinstance(tilt, str) else tuple(tilt),
            config="" if config is None else os.fspath(config),
            settings=dict(settings),
            threads=threads,
        )

    def segmenter() -> Surface:
        return Surface(sensor=sensor, sensor_height=sensor_height, tilt=tilt, config=config, **settings)

    with running() as (draw, terminal_columns):
        _core.check_map_request(request_of(run, poses))
        found = prepare_input(given, segmenter, report=problems.append)
        counts = _core.map_run(request_of(found.run, found.poses), draw, terminal_columns)
    directory = Path(output)
    problems += read_json(directory / "run.json")["problems"]
    files = exports.write(directory, problems.append)
    summary = MapSummary(directory, **counts, problems=tuple(problems), exports=tuple(files))
    _warn(summary, exports)
    return summary


def _warn(summary: MapSummary, exports: Exports) -> None:
    """Warns if some scans or exports are not as wanted."""
    unwritten = exports.geotiff + exports.las + exports.recording + exports.animation - len(summary.exports)
    counts = [(summary.failed, "failed"), (summary.alone, "labelled alone")]
    parts = [f"{count} of {summary.scans} scans {what}" for count, what in counts if count > 0]
    if unwritten:
        parts.append(f"{unwritten} exports not written")
    if parts:
        reason = summary.problems[0] if summary.problems else "unknown"
        warnings.warn(f"{', '.join(parts)}, see `problems`: {reason}", RuntimeWarning, stacklevel=3)
