# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs one of the programs of external_tools.py for `flagstone bench --compare`, which starts this worker:

    python3 bench/external_worker.py TOOL SENSOR_HEIGHT

The worker first prints one line: "ready", or the error that stops it. It then reads requests from standard input:

    scan COUNT      one line, followed by 4 * COUNT 32-bit floats: x, y, z, intensity of each point
    run K           one line, answered with the line "NANOSECONDS GROUND": the time for scan K, counted from 0 in the
                    order received, and the number of ground points

It ends at the end of the input. If an error occurs, the answer is a line with the error. The tool keeps one segmenter
for all scans; only pypatchworkpp's patchworkpp carries state from one scan to the next.
"""

import os
import sys
import time


def separate_answers():
    """A stream for answers. Standard output itself, to which the packages print, is discarded."""
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    return answers


def serve(tool, answers, requests):
    import numpy as np
    from external_tools import usable_points

    ground = tool.prepare()
    scans = []
    while line := requests.readline():
        word, number = line.decode().split()
        if word == "scan":
            floats = np.frombuffer(requests.read(16 * int(number)), np.float32)
            points = floats.reshape(-1, 4)
            scans.append(tool.convert(points[usable_points(points)]))
            continue
        scan = scans[int(number)]
        start = time.perf_counter_ns()
        found = ground(scan)
        elapsed = time.perf_counter_ns() - start
        print(elapsed, len(found), file=answers)


def main():
    name, sensor_height = sys.argv[1:]
    answers = separate_answers()
    try:
        from external_tools import TOOLS

        tool = TOOLS[name](float(sensor_height))
        print("ready", file=answers)
        serve(tool, answers, sys.stdin.buffer)
    except Exception as error:  # flagstone reports any error
        print(*f"{type(error).__name__}: {error}".split(), file=answers)
        sys.exit(1)


if __name__ == "__main__":
    main()
