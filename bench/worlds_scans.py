# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The simulated worlds: every scene seen by every sensor, as sequences that `flagstone eval` reads."""

import statistics

from flagstone_runs import show_progress

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
