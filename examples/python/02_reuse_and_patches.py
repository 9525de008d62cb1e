# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reuse a segmenter for several scans, and inspect the patches of Patchwork."""

import numpy as np

import flagstone

random = np.random.default_rng(1)


def next_scan() -> np.ndarray:
    """A road and a wall. Replace this with your driver."""
    road = random.uniform([-40, -40, -1.75], [40, 40, -1.71], (80_000, 3))
    wall = random.uniform([10, -20, -1.7], [10.1, 20, 1], (20_000, 3))
    return np.concatenate([road, wall]).astype(np.float32)


# The segmenter keeps its memory, so after the first scans it allocates almost nothing. It keeps nothing else, so the
# labels of a scan never depend on earlier scans.
segmenter = flagstone.Patchwork(sensor="hdl-64e")
for _ in range(3):
    result = segmenter.segment(next_scan())
    print(f"ground: {result.counts['ground']} of {len(result)} points, {len(result.patches)} patches")

# The patches of the last scan: position, number of points, plane (normal . p + d = 0) and status.
for patch in result.patches[:5]:
    x, y, z = patch["normal"]
    print(
        f"zone {patch['zone']} ring {patch['ring']} sector {patch['sector']:2}: {patch['point_count']:3} points,"
        f" normal ({x:.3f} {y:.3f} {z:.3f}), d {patch['d']:.2f}, {flagstone.Verdict(patch['verdict']).name.lower()}"
    )

# You can count and filter the structured array. result.to_pandas() returns it as a data frame.
for verdict, count in zip(*np.unique(result.patches["verdict"], return_counts=True), strict=True):
    print(f"{flagstone.Verdict(verdict).name.lower()}: {count} patches")
