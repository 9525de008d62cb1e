# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Scans as a sensor takes them that stands otherwise, or sees less, or sees what is not there. Needs NumPy."""

import typing

import numpy as np

HEIGHT = 1.73  # of the sensor, metres
GROUND = (40, 44, 48, 49, 60, 72)  # classes of SemanticKITTI
OUTLIER = 1  # what its annotators call ghosts; the protocol `patchwork++` does not score it
OTHER_OBJECT = 99  # a class that it scores, and not as ground


class Disturbance(typing.NamedTuple):
    """What happens to a scan: (points (N, 4), classes (N,), random) -> the same and where each point came from."""

    name: str
    disturb: typing.Callable
    sensor_height: float = HEIGHT  # what the methods are told


def unchanged(points, classes, _random):
    return points, classes, range(len(points))


def tilted(degrees, axis):
    """By a right-handed turn around the axis x (0: roll) or y (1: pitch)."""

    def disturb(points, classes, _random):
        angle = np.radians(degrees)
        before, behind = [(1, 2), (2, 0)][axis]
        turned = points.copy()
        turned[:, before] = np.cos(angle) * points[:, before] - np.sin(angle) * points[:, behind]
        turned[:, behind] = np.sin(angle) * points[:, before] + np.cos(angle) * points[:, behind]
        return turned, classes, range(len(points))

    return disturb


def kept(choose):
    """Only the points that `choose` says of which are kept."""

    def disturb(points, classes, _random):
        where = np.flatnonzero(choose(points))
        return points[where], classes[where], where

    return disturb


def azimuths(points):
    """0 to 2 pi, from straight ahead counter-clockwise."""
    return np.arctan2(points[:, 1], points[:, 0]) % (2 * np.pi)


def every_other_beam(points):
    """KITTI's files hold beam by beam: a new one begins where the azimuth starts over."""
    starts = np.diff(azimuths(points), prepend=0) < -np.pi
    return np.cumsum(starts) % 2 == 0


def quarter(direction):
    """90 degrees around a direction, in degrees."""

    def choose(points):
        away = (azimuths(points) - np.radians(direction) + np.pi) % (2 * np.pi) - np.pi
        return np.abs(away) < np.pi / 4

    return choose


def with_ghosts(their_class):
    """One point in a hundred more: mirror images, below the ground, of points 0.3 m or more above it."""

    def disturb(points, classes, random):
        picked, heights = ghosts_of(points, np.isin(classes & 0xFFFF, GROUND), random)
        ghosts = points[picked].copy()
        ghosts[:, 2] = heights
        return (
            np.concatenate([points, ghosts]),
            np.concatenate([classes, np.full(len(picked), their_class, classes.dtype)]),
            np.concatenate([np.arange(len(points)), np.full(len(picked), -1)]),
        )

    return disturb


def ghosts_of(points, is_ground, random):
    """Some points whose mirror images appear, and the heights of these; the ground is that of cells of 2 m."""
    cell = np.floor(points[:, :2] / 2).astype(np.int64)
    key = (cell[:, 0] + 1000) * 2000 + cell[:, 1] + 1000
    keys, inverse = np.unique(key, return_inverse=True)
    count = np.bincount(inverse[is_ground], minlength=len(keys))
    heights = np.bincount(inverse[is_ground], weights=points[is_ground, 2], minlength=len(keys))
    ground = np.where(count > 0, heights / np.maximum(count, 1), np.nan)[inverse]
    sources = np.flatnonzero(points[:, 2] > ground + 0.3)  # false where no ground is known
    picked = random.choice(sources, len(points) // 100, replace=False)
    return picked, 2 * ground[picked] - points[picked, 2]


DISTURBANCES = [
    Disturbance("none", unchanged),
    Disturbance("height set 0.3 m too small", unchanged, sensor_height=HEIGHT - 0.3),
    Disturbance("height set 0.3 m too large", unchanged, sensor_height=HEIGHT + 0.3),
    Disturbance("rolled by +3°", tilted(3, axis=0)),
    Disturbance("rolled by -3°", tilted(-3, axis=0)),
    Disturbance("pitched by +3°", tilted(3, axis=1)),
    Disturbance("pitched by -3°", tilted(-3, axis=1)),
    Disturbance("half the beams", kept(every_other_beam)),
    *(
        Disturbance(f"90° of the view, {where}", kept(quarter(direction)))
        for where, direction in (("ahead", 0), ("left", 90), ("behind", 180), ("right", 270))
    ),
    Disturbance("1 % ghosts", with_ghosts(OUTLIER)),
    Disturbance("1 % ghosts, each a point to be scored", with_ghosts(OTHER_OBJECT)),
]


def write_copies(kitti, before, methods, disturb, folder):
    """Disturbed scans in `folder`, and the labels that their points had `before`, by method."""
    for kind in ("velodyne", "labels", *methods):
        (folder / kind).mkdir(parents=True)
    random = np.random.default_rng(1)
    for file in sorted((kitti / "velodyne").glob("*.bin")):
        points = np.fromfile(file, "<f4").reshape(-1, 4)
        classes = np.fromfile(kitti / "labels" / f"{file.stem}.label", "<u4")
        moved, their_classes, sources = disturb(points, classes, random)
        moved.astype("<f4").tofile(folder / "velodyne" / file.name)
        their_classes.astype("<u4").tofile(folder / "labels" / f"{file.stem}.label")
        sources = np.asarray(sources)
        for method in methods:
            labels = np.fromfile(before / method / f"{file.stem}.label", "<u4")
            np.where(sources < 0, 0, labels[sources]).astype("<u4").tofile(folder / method / f"{file.stem}.label")
