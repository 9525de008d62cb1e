# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What does `segment` cost from Python beside the same call in C++? Needs the package and what builds the library.

    python3 bench/python_overhead.py $FLAGSTONE_DATA/kitti/velodyne/0[08]-*.bin
    python3 bench/python_overhead.py --methods surface --launches 40

Two programs segment the same scans by turns on one core: segment_loop.cpp, and segment_loop.py in this Python
interpreter. Both hold float32 arrays of four columns and take the time of one call, in Python that of
`segmenter.segment(points)`, the result and all. How it is measured otherwise, and what is printed: bench/compare.py.
A ratio above 1 is what Python adds.
"""

import argparse
import os
import pathlib
import sys

from compare import FOLDER, ROOT, alternate, build, default_scans, row_of, say, table

LOOP = ROOT / "bench" / "segment_loop" / "segment_loop.py"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    methods = ("surface", "patchwork")
    parser.add_argument("--methods", nargs="+", choices=methods, default=methods, help="both")
    parser.add_argument("--launches", type=int, default=20, help="6 or more; 20")
    parser.add_argument("--rounds", type=int, default=20, help="of a launch, over all scans; 20")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="the last one")
    parser.add_argument("scans", nargs="*", type=pathlib.Path, help="KITTI's .bin files")
    arguments = parser.parse_args()
    if arguments.launches < 6:
        parser.error("--launches: 6 or more, fewer give no interval")
    if arguments.rounds < 1:
        parser.error("--rounds: 1 or more")

    FOLDER.mkdir(exist_ok=True)
    scans = [scan.resolve() for scan in arguments.scans] or default_scans()
    program = build("tree-build", ROOT)
    rows = []
    for method in arguments.methods:
        programs = [(program, method), (sys.executable, LOOP, method)]
        launches = []
        for number in range(arguments.launches):
            say(f"{method}: {number} of {arguments.launches} launches")
            times, same = alternate(programs, scans, arguments.core, arguments.rounds, first=number % 2)
            if not all(same):
                sys.exit(f"{method}: Python and C++ give different labels, so they are not of one version")
            launches.append(times)
        rows.append(row_of(f"`{method}`", launches, sum))
    say("")
    points = sorted(scan.stat().st_size // 16 for scan in scans)
    print(
        f"{len(scans)} scans of {points[0]:,} to {points[-1]:,} points, {arguments.launches} launches of"
        f" {arguments.rounds} rounds by turns on one core; times of all scans together.\n"
    )
    print(table(["", "C++, ms", "Python, ms", "ratio", "95 %"], rows))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
