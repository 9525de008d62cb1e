# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Counts errors of mapped runs: labels, heights and moving points. Needs NumPy. bench/runs_study.py uses it.

Ranges are horizontal distances from the sensor. Classes are those of SemanticKITTI.
"""

import itertools
import json
import pathlib

import numpy as np

GROUND_CLASSES = (40, 44, 48, 49, 60, 72)
UNKNOWN_CLASSES = (0, 1)  # unlabeled, outlier
MOVING_CLASSES = range(252, 260)
VEGETATION = 70
LABEL_NONGROUND, LABEL_GROUND = 0, 1  # in label files of flagstone
MOVES_LATER = 1  # in motion files of the simulator: an object that waits now

BANDS = (0, 10, 20, 40, 80)  # metres
VOXEL = 0.2  # metres, for PR and RR

IS_GROUND = np.zeros(65536, bool)
IS_GROUND[list(GROUND_CLASSES)] = True
IS_UNKNOWN = np.zeros(65536, bool)
IS_UNKNOWN[list(UNKNOWN_CLASSES)] = True
IS_MOVING = np.zeros(65536, bool)
IS_MOVING[list(MOVING_CLASSES)] = True


class Sequence:
    """A run in the layout of SemanticKITTI."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.names = sorted(file.stem for file in (self.directory / "velodyne").glob("*.bin"))

    def points(self, name):
        return np.fromfile(self.directory / "velodyne" / f"{name}.bin", "<f4").reshape(-1, 4)[:, :3]

    def classes(self, name):
        return np.fromfile(self.directory / "labels" / f"{name}.label", "<u4") & 0xFFFF

    def true_heights(self, name, points):
        """Height of each point above the true ground, metres."""
        return points[:, 2] - np.load(self.directory / "ground" / f"{name}.ground.npy")

    def times(self):
        return np.loadtxt(self.directory / "times.txt")[: len(self.names)]


def labels_in(directory, name):
    return np.fromfile(pathlib.Path(directory) / f"{name}.label", "<u4")


def heights_in(directory, name):
    return np.load(pathlib.Path(directory) / f"{name}.heights.npy")


def moving_in(mapped, name):
    return np.load(pathlib.Path(mapped) / "moving" / f"{name}.moving.npy") > 0


def ranges_of(points):
    return np.hypot(points[:, 0], points[:, 1])


def bands_of(ranges):
    """Index of the band of each point; the number of bands beyond the last one."""
    return np.searchsorted(BANDS[1:], ranges, side="right")


def read_poses(file):
    return np.loadtxt(file).reshape(-1, 3, 4)


# --- labels of points behind objects --------------------------------------------------------------------------

COLUMNS = 720  # of half a degree
BEHIND_BY = 0.5  # metres


def are_behind(points, is_object):
    """Whether an object is nearer than a point by at least BEHIND_BY, in the same column of half a degree."""
    ranges = ranges_of(points)
    column = ((np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) + 0.5) * COLUMNS).astype(int) % COLUMNS
    nearest = np.full(COLUMNS, np.inf)
    np.minimum.at(nearest, column[is_object], ranges[is_object])
    return ranges > nearest[column] + BEHIND_BY


def behind_f1(sequence, directories, every, ignored=()):
    """F1 of ground over all points behind objects, by name of the label directory."""
    counts = {name: np.zeros(3) for name in directories}
    points_behind = 0
    for scan in sequence.names[::every]:
        points, classes = sequence.points(scan), sequence.classes(scan)
        is_object = ~IS_GROUND[classes] & ~IS_UNKNOWN[classes]
        used = are_behind(points, is_object) & ~np.isin(classes, ignored)
        points_behind += int(used.sum())
        truth = IS_GROUND[classes[used]]
        for name, directory in directories.items():
            found = labels_in(directory, scan)[used] == LABEL_GROUND
            counts[name] += ((found & truth).sum(), (found & ~truth).sum(), (~found & truth).sum())
    return {name: f1_of(*count) for name, count in counts.items()}, points_behind


def f1_of(true, false, missed):
    total = 2 * true + false + missed
    return float(2 * true / total) if total else None


# --- heights --------------------------------------------------------------------------------------------------


def height_errors(sequence, directories, every, scans=slice(None)):
    """Absolute height errors by name of the directory of heights and by band, on the same points.

    The points are those of ground classes at which every directory has a height: their fraction is `known`.
    """
    errors = {name: [[] for _ in BANDS[1:]] for name in directories}
    points_in_band, known_in_band = np.zeros(len(BANDS)), np.zeros(len(BANDS))
    for scan in sequence.names[scans][::every]:
        points, classes = sequence.points(scan), sequence.classes(scan)
        truth = sequence.true_heights(scan, points)
        used = IS_GROUND[classes] & np.isfinite(truth)
        heights = {name: heights_in(directory, scan) for name, directory in directories.items()}
        band = bands_of(ranges_of(points))
        points_in_band += np.bincount(band[used], minlength=len(BANDS))
        for values in heights.values():
            used &= np.isfinite(values)
        known_in_band += np.bincount(band[used], minlength=len(BANDS))
        for index in range(len(BANDS) - 1):
            selected = used & (band == index)
            for name, values in heights.items():
                errors[name][index].append(np.abs(values[selected] - truth[selected]))
    known = [float(k / n) if n else None for k, n in zip(known_in_band[:-1], points_in_band[:-1], strict=True)]
    return {name: [quantiles(np.concatenate(band)) for band in bands] for name, bands in errors.items()}, known


def quantiles(errors):
    if not len(errors):
        return None
    median, most = np.quantile(errors, (0.5, 0.95))
    return {"median": float(median), "p95": float(most)}


def map_cells(mapped):
    """Heights of a map by tile: {(x, y): (64, 64)}."""
    directory = pathlib.Path(mapped) / "ground"
    geometry = json.loads((directory / "map.json").read_text())
    return {(t["x"], t["y"]): np.load(directory / t["file"])["height"] for t in geometry["tiles"]}, geometry["cell"]


def map_difference(one, other):
    """Absolute height differences of two maps in common cells, as they are and after a fitted plane is subtracted."""
    first, cell = map_cells(one)
    second, _ = map_cells(other)
    x, y, difference = [], [], []
    for tile in first.keys() & second.keys():
        both = first[tile] - second[tile]
        row, column = np.nonzero(np.isfinite(both))
        x.append((column + both.shape[1] * tile[0]) * cell)
        y.append((row + both.shape[0] * tile[1]) * cell)
        difference.append(both[row, column])
    x, y, difference = (np.concatenate(part).astype(float) for part in (x, y, difference))
    terms = np.stack([np.ones_like(x), x - x.mean(), y - y.mean()], axis=1)
    kept = np.ones(len(x), bool)
    for _ in range(3):  # cells of another height, such as car roofs, do not tilt the plane
        plane = np.linalg.lstsq(terms[kept], difference[kept], rcond=None)[0]
        rest = np.abs(difference - terms @ plane)
        kept = rest < 3 * 1.48 * np.median(rest)
    return {"cells": len(x), "as_is": quantiles(np.abs(difference)), "levelled": quantiles(rest)}


# --- moving points --------------------------------------------------------------------------------------------

MIN_HEIGHT, MAX_HEIGHT = 0.1, 4.5  # of points that flagstone::MovingPoints examines, metres
ENDS = 2.0  # seconds at the start and the end of a run with fewer other scans


class MovingCounts:
    """Counts of the moving points that one mapped run found."""

    def __init__(self):
        self.confusion = np.zeros((len(BANDS), 3))  # by band: found, false, missed
        self.static = np.zeros(2)  # static points that are not ground, and those of them that are kept
        self.classes = {kind: np.zeros(65536, int) for kind in ("moving", "missed", "false")}
        self.missed_because = dict.fromkeys(REASONS, 0)
        self.false_waiting = 0  # of objects that move at another time

    def add(self, scan, found):
        """`scan`: a MovingScan; `found`: mask of its points."""
        true, false, missed = found & scan.moving, found & scan.static, ~found & scan.moving
        for column, mask in enumerate((true, false, missed)):
            self.confusion[:, column] += np.bincount(scan.band[mask], minlength=len(BANDS))
        fixed = scan.static & ~IS_GROUND[scan.classes]
        self.static += (fixed.sum(), (fixed & ~found).sum())
        for kind, mask in (("moving", scan.moving), ("missed", missed), ("false", false)):
            self.classes[kind] += np.bincount(scan.classes[mask], minlength=65536)
        self.false_waiting += int((false & scan.waits).sum())
        return missed

    def explain(self, missed, conditions):
        """Counts missed points by the first condition that applies."""
        for reason, condition in conditions.items():
            self.missed_because[reason] += int((missed & condition).sum())
            missed = missed & ~condition

    def metrics(self):
        true, false, missed = self.confusion[:-1].sum(axis=0)
        return {
            "iou": ratio(true, true + false + missed),
            "recall": ratio(true, true + missed),
            "precision": ratio(true, true + false),
            "bands": [ratio(band[0], band.sum()) if band[0] + band[2] else None for band in self.confusion[:-1]],
            "kept": ratio(self.static[1], self.static[0]),
            "static": int(self.static[0]),
            "false_waiting": self.false_waiting,
            "classes": {
                kind: {str(number): int(counts[number]) for number in np.flatnonzero(counts)}
                for kind, counts in self.classes.items()
            },
            "missed_because": dict(self.missed_because),
        }


REASONS = ("no candidate", "beyond 40 m", "ends", "other")


def ratio(part, whole):
    return float(part / whole) if whole else None


class MovingScan:
    """The true moving and static points of a scan, up to the end of the last band."""

    def __init__(self, sequence, name):
        self.points, self.classes = sequence.points(name), sequence.classes(name)
        ranges = ranges_of(self.points)
        self.band = bands_of(ranges)
        self.is_far = ranges >= 40
        scored = ~IS_UNKNOWN[self.classes] & (ranges < BANDS[-1])
        self.moving = IS_MOVING[self.classes] & scored
        self.static = ~IS_MOVING[self.classes] & scored
        motion = sequence.directory / "motion" / f"{name}.motion.npy"  # of simulated scans
        self.waits = np.load(motion) == MOVES_LATER if motion.exists() else np.zeros(len(ranges), bool)


def moving_metrics(sequence, mapped, alone, poses):
    """Metrics of moving points by kind of labels.

    `mapped`: output directories of `flagstone map` by kind. `alone`: labels and heights of each scan alone. `poses`:
    exact poses of the sensor, for PR and RR.
    """
    counts = {kind: MovingCounts() for kind in mapped}
    voxels = Voxels(list(mapped))
    times = sequence.times()
    moving_points = points = 0
    for name, time, pose in zip(sequence.names, times, poses, strict=True):
        scan = MovingScan(sequence, name)
        moving_points += int(scan.moving.sum())
        points += int(scan.moving.sum() + scan.static.sum())
        height = heights_in(alone, name)
        is_candidate = (labels_in(alone, name) == LABEL_NONGROUND) & ~(height <= MIN_HEIGHT) & ~(height > MAX_HEIGHT)
        found = {kind: moving_in(directory, name) for kind, directory in mapped.items()}
        for kind, mask in found.items():
            missed = counts[kind].add(scan, mask)
            at_end = time - times[0] < ENDS or (kind != "live" and times[-1] - time < ENDS)
            conditions = (~is_candidate, scan.is_far, np.full(len(missed), at_end), np.ones(len(missed), bool))
            counts[kind].explain(missed, dict(zip(REASONS, conditions, strict=True)))
        voxels.add(scan, pose, found)
    rates = voxels.rates()
    return {
        "points": points,
        "moving": moving_points,
        "kinds": {kind: {**count.metrics(), **rates[kind]} for kind, count in counts.items()},
    }


class Voxels:
    """Preservation and rejection rate of the cloud of all scans without the points that were found to move.

    A voxel is static if it contains a static point, otherwise dynamic. PR: fraction of the static voxels in which a
    static point is left. RR: fraction of the dynamic voxels in which no point is left.
    """

    def __init__(self, kinds):
        self.kinds = kinds
        self.keys, self.flags = [], []

    def add(self, scan, pose, found):
        used = scan.moving | scan.static
        world = scan.points[used].astype(np.float64) @ pose[:, :3].T + pose[:, 3]
        x, y, z = np.floor(world / VOXEL).astype(np.int64).T
        # One bit for "contains a static point", and two bits per kind for "a static, a moving point is left".
        is_static = scan.static[used]
        flags = is_static.astype(np.uint8)
        for bit, kind in enumerate(self.kinds):
            left = ~found[kind][used]
            flags |= ((left & is_static).astype(np.uint8) << (1 + 2 * bit)).astype(np.uint8)
            flags |= ((left & ~is_static).astype(np.uint8) << (2 + 2 * bit)).astype(np.uint8)
        keys, flags = merged(x + 2**20 + ((y + 2**20) << 21) + ((z + 2**20) << 42), flags)
        self.keys.append(keys)
        self.flags.append(flags)

    def rates(self):
        _, flags = merged(np.concatenate(self.keys), np.concatenate(self.flags))
        is_static = flags & 1 > 0
        found = {}
        for bit, kind in enumerate(self.kinds):
            has_static, has_moving = (flags & (1 << (first + 2 * bit)) > 0 for first in (1, 2))
            found[kind] = {
                "pr": ratio((is_static & has_static).sum(), is_static.sum()),
                "rr": ratio((~is_static & ~has_moving).sum(), (~is_static).sum()),
            }
        return found


def merged(keys, flags):
    """Each key once, with the flags of all its occurrences."""
    order = np.argsort(keys)
    keys, flags = keys[order], flags[order]
    first = np.flatnonzero(np.concatenate(([True], keys[1:] != keys[:-1])))
    return keys[first], np.bitwise_or.reduceat(flags, first)


# --- the image ------------------------------------------------------------------------------------------------

COLORS = {"found": "#d62728", "missed": "#1f4fd8", "false": "#ff9d0a", "static": "#9aa0a6", "ground": "#e6e2d6"}


def draw_moving(panels, reach, file):
    """Draws bird's-eye views of the moving points of scans.

    `panels`: rows of (title, sequence, directory of a mapped run, name of the scan). `reach`: metres from the sensor
    along x and y.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(
        len(panels), len(panels[0]), figsize=(15, 7.3), sharex=True, sharey=True, layout="constrained"
    )
    for axis, (title, sequence, mapped, name) in zip(axes.flat, itertools.chain(*panels), strict=True):
        scan = MovingScan(sequence, name)
        found = moving_in(mapped, name)
        ground = IS_GROUND[scan.classes]
        layers = [
            ("ground", scan.static & ground, 0.2),
            ("static", scan.static & ~ground & ~found, 0.5),
            ("found", scan.moving & found, 1.2),
            ("missed", scan.moving & ~found, 1.2),
            ("false", scan.static & found, 1.2),
        ]
        for layer, mask, size in layers:
            x, y = scan.points[mask, 0], scan.points[mask, 1]
            axis.scatter(x, y, s=size, c=COLORS[layer], linewidths=0)
        axis.plot(0, 0, marker=">", color="black", markersize=6)
        axis.set(xlim=(-reach[0], reach[0]), ylim=(-reach[1], reach[1]), aspect="equal")
        axis.set_title(title, fontsize=11)
        axis.tick_params(labelsize=8)
    for axis in axes[:, 0]:
        axis.set_ylabel("metres to the left", fontsize=9)
    for axis in axes[-1]:
        axis.set_xlabel("metres ahead", fontsize=9)
    names = {"found": "moving, found", "missed": "moving, missed", "false": "static, marked as moving"}
    names |= {"static": "other static points", "ground": "ground"}
    handles = [
        plt.Line2D([], [], color=COLORS[layer], marker="o", linestyle="", label=text) for layer, text in names.items()
    ]
    handles.append(plt.Line2D([], [], color="black", marker=">", linestyle="", label="sensor, facing right"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), fontsize=10, frameon=False)
    figure.savefig(file, dpi=100, metadata={"Software": None})
