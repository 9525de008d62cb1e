# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The scans that the studies of the method `surface` stand on, and `flagstone eval` over them."""

import os
import pathlib
import re
import sys
import typing

from flagstone_runs import ROOT, Runs, show_progress

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
            (
                "$FLAGSTONE_DATA/nuscenes --sensor-height 1.84 --protocol $FLAGSTONE_DATA/nuscenes/classes.json",
            ),
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
        arguments = (
            f"$WORK/simulated --sequences {number:02} --every 10 --sensor-height 1.73 --protocol simulation"
        )
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
        """The settings of `surface` but for the sensor's height: key -> (value, meaning with unit)."""
        import tomllib  # from Python 3.11 on; tables are written and checked with less

        overriding = "".join(f" --set {setting}" for setting in self.settings)
        text = self.call(f"flagstone config --method surface{overriding}")
        values = flat(tomllib.loads(text))
        meanings = dict(zip(values, re.findall(r"^\w+ = \S+  # (.*)$", text, flags=re.MULTILINE)))
        values.pop("sensor_height")
        return {key: (value, meanings[key]) for key, value in values.items()}


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
