# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Simulated scans with exact ground truth."""

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
    """A scan that `simulate` wrote: its index in the sequence, its files and the position of the sensor."""

    sequence: str
    """Name of the sequence, two digits."""
    frame: int
    """Index in the sequence, from 0."""
    drive: int
    """Index of the environment that the scan was simulated in, from 0."""
    scan: str
    """Path of the points: x, y, z, intensity, float32."""
    labels: str
    """Path of the ground-truth classes, with SemanticKITTI's codes."""
    ground: str
    """Path of the true z of the ground at each point, metres."""
    returns: str
    """Path of the origin of each return (surface, rain, reflection and so on)."""
    motion: str
    """Path of the motion of the object at each point: 0 none, 1 later, 2 now."""
    points: int
    """Number of points."""
    ground_share: float
    """Fraction of the points that are ground under protocol `simulation`, 0 to 1; NaN without points."""
    x: float
    """x of the sensor in its environment, metres."""
    y: float
    """y of the sensor, metres."""
    z: float
    """z of the sensor, metres."""


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
    length: float = 72,
    loop: bool = False,
    rate: float = 1,
    speed: float = 8,
    distortion: bool = False,
    pose_noise: str = "none",
    seed: int = 1,
    sequence: str = "00",
    threads: int | None = None,
) -> list[SimulatedScan]:
    """Simulates a sequence of scans with exact ground truth, as `flagstone simulate` does.

    The files are written to `output/sequences/NN` in the layout of SemanticKITTI, which `evaluate(output)` reads.
    Existing frames are kept: call again with the same arguments to resume an interrupted simulation, or with more
    frames to extend it. The same arguments give bit-identical files for any number of threads.

    Args:
        output: Output directory, created if it does not exist.
        scene: Scene to simulate: `"flat_street"`, `"steep_street"`, `"parked_cars"`, `"bushes_and_lawn"`,
            `"bumpy_field"`, `"steps"`, `"park"`, `"forest_track"`, `"ploughed_field"`, `"embankment"`,
            `"construction_site"`, `"urban_street"`, `"highway"`, `"drops"`, `"crossroads"`, `"ramp"`, `"tunnel"`,
            `"indoor_hall"`.
        sensor: A name from `flagstone.sensors()`, or a `.toml` file.
        sensor_height: Height of the sensor above the ground in metres, 0 to 100; the sensor's usual height by default.
        tilt: Pitch and roll of the sensor in degrees, -90 to 90 each. Positive pitch tilts the sensor down ahead,
            positive roll lowers its right side.
        noise: `"clean"`, `"default"` or `"harsh"`.
        weather: One or more of `"clear"`, `"wet"`, `"rain"` and `"dust"`.
        keep_no_returns: Write missing returns as points at (0, 0, 0), like many drivers.
        frames: Number of scans, 1 to 100,000. A new environment starts behind the end of the previous one.
        length: Length of an environment in metres, 72 to 20,000, rounded up to a multiple of 72. More than 72 for the
            scenes `"parked_cars"`, `"park"`, `"forest_track"`, `"urban_street"`, `"highway"` and `"crossroads"`.
        loop: Environments are circuits of `length`, at least 700 m, which the vehicle passes twice.
        rate: Scans per second, 0.1 to 100. With 10, the sensor moves 0.8 m between scans.
        speed: Speed of the vehicle in m/s, 0.1 to 30. Traffic is as fast, compared with the vehicle, as at 8 m/s.
        distortion: Motion distortion: the sensor moves while it measures a scan. `times/NNNNNN.time.npy` contains the
            time of each point after the first firing of its scan, in seconds.
        pose_noise: Errors of the poses in `poses_measured.txt`: `"none"` (no such file), `"jitter"` or `"drift"`.
        seed: Seed of the environments and the noise, 0 to 2**64 - 1.
        sequence: Name of the sequence, two digits. One directory can contain several sequences.
        threads: Number of scans to process in parallel, 1 to 1,024; all cores by default.

    Returns:
        The scans with their files, in order. `pandas.DataFrame(scans)` converts them to a data frame.

    Raises:
        ValueError: An argument is invalid, or the directory contains a sequence made with other arguments.
        OSError: Files cannot be written.
        KeyboardInterrupt: You pressed Ctrl-C; the same call resumes the simulation.
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
            float(length),
            loop,
            float(rate),
            float(speed),
            distortion,
            pose_noise,
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
        motion=str(folder / "motion" / f"{name}.motion.npy"),
        points=len(classes),
        ground_share=float(np.isin(classes, _ground_classes).mean()) if len(classes) > 0 else float("nan"),
        x=x,
        y=y,
        z=z,
    )
