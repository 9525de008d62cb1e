# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reads the output directory of a mapped run scan by scan."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt

from flagstone import io
from flagstone._points import columns_of
from flagstone.maps._tiles import PathLike, read_json

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MappedScan:
    """A scan of N points in the world frame."""

    number: int
    """Index in the run, from 0."""
    points: npt.NDArray[np.float32]
    """(N, 3): x, y, z in the frame of the scan, metres."""
    pose: Floats
    """(3, 4): rotation and position of the scan after levelling."""
    labels: npt.NDArray[np.uint8]
    """(N,): code of each point, see `Label`."""
    moving: npt.NDArray[np.bool_]
    """(N,): whether each point moves; all False if the run has no files of moving points."""

    @cached_property
    def world(self) -> Floats:
        """(N, 3): the points in the world frame, metres."""
        x, y, z = self.points.astype(np.float64).T
        # Matrix products of a few columns start threads, which takes longer than the computation.
        axes = [r[0] * x + r[1] * y + r[2] * z + r[3] for r in self.pose.tolist()]
        return np.stack(axes, axis=1)


@dataclass(frozen=True)
class MappedRun:
    """The output directory of a run. Its scans are read when they are needed."""

    directory: Path
    files: tuple[Path, ...]
    """The scans, in order."""
    poses: Floats
    """(S, 3, 4): rotation and position of each scan after levelling; NaN if the pose is unknown."""

    def __len__(self) -> int:
        """Number of scans."""
        return len(self.files)

    @property
    def path(self) -> Floats:
        """(S, 2): x and y of the sensor at each scan, metres; NaN if unknown."""
        path: Floats = self.poses[:, :2, 3]
        return path

    def scan(self, number: int) -> MappedScan:
        """Reads a scan with its labels.

        Args:
            number: Index of the scan, from 0.

        Raises:
            FileNotFoundError: The scan or its labels do not exist.
            ValueError: A file is damaged, or belongs to another scan.
        """
        file = self.files[number]
        points = np.stack(columns_of(io.read(file)), axis=1).astype(np.float32, copy=False)
        name = _name_of(file)
        labels = io.read_labels(self.directory / "labels" / f"{name}.label", len(points)).astype(np.uint8)
        moving_file = self.directory / "moving" / f"{name}.moving.npy"
        moving = np.zeros(len(points), np.bool_)
        if moving_file.is_file():
            moving = io.read_labels(moving_file, len(points)) != 0
        return MappedScan(number, points, self.poses[number], labels, moving)

    def scans(self, every: int = 1) -> Iterator[MappedScan]:
        """Reads every N-th scan that has a pose and labels.

        Scans whose pose is unknown, and scans that were not labelled because they could not be read, are skipped.
        """
        for number in range(0, len(self), every):
            has_labels = (self.directory / "labels" / f"{_name_of(self.files[number])}.label").is_file()
            if has_labels and np.isfinite(self.poses[number]).all():
                yield self.scan(number)


def read_run(directory: PathLike, *, scans: Sequence[PathLike] | None = None) -> MappedRun:
    """Opens the output directory of `flagstone map`.

    Args:
        directory: The output directory.
        scans: Paths of the scans in order, if they have moved since. By default those in `run.json`.

    Raises:
        FileNotFoundError: `run.json` or `poses.txt` does not exist.
        ValueError: A file is damaged, or the number of poses is not the number of scans.
    """
    folder = Path(directory)
    run = read_json(folder / "run.json")
    files = [os.fspath(scan) for scan in scans] if scans is not None else run.get("scans")
    if not isinstance(files, list) or not all(isinstance(file, str) for file in files):
        raise ValueError(f'{folder / "run.json"}: no list of scans (expected paths under the key "scans")')
    path = folder / "poses.txt"
    try:
        poses = np.loadtxt(path, np.float64, ndmin=2)
    except FileNotFoundError:
        raise FileNotFoundError(f"{path}: file does not exist (expected the output of flagstone map)") from None
    except ValueError as error:
        raise ValueError(f"{path}: {' '.join(str(error).split())} (expected 12 numbers per line)") from error
    if poses.shape != (len(files), 12):
        rows, columns = poses.shape
        raise ValueError(f"{path}: {rows} rows of {columns} numbers (expected {len(files)} rows of 12, one per scan)")
    return MappedRun(folder, tuple(Path(file) for file in files), poses.reshape(-1, 3, 4))


def _name_of(file: Path) -> str:
    """The name of a scan in the output directory: without its extension."""
    return file.name.removesuffix(".pcd.bin") if file.name.endswith(".pcd.bin") else file.stem
