# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Points as you already have them, read in place: wide rows, named fields, bytes, an organized cloud."""

import numpy as np

import flagstone

random = np.random.default_rng(1)
road = random.uniform([-40, -40, -1.75, 0.0], [40, 40, -1.71, 0.4], (80_000, 4))
wall = random.uniform([10, -20, -1.7, 0.5], [10.1, 20, 1, 0.9], (20_000, 4))
rows = np.concatenate([road, wall]).astype(np.float32)  # x, y, z, intensity

segmenter = flagstone.Surface()
labels = segmenter.segment(rows).labels  # without a copy: other columns are skipped

# One record per return, as a driver packs it: the fields x, y and z are found by name, wherever they are.
returns = np.zeros(len(rows), [("time", "f8"), ("z", "f4"), ("ring", "u2"), ("x", "f4"), ("y", "f4")])
returns["x"], returns["y"], returns["z"] = rows[:, 0], rows[:, 1], rows[:, 2]
print("records:", np.array_equal(segmenter.segment(returns).labels, labels))

# The same as bytes with a layout.
message = returns.tobytes()
print("bytes:", np.array_equal(segmenter.segment(np.frombuffer(message, returns.dtype)).labels, labels))

# An organized cloud: labels are in the order of its rows.
image = rows.reshape(100, 1000, 4)
print("organized:", np.array_equal(segmenter.segment(image).labels.reshape(100, 1000), labels.reshape(100, 1000)))

# Every second point of an array, by its strides. Data frames, PyArrow tables and torch tensors are points too.
print("every second point:", len(segmenter.segment(rows[::2])))

# Coordinates down the rows have to be transposed; the error says so.
try:
    segmenter.segment(rows[:, :3].T)
except ValueError as error:
    print(error)
