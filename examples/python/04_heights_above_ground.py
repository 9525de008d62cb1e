# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""How high each point stands above the ground, and the ground itself at any place."""

import numpy as np

import flagstone

frames = flagstone.simulate("simulated", scene="flat_street", frames=3)
points = flagstone.io.read(frames["scan"][0])
truth = np.load(frames["ground"][0])  # z of the true ground at each point, metres

result = flagstone.Surface(sensor_height=1.73).segment(points)

heights = result.heights  # metres; NaN where no ground is known
known = np.isfinite(heights) & np.isfinite(truth)
errors = np.abs(heights - (points["z"] - truth))[known]
print(f"heights of {known.mean():.1%} of the points; median error {100 * np.median(errors):.1f} cm")

low = (heights > 0.3) & (heights < 2.2)  # what a vehicle could hit; comparing with NaN is False
print(
    f"obstacles: {np.count_nonzero(low)} points, the nearest {np.hypot(points['x'], points['y'])[low].min():.1f} m away"
)

# The ground at any place, seen or not: one point, or a whole grid.
x, y = np.meshgrid(np.arange(0, 30, 0.5), np.arange(-5, 5, 0.5))
ground = result.surface.at(x, y)
print(f"12 m ahead: z = {result.surface.height(12, 0):.2f} m")
print(f"steepest within 30 m ahead: {np.degrees(np.nanmax(ground.slope)):.1f} degrees")
