# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs the experiments of the Patchwork paper and writes the tables of docs/benchmarks/patchwork-paper.md.

    python3 bench/experiments.py run --work /tmp/experiments               # all of them, about ten minutes
    python3 bench/experiments.py run --work /tmp/experiments --only real   # some of them; the other results are kept
    python3 bench/experiments.py page                                      # tables from docs/results/experiments.json
    python3 bench/experiments.py check                                     # do the tables match the results?

`run` needs the command (build/flagstone), the real scans in FLAGSTONE_DATA and, for `external`, the packages that
bench/external_tools.py lists. It simulates five sequences of 200 scans in the work directory, or reuses those that
are there.
"""

import json
import re
import sys

from study import ROOT, Runs, main, paired, percent, percentage_points, rounded, show_progress, table, with_interval

PAGES = (ROOT / "docs" / "benchmarks" / "patchwork-paper.md",)
RESULTS = ROOT / "docs" / "results" / "experiments.json"
SCENES = ["flat_street", "steep_street", "parked_cars", "bushes_and_lawn", "bumpy_field"]
PRESETS = ["default", "reference", "paper"]

# Tables I and II of the paper. Table I: mean and standard deviation of precision and of recall, F1; all in percent.
# Table II: scans per second on an i7-7700K.
TABLE_1 = {
    "ransac": (88.16, 17.18, 91.26, 12.52, 89.7),
    "gpf": (95.84, 3.41, 79.57, 21.08, 87.0),
    "line_fit": (98.17, 1.47, 78.26, 9.29, 87.1),
    "cascaded": (91.16, 11.10, 68.95, 11.18, 78.5),
    "r_gpf": (66.94, 16.50, 93.34, 3.41, 78.0),
    "r_gpf+u": (91.88, 4.97, 92.84, 4.45, 92.4),
    "czm+u": (91.38, 5.33, 93.65, 4.10, 92.5),
    "czm+u+e": (92.89, 4.25, 93.08, 4.73, 93.0),
    "czm+u+e+f": (92.47, 4.26, 93.43, 4.63, 93.0),
}
TABLE_2 = {"line_fit": 58.96, "cascaded": 13.07, "gpf": 29.72, "r_gpf": 35.30, "patchwork": 43.97}

# What the paper claims about the rows of Table I: two rows, and the metric in which they are compared.
CLAIMS = [
    ("uprightness (U) raises the precision of R-GPF", "r_gpf+u", "r_gpf", "precision"),
    ("uprightness costs R-GPF little recall", "r_gpf+u", "r_gpf", "recall"),
    ("the concentric zone model (CZM) keeps recall that R-GPF + U loses", "czm+u", "r_gpf+u", "recall"),
    ("elevation (E) raises precision", "czm+u+e", "czm+u", "precision"),
    ("elevation costs some recall", "czm+u+e", "czm+u", "recall"),
    ("flatness (F) restores recall", "czm+u+e+f", "czm+u+e", "recall"),
    ("flatness costs little precision", "czm+u+e+f", "czm+u+e", "precision"),
    ("GPF has lower recall than the full method", "gpf", "czm+u+e+f", "recall"),
    ("CascadedSeg has lower recall than the full method", "cascaded", "czm+u+e+f", "recall"),
    ("LineFit has higher precision than the full method", "line_fit", "czm+u+e+f", "precision"),
    ("the full method has a higher F1 than one plane (RANSAC)", "czm+u+e+f", "ransac", "f1"),
]


# --- running -----------------------------------------------------------------------------------------------


class Runner:
    """Runs the command and keeps the results by name."""

    def __init__(self, work, flagstone):
        self.runs = Runs(work, flagstone)
        self.experiments = {}

    def call(self, command):
        show_progress(command)
        return self.runs.call(command)

    def evaluate(self, name, command):
        """Runs an `eval` or `sweep` command and keeps its results, with date and machine, under `name`."""
        show_progress(command)
        result = self.runs.evaluate_command(command)
        self.experiments[name] = {**self.runs.made_by, **result}
        return self.experiments[name]


def largest_gains(of, other, metric, count):
    """The scans with the largest differences between `of` and `other`."""
    before = {scan["scan"]: scan[metric] for scan in other["per_scan"]}
    ranked = sorted(of["per_scan"], key=lambda scan: before[scan["scan"]] - scan[metric])[:count]
    return [{"scan": s["scan"], "before": before[s["scan"]], "after": s[metric], "figure": metric} for s in ranked]


def by_name(experiment):
    return {method["name"]: method for method in experiment["methods"]}


def run_simulated(runner):
    for number, scene in enumerate(SCENES):
        runner.call(
            f"flagstone simulate --scene {scene} --frames 200 --seed 1 --output $WORK/simulated --sequence {number:02}"
        )
        for preset in PRESETS:
            found = runner.evaluate(
                f"{scene}/{preset}",
                f"flagstone eval $WORK/simulated --sequences {number:02} --protocol simulation"
                f" --methods table1 --preset {preset} --sensor-height 1.73",
            )
            rows = by_name(found)
            found["claims"] = [paired(rows[first], rows[second], metric) for _, first, second, metric in CLAIMS]
            found["gains"] = {
                "elevation": largest_gains(rows["czm+u+e"], rows["czm+u"], "precision", 3),
                "flatness": largest_gains(rows["czm+u+e+f"], rows["czm+u+e"], "recall", 3),
            }
        runner.evaluate(
            f"{scene}/gpf",
            f"flagstone eval $WORK/simulated --sequences {number:02} --protocol simulation"
            " --methods gpf --set gpf.noise_factor=inf --sensor-height 1.73",
        )


def run_real(runner):
    for protocol in ("patchwork", "patchwork++"):
        for preset in PRESETS:
            runner.evaluate(
                f"kitti/{protocol}/{preset}",
                f"flagstone eval $FLAGSTONE_DATA/kitti --protocol {protocol} --methods table1"
                f" --preset {preset} --sensor-height 1.73",
            )


def run_speed(runner):
    runner.evaluate(
        "speed",
        "flagstone eval $FLAGSTONE_DATA/kitti --protocol patchwork --methods table1,patchwork --speed",
    )


def run_external(runner):
    text = runner.call(f"{sys.executable} bench/external_tools.py $FLAGSTONE_DATA/kitti --output $WORK/external")
    labels = re.findall(r"--labels (\S+)", text.splitlines()[-1])
    arguments = " ".join(f"--labels {label}" for label in labels)
    arguments = arguments.replace(str(runner.runs.work), "$WORK")
    for protocol in ("patchwork", "patchwork++"):
        found = runner.evaluate(
            f"external/{protocol}",
            f"flagstone eval $FLAGSTONE_DATA/kitti --protocol {protocol} --methods patchwork --threads 1 {arguments}",
        )
        found["hz"] = {line.split()[0]: float(line.split()[1]) for line in text.splitlines() if " Hz mean" in line}


def run_sweeps(runner):
    runner.evaluate("sweep/kitti", "flagstone sweep $FLAGSTONE_DATA/kitti --protocol patchwork")
    runner.evaluate("sweep/simulated", "flagstone sweep $WORK/simulated --protocol simulation --every 10")


def run_shares(runner):
    runner.evaluate(
        "shares",
        "flagstone eval $WORK/simulated --protocol simulation --methods patchwork --threads 1",
    )


EXPERIMENTS = {
    "simulated": run_simulated,
    "real": run_real,
    "speed": run_speed,
    "external": run_external,
    "sweeps": run_sweeps,
    "shares": run_shares,
}


def measure(options):
    runner = Runner(options.work, options.flagstone)
    for name in options.only:
        EXPERIMENTS[name](runner)
    for experiment in runner.experiments.values():
        for method in experiment.get("methods", []):
            method.pop("per_scan")  # most of the size of the results
    known = json.loads(RESULTS.read_text())["experiments"] if RESULTS.exists() else {}
    return {"experiments": known | rounded(runner.experiments)}


# --- tables ------------------------------------------------------------------------------------------------


def origin(experiment):
    return (
        f"{experiment['scans']} scans, protocol `{experiment['protocol']}`, {experiment['date']},"
        f" {experiment['machine']}:\n\n    {experiment['command']}"
    )


def table_1(results, name):
    """The values of the paper next to those measured here."""
    experiment = results["experiments"][name]
    rows = []
    for method in experiment["methods"]:
        paper = TABLE_1[method["name"]]
        rows.append(
            [
                method["title"],
                *(f"{value:.2f}" for value in paper[:4]),
                f"{paper[4]:.1f}",
                percent(method["precision"]["mean"]),
                percent(method["precision"]["std"]),
                percent(method["recall"]["mean"]),
                percent(method["recall"]["std"]),
                with_interval(method["f1"]),
            ]
        )
    head = ["", "paper: P", "σ", "R", "σ", "F1", "here: P", "σ", "R", "σ", "F1 ± 95 %"]
    return table(head, rows) + "\n\n" + origin(experiment)


def f1_by_preset(results, columns):
    """F1 of every row of Table I: one column per protocol and preset."""
    experiments = [results["experiments"][name] for name, _ in columns]
    rows = []
    for m, method in enumerate(experiments[0]["methods"]):
        rows.append([method["title"], *(with_interval(e["methods"][m]["f1"]) for e in experiments)])
    lines = table([""] + [title for _, title in columns], rows)
    commands = "\n".join(f"    {e['command']}" for e in experiments)
    first = experiments[0]
    return f"{lines}\n\n{first['scans']} scans, {first['date']}, {first['machine']}:\n\n{commands}"


def scene_table(results, scene, preset="reference"):
    experiment = results["experiments"][f"{scene}/{preset}"]
    rows = [
        [
            method["title"],
            percent(method["precision"]["mean"]),
            percent(method["precision"]["std"]),
            percent(method["recall"]["mean"]),
            percent(method["recall"]["std"]),
            with_interval(method["f1"]),
            percent(method["by_area"]["f1"]),
        ]
        for method in experiment["methods"]
    ]
    head = ["", "P", "σ", "R", "σ", "F1 ± 95 %", "F1 per BEV cell"]
    return table(head, rows) + "\n\n" + origin(experiment)


def claims_table(results, preset):
    rows = []
    for c, (claim, first, second, metric) in enumerate(CLAIMS):
        column = {"precision": 0, "recall": 2, "f1": 4}[metric]
        rows.append(
            [
                claim,
                "F1" if metric == "f1" else metric,
                f"{TABLE_1[first][column] - TABLE_1[second][column]:+.2f}",
                *(percentage_points(results["experiments"][f"{scene}/{preset}"]["claims"][c]) for scene in SCENES),
            ]
        )
    head = ["claim", "metric", "paper", *(scene.replace("_", " ") for scene in SCENES)]
    return table(head, rows, left=2)


def gpf_table(results):
    """GPF with and without the removal of low points, the first step of its public implementation."""
    rows = []
    for title, name in (("with", "reference"), ("without", "gpf")):
        row = [f"{title} removal of low points"]
        for scene in SCENES:
            found = by_name(results["experiments"][f"{scene}/{name}"])["gpf"]
            row.append(" / ".join(percent(found[figure]["mean"]) for figure in ("precision", "recall")))
        rows.append(row)
    head = ["GPF: P / R"] + [scene.replace("_", " ") for scene in SCENES]
    command = results["experiments"][f"{SCENES[0]}/gpf"]["command"]
    return f"{table(head, rows)}\n\nCommand for the second row and the first scene:\n\n    {command}"


def gains_table(results, preset):
    rows = []
    for term, scene in (("elevation", "parked_cars"), ("flatness", "steep_street")):
        for gain in results["experiments"][f"{scene}/{preset}"]["gains"][term]:
            rows.append(
                [
                    f"{term}, {scene.replace('_', ' ')}",
                    f"`{gain['scan']}`",
                    gain["figure"],
                    percent(gain["before"]),
                    percent(gain["after"]),
                ]
            )
    return table(["term, scene", "scan", "metric", "without", "with"], rows)


def sweep_table(results, name):
    experiment = results["experiments"][name]
    bins = list(dict.fromkeys(cell["values"][0] for cell in experiment["cells"]))
    angles = list(dict.fromkeys(cell["values"][1] for cell in experiment["cells"]))
    cells = {tuple(cell["values"]): cell for cell in experiment["cells"]}

    def text(cell):
        return " / ".join(percent(cell[figure]["mean"], 1) for figure in ("precision", "recall", "f1"))

    rows = [[size, *(text(cells[size, angle]) for angle in angles)] for size in bins]
    head = ["bins N_r × N_θ"] + [f"{angle}°" for angle in angles]
    return f"{table(head, rows)}\n\n{experiment['winner']}\n\n{origin(experiment)}"


def speed_table(results):
    experiment = results["experiments"]["speed"]
    rows = [
        [
            method["title"],
            f"{TABLE_2[method['name']]:.2f}" if method["name"] in TABLE_2 else "–",
            f"{method['hz']:.1f}",
            f"{method['hz_slowest_1_percent']:.1f}",
        ]
        for method in experiment["methods"]
    ]
    head = ["", "paper, Hz", "here, Hz", "slowest 1 %, Hz"]
    return table(head, rows) + "\n\n" + origin(experiment)


def external_table(results):
    one, other = (results["experiments"][f"external/{p}"] for p in ("patchwork", "patchwork++"))
    rows = []
    for m, method in enumerate(one["methods"]):
        hz = one["hz"].get(method["name"])
        rows.append(
            [
                method["title"],
                with_interval(method["f1"]),
                with_interval(other["methods"][m]["f1"]),
                percent(method["by_area"]["f1"]),
                f"{hz:.1f}" if hz else "–",
            ]
        )
    head = ["", "F1, `patchwork`", "F1, `patchwork++`", "F1 per BEV cell, `patchwork`", "Hz"]
    command = "    python3 bench/external_tools.py $FLAGSTONE_DATA/kitti --output $WORK/external"
    return (
        f"{table(head, rows)}\n\n{one['scans']} scans, {one['date']}, {one['machine']}:\n\n"
        f"{command}\n    {one['command']}\n    {other['command']}"
    )


def shares_table(results):
    experiment = results["experiments"]["shares"]
    time = experiment["milliseconds"]
    scans = experiment["scans"]
    whole = sum(time.values())
    rows = [
        [name, f"{value / scans:.2f}", f"{100 * value / whole:.0f}"]
        for name, value in zip(("reading", "segmenting", "scoring"), time.values())
    ]
    return table(["", "ms per scan", "%"], rows) + "\n\n" + origin(experiment)


def tables(results):
    kitti = [
        (f"kitti/{p}/{preset}", f"`{p}`, preset `{preset}`") for p in ("patchwork", "patchwork++") for preset in PRESETS
    ]
    found = {
        "table-1": table_1(results, "kitti/patchwork/reference"),
        "table-1-presets": f1_by_preset(results, kitti),
        "claims-reference": claims_table(results, "reference"),
        "claims-paper": claims_table(results, "paper"),
        "gains": gains_table(results, "reference"),
        "gpf": gpf_table(results),
        "figure-5-kitti": sweep_table(results, "sweep/kitti"),
        "figure-5-simulated": sweep_table(results, "sweep/simulated"),
        "table-2": speed_table(results),
        "external": external_table(results),
        "shares": shares_table(results),
    }
    for scene in SCENES:
        found[f"scene-{scene}"] = scene_table(results, scene)
    return found


if __name__ == "__main__":
    main(__doc__, PAGES, RESULTS, tables, measure, EXPERIMENTS)
