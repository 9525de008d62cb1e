# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Perturbed scans: a tilted sensor, fewer points, ghost points. Needs NumPy."""

import typing

import numpy as np

HEIGHT = 1.73  # of the sensor, metres
GROUND = (40, 44, 48, 49, 60, 72)  # classes of SemanticKITTI
OUTLIER = 1  # the class of ghost points; the protocol `patchwork++` does not score it
OTHER_OBJECT = 99  # a class that the protocol scores as non-ground


class Perturbation(typing.NamedTuple):
    """A change of a scan and the sensor height that the methods are given, metres.

    `perturb(points (N, 4), classes (N,), random)` returns points, classes and, for each point, its index in the
    original scan, or -1 for an added point.
    """

    name: str
    perturb: typing.Callable
    sensor_height: float = HEIGHT


def unchanged(points, classes, _random):
    return points, classes, range(len(points))


def tilted(degrees, axis):
    """A right-handed rotation about the x axis (0, roll) or the y axis (1, pitch)."""

    def perturb(points, classes, _random):
        angle = np.radians(degrees)
        first, second = [(1, 2), (2, 0)][axis]
        turned = points.copy()
        turned[:, first] = np.cos(angle) * points[:, first] - np.sin(angle) * points[:, second]
        turned[:, second] = np.sin(angle) * points[:, first] + np.cos(angle) * points[:, second]
        return turned, classes, range(len(points))

    return perturb


def kept(choose):
    """Keeps the points for which `choose(points)` is true."""

    def perturb(points, classes, _random):
        indices = np.flatnonzero(choose(points))
        return points[indices], classes[indices], indices

    return perturb


def azimuths(points):
    """Azimuths from 0 to 2 pi, counter-clockwise from straight ahead."""
    return np.arctan2(points[:, 1], points[:, 0]) % (2 * np.pi)


def every_other_beam(points):
    """KITTI's files store one beam after another. A new beam starts at each wrap-around of the azimuth."""
    starts = np.diff(azimuths(points), prepend=0) < -np.pi
    return np.cumsum(starts) % 2 == 0


def quarter(direction):
    """A field of view of 90 degrees, centred on a direction in degrees."""

    def choose(points):
        offset = (azimuths(points) - np.radians(direction) + np.pi) % (2 * np.pi) - np.pi
        return np.abs(offset) < np.pi / 4

    return choose


def with_ghosts(ghost_class):
    """Adds 1 % ghost points: reflections, below the ground, of points at least 0.3 m above it."""

    def perturb(points, classes, random):
        picked, heights = ghosts_of(points, np.isin(classes & 0xFFFF, GROUND), random)
        ghosts = points[picked].copy()
        ghosts[:, 2] = heights
        return (
            np.concatenate([points, ghosts]),
            np.concatenate([classes, np.full(len(picked), ghost_class, classes.dtype)]),
            np.concatenate([np.arange(len(points)), np.full(len(picked), -1)]),
        )

    return perturb


def ghosts_of(points, is_ground, random):
    """Indices of points to reflect at the ground, and z of the reflections. The ground is the mean per cell of 2 m."""
    cell = np.floor(points[:, :2] / 2).astype(np.int64)
    key = (cell[:, 0] + 1000) * 2000 + cell[:, 1] + 1000
    keys, inverse = np.unique(key, return_inverse=True)
    count = np.bincount(inverse[is_ground], minlength=len(keys))
    heights = np.bincount(inverse[is_ground], weights=points[is_ground, 2], minlength=len(keys))
    ground = np.where(count > 0, heights / np.maximum(count, 1), np.nan)[inverse]
    sources = np.flatnonzero(points[:, 2] > ground + 0.3)  # NaN without ground in the cell: false
    picked = random.choice(sources, len(points) // 100, replace=False)
    return picked, 2 * ground[picked] - points[picked, 2]


PERTURBATIONS = [
    Perturbation("none", unchanged),
    Perturbation("height 0.3 m too small", unchanged, sensor_height=HEIGHT - 0.3),
    Perturbation("height 0.3 m too large", unchanged, sensor_height=HEIGHT + 0.3),
    Perturbation("rolled by +3°", tilted(3, axis=0)),
    Perturbation("rolled by -3°", tilted(-3, axis=0)),
    Perturbation("pitched by +3°", tilted(3, axis=1)),
    Perturbation("pitched by -3°", tilted(-3, axis=1)),
    Perturbation("every other beam", kept(every_other_beam)),
    *(
        Perturbation(f"90° field of view, {name}", kept(quarter(direction)))
        for name, direction in (("front", 0), ("left", 90), ("rear", 180), ("right", 270))
    ),
    Perturbation("1 % ghost points, not scored", with_ghosts(OUTLIER)),
    Perturbation("1 % ghost points, scored as non-ground", with_ghosts(OTHER_OBJECT)),
]


def write_copies(kitti, before, methods, perturb, directory):
    """Writes perturbed scans, and the labels that each method gave to their points `before`, into a directory."""
    for kind in ("velodyne", "labels", *methods):
        (directory / kind).mkdir(parents=True)
    random = np.random.default_rng(1)
    for file in sorted((kitti / "velodyne").glob("*.bin")):
        points = np.fromfile(file, "<f4").reshape(-1, 4)
        classes = np.fromfile(kitti / "labels" / f"{file.stem}.label", "<u4")
        moved, new_classes, sources = perturb(points, classes, random)
        moved.astype("<f4").tofile(directory / "velodyne" / file.name)
        new_classes.astype("<u4").tofile(directory / "labels" / f"{file.stem}.label")
        sources = np.asarray(sources)
        for method in methods:
            labels = np.fromfile(before / method / f"{file.stem}.label", "<u4")
            np.where(sources < 0, 0, labels[sources]).astype("<u4").tofile(directory / method / f"{file.stem}.label")
