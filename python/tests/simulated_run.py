# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A simulated run, segmented and mapped, and the directory that a mapping command writes for it."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

import flagstone

Floats = npt.NDArray[np.float64]


@dataclass
class Run:
    """Scans with their results and poses, and the map of all of them."""

    files: list[Path]
    scans: list[npt.NDArray[np.float32]]
    results: list[flagstone.Segmentation]
    poses: list[Floats]
    """(4, 4) each."""
    classes: list[npt.NDArray[np.uint32]]
    moving: list[npt.NDArray[np.bool_]]
    true_heights: list[npt.NDArray[np.float32]]
    """z of the ground at each point, sensor frame."""
    map: flagstone.GroundMap
    vote: flagstone.LabelVote
    levellings: list[flagstone.Levelling] = field(default_factory=list)


def simulated_run(folder: Path, *, scene: str = "urban_street", frames: int = 12, speed: float = 4) -> Run:
    simulated = flagstone.simulate(
        folder, scene=scene, sensor="vlp-16", frames=frames, rate=4, speed=speed, pose_noise="jitter", seed=3
    )
    segmenter = flagstone.Surface(sensor="vlp-16")
    sequence = Path(simulated[0].scan).parents[1]
    poses = np.loadtxt(sequence / "poses_measured.txt").reshape(-1, 3, 4)
    run = Run([], [], [], [], [], [], [], flagstone.GroundMap(), flagstone.LabelVote())
    for scan, pose in zip(simulated, poses, strict=True):
        points = np.fromfile(scan.scan, np.float32).reshape(-1, 4)
        result = segmenter.segment(points)
        levelling = run.map.add(points, result, pose)
        run.vote.add(points, result, pose, levelling)
        run.files.append(Path(scan.scan))
        run.scans.append(points)
        run.results.append(result)
        run.poses.append(np.vstack([pose, [0, 0, 0, 1]]))
        run.levellings.append(levelling)
        run.classes.append(np.fromfile(scan.labels, np.uint32))
        run.moving.append(np.load(scan.motion) == 2)
        run.true_heights.append(np.load(scan.ground))
    return run


def write_map(run: Run, directory: Path) -> Path:
    """The output directory of a run, as docs/reference/file-formats.md describes it."""
    for name in ("ground", "labels", "moving"):
        (directory / name).mkdir(parents=True)
    rows = [levelling.corrected(pose).ravel() for levelling, pose in zip(run.levellings, run.poses, strict=True)]
    np.savetxt(directory / "poses.txt", rows)
    for file, points, result, pose, levelling, moving in zip(
        run.files, run.scans, run.results, run.poses, run.levellings, run.moving, strict=True
    ):
        labels = run.vote.relabel(points, result, pose, levelling)
        flagstone.io.write_labels(directory / "labels" / f"{file.stem}.label", labels)
        np.save(directory / "moving" / f"{file.stem}.moving.npy", moving.astype(np.uint8))
    (directory / "run.json").write_text(json.dumps({"scans": [str(file) for file in run.files]}))
    run.map.write(directory / "ground")
    return directory
