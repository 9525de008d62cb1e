#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Times copies of bags in which every cloud gets a labelled copy, without segmentation.

    bench/bag_copies.py [--scans 200] [--runs 5] [--directory /tmp]

Needs the extra `bag` and the package `mcap`. Prints the median rate in scans per second, the range of the runs and
the CPU time per scan, and for comparison the same for writing a plain file of this size.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import tempfile
import time
from pathlib import Path

import mcap.writer
import numpy as np
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_typestore

from flagstone.bags import create_bag, open_bag

CLOUD_SIZE = 2_000_000
LABELLED_SIZE = 2_600_000
CASES = [
    ("plain file", ""),
    ("rosbag1", "none"),
    ("sqlite3", "none"),
    ("mcap", "none"),
    ("mcap", "none, check sums"),
    ("rosbag1", "lz4"),
    ("mcap", "zstd"),
]
CLOUD = "sensor_msgs/msg/PointCloud2"


def cloud_bytes() -> bytes:
    """Random floats like those of a scan: partly compressible."""
    random = np.random.default_rng(1)
    return np.round(random.normal(0, 20, CLOUD_SIZE // 4), 2).astype("<f4").tobytes()


def write_input(folder: Path, name: str, compression: str, scans: int) -> Path:
    """A bag by rosbags."""
    data = cloud_bytes()
    if name == "rosbag1":
        path = folder / "in.bag"
        writer = rosbag1.Writer(path)
        if compression != "none":
            writer.set_compression(rosbag1.Writer.CompressionFormat[compression.upper()])
        types = get_typestore(Stores.ROS1_NOETIC)
    elif compression == "none, check sums":
        return write_with_check_sums(folder / "in.mcap", scans, data)
    else:
        path = folder / "in"
        writer = rosbag2.Writer(path, version=9, storage_plugin=rosbag2.StoragePlugin[name.upper()])
        if compression != "none":
            writer.set_compression(rosbag2.CompressionMode.STORAGE, rosbag2.CompressionFormat.ZSTD)
        types = get_typestore(Stores.LATEST)
    with writer:
        cloud = writer.add_connection("/points", CLOUD, typestore=types)
        imu = writer.add_connection("/imu", "sensor_msgs/msg/Imu", typestore=types)
        for scan in range(scans):
            for i in range(10):
                writer.write(imu, scan * 10**8 + i * 10**7, bytes(320))
            writer.write(cloud, scan * 10**8, data)
    return path


def write_with_check_sums(path: Path, scans: int, data: bytes) -> Path:
    """An MCAP file by the package `mcap`, with check sums as rosbag2 writes them; rosbags writes none."""
    definition = get_typestore(Stores.LATEST).generate_msgdef(CLOUD, ros_version=2)[0].encode()
    with path.open("wb") as file:
        writer = mcap.writer.Writer(file, compression=mcap.writer.CompressionType.NONE)
        writer.start("ros2")
        schema = writer.register_schema(CLOUD, "ros2msg", definition)
        channel = writer.register_channel("/points", "cdr", schema)
        for scan in range(scans):
            writer.add_message(channel, scan * 10**8, data, scan * 10**8)
        writer.finish()
    return path


def copy(source: Path, target: Path, labelled: bytes) -> None:
    """Copies a bag and adds a message per cloud."""
    with open_bag(source) as bag, create_bag(target, like=bag) as writer:
        (points,) = bag.topics_named("/points")
        added = writer.add_topic("/points/labelled", CLOUD, like=points)
        for message in bag.messages():
            writer.copy(message)
            if message.topic is points:
                writer.write(added, message.log_time, labelled)
        writer.finish()


def write_plain(target: Path, scans: int, data: bytes, labelled: bytes) -> None:
    """Writes a file of the same size."""
    descriptor = os.open(target, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for _ in range(scans):
        os.writev(descriptor, [data, labelled])
    os.close(descriptor)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scans", type=int, default=200, help="clouds per bag (default: 200)")
    parser.add_argument("--runs", type=int, default=5, help="runs per format (default: 5)")
    parser.add_argument("--directory", type=Path, help="directory for the bags (default: for temporary files)")
    arguments = parser.parse_args()
    labelled = cloud_bytes() + bytes(LABELLED_SIZE - CLOUD_SIZE)
    print("| format | compression | scans per second | range | CPU, ms per scan |")
    print("|---|---|---:|---|---:|")
    for name, compression in CASES:
        with tempfile.TemporaryDirectory(dir=arguments.directory) as folder:
            source = None if name == "plain file" else write_input(Path(folder), name, compression, arguments.scans)
            rates, cpu_times = [], []
            for _ in range(arguments.runs):
                target = Path(folder) / ("out.bag" if name == "rosbag1" else "out")
                begin, cpu_begin = time.perf_counter(), time.process_time()
                if source is None:
                    write_plain(target, arguments.scans, labelled[:CLOUD_SIZE], labelled)
                else:
                    copy(source, target, labelled)
                rates.append(arguments.scans / (time.perf_counter() - begin))
                cpu_times.append((time.process_time() - cpu_begin) / arguments.scans * 1000)
                shutil.rmtree(target) if target.is_dir() else target.unlink()
        result = f"{statistics.median(rates):.0f} | {min(rates):.0f} to {max(rates):.0f}"
        print(f"| {name} | {compression} | {result} | {statistics.median(cpu_times):.1f} |", flush=True)


if __name__ == "__main__":
    main()
