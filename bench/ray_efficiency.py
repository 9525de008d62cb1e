# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures the overhead of Ray: `flagstone.ray.segment` and `flagstone segment` on the same cores and scans.

Simulates scans once, then runs the two alternately, each of them first in every other round, and prints medians. With
--driver, it prints the CPU time and memory per scan of the driver. There is one driver for any number of machines. Use
directories in memory (/dev/shm) to exclude the disk.

    python bench/ray_efficiency.py --work /dev/shm/ray-efficiency
    python bench/ray_efficiency.py --work /dev/shm/ray-efficiency --driver
"""

import argparse
import json
import os
import pathlib
import platform
import resource
import shutil
import statistics
import subprocess
import sys
import time
from datetime import date

import flagstone.ray
from flagstone import _command

SCENES = ("flat_street", "urban_street", "park", "highway")
DISTINCT = 200  # simulated scans; the others are hard links to them
LINKS = 60_000  # below the maximum number of hard links of a file on ext4


def make_options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True, help="directory for scans and labels")
    parser.add_argument("--scans", type=int, default=2000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--driver", action="store_true", help="measure the driver, with scans of one point")
    parser.add_argument("--measure", type=pathlib.Path, help=argparse.SUPPRESS)  # one run, in a separate process
    return parser


def simulate(work: pathlib.Path, count: int) -> pathlib.Path:
    """A directory with `count` scans of an HDL-64E under different names."""
    found = []
    for scene in SCENES:
        sequence = work / "simulated" / scene
        frames = str(DISTINCT // len(SCENES))
        subprocess.run(
            [_command.path(), "simulate", "--scene", scene, "--frames", frames, "--output", sequence],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        found += sorted((sequence / "sequences" / "00" / "velodyne").iterdir())
    return link(found, work / f"scans-{count}", count)


def link(files: list[pathlib.Path], directory: pathlib.Path, count: int) -> pathlib.Path:
    if not directory.exists():
        for i in range(count):
            subdirectory = directory / f"{i // 1000:04}"
            subdirectory.mkdir(parents=True, exist_ok=True)
            (subdirectory / f"{i:08}.bin").hardlink_to(files[i % len(files)])
    return directory


def run_plain(scans: pathlib.Path, labels: pathlib.Path) -> float:
    start = time.perf_counter()
    subprocess.run([_command.path(), "segment", scans, "--output", labels], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def run_ray(scans: pathlib.Path, labels: pathlib.Path) -> tuple[float, float]:
    """Seconds of the whole job, and from the start of the first scan to the end of the last."""
    start = time.perf_counter()
    summary = flagstone.ray.segment(scans, labels)
    assert not summary.failures
    return time.perf_counter() - start, summary.seconds


def check_equal(plain: pathlib.Path, by_ray: pathlib.Path) -> None:
    for file in plain.rglob("*.label"):
        assert file.read_bytes() == (by_ray / file.relative_to(plain)).read_bytes(), file


def compare(work: pathlib.Path, count: int, rounds: int) -> None:
    scans = simulate(work, count)
    plain, by_ray = work / "labels-plain", work / "labels-ray"
    times: dict[str, list[float]] = {"flagstone segment": [], "Ray, scans only": [], "Ray, whole job": []}
    for number in range(rounds + 1):
        for directory in (plain, by_ray):
            shutil.rmtree(directory, ignore_errors=True)
        os.sync()  # so that no earlier writes are flushed during the measurement
        if number % 2:
            alone = run_plain(scans, plain)
        whole, scans_only = run_ray(scans, by_ray)
        if not number % 2:
            alone = run_plain(scans, plain)
        if number == 0:  # warm-up: reads the scans into the page cache
            check_equal(plain, by_ray)
            continue
        for seconds, value in zip(times.values(), (alone, scans_only, whole), strict=True):
            seconds.append(value)
        print(f"round {number}: {alone:.2f} s, {scans_only:.2f} s, {whole:.2f} s", file=sys.stderr)

    megabytes = sum(file.stat().st_size for file in scans.rglob("*.bin")) / count / 1e6
    print(f"{count} scans of {megabytes:.2f} MB, bit-identical labels; medians of {rounds} alternating rounds")
    print_machine()
    print(f"\n{'':24}{'seconds':>9}{'minimum':>9}{'maximum':>9}{'scans/s':>9}{'efficiency':>12}")
    base = statistics.median(times["flagstone segment"])
    for name, seconds in times.items():
        middle = statistics.median(seconds)
        share = statistics.median(a / b for a, b in zip(times["flagstone segment"], seconds, strict=True))
        print(f"{name:24}{middle:9.2f}{min(seconds):9.2f}{max(seconds):9.2f}{count / middle:9.0f}{100 * share:10.0f} %")
    startup = statistics.median(
        whole - scans_only for whole, scans_only in zip(times["Ray, whole job"], times["Ray, scans only"], strict=True)
    )
    print(
        f"\nStartup and shutdown of Ray take {startup:.1f} s for any number of scans;"
        f" flagstone segment takes {base:.1f} s"
    )


def measure(scans: pathlib.Path) -> None:
    """One run: CPU time and memory of this process, the driver."""
    labels = scans.with_name(scans.name + "-labels")
    shutil.rmtree(labels, ignore_errors=True)
    start = time.process_time()
    flagstone.ray.segment(scans, labels, progress=False)
    used = time.process_time() - start
    print(json.dumps({"seconds": used, "bytes": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss}))


def measure_driver(work: pathlib.Path) -> None:
    counts = (5_000, 105_000)
    needs = []
    for count in counts:
        files = [work / f"tiny-{i}.bin" for i in range(1 + count // LINKS)]
        for file in files:
            if not file.exists():
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(bytes(16))
        scans = link(files, work / f"tiny-{count}", count)
        command = [sys.executable, __file__, "--work", work, "--measure", scans]
        needs.append(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))
    print("driver, from the difference of runs over " + " and ".join(map(str, counts)) + " scans of one point:")
    print_machine()
    more = counts[1] - counts[0]
    micro = 1e6 * (needs[1]["seconds"] - needs[0]["seconds"]) / more
    kilo = (needs[1]["bytes"] - needs[0]["bytes"]) / more / 1e3
    print(
        f"\n{micro:.0f} µs of one core and {kilo:.2f} kB of memory per scan;"
        f" {needs[0]['bytes'] / 1e6:.0f} MB for {counts[0]} scans"
    )


def print_machine() -> None:
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    print(f"{models[0] if models else platform.machine()}, {len(os.sched_getaffinity(0))} cores; {date.today()}")


def main() -> None:
    options = make_options().parse_args()
    if options.measure:
        measure(options.measure)
    elif options.driver:
        measure_driver(options.work)
    else:
        compare(options.work, options.scans, options.rounds)


if __name__ == "__main__":
    main()
