# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""One call: segment an array of points and get one label per point."""

import numpy as np

import flagstone

# Replace this with your own scan, from a file or a driver: (N, >=3) float32, in metres, x forward, y left, z up, origin
# at the sensor. Here: a road 1.73 m below the sensor and a wall. The fourth column is the intensity.
random = np.random.default_rng(1)
road = random.uniform([-40, -40, -1.75, 0.0], [40, 40, -1.71, 0.4], (80_000, 4))
wall = random.uniform([10, -20, -1.7, 0.5], [10.1, 20, 1, 0.9], (20_000, 4))
points = np.concatenate([road, wall]).astype(np.float32)

segmenter = flagstone.Surface(sensor_height=1.73)  # height of the sensor above the ground
result = segmenter.segment(points)

print(f"ground: {result.ground.sum()} of {len(points)} points")
print(f"all labels: {result.counts}")

# Labels are in the order of the points, so the mask can index any other array of the scan.
intensity = points[:, 3]
print(f"mean intensity: ground {intensity[result.ground].mean():.2f}, others {intensity[~result.ground].mean():.2f}")
