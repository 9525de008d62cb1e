# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""How near `flagstone segment FOLDER` comes to what the page cache and the segmenter allow together.

    python3 bench/files.py build/flagstone SCANS --output /dev/shm/labels
    python3 bench/files.py build/flagstone SCANS --output /dev/shm/labels --segment --format u8
    python3 bench/files.py build/flagstone SCANS --output /dev/shm/labels --segment --method patchwork

Round after round it runs the command with one thread and with all cores, into an empty folder, and measures the
bound beside it. The bound of one core is one scan in the time it takes to read(2) a file of SCANS into memory
that is already there, to segment it (as the command says of its run with one thread) and to write(2) its labels
to a new file; that of N cores is N times as much. Rates are those of the whole command, its start included.
Everything is read once before, so the files come from the page cache if memory holds them. Printed are medians
over the rounds; shares and scaling are those of rounds, so that what slows a whole round down does not count.
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
    """What one round measured: means over its scans in milliseconds, and scans a second."""

    read_ms: float
    segment_ms: float
    write_ms: float
    one: float
    many: float
    what_binds: str  # what the command said with many threads

    @property
    def bound(self):
        return 1000 / (self.read_ms + self.segment_ms + self.write_ms)


def run_command(command, scans, output, threads, options):
    """Scans a second of the whole command, the mean milliseconds it segmented one in, and its last line."""
    shutil.rmtree(output, ignore_errors=True)
    arguments = [command, "segment", scans, "--output", output, "--threads", str(threads), *options]
    start = time.perf_counter()
    done = subprocess.run(arguments, stdout=subprocess.PIPE, text=True, check=True)
    seconds = time.perf_counter() - start
    *_, summary, what_binds = done.stdout.splitlines()
    segmented = int(re.match(r"\d+", summary)[0])
    segment_ms = float(re.search(r"([\d.]+) ms of segmenting a scan", what_binds)[1])
    return segmented / seconds, segment_ms, what_binds


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


def file_milliseconds(inputs, label_sizes, folder):
    """What reading a scan and writing its labels takes at the least: means."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    memory = bytearray(max(path.stat().st_size for path in inputs))
    labels = memoryview(bytearray(max(label_sizes)))
    inputs = [os.fspath(path) for path in inputs]
    outputs = [os.fspath(folder / str(i)) for i in range(len(inputs))]
    reading = writing = 0
    for source, target, size in zip(inputs, outputs, label_sizes):
        begin = time.perf_counter()
        read_file(source, memory)
        middle = time.perf_counter()
        write_file(target, labels[:size])
        writing += time.perf_counter() - middle
        reading += middle - begin
    shutil.rmtree(folder)
    return 1000 * reading / len(inputs), 1000 * writing / len(inputs)


def machine():
    """The processor, and the cores this process may use."""
    info = pathlib.Path("/proc/cpuinfo").read_text()
    model = re.search(r"^model name\s*: (.*)$", info, re.MULTILINE)
    return f"{model[1] if model else 'unknown processor'}, {len(os.sched_getaffinity(0))} cores"


def file_system(path):
    """The type of the file system that a path is on."""
    path = os.path.realpath(path)
    best = ("", "unknown file system")
    for line in pathlib.Path("/proc/mounts").read_text().splitlines():
        _, place, kind, *_ = line.split()
        if os.path.commonpath([place, path]) == place and len(place) > len(best[0]):
            best = (place, kind)
    return best[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", help="flagstone")
    parser.add_argument("scans", help="folder of .bin files, a thousand or so")
    parser.add_argument("--output", required=True, help="folder for labels; removed, made anew")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--segment", nargs=argparse.REMAINDER, default=[], help="all behind it is told to segment")
    asked = parser.parse_args()
    inputs = sorted(pathlib.Path(asked.scans).rglob("*.bin"))
    if not inputs:
        sys.exit(f"{asked.scans}: no .bin file in this folder or below it; name a folder of scans")
    output = pathlib.Path(asked.output)
    if output.exists() and not (output / ".flagstone-bench").exists():
        sys.exit(f"{output}: is there already and would be removed; name a folder that is not there")
    labels, least = output / "labels", output / "least"
    output.mkdir(parents=True, exist_ok=True)
    (output / ".flagstone-bench").touch()

    run_command(asked.command, asked.scans, labels, asked.threads, asked.segment)  # warms up
    written = [path for path in labels.rglob("*") if path.is_file()]
    label_sizes = [path.stat().st_size for path in written]
    if len(label_sizes) != len(inputs):
        sys.exit(f"{len(label_sizes)} files for {len(inputs)} scans; one a scan is measured")

    rounds = []
    for number in range(asked.rounds):
        if sys.stderr.isatty():
            print(f"\rround {number + 1} of {asked.rounds}", end="", file=sys.stderr)
        read_ms, write_ms = file_milliseconds(inputs, label_sizes, least)
        one, segment_ms, _ = run_command(asked.command, asked.scans, labels, 1, asked.segment)
        many, _, what_binds = run_command(asked.command, asked.scans, labels, asked.threads, asked.segment)
        rounds.append(Round(read_ms, segment_ms, write_ms, one, many, what_binds))
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr)
    shutil.rmtree(output)

    def median(value):
        return statistics.median(map(value, rounds))

    threads = asked.threads
    print(f"{datetime.date.today()}, {machine()}, {file_system(asked.scans)}, {asked.rounds} rounds")
    print(
        f"{len(inputs)} scans of {statistics.mean(p.stat().st_size for p in inputs) / 1e6:.2f} MB, "
        f"labels of {statistics.mean(label_sizes) / 1e6:.2f} MB"
    )
    print(
        f"at the least, ms a scan: read {median(lambda r: r.read_ms):.3f}, "
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
    print(f"{threads} threads to 1: {median(lambda r: r.many / r.one):.2f} times as many scans")
    usual = sorted(rounds, key=lambda r: r.many)[len(rounds) // 2]
    print(f"the command itself, {threads} threads: {usual.what_binds}")


if __name__ == "__main__":
    main()
