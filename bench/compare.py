# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Is the working tree faster or slower than another revision? Needs git, CMake, Ninja and a C++ compiler.

    make bench-compare                           # against the last tag, or HEAD~1 where there is none
    make bench-compare REVISION=54a37fc
    make bench-compare REVISION=main SCANS="a.bin b.bin" METHOD=surface
    python3 bench/compare.py --revision main --launches 40 --core 1

Builds the library of both, each with bench/segment_loop, and has the two segment the same scans by turns on
one core. Where a program's memory comes to lie is worth a few percent, so both are started anew many times. A
launch gives one ratio of the times, working tree / revision: the median over its rounds. Printed is the
median over launches, with its interval of 95 % or a little more by order statistics, which assumes nothing
of the distribution.

Where Valgrind is, also the instructions of one pass over each scan under callgrind: they repeat to the digit
where times do not. Valgrind offers a program no AVX-512, so the library takes its AVX2 code there.

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
    tag = subprocess.run(["git", "describe", "--tags", "--abbrev=0", "HEAD"], cwd=ROOT, text=True, capture_output=True)
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
    data = pathlib.Path(os.environ.get("FLAGSTONE_DATA", ROOT.parent / "shared" / "data"))
    scans = sorted((data / "kitti" / "velodyne").glob("*.bin"))
    if scans:
        return scans
    folder = FOLDER / "simulated"
    scans = sorted(folder.rglob("*.bin"))
    if not scans:
        say("simulating")
        command = ROOT / "build" / "flagstone"
        if not command.exists():
            sys.exit(
                f"no scans: none of KITTI's in {data} and no {command} to simulate some; set FLAGSTONE_DATA,"
                " run `make build`, or give .bin files as SCANS"
            )
        call(command, "simulate", "--scene", "flat_street", "--frames", "4", "--output", folder)
        scans = sorted(folder.rglob("*.bin"))
    return scans


class Loop:
    """A driver that waits for the next round, on one core. `program` ends on the name of the method."""

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


def alternate(programs, scans, core, rounds, first):
    """A launch: times of both, by round and scan, and of each scan whether its labels are the same.

    The two take turns strictly: who went twice would find its caches warm the second time.
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
    """Median and its interval of at least 95 %: how many of the values lie below the true median is
    binomial."""
    ordered = sorted(values)
    count = len(ordered)
    left_out = 0  # values on either side
    while sum(math.comb(count, k) for k in range(left_out + 1)) / 2**count <= 0.025:
        left_out += 1
    first = left_out - 1
    return statistics.median(ordered), ordered[first], ordered[count - 1 - first]


def instructions(program, scan):
    """Of one pass over a scan, after two to warm up."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out",
             "--collect-atstart=no", "--toggle-collect=segment_measured", *program, scan],
            input="\n", text=True, capture_output=True,
        )  # fmt: skip
    found = re.search(r"Collected : (\d+)", done.stderr)
    return int(found.group(1)) if found else None


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def row_of(name, launches, time_of):
    """Times and ratio of what `time_of` takes from a round."""
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
        say(f"instructions: {scan.name}")
        counts = [instructions(program, scan) for program in programs]
        if None in counts:
            return f"no instruction counts: Valgrind could not run {programs[counts.index(None)][0]}"
        totals = [total + count for total, count in zip(totals, counts)]
        rows.append([scan.name, *(f"{count:,}" for count in counts), f"{counts[1] / counts[0]:.4f}"])
    rows.append(["all", *(f"{total:,}" for total in totals), f"{totals[1] / totals[0]:.4f}"])
    return table(["scan, instructions", "revision", "working tree", "ratio"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--revision", help="what git knows it by; the last tag or HEAD~1")
    parser.add_argument("--method", choices=("patchwork", "surface"), default="patchwork")
    parser.add_argument("--launches", type=int, default=20, help="6 or more; 20")
    parser.add_argument("--rounds", type=int, default=20, help="of a launch, over all scans; 20")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="the last one")
    parser.add_argument("--no-instructions", action="store_true", help="times only")
    parser.add_argument("scans", nargs="*", type=pathlib.Path, help="KITTI's .bin files")
    arguments = parser.parse_args()
    if arguments.launches < 6:
        parser.error("--launches: 6 or more, fewer give no interval")
    if arguments.rounds < 1:
        parser.error("--rounds: 1 or more")
    if arguments.core not in os.sched_getaffinity(0):
        parser.error(f"--core: one of {sorted(os.sched_getaffinity(0))}")
    FOLDER.mkdir(exist_ok=True)
    scans = [scan.resolve() for scan in arguments.scans] or default_scans()
    revision = call("git", "rev-parse", "--short", f"{arguments.revision or default_revision()}^{{commit}}")
    built = build(f"{revision}-build", checkout(revision)), build("tree-build", ROOT)
    programs = [(program, arguments.method) for program in built]
    launches = []
    for number in range(arguments.launches):
        say(f"{number} of {arguments.launches} launches")
        times, same = alternate(programs, scans, arguments.core, arguments.rounds, first=number % 2)
        launches.append(times)
    say("")
    print(
        f"Working tree against {revision}, method {arguments.method}: {arguments.launches} launches of"
        f" {arguments.rounds} rounds by turns on core {arguments.core}.\n"
    )
    print(time_table(launches, scans, same))
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
