# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# %% [markdown]
# # Side by side
#
# This program segments the same scans with flagstone (two methods),
# [pypatchworkpp](https://github.com/url-kaist/patchwork-plusplus) (two methods) and `segment_plane` of
# [Open3D](https://www.open3d.org). It compares lines of code, time, accuracy and the behaviour for invalid input.
# Packages that are not installed are skipped.
#
#     pip install '.[plot]' pypatchworkpp open3d
#     python side_by_side.py                                         # print the tables
#     python side_by_side.py --quick                                 # use fewer scans and rounds
#     python side_by_side.py --write docs/benchmarks/side-by-side.md     # update the page and its plot
#
# You can also open it as a notebook: cells begin with `# %%`. The scans are simulated. If the environment variable
# `FLAGSTONE_DATA` names a directory with real scans, the scans in `kitti` are used too.

# %%
import argparse
import contextlib
import datetime
import importlib.util
import inspect
import json
import os
import pathlib
import platform
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import textwrap
import time
import typing

import numpy as np

os.environ["OMP_NUM_THREADS"] = "1"  # one thread; must be set before the packages are imported

# %% [markdown]
# ## Code
#
# Each function creates a segmenter and returns a function from points, (N, 4) float32 (x, y, z, intensity), to a ground
# mask. All settings have their default values, except the sensor height, and the 0.2 m and 1,000 iterations of RANSAC,
# which have no defaults.


# %%
def pypatchworkpp_patchwork(sensor_height):
    import numpy as np
    import pypatchworkpp

    parameters = pypatchworkpp.PatchworkParams()
    parameters.sensor_height = sensor_height
    segmenter = pypatchworkpp.patchwork(parameters)

    def ground_of(points):
        segmenter.estimateGround(points)
        ground = np.zeros(len(points), bool)
        ground[segmenter.getGroundIndices()] = True
        return ground

    return ground_of


def pypatchworkpp_patchworkpp(sensor_height):
    import numpy as np
    import pypatchworkpp

    parameters = pypatchworkpp.Parameters()
    parameters.sensor_height = sensor_height
    segmenter = pypatchworkpp.patchworkpp(parameters)

    def ground_of(points):
        segmenter.estimateGround(points)
        ground = np.zeros(len(points), bool)
        ground[segmenter.getGroundIndices()] = True
        return ground

    return ground_of


def open3d_segment_plane(_sensor_height):
    import numpy as np
    import open3d

    def ground_of(points):
        xyz = open3d.utility.Vector3dVector(points[:, :3].astype(float))
        _, inliers = open3d.geometry.PointCloud(xyz).segment_plane(0.2, ransac_n=3, num_iterations=1000)
        ground = np.zeros(len(points), bool)
        ground[inliers] = True
        return ground

    return ground_of


def flagstone_surface(sensor_height):
    import flagstone

    segmenter = flagstone.Surface(sensor_height=sensor_height)

    def ground_of(points):
        return segmenter.segment(points).ground

    return ground_of


def flagstone_patchwork(sensor_height):
    import flagstone

    segmenter = flagstone.Patchwork(sensor_height=sensor_height)

    def ground_of(points):
        return segmenter.segment(points).ground

    return ground_of


# %%
class Contender(typing.NamedTuple):
    """A ground segmentation method of a package."""

    title: str
    package: str
    make: typing.Callable  # sensor height, metres -> a function from points to a mask
    returns: str  # result of the package, before it is converted to a mask


CONTENDERS = (
    Contender("flagstone `Surface`", "flagstone", flagstone_surface, "label and height of each point"),
    Contender("flagstone `Patchwork`", "flagstone", flagstone_patchwork, "label of each point"),
    Contender(
        "pypatchworkpp `patchwork`", "pypatchworkpp", pypatchworkpp_patchwork, "two lists of indices, ordered by bin"
    ),
    Contender(
        "pypatchworkpp `patchworkpp`",
        "pypatchworkpp",
        pypatchworkpp_patchworkpp,
        "two arrays of indices, ordered by bin",
    ),
    Contender("Open3D `segment_plane`", "open3d", open3d_segment_plane, "indices of the plane's points, ascending"),
)


def installed(contenders=CONTENDERS):
    """The contenders whose package is installed. Prints the missing packages."""
    there = [c for c in contenders if importlib.util.find_spec(c.package)]
    for package in sorted({c.package for c in contenders if c not in there}):
        print(f"skipped: {package} is not installed (pip install {package})")
    return there


def lines_of(make):
    """Lines of code, without blank lines and without the three common lines: two `def`, one `return`."""
    return sum(bool(line.strip()) for line in inspect.getsource(make).splitlines()) - 3


@contextlib.contextmanager
def silence():
    """Discards standard output, because pypatchworkpp prints from C++ when it creates a segmenter."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def made(contender, sensor_height):
    with silence():
        return contender.make(sensor_height)


# %% [markdown]
# ## Scans
#
# Simulated: one HDL-64E scan of each of eight scenes, with exact classes. Real: eight full-density SemanticKITTI scans
# from two places; the first six were recorded within 1.5 seconds.


# %%
class Scan(typing.NamedTuple):
    """Points, (N, 4) float32, and their SemanticKITTI classes, (N,)."""

    points: np.ndarray
    classes: np.ndarray


SENSOR_HEIGHT = 1.73  # metres, for all scans
SCENES = (
    "flat_street", "steep_street", "parked_cars", "bushes_and_lawn", "urban_street", "crossroads", "highway", "park",
)  # fmt: skip
KITTI = (
    "00-000000", "00-000001", "00-000002", "00-000005", "00-000010", "00-000015", "08-000000", "08-000536",
)  # fmt: skip


def read_scan(points, labels):
    return Scan(np.fromfile(points, np.float32).reshape(-1, 4), np.fromfile(labels, np.uint32) & 0xFFFF)


def simulated_scans(folder, scenes):
    import flagstone

    scans = []
    for number, scene in enumerate(scenes):
        show_progress(f"simulating {scene}")
        frames = flagstone.simulate(folder, scene=scene, frames=1, sequence=f"{number:02}")
        scans.append(read_scan(frames[0].scan, frames[0].labels))
    return scans


def real_scans(names):
    folder = pathlib.Path(os.environ.get("FLAGSTONE_DATA", "/none")) / "kitti"
    if not folder.is_dir():
        print("skipped: real scans (set FLAGSTONE_DATA to a directory that contains kitti/)")
        return []
    return [read_scan(folder / "velodyne" / f"{name}.bin", folder / "labels" / f"{name}.label") for name in names]


def show_progress(text):
    """Shows a line on a terminal, in place of the previous one. An empty text clears the line."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


# %% [markdown]
# ## Accuracy
#
# F1 of ground under two protocols from the literature. Only results of the same protocol are comparable. A new
# segmenter is created for every scan. The last column is the percentage of labels that differ if the segmenter has
# processed earlier scans, because it adapts to them or because it is random.


# %%
GROUND = (40, 44, 48, 49, 60, 72)  # road, parking, sidewalk, other ground, lane marking, terrain
VEGETATION = 70
PROTOCOLS = ("patchwork", "patchwork++")


def truth_of(scan, protocol):
    """Masks of the ground points and of the scored points."""
    ground = np.isin(scan.classes, GROUND)
    if protocol == "patchwork":  # low vegetation is ground; all points are scored
        return ground | ((scan.classes == VEGETATION) & (scan.points[:, 2] < -1.3)), np.ones(len(ground), bool)
    return ground, ~np.isin(scan.classes, (0, 1, VEGETATION))  # unlabelled points and outliers are not scored


def f1_of(found, truth, scored):
    """Harmonic mean of precision and recall: 2 TP / (2 TP + FP + FN)."""
    hits = np.count_nonzero(found & truth & scored)
    return 2 * hits / (np.count_nonzero(found & scored) + np.count_nonzero(truth & scored))


def accuracy(contenders, scans):
    """Mean F1 per protocol, and labels changed by earlier scans, by contender, in percent."""
    found = {}
    for contender in contenders:
        show_progress(f"accuracy of {contender.title}")
        kept = made(contender, SENSOR_HEIGHT)
        rows = []
        for scan in scans:
            ground = made(contender, SENSOR_HEIGHT)(scan.points)
            f1 = [f1_of(ground, *truth_of(scan, protocol)) for protocol in PROTOCOLS]
            rows.append([*f1, np.mean(ground != kept(scan.points))])
        found[contender.title] = dict(zip((*PROTOCOLS, "changed"), 100 * np.mean(rows, axis=0), strict=True))
    return found


# %% [markdown]
# ## Time
#
# CPU time from the array to the mask, with one thread on one core. In each round, the contenders segment all scans one
# after the other, in an order that changes between rounds. Each contender uses one segmenter for all scans.


# %%
def times(contenders, scans, rounds):
    """Median CPU time per scan over scans and rounds, milliseconds, by contender."""
    segment = {contender.title: made(contender, SENSOR_HEIGHT) for contender in contenders}
    taken = {title: [] for title in segment}
    with one_core():
        for turn in range(rounds + 1):  # the first round is a warm-up
            show_progress(f"time, round {turn} of {rounds}")
            titles = list(segment)
            for title in titles[turn % len(titles) :] + titles[: turn % len(titles)]:
                for scan in scans:
                    start = time.process_time()
                    segment[title](scan.points)
                    taken[title].append(time.process_time() - start)
    return {title: 1000 * statistics.median(each[len(scans) :]) for title, each in taken.items()}


@contextlib.contextmanager
def one_core():
    """Pins this process to one core, if the operating system supports it."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


# %% [markdown]
# ## Invalid input
#
# Each case runs in a separate process, because some of them crash. The program counts the invalid points that are
# labelled ground, and the other points whose label changes compared with a scan without the invalid points.


# %%
CHILD = """
import json, sys
import numpy as np

{source}

make, case, directory = {name}, *sys.argv[1:]
points = np.load(directory + "/points.npy")
if case == "empty":
    outcome = {{"shape": list(make({height})(points[:0]).shape)}}
else:
    if case == "lost returns":
        points[::10] = np.nan
    else:
        points[::1000, 0] = points[500::1000, 2] = np.nan
    bad = np.isnan(points).any(axis=1)
    ground = make({height})(points)
    alone = make({height})(points[~bad])
    outcome = {{"labelled_ground": int(ground[bad].sum()), "changed": float(np.mean(ground[~bad] != alone))}}
with open(directory + "/outcome.json", "w") as file:
    json.dump(outcome, file)
"""

CASES = {
    "empty": "empty array, (0, 4)",
    "lost returns": "every tenth point NaN",
    "one coordinate": "x or z of every 500th point NaN",
}


def what_happens(contender, scan, case):
    """The outcome of a case in a few words."""
    source = textwrap.dedent(inspect.getsource(contender.make))
    program = CHILD.format(source=source, name=contender.make.__name__, height=SENSOR_HEIGHT)
    with tempfile.TemporaryDirectory() as folder:
        np.save(pathlib.Path(folder) / "points.npy", scan.points)
        done = subprocess.run([sys.executable, "-c", program, case, folder], capture_output=True, text=True)
        if done.returncode < 0:
            return f"crashes ({signal.Signals(-done.returncode).name})"
        if done.returncode > 0:
            return error_in(done.stderr)
        outcome = json.loads((pathlib.Path(folder) / "outcome.json").read_text())
    if case == "empty":
        return "empty result" if outcome["shape"] == [0] else f"result of shape {outcome['shape']}"
    ground = f"{outcome['labelled_ground']:,} labelled ground" if outcome["labelled_ground"] else "none labelled ground"
    changed = f"{max(0.01, 100 * outcome['changed']):.2f} % of the other labels change"
    return f"{ground}; {changed if outcome['changed'] else 'no other label changes'}"


def error_in(text):
    """Type of the exception and end of its message."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", text)  # messages of Open3D are coloured
    kind, _, message = [line for line in plain.splitlines() if "Error" in line][-1].partition(": ")
    return f"`{kind}`: {re.sub(r'^.*[.]cpp:[0-9]+: ', '', message)}"


def behaviour(contenders, scan):
    """Outcomes by contender and case."""
    outcomes = {}
    for contender in contenders:
        show_progress(f"invalid input: {contender.title}")
        outcomes[contender.title] = {case: what_happens(contender, scan, case) for case in CASES}
    return outcomes


# %% [markdown]
# ## Order of the labels
#
# A mask has the order of the points. The indices of pypatchworkpp are ordered by bin, and within a bin by height. You
# must sort them before you can combine them with other arrays of the scan.


# %%
def indices_of_pypatchworkpp(scan):
    import pypatchworkpp

    with silence():
        segmenter = pypatchworkpp.patchwork(pypatchworkpp.PatchworkParams())
        segmenter.estimateGround(scan.points)
    indices = np.asarray(segmenter.getGroundIndices())
    others = np.asarray(segmenter.getNongroundIndices())
    missing = len(scan.points) - len(indices) - len(others)
    print(
        f"pypatchworkpp.patchwork: first ground indices: {indices[:5].tolist()}; ascending:"
        f" {bool((np.diff(indices) > 0).all())}; in neither list: {missing} of {len(scan.points):,} points"
    )


# %% [markdown]
# ## Tables and plot


# %%
def table(head, rows, left=1):
    """A Markdown table. The first `left` columns are left-aligned, the others right-aligned."""
    rule = ["---"] * left + ["---:"] * (len(head) - left)
    return "\n".join("| " + " | ".join(line) + " |" for line in (head, rule, *rows))


def speed_table(contenders, milliseconds, f1):
    rows = [
        [
            contender.title,
            str(lines_of(contender.make)),
            f"{milliseconds[contender.title]:.2f}",
            *(f"{f1[contender.title][figure]:.2f}" for figure in (*PROTOCOLS, "changed")),
        ]
        for contender in contenders
    ]
    head = ["", "lines", "ms", *(f"F1 `{protocol}`" for protocol in PROTOCOLS), "labels changed by earlier scans, %"]
    return table(head, rows)


def behaviour_table(contenders, outcomes):
    rows = [
        [contender.title, contender.returns, *(outcomes[contender.title][case] for case in CASES)]
        for contender in contenders
    ]
    head = ["", "returns", *CASES.values()]
    return table(head, rows, left=len(head))


CPU = pathlib.Path("/proc/cpuinfo")


def made_by(what, scans, rounds):
    """Conditions of the measurement, for the line below the table."""
    processor = dict(re.findall(r"^(model name|cpu family|model)\s*: (.*)", CPU.read_text(), flags=re.MULTILINE))
    versions = [f"{name} {version_of(name)}" for name in ("flagstone", "pypatchworkpp", "open3d", "numpy")]
    points = statistics.mean(len(scan.points) for scan in scans)
    return (
        f"{what}: {len(scans)} scans of {points:,.0f} points (mean), median of {rounds} rounds;"
        f" {', '.join(v for v in versions if not v.endswith('None'))}; Python {platform.python_version()};"
        f" one core of an {processor['model name']}, family {processor['cpu family']}, model {processor['model']};"
        f" {datetime.date.today()}."
    )


def version_of(package):
    from importlib.metadata import PackageNotFoundError, version

    if package == "flagstone":  # it may be a source tree
        import flagstone

        return flagstone.__version__
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def filled(page, found):
    """The text of a page, with new tables between <!-- table NAME --> and <!-- end -->."""
    for name, text in found.items():
        page = re.sub(
            rf"<!-- table {name} -->.*?<!-- end -->",
            lambda _, name=name, text=text: f"<!-- table {name} -->\n\n{text}\n\n<!-- end -->",
            page,
            flags=re.DOTALL,
        )
    return page


def draw(results, file=None):
    """Plots F1 over time. Filled dots are real scans, hollow dots simulated scans."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7.5, 4.8), layout="constrained")
    colours = {"flagstone": "#b86a00", "pypatchworkpp": "#2f5f9e", "open3d": "#666666"}
    for what, (contenders, milliseconds, f1) in results.items():
        for contender in contenders:
            colour = colours[contender.package]
            place = milliseconds[contender.title], f1[contender.title]["patchwork++"]
            axes.plot(*place, "o", color=colour, markerfacecolor=colour if what == "kitti" else "white", markersize=8)
            if what == list(results)[-1]:
                to_the_left = contender.package == "open3d"
                axes.annotate(
                    contender.title.replace("`", ""),
                    place,
                    xytext=(-12 if to_the_left else 14, 0),
                    textcoords="offset points",
                    horizontalalignment="right" if to_the_left else "left",
                    verticalalignment="center",
                    color=colour,
                )
    for what, face in (("SemanticKITTI", "black"), ("simulated", "white")):
        axes.plot([], [], "o", color="black", markerfacecolor=face, markersize=8, label=what)
    axes.legend(loc="lower left", frameon=False)
    axes.set_xscale("log")
    axes.set_xlim(0.5, 500)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_xlabel("milliseconds per scan, one core")
    axes.set_ylabel("F1 of ground, % (protocol patchwork++)")
    axes.grid(alpha=0.25)
    axes.spines[["top", "right"]].set_visible(False)
    if file:
        figure.savefig(file, dpi=120)
        plt.close(figure)
    return figure


# %%
def main(arguments=None):
    parser = argparse.ArgumentParser(description="Segment the same scans with several packages.")
    parser.add_argument("--quick", action="store_true", help="use two scans and two rounds")
    parser.add_argument("--rounds", type=int, metavar="N", help="number of timing rounds (default: 15)")
    parser.add_argument(
        "--write", type=pathlib.Path, metavar="PAGE", help="update the tables and the plot of this page"
    )
    options = parser.parse_args(arguments)
    rounds = options.rounds or (2 if options.quick else 15)
    count = 2 if options.quick else len(SCENES)

    contenders = installed()
    found, results = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        sets = {"simulated": simulated_scans(folder, SCENES[:count]), "kitti": real_scans(KITTI[:count])}
    titles = {"simulated": "Simulated", "kitti": "SemanticKITTI"}
    for name, scans in sets.items():
        if not scans:
            continue
        f1 = accuracy(contenders, scans)
        milliseconds = times(contenders, scans, rounds)
        results[name] = (contenders, milliseconds, f1)
        found[name] = f"{speed_table(contenders, milliseconds, f1)}\n\n{made_by(titles[name], scans, rounds)}"
    found["behaviour"] = behaviour_table(contenders, behaviour(contenders, sets["simulated"][0]))
    show_progress("")
    if any(contender.package == "pypatchworkpp" for contender in contenders):
        indices_of_pypatchworkpp(sets["simulated"][0])
    print("\n\n".join(["", *found.values()]))
    if options.write:
        options.write.write_text(filled(options.write.read_text(), found))
        draw(results, options.write.parent.parent / "images" / "side-by-side.png")
    return results


if __name__ == "__main__":
    try:
        results = main([] if "ipykernel" in sys.modules else None)  # in a notebook, draw(results) shows the plot
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
