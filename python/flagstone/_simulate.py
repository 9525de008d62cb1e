# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Simulated scans with exact truth, and a data frame of their files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from flagstone._optional import needs
from flagstone._run_command import listed, option, run

if TYPE_CHECKING:
    import pandas

PathLike = str | os.PathLike[str]

_ground_classes = (40, 44, 48, 49, 60, 72)  # protocol "simulation"
_frames_per_drive = 10


def simulate(
    output: PathLike,
    *,
    scene: str,
    sensor: PathLike = "hdl-64e",
    sensor_height: float | None = None,
    tilt: Sequence[float] = (0.0, 0.0),
    noise: str = "default",
    weather: str | Sequence[str] = "clear",
    keep_no_returns: bool = False,
    frames: int = 200,
    seed: int = 1,
    sequence: str = "00",
    threads: int | None = None,
) -> pandas.DataFrame:
    """Simulates a sequence of scans with exact truth, as `flagstone simulate` does.

    The files lie below `output/sequences/NN` as SemanticKITTI lays out a sequence, so that `evaluate(output)` reads
    them. Frames that are there already are kept: an interrupted call goes on where it ended, and a call with more
    frames adds to them. The same arguments give the same bytes, for any number of threads.

    Args:
        output: The folder; made if missing.
        scene: What is simulated: `"flat_street"`, `"steep_street"`, `"parked_cars"`, `"bushes_and_lawn"`,
            `"bumpy_field"`, `"steps"`, `"park"`, `"forest_track"`, `"ploughed_field"`, `"embankment"`,
            `"construction_site"`, `"urban_street"`, `"highway"`, `"drops"`, `"crossroads"`, `"ramp"`, `"tunnel"`,
            `"indoor_hall"`.
        sensor: A name of `flagstone.sensors()`, or a `.toml` file.
        sensor_height: Metres above the ground, 0 to 100; where the sensor usually is by default.
        tilt: Pitch and roll of the sensor on its vehicle, degrees, -90 to 90 each: positive pitch looks down ahead,
            positive roll has the right side lower.
        noise: `"clean"`, `"default"` or `"harsh"`.
        weather: One or more of `"clear"`, `"wet"`, `"rain"`, `"dust"`.
        keep_no_returns: Write beams without echo as points at (0, 0, 0), as many drivers do.
        frames: Scans, 1 to 100,000; every 10 a new world, a drive.
        seed: Which worlds, from 0.
        sequence: Two digits, so that one folder can hold several sequences.
        threads: Scans worked on at once, 1 to 1024; all cores by default.

    Returns:
        A row a scan: `sequence`, `frame`, `drive`; the files `scan` (x, y, z, intensity, float32), `labels`
        (SemanticKITTI's classes), `ground` (true z of the ground at each point) and `echoes` (what each point is an
        echo of); `points`, `ground_share` (0 to 1, by the classes of protocol `simulation`); `x`, `y`, `z` of the
        sensor in the world of its drive, metres.

    Raises:
        ValueError: An argument is wrong, or the folder holds something else.
        OSError: Files cannot be written.
        ImportError: pandas is not installed.
    """
    needs("pandas", "pandas")
    arguments = [
        *("simulate", f"--output={os.fspath(output)}", f"--scene={scene}"),
        *option("sensor", os.fspath(sensor)),
        *option("sensor-height", sensor_height),
        *option("tilt", listed(tilt)),
        *option("noise", noise),
        *option("weather", listed(weather)),
        *(["--keep-no-returns"] if keep_no_returns else []),
        *option("frames", frames),
        *option("seed", seed),
        *option("sequence", sequence),
        *option("threads", threads),
    ]
    ended = run(arguments)
    if ended.code != 0:
        raise OSError(ended.reason)
    return _list_sequence(Path(output) / "sequences" / sequence, frames)


def _list_sequence(folder: Path, frames: int) -> pandas.DataFrame:
    poses = np.loadtxt(folder / "poses.txt", ndmin=2).reshape(-1, 3, 4)
    rows = []
    for number in range(frames):
        name = f"{number:06}"
        labels = folder / "labels" / f"{name}.label"
        classes = np.fromfile(labels, "<u4") & 0xFFFF
        rows.append(
            {
                "sequence": folder.name,
                "frame": number,
                "drive": number // _frames_per_drive,
                "scan": str(folder / "velodyne" / f"{name}.bin"),
                "labels": str(labels),
                "ground": str(folder / "ground" / f"{name}.ground.npy"),
                "echoes": str(folder / "echoes" / f"{name}.echo.npy"),
                "points": len(classes),
                "ground_share": float(np.isin(classes, _ground_classes).mean()) if len(classes) > 0 else float("nan"),
                **dict(zip("xyz", poses[number, :, 3].tolist(), strict=True)),
            }
        )
    frame: pandas.DataFrame = needs("pandas", "pandas").DataFrame(rows)
    return frame
