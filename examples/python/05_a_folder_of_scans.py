# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Segment a directory of scans with several threads, and write the labels to files. For clusters, use flagstone.ray."""

import os
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import flagstone

scans, output = Path("scans"), Path("labels")
output.mkdir(exist_ok=True)
if not scans.exists():  # replace this with your own scans: .bin, .pcd, .ply or .npy
    scans.mkdir()
    for number in range(3):
        random = np.random.default_rng(number)
        road = random.uniform([-40, -40, -1.75, 0], [40, 40, -1.71, 1], (80_000, 4))
        wall = random.uniform([10, -20, -1.7, 0], [10.1, 20, 1, 1], (20_000, 4))
        np.concatenate([road, wall]).astype(np.float32).tofile(scans / f"{number:06}.bin")

# segment() releases the GIL, so threads run in parallel. Threads that share a segmenter take turns, so each thread gets
# its own segmenter.
own = threading.local()


def segment_file(path: Path) -> str:
    """Segments one scan, writes its labels and returns a summary."""
    if not hasattr(own, "segmenter"):
        own.segmenter = flagstone.Surface(sensor="hdl-64e")
    result = own.segmenter.segment(flagstone.io.read(path))
    flagstone.io.write_labels(output / f"{path.stem}.label", result.labels)
    return f"{path.name}: {result.counts['ground'] / len(result):.1%} ground"


with ThreadPoolExecutor(os.cpu_count()) as pool:
    print(*pool.map(segment_file, sorted(scans.iterdir())), sep="\n")
