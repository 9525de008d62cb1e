# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Heights of points above the ground, and the elevation of the ground at any position."""

import numpy as np

import flagstone

# A road with a slope of 3 %, and boxes on it. Replace this with your own scan.
random = np.random.default_rng(1)
points = np.zeros((100_000, 3), np.float32)
points[:, :2] = random.uniform(-40, 40, (100_000, 2))
truth = (0.03 * points[:, 0] - 1.73).astype(np.float32)  # true z of the ground at each point, metres
in_box = (np.abs(points[:, 0] % 10 - 5) < 1) & (points[:, 1] % 12 < 2)
points[:, 2] = truth + random.normal(0, 0.01, 100_000) + in_box * random.uniform(0, 1.8, 100_000)

result = flagstone.Surface(sensor_height=1.73).segment(points)

heights = result.heights  # metres; NaN if the ground is unknown
known = np.isfinite(heights)
errors = np.abs(heights - (points[:, 2] - truth))[known]
print(f"heights of {known.mean():.1%} of the points; median error {100 * np.median(errors):.1f} cm")

low = (heights > 0.3) & (heights < 2.2)  # obstacles for a vehicle; comparisons with NaN are False
distances = np.hypot(points[:, 0], points[:, 1])
print(f"obstacles: {np.count_nonzero(low)} points, the nearest {distances[low].min():.1f} m away")

# The ground at any position, even without points nearby: a single position, or a grid.
x, y = np.meshgrid(np.arange(0, 30, 0.5), np.arange(-5, 5, 0.5))
ground = result.surface.at(x, y)
print(f"12 m ahead: z = {result.surface.height(12, 0):.2f} m")
print(f"median slope within 30 m ahead: {np.degrees(np.nanmedian(ground.slope)):.1f} degrees")
