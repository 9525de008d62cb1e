# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures changes of the labels if the order, number or direction of points changes: tables of robustness.md.

    python3 bench/invariance_study.py run --work /tmp/study                  # all sets, some minutes
    python3 bench/invariance_study.py run --work /tmp/study --only livox-10  # one set; the other results are kept
    python3 bench/invariance_study.py page                                   # tables of docs/results/invariance.json
    python3 bench/invariance_study.py check                                  # do the tables match the results?

`run` needs the command (build/flagstone), NumPy and the real scans in FLAGSTONE_DATA. It writes changed copies of the
scans to the work directory (1 GB), labels them, brings the labels into the original order and scores them there.
"""

import pathlib
import shutil
import statistics
import sys
import typing

from study import ROOT, Runs, main, percent, rounded, show_progress, table
from surface_study import FULL_KITTI, LIVOX_HEIGHTS

PAGES = (ROOT / "docs" / "benchmarks" / "robustness.md",)
RESULTS = ROOT / "docs" / "results" / "invariance.json"
METHODS = ("surface", "patchwork")


# --- scan sets ------------------------------------------------------------------------------------------------

BOTH_PROTOCOLS = ("patchwork", "patchwork++")  # of SemanticKITTI
SEQUENCES = ("00", "03", "05", "10")


class Scans(typing.NamedTuple):
    """A set of scans. `files` is a function from the directory of real scans to (name, points, labels)."""

    title: str
    height: float
    protocols: tuple
    files: typing.Callable


def named(directory, names):
    """Scans in a directory with velodyne/ and labels/."""

    def files(data):
        folder = data / directory
        return [(name, folder / "velodyne" / f"{name}.bin", folder / "labels" / f"{name}.label") for name in names]

    return files


def sequences(data):
    return [
        (f"{number}-{file.stem}", file, file.parent.parent / "labels" / f"{file.stem}.label")
        for number in SEQUENCES
        for file in sorted((data / "sequences" / number / "velodyne").glob("*.bin"))
    ]


def pandaset(data):
    names = [file.stem for file in sorted((data / "pandaset" / "velodyne").glob("*.bin"))]
    return named("pandaset", names)(data)


def nuscenes(data):
    names = [file.name.removesuffix(".pcd.bin") for file in sorted((data / "nuscenes").glob("*.pcd.bin"))]
    return [(name, data / "nuscenes" / f"{name}.pcd.bin", data / "nuscenes" / f"{name}_lidarseg.bin") for name in names]


def classes_of(directory):
    return (f"$FLAGSTONE_DATA/{directory}/classes.json",)


SETS = {
    "kitti": Scans("KITTI", 1.73, BOTH_PROTOCOLS, named("kitti", FULL_KITTI)),
    "voxel-means": Scans(
        "KITTI, voxel means", 1.73, BOTH_PROTOCOLS, named("kitti", ["01-000000-sub", "01-000001-sub"])
    ),
    "sequences": Scans("KITTI, sequences 00, 03, 05, 10", 1.73, BOTH_PROTOCOLS, sequences),
    "nuscenes": Scans("nuScenes", 1.84, classes_of("nuscenes"), nuscenes),
    **{
        f"livox-{name[:2]}": Scans(f"Livox {name[:2]}", height, classes_of("livox"), named("livox", [name]))
        for name, height in LIVOX_HEIGHTS.items()
    },
    "pandaset": Scans("PandaSet", 2.1, classes_of("pandaset"), pandaset),
}


# --- changes of a scan ----------------------------------------------------------------------------------------

SHUFFLES = 100
TURNS = (10, 20, *range(45, 360, 45))  # degrees about the z axis


class Change(typing.NamedTuple):
    """`change(points, random)` returns changed points and, for each original point, its index among them."""

    kind: str
    name: str
    change: typing.Callable


def shuffled(points, random):
    order = random.permutation(len(points))
    indices = order.copy()
    indices[order] = range(len(points))  # the inverse permutation
    return points[order], indices


def doubled(points, _random):
    """Every point twice in a row."""
    return points.repeat(2, axis=0), range(0, 2 * len(points), 2)


def turned(degrees):
    def change(points, _random):
        import numpy as np

        angle = np.radians(degrees)
        # Multiples of 90 degrees are exact.
        sine, cosine = (round(f, 15) for f in (np.sin(angle), np.cos(angle)))
        changed = points.copy()
        changed[:, 0] = cosine * points[:, 0].astype(float) - sine * points[:, 1]
        changed[:, 1] = sine * points[:, 0].astype(float) + cosine * points[:, 1]
        return changed, range(len(points))

    return change


def flipped(axis):
    def change(points, _random):
        changed = points.copy()
        changed[:, axis] *= -1
        return changed, range(len(points))

    return change


CHANGES = [
    *(Change("shuffled", f"shuffle {number}", shuffled) for number in range(SHUFFLES)),
    Change("doubled", "every point twice", doubled),
    *(Change("turned", f"turned by {degrees}°", turned(degrees)) for degrees in TURNS),
    Change("flipped", "x negated", flipped(0)),
    Change("flipped", "y negated", flipped(1)),
]
KINDS = list(dict.fromkeys(change.kind for change in CHANGES))


# --- measurement ----------------------------------------------------------------------------------------------


def measure_set(runs, scans):
    """The summary of each method on a set; None if its scans are missing."""
    import numpy as np

    data = pathlib.Path(runs.directories["$FLAGSTONE_DATA"])
    files = scans.files(data)
    if not files or not all(points.exists() for _, points, _ in files):
        return None
    work = runs.work / "invariance"
    shutil.rmtree(work, ignore_errors=True)
    clouds, columns = {}, 4
    for name, points, _ in files:
        columns = 5 if points.name.endswith(".pcd.bin") else 4
        clouds[name] = np.fromfile(points, "<f4").reshape(-1, columns)
    link_scans(files, work / "original")

    def label(scans_directory, output):
        for method in METHODS:
            runs.call(
                f"flagstone segment {scans_directory} --columns {columns} --method {method}"
                f" --sensor-height {scans.height} --output {output}/{method}"
            )

    has_folders = (work / "original" / "velodyne").exists()
    label(work / "original" / "velodyne" if has_folders else work / "original", work / "before")
    original = {
        method: {name: read_labels(work / "before" / method / f"{name}.label") for name in clouds} for method in METHODS
    }

    found = {method: {change.name: {} for change in CHANGES} for method in METHODS}
    for number, change in enumerate(CHANGES):
        show_progress(f"{scans.title}: {number + 1} of {len(CHANGES)}, {change.name}")
        copies = work / "changed"
        copies.mkdir()
        indices = {}
        for index, (name, points) in enumerate(clouds.items()):
            changed, indices[name] = change.change(points, np.random.default_rng([number, index]))
            changed.astype("<f4").tofile(copies / f"{name}.bin")
        label(copies, work / "after")
        for method in METHODS:
            target = work / f"{method}-{number}"
            target.mkdir()
            shares = {}
            for name in clouds:
                labels = read_labels(work / "after" / method / f"{name}.label")[np.asarray(indices[name])]
                labels.tofile(target / f"{name}.label")
                shares[name] = float((labels != original[method][name]).mean())
            found[method][change.name]["changed"] = shares
        shutil.rmtree(copies)
        shutil.rmtree(work / "after")
    for method in METHODS:
        directories = {change.name: work / f"{method}-{number}" for number, change in enumerate(CHANGES)}
        f1 = f1_by_protocol(runs, scans, work, {"original": work / "before" / method} | directories)
        found[method]["original"] = {protocol: of.pop("original") for protocol, of in f1.items()}
        for change in CHANGES:
            found[method][change.name]["f1"] = {protocol: of[change.name] for protocol, of in f1.items()}
    shutil.rmtree(work)
    return {"title": scans.title, **{method: summary(found[method]) for method in METHODS}}


def link_scans(files, directory):
    """A directory with links to the scans and their labels, for `flagstone segment` and `flagstone eval`."""
    directory.mkdir(parents=True)
    for name, points, labels in files:
        if points.name.endswith(".pcd.bin"):
            (directory / points.name).symlink_to(points.resolve())
            (directory / labels.name).symlink_to(labels.resolve())
            continue
        for kind, file in (("velodyne", points), ("labels", labels)):
            (directory / kind).mkdir(exist_ok=True)
            (directory / kind / f"{name}{file.suffix}").symlink_to(file.resolve())


def read_labels(file):
    import numpy as np

    return np.fromfile(file, "<u4")


def f1_by_protocol(runs, scans, work, directories):
    """F1 per scan by protocol and name; `directories` contain labels of the original points, by name."""
    found = {}
    for protocol in scans.protocols:
        found[protocol] = {}
        names = list(directories)
        for first in range(0, len(names), 20):
            some = names[first : first + 20]
            labels = " ".join(f"--labels l{i}={directories[name]}" for i, name in enumerate(some))
            result = runs.evaluate_command(
                f"flagstone eval {work}/original --sensor-height {scans.height} --protocol {protocol}"
                f" --methods none {labels}"
            )
            by_name = {method["name"]: method["per_scan"] for method in result["methods"]}
            for i, name in enumerate(some):
                found[protocol][name] = {scan["scan"]: scan["f1"] or 0.0 for scan in by_name[f"l{i}"]}
    return found


def summary(found):
    """Of one method: F1 by protocol; for each kind of change, changed labels and changes of F1."""
    f1 = {protocol: statistics.fmean(scans.values()) for protocol, scans in found["original"].items()}
    kinds = {}
    for kind in KINDS:
        names = [change.name for change in CHANGES if change.kind == kind]
        shares = [share for name in names for share in found[name]["changed"].values()]
        kinds[kind] = {"changed": statistics.fmean(shares), "changed_most": max(shares), "f1": {}}
        for protocol, before in found["original"].items():
            by_scan = [
                {scan: value - before[scan] for scan, value in found[name]["f1"][protocol].items()} for name in names
            ]
            means = [statistics.fmean(scans.values()) for scans in by_scan]
            kinds[kind]["f1"][protocol] = {
                "mean": statistics.fmean(means),
                "largest": max(means, key=abs),
                "largest_of_a_scan": max((value for scans in by_scan for value in scans.values()), key=abs),
            }
    scans = len(next(iter(found["original"].values())))
    return {"scans": scans, "f1": f1, "kinds": kinds}


# --- tables ---------------------------------------------------------------------------------------------------


def points(difference):
    return f"{round(100 * difference, 2) + 0.0:+.2f}"


def changes_table(results, method):
    rows = []
    for name in (name for name in SETS if name in results):
        found = results[name][method]
        for protocol, f1 in found["f1"].items():
            title = results[name]["title"] + (f", `{protocol}`" if protocol in BOTH_PROTOCOLS else "")
            cells = []
            for kind in KINDS:
                of = found["kinds"][kind]
                cells.append(percent(of["changed"]))
                if kind == "shuffled":
                    continue
                cells.append(points(of["f1"][protocol]["mean"]))
                if kind != "doubled":
                    cells.append(points(of["f1"][protocol]["largest"]))
            rows.append([title, str(found["scans"]), percent(f1), *cells])
    head = ["scans", "number", "F1", "shuffled: labels", "doubled: labels", "F1"]
    head += [text for kind in ("turned", "flipped") for text in (f"{kind}: labels", "F1, mean", "F1, largest")]
    made_by = next(iter(results.values()))["made_by"]
    return f"{table(head, rows)}\n\n{made_by['date']}, {made_by['machine']}"


def tables(results):
    return {f"invariance-{method}": changes_table(results, method) for method in METHODS} if results else {}


def measure(options):
    runs = Runs(options.work, options.flagstone)
    found = {}
    for name in options.only:
        result = measure_set(runs, SETS[name])
        if result is None:
            print(f"{name}: skipped, no scans in FLAGSTONE_DATA", file=sys.stderr)
            continue
        found[name] = {**rounded(result), "made_by": dict(runs.made_by)}
    return found


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, SETS)
