# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Zero-copy input from the memory layouts you already have: wide rows, named fields, bytes, organized clouds."""

import numpy as np

import flagstone

random = np.random.default_rng(1)
road = random.uniform([-40, -40, -1.75, 0.0], [40, 40, -1.71, 0.4], (80_000, 4))
wall = random.uniform([10, -20, -1.7, 0.5], [10.1, 20, 1, 0.9], (20_000, 4))
rows = np.concatenate([road, wall]).astype(np.float32)  # x, y, z, intensity

segmenter = flagstone.Surface()
labels = segmenter.segment(rows).labels  # zero-copy; other columns are ignored

# One record per return, as drivers pack them. The fields x, y and z are found by name, in any order.
returns = np.zeros(len(rows), [("time", "f8"), ("z", "f4"), ("ring", "u2"), ("x", "f4"), ("y", "f4")])
returns["x"], returns["y"], returns["z"] = rows[:, 0], rows[:, 1], rows[:, 2]
print("records:", np.array_equal(segmenter.segment(returns).labels, labels))

# Raw bytes with a known layout.
message = returns.tobytes()
print("bytes:", np.array_equal(segmenter.segment(np.frombuffer(message, returns.dtype)).labels, labels))

# An organized cloud. Labels are in row order.
image = rows.reshape(100, 1000, 4)
print("organized:", np.array_equal(segmenter.segment(image).labels.reshape(100, 1000), labels.reshape(100, 1000)))

# Any strides, here every second point. Data frames, PyArrow tables and torch tensors work too.
print("every second point:", len(segmenter.segment(rows[::2])))

# An array with one coordinate per row must be transposed. The error message explains it.
try:
    segmenter.segment(rows[:, :3].T)
except ValueError as error:
    print(error)
