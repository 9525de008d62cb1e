# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Times `flagstone bag` on simulated scans of 120,000 points, and prints a Markdown table.

    bench/bags.py [--clouds 200] [--points 120000] [--rounds 5] [--directory DIR]

For each format: a bag with five other topics, written by rosbags, is copied with the labelled clouds. The table shows
the run with the median time, and the time per cloud of each part.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python" / "tests"))
from bag_scenes import FORMATS, bag_name, scene, write_bag

import flagstone

TITLES = {"rosbag1": "ROS 1 .bag", "sqlite3": "rosbag2, SQLite", "mcap": "MCAP"}
ROW = "| {} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} |"


def simulated_clouds(directory: Path, count: int, points: int) -> list[np.ndarray]:
    """`count` scans with `points` points each, of a few simulated frames."""
    frames = flagstone.simulate(directory, scene="urban_street", sensor="hdl-64e", frames=4)
    scans = [np.resize(flagstone.io.read(frame.scan), points) for frame in frames]
    return [scans[index % len(scans)] for index in range(count)]


def timed(source: Path, destination: Path) -> flagstone.BagSummary:
    """One run on all cores. The destination is deleted."""
    try:
        return flagstone.bag(source, destination, progress=False)
    finally:
        if destination.is_dir():
            shutil.rmtree(destination)
        else:
            destination.unlink(missing_ok=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clouds", type=int, default=200, help="number of clouds per bag (default: 200)")
    parser.add_argument("--points", type=int, default=120_000, help="points per cloud (default: 120000)")
    parser.add_argument("--rounds", type=int, default=5, help="runs per format (default: 5)")
    parser.add_argument("--directory", type=Path, help="where to write the bags (default: a temporary directory)")
    parser.add_argument("--format", choices=FORMATS, action="append", help="only these formats")
    options = parser.parse_args()
    print("| format | clouds/s | MB/s | read, ms | write, ms | wait, ms | segment, ms | encode, ms | bottleneck |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---|")
    with tempfile.TemporaryDirectory(dir=options.directory) as name:
        directory = Path(name)
        clouds = simulated_clouds(directory / "simulated", options.clouds, options.points)
        for format in options.format or FORMATS:
            source = write_bag(directory / bag_name(format), format, scene(format, clouds))
            runs = [timed(source, directory / bag_name(format, "out")) for _ in range(options.rounds)]
            run = sorted(runs, key=lambda summary: summary.times.total)[len(runs) // 2]
            times, each = run.times, 1000 / run.clouds
            parts = [part * each for part in (times.read, times.write, times.wait, times.segment, times.encode)]
            rates = run.clouds / times.total, run.bytes / 1e6 / times.total
            print(ROW.format(TITLES[format], *rates, *parts, times.bottleneck), flush=True)
            if source.is_dir():
                shutil.rmtree(source)
            else:
                source.unlink()


if __name__ == "__main__":
    main()
