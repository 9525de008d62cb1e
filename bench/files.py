# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Compares the throughput of `flagstone segment DIR` with the bound set by the page cache and the segmenter.

    python3 bench/files.py build/flagstone SCANS --output /dev/shm/labels
    python3 bench/files.py build/flagstone SCANS --output /dev/shm/labels --segment --format u8
    python3 bench/files.py build/flagstone SCANS --output /dev/shm/labels --segment --method patchwork

Each round runs the command with one thread and with all cores into an empty directory, and measures the bound. For one
core, the bound is one scan in the time of three steps: read(2) a file of SCANS into allocated memory, segment it (the
time that the command reports with one thread), and write(2) its labels to a new file. For N cores it is N times as many
scans. Rates are of the whole command, including its start. All files are read once before, so they come from the
page cache if they fit in memory. The program prints medians over the rounds. Ratios are computed within rounds, so a
slowdown of a whole round has no effect on them.
"""

import argparse
import datetime
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import time
import typing


class Round(typing.NamedTuple):
    """Results of one round: means over its scans in milliseconds, and scans per second."""

    read_ms: float
    segment_ms: float
    write_ms: float
    one: float
    many: float
    last_line: str  # printed by the command with many threads

    @property
    def bound(self):
        return 1000 / (self.read_ms + self.segment_ms + self.write_ms)


def run_command(command, scans, output, threads, options):
    """Scans per second of the whole command, mean milliseconds of segmentation per scan, and the last line printed."""
    shutil.rmtree(output, ignore_errors=True)
    arguments = [command, "segment", scans, "--output", output, "--threads", str(threads), *options]
    start = time.perf_counter()
    done = subprocess.run(arguments, stdout=subprocess.PIPE, text=True, check=True)
    seconds = time.perf_counter() - start
    *_, summary, last_line = done.stdout.splitlines()
    segmented = int(re.match(r"\d+", summary)[0])
    segment_ms = float(re.search(r"([\d.]+) ms of segmenting", last_line)[1])
    return segmented / seconds, segment_ms, last_line


def read_file(path, memory):
    file = os.open(path, os.O_RDONLY)
    size = os.fstat(file).st_size
    done = 0
    while done < size:
        done += os.readv(file, [memoryview(memory)[done:size]])
    os.close(file)


def write_file(path, data):
    file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    while data:
        data = data[os.write(file, data) :]
    os.close(file)


def file_milliseconds(inputs, label_sizes, directory):
    """Mean time to read a scan and mean time to write its labels, milliseconds."""
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    memory = bytearray(max(path.stat().st_size for path in inputs))
    labels = memoryview(bytearray(max(label_sizes)))
    inputs = [os.fspath(path) for path in inputs]
    outputs = [os.fspath(directory / str(i)) for i in range(len(inputs))]
    reading = writing = 0
    for source, target, size in zip(inputs, outputs, label_sizes):
        begin = time.perf_counter()
        read_file(source, memory)
        middle = time.perf_counter()
        write_file(target, labels[:size])
        writing += time.perf_counter() - middle
        reading += middle - begin
    shutil.rmtree(directory)
    return 1000 * reading / len(inputs), 1000 * writing / len(inputs)


def machine():
    """CPU model, and the number of cores that this process may use."""
    info = pathlib.Path("/proc/cpuinfo").read_text()
    model = re.search(r"^model name\s*: (.*)$", info, re.MULTILINE)
    return f"{model[1] if model else 'unknown CPU'}, {len(os.sched_getaffinity(0))} cores"


def file_system(path):
    """The type of the file system that a path is on."""
    path = os.path.realpath(path)
    best = ("", "unknown file system")
    for line in pathlib.Path("/proc/mounts").read_text().splitlines():
        _, mount_point, kind, *_ = line.split()
        if os.path.commonpath([mount_point, path]) == mount_point and len(mount_point) > len(best[0]):
            best = (mount_point, kind)
    return best[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", help="flagstone")
    parser.add_argument("scans", help="directory with about a thousand .bin files")
    parser.add_argument("--output", required=True, help="directory for labels; it is removed first")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument(
        "--segment", nargs=argparse.REMAINDER, default=[], help="all following options are passed to flagstone segment"
    )
    options = parser.parse_args()
    inputs = sorted(pathlib.Path(options.scans).rglob("*.bin"))
    if not inputs:
        sys.exit(f"{options.scans}: no .bin files in this directory")
    output = pathlib.Path(options.output)
    if output.exists() and not (output / ".flagstone-bench").exists():
        sys.exit(f"{output}: exists and would be removed (choose a new directory)")
    labels, baseline = output / "labels", output / "baseline"
    output.mkdir(parents=True, exist_ok=True)
    (output / ".flagstone-bench").touch()

    run_command(options.command, options.scans, labels, options.threads, options.segment)  # warm-up
    written = [path for path in labels.rglob("*") if path.is_file()]
    label_sizes = [path.stat().st_size for path in written]
    if len(label_sizes) != len(inputs):
        sys.exit(f"{output}: {len(label_sizes)} files for {len(inputs)} scans (expected one file per scan)")

    rounds = []
    for number in range(options.rounds):
        if sys.stderr.isatty():
            print(f"\rround {number + 1} of {options.rounds}", end="", file=sys.stderr)
        read_ms, write_ms = file_milliseconds(inputs, label_sizes, baseline)
        one, segment_ms, _ = run_command(options.command, options.scans, labels, 1, options.segment)
        many, _, last_line = run_command(options.command, options.scans, labels, options.threads, options.segment)
        rounds.append(Round(read_ms, segment_ms, write_ms, one, many, last_line))
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr)
    shutil.rmtree(output)

    def median(value):
        return statistics.median(map(value, rounds))

    threads = options.threads
    print(f"{datetime.date.today()}, {machine()}, {file_system(options.scans)}, {options.rounds} rounds")
    print(
        f"{len(inputs)} scans of {statistics.mean(p.stat().st_size for p in inputs) / 1e6:.2f} MB, "
        f"labels of {statistics.mean(label_sizes) / 1e6:.2f} MB"
    )
    print(
        f"minimum, ms per scan: read {median(lambda r: r.read_ms):.3f}, "
        f"segment {median(lambda r: r.segment_ms):.3f}, write {median(lambda r: r.write_ms):.3f}"
    )
    print(f"{'':12}{'scans/s':>9}{'bound':>9}{'share':>9}")
    print(
        f"{'1 thread':12}{median(lambda r: r.one):9.0f}{median(lambda r: r.bound):9.0f}"
        f"{median(lambda r: 100 * r.one / r.bound):7.1f} %"
    )
    print(
        f"{f'{threads} threads':12}{median(lambda r: r.many):9.0f}"
        f"{median(lambda r: threads * r.bound):9.0f}"
        f"{median(lambda r: 100 * r.many / (threads * r.bound)):7.1f} %"
    )
    print(f"speedup with {threads} threads: {median(lambda r: r.many / r.one):.2f}")
    median_round = sorted(rounds, key=lambda r: r.many)[len(rounds) // 2]
    print(f"flagstone segment, {threads} threads: {median_round.last_line}")


if __name__ == "__main__":
    main()
