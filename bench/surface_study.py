# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures the method `surface` and writes the tables of docs/benchmarks/accuracy.md and robustness.md. Needs Python 3.11 and NumPy.

    python3 bench/surface_study.py run --work /tmp/study               # all of it, some ten minutes
    python3 bench/surface_study.py run --work /tmp/study --only robustness
    python3 bench/surface_study.py try --work /tmp/study --only ablation --set point.margin=0.15
    python3 bench/surface_study.py page                                # the tables, from docs/results/surface.json
    python3 bench/surface_study.py check                               # are the page's tables those of the results?

`run` wants the command built (build/flagstone) and the real scans in FLAGSTONE_DATA. The first time it simulates
six sequences of 200 scans in the work folder (4 GB, some minutes); later runs keep them. `try` prints tables and
writes nothing: the settings of --set hold throughout, for the rows with nothing changed too. Tables stand in the
page between <!-- table NAME --> and <!-- end -->.
"""

import json
import os
import pathlib
import statistics
import sys
import tempfile
import typing

from study import (
    ROOT,
    Runs,
    main,
    mean_of,
    paired,
    percent,
    percentage_points,
    rounded,
    show_progress,
    table,
    with_interval,
)

PAGES = (ROOT / "docs" / "benchmarks" / "accuracy.md", ROOT / "docs" / "benchmarks" / "robustness.md")
RESULTS = ROOT / "docs" / "results" / "surface.json"


# --- the scans, and `flagstone eval` over them ----------------------------------------------------------------

SCENES = ["flat_street", "steep_street", "parked_cars", "bushes_and_lawn", "bumpy_field", "steps"]

# SemanticKITTI scans with all their points; the others of that folder are means of voxels.
FULL_KITTI = [*(f"00-{frame:06}" for frame in (0, 1, 2, 5, 10, 15)), "08-000000", "08-000536"]
LIVOX_HEIGHTS = {"01-000000": 1.2, "04-000000": 1.8, "10-000000": 1.1}


class Scans(typing.NamedTuple):
    """A set of scans: the arguments of `flagstone eval` for it; several where its scans need different ones."""

    title: str
    arguments: tuple
    simulated: bool


def scan_sets(work):
    """By name. Folders of links to real scans are made in the work folder."""
    data = pathlib.Path(os.environ.get("FLAGSTONE_DATA", ROOT.parent / "shared" / "data"))
    if not (data / "kitti").is_dir():
        sys.exit(f"{data}: no folder of real scans with kitti/; FLAGSTONE_DATA names it")
    link_scans(data / "kitti", FULL_KITTI, work / "kitti")
    for name in LIVOX_HEIGHTS:
        link_scans(data / "livox", [name], work / "livox" / name)
    kitti = "$WORK/kitti --sensor-height 1.73 --protocol"
    sets = {
        "kitti/patchwork": Scans("KITTI `patchwork`", (f"{kitti} patchwork",), False),
        "kitti/patchwork++": Scans("KITTI `patchwork++`", (f"{kitti} patchwork++",), False),
        "nuscenes": Scans(
            "nuScenes",
            ("$FLAGSTONE_DATA/nuscenes --sensor-height 1.84 --protocol $FLAGSTONE_DATA/nuscenes/classes.json",),
            False,
        ),
        "livox": Scans(
            "Livox",
            tuple(
                f"$WORK/livox/{name} --sensor-height {height} --protocol $FLAGSTONE_DATA/livox/classes.json"
                for name, height in LIVOX_HEIGHTS.items()
            ),
            False,
        ),
    }
    for number, scene in enumerate(SCENES):
        # The first scan of each drive: as many worlds as scans.
        arguments = f"$WORK/simulated --sequences {number:02} --every 10 --sensor-height 1.73 --protocol simulation"
        sets[scene] = Scans(scene.replace("_", " "), (arguments,), True)
    return sets


def link_scans(data, names, folder):
    """A folder with velodyne/ and labels/ of some of the scans of another."""
    for kind, ending in (("velodyne", "bin"), ("labels", "label")):
        (folder / kind).mkdir(parents=True, exist_ok=True)
        for name in names:
            link = folder / kind / f"{name}.{ending}"
            target = data / kind / f"{name}.{ending}"
            if link.is_symlink():
                link.unlink()
            link.symlink_to(target.resolve())


class Study(Runs):
    """Where the scans are, which settings of `surface` hold throughout, and what was evaluated so far."""

    def __init__(self, work, flagstone, settings=()):
        super().__init__(work, flagstone)
        self.settings = tuple(settings)  # KEY=VALUE
        self.known = {}
        self.sets = scan_sets(work)

    def simulate(self, frames=200):
        """Writes the simulated sequences; what is there already is kept."""
        for number, scene in enumerate(SCENES):
            show_progress(f"simulating {scene}")
            self.call(
                f"flagstone simulate --scene {scene} --frames {frames} --seed 1 --output $WORK/simulated"
                f" --sequence {number:02}"
            )

    def command(self, arguments, methods, settings=()):
        words = [f"flagstone eval {arguments} --methods {','.join(methods)}"]
        words += [f"--set surface.{setting}" for setting in (*self.settings, *settings)]
        return " ".join(words)

    def evaluate(self, name, methods=("surface",), settings=()):
        """The results of a set, one for each of its `arguments`; settings are those of `surface`."""
        commands = [self.command(arguments, methods, settings) for arguments in self.sets[name].arguments]
        for command in commands:
            if command not in self.known:
                self.known[command] = self.evaluate_command(command)
        return [self.known[command] for command in commands]

    def surface_defaults(self):
        """Those of `surface` that hold throughout."""
        return surface_settings(self, "".join(f" --set {setting}" for setting in self.settings))


def surface_settings(runs, options=""):
    """The settings of `surface` except the sensor height, by key."""
    import tomllib  # from Python 3.11 on; tables are written and checked with less

    text = runs.call(f"flagstone config --method surface{options}")
    text = text.partition("\n[mount]")[0]  # how the sensor is mounted belongs to no method
    values = flat(tomllib.loads(text))
    values.pop("sensor_height")
    return values


def flat(values, prefix=""):
    """{"a": {"b": 1}} as {"a.b": 1}."""
    found = {}
    for key, value in values.items():
        found.update(flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value})
    return found


def per_scan(results, method):
    """The scans of one method in the results of a set."""
    return {
        "per_scan": [
            scan
            for result in results
            for entry in result["methods"]
            if entry["name"] == method
            for scan in entry["per_scan"]
        ]
    }


# --- what `surface` loses without one of its parts, and what each setting does --------------------------------

# A part, and the settings that take it out; {margin} and the like stand for the settings' own values.
REMOVALS = [
    ("uprightness: patches up to 60° steep", ["acceptance.upright_angle=30"]),
    ("contrast of patches", ["acceptance.max_clutter_ratio=inf"]),
    ("cone", ["acceptance.max_height=1000"]),
    ("consistency with nearer patches", ["acceptance.max_step=inf"]),
    ("all refinement: the coarse surface alone", ["refinement.levels=0"]),
    ("cells of 1 m and less", ["refinement.levels=1"]),
    ("cells of 0.5 m and less", ["refinement.levels=2"]),
    ("cells of 0.25 m", ["refinement.levels=3"]),
    ("contrast of cells", ["refinement.max_clutter_ratio=inf"]),
    ("lower bound", ["refinement.lower_bound_weight=0"]),
    ("narrower gates on finer levels", ["refinement.gate_factor=1"]),
    ("smaller margin at obstacles", ["point.obstacle_margin={point.margin}"]),
    ("wider margin elsewhere", ["point.margin={point.obstacle_margin}"]),
    ("noise below the surface", ["point.noise_depth=1000"]),
]

# Settings are halved and doubled, except these.
OTHER_VALUES = {
    "max_range": (50, 80),
    "acceptance.upright_angle": (40, 60),
    "refinement.levels": (2, 3),
    "refinement.gate_factor": (0.5, 0.8),
}


def difference(study, names, settings):
    """F1 with settings less F1 without, over the scans of some sets."""
    changed = [result for name in names for result in study.evaluate(name, settings=settings)]
    before = [result for name in names for result in study.evaluate(name)]
    return paired(per_scan(changed, "surface"), per_scan(before, "surface"), "f1")


def level_of(study, name):
    """F1 of a set, mean over scans."""
    return mean_of([scan["f1"] for scan in per_scan(study.evaluate(name), "surface")["per_scan"]])


def measure_ablation(study):
    values = study.surface_defaults()
    rows = []
    for part, templates in REMOVALS:
        settings = [named(template, values) for template in templates]
        show_progress(f"ablation {len(rows) + 1} of {len(REMOVALS)}: {part}")
        rows.append(
            {
                "part": part,
                "settings": settings,
                "f1": {name: difference(study, [name], settings) for name in study.sets},
            }
        )
    return {"whole": {name: level_of(study, name) for name in study.sets}, "rows": rows}


def named(template, values):
    for key, value in values.items():
        template = template.replace(f"{{{key}}}", f"{value:g}")
    return template


def measure_settings(study):
    real = [name for name, scans in study.sets.items() if not scans.simulated]
    simulated = [name for name, scans in study.sets.items() if scans.simulated]
    rows = []
    defaults = study.surface_defaults()
    for key, value in defaults.items():
        show_progress(f"setting {len(rows) // 2 + 1} of {len(defaults)}: {key}")
        for other in OTHER_VALUES.get(key, (value / 2, value * 2)):
            settings = [f"{key}={other:g}"]
            f1 = {name: difference(study, [name], settings) for name in real}
            f1["simulated"] = difference(study, simulated, settings)
            rows.append({"setting": key, "default": value, "value": other, "f1": f1})
    return {"rows": rows}


def ablation_table(results, titles, simulated):
    """Over the real scans, or the simulated ones."""
    names = [name for name, scans in titles.items() if scans["simulated"] == simulated]
    whole = ["F1 of the whole method", "", *(with_interval(results["whole"][name]) for name in names)]
    rows = [
        [
            row["part"],
            " ".join(f"`{setting}`" for setting in row["settings"]),
            *(percentage_points(row["f1"][name]) for name in names),
        ]
        for row in results["rows"]
    ]
    head = ["without", "that is", *(titles[name]["title"] for name in names)]
    return table(head, [whole, *rows], left=2)


def effects_table(results, titles):
    names = [*(name for name, scans in titles.items() if not scans["simulated"]), "simulated"]
    rows = [
        [
            f"`{row['setting']}`",
            f"{row['default']:g} → {row['value']:g}",
            *(percentage_points(row["f1"][name]) for name in names),
        ]
        for row in results["rows"]
    ]
    head = ["setting", "changed", *(titles[name]["title"] for name in names[:-1]), "simulated"]
    return table(head, rows, left=2)


# --- accuracy beside `patchwork` and the baselines, by range and by area; heights -----------------------------

COMPARED_METHODS = ["surface", "patchwork", "ransac", "gpf", "line_fit", "cascaded", "r_gpf", "r_gpf+u"]
BANDS = ["0–10 m", "10–20 m", "20–40 m", "40–80 m"]
HEIGHT_BANDS = [(0, 20), (20, 40), (40, 80)]


def measure_accuracy(study):
    """By set of scans: `methods`, and by how much `surface` exceeds `patchwork`."""
    found = {}
    for name in study.sets:
        show_progress(f"accuracy {len(found) + 1} of {len(study.sets)}: {name}")
        results = study.evaluate(name, COMPARED_METHODS)
        found[name] = {
            "commands": [result["command"] for result in results],
            "methods": [method_row(results, method) for method in COMPARED_METHODS],
            "over_patchwork": over_patchwork(results),
        }
    return found


def method_row(results, method):
    entries = [entry for result in results for entry in result["methods"] if entry["name"] == method]
    scans = per_scan(results, method)["per_scan"]
    return {
        "name": method,
        **{figure: mean_of([scan[figure] for scan in scans]) for figure in ("precision", "recall", "f1", "iou")},
        # Pooled over the scans that were evaluated together, then the mean.
        "by_range": [mean_if_any([entry["by_range"][band]["f1"] for entry in entries]) for band in range(len(BANDS))],
        "by_area": mean_if_any([entry["by_area"]["f1"] for entry in entries]),
    }


def mean_if_any(values):
    known = [value for value in values if value is not None]
    return statistics.fmean(known) if known else None


def over_patchwork(results):
    ours, theirs = (per_scan(results, method) for method in ("surface", "patchwork"))
    f1 = {scan["scan"]: scan["f1"] for scan in theirs["per_scan"]}
    return {
        **{figure: paired(ours, theirs, figure) for figure in ("precision", "recall", "f1")},
        "better": sum(scan["f1"] > f1[scan["scan"]] for scan in ours["per_scan"]),
    }


def measure_heights(study):
    """By simulated scene: errors of heights, of points of the ground and of all."""
    found = {}
    for name, scans in study.sets.items():
        if not scans.simulated:
            continue
        show_progress(f"heights of {name}")
        result = study.evaluate(name)[0]
        heights = result["methods"][0]["heights"]
        found[name] = {
            "command": result["command"],
            "ground": heights["ground"],
            "everywhere": heights["everywhere"],
        }
    return found


def accuracy_tables(results, titles):
    """One table a set of scans, and the differences to `patchwork` over all of them."""
    found = {}
    for name, title in titles.items():
        found[f"accuracy-{name}"] = accuracy_table(results[name], title["title"], results["made_by"])
    found["over-patchwork"] = over_patchwork_table(results, titles)
    return found


def accuracy_table(result, title, made_by):
    best = max(method["f1"]["mean"] for method in result["methods"])
    rows = [
        [
            f"`{method['name']}`",
            percent(method["precision"]["mean"]),
            percent(method["recall"]["mean"]),
            bold_if(method["f1"]["mean"] == best, with_interval(method["f1"])),
            percent(method["iou"]["mean"]),
            *(percent(band) for band in method["by_range"]),
            percent(method["by_area"]),
        ]
        for method in result["methods"]
    ]
    head = [title, "P", "R", "F1 ± 95 %", "IoU", *BANDS, "by area"]
    commands = "\n".join(f"    {command}" for command in result["commands"])
    scans = result["over_patchwork"]["f1"]["scans"]
    return f"{table(head, rows)}\n\n{scans} scans, {made_by['date']}, {made_by['machine']}:\n\n{commands}"


def bold_if(condition, text):
    return f"**{text}**" if condition else text


def over_patchwork_table(results, titles):
    rows = []
    for name, title in titles.items():
        over = results[name]["over_patchwork"]
        rows.append(
            [
                title["title"],
                *(percentage_points(over[figure]) for figure in ("precision", "recall", "f1")),
                f"{over['better']} of {over['f1']['scans']}",
            ]
        )
    return table(["`surface` less `patchwork`, points", "P", "R", "F1", "F1 better in"], rows)


def heights_table(results, titles, points):
    """Of points of the `ground`, or `everywhere`."""
    rows = []
    for name, title in titles.items():
        if not title["simulated"]:
            continue
        heights = results[name][points]
        bands = {(band["from"], band["to"]): band for band in heights["by_range"]}
        rows.append(
            [
                title["title"],
                *(
                    centimetres(bands[band][figure]["mean"])
                    for band in HEIGHT_BANDS
                    for figure in ("median", "percentile95", "bias")
                ),
                percent(heights["with_height"], 1),
            ]
        )
    head = [
        "cm",
        *(text for low, high in HEIGHT_BANDS for text in (f"{low}–{high} m: median", "95 %", "bias")),
        "with a height, %",
    ]
    return table(head, rows)


def centimetres(metres):
    return "–" if metres is None else f"{100 * metres:.1f}"


# --- which points `surface` gets wrong: their classes, and how high they truly lie above the ground -----------

MOST_CLASSES = 5  # named of each kind of error

# Bands of true height above the ground, metres: upper ends.
TRUE_HEIGHT_BANDS = (-0.1, 0.05, 0.1, 0.15, 0.2, 0.3)


def scans_by_set(study):
    """Set -> (what `flagstone segment` takes, where the labels are, classes.json)."""
    real = pathlib.Path(study.directories["$FLAGSTONE_DATA"])
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
            [f"$WORK/livox/{name}/velodyne --sensor-height {height}" for name, height in LIVOX_HEIGHTS.items()],
            [study.work / "livox" / name / "labels" / f"{name}.label" for name in LIVOX_HEIGHTS],
        ),
    }
    return {name: (*found, json.loads((real / name / "classes.json").read_text())) for name, found in sets.items()}


def measure_errors(study):
    """By real set: wrong points by class, as shares of the true ground points; vegetation of KITTI is not scored."""
    found = {}
    for name, (inputs, label_files, classes) in scans_by_set(study).items():
        show_progress(f"errors on {name}")
        ignored = {*classes["ignored"], *([70] if name == "kitti" else [])}
        with tempfile.TemporaryDirectory(prefix="flagstone-errors-") as place:
            for arguments in inputs:
                study.call(f"flagstone segment {arguments} --method surface{set_options(study)} --output {place}")
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
            "classes": {names.get(str(number), str(number)): count / ground_points for number, count in ranked},
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
        bands = np.zeros(len(TRUE_HEIGHT_BANDS) + 1)
        ground_points = missed = 0
        with tempfile.TemporaryDirectory(prefix="flagstone-errors-") as place:
            files = " ".join(f"$WORK/simulated/sequences/{number:02}/velodyne/{scan.name}" for scan in scans)
            study.call(f"flagstone segment {files} --method surface{set_options(study)} --output {place}")
            for scan in scans:
                height = np.fromfile(scan, "<f4").reshape(-1, 4)[:, 2]
                height = height - np.load(folder / "ground" / f"{scan.stem}.ground.npy")
                truth = np.fromfile(folder / "labels" / f"{scan.stem}.label", "<u4")
                ours = np.fromfile(pathlib.Path(place) / f"{scan.stem}.label", "<u4") == 1
                is_ground = np.isin(truth & 0xFFFF, (40, 44, 48, 49, 60, 72))
                taken = ours & ~is_ground & np.isfinite(height)
                bands += np.bincount(np.searchsorted(TRUE_HEIGHT_BANDS, height[taken]), minlength=len(bands))
                ground_points += int(is_ground.sum())
                missed += int((is_ground & ~ours).sum())
        found[scene] = {"taken": (bands / ground_points).tolist(), "missed": missed / ground_points}
    return found


def errors_table(results, titles):
    rows = []
    for name, title in titles.items():
        kinds = [results[name][kind] for kind in ("taken", "missed")]
        rows.append([title, *(text for kind in kinds for text in (percent(kind["all"]), class_list(kind["classes"])))])
    head = ["% of ground points", "taken for ground", "of these", "missed", "of these"]
    return table(head, rows)


def class_list(shares):
    return ", ".join(f"{name} {percent(share)}" for name, share in shares.items())


def true_heights_table(results):
    ends = [f"{100 * end:.0f}" for end in TRUE_HEIGHT_BANDS]
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


# --- what a sensor that stands otherwise, or sees less than the methods are told, costs -----------------------

# Every disturbed copy of a scan is scored beside the labels that the same method gave to the same points of the
# whole, undisturbed scan: what differs is due to the disturbance, not to which points are left.

DISTURBED_METHODS = ("surface", "patchwork")


def measure_robustness(study):
    # Not above: tables are written and checked without NumPy.
    from surface_disturbances import DISTURBANCES, HEIGHT, write_copies

    with tempfile.TemporaryDirectory(prefix="flagstone-robustness-") as place:
        place = pathlib.Path(place)
        for method in DISTURBED_METHODS:
            settings = "".join(f" --set {setting}" for setting in study.settings if method == "surface")
            study.call(
                f"flagstone segment $WORK/kitti/velodyne --method {method} --sensor-height {HEIGHT}{settings}"
                f" --output {place}/before/{method}"
            )
        rows = []
        for number, disturbance in enumerate(DISTURBANCES):
            show_progress(f"robustness {number + 1} of {len(DISTURBANCES)}: {disturbance.name}")
            folder = place / f"disturbed-{number}"
            write_copies(study.work / "kitti", place / "before", DISTURBED_METHODS, disturbance.disturb, folder)
            arguments = f"{folder} --protocol patchwork++ --sensor-height {disturbance.sensor_height:g}"
            arguments += "".join(f" --labels before-{method}={folder / method}" for method in DISTURBED_METHODS)
            result = study.evaluate_command(study.command(arguments, DISTURBED_METHODS))
            rows.append({"disturbance": disturbance.name, **row_of(result)})
    return {"rows": rows}


def row_of(result):
    """By method: F1 and by how much it differs from that of the undisturbed scan."""
    methods = {method["name"]: method for method in result["methods"]}
    row = {}
    for method in DISTURBED_METHODS:
        now, before = methods[method], methods[f"before-{method}"]
        differences = {scan["scan"]: scan["f1"] for scan in now["per_scan"]}
        for scan in before["per_scan"]:
            differences[scan["scan"]] -= scan["f1"]
        row[method] = {
            "f1": mean_of([scan["f1"] for scan in now["per_scan"]]),
            "difference": paired(now, before, "f1"),
            "worst": min(differences.values()),
        }
    return row


def robustness_table(results):
    rows = [
        [
            row["disturbance"],
            *(
                text
                for method in DISTURBED_METHODS
                for text in (
                    percent(row[method]["f1"]["mean"]),
                    percentage_points(row[method]["difference"]),
                    f"{round(100 * row[method]['worst'], 2) + 0.0:+.2f}",
                )
            ),
        ]
        for row in results["rows"]
    ]
    head = [
        "disturbed",
        *(text for method in DISTURBED_METHODS for text in (f"`{method}`: F1", "change", "worst scan")),
    ]
    return table(head, rows)


# --- the study ------------------------------------------------------------------------------------------------

# What is measured, by name: makes results that JSON can hold.
MEASUREMENTS = {
    "ablation": measure_ablation,
    "settings": measure_settings,
    "accuracy": measure_accuracy,
    "heights": measure_heights,
    "errors": measure_errors,
    "true_heights": measure_true_heights,
    "robustness": measure_robustness,
}
ON_REAL_SCANS_ALONE = {"errors", "robustness"}


def tables(results):
    """Every table of what was measured, by name."""
    sets = results["sets"]
    found = {}
    if "ablation" in results:
        found["ablation-real"] = ablation_table(results["ablation"], sets, simulated=False)
        found["ablation-simulated"] = ablation_table(results["ablation"], sets, simulated=True)
    if "settings" in results:
        found["settings-effect"] = effects_table(results["settings"], sets)
    if "accuracy" in results:
        found |= accuracy_tables(results["accuracy"], sets)
    if "heights" in results:
        for points in ("ground", "everywhere"):
            found[f"heights-{points}"] = heights_table(results["heights"], sets, points)
    if "errors" in results:
        titles = {"kitti": "KITTI `patchwork++`", "nuscenes": "nuScenes", "livox": "Livox"}
        found["errors"] = errors_table(results["errors"], titles)
    if "true_heights" in results:
        found["true-heights"] = true_heights_table(results["true_heights"])
    if "robustness" in results:
        found["robustness"] = robustness_table(results["robustness"])
    return found


def measure(options):
    """Results by name, and of which sets of scans."""
    study = Study(options.work, options.flagstone, getattr(options, "set", ()))
    names = options.only
    if set(names) - ON_REAL_SCANS_ALONE:
        study.simulate()
    results = {
        "sets": {
            name: {"title": scans.title, "simulated": scans.simulated, "arguments": list(scans.arguments)}
            for name, scans in study.sets.items()
        }
    }
    for name in names:
        results[name] = {**rounded(MEASUREMENTS[name](study)), "made_by": dict(study.made_by)}
    return results


def changed_defaults(results, flagstone):
    """Settings of `surface` whose defaults are not those that were measured."""
    with tempfile.TemporaryDirectory(prefix="flagstone-defaults-") as place:
        defaults = surface_settings(Runs(pathlib.Path(place), flagstone))
    measured = {row["setting"]: row["default"] for row in results["settings"]["rows"]}
    return [
        f"{key} is {defaults.get(key, 'unknown')}, measured with {measured.get(key)}"
        for key in {**defaults, **measured}
        if defaults.get(key) != measured.get(key)
    ]


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, MEASUREMENTS, can_try=True, verify=changed_defaults)
