# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""F1 of scans with a fault, before and after the protection against it. Measuring wants NumPy.

Scans are those of one sensor in every scene. Under the protocol `simulation` every point counts, so that a
ghost that is called ground is an error.
"""

import importlib.util
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import typing

from flagstone_runs import ROOT, show_progress
from tables import percent, table
from worlds_scans import METHODS, SCENES, SENSORS, simulate

SENSOR = "hdl-64e"
HEIGHT = SENSORS[SENSOR]
TILT = math.radians(20)
PEER = "pypatchworkpp-patchworkpp"

# What makes points below the ground noise, switched off.
WITHOUT_NOISE_RULES = (
    "--set patchwork.noise_depth=inf --set patchwork.noise_margin=inf"
    " --set surface.noise_depth=1000 --set surface.point.noise_depth=1000"
)


class Fault(typing.NamedTuple):
    """A fault, and the options of `flagstone eval` without and with the protection; None where it is always on."""

    name: str
    spoil: (
        typing.Callable | None
    )  # (points (N, 4), random) -> the same; None for a simulated sequence of its own
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
    has_peer = importlib.util.find_spec("pypatchworkpp") is not None
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
            if has_peer:
                row["peer"] = f1_of_peer(runs, folder, pathlib.Path(place) / "peers")
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


def f1_of_peer(runs, folder, labels):
    """None if it does not survive the scans."""
    done = subprocess.run(
        [sys.executable, ROOT / "bench" / "peers.py", folder, "--output", labels, "--peers", PEER],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    if done.returncode != 0:
        return None
    command = f"flagstone eval {folder} --protocol simulation --methods none --labels {PEER}={labels / PEER}"
    return mean_f1(runs.evaluate_command(command)["methods"][0])


def faults_tables(results):
    rows = []
    for row in results["rows"]:
        cells = [
            percent(row[part][method] if row[part] else None)
            for method in METHODS
            for part in ("before", "after")
        ]
        peer = percent(row["peer"]) if row.get("peer") is not None else "–"
        rows.append([row["fault"], row["protection"], *cells, peer])
    head = [
        "fault",
        "protection",
        *(text for method in METHODS for text in (f"`{method}` before", "after")),
        "pypatchworkpp",
    ]
    return {"faults": table(head, rows, left=2)}
