# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures how time and memory of both methods scale, draws the plot and prints the tables. Needs Matplotlib.

    make bench-scaling                                       # both methods, a minute or two
    scripts/benchmark scaling --method surface                # one method; the results of the other are kept
    python3 bench/scaling.py --from docs/results/scaling.json  # plot and tables from earlier results

Results are written to docs/results/scaling.json, the plot to docs/images/scaling.png, and Markdown tables to standard
output. All clouds are simulated.
"""

import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "docs" / "results" / "scaling.json"
IMAGE = ROOT / "docs" / "images" / "scaling.png"
LIMIT = 64  # maximum memory, bytes per point

METHODS = ("patchwork", "surface")
TITLES = {"patchwork": "Patchwork", "surface": "surface"}
COLORS = {"patchwork": "#1f6fb4", "surface": "#d9601a"}
GREY = "#808080"


def measure(program, method, points):
    done = subprocess.run([program, method, str(points)], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}: {program} {method} {points}")
    return json.loads(done.stdout)


# --- plot --------------------------------------------------------------------------------------------------


def median(duration):
    return duration["median_ms"]


def slope_1(axes, first, last, rate):
    """Draws the line y = `rate` x."""
    axes.loglog([first, last], [rate * first, rate * last], "--", color=GREY, linewidth=1, label="slope 1")


def plot_points(axes, results):
    for method, measured in results.items():
        rows = measured["points"]
        points = [row["points"] for row in rows]
        for order, line in (("ordered", "o-"), ("shuffled", "s:")):
            label = TITLES[method] + (", sensor order" if order == "ordered" else ", shuffled")
            times = [median(row[order]) for row in rows]
            axes.loglog(points, times, line, color=COLORS[method], label=label)
    rows = next(iter(results.values()))["points"]
    # The line passes through the ordered scan of 100,000 points.
    through = next((row for row in rows if row["points"] == 100000), rows[-1])
    rate = median(through["ordered"]) / through["points"]
    slope_1(axes, rows[0]["points"], rows[-1]["points"], rate)
    axes.set(title="Time by points", xlabel="points", ylabel="time per scan, ms")


def plot_memory(axes, results):
    for method, measured in results.items():
        rows = measured["points"]
        points = [row["points"] for row in rows]
        held = [row["bytes_held"] / 2**20 for row in rows]
        axes.loglog(points, held, "o-", color=COLORS[method], label=f"{TITLES[method]}, including the result")
    axes.loglog(
        points,
        [LIMIT * n / 2**20 for n in points],
        "--",
        color=GREY,
        linewidth=1,
        label=f"{LIMIT} bytes per point (slope 1)",
    )
    axes.set(title="Memory by points", xlabel="points", ylabel="memory, MiB")


def plot_beams(axes, results):
    for method, measured in results.items():
        rows = measured["beams"]
        beams = [row["beams"] for row in rows]
        times = [median(row["time"]) for row in rows]
        axes.loglog(beams, times, "o-", color=COLORS[method], label=TITLES[method])
    slope_1(axes, beams[0], beams[-1], times[-1] / beams[-1])
    axes.set_xticks(beams, [str(n) for n in beams])
    axes.minorticks_off()
    axes.set(title="Time by beams, 2,048 columns", xlabel="beams", ylabel="time per scan, ms")


def plot_bins(axes, results):
    measured = results["patchwork"]
    rows = measured["bins"]
    bins = [row["bins"] for row in rows]
    times = [median(row["time"]) for row in rows]
    axes.loglog(bins, times, "o-", color=COLORS["patchwork"], label="equal rings × sectors")
    default = measured["general_layouts"][0]
    axes.loglog([default["bins"]], [median(default["time"])], "D", color="black", label="default zones")
    slope_1(axes, bins[0], bins[2], times[0] / bins[0])
    axes.set(title="Time by bins, Patchwork, 120,000 points", xlabel="bins", ylabel="time per scan, ms")


def plot_one_scan(axes, results):
    for method, measured in results.items():
        rows = measured["threads_of_one_scan"]
        for size, line in zip(sorted({row["points"] for row in rows}), ("o-", "s:")):
            times = [(row["threads"], median(row["time"])) for row in rows if row["points"] == size]
            alone = times[0][1]
            speedups = [(threads, alone / time) for threads, time in times]
            label = f"{TITLES[method]}, {size:,} points"
            axes.plot(*zip(*speedups), line, color=COLORS[method], label=label)
    threads_scale(axes, rows)
    axes.set(title="One scan, by threads", xlabel="threads", ylabel="speedup")


def plot_many_scans(axes, results):
    for method, measured in results.items():
        rows = measured["threads_of_many_scans"]
        alone = rows[0]["scans_per_second"]
        speedups = [(row["threads"], row["scans_per_second"] / alone) for row in rows]
        label = f"{TITLES[method]}: {alone:,.0f} scans/s with 1 thread"
        axes.plot(*zip(*speedups), "o-", color=COLORS[method], label=label)
    threads_scale(axes, rows)
    axes.set(title="Many scans of 120,000 points, by threads", xlabel="threads", ylabel="speedup")


def threads_scale(axes, rows):
    """Linear axes from 0, with the line of a perfect speedup."""
    threads = sorted({row["threads"] for row in rows})
    axes.plot(threads, threads, "--", color=GREY, linewidth=1, label="slope 1")
    axes.set_xticks(threads)
    axes.set_ylim(0, 1.25 * threads[-1])


def plain_numbers(axis):
    """Ticks at 1, 2, 5 if the axis covers at most two decades."""
    from matplotlib import ticker

    low, high = axis.get_view_interval()
    if axis.get_scale() != "log" or high > 100 * low:
        return
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_locator(ticker.NullLocator())


def conditions(measured):
    """Machine, instruction set and date."""
    return f"{measured['machine']}, {measured['simd']}, {measured['date']}"


def draw(results, path):
    try:
        import matplotlib
    except ImportError:
        sys.exit("Matplotlib is not installed (Debian: apt-get install python3-matplotlib)")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 3, figsize=(13, 7.6), layout="constrained")
    plots = (plot_points, plot_memory, plot_beams, plot_bins, plot_one_scan, plot_many_scans)
    for plot, panel in zip(plots, axes.flat):
        plot(panel, results)
        panel.grid(True, which="major", color="#dddddd", linewidth=0.6)
        panel.set_axisbelow(True)
        plain_numbers(panel.yaxis)
        panel.legend(frameon=False, fontsize=9)
    figure.suptitle("\n".join(f"{TITLES[name]}: {conditions(of)}" for name, of in results.items()), fontsize=11)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110, metadata={"Software": None})


# --- tables ------------------------------------------------------------------------------------------------


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def ms(duration):
    return f"{duration['median_ms']:.3f}"


def points_table(results):
    rows = []
    for row in results["points"]:
        points = row["points"]
        ordered, scattered = row["ordered"]["median_ms"], row["shuffled"]["median_ms"]
        rows.append(
            [f"{points:,}", ms(row["ordered"]), f"{1e6 * ordered / points:.2f}", ms(row["shuffled"]),
             f"{1e6 * scattered / points:.2f}", f"{scattered / ordered:.2f}", f"{row['bytes_held'] / points:.1f}"]
        )  # fmt: skip
    head = [
        "points",
        "in order, ms",
        "ns per point",
        "shuffled, ms",
        "ns per point",
        "shuffled / in order",
        "bytes per point",
    ]
    return table(head, rows)


def beams_table(results):
    rows = [
        [
            str(row["beams"]),
            f"{row['points']:,}",
            ms(row["time"]),
            f"{1e6 * row['time']['median_ms'] / row['points']:.2f}",
        ]
        for row in results["beams"]
    ]
    return table(["beams, 2,048 columns", "points", "ms", "ns per point"], rows)


def layouts_table(results, name):
    default = results["general_layouts"][0]["time"]["median_ms"]
    rows = [
        [row["layout"], str(row["rings"]), f"{row['bins']:,}", f"{row['patches']:,}", ms(row["time"]),
         f"{row['time']['median_ms'] / default:.2f}"]
        for row in results[name]
    ]  # fmt: skip
    return table(["zones, rings × sectors", "rings", "bins", "non-empty", "ms", "/ default"], rows)


def cells_table(results):
    rows = results["cells"]
    default = median(next(row["time"] for row in rows if row["max_range"] == 100 and row["levels"] == 4))
    cells = [
        [f"{row['max_range']:.0f}", str(row["levels"]), ms(row["time"]),
         f"{median(row['time']) / default:.2f}", f"{row['bytes_held'] / 1e6:.2f}"]
        for row in rows
    ]  # fmt: skip
    return table(["range, m", "levels", "ms", "/ default", "MB"], cells)


def memory_table(results):
    first = results["memory_layouts"][0]["time"]["median_ms"]
    rows = [
        [row["memory"], ms(row["time"]), f"{row['time']['median_ms'] / first:.2f}"] for row in results["memory_layouts"]
    ]
    return table(["point layout", "ms", "/ packed xyz"], rows)


def yes_or_no(same):
    return "yes" if same else "**no**"


def threads_tables(results):
    rows = []
    alone = {}
    for row in results["threads_of_one_scan"]:
        time = row["time"]["median_ms"]
        alone.setdefault(row["points"], time)
        rows.append(
            [
                f"{row['points']:,}",
                str(row["threads"]),
                f"{time:.3f}",
                f"{alone[row['points']] / time:.2f}",
                yes_or_no(row["same_labels"]),
            ]
        )
    one = table(["points", "threads", "ms", "speedup", "identical labels"], rows)
    many = results["threads_of_many_scans"]
    rows = [
        [
            str(row["threads"]),
            f"{row['scans_per_second']:.0f}",
            f"{row['scans_per_second'] / many[0]['scans_per_second']:.2f}",
            yes_or_no(row["same_labels"]),
        ]
        for row in many
    ]
    return f"{one}\n{table(['many scans, threads', 'scans per second', 'speedup', 'identical labels'], rows)}"


def tables(results):
    head = f"{results['date']}, {results['machine']}, {results['simd']}; medians, warm caches.\n"
    parts = [head, points_table(results), beams_table(results)]
    if "cells" in results:
        parts.append(cells_table(results))
    else:
        parts += [layouts_table(results, "bins"), layouts_table(results, "general_layouts")]
    parts += [memory_table(results), threads_tables(results)]
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "bench" / "performance" / "scaling")
    parser.add_argument("--points", type=int, default=10000000, help="points of the largest cloud, 1,000 to 10,000,000")
    parser.add_argument("--method", choices=METHODS, help="measure only this method")
    parser.add_argument(
        "--from", dest="file", type=pathlib.Path, help="draw and print these results instead of measuring"
    )
    arguments = parser.parse_args()
    if arguments.file:
        results = json.loads(arguments.file.read_text())
    else:
        if not arguments.program.exists():
            sys.exit(f"{arguments.program}: no such file (run `make bench-scaling`)")
        results = {}
        if arguments.method:
            results = json.loads(RESULTS.read_text())
        for method in [arguments.method] if arguments.method else METHODS:
            results[method] = measure(arguments.program, method, arguments.points)
        RESULTS.parent.mkdir(exist_ok=True)
        RESULTS.write_text(json.dumps(results, indent=1) + "\n")
    for method, measured in results.items():
        print(f"{TITLES[method]}: {tables(measured)}")
    draw(results, IMAGE)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
