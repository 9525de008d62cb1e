# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Compares the time of `segment` in Python with the same call in C++. Needs the package and the build tools.

    python3 bench/python_overhead.py $FLAGSTONE_DATA/kitti/velodyne/0[08]-*.bin
    python3 bench/python_overhead.py --methods surface --launches 40

Two programs segment the same scans alternately on one core: segment_loop.cpp, and segment_loop.py in this Python
interpreter. Both use float32 arrays of four columns and measure the time of one call. In Python this is
`segmenter.segment(points)`, including the result. bench/compare.py describes the measurement and the output. A ratio
above 1 is the overhead of Python.
"""

import argparse
import os
import pathlib
import sys

from compare import ROOT, TREES, alternate, build, default_scans, row_of, show_progress, table

LOOP = ROOT / "bench" / "segment_loop" / "segment_loop.py"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    methods = ("surface", "patchwork")
    parser.add_argument("--methods", nargs="+", choices=methods, default=methods, help="default: both")
    parser.add_argument("--launches", type=int, default=20, help="at least 6 (default: 20)")
    parser.add_argument("--rounds", type=int, default=20, help="rounds over all scans per launch (default: 20)")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="default: the last core")
    parser.add_argument("scans", nargs="*", type=pathlib.Path, help="KITTI .bin files")
    arguments = parser.parse_args()
    if arguments.launches < 6:
        parser.error("--launches must be at least 6: fewer give no interval")
    if arguments.rounds < 1:
        parser.error("--rounds must be at least 1")

    TREES.mkdir(exist_ok=True)
    scans = [scan.resolve() for scan in arguments.scans] or default_scans()
    program = build("tree-build", ROOT)
    rows = []
    for method in arguments.methods:
        programs = [(program, method), (sys.executable, LOOP, method)]
        launches = []
        for number in range(arguments.launches):
            show_progress(f"{method}: {number} of {arguments.launches} launches")
            times, same = alternate(programs, scans, arguments.core, arguments.rounds, first=number % 2)
            if not all(same):
                sys.exit(f"{method}: Python and C++ give different labels (install the package of this source tree)")
            launches.append(times)
        rows.append(row_of(f"`{method}`", launches, sum))
    show_progress("")
    points = sorted(scan.stat().st_size // 16 for scan in scans)
    print(
        f"{len(scans)} scans of {points[0]:,} to {points[-1]:,} points, {arguments.launches} launches of"
        f" {arguments.rounds} rounds, alternating on one core; total time of all scans.\n"
    )
    print(table(["", "C++, ms", "Python, ms", "ratio", "95 %"], rows))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
