# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Simulated scans with exact ground truth, and the list of their files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._runs import listed, run

PathLike = str | os.PathLike[str]

_ground_classes = (40, 44, 48, 49, 60, 72)  # protocol "simulation"


class SimulatedScan(NamedTuple):
    """A scan that `simulate` wrote: its place in the sequence, its files, and where the sensor was."""

    sequence: str
    """Two digits."""
    frame: int
    """From 0."""
    drive: int
    """From 0; the scans of one drive are of one environment."""
    scan: str
    """File of the points: x, y, z, intensity, float32."""
    labels: str
    """File of the classes, SemanticKITTI's."""
    ground: str
    """File of the true z of the ground at each point, metres."""
    returns: str
    """File of what each point is a return of."""
    points: int
    """Number of points."""
    ground_share: float
    """Fraction of the points on the ground, 0 to 1, by the classes of protocol `simulation`; NaN without points."""
    x: float
    """Position of the sensor in the environment of its drive, metres."""
    y: float
    z: float


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
) -> list[SimulatedScan]:
    """Simulates a sequence of scans with exact ground truth, as `flagstone simulate` does.

    The files lie below `output/sequences/NN` as SemanticKITTI lays out a sequence, so that `evaluate(output)` reads
    them. Frames that are there already are kept: an interrupted call continues where it ended, and a call with more
    frames adds to them. The same arguments give the same bytes, for any number of threads.

    Args:
        output: The directory; created if missing.
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
        keep_no_returns: Write missing returns as points at (0, 0, 0), as many drivers do.
        frames: Scans, 1 to 100,000; every 10 in a new environment, a drive.
        seed: Which environments, 0 to 2**64 - 1.
        sequence: Two digits, so that one directory can hold several sequences.
        threads: Scans worked on at once, 1 to 1024; all cores by default.

    Returns:
        The scans with their files, in order; `pandas.DataFrame(scans)` makes a data frame of them.

    Raises:
        ValueError: An argument is wrong, or the folder holds something else.
        OSError: Files cannot be written.
        KeyboardInterrupt: Ctrl-C; the same call continues.
    """
    with run() as (draw, columns):
        frames_per_drive = _core.simulate(
            os.fspath(output),
            scene,
            os.fspath(sensor),
            sensor_height,
            ",".join(map(str, tilt)),
            noise,
            listed(weather),
            keep_no_returns,
            frames,
            seed,
            sequence,
            threads,
            draw,
            columns,
        )
    folder = Path(output) / "sequences" / sequence
    poses = np.loadtxt(folder / "poses.txt", ndmin=2).reshape(-1, 3, 4)
    return [_scan(folder, number, number // frames_per_drive, poses[number, :, 3]) for number in range(frames)]


def _scan(folder: Path, frame: int, drive: int, position: npt.NDArray[np.float64]) -> SimulatedScan:
    name = f"{frame:06}"
    labels = folder / "labels" / f"{name}.label"
    classes = np.fromfile(labels, "<u4") & 0xFFFF
    x, y, z = position.tolist()
    return SimulatedScan(
        sequence=folder.name,
        frame=frame,
        drive=drive,
        scan=str(folder / "velodyne" / f"{name}.bin"),
        labels=str(labels),
        ground=str(folder / "ground" / f"{name}.ground.npy"),
        returns=str(folder / "returns" / f"{name}.return.npy"),
        points=len(classes),
        ground_share=float(np.isin(classes, _ground_classes).mean()) if len(classes) > 0 else float("nan"),
        x=x,
        y=y,
        z=z,
    )
