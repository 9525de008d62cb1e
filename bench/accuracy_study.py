# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures presets, derived settings, and estimated height and tilt: tables of docs/benchmarks/accuracy.md.

    python3 bench/accuracy_study.py run --work /tmp/study                # all of it, about five minutes
    python3 bench/accuracy_study.py run --work /tmp/study --only mount   # one part; the other results are kept
    python3 bench/accuracy_study.py page                                 # the tables, from docs/results/accuracy.json
    python3 bench/accuracy_study.py check                                # do the tables match the results?

`run` needs the command (build/flagstone), NumPy and the real scans in FLAGSTONE_DATA. It uses the simulated sequences
of surface_study.py in the same work directory, or simulates them. `presets` also scores the package pypatchworkpp if it
is installed.
"""

import importlib.util
import math
import pathlib
import sys
import tempfile

from study import ROOT, main, mean_of, percent, rounded, show_progress, table
from surface_study import LIVOX_HEIGHTS, SCENES, Study, per_scan

PAGES = (ROOT / "docs" / "benchmarks" / "accuracy.md",)
RESULTS = ROOT / "docs" / "results" / "accuracy.json"
METHODS = ("surface", "patchwork")


class Sets:
    """The scan sets of surface_study.py, with the three Livox scans as separate sets if `livox_apart`."""

    def __init__(self, study, livox_apart):
        self.arguments = {}  # set -> [(scans, options)]
        self.titles = {}
        for name, scans in study.sets.items():
            parts = [tuple(arguments.split(" ", 1)) for arguments in scans.arguments]
            if name == "livox" and livox_apart:
                for scan, part in zip(LIVOX_HEIGHTS, parts, strict=True):
                    self.arguments[f"livox-{scan[:2]}"] = [part]
                    self.titles[f"livox-{scan[:2]}"] = f"Livox {scan[:2]}"
            else:
                self.arguments[name] = parts
                self.titles[name] = scans.title


def evaluate(study, parts, options, methods=METHODS):
    """Mean precision, recall and F1 by method; `parts` are pairs of scans and their options."""
    commands = [f"flagstone eval {scans} {own}{options} --methods {','.join(methods)}" for scans, own in parts]
    results = [study.evaluate_command(command) for command in commands]
    return {method: means(results, method) for method in methods}, commands


def means(results, method):
    scans = per_scan(results, method)["per_scan"]
    # Without any point labelled ground, precision and F1 are undefined; they count as 0.
    return {
        metric: mean_of([scan[metric] or 0.0 for scan in scans])["mean"] for metric in ("precision", "recall", "f1")
    }


# --- presets of Patchwork on real scans -----------------------------------------------------------------------

PRESETS = ("default", "reference", "paper")
PACKAGE = "pypatchworkpp"
CLASSES = ("patchwork", "patchworkpp")


def measure_presets(study):
    sets = Sets(study, livox_apart=False)
    names = [name for name, scans in study.sets.items() if not scans.simulated]
    rows, commands = [], []
    for preset in PRESETS:
        found = {}
        for name in names:
            show_progress(f"preset {preset}: {name}")
            by_method, used = evaluate(study, sets.arguments[name], f" --preset {preset}", ["patchwork"])
            found[name] = by_method["patchwork"]
            commands += used if preset == PRESETS[0] else []
        rows.append({"title": f"preset `{preset}`", "sets": found})
    if importlib.util.find_spec(PACKAGE):
        rows += rows_of_package(study, sets)
    return {"titles": {name: sets.titles[name] for name in names}, "rows": rows, "commands": commands}


def rows_of_package(study, sets):
    labels = [f"{PACKAGE}-{name}" for name in CLASSES]
    study.call(
        f"{sys.executable} bench/external_tools.py $WORK/kitti --output $WORK/external --tools {','.join(labels)}"
    )
    rows = [{"title": f"{PACKAGE} 1.4.1, class `{name}`", "sets": {}} for name in CLASSES]
    for name in ("kitti/patchwork", "kitti/patchwork++"):
        scans, own = sets.arguments[name][0]
        options = " ".join(f"--labels {label}=$WORK/external/{label}" for label in labels)
        result = study.evaluate_command(f"flagstone eval {scans} {own} --methods none {options}")
        for row, label in zip(rows, labels, strict=True):
            row["sets"][name] = means([result], label)
    return rows


def presets_table(results):
    rows = [
        [
            row["title"],
            *(
                " / ".join(percent(row["sets"][name][metric]) for metric in ("precision", "recall", "f1"))
                if name in row["sets"]
                else ""
                for name in results["titles"]
            ),
        ]
        for row in results["rows"]
    ]
    head = ["P / R / F1, %", *results["titles"].values()]
    return with_commands(table(head, rows), results, "For each preset:")


def with_commands(text, results, title):
    made_by = results["made_by"]
    commands = "\n".join(f"    {command}" for command in results["commands"])
    return f"{text}\n\n{made_by['date']}, {made_by['machine']}. {title}\n\n{commands}"


# --- settings derived from a sensor ---------------------------------------------------------------------------

SENSOR_HEIGHTS = [
    ("hdl-64e", 1.73),
    ("hdl-64e", 3.0),
    ("hdl-32e", 1.84),
    ("vlp-16", 0.6),
    ("vlp-16", 1.8),
    ("pandar64", 1.9),
    ("os0-128", 0.9),
    ("os0-128", 0.4),
    ("os1-64", 1.8),
    ("livox-avia", 1.5),
    ("at128", 2.6),
]
SEEDS = (1, 2, 3)
REAL_SENSORS = {
    "kitti/patchwork": "hdl-64e",
    "kitti/patchwork++": "hdl-64e",
    "nuscenes": "hdl-32e",
    **{f"livox-{scan[:2]}": "livox-avia" for scan in LIVOX_HEIGHTS},
}


def measure_sensors(study):
    simulated = []
    for sensor, height in SENSOR_HEIGHTS:
        folder = f"$WORK/sensors/{sensor}-{height:g}"
        for number, scene in enumerate(SCENES):
            show_progress(f"sensor {sensor}, {height:g} m: {scene}")
            for seed in SEEDS:
                study.call(
                    f"flagstone simulate --scene {scene} --sensor {sensor} --sensor-height {height:g} --frames 1"
                    f" --seed {seed} --sequence {number}{seed} --output {folder}"
                )
        simulated.append(sensor_row(study, sensor, [(folder, f"--protocol simulation --sensor-height {height:g}")]))
        simulated[-1] |= {"title": f"`{sensor}`", "height": height}
    sets = Sets(study, livox_apart=True)
    real = []
    for name, sensor in REAL_SENSORS.items():
        show_progress(f"sensor {sensor}: {name}")
        real.append({"title": sets.titles[name], "sensor": sensor, **sensor_row(study, sensor, sets.arguments[name])})
    return {"simulated": simulated, "real": real}


def sensor_row(study, sensor, parts):
    row = {}
    for name, options in (("given", ""), ("derived", f" --sensor {sensor}")):
        found, commands = evaluate(study, parts, options)
        row[name] = {method: found[method]["f1"] for method in METHODS}
        row["command"] = commands[0]
    return row


def sensor_cells(row):
    return [percent(row[name][method]) for method in reversed(METHODS) for name in ("given", "derived")]


SENSOR_HEAD = ["`patchwork`, default", "`patchwork`, derived", "`surface`, default", "`surface`, derived"]


def sensors_tables(results):
    simulated = [[row["title"], f"{row['height']:g} m", *sensor_cells(row)] for row in results["simulated"]]
    real = [[row["title"], f"`{row['sensor']}`", *sensor_cells(row)] for row in results["real"]]
    made_by = f"{results['made_by']['date']}, {results['made_by']['machine']}"
    last = results["simulated"][-1]["command"]
    return {
        "sensors-simulated": table(["F1, %: sensor", "height", *SENSOR_HEAD], simulated)
        + f"\n\n{made_by}. Command for the last row, derived settings:\n\n    {last}",
        "sensors-real": table(["F1, %: scans", "sensor", *SENSOR_HEAD], real, left=2)
        + f"\n\n{made_by}. Command for the last row, derived settings:\n\n    {results['real'][-1]['command']}",
    }


# --- height and tilt: known, estimated, wrong -----------------------------------------------------------------

PITCH = -20  # degrees about the y axis: the ground in front appears to rise
WRONG_BY = 0.5  # metres


def measure_mount(study):
    sets = Sets(study, livox_apart=True)
    rows = {}
    for name, parts in sets.arguments.items():
        if name == "kitti/patchwork":
            continue
        show_progress(f"height and tilt: {name}")
        rows[name] = {"title": sets.titles[name], **mount_row(study, parts[0])}
    return {"rows": rows}


def mount_row(study, part):
    """F1 by column and method."""
    scans, own = part
    words = own.split()
    height = float(words[words.index("--sensor-height") + 1])
    with tempfile.TemporaryDirectory(prefix="flagstone-pitched-", dir=study.work) as directory:
        write_pitched(study, scans, words, pathlib.Path(directory))
        # The copies are a plain directory: sequences and frames were chosen when they were written.
        pitched = (directory, " ".join(without(words, "--sequences", "--every")))
        wrong = {
            name: " ".join(f" --set {method}.sensor_height={value:g}" for method in METHODS)
            for name, value in (("large", height + WRONG_BY), ("small", height - WRONG_BY))
        }
        unset = (scans, " ".join(without(words, "--sensor-height")))
        columns = {
            "known": (part, ""),
            "height": (with_height(part, "estimate"), ""),
            "both": (with_height(part, "estimate"), " --tilt estimate"),
            "pitched": (pitched, ""),
            "pitched, both": (with_height(pitched, "estimate"), " --tilt estimate"),
            "large": (unset, wrong["large"]),
            "large, height": (unset, wrong["large"] + " --sensor-height estimate"),
            "small": (unset, wrong["small"]),
            "small, height": (unset, wrong["small"] + " --sensor-height estimate"),
        }
        found = {name: evaluate(study, [scans], options)[0] for name, (scans, options) in columns.items()}
    return {name: {method: values[method]["f1"] for method in METHODS} for name, values in found.items()}


def without(words, *options):
    """The words of a command without some options and their values."""
    dropped = {index + offset for index, word in enumerate(words) if word in options for offset in (0, 1)}
    return [word for index, word in enumerate(words) if index not in dropped]


def with_height(part, value):
    scans, own = part
    words = own.split()
    if "--sensor-height" in words:
        words[words.index("--sensor-height") + 1] = value
    else:
        words += ["--sensor-height", value]
    return scans, " ".join(words)


def write_pitched(study, scans, words, target):
    """Copies of scans, pitched by PITCH degrees, with links to their labels."""
    from surface_perturbations import tilted  # imports NumPy, which writing tables does not need

    source = scans
    for name, directory in study.directories.items():
        source = source.replace(name, directory)
    source = pathlib.Path(source)
    if "--sequences" in words:
        source = source / "sequences" / words[words.index("--sequences") + 1]
    step = int(words[words.index("--every") + 1]) if "--every" in words else 1
    turn = tilted(PITCH, axis=1)
    if list(source.glob("*.pcd.bin")):
        for file in sorted(source.glob("*.pcd.bin")):
            copy_turned(file, target / file.name, 5, turn)
            labels = file.name.replace(".pcd.bin", "_lidarseg.bin")
            (target / labels).symlink_to((source / labels).resolve())
        return
    (target / "velodyne").mkdir()
    (target / "labels").mkdir()
    for file in sorted((source / "velodyne").glob("*.bin"))[::step]:
        copy_turned(file, target / "velodyne" / file.name, 4, turn)
        labels = f"{file.stem}.label"
        (target / "labels" / labels).symlink_to((source / "labels" / labels).resolve())


def copy_turned(source, target, columns, turn):
    import numpy as np

    points = np.fromfile(source, "<f4").reshape(-1, columns)
    turn(points, None, None)[0].astype("<f4").tofile(target)


MOUNT_COLUMNS = {
    "mount-tilt": {
        "known": "known height",
        "height": "height estimated",
        "both": "height and tilt estimated",
        "pitched": f"pitched by {abs(PITCH)}°",
        "pitched, both": f"pitched by {abs(PITCH)}°, both estimated",
    },
    "mount-height": {
        "known": "known height",
        "large": f"{WRONG_BY} m too large",
        "large, height": f"{WRONG_BY} m too large, estimated",
        "small": f"{WRONG_BY} m too small",
        "small, height": f"{WRONG_BY} m too small, estimated",
    },
}


def mount_tables(results):
    made_by = f"{results['made_by']['date']}, {results['made_by']['machine']}."
    found = {}
    for name, columns in MOUNT_COLUMNS.items():
        rows = [
            [row["title"], *(" / ".join(percent(row[column][method]) for method in METHODS) for column in columns)]
            for row in results["rows"].values()
        ]
        head = ["F1 of `surface` / `patchwork`, %", *columns.values()]
        found[name] = f"{table(head, rows)}\n\n{made_by}"
    return found


# --- settings recommended by `flagstone doctor` ---------------------------------------------------------------


def measure_doctor(study):
    import tomllib  # needs Python 3.11, which `page` and `check` do not need

    sets = Sets(study, livox_apart=True)
    rows, commands = [], []
    for name in [name for name in REAL_SENSORS if name != "kitti/patchwork"]:
        show_progress(f"doctor: {name}")
        scans, own = sets.arguments[name][0]
        part = (scans, " ".join(without(own.split(), "--sensor-height")))
        file = study.work / "doctor" / f"{name.replace('/', '-')}.toml"
        file.parent.mkdir(exist_ok=True)
        doctor = f"flagstone doctor {scans} --output $WORK/doctor/{file.name}"
        study.call(doctor, exit_codes=(0, 1))  # 1: it recommends settings
        before, _ = evaluate(study, [part], "")
        after, used = evaluate(study, [part], f" --config $WORK/doctor/{file.name}")
        commands = [doctor, *used]
        settings = tomllib.loads(file.read_text())
        rows.append(
            {
                "title": sets.titles[name],
                "sensor": settings.get("sensor"),
                "height": settings.get("sensor_height"),
                "up": settings.get("mount", {}).get("up"),
                **{method: {"default": before[method]["f1"], "recommended": after[method]["f1"]} for method in METHODS},
            }
        )
    return {"rows": rows, "commands": commands}


def doctor_table(results):
    rows = []
    for row in results["rows"]:
        settings = [f"`{row['sensor']}`", f"height {row['height']:g} m"]
        if row["up"]:
            settings.append(f"tilt {math.degrees(math.acos(row['up'][2])):.1f}°")
        values = [percent(row[method][name]) for method in METHODS for name in ("default", "recommended")]
        rows.append([row["title"], ", ".join(settings), *values])
    head = ["F1, %: scans", "recommended settings"]
    head += [text for method in METHODS for text in (f"`{method}`, default", "recommended")]
    return with_commands(table(head, rows, left=2), results, "Commands for the last row:")


# --- the study ------------------------------------------------------------------------------------------------

MEASUREMENTS = {
    "presets": measure_presets,
    "sensors": measure_sensors,
    "mount": measure_mount,
    "doctor": measure_doctor,
}


def tables(results):
    """All tables of the results, by name."""
    found = {}
    if "presets" in results:
        found["presets"] = presets_table(results["presets"])
    if "sensors" in results:
        found |= sensors_tables(results["sensors"])
    if "mount" in results:
        found |= mount_tables(results["mount"])
    if "doctor" in results:
        found["doctor"] = doctor_table(results["doctor"])
    return found


def measure(options):
    study = Study(options.work, options.flagstone)
    if "mount" in options.only:
        study.simulate()
    return {name: {**rounded(MEASUREMENTS[name](study)), "made_by": dict(study.made_by)} for name in options.only}


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, MEASUREMENTS)
