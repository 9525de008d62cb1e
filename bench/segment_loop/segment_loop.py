# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""segment_loop.cpp with the Python package, for bench/python_overhead.py: segment_loop.py METHOD FILE..."""

import sys
import time

import numpy as np

import flagstone


def hash_of(labels):
    """FNV-1a hash of the labels."""
    number = 0xCBF29CE484222325
    for label in labels.tobytes():
        number = ((number ^ label) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return number


def main():
    method, *files = sys.argv[1:]
    segmenter = flagstone.make_segmenter(method)
    scans = [np.fromfile(file, np.float32).reshape(-1, 4) for file in files]

    # Two warm-up rounds, then a round that prints the hashes of the labels.
    for scan in scans + scans:
        result = segmenter.segment(scan)
    print(*(hash_of(segmenter.segment(scan).labels) for scan in scans), flush=True)

    for _ in sys.stdin:
        # Another program used the core in between: one untimed scan warms the caches.
        result = segmenter.segment(scans[-1])
        times = []
        for scan in scans:
            start = time.perf_counter_ns()
            result = segmenter.segment(scan)  # noqa: F841  kept until the next result, as in most loops
            times.append(time.perf_counter_ns() - start)
        print(*times, flush=True)


if __name__ == "__main__":
    main()
