# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs other implementations of ground segmentation over a dataset and writes labels for `flagstone eval --labels`.

    python3 -m pip install numpy pypatchworkpp==1.4.1 open3d cloth-simulation-filter
    python3 bench/external_tools.py DATASET --output /tmp/external

The last line printed is the command that scores the labels together with flagstone's methods. Packages that are not
installed are listed and skipped. Datasets are the same as for `flagstone eval`: sequences/NN/velodyne, velodyne/ or
NAME.pcd.bin files. Every tool runs with its own defaults on one core, after one scan to warm up. Label files contain
one uint32 per point, 1 for ground, in the order of the scan. The timed part begins with points in the tool's own format
and ends with the indices of ground points.
"""

import argparse
import contextlib
import importlib
import os
import pathlib
import shlex
import sys
import time
import typing

os.environ.setdefault("OMP_NUM_THREADS", "1")  # must be set before the packages are loaded

import numpy as np


class ExternalTool(typing.NamedTuple):
    """An implementation to compare with."""

    convert: typing.Callable  # points (N, 4), float32: x, y, z, intensity -> the format of the tool
    prepare: typing.Callable  # () -> function from converted points to indices of ground points


def pypatchworkpp_tool(method, sensor_height):
    package = importlib.import_module("pypatchworkpp")
    classes = {
        "patchwork": (package.PatchworkParams, package.patchwork),
        "patchworkpp": (package.Parameters, package.patchworkpp),
    }

    def prepare():  # a new segmenter for each scan, because patchworkpp adapts to earlier scans
        make_parameters, make = classes[method]
        parameters = make_parameters()
        parameters.sensor_height = sensor_height
        parameters.verbose = False
        segmenter = make(parameters)

        def ground(points):
            segmenter.estimateGround(points)
            return segmenter.getGroundIndices()

        return ground

    return ExternalTool(np.asfortranarray, prepare)  # pypatchworkpp stores points by columns


def open3d_ransac(_sensor_height):
    """The largest plane: threshold 0.2 m, as in flagstone's RANSAC, and 1,000 iterations."""
    open3d = importlib.import_module("open3d")

    def cloud_of(points):
        return open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points[:, :3].astype(np.float64)))

    def ground(cloud):
        open3d.utility.random.seed(0)
        _, inliers = cloud.segment_plane(distance_threshold=0.2, ransac_n=3, num_iterations=1000)
        return inliers

    return ExternalTool(cloud_of, lambda: ground)


def cloth_simulation(_sensor_height):
    """W. Zhang et al., "An Easy-to-Use Airborne LiDAR Data Filtering Method Based on Cloth Simulation",
    Remote Sensing 8(6), 2016. Cells of 0.5 m, which suit streets."""
    package = importlib.import_module("CSF")

    def ground(points):
        csf = package.CSF()
        csf.params.bSloopSmooth = False
        csf.params.cloth_resolution = 0.5
        csf.setPointCloud(points[:, :3].astype(np.float64))
        found, others = package.VecInt(), package.VecInt()
        csf.do_filtering(found, others, False)
        return np.array(found, int)

    return ExternalTool(lambda points: points, lambda: ground)


TOOLS = {
    "pypatchworkpp-patchwork": lambda height: pypatchworkpp_tool("patchwork", height),
    "pypatchworkpp-patchworkpp": lambda height: pypatchworkpp_tool("patchworkpp", height),
    "open3d-ransac": open3d_ransac,
    "csf": cloth_simulation,
}


def scans_of(dataset, sequences, every):
    """Pairs of the name of a scan, as in `flagstone eval`, and its file."""
    if (dataset / "sequences").is_dir():
        names = sequences or sorted(p.name for p in (dataset / "sequences").iterdir())
        for name in names:
            files = sorted((dataset / "sequences" / name / "velodyne").glob("*.bin"))
            yield from ((f"{name}/{file.stem}", file) for file in files[::every])
    elif (dataset / "velodyne").is_dir():
        files = sorted((dataset / "velodyne").glob("*.bin"))
        yield from ((file.stem, file) for file in files[::every])
    else:
        files = sorted(dataset.glob("*.pcd.bin"))
        yield from ((file.name.removesuffix(".pcd.bin"), file) for file in files[::every])


def read(file):
    columns = 5 if file.name.endswith(".pcd.bin") else 4
    return np.fromfile(file, np.float32).reshape(-1, columns)[:, :4]


@contextlib.contextmanager
def silence():
    """Discards standard output, to which the packages print from C++."""
    sys.stdout.flush()
    saved, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(null)


def usable_points(points):
    """Indices of points with finite coordinates that are not all zero. Only these are passed to a tool."""
    return np.flatnonzero(np.isfinite(points[:, :3]).all(axis=1) & (points[:, :3] != 0).any(axis=1))


def segment(tool, points):
    """One code per point, and the time in seconds."""
    usable = usable_points(points)
    converted = tool.convert(points[usable])
    with silence():
        ground = tool.prepare()
        start = time.perf_counter()
        found = ground(converted)
        seconds = time.perf_counter() - start
    codes = np.zeros(len(points), np.uint32)
    codes[usable[found]] = 1
    return codes, seconds


def run(name, tool, scans, directory):
    segment(tool, read(scans[0][1]))  # warm-up
    times = []
    for i, (scan, file) in enumerate(scans):
        codes, seconds = segment(tool, read(file))
        times.append(seconds)
        out = directory / f"{scan}.label"
        out.parent.mkdir(parents=True, exist_ok=True)
        codes.tofile(out)
        if sys.stderr.isatty():
            print(f"\r{name}: {i + 1} of {len(scans)} scans", end="", file=sys.stderr)
    slowest = np.sort(times)[-max(1, len(times) // 100) :]
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr)
    print(
        f"{name:<26} {1 / np.mean(times):8.2f} Hz mean, {1 / np.mean(slowest):8.2f} Hz slowest 1 %, "
        f"{1000 * np.median(times):8.2f} ms median, {len(times)} scans",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=pathlib.Path)
    parser.add_argument(
        "--output", type=pathlib.Path, required=True, help="output directory; one subdirectory per tool"
    )
    parser.add_argument("--tools", default=",".join(TOOLS), help="tools to run (default: %(default)s)")
    parser.add_argument("--sensor-height", type=float, default=1.73, help="metres (default: %(default)s)")
    parser.add_argument("--sequences", default="", help="for example 05,10 (default: all)")
    parser.add_argument("--every", type=int, default=1, help="every N-th scan of each sequence")
    options = parser.parse_args()

    sequences = [s for s in options.sequences.split(",") if s]
    scans = list(scans_of(options.dataset, sequences, options.every))
    if not scans:
        sys.exit(f"{options.dataset}: no scans (expected sequences/NN/velodyne, velodyne/ or *.pcd.bin)")
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # one core

    labels = []
    for name in options.tools.split(","):
        if name not in TOOLS:
            sys.exit(f"--tools: unknown tool {name!r} (expected {', '.join(TOOLS)})")
        try:
            tool = TOOLS[name](options.sensor_height)
        except ImportError as error:
            print(f"{name:<26} skipped: {error}")
            continue
        run(name, tool, scans, options.output / name)
        labels += ["--labels", f"{name}={options.output / name}"]
    command = ["flagstone", "eval", str(options.dataset)]
    command += ["--sequences", options.sequences] if options.sequences else []
    command += ["--every", str(options.every)] if options.every > 1 else []
    print(shlex.join([*command, "--methods", "all", *labels]))


if __name__ == "__main__":
    main()
