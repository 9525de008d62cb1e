# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs one of the peers of peers.py for `flagstone bench --compare`, which starts it and talks to it:

    python3 bench/peer_worker.py PEER SENSOR_HEIGHT

The worker begins with a line: "ready", or why it cannot work. Then it reads, from standard input,

    scan COUNT      a line, followed by 4 * COUNT floats of 32 bits: x, y, z, intensity of each point
    run K           a line, which it answers with a line, NANOSECONDS GROUND: what the peer took for scan K,
                    counted from 0 in the order they came, and how many points it found ground

until there is no more. What cannot be done is answered with a line that says why. The peer keeps one segmenter,
as it would on a drive; only pypatchworkpp's patchworkpp carries anything from one scan to the next.
"""

import os
import sys
import time


def separate_answers():
    """A stream for answers alone: the packages print on standard output, which leads nowhere from here on."""
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    return answers


def serve(peer, answers, requests):
    import numpy as np
    from peers import usable_points

    ground = peer.prepare()
    scans = []
    while line := requests.readline():
        word, number = line.decode().split()
        if word == "scan":
            floats = np.frombuffer(requests.read(16 * int(number)), np.float32)
            points = floats.reshape(-1, 4)
            scans.append(peer.convert(points[usable_points(points)]))
            continue
        scan = scans[int(number)]
        start = time.perf_counter_ns()
        found = ground(scan)
        spent = time.perf_counter_ns() - start
        print(spent, len(found), file=answers)


def main():
    name, sensor_height = sys.argv[1:]
    answers = separate_answers()
    try:
        from peers import PEERS

        peer = PEERS[name](float(sensor_height))
        print("ready", file=answers)
        serve(peer, answers, sys.stdin.buffer)
    except Exception as error:  # whatever it is, flagstone shall say it
        print(*f"{type(error).__name__}: {error}".split(), file=answers)
        sys.exit(1)


if __name__ == "__main__":
    main()
