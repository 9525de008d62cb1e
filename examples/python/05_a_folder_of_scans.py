# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A folder of scans on several threads; labels are written beside them. For a whole cluster there is flagstone.ray."""

import os
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import flagstone

frames = flagstone.simulate("simulated", scene="flat_street", frames=3)
output = Path("labels")
output.mkdir(exist_ok=True)

# Python's lock is free while a scan is segmented, so that threads do work side by side. Those that share a segmenter
# take turns: give each its own.
own = threading.local()


def segment_file(path: str) -> str:
    """Segments one scan, writes its labels, and says how it went."""
    if not hasattr(own, "segmenter"):
        own.segmenter = flagstone.Surface(sensor="hdl-64e")
    points = flagstone.io.read(path)
    result = own.segmenter.segment(points)
    flagstone.io.write_labels(output / f"{Path(path).stem}.label", result.labels)
    return f"{Path(path).name}: {result.counts['ground'] / len(result):.1%} ground"


with ThreadPoolExecutor(os.cpu_count()) as pool:
    for line in pool.map(segment_file, frames["scan"]):
        print(line)
