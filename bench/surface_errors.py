# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Which points `surface` gets wrong: their classes, and how high they truly lie above the ground."""

import json
import pathlib
import tempfile

from flagstone_runs import show_progress
from surface_scans import LIVOX_HEIGHTS, SCENES
from tables import percent, table

MOST_CLASSES = 5  # named of each kind of error

# Bands of true height above the ground, metres: upper ends.
HEIGHT_BANDS = (-0.1, 0.05, 0.1, 0.15, 0.2, 0.3)


def scans_by_set(study):
    """Set -> (what `flagstone segment` takes, where the labels are, classes.json)."""
    real = pathlib.Path(study.places["$FLAGSTONE_DATA"])
    sets = {
        "kitti": (
            [f"$WORK/kitti/velodyne --sensor-height {1.73}"],
            sorted((study.work / "kitti" / "labels").glob("*.label")),
        ),
        "nuscenes": (
            ["$FLAGSTONE_DATA/nuscenes --sensor-height 1.84"],
            sorted((real / "nuscenes").glob("*_lidarseg.bin")),
        ),
        "livox": (
            [
                f"$WORK/livox/{name}/velodyne --sensor-height {height}"
                for name, height in LIVOX_HEIGHTS.items()
            ],
            [study.work / "livox" / name / "labels" / f"{name}.label" for name in LIVOX_HEIGHTS],
        ),
    }
    return {
        name: (*found, json.loads((real / name / "classes.json").read_text())) for name, found in sets.items()
    }


def measure_errors(study):
    """By real set: wrong points by class, as shares of the true ground points; vegetation of KITTI is not scored."""
    found = {}
    for name, (inputs, label_files, classes) in scans_by_set(study).items():
        show_progress(f"errors on {name}")
        ignored = {*classes["ignored"], *([70] if name == "kitti" else [])}
        with tempfile.TemporaryDirectory(prefix="flagstone-errors-") as place:
            for arguments in inputs:
                study.call(
                    f"flagstone segment {arguments} --method surface{set_options(study)} --output {place}"
                )
            found[name] = errors_by_class(pathlib.Path(place), label_files, classes, ignored)
    return found


def set_options(study):
    return "".join(f" --set {setting}" for setting in study.settings)


def errors_by_class(folder, label_files, classes, ignored):
    import numpy as np

    wrong, missed, ground_points = {}, {}, 0
    for file in label_files:
        name = file.name.removesuffix("_lidarseg.bin").removesuffix(".label")
        is_bytes = file.name.endswith("_lidarseg.bin")
        truth = np.fromfile(file, "u1" if is_bytes else "<u4").astype(np.uint32) & 0xFFFF
        ours = np.fromfile(folder / f"{name}.label", "<u4") == 1
        is_ground = np.isin(truth, classes["ground"])
        scored = ~np.isin(truth, list(ignored))
        ground_points += int(is_ground.sum())
        for counts, chosen in ((wrong, ours & ~is_ground & scored), (missed, ~ours & is_ground)):
            for number, count in zip(*np.unique(truth[chosen], return_counts=True)):
                counts[int(number)] = counts.get(int(number), 0) + int(count)

    def shares(counts):
        names = classes["names"]
        ranked = sorted(counts.items(), key=lambda entry: -entry[1])[:MOST_CLASSES]
        return {
            "all": sum(counts.values()) / ground_points,
            "classes": {
                names.get(str(number), str(number)): count / ground_points for number, count in ranked
            },
        }

    return {"taken": shares(wrong), "missed": shares(missed), "ground_points": ground_points}


def measure_true_heights(study):
    """By simulated scene: points taken for ground that are none, by their true height, as shares of the ground."""
    import numpy as np

    found = {}
    for number, scene in enumerate(SCENES):
        show_progress(f"errors by height, {scene}")
        folder = study.work / "simulated" / "sequences" / f"{number:02}"
        scans = sorted((folder / "velodyne").glob("*0.bin"))  # the first of each drive
        bands = np.zeros(len(HEIGHT_BANDS) + 1)
        ground_points = missed = 0
        with tempfile.TemporaryDirectory(prefix="flagstone-errors-") as place:
            files = " ".join(f"$WORK/simulated/sequences/{number:02}/velodyne/{scan.name}" for scan in scans)
            study.call(f"flagstone segment {files} --method surface{set_options(study)} --output {place}")
            for scan in scans:
                height = np.fromfile(scan, "<f4").reshape(-1, 4)[:, 2]
                height = height - np.load(folder / "ground" / f"{scan.stem}.npy")
                truth = np.fromfile(folder / "labels" / f"{scan.stem}.label", "<u4")
                ours = np.fromfile(pathlib.Path(place) / f"{scan.stem}.label", "<u4") == 1
                is_ground = np.isin(truth & 0xFFFF, (40, 44, 48, 49, 60, 72))
                taken = ours & ~is_ground & np.isfinite(height)
                bands += np.bincount(np.searchsorted(HEIGHT_BANDS, height[taken]), minlength=len(bands))
                ground_points += int(is_ground.sum())
                missed += int((is_ground & ~ours).sum())
        found[scene] = {"taken": (bands / ground_points).tolist(), "missed": missed / ground_points}
    return found


# --- tables ------------------------------------------------------------------------------------------------


def errors_table(results, titles):
    rows = []
    for name, title in titles.items():
        kinds = [results[name][kind] for kind in ("taken", "missed")]
        rows.append(
            [title, *(text for kind in kinds for text in (percent(kind["all"]), class_list(kind["classes"])))]
        )
    head = ["% of ground points", "taken for ground", "of these", "missed", "of these"]
    return table(head, rows)


def class_list(shares):
    return ", ".join(f"{name} {percent(share)}" for name, share in shares.items())


def true_heights_table(results):
    ends = [f"{100 * end:.0f}" for end in HEIGHT_BANDS]
    bands = [
        f"below {ends[0]} cm",
        *(f"{low} to {high}" for low, high in zip(ends, ends[1:])),
        f"above {ends[-1]}",
    ]
    rows = [
        [
            scene.replace("_", " "),
            percent(sum(row["taken"])),
            *(percent(band) for band in row["taken"]),
            percent(row["missed"]),
        ]
        for scene, row in results.items()
        if scene in SCENES
    ]
    return table(["% of ground points", "taken for ground", *bands, "missed"], rows)
