# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Points as you already have them, read where they lie: wide rows, named fields, bytes, a data frame."""

import numpy as np
import pandas as pd

import flagstone

frames = flagstone.simulate("simulated", scene="flat_street", frames=3)
rows = np.fromfile(frames["scan"][0], np.float32).reshape(-1, 4)  # x, y, z, intensity
segmenter = flagstone.Surface()
labels = segmenter.segment(rows).labels  # without a copy: other columns are stepped over

# A record a return, as a driver packs it: the fields x, y and z are found by name, wherever they are.
returns = np.zeros(len(rows), [("time", "f8"), ("z", "f4"), ("ring", "u2"), ("x", "f4"), ("y", "f4")])
returns["x"], returns["y"], returns["z"] = rows[:, 0], rows[:, 1], rows[:, 2]
print("records:", np.array_equal(segmenter.segment(returns).labels, labels))

# The same as bytes with a layout.
message = returns.tobytes()
print("bytes:", np.array_equal(segmenter.segment(np.frombuffer(message, returns.dtype)).labels, labels))

# A data frame; and every second point of an array, by its strides.
frame = pd.DataFrame(rows, columns=["x", "y", "z", "intensity"])
print("frame:", np.array_equal(segmenter.segment(frame).labels, labels))
print("every second point:", len(segmenter.segment(rows[::2])))

# Coordinates down the rows have to be turned; whoever forgets is told.
try:
    segmenter.segment(rows[:, :3].T)
except ValueError as error:
    print(error)
