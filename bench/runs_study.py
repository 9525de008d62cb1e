# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures labels, maps and moving points of `flagstone map`: tables and image of docs/benchmarks/runs.md.

    python3 bench/runs_study.py run --work /tmp/runs                # all of it
    python3 bench/runs_study.py run --work /tmp/runs --only moving  # one part; the other results are kept
    python3 bench/runs_study.py page                                # the tables, from docs/results/runs.json
    python3 bench/runs_study.py check                               # do the tables match the results?

`run` needs the command (build/flagstone), NumPy, Matplotlib and the real scans in FLAGSTONE_DATA. It simulates all runs
in the work directory (8 GB) and maps them (15 GB), or reuses the simulated scans, and the maps that the same
command has made. Results are written after each part, so that an interrupted study continues with the next one.
"""

import hashlib
import json
import os
import pathlib
import shlex
import shutil
import statistics
import subprocess
import sys
import time
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
)

PAGES = (ROOT / "docs" / "benchmarks" / "runs.md",)
RESULTS = ROOT / "docs" / "results" / "runs.json"
IMAGE = ROOT / "docs" / "images" / "moving-missed.png"

SCENES = ["urban_street", "highway", "crossroads", "parked_cars", "park", "forest_track"]
SENSORS = {"hdl-64e": 1.73, "hdl-32e": 1.84, "vlp-16": 1.73}  # mounting heights, metres
SEEDS = {"hdl-64e": (1, 2, 3), "hdl-32e": (1,), "vlp-16": (1,)}
REAL_SEQUENCES = ("00", "03", "05", "10")
REAL_WITH_MOTION = ("00", "05", "10")
FRAMES, RATE = 91, 10  # of a simulated run: 72 m
KINDS = ("live", "delayed", "offline")
BANDS = ("0–10 m", "10–20 m", "20–40 m", "40–80 m")
EVERY = 3  # scans of simulated runs that the labels and heights are scored on

# A circuit of 2016 m that the vehicle passes twice.
LOOP = {"sensor": "hdl-32e", "length": 2000, "rate": 4, "lap": 1008}
LOOP_EVERY = 10


class Run(typing.NamedTuple):
    """The scans of a run. `directory` is in the layout of SemanticKITTI."""

    name: str
    directory: str
    height: float
    scene: str = ""
    sensor: str = ""
    seed: int = 0
    extra: str = ""  # options of `flagstone simulate`
    frames: int = FRAMES
    rate: float = RATE

    @property
    def is_real(self):
        return not self.scene


def simulated(sensor, seed, scene):
    directory = f"$WORK/simulated/{sensor}-{seed}/sequences/{SCENES.index(scene):02}"
    return Run(f"{sensor}-{seed}/{scene}", directory, SENSORS[sensor], scene, sensor, seed)


def real(sequence):
    return Run(f"real/{sequence}", f"$FLAGSTONE_DATA/sequences/{sequence}", 1.73)


def loop():
    sensor = LOOP["sensor"]
    extra = f" --length {LOOP['length']} --loop"
    return Run(
        "loop",
        "$WORK/simulated/loop/sequences/00",
        SENSORS[sensor],
        "urban_street",
        sensor,
        1,
        extra,
        2 * LOOP["lap"],
        LOOP["rate"],
    )


class Study(Runs):
    """Simulates and maps runs in the work directory."""

    def __init__(self, work, flagstone):
        super().__init__(work, flagstone)
        self.binary = hashlib.sha256(pathlib.Path(flagstone).read_bytes()).hexdigest()

    def path(self, text):
        """A path that begins with $WORK or $FLAGSTONE_DATA."""
        for name, directory in self.directories.items():
            text = text.replace(name, directory)
        return pathlib.Path(text)

    def sequence(self, run):
        from run_metrics import Sequence  # needs NumPy, which `page` and `check` do not need

        return Sequence(self.path(run.directory))

    def simulate(self, run, directory=None, sensor=None, noise="jitter"):
        """Existing scans are kept."""
        output, _, sequence = (directory or run.directory).partition("/sequences/")
        show_progress(f"simulating {run.name}")
        self.call(
            f"flagstone simulate --scene {run.scene} --sensor {sensor or run.sensor} --sensor-height {run.height:g}"
            f" --frames {run.frames} --rate {run.rate}{run.extra} --pose-noise {noise} --seed {run.seed}"
            f" --output {output} --sequence {sequence}"
        )

    def poses(self, run, noise):
        """The file of poses. A sensor with one beam yields poses with other errors without simulating all scans."""
        if run.is_real:
            return f"{run.directory}/poses.txt"
        scene = json.loads((self.path(run.directory) / "scene.json").read_text())
        if noise == "exact":
            return f"{run.directory}/poses.txt"
        if noise == scene["pose_noise"]:
            return f"{run.directory}/poses_measured.txt"
        beam = self.work / "one-beam.toml"
        beam.write_text(
            'name = "one-beam"\ntitle = "One beam"\nelevations = [0.0]\nfirings = 4\nmin_range = 1.0\nmax_range = 10\n'
            f"range_sigma = 0.0\nheight = {run.height}\n"
        )
        directory = f"$WORK/poses/{noise}/{run.name}/sequences/00"
        self.simulate(run, directory, "$WORK/one-beam.toml", noise)
        if (self.path(directory) / "poses.txt").read_bytes() != (self.path(run.directory) / "poses.txt").read_bytes():
            sys.exit(f"{directory}: other exact poses than in {run.directory}")
        return f"{directory}/poses_measured.txt"

    def reuse(self, output, command):
        """The result of a command that wrote `output` before, unless it was another command or another build."""
        stamp = self.path(f"{output}.json")
        if stamp.exists():
            earlier = json.loads(stamp.read_text())
            if earlier["command"] == command and earlier["binary"] == self.binary:
                return earlier["result"]
        shutil.rmtree(self.path(output), ignore_errors=True)
        stamp.parent.mkdir(parents=True, exist_ok=True)
        return None

    def remember(self, output, command, result):
        text = json.dumps({"command": command, "binary": self.binary, "result": result})
        self.path(f"{output}.json").write_text(text)
        return result

    def map(self, run, kind, noise):
        """Maps a run, and returns the output directory. Offline maps have heights."""
        options = f"--labels {kind} --voxel 0{' --heights' if kind == 'offline' else ''}"
        return self.map_directory(run, run.directory, self.poses(run, noise), options, f"{noise}-{kind}")

    def map_directory(self, run, directory, poses, options, name):
        """Maps scans of a run, and returns the output directory."""
        output = f"$WORK/mapped/{run.name}/{name}"
        command = (
            f"flagstone map {directory} --poses {poses} --sensor-height {run.height:g} {options} --output {output}"
        )
        if self.reuse(output, command) is None:
            show_progress(f"mapping {directory}, {name}")
            self.remember(output, command, json.loads(self.call(f"{command} --json")))
        return output

    def result(self, output):
        """What `flagstone map` printed."""
        return json.loads(self.path(f"{output}.json").read_text())["result"]

    def command(self, output):
        return json.loads(self.path(f"{output}.json").read_text())["command"]

    def alone(self, run):
        """Labels and heights of each scan alone."""
        output = f"$WORK/alone/{run.name}"
        command = (
            f"flagstone segment {run.directory}/velodyne --sensor-height {run.height:g} --heights --output {output}"
        )
        if self.reuse(output, command) is None:
            show_progress(f"segmenting {run.name}")
            self.call(command)
            self.remember(output, command, {})
        return output

    def part_of(self, run, name, scans):
        """A run of some scans of another one, as links."""
        directory = f"$WORK/parts/{run.name}-{name}"
        target, source = self.path(directory), self.path(run.directory)
        shutil.rmtree(target, ignore_errors=True)
        (target / "velodyne").mkdir(parents=True)
        for scan in sorted((source / "velodyne").iterdir())[scans]:
            (target / "velodyne" / scan.name).symlink_to(scan.resolve())
        for file in ("poses.txt", "times.txt"):
            lines = (source / file).read_text().splitlines(keepends=True)
            (target / file).write_text("".join(lines[scans]))
        return directory

    def identify(self):
        """Sets `made_by` by a short evaluation, because some parts do not evaluate."""
        run = simulated("hdl-64e", 1, SCENES[0])
        self.simulate(run)
        self.evaluate_command(f"flagstone eval {run.directory} --methods surface --every {FRAMES}")


def runs_of(sensor):
    return [simulated(sensor, seed, scene) for scene in SCENES for seed in SEEDS[sensor]]


def titled(scene):
    return scene.replace("_", " ")


# --- labels: F1 of the scan alone, live, delayed and offline --------------------------------------------------


def measure_labels(study):
    """Each row: a scene with a sensor, all seeds together; or a real run with a protocol."""
    rows = []
    for sensor in SENSORS:
        for scene in SCENES:
            runs = [simulated(sensor, seed, scene) for seed in SEEDS[sensor]]
            rows.append({"title": titled(scene), "set": sensor, **labels_row(study, runs, "simulation", EVERY)})
    for protocol in ("patchwork", "patchwork++"):
        for sequence in REAL_SEQUENCES:
            row = labels_row(study, [real(sequence)], protocol, 1)
            rows.append({"title": f"KITTI {sequence}", "set": protocol, **row})
    return {"rows": rows}


def labels_row(study, runs, protocol, every):
    from run_metrics import UNKNOWN_CLASSES, VEGETATION, behind_f1

    ignored = {"simulation": (), "patchwork": None, "patchwork++": (*UNKNOWN_CLASSES, VEGETATION)}[protocol]
    results, behind, behind_points = [], [], 0
    for run in runs:
        if not run.is_real:
            study.simulate(run)
        noise = "given" if run.is_real else "jitter"
        mapped = {kind: study.map(run, kind, noise) for kind in KINDS}
        alone = study.alone(run)
        labels = "".join(f" --labels {kind}={output}/labels" for kind, output in mapped.items())
        command = (
            f"flagstone eval {run.directory} --protocol {protocol} --sensor-height {run.height:g} --every {every}"
            f" --methods surface{labels}"
        )
        show_progress(f"scoring labels of {run.name}")
        result = study.evaluate_command(command)
        results.append({method["name"]: method for method in result["methods"]})
        if ignored is not None:  # protocol patchwork: vegetation counts by its height, and unknown classes are wrong
            directories = {kind: study.path(f"{output}/labels") for kind, output in mapped.items()}
            directories["surface"] = study.path(alone)
            f1, points = behind_f1(study.sequence(run), directories, every, ignored)
            behind.append(f1)
            behind_points += points
    names = ("surface", *KINDS)
    scans = {name: {"per_scan": unique_scans(results, name)} for name in names}
    return {
        "f1": mean_of([scan["f1"] for scan in scans["surface"]["per_scan"]]),
        "difference": {kind: paired(scans[kind], scans["surface"], "f1") for kind in KINDS},
        "far": {name: mean_known([result[name]["by_range"][-1]["f1"] for result in results]) for name in names},
        "behind": {name: mean_known([f1[name] for f1 in behind]) for name in names} if behind else None,
        "behind_points": behind_points,
        "command": command,
    }


def unique_scans(results, name):
    """The scans of several runs, with the number of the run in their names."""
    return [
        {**scan, "scan": f"{number}/{scan['scan']}"}
        for number, result in enumerate(results)
        for scan in result[name]["per_scan"]
    ]


def mean_known(values):
    known = [value for value in values if value is not None]
    return statistics.fmean(known) if known else None


def made_by(results):
    return f"{results['made_by']['date']}, {results['made_by']['machine']}"


def set_title(row):
    return row["set"] if row["set"] in SENSORS else f"`{row['set']}`"


def labels_tables(results):
    rows = [
        [
            set_title(row),
            row["title"],
            str(row["f1"]["scans"]),
            percent(row["f1"]["mean"]),
            *(percentage_points(row["difference"][kind]) for kind in KINDS),
        ]
        for row in results["rows"]
    ]
    head = ["sensor or protocol", "run", "scans", "scan alone: F1, %", *(f"{kind}: change" for kind in KINDS)]
    command = results["rows"][len(SCENES) - 1]["command"]
    found = {
        "labels": table(head, rows, left=2)
        + f"\n\n{made_by(results)}. Command of the last run with {next(iter(SENSORS))}:\n\n    {command}"
    }
    names = ("surface", *KINDS)
    for name, part in (("labels-far", "far"), ("labels-behind", "behind")):
        rows = [
            [set_title(row), row["title"], *(percent(row[part][name]) for name in names)]
            for row in results["rows"]
            if row[part] and row[part]["surface"] is not None
        ]
        found[name] = table(["sensor or protocol", "run", "scan alone", *KINDS], rows, left=2)
    return found


# --- heights of the map ---------------------------------------------------------------------------------------

NOISES = ("exact", "jitter", "drift")


def measure_map(study):
    rows = []
    for sensor in SENSORS:
        for noise in NOISES if sensor == "hdl-64e" else ("jitter",):
            for scene in SCENES:
                run = simulated(sensor, 1, scene)
                study.simulate(run)
                rows.append({"set": sensor, "noise": noise, "title": titled(scene), **heights_row(study, run, noise)})
    return {"rows": rows, "loop": measure_loop(study), "twice": measure_twice(study)}


def heights_row(study, run, noise, scans=slice(None), every=EVERY):
    from run_metrics import height_errors

    mapped = study.map(run, "offline", noise)
    directories = {"alone": study.path(study.alone(run)), "map": study.path(f"{mapped}/heights")}
    show_progress(f"scoring heights of {run.name}, {noise} poses")
    errors, known = height_errors(study.sequence(run), directories, every, scans)
    return {
        "errors": errors,
        "known": known,
        "mapped": study.result(mapped)["mapped"],
        "command": study.command(mapped),
    }


def measure_loop(study):
    """Height errors in the first and the second lap of a circuit."""
    run, lap = loop(), LOOP["lap"]
    study.simulate(run, noise="drift")
    rows = []
    for noise in NOISES:
        for title, scans in (("first", slice(0, lap)), ("second", slice(lap, 2 * lap))):
            rows.append({"noise": noise, "lap": title, **heights_row(study, run, noise, scans, LOOP_EVERY)})
    return {"rows": rows, "scans": run.frames}


def measure_twice(study):
    """Differences of two maps of the same ground: the two laps of a circuit, and the even and odd scans of a run."""
    lap = LOOP["lap"]
    pairs = [("two laps", loop(), "exact", (slice(0, lap), slice(lap, 2 * lap)))]
    halves = (slice(0, None, 2), slice(1, None, 2))
    for noise in ("exact", "jitter"):
        pairs += [(titled(scene), simulated("hdl-64e", 1, scene), noise, halves) for scene in SCENES]
    return [
        {"title": title, "noise": noise, **difference_of(study, run, noise, parts)}
        for title, run, noise, parts in pairs
    ]


def difference_of(study, run, noise, parts):
    from run_metrics import map_difference

    outputs = []
    poses = study.path(study.poses(run, noise)).read_text().splitlines(keepends=True)
    for number, scans in enumerate(parts):
        name = f"{noise}-{number}"
        directory = study.part_of(run, name, scans)
        (study.path(directory) / "poses.txt").write_text("".join(poses[scans]))
        output = study.map_directory(run, directory, f"{directory}/poses.txt", "--voxel 0", f"part-{name}")
        outputs.append(study.path(output))
    return map_difference(*outputs)


def centimetres(metres):
    return f"{100 * metres:.1f}"


def median_and_most(values):
    return f"{centimetres(values['median'])} / {centimetres(values['p95'])}" if values else "–"


def error_cells(row):
    """`alone` and `map` by band: median / 95th percentile."""
    return [
        f"{median_and_most(alone)} → {median_and_most(mapped)}" if alone else "–"
        for alone, mapped in zip(row["errors"]["alone"], row["errors"]["map"], strict=True)
    ]


def map_tables(results):
    rows = [[row["set"], row["noise"], row["title"], *error_cells(row)] for row in results["rows"]]
    found = {
        "map-heights": table(["sensor", "poses", "scene", *BANDS], rows, left=3)
        + f"\n\n{made_by(results)}. Command of the last map:\n\n    {results['rows'][-1]['command']}"
    }
    scans = results["loop"]["scans"]
    rows = [
        [row["noise"], row["lap"], f"{row['mapped']} of {scans}", *error_cells(row)] for row in results["loop"]["rows"]
    ]
    found["map-loop"] = table(["poses", "lap", "scans mapped", *BANDS], rows, left=2) + (
        f"\n\n{made_by(results)}. Command of the last map:\n\n    {results['loop']['rows'][-1]['command']}"
    )
    rows = [
        [row["title"], row["noise"], str(row["cells"]), median_and_most(row["as_is"]), median_and_most(row["levelled"])]
        for row in results["twice"]
    ]
    head = ["maps", "poses", "common cells", "difference, cm", "after a fitted plane is subtracted, cm"]
    found["map-twice"] = table(head, rows, left=2)
    return found


# --- moving points --------------------------------------------------------------------------------------------


def measure_moving(study):
    rows = []
    for sensor in SENSORS:
        for scene in SCENES:
            runs = [simulated(sensor, seed, scene) for seed in SEEDS[sensor]]
            seeds = [moving_row(study, run, "jitter", KINDS) for run in runs]
            rows.append({"set": sensor, "noise": "jitter", "title": titled(scene), "seeds": seeds})
    for noise in ("exact", "drift"):
        for scene in SCENES:
            seeds = [moving_row(study, simulated("hdl-64e", 1, scene), noise, ("live", "offline"))]
            rows.append({"set": "hdl-64e", "noise": noise, "title": titled(scene), "seeds": seeds})
    for sequence in REAL_WITH_MOTION:
        seeds = [moving_row(study, real(sequence), "given", KINDS)]
        rows.append({"set": "real", "noise": "given", "title": sequence, "seeds": seeds})
    return {"rows": rows, "classes": class_names(study)}


def moving_row(study, run, noise, kinds):
    from run_metrics import moving_metrics, read_poses

    if not run.is_real:
        study.simulate(run)
    mapped = {kind: study.map(run, kind, noise) for kind in kinds}
    alone = study.path(study.alone(run))
    # Real poses are of the camera; the poses of the map are of the sensor.
    poses = study.path(f"{mapped['offline']}/poses.txt" if run.is_real else f"{run.directory}/poses.txt")
    show_progress(f"scoring moving points of {run.name}, {noise} poses")
    directories = {kind: study.path(output) for kind, output in mapped.items()}
    metrics = moving_metrics(study.sequence(run), directories, alone, read_poses(poses))
    return {**metrics, "command": study.command(mapped["offline"])}


def class_names(study):
    scene = json.loads((study.path(simulated("hdl-64e", 1, SCENES[0]).directory) / "scene.json").read_text())
    return scene["classes"]


MIN_MOVING = 1000  # points; with fewer, metrics of moving points are not listed


def metric_of(seed, kind, metric):
    """A metric of a run, or None if it has too few moving points for the metric."""
    is_of_static = metric in ("kept", "pr")
    return seed["kinds"][kind][metric] if is_of_static or seed["moving"] >= MIN_MOVING else None


def over_seeds(row, kind, metric):
    """Mean over the seeds, with its 95 % confidence interval if there are several."""
    values = [metric_of(seed, kind, metric) for seed in row["seeds"]]
    known = [value for value in values if value is not None]
    return mean_of(known) if known else None


def seeds_text(value, digits=1):
    if value is None:
        return "–"
    if value["ci95"] is None:
        return percent(value["mean"], digits)
    return f"{percent(value['mean'], digits)} ± {percent(value['ci95'], digits)}"


def fraction_moving(row):
    return sum(seed["moving"] for seed in row["seeds"]) / sum(seed["points"] for seed in row["seeds"])


def bands_text(row, kind):
    """IoU by band, mean over the seeds."""
    bands = [[seed["kinds"][kind]["bands"][band] for seed in row["seeds"]] for band in range(len(BANDS))]
    return " / ".join(percent(mean_known(values), 0) for values in bands)


def rows_of(results, noise):
    return [row for row in results["rows"] if row["noise"] == noise]


def row_title(row):
    return ["KITTI" if row["set"] == "real" else row["set"], row["title"]]


def moving_tables(results):
    main_rows = [*rows_of(results, "jitter"), *rows_of(results, "given")]
    rows = [
        [
            *row_title(row),
            percent(fraction_moving(row), 1),
            *(seeds_text(over_seeds(row, kind, "iou")) for kind in KINDS),
            *(seeds_text(over_seeds(row, kind, "kept"), 2) for kind in ("live", "offline")),
            seeds_text(over_seeds(row, "offline", "pr"), 2),
            seeds_text(over_seeds(row, "offline", "rr")),
        ]
        for row in main_rows
    ]
    head = ["sensor", "run", "moving points, %", *(f"IoU {kind}" for kind in KINDS)]
    head += ["kept live", "kept offline", "PR offline", "RR offline"]
    found = {
        "moving": table(head, rows, left=2)
        + f"\n\n{made_by(results)}. Command of the last simulated map:\n\n"
        + f"    {rows_of(results, 'jitter')[-1]['seeds'][-1]['command']}"
    }
    rows = [
        [*row_title(row), *(bands_text(row, kind) for kind in KINDS)]
        for row in main_rows
        if over_seeds(row, "offline", "iou")
    ]
    found["moving-ranges"] = table(["sensor", "run", *KINDS], rows, left=2)
    rows = []
    for scene in SCENES:
        by_noise = [
            next(row for row in rows_of(results, noise) if row["set"] == "hdl-64e" and row["title"] == titled(scene))
            for noise in NOISES
        ]
        firsts = [row["seeds"][0] for row in by_noise]  # the seed that has all poses
        cells = [
            " / ".join(percent(metric_of(seed, kind, metric), digits) for seed in firsts)
            for metric, digits in (("iou", 1), ("kept", 2))
            for kind in ("live", "offline")
        ]
        rows.append([titled(scene), *cells])
    head = [" / ".join(NOISES), "IoU live", "IoU offline", "kept live", "kept offline"]
    found["moving-poses"] = table(head, rows)
    return found | missed_tables(results)


MOVING_NAMES = {"252": "cars", "253": "cyclists", "254": "pedestrians", "257": "buses", "258": "trucks"}
REASON_TITLES = {
    "no candidate": "the scan alone has another label than `nonground`, or a height below 0.1 m or above 4.5 m",
    "beyond 40 m": "beyond 40 m",
    "ends": "in the first 2 s of the run, or except live in the last 2 s",
    "other": "other",
}
MAX_CLASSES = 5


def missed_tables(results):
    """Sums over all runs with one sensor and one kind of poses."""
    seeds = [seed for row in rows_of(results, "jitter") if row["set"] == "hdl-64e" for seed in row["seeds"]]

    def sum_of(kind, part, key):
        return sum(seed["kinds"][kind][part].get(key, 0) for seed in seeds)

    def class_counts(kind, part):
        counts = {}
        for seed in seeds:
            for number, count in seed["kinds"][kind]["classes"][part].items():
                counts[number] = counts.get(number, 0) + count
        return counts

    moving = class_counts("offline", "moving")
    missed = {kind: class_counts(kind, "missed") for kind in KINDS}
    rows = [
        [
            MOVING_NAMES[number],
            percent(moving[number] / sum(moving.values()), 1),
            *(percent(1 - missed[kind].get(number, 0) / moving[number], 1) for kind in KINDS),
            *(percent(missed[kind].get(number, 0) / sum(missed[kind].values()), 1) for kind in ("live", "offline")),
        ]
        for number in MOVING_NAMES
        if moving.get(number)
    ]
    head = ["objects", "of all moving points, %", *(f"found {kind}, %" for kind in KINDS)]
    head += ["of the missed points, live, %", "offline, %"]
    found = {"missed-classes": table(head, rows)}
    rows = []
    for reason, title in REASON_TITLES.items():
        shares = [sum_of(kind, "missed_because", reason) / sum(missed[kind].values()) for kind in KINDS]
        rows.append([title, *(percent(share, 1) for share in shares)])
    found["missed-reasons"] = table(["first reason that applies", *(f"{kind}, %" for kind in KINDS)], rows)
    rows = []
    for kind in KINDS:
        false = class_counts(kind, "false")
        total = sum(false.values())
        ranked = sorted(false.items(), key=lambda entry: -entry[1])[:MAX_CLASSES]
        shares = [f"{results['classes'].get(number, number)} {percent(count / total, 0)}" for number, count in ranked]
        static = sum(seed["kinds"][kind]["static"] for seed in seeds)
        waiting = sum(seed["kinds"][kind]["false_waiting"] for seed in seeds)
        rows.append([kind, ", ".join(shares), percent(waiting / total, 0), percent(total / static, 3)])
    head = ["labels", "classes of the falsely marked points, %", "of objects that move at another time, %"]
    head.append("falsely marked, of the static points that are not ground, %")
    found["false-classes"] = table(head, rows, left=2)
    return found


# --- the image ------------------------------------------------------------------------------------------------

PANEL_SCENES = ("urban_street", "highway", "crossroads")
PANEL_SCAN = 45  # the middle of the run
PANEL_REACH = (45, 27)  # metres


def measure_image(study):
    """Draws simulated scans: real ones must not be published."""
    from run_metrics import draw_moving

    panels, rows = [], []
    for kind in ("live", "offline"):
        panels.append([])
        for scene in PANEL_SCENES:
            run = simulated("hdl-64e", 1, scene)
            study.simulate(run)
            mapped = study.path(study.map(run, kind, "jitter"))
            sequence = study.sequence(run)
            panels[-1].append((f"{titled(scene)}, {kind}", sequence, mapped, sequence.names[PANEL_SCAN]))
            rows.append({"scene": scene, "labels": kind, "scan": sequence.names[PANEL_SCAN]})
    draw_moving(panels, PANEL_REACH, IMAGE)
    return {"panels": rows}


# --- cost -----------------------------------------------------------------------------------------------------

PREFIXES = (250, 500, 1000, 2000)


def measure_cost(study):
    """Time and memory of the first scans of a circuit."""
    run = loop()
    study.simulate(run, noise="drift")
    rows = []
    for count in PREFIXES:
        show_progress(f"cost of {count} scans")
        directory = study.part_of(run, f"first-{count}", slice(0, count))
        output = f"$WORK/mapped/cost-{count}"
        shutil.rmtree(study.path(output), ignore_errors=True)
        command = (
            f"flagstone map {directory} --poses {directory}/poses.txt --sensor-height {run.height:g} --output {output}"
        )
        result, peak = call_measured(study, f"{command} --json")
        rows.append({"scans": count, "peak": peak, "command": command, **result})
    return {"rows": rows}


def call_measured(study, command):
    """The JSON output of a command, and the largest memory that its process used, in bytes."""
    text = command
    for name, directory in study.directories.items():
        text = text.replace(name, shlex.quote(directory))
    words = shlex.split(text)
    process = subprocess.Popen([study.flagstone, *words[1:]], cwd=ROOT, text=True, stdout=subprocess.PIPE)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"failed: {command}")
    return json.loads(output), usage.ru_maxrss * 1024


def cost_tables(results):
    rows, before = [], {"scans": 0, "seconds": 0.0}
    for row in results["rows"]:
        more = row["scans"] - before["scans"]
        rows.append(
            [
                str(row["scans"]),
                f"{row['path']:.0f}",
                f"{row['seconds']:.1f}",
                f"{1000 * (row['seconds'] - before['seconds']) / more:.1f}",
                *(f"{row[key] / 1e6:.1f}" for key in ("map_bytes", "vote_bytes")),
                f"{row['static_points'] / 1e6:.2f}",
                f"{row['peak'] / 1e6:.0f}",
            ]
        )
        before = row
    head = ["first scans", "path, m", "time, s", "ms per scan since the row before", "map, MB", "votes, MB"]
    head += ["static points, millions", "peak memory, MB"]
    command = results["rows"][-1]["command"]
    return {"cost": f"{table(head, rows, left=0)}\n\n{made_by(results)}. Command of the last row:\n\n    {command}"}


# --- CPU time per scan, live ----------------------------------------------------------------------------------

LIVE_SENSOR, LIVE_NOISE = "hdl-64e", "jitter"
LIVE_STEPS = {
    "segmentation": "segmentation",
    "level": "levelling",
    "moving_points": "moving points",
    "add_to_map": "map",
    "vote": "vote",
    "compare_with_map": "comparison with the map",
    "mapping": "all steps after the segmentation",
}


def measure_live(study):
    """CPU time of one thread per scan, with live labels."""
    rows = []
    for scene in SCENES:
        run = simulated(LIVE_SENSOR, 1, scene)
        study.simulate(run)
        command = f"scripts/benchmark live_map {run.directory} {study.poses(run, LIVE_NOISE)} {run.height:g}"
        show_progress(f"timing {run.name}")
        rows.append({"title": titled(scene), "command": command, **json.loads(study.call(command))})
    return {"rows": rows}


def live_tables(results):
    rows = [[row["title"], *(f"{row[step]:.1f}" for step in LIVE_STEPS)] for row in results["rows"]]
    command = results["rows"][-1]["command"]
    text = table(["run", *LIVE_STEPS.values()], rows)
    return {"live": f"{text}\n\n{made_by(results)}. Command of the last row:\n\n    {command}"}


# --- published results ----------------------------------------------------------------------------------------

MOS = "SemanticKITTI-MOS"
# Each value was found in its source: the repository of the authors, or the abstract.
PUBLISHED = [
    (
        "[LMNet](https://github.com/PRBonn/LiDAR-MOS/issues/47), Chen et al. 2021",
        "yes",
        f"{MOS}, test (11 to 21)",
        "IoU about 58, with semantic labels about 62",
    ),
    (
        "[4DMOS](https://github.com/PRBonn/4DMOS/issues/24), Mersch et al. 2022",
        "yes",
        f"{MOS}, validation (08) and test",
        "IoU 77.2 and 65.2",
    ),
    (
        "[MapMOS](https://github.com/PRBonn/MapMOS/issues/16), Mersch et al. 2023",
        "yes",
        f"{MOS}, validation (08) and test",
        "IoU 86.1 and 66.0",
    ),
    (
        "[Dynablox](https://arxiv.org/abs/2304.10049), Schmid et al. 2023",
        "no",
        'real scans "in typical robotic settings", live',
        "IoU 86",
    ),
    (
        "[ERASOR](https://github.com/LimHyungTae/ERASOR), Lim et al. 2021",
        "no",
        "SemanticKITTI, parts of 00, 01, 02, 05, 07, offline",
        "PR 91.7, 91.9, 81.1, 87.0, 92.0; RR 97.0, 94.6, 99.1, 97.9, 98.3",
    ),
]


def published_table():
    return table(["method", "learned", "scans", "result, %"], [list(row) for row in PUBLISHED], left=4)


# --- the study ------------------------------------------------------------------------------------------------

MEASUREMENTS = {
    "labels": measure_labels,
    "map": measure_map,
    "moving": measure_moving,
    "image": measure_image,
    "cost": measure_cost,
    "live": measure_live,
}
TABLES = {
    "labels": labels_tables,
    "map": map_tables,
    "moving": moving_tables,
    "cost": cost_tables,
    "live": live_tables,
}


def tables(results):
    """All tables of the results, by name."""
    found = {"published": published_table()}
    for name, make in TABLES.items():
        if name in results:
            found |= make(results[name])
    return found


def measure(options):
    study = Study(options.work, options.flagstone)
    study.identify()
    found = {}
    for name in options.only:
        begin = time.monotonic()
        found[name] = {**rounded(MEASUREMENTS[name](study)), "made_by": dict(study.made_by)}
        results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
        RESULTS.write_text(json.dumps(results | found, indent=1) + "\n")
        show_progress("")
        print(f"{name}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    return found


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, MEASUREMENTS)
