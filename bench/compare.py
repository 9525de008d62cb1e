# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Is the working tree faster or slower than another revision? Needs git, CMake, Ninja and a C++ compiler.

    make bench-compare                           # against the last tag, or HEAD~1 where there is none
    make bench-compare REVISION=54a37fc
    make bench-compare REVISION=main SCANS="a.bin b.bin"
    python3 bench/compare.py --revision main --rounds 400 --core 1

Builds the library of both, each with bench/segment_loop, and has the two segment the same scans by turns on
one core. Prints the ratio of the times, working tree / revision: the median over rounds, and its 95 % interval
by order statistics, which assumes no distribution, but that rounds are independent. Where Valgrind is, also the instructions of one pass over
each scan under callgrind: they repeat to the digit where times do not. Valgrind offers a program no AVX-512,
so the library takes its AVX2 code there.

Scans are KITTI's .bin files: those given, else those in FLAGSTONE_DATA, else simulated ones.
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
FOLDER = ROOT / "build-compare"


def call(*command):
    done = subprocess.run(
        [str(word) for word in command], cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nexit code {done.returncode}: {' '.join(str(word) for word in command)}")
    return done.stdout.strip()


def say(text):
    """On the last line of a terminal."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)


def default_revision():
    tag = subprocess.run(
        ["git", "describe", "--tags", "--abbrev=0", "HEAD"], cwd=ROOT, text=True, capture_output=True
    )
    return tag.stdout.strip() if tag.returncode == 0 else "HEAD~1"


def checkout(revision):
    """The files of a revision in a folder of their own, which is kept."""
    folder = FOLDER / revision
    if not folder.exists():
        archive = subprocess.run(["git", "archive", revision], cwd=ROOT, stdout=subprocess.PIPE, check=True)
        with tarfile.open(fileobj=io.BytesIO(archive.stdout)) as files:
            files.extractall(folder)
    return folder


def build(name, source):
    """The driver with the library in `source`."""
    say(f"building {name}")
    tree = FOLDER / name
    call(
        "cmake", "-G", "Ninja", "-S", ROOT / "bench" / "segment_loop", "-B", tree,
        f"-DFLAGSTONE_REVISION={source}", "-DCMAKE_BUILD_TYPE=Release",
    )  # fmt: skip
    call("cmake", "--build", tree, "--target", "segment_loop")
    return tree / "segment_loop"


def default_scans():
    data = os.environ.get("FLAGSTONE_DATA")
    if data:
        scans = sorted(pathlib.Path(data, "kitti", "velodyne").glob("*.bin"))
        if scans:
            return scans
    folder = FOLDER / "simulated"
    scans = sorted(folder.rglob("*.bin"))
    if not scans:
        say("simulating")
        command = ROOT / "build" / "flagstone"
        if not command.exists():
            sys.exit(
                f"no scans: FLAGSTONE_DATA is not set and {command} not built; run `make build`, or give"
                " KITTI's .bin files as SCANS"
            )
        call(command, "simulate", "--scene", "flat_street", "--frames", "4", "--output", folder)
        scans = sorted(folder.rglob("*.bin"))
    return scans


class Loop:
    """A driver that waits for the next round, on one core."""

    def __init__(self, program, scans, core):
        self.process = subprocess.Popen(
            [program, *scans],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        os.sched_setaffinity(self.process.pid, {core})
        self.hashes = self.answer()

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"{self.process.args[0]} ended with exit code {self.process.wait()}")
        return [int(word) for word in line.split()]

    def round(self):
        """Nanoseconds for each scan."""
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return self.answer()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def alternate(programs, scans, core, rounds):
    """Times of both, by round and scan, and whether their labels are the same."""
    loops = [Loop(program, scans, core) for program in programs]
    same = [a == b for a, b in zip(loops[0].hashes, loops[1].hashes)]
    times = ([], [])
    try:
        for number in range(rounds):
            if number % 20 == 0:
                say(f"{number} of {rounds} rounds")
            # Each goes first in every other round.
            for which in (0, 1) if number % 2 == 0 else (1, 0):
                times[which].append(loops[which].round())
    finally:
        for loop in loops:
            loop.close()
    return times, same


def median_with_interval(values):
    """Median and the 95 % interval by order statistics: as many values as that lie below the median are
    binomial."""
    ordered = sorted(values)
    count = len(ordered)
    margin = 1.96 * math.sqrt(count) / 2
    low = max(0, math.floor(count / 2 - margin) - 1)
    high = min(count - 1, math.ceil(count / 2 + margin))
    return statistics.median(ordered), ordered[low], ordered[high]


def instructions(program, scan):
    """Of one pass over a scan, after two to warm up."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out",
             "--collect-atstart=no", "--toggle-collect=segment_measured", program, scan],
            input="\n", text=True, capture_output=True,
        )  # fmt: skip
    found = re.search(r"Collected : (\d+)", done.stderr)
    return int(found.group(1)) if found else None


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def time_table(times, scans, same):
    revision, tree = times
    rows = []
    for s, scan in enumerate(scans):
        ratios = [new[s] / old[s] for old, new in zip(revision, tree)]
        before = statistics.median(old[s] for old in revision) / 1e6
        after = statistics.median(new[s] for new in tree) / 1e6
        ratio, low, high = median_with_interval(ratios)
        rows.append(
            [scan.name, f"{before:.3f}", f"{after:.3f}", f"{ratio:.4f}", f"{low:.4f} to {high:.4f}",
             "same" if same[s] else "differ"]
        )  # fmt: skip
    ratio, low, high = median_with_interval([sum(new) / sum(old) for old, new in zip(revision, tree)])
    totals = [f"{statistics.median(sum(r) for r in side) / 1e6:.3f}" for side in times]
    rows.append(["all", *totals, f"**{ratio:.4f}**", f"**{low:.4f} to {high:.4f}**", ""])
    return table(["scan", "revision, ms", "working tree, ms", "ratio", "95 %", "labels"], rows)


def instruction_table(programs, scans):
    rows = []
    totals = [0, 0]
    for scan in scans:
        say(f"instructions: {scan.name}")
        counts = [instructions(program, scan) for program in programs]
        if None in counts:
            return f"no instruction counts: Valgrind could not run {programs[counts.index(None)]}"
        totals = [total + count for total, count in zip(totals, counts)]
        rows.append([scan.name, *(f"{count:,}" for count in counts), f"{counts[1] / counts[0]:.4f}"])
    rows.append(["all", *(f"{total:,}" for total in totals), f"**{totals[1] / totals[0]:.4f}**"])
    return table(["scan, instructions", "revision", "working tree", "ratio"], rows)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--revision", help="what git knows it by; the last tag or HEAD~1")
    parser.add_argument("--rounds", type=int, default=200, help="over all scans, 10 or more; 200")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="the last one")
    parser.add_argument("--no-instructions", action="store_true", help="times only")
    parser.add_argument("scans", nargs="*", type=pathlib.Path, help="KITTI's .bin files")
    arguments = parser.parse_args()
    if arguments.rounds < 10:
        parser.error("--rounds: 10 or more, for an interval")
    if arguments.core not in os.sched_getaffinity(0):
        parser.error(f"--core: one of {sorted(os.sched_getaffinity(0))}")
    FOLDER.mkdir(exist_ok=True)
    scans = [scan.resolve() for scan in arguments.scans] or default_scans()
    revision = call("git", "rev-parse", "--short", f"{arguments.revision or default_revision()}^{{commit}}")
    programs = [build(f"{revision}-build", checkout(revision)), build("tree-build", ROOT)]
    times, same = alternate(programs, scans, arguments.core, arguments.rounds)
    say("")
    print(f"Working tree against {revision}, {arguments.rounds} rounds by turns on core {arguments.core}:\n")
    print(time_table(times, scans, same))
    if arguments.no_instructions:
        return
    if shutil.which("valgrind") is None:
        print("\nno instruction counts: Valgrind is not installed (Debian: apt-get install valgrind)")
        return
    counts = instruction_table(programs, scans)
    say("")
    print(f"\n{counts}")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
