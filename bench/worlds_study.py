# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures both methods in every simulated scene with every sensor: tables of docs/benchmarks/robustness.md.

    python3 bench/worlds_study.py run --work /tmp/scenes                # all of it
    python3 bench/worlds_study.py run --work /tmp/scenes --only faults  # one part; the other results are kept
    python3 bench/worlds_study.py page                                  # tables and image from docs/results/worlds.json
    python3 bench/worlds_study.py check                                 # do the tables match the results?

`run` needs the command (build/flagstone). It simulates all scenes in the work directory (8 GB, half an hour on two
cores), or reuses those that are there. `faults` needs NumPy, the image needs Matplotlib.
"""

import importlib.util
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import typing

from study import ROOT, Runs, main, percent, rounded, show_progress, table

PAGES = (ROOT / "docs" / "benchmarks" / "robustness.md",)
RESULTS = ROOT / "docs" / "results" / "worlds.json"
IMAGE = ROOT / "docs" / "images" / "worlds-f1.png"

SCENES = [
    "flat_street",
    "urban_street",
    "highway",
    "steep_street",
    "ramp",
    "crossroads",
    "parked_cars",
    "park",
    "bushes_and_lawn",
    "forest_track",
    "ploughed_field",
    "bumpy_field",
    "embankment",
    "steps",
    "drops",
    "tunnel",
    "construction_site",
    "indoor_hall",
]
# In the order of the tables, with the mounting height of each sensor file, metres.
SENSORS = {
    "hdl-64e": 1.73,
    "pandar64": 1.9,
    "os1-64": 1.8,
    "os0-128": 0.9,
    "hdl-32e": 1.84,
    "vlp-16": 0.6,
    "at128": 2.6,
    "livox-avia": 1.5,
}
METHODS = ("patchwork", "surface")
FRAMES = 20  # per scene and sensor: two scene instances of ten scans
SEED = 11


def simulate(runs, sensor, scenes, directory, options=""):
    """Writes one sequence per scene, numbered in the order of SCENES. Existing scans are kept."""
    for scene in scenes:
        show_progress(f"simulating {scene} with {sensor}{options}")
        runs.call(
            f"flagstone simulate --scene {scene} --sensor {sensor} --frames {FRAMES} --seed {SEED}"
            f" --output $WORK/{directory} --sequence {SCENES.index(scene):02}{options}"
        )


def by_scene(method, metric="f1"):
    """Mean per scene of a metric in one method's entry of an evaluation."""
    found = {}
    for scan in method["per_scan"]:
        scene = SCENES[int(scan["scan"].split("/")[0])]
        found.setdefault(scene, []).append(scan[metric])
    return {scene: statistics.fmean(values) for scene, values in found.items()}


# --- default settings, settings derived from the sensor, and height and tilt estimated ----------------------

MIN_F1 = 0.90  # an F1 below this is listed as a shortfall
MAX_LOSS = 0.005  # a larger loss of F1 by estimation is listed too


def settings_of(sensor, height):
    """Options of `flagstone eval`, by column."""
    return {
        "plain": f"--sensor-height {height:g}",
        "preset": f"--sensor {sensor}",
        "estimated": f"--sensor {sensor} --sensor-height estimate --tilt estimate",
    }


def measure_settings(runs):
    sensors = {}
    commands = []
    for sensor, height in SENSORS.items():
        simulate(runs, sensor, SCENES, f"scenes/{sensor}")
        sensors[sensor] = {}
        for name, options in settings_of(sensor, height).items():
            show_progress(f"{sensor}, {name}")
            command = f"flagstone eval $WORK/scenes/{sensor} --protocol patchwork++ {options}"
            result = runs.evaluate_command(f"{command} --methods {','.join(METHODS)}")
            commands.append(result["command"])
            sensors[sensor][name] = {method["name"]: by_scene(method) for method in result["methods"]}
    return {"sensors": sensors, "commands": commands}


def bold_if(condition, text):
    return f"**{text}**" if condition else text


def presets_table(results, method):
    """One row per scene, one column per sensor. Each cell: F1 with default, then with derived settings."""
    rows = []
    for scene in SCENES:
        cells = []
        for sensor in SENSORS:
            plain = results["sensors"][sensor]["plain"][method][scene]
            preset = results["sensors"][sensor]["preset"][method][scene]
            cells.append(f"{percent(plain, 1)} → {bold_if(preset < MIN_F1, percent(preset, 1))}")
        rows.append([f"`{scene}`", *cells])
    rows.append(
        [
            "mean",
            *(f"{means(results, s, 'plain', method)} → {means(results, s, 'preset', method)}" for s in SENSORS),
        ]
    )
    return table(["scene", *SENSORS], rows)


def means(results, sensor, name, method):
    values = results["sensors"][sensor][name][method]
    return percent(sum(values.values()) / len(values), 1)


def estimated_table(results, method):
    """Change of F1 by estimating height and tilt, percentage points."""
    rows = []
    for scene in SCENES:
        cells = []
        for sensor in SENSORS:
            of_sensor = results["sensors"][sensor]
            change = of_sensor["estimated"][method][scene] - of_sensor["preset"][method][scene]
            cells.append(bold_if(change < -MAX_LOSS, f"{round(100 * change, 2) + 0.0:+.2f}"))
        rows.append([f"`{scene}`", *cells])
    return table(["scene", *SENSORS], rows)


def shortfalls(results):
    """Scenes and sensors with an F1 below MIN_F1 with derived settings, or a loss by estimation above MAX_LOSS."""
    rows = []
    for method in METHODS:
        for scene in SCENES:
            for sensor in SENSORS:
                of_sensor = results["sensors"][sensor]
                plain, preset, estimated = (of_sensor[name][method][scene] for name in ("plain", "preset", "estimated"))
                if preset >= MIN_F1 and estimated >= preset - MAX_LOSS:
                    continue
                rows.append(
                    [
                        f"`{method}`",
                        f"`{scene}`",
                        sensor,
                        *(percent(f1, 1) for f1 in (plain, preset, estimated)),
                    ]
                )
    return table(["method", "scene", "sensor", "default", "derived", "estimated"], rows, left=3)


def settings_tables(results):
    found = {"shortfalls": shortfalls(results)}
    for method in METHODS:
        found[f"presets-{method}"] = presets_table(results, method)
        found[f"estimated-{method}"] = estimated_table(results, method)
    return found


# --- faulty scans, without and with the protection against the fault ----------------------------------------
#
# One sensor in every scene. The protocol `simulation` scores every point, so a ghost point labelled ground is an
# error.

SENSOR = "hdl-64e"
HEIGHT = SENSORS[SENSOR]
TILT = math.radians(20)
TOOL = "pypatchworkpp-patchworkpp"

# Disables the rules that label points below the ground as noise.
WITHOUT_NOISE_RULES = (
    "--set patchwork.noise_depth=inf --set patchwork.noise_margin=inf"
    " --set surface.noise_depth=1000 --set surface.point.noise_depth=1000"
)


class Fault(typing.NamedTuple):
    """A fault, and the options of `flagstone eval` without and with the protection (None if it is always on)."""

    name: str
    corrupt: typing.Callable | None  # (points (N, 4), random) -> points; None for a separately simulated sequence
    before: str | None
    after: str
    protection: str


def pitched(points, _random):
    return rotated(points, 2, 0)


def rolled(points, _random):
    return rotated(points, 1, 2)


def rotated(points, first, second):
    moved = points.copy()
    moved[:, first] = math.cos(TILT) * points[:, first] - math.sin(TILT) * points[:, second]
    moved[:, second] = math.sin(TILT) * points[:, first] + math.cos(TILT) * points[:, second]
    return moved


def unchanged(points, _random):
    return points


def lost(value):
    """One point in five without a return."""

    def corrupt(points, random):
        corrupted = points.copy()
        corrupted[random.random(len(points)) < 0.2, :3] = value
        return corrupted

    return corrupt


def with_heights(height):
    return " ".join(f"--set {method}.sensor_height={height:g}" for method in METHODS)


KNOWN = f"--sensor-height {HEIGHT}"
FAULTS = [
    Fault("none", unchanged, KNOWN, KNOWN, ""),
    Fault("wet road: ghost points", None, f"{KNOWN} {WITHOUT_NOISE_RULES}", KNOWN, "noise rules"),
    Fault("one return in five is (0, 0, 0)", lost(0), None, KNOWN, "label `invalid`"),
    Fault("one return in five is NaN", lost(math.nan), None, KNOWN, "label `invalid`"),
    Fault("pitched by 20°", pitched, KNOWN, f"{KNOWN} --tilt estimate", "tilt estimated"),
    Fault("rolled by 20°", rolled, KNOWN, f"{KNOWN} --tilt estimate", "tilt estimated"),
    *(
        Fault(
            f"height 0.5 m too {word}",
            unchanged,
            with_heights(height),
            f"{with_heights(height)} --sensor-height estimate",
            "height estimated",
        )
        for word, height in (("large", HEIGHT + 0.5), ("small", HEIGHT - 0.5))
    ),
]


def measure_faults(runs):
    simulate(runs, SENSOR, SCENES, f"scenes/{SENSOR}")
    simulate(runs, SENSOR, SCENES, f"scenes/{SENSOR}-wet", " --weather wet")
    has_tool = importlib.util.find_spec("pypatchworkpp") is not None
    rows = []
    for number, fault in enumerate(FAULTS):
        show_progress(f"fault {number + 1} of {len(FAULTS)}: {fault.name}")
        with tempfile.TemporaryDirectory(prefix="flagstone-faults-", dir=runs.work) as temporary:
            directory = pathlib.Path(temporary) / "scans"
            if fault.corrupt is None:
                directory = runs.work / "scenes" / f"{SENSOR}-wet"
            else:
                write_corrupted(runs.work / "scenes" / SENSOR, directory, fault.corrupt)
            row = {"fault": fault.name, "protection": fault.protection}
            for part in ("before", "after"):
                options = getattr(fault, part)
                row[part] = f1_of(runs, directory, options) if options else None
            if has_tool:
                row["external"] = f1_of_tool(runs, directory, pathlib.Path(temporary) / "external")
            rows.append(row)
    return {"rows": rows}


def write_corrupted(source, target, corrupt):
    import numpy as np  # `page` and `check` do not need it

    random = np.random.default_rng(1)
    for file in sorted(source.glob("sequences/*/velodyne/*.bin")):
        sequence = target / "sequences" / file.parts[-3]
        for kind in ("velodyne", "labels"):
            (sequence / kind).mkdir(parents=True, exist_ok=True)
        points = corrupt(np.fromfile(file, "<f4").reshape(-1, 4), random)
        points.astype("<f4").tofile(sequence / "velodyne" / file.name)
        labels = file.parent.parent / "labels" / f"{file.stem}.label"
        classes = np.fromfile(labels, "<u4")
        classes[~(points[:, :3] != 0).any(axis=1) | np.isnan(points[:, 0])] = (
            0  # class 0: missing returns are not scored
        )
        classes.tofile(sequence / "labels" / labels.name)


def mean_f1(method):
    return statistics.fmean(scan["f1"] for scan in method["per_scan"])


def f1_of(runs, directory, options):
    command = f"flagstone eval {directory} --protocol simulation {options} --methods {','.join(METHODS)}"
    return {method["name"]: mean_f1(method) for method in runs.evaluate_command(command)["methods"]}


def f1_of_tool(runs, directory, labels):
    """F1 of pypatchworkpp; None if it fails on the scans."""
    done = subprocess.run(
        [sys.executable, ROOT / "bench" / "external_tools.py", directory, "--output", labels, "--tools", TOOL],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    if done.returncode != 0:
        return None
    command = f"flagstone eval {directory} --protocol simulation --methods none --labels {TOOL}={labels / TOOL}"
    return mean_f1(runs.evaluate_command(command)["methods"][0])


def faults_tables(results):
    rows = []
    for row in results["rows"]:
        cells = [
            percent(row[part][method] if row[part] else None) for method in METHODS for part in ("before", "after")
        ]
        external = percent(row["external"]) if row.get("external") is not None else "–"
        rows.append([row["fault"], row["protection"], *cells, external])
    head = [
        "fault",
        "protection",
        *(text for method in METHODS for text in (f"`{method}`, without", "with")),
        "pypatchworkpp",
    ]
    return {"faults": table(head, rows, left=2)}


# --- the image ----------------------------------------------------------------------------------------------

TITLES = {
    "plain": "default settings, height known",
    "preset": "derived settings, height known",
    "estimated": "derived settings, height and tilt estimated",
}


def draw(results):
    """Draws the F1 of every scene and sensor: one heat map per method and column."""
    if "settings" not in results:
        return
    import matplotlib  # `check` does not need it

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    results = results["settings"]
    figure, axes = plt.subplots(
        len(METHODS), len(TITLES), figsize=(15, 12.5), sharex=True, sharey=True, layout="constrained"
    )
    for row, method in zip(axes, METHODS):
        for part, (name, title) in zip(row, TITLES.items()):
            f1 = [[100 * results["sensors"][s][name][method][scene] for s in SENSORS] for scene in SCENES]
            image = part.imshow(f1, vmin=70, vmax=100, cmap="RdYlGn", aspect="auto")
            part.set_title(f"{method}: {title}", fontsize=11)
            part.set_xticks(range(len(SENSORS)), SENSORS, rotation=45, ha="right")
            part.set_yticks(range(len(SCENES)), [scene.replace("_", " ") for scene in SCENES])
            for i, values in enumerate(f1):
                for j, value in enumerate(values):
                    dark = value < 76 or value > 96.5
                    part.text(
                        j,
                        i,
                        f"{value:.1f}",
                        ha="center",
                        va="center",
                        fontsize=7.5,
                        color="white" if dark else "black",
                    )
    figure.colorbar(image, ax=axes, shrink=0.5, label="F1 in percent, protocol patchwork++", extend="min")
    figure.savefig(IMAGE, dpi=90)


# --- the study ----------------------------------------------------------------------------------------------

MEASUREMENTS = {"settings": measure_settings, "faults": measure_faults}
TABLES = {"settings": settings_tables, "faults": faults_tables}


def tables(results):
    """All tables of the results, by name."""
    found = {}
    for name, make in TABLES.items():
        if name in results:
            found |= make(results[name])
    return found


def measure(options):
    runs = Runs(options.work, options.flagstone)
    return {name: {**rounded(MEASUREMENTS[name](runs)), "made_by": dict(runs.made_by)} for name in options.only}


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, MEASUREMENTS, draw=draw)
