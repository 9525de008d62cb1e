# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Compares the speed of the working tree and another revision. Needs git, CMake, Ninja and a C++ compiler.

    make bench-compare                           # compared with the last tag, or HEAD~1 if there is none
    make bench-compare REVISION=54a37fc
    make bench-compare REVISION=main SCANS="a.bin b.bin" METHOD=surface
    make bench-compare TARGET=avx2               # instruction set, named as by `flagstone bench --isa`
    python3 bench/compare.py --revision main --launches 40 --core 1

Builds the library of both, each with bench/segment_loop, and runs the two programs alternately on the same scans on one
core. The memory layout of a process changes its speed by a few percent, so both programs are started many times. Each
launch gives one ratio of times, working tree / revision: the median over its rounds. The output is the median over
launches and its confidence interval of at least 95 % by order statistics, which assumes no distribution.

If Valgrind is installed, the instructions of one pass over each scan are counted too. Unlike times, these counts are
reproducible. Valgrind does not support AVX-512, so the library uses its AVX2 code there, also with TARGET=avx3.

Scans are KITTI .bin files: those on the command line, otherwise those in FLAGSTONE_DATA, otherwise simulated scans.
"""

import argparse
import io
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TREES = ROOT / "build-compare"


def call(*command):
    done = subprocess.run(
        [str(word) for word in command], cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nexit code {done.returncode}: {' '.join(str(word) for word in command)}")
    return done.stdout.strip()


def show_progress(text):
    """Shows a line on a terminal; the next call replaces it."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)


def default_revision():
    tag = subprocess.run(["git", "describe", "--tags", "--abbrev=0", "HEAD"], cwd=ROOT, text=True, capture_output=True)
    return tag.stdout.strip() if tag.returncode == 0 else "HEAD~1"


def checkout(revision):
    """A directory with the files of a revision. It is kept for later runs."""
    directory = TREES / revision
    if not directory.exists():
        archive = subprocess.run(["git", "archive", revision], cwd=ROOT, stdout=subprocess.PIPE, check=True)
        with tarfile.open(fileobj=io.BytesIO(archive.stdout)) as files:
            files.extractall(directory)
    return directory


def build(name, source):
    """Builds segment_loop with the library in `source`."""
    show_progress(f"building {name}")
    tree = TREES / name
    call(
        "cmake", "-G", "Ninja", "-S", ROOT / "bench" / "segment_loop", "-B", tree,
        f"-DFLAGSTONE_REVISION={source}", "-DCMAKE_BUILD_TYPE=Release",
    )  # fmt: skip
    call("cmake", "--build", tree, "--target", "segment_loop")
    return tree / "segment_loop"


def default_scans():
    data = pathlib.Path(os.environ.get("FLAGSTONE_DATA", ROOT.parent / "shared" / "data"))
    scans = sorted((data / "kitti" / "velodyne").glob("*.bin"))
    if scans:
        return scans
    directory = TREES / "simulated"
    scans = sorted(directory.rglob("*.bin"))
    if not scans:
        show_progress("simulating")
        command = ROOT / "build" / "flagstone"
        if not command.exists():
            sys.exit(
                f"no scans: {data} has no KITTI scans, and {command} does not exist (set FLAGSTONE_DATA,"
                " run `make build`, or pass .bin files as SCANS)"
            )
        call(command, "simulate", "--scene", "flat_street", "--frames", "4", "--output", directory)
        scans = sorted(directory.rglob("*.bin"))
    return scans


class Loop:
    """A running segment_loop on one core. The last word of `program` is the method."""

    def __init__(self, program, scans, core):
        self.process = subprocess.Popen(
            [*program, *scans],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        os.sched_setaffinity(self.process.pid, {core})
        self.hashes = self.answer()

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"{self.process.args[0]}: exit code {self.process.wait()}")
        return [int(word) for word in line.split()]

    def round(self):
        """Runs one round and returns the nanoseconds per scan."""
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return self.answer()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def command_of(program, method, target=None):
    """The command of a segment_loop that uses an instruction set, or the best one."""
    return (program, *(("--target", target) if target else ()), method)


def alternate(programs, scans, core, rounds, first):
    """One launch: the times of both programs by round and scan, and whether the labels of each scan are identical.

    The programs alternate strictly. A program that ran twice in a row would find its data in the cache.
    """
    loops = [Loop(program, scans, core) for program in programs]
    times = ([], [])
    try:
        for _ in range(rounds):
            for which in (first, 1 - first):
                times[which].append(loops[which].round())
    finally:
        for loop in loops:
            loop.close()
    return times, [a == b for a, b in zip(loops[0].hashes, loops[1].hashes)]


def median_with_interval(values):
    """Median and its confidence interval of at least 95 %. The number of values below the true median is binomial."""
    ordered = sorted(values)
    count = len(ordered)
    excluded = 0  # values at each end
    while sum(math.comb(count, k) for k in range(excluded + 1)) / 2**count <= 0.025:
        excluded += 1
    first = excluded - 1
    return statistics.median(ordered), ordered[first], ordered[count - 1 - first]


def instructions(program, scan):
    """Instructions of one pass over a scan, after two warm-up passes."""
    with tempfile.TemporaryDirectory() as directory:
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={directory}/out",
             "--collect-atstart=no", "--toggle-collect=segment_measured", *program, scan],
            input="\n", text=True, capture_output=True,
        )  # fmt: skip
    found = re.search(r"Collected : (\d+)", done.stderr)
    return int(found.group(1)) if found else None


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def row_of(name, launches, time_of):
    """A table row: median times and their ratio. `time_of(round)` is the time of a round to compare."""
    sides = [[time_of(round_) for times in launches for round_ in times[side]] for side in (0, 1)]
    ratios = [statistics.median(time_of(new) / time_of(old) for old, new in zip(*times)) for times in launches]
    ratio, low, high = median_with_interval(ratios)
    return [name, *(f"{statistics.median(side) / 1e6:.3f}" for side in sides), f"{ratio:.4f}",
            f"{low:.4f} to {high:.4f}"]  # fmt: skip


def time_table(launches, scans, same):
    rows = [
        [*row_of(scan.name, launches, lambda times, s=s: times[s]), "same" if same[s] else "differ"]
        for s, scan in enumerate(scans)
    ]
    rows.append([*row_of("all", launches, sum), "same" if all(same) else "differ"])
    return table(["scan", "revision, ms", "working tree, ms", "ratio", "95 %", "labels"], rows)


def instruction_table(programs, scans):
    rows = []
    totals = [0, 0]
    for scan in scans:
        show_progress(f"instructions: {scan.name}")
        counts = [instructions(program, scan) for program in programs]
        if None in counts:
            return f"no instruction counts: Valgrind could not run {programs[counts.index(None)][0]}"
        totals = [total + count for total, count in zip(totals, counts)]
        rows.append([scan.name, *(f"{count:,}" for count in counts), f"{counts[1] / counts[0]:.4f}"])
    rows.append(["all", *(f"{total:,}" for total in totals), f"{totals[1] / totals[0]:.4f}"])
    return table(["scan, instructions", "revision", "working tree", "ratio"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--revision", help="git revision (default: the last tag or HEAD~1)")
    parser.add_argument("--method", choices=("patchwork", "surface"), default="patchwork")
    parser.add_argument("--target", help="instruction set, e.g. avx3 (AVX-512) or avx2 (default: the best one)")
    parser.add_argument("--launches", type=int, default=20, help="at least 6 (default: 20)")
    parser.add_argument("--rounds", type=int, default=20, help="rounds over all scans per launch (default: 20)")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="default: the last core")
    parser.add_argument("--no-instructions", action="store_true", help="times only")
    parser.add_argument("scans", nargs="*", type=pathlib.Path, help="KITTI .bin files")
    arguments = parser.parse_args()
    if arguments.launches < 6:
        parser.error("--launches must be at least 6: fewer give no interval")
    if arguments.rounds < 1:
        parser.error("--rounds must be at least 1")
    if arguments.core not in os.sched_getaffinity(0):
        parser.error(f"--core must be one of {sorted(os.sched_getaffinity(0))}")
    TREES.mkdir(exist_ok=True)
    scans = [scan.resolve() for scan in arguments.scans] or default_scans()
    revision = call("git", "rev-parse", "--short", f"{arguments.revision or default_revision()}^{{commit}}")
    built = build(f"{revision}-build", checkout(revision)), build("tree-build", ROOT)
    programs = [command_of(program, arguments.method, arguments.target) for program in built]
    launches = []
    for number in range(arguments.launches):
        show_progress(f"{number} of {arguments.launches} launches")
        times, same = alternate(programs, scans, arguments.core, arguments.rounds, first=number % 2)
        launches.append(times)
    show_progress("")
    print(
        f"Working tree compared with {revision}, method {arguments.method},"
        f" instruction set {arguments.target or 'chosen by the library'}:\n{arguments.launches} launches of"
        f" {arguments.rounds} rounds, alternating on core {arguments.core}.\n"
    )
    print(time_table(launches, scans, same))
    if arguments.no_instructions:
        return
    if shutil.which("valgrind") is None:
        print("\nno instruction counts: Valgrind is not installed (Debian: apt-get install valgrind)")
        return
    counted_target = "avx2" if arguments.target == "avx3" else arguments.target
    counts = instruction_table([command_of(program, arguments.method, counted_target) for program in built], scans)
    show_progress("")
    print(f"\n{counts}")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
