# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs each method on 100,000 different scans and plots the memory of the process. Needs Matplotlib.

    make soak-test                                       # some minutes
    python3 bench/soak.py --from docs/results/soak.json  # plot and table from earlier results

Results are written to docs/results/soak.json, the plot to docs/images/soak.png, and a Markdown table to standard
output. The exit code is 1 if the memory grew by more than the allowed amount. All scans are simulated.
"""

import argparse
import datetime
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "docs" / "results" / "soak.json"
IMAGE = ROOT / "docs" / "images" / "soak.png"
COLORS = {"patchwork": "#1f6fb4", "surface": "#d9601a"}
MEBI = 2**20


def measure(program, method, scans):
    done = subprocess.run([program, method, str(scans)], stdout=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"exit code {done.returncode}: {program} {method} {scans}")
    return json.loads(done.stdout)


def draw(results):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 3.2), layout="constrained")
    for method, measured in results["methods"].items():
        scans = [row["scans"] for row in measured["memory"]]
        memory = [row["bytes"] / MEBI for row in measured["memory"]]
        axes.plot(scans, memory, label=method, color=COLORS[method])
        axes.annotate(f"{memory[-1]:.1f}", (scans[-1], memory[-1]), xytext=(-30, 5), textcoords="offset points")
    maximum = max(row["bytes"] for measured in results["methods"].values() for row in measured["memory"])
    axes.set(xlabel="scans", ylabel="resident memory, MiB", ylim=(0, 1.2 * maximum / MEBI), xlim=(0, None))
    axes.legend(loc="center right")
    axes.grid(alpha=0.3)
    figure.savefig(IMAGE, dpi=120)


def table(results):
    lines = [
        f"{results['date']}, {results['machine']}.",
        "",
        "| method | scans | points, billions | after the first tenth, MiB | maximum after it, MiB | increase, KiB"
        " | allowed, KiB |",
        "|---|---:|---:|---:|---:|---:|---:|",
    ]
    for method, measured in results["methods"].items():
        memory = [row["bytes"] for row in measured["memory"]]
        tenth = len(memory) // 10
        lines.append(
            f"| `{method}` | {measured['scans']:,} | {measured['points'] / 1e9:.2f} | "
            f"{memory[tenth - 1] / MEBI:.2f} | {max(memory[tenth:]) / MEBI:.2f} | "
            f"{measured['growth_bytes'] / 1024:.0f} | {measured['allowed_growth_bytes'] / 1024:.0f} |"
        )
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "bench" / "performance" / "soak")
    parser.add_argument("--scans", type=int, default=100000, help="scans per method")
    parser.add_argument(
        "--from", dest="file", type=pathlib.Path, help="draw and print these results instead of measuring"
    )
    arguments = parser.parse_args()
    if arguments.file:
        results = json.loads(arguments.file.read_text())
    else:
        if not arguments.program.exists():
            sys.exit(f"{arguments.program}: no such file (run `make soak-test`)")
        measured = {m: measure(arguments.program, m, arguments.scans) for m in COLORS}
        results = {
            "date": datetime.date.today().isoformat(),
            "machine": measured["patchwork"].pop("machine"),
            "methods": measured,
        }
        measured["surface"].pop("machine")
        RESULTS.parent.mkdir(exist_ok=True)
        RESULTS.write_text(json.dumps(results, indent=1) + "\n")
    print(table(results))
    draw(results)
    grown = [m for m, r in results["methods"].items() if r["growth_bytes"] > r["allowed_growth_bytes"]]
    if grown:
        sys.exit(f"memory grew: {', '.join(grown)}")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
