# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures the method `surface` and writes the tables of docs/benchmarks/accuracy.md and robustness.md.

    python3 bench/surface_study.py run --work /tmp/study                    # all of it, about ten minutes
    python3 bench/surface_study.py run --work /tmp/study --only robustness  # one part; the other results are kept
    python3 bench/surface_study.py try --work /tmp/study --only ablation --set point.margin=0.15
    python3 bench/surface_study.py page                                     # the tables, from docs/results/surface.json
    python3 bench/surface_study.py check                                    # do the tables match the results?

`run` needs Python 3.11, NumPy, the command (build/flagstone) and the real scans in FLAGSTONE_DATA. It simulates six
sequences of 200 scans in the work directory (4 GB, some minutes), or reuses those that are there. `try` prints tables
and writes nothing; the settings of --set apply to every row, including the rows for unchanged settings.
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


# --- scan sets, and `flagstone eval` on them ------------------------------------------------------------------

SCENES = ["flat_street", "steep_street", "parked_cars", "bushes_and_lawn", "bumpy_field", "steps"]

# SemanticKITTI scans with all their points. The other scans of that directory are voxel means.
FULL_KITTI = [*(f"00-{frame:06}" for frame in (0, 1, 2, 5, 10, 15)), "08-000000", "08-000536"]
LIVOX_HEIGHTS = {"01-000000": 1.2, "04-000000": 1.8, "10-000000": 1.1}


class Scans(typing.NamedTuple):
    """A set of scans. `arguments` are those of `flagstone eval`, one entry for each sensor height in the set."""

    title: str
    arguments: tuple
    simulated: bool


def scan_sets(work):
    """The scan sets by name. Creates directories of links to real scans in the work directory."""
    data = pathlib.Path(os.environ.get("FLAGSTONE_DATA", ROOT.parent / "shared" / "data"))
    if not (data / "kitti").is_dir():
        sys.exit(f"{data}: no directory kitti/ in it (set FLAGSTONE_DATA to the directory of real scans)")
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
        # The first scan of each simulated run: every scan is from a different scene instance.
        arguments = f"$WORK/simulated --sequences {number:02} --every 10 --sensor-height 1.73 --protocol simulation"
        sets[scene] = Scans(scene.replace("_", " "), (arguments,), True)
    return sets


def link_scans(data, names, directory):
    """Creates a directory with velodyne/ and labels/ that contain links to some of the scans in `data`."""
    for kind, extension in (("velodyne", "bin"), ("labels", "label")):
        (directory / kind).mkdir(parents=True, exist_ok=True)
        for name in names:
            link = directory / kind / f"{name}.{extension}"
            target = data / kind / f"{name}.{extension}"
            if link.is_symlink():
                link.unlink()
            link.symlink_to(target.resolve())


class Study(Runs):
    """Scan sets, settings of `surface` that apply to every evaluation, and the evaluations done so far."""

    def __init__(self, work, flagstone, settings=()):
        super().__init__(work, flagstone)
        self.settings = tuple(settings)  # KEY=VALUE
        self.known = {}
        self.sets = scan_sets(work)

    def simulate(self, frames=200):
        """Writes the simulated sequences. Existing scans are kept."""
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
        """The results of a set, one for each entry of its `arguments`. `settings` are settings of `surface`."""
        commands = [self.command(arguments, methods, settings) for arguments in self.sets[name].arguments]
        for command in commands:
            if command not in self.known:
                self.known[command] = self.evaluate_command(command)
        return [self.known[command] for command in commands]

    def surface_defaults(self):
        """The settings of `surface` that apply to every evaluation."""
        return surface_settings(self, "".join(f" --set {setting}" for setting in self.settings))


def surface_settings(runs, options=""):
    """The settings of `surface` except the sensor height, by key."""
    import tomllib  # needs Python 3.11, which `page` and `check` do not need

    text = runs.call(f"flagstone config --method surface{options}")
    text = text.partition("\n[mount]")[0]  # the mounting pose is not a setting of a method
    values = flat(tomllib.loads(text))
    values.pop("sensor_height")
    return values


def flat(values, prefix=""):
    """Flattens a dictionary: {"a": {"b": 1}} becomes {"a.b": 1}."""
    found = {}
    for key, value in values.items():
        found.update(flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value})
    return found


def per_scan(results, method):
    """All scans of one method in the results of a set."""
    return {
        "per_scan": [
            scan
            for result in results
            for entry in result["methods"]
            if entry["name"] == method
            for scan in entry["per_scan"]
        ]
    }


# --- ablation and sensitivity to settings ---------------------------------------------------------------------

# Parts of the method and the settings that disable them. {point.margin} is replaced by the value of that setting.
REMOVALS = [
    ("uprightness: patches up to 60° steep", ["acceptance.upright_angle=30"]),
    ("clutter ratio of patches", ["acceptance.max_clutter_ratio=inf"]),
    ("height limit", ["acceptance.max_height=1000"]),
    ("consistency with nearer patches", ["acceptance.max_step=inf"]),
    ("all refinement: the coarse surface alone", ["refinement.levels=0"]),
    ("cells of 1 m and smaller", ["refinement.levels=1"]),
    ("cells of 0.5 m and smaller", ["refinement.levels=2"]),
    ("cells of 0.25 m", ["refinement.levels=3"]),
    ("clutter ratio of cells", ["refinement.max_clutter_ratio=inf"]),
    ("lower bound", ["refinement.lower_bound_weight=0"]),
    ("narrower gates on finer levels", ["refinement.gate_factor=1"]),
    ("smaller margin at obstacles", ["point.obstacle_margin={point.margin}"]),
    ("wider margin elsewhere", ["point.margin={point.obstacle_margin}"]),
    ("noise below the surface", ["point.noise_depth=1000"]),
]

# Settings are halved and doubled, except these, which take the values listed.
OTHER_VALUES = {
    "max_range": (50, 80),
    "acceptance.upright_angle": (40, 60),
    "refinement.levels": (2, 3),
    "refinement.gate_factor": (0.5, 0.8),
}


def difference(study, names, settings):
    """F1 with `settings` minus F1 without, over the scans of some sets."""
    changed = [result for name in names for result in study.evaluate(name, settings=settings)]
    before = [result for name in names for result in study.evaluate(name)]
    return paired(per_scan(changed, "surface"), per_scan(before, "surface"), "f1")


def level_of(study, name):
    """Mean F1 of a set."""
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
    """The ablation on the real or the simulated scans."""
    names = [name for name, scans in titles.items() if scans["simulated"] == simulated]
    whole = ["nothing: F1 of the full method", "", *(with_interval(results["whole"][name]) for name in names)]
    rows = [
        [
            row["part"],
            " ".join(f"`{setting}`" for setting in row["settings"]),
            *(percentage_points(row["f1"][name]) for name in names),
        ]
        for row in results["rows"]
    ]
    head = ["removed part", "setting", *(titles[name]["title"] for name in names)]
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
    head = ["setting", "change", *(titles[name]["title"] for name in names[:-1]), "simulated"]
    return table(head, rows, left=2)


# --- accuracy compared with `patchwork` and the baselines, by range and per BEV cell; heights -------------------

COMPARED_METHODS = ["surface", "patchwork", "ransac", "gpf", "line_fit", "cascaded", "r_gpf", "r_gpf+u"]
BANDS = ["0–10 m", "10–20 m", "20–40 m", "40–80 m"]
HEIGHT_BANDS = [(0, 20), (20, 40), (40, 80)]


def measure_accuracy(study):
    """For each scan set: the metrics of all methods, and `surface` minus `patchwork`."""
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
        **{metric: mean_of([scan[metric] for scan in scans]) for metric in ("precision", "recall", "f1", "iou")},
        # Micro-average over the scans that were evaluated together, then the mean.
        "by_range": [mean_if_any([entry["by_range"][band]["f1"] for entry in entries]) for band in range(len(BANDS))],
        "by_area": mean_if_any([entry["by_area"]["f1"] for entry in entries]),
    }


def mean_if_any(values):
    known = [value for value in values if value is not None]
    return statistics.fmean(known) if known else None


def over_patchwork(results):
    surface, patchwork = (per_scan(results, method) for method in ("surface", "patchwork"))
    f1 = {scan["scan"]: scan["f1"] for scan in patchwork["per_scan"]}
    return {
        **{metric: paired(surface, patchwork, metric) for metric in ("precision", "recall", "f1")},
        "better": sum(scan["f1"] > f1[scan["scan"]] for scan in surface["per_scan"]),
    }


def measure_heights(study):
    """For each simulated scene: height errors of ground points and of all points."""
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
    """One table for each scan set, and the differences from `patchwork` on all sets."""
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
    head = [title, "P", "R", "F1 ± 95 %", "IoU", *BANDS, "BEV cells"]
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
                *(percentage_points(over[metric]) for metric in ("precision", "recall", "f1")),
                f"{over['better']} of {over['f1']['scans']}",
            ]
        )
    return table(["`surface` minus `patchwork`", "P", "R", "F1", "scans with higher F1"], rows)


def heights_table(results, titles, points):
    """Height errors. `points` is `ground` (ground points only) or `everywhere`."""
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
                    centimetres(bands[band][metric]["mean"])
                    for band in HEIGHT_BANDS
                    for metric in ("median", "percentile95", "bias")
                ),
                percent(heights["with_height"], 1),
            ]
        )
    head = [
        "height error, cm",
        *(text for low, high in HEIGHT_BANDS for text in (f"{low}–{high} m: median", "95 %", "bias")),
        "points with a height, %",
    ]
    return table(head, rows)


def centimetres(metres):
    return "–" if metres is None else f"{100 * metres:.1f}"


# --- wrong points by class and by true height -----------------------------------------------------------------

MAX_CLASSES = 5  # listed for each kind of error

# Upper limits of the bands of true height above the ground, metres.
TRUE_HEIGHT_BANDS = (-0.1, 0.05, 0.1, 0.15, 0.2, 0.3)


def scans_by_set(study):
    """By set: arguments of `flagstone segment`, label files, contents of classes.json."""
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
    """For each real set: wrong points by class, as fractions of the ground points. KITTI's vegetation is not scored."""
    found = {}
    for name, (inputs, label_files, classes) in scans_by_set(study).items():
        show_progress(f"errors on {name}")
        ignored = {*classes["ignored"], *([70] if name == "kitti" else [])}
        with tempfile.TemporaryDirectory(prefix="flagstone-errors-") as directory:
            for arguments in inputs:
                study.call(f"flagstone segment {arguments} --method surface{set_options(study)} --output {directory}")
            found[name] = errors_by_class(pathlib.Path(directory), label_files, classes, ignored)
    return found


def set_options(study):
    return "".join(f" --set {setting}" for setting in study.settings)


def errors_by_class(directory, label_files, classes, ignored):
    import numpy as np

    wrong, missed, ground_points = {}, {}, 0
    for file in label_files:
        name = file.name.removesuffix("_lidarseg.bin").removesuffix(".label")
        is_bytes = file.name.endswith("_lidarseg.bin")
        truth = np.fromfile(file, "u1" if is_bytes else "<u4").astype(np.uint32) & 0xFFFF
        ours = np.fromfile(directory / f"{name}.label", "<u4") == 1
        is_ground = np.isin(truth, classes["ground"])
        scored = ~np.isin(truth, list(ignored))
        ground_points += int(is_ground.sum())
        for counts, chosen in ((wrong, ours & ~is_ground & scored), (missed, ~ours & is_ground)):
            for number, count in zip(*np.unique(truth[chosen], return_counts=True)):
                counts[int(number)] = counts.get(int(number), 0) + int(count)

    def fractions(counts):
        names = classes["names"]
        ranked = sorted(counts.items(), key=lambda entry: -entry[1])[:MAX_CLASSES]
        return {
            "all": sum(counts.values()) / ground_points,
            "classes": {names.get(str(number), str(number)): count / ground_points for number, count in ranked},
        }

    return {"taken": fractions(wrong), "missed": fractions(missed), "ground_points": ground_points}


def measure_true_heights(study):
    """For each simulated scene: false ground points by true height, as fractions of the ground points."""
    import numpy as np

    found = {}
    for number, scene in enumerate(SCENES):
        show_progress(f"errors by height, {scene}")
        sequence = study.work / "simulated" / "sequences" / f"{number:02}"
        scans = sorted((sequence / "velodyne").glob("*0.bin"))  # the first of each simulated run
        bands = np.zeros(len(TRUE_HEIGHT_BANDS) + 1)
        ground_points = missed = 0
        with tempfile.TemporaryDirectory(prefix="flagstone-errors-") as directory:
            files = " ".join(f"$WORK/simulated/sequences/{number:02}/velodyne/{scan.name}" for scan in scans)
            study.call(f"flagstone segment {files} --method surface{set_options(study)} --output {directory}")
            for scan in scans:
                height = np.fromfile(scan, "<f4").reshape(-1, 4)[:, 2]
                height = height - np.load(sequence / "ground" / f"{scan.stem}.ground.npy")
                truth = np.fromfile(sequence / "labels" / f"{scan.stem}.label", "<u4")
                labelled = np.fromfile(pathlib.Path(directory) / f"{scan.stem}.label", "<u4") == 1
                is_ground = np.isin(truth & 0xFFFF, (40, 44, 48, 49, 60, 72))
                taken = labelled & ~is_ground & np.isfinite(height)
                bands += np.bincount(np.searchsorted(TRUE_HEIGHT_BANDS, height[taken]), minlength=len(bands))
                ground_points += int(is_ground.sum())
                missed += int((is_ground & ~labelled).sum())
        found[scene] = {"taken": (bands / ground_points).tolist(), "missed": missed / ground_points}
    return found


def errors_table(results, titles):
    rows = []
    for name, title in titles.items():
        kinds = [results[name][kind] for kind in ("taken", "missed")]
        rows.append([title, *(text for kind in kinds for text in (percent(kind["all"]), class_list(kind["classes"])))])
    head = ["% of ground points", "false ground", "by class", "missed ground", "by class"]
    return table(head, rows)


def class_list(fractions):
    return ", ".join(f"{name} {percent(fraction)}" for name, fraction in fractions.items())


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
    return table(["% of ground points", "false ground", *bands, "missed ground"], rows)


# --- robustness: perturbed scans -------------------------------------------------------------------------------

# Each perturbed copy of a scan is compared with the labels that the same method gave to the same points of the
# unperturbed scan. The differences are therefore due to the perturbation, not to the selection of points.

PERTURBED_METHODS = ("surface", "patchwork")


def measure_robustness(study):
    # Imports NumPy, which `page` and `check` do not need.
    from surface_perturbations import HEIGHT, PERTURBATIONS, write_copies

    with tempfile.TemporaryDirectory(prefix="flagstone-robustness-") as directory:
        directory = pathlib.Path(directory)
        for method in PERTURBED_METHODS:
            settings = "".join(f" --set {setting}" for setting in study.settings if method == "surface")
            study.call(
                f"flagstone segment $WORK/kitti/velodyne --method {method} --sensor-height {HEIGHT}{settings}"
                f" --output {directory}/before/{method}"
            )
        rows = []
        for number, perturbation in enumerate(PERTURBATIONS):
            show_progress(f"robustness {number + 1} of {len(PERTURBATIONS)}: {perturbation.name}")
            copies = directory / f"perturbed-{number}"
            write_copies(study.work / "kitti", directory / "before", PERTURBED_METHODS, perturbation.perturb, copies)
            arguments = f"{copies} --protocol patchwork++ --sensor-height {perturbation.sensor_height:g}"
            arguments += "".join(f" --labels before-{method}={copies / method}" for method in PERTURBED_METHODS)
            result = study.evaluate_command(study.command(arguments, PERTURBED_METHODS))
            rows.append({"perturbation": perturbation.name, **row_of(result)})
    return {"rows": rows}


def row_of(result):
    """For each method: F1, and its difference from the F1 of the unperturbed scan."""
    methods = {method["name"]: method for method in result["methods"]}
    row = {}
    for method in PERTURBED_METHODS:
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
            row["perturbation"],
            *(
                text
                for method in PERTURBED_METHODS
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
        "perturbation",
        *(text for method in PERTURBED_METHODS for text in (f"`{method}`: F1", "change", "worst scan")),
    ]
    return table(head, rows)


# --- the study ------------------------------------------------------------------------------------------------

# Functions that return results that can be written as JSON.
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
    """All tables of the results, by name."""
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
    """Results by name, and the scan sets."""
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
    """Settings of `surface` whose defaults have changed since the results were measured."""
    with tempfile.TemporaryDirectory(prefix="flagstone-defaults-") as directory:
        defaults = surface_settings(Runs(pathlib.Path(directory), flagstone))
    measured = {row["setting"]: row["default"] for row in results["settings"]["rows"]}
    return [
        f"{key} is {defaults.get(key, 'unknown')}, measured with {measured.get(key)}"
        for key in {**defaults, **measured}
        if defaults.get(key) != measured.get(key)
    ]


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, MEASUREMENTS, can_try=True, verify=changed_defaults)
