# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""One call: an array of points goes in, one label a point comes out."""

import flagstone

# A scan of a street by a 64-beam sensor; yours comes from a file or a driver: x forward, y left, z up, metres.
frames = flagstone.simulate("simulated", scene="flat_street", frames=3)
points = flagstone.io.read(frames["scan"][0])

segmenter = flagstone.Surface(sensor_height=1.73)  # how high the sensor sits above the ground
result = segmenter.segment(points)

print(f"ground: {result.ground.sum()} of {len(points)} points")
print(f"all labels: {result.counts}")

# Labels have the order of the points: a mask picks from any array of the scan.
print(f"mean intensity: ground {points['intensity'][result.ground].mean():.2f},", end=" ")
print(f"the rest {points['intensity'][~result.ground].mean():.2f}")
