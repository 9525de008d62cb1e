# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""One call: an array of points goes in, one label per point comes out."""

import numpy as np

import flagstone

# Your own scan goes here, from a file or a driver: (N, >=3) float32, x forward, y left, z up, in metres around the
# sensor. This one is a road, 1.73 m below the sensor, and a wall; the fourth column is the intensity.
random = np.random.default_rng(1)
road = random.uniform([-40, -40, -1.75, 0.0], [40, 40, -1.71, 0.4], (80_000, 4))
wall = random.uniform([10, -20, -1.7, 0.5], [10.1, 20, 1, 0.9], (20_000, 4))
points = np.concatenate([road, wall]).astype(np.float32)

segmenter = flagstone.Surface(sensor_height=1.73)  # height of the sensor above the ground
result = segmenter.segment(points)

print(f"ground: {result.ground.sum()} of {len(points)} points")
print(f"all labels: {result.counts}")

# Labels are in the order of the points: a mask selects from any array of the scan.
intensity = points[:, 3]
print(f"mean intensity: ground {intensity[result.ground].mean():.2f}, others {intensity[~result.ground].mean():.2f}")
