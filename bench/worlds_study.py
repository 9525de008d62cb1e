# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures the methods in every simulated world with every sensor, and writes the tables of docs/benchmarks/robustness.md.

    python3 bench/worlds_study.py run --work /tmp/worlds                  # all of it
    python3 bench/worlds_study.py run --work /tmp/worlds --only faults
    python3 bench/worlds_study.py page                                    # tables and picture, from docs/results/worlds.json
    python3 bench/worlds_study.py check                                   # are the page's tables those of the results?

`run` wants the command built (build/flagstone). The first time it simulates all worlds in the work folder (some
GB, half an hour on two cores); later runs keep them. `faults` wants NumPy, the picture wants Matplotlib.
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
PICTURE = ROOT / "docs" / "images" / "worlds-f1.png"

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
# In the order of the tables, with the height that each stands at in its file, metres.
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
FRAMES = 20  # of each scene, by each sensor: two worlds
SEED = 11


def simulate(runs, sensor, scenes, folder, options=""):
    """One sequence a scene, numbered in the order of SCENES; what is there already is kept."""
    for scene in scenes:
        show_progress(f"simulating {scene} with {sensor}{options}")
        runs.call(
            f"flagstone simulate --scene {scene} --sensor {sensor} --frames {FRAMES} --seed {SEED}"
            f" --output $WORK/{folder} --sequence {SCENES.index(scene):02}{options}"
        )


def by_scene(method, figure="f1"):
    """Mean over the scans of each scene of one method's entry in an evaluation."""
    found = {}
    for scan in method["per_scan"]:
        scene = SCENES[int(scan["scan"].split("/")[0])]
        found.setdefault(scene, []).append(scan[figure])
    return {scene: statistics.fmean(values) for scene, values in found.items()}


# --- settings: plain, the sensor's preset, and the preset with height and tilt estimated --------------------

LEAST = 0.90  # F1 below this is a shortfall
MOST_LOST = 0.005  # by estimating


def settings_of(sensor, height):
    """Options of `flagstone eval` by the name of a column."""
    return {
        "plain": f"--sensor-height {height:g}",
        "preset": f"--sensor {sensor}",
        "estimated": f"--sensor {sensor} --sensor-height estimate --tilt estimate",
    }


def measure_settings(runs):
    sensors = {}
    commands = []
    for sensor, height in SENSORS.items():
        simulate(runs, sensor, SCENES, f"worlds/{sensor}")
        sensors[sensor] = {}
        for name, options in settings_of(sensor, height).items():
            show_progress(f"{sensor}, {name}")
            command = f"flagstone eval $WORK/worlds/{sensor} --protocol patchwork++ {options}"
            result = runs.evaluate_command(f"{command} --methods {','.join(METHODS)}")
            commands.append(result["command"])
            sensors[sensor][name] = {method["name"]: by_scene(method) for method in result["methods"]}
    return {"sensors": sensors, "commands": commands}


def shown(value, is_short):
    return f"**{value}**" if is_short else value


def presets_table(results, method):
    """Rows of scenes, columns of sensors; each cell: plain, then preset."""
    rows = []
    for scene in SCENES:
        cells = []
        for sensor in SENSORS:
            plain = results["sensors"][sensor]["plain"][method][scene]
            preset = results["sensors"][sensor]["preset"][method][scene]
            cells.append(f"{percent(plain, 1)} → {shown(percent(preset, 1), preset < LEAST)}")
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
    """What estimating height and tilt changes, points of F1."""
    rows = []
    for scene in SCENES:
        cells = []
        for sensor in SENSORS:
            of_sensor = results["sensors"][sensor]
            change = of_sensor["estimated"][method][scene] - of_sensor["preset"][method][scene]
            cells.append(shown(f"{round(100 * change, 2) + 0.0:+.2f}", change < -MOST_LOST))
        rows.append([f"`{scene}`", *cells])
    return table(["scene", *SENSORS], rows)


def shortfalls(results):
    """Where F1 with the preset is below LEAST, and where estimating costs more than MOST_LOST."""
    rows = []
    for method in METHODS:
        for scene in SCENES:
            for sensor in SENSORS:
                of_sensor = results["sensors"][sensor]
                plain, preset, estimated = (of_sensor[name][method][scene] for name in ("plain", "preset", "estimated"))
                if preset >= LEAST and estimated >= preset - MOST_LOST:
                    continue
                rows.append(
                    [
                        f"`{method}`",
                        f"`{scene}`",
                        sensor,
                        *(percent(f1, 1) for f1 in (plain, preset, estimated)),
                    ]
                )
    return table(["method", "scene", "sensor", "plain", "preset", "estimated"], rows, left=3)


def settings_tables(results):
    found = {"shortfalls": shortfalls(results)}
    for method in METHODS:
        found[f"presets-{method}"] = presets_table(results, method)
        found[f"estimated-{method}"] = estimated_table(results, method)
    return found


# --- faults: scans with a fault, before and after the protection against it ---------------------------------
#
# Scans are those of one sensor in every scene. Under the protocol `simulation` every point counts, so that a
# ghost that is called ground is an error.

SENSOR = "hdl-64e"
HEIGHT = SENSORS[SENSOR]
TILT = math.radians(20)
TOOL = "pypatchworkpp-patchworkpp"

# What makes points below the ground noise, switched off.
WITHOUT_NOISE_RULES = (
    "--set patchwork.noise_depth=inf --set patchwork.noise_margin=inf"
    " --set surface.noise_depth=1000 --set surface.point.noise_depth=1000"
)


class Fault(typing.NamedTuple):
    """A fault, and the options of `flagstone eval` without and with the protection; None where it is always on."""

    name: str
    spoil: typing.Callable | None  # (points (N, 4), random) -> the same; None for a simulated sequence of its own
    before: str | None
    after: str
    protection: str


def pitched(points, _random):
    return turned(points, 2, 0)


def rolled(points, _random):
    return turned(points, 1, 2)


def turned(points, first, second):
    moved = points.copy()
    moved[:, first] = math.cos(TILT) * points[:, first] - math.sin(TILT) * points[:, second]
    moved[:, second] = math.sin(TILT) * points[:, first] + math.cos(TILT) * points[:, second]
    return moved


def unchanged(points, _random):
    return points


def lost(value):
    """One point in five without an echo."""

    def spoil(points, random):
        spoilt = points.copy()
        spoilt[random.random(len(points)) < 0.2, :3] = value
        return spoilt

    return spoil


def told(height):
    return " ".join(f"--set {method}.sensor_height={height:g}" for method in METHODS)


KNOWN = f"--sensor-height {HEIGHT}"
FAULTS = [
    Fault("none", unchanged, KNOWN, KNOWN, ""),
    Fault("wet road: ghosts", None, f"{KNOWN} {WITHOUT_NOISE_RULES}", KNOWN, "noise rules"),
    Fault("one return in five is (0, 0, 0)", lost(0), None, KNOWN, "label `invalid`"),
    Fault("one return in five is NaN", lost(math.nan), None, KNOWN, "label `invalid`"),
    Fault("pitched by 20°", pitched, KNOWN, f"{KNOWN} --tilt estimate", "tilt estimated"),
    Fault("rolled by 20°", rolled, KNOWN, f"{KNOWN} --tilt estimate", "tilt estimated"),
    *(
        Fault(
            f"height set 0.5 m too {word}",
            unchanged,
            told(height),
            f"{told(height)} --sensor-height estimate",
            "height estimated",
        )
        for word, height in (("large", HEIGHT + 0.5), ("small", HEIGHT - 0.5))
    ),
]


def measure_faults(runs):
    simulate(runs, SENSOR, SCENES, f"worlds/{SENSOR}")
    simulate(runs, SENSOR, SCENES, f"worlds/{SENSOR}-wet", " --weather wet")
    has_tool = importlib.util.find_spec("pypatchworkpp") is not None
    rows = []
    for number, fault in enumerate(FAULTS):
        show_progress(f"fault {number + 1} of {len(FAULTS)}: {fault.name}")
        with tempfile.TemporaryDirectory(prefix="flagstone-faults-", dir=runs.work) as place:
            folder = pathlib.Path(place) / "scans"
            if fault.spoil is None:
                folder = runs.work / "worlds" / f"{SENSOR}-wet"
            else:
                write_spoilt(runs.work / "worlds" / SENSOR, folder, fault.spoil)
            row = {"fault": fault.name, "protection": fault.protection}
            for part in ("before", "after"):
                options = getattr(fault, part)
                row[part] = f1_of(runs, folder, options) if options else None
            if has_tool:
                row["external"] = f1_of_tool(runs, folder, pathlib.Path(place) / "external")
            rows.append(row)
    return {"rows": rows}


def write_spoilt(source, target, spoil):
    import numpy as np  # not above: tables are written and checked without it

    random = np.random.default_rng(1)
    for file in sorted(source.glob("sequences/*/velodyne/*.bin")):
        sequence = target / "sequences" / file.parts[-3]
        for kind in ("velodyne", "labels"):
            (sequence / kind).mkdir(parents=True, exist_ok=True)
        points = spoil(np.fromfile(file, "<f4").reshape(-1, 4), random)
        points.astype("<f4").tofile(sequence / "velodyne" / file.name)
        labels = file.parent.parent / "labels" / f"{file.stem}.label"
        classes = np.fromfile(labels, "<u4")
        classes[~(points[:, :3] != 0).any(axis=1) | np.isnan(points[:, 0])] = 0  # what is lost is nothing
        classes.tofile(sequence / "labels" / labels.name)


def mean_f1(method):
    return statistics.fmean(scan["f1"] for scan in method["per_scan"])


def f1_of(runs, folder, options):
    command = f"flagstone eval {folder} --protocol simulation {options} --methods {','.join(METHODS)}"
    return {method["name"]: mean_f1(method) for method in runs.evaluate_command(command)["methods"]}


def f1_of_tool(runs, folder, labels):
    """None if it does not survive the scans."""
    done = subprocess.run(
        [sys.executable, ROOT / "bench" / "external_tools.py", folder, "--output", labels, "--tools", TOOL],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    if done.returncode != 0:
        return None
    command = f"flagstone eval {folder} --protocol simulation --methods none --labels {TOOL}={labels / TOOL}"
    return mean_f1(runs.evaluate_command(command)["methods"][0])


def faults_tables(results):
    rows = []
    for row in results["rows"]:
        cells = [
            percent(row[part][method] if row[part] else None) for method in METHODS for part in ("before", "after")
        ]
        peer = percent(row["external"]) if row.get("external") is not None else "–"
        rows.append([row["fault"], row["protection"], *cells, peer])
    head = [
        "fault",
        "protection",
        *(text for method in METHODS for text in (f"`{method}` before", "after")),
        "pypatchworkpp",
    ]
    return {"faults": table(head, rows, left=2)}


# --- the picture --------------------------------------------------------------------------------------------

TITLES = {
    "plain": "plain settings, height known",
    "preset": "preset, height known",
    "estimated": "preset, height and tilt estimated",
}


def draw(results):
    """F1 of every scene and sensor as a picture: one map per method and setting."""
    if "settings" not in results:
        return
    import matplotlib  # not above: the page is checked without it

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
    figure.colorbar(image, ax=axes, shrink=0.5, label="F1, percent, protocol patchwork++", extend="min")
    figure.savefig(PICTURE, dpi=90)


# --- the study ----------------------------------------------------------------------------------------------

MEASUREMENTS = {"settings": measure_settings, "faults": measure_faults}
TABLES = {"settings": settings_tables, "faults": faults_tables}


def tables(results):
    """Every table of what was measured, by name."""
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
