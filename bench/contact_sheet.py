# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Draws docs/images/worlds.png: every scene as three sensors see it, from above, by true class. Needs Matplotlib.

make contact-sheet         # builds the command, simulates, draws
make contact-sheet SHEET="--scenes park forest_track --columns 1 --panel 600 --output sheet.png"
"""

import argparse
import io
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import matplotlib
    import numpy as np
except ImportError:
    sys.exit("no Matplotlib for the pictures: install it (Debian: apt-get install python3-matplotlib)")
matplotlib.use("Agg")
from matplotlib import pyplot  # now that what draws is chosen
from PIL import Image  # Matplotlib writes pictures with it

ROOT = pathlib.Path(__file__).resolve().parent.parent
SENSORS = ["hdl-64e", "vlp-16", "os0-128"]

PANEL_COLOR, PAGE_COLOR, INK = "#101318", "#ffffff", "#181c22"
# Name, colour and SemanticKITTI ids of what shares them, in the order in which they are drawn.
KINDS = [
    ("road", "#8b8fa8", (40, 44)),
    ("sidewalk", "#c98fc0", (48,)),
    ("marking", "#f2f2f2", (60,)),
    ("other ground", "#b08a5a", (49,)),
    ("terrain", "#6f9a4c", (72,)),
    ("vegetation", "#1f7a45", (70,)),
    ("trunk", "#a5562e", (71,)),
    ("building, structure", "#e0c341", (50, 52)),
    ("fence", "#e08a35", (51,)),
    ("pole, sign", "#f2e8a0", (80, 81)),
    ("other object", "#3fc9c9", (99,)),
    ("vehicle", "#5b8ff0", (10, 11, 13, 15, 18, 20)),
    ("person, rider", "#ff5050", (30, 31, 32)),
    ("ghost", "#ff30ff", (1,)),
]


def rgb(color):
    return np.array([int(color[i : i + 2], 16) for i in (1, 3, 5)], np.uint8)


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}: {' '.join(map(str, command))}\n{done.stderr.strip()}")
    return done.stdout


def scene_names(command):
    """As `flagstone simulate --help` lists them."""
    listed = run([command, "simulate", "--help"]).split("Scenes:")[1]
    return re.findall(r"^  ([a-z_]+) +\S", listed.split("\n\n")[0], re.MULTILINE)


def simulated_scan(command, scene, sensor, options):
    """Points (N, 4) and classes of one frame."""
    with tempfile.TemporaryDirectory(prefix="flagstone-sheet-") as place:
        arguments = ["--scene", scene, "--frames", options.frame + 1, "--seed", options.seed, "--output", place]
        run([command, "simulate", *arguments, "--sensor", sensor])
        sequence = pathlib.Path(place) / "sequences" / "00"
        points = np.fromfile(sequence / "velodyne" / f"{options.frame:06}.bin", np.float32).reshape(-1, 4)
        classes = np.fromfile(sequence / "labels" / f"{options.frame:06}.label", np.uint32) & 0xFFFF
    return points, classes


def panel(points, classes, size, extent):
    """A picture (size, size, 3): x, forward, up and y, left, to the left, as `flagstone segment --image` does."""
    picture = np.empty((size, size, 3), np.uint8)
    picture[:] = rgb(PANEL_COLOR)
    column = np.floor((extent - points[:, 1]) / (2 * extent) * size).astype(int)
    row = np.floor((extent - points[:, 0]) / (2 * extent) * size).astype(int)
    inside = (column >= 0) & (column < size) & (row >= 0) & (row < size)
    dot = 1 if len(points) > 40_000 else 2  # pixels: few points shall be seen as well
    overhead = points[:, 2] > 1  # metres above the sensor: ceilings and crowns would hide the ground
    for layer in (overhead, ~overhead):
        for _, color, ids in KINDS:
            chosen = inside & layer & np.isin(classes, ids)
            for down in range(dot):
                for right in range(dot):
                    at = np.minimum(row[chosen] + down, size - 1), np.minimum(column[chosen] + right, size - 1)
                    picture[at] = rgb(color)
    middle = size // 2  # where the sensor is
    picture[middle - 1 : middle + 2, middle - 3 : middle + 4] = 255
    picture[middle - 3 : middle + 4, middle - 1 : middle + 2] = 255
    return picture


def draw(rows, options):
    """rows: of (scene, panels); as many beside each other as there are columns."""
    size, gap, left, top = options.panel, 4, 26, 62
    columns, deep = options.columns, -(-len(rows) // options.columns)
    across = left + len(SENSORS) * (size + gap) + 10
    width, height = columns * across, top + deep * (size + gap) + 8
    dots = 100
    figure = pyplot.figure(figsize=(width / dots, height / dots), dpi=dots, facecolor=PAGE_COLOR)
    page = np.full((height, width, 3), 255, np.uint8)

    def write(x, y, text, **how):
        figure.text(x / width, 1 - y / height, text, color=how.pop("color", INK), ha="center", va="center", **how)

    for index, (scene, panels) in enumerate(rows):
        x, y = (index // deep) * across + left, top + (index % deep) * (size + gap)
        write(x - 13, y + size / 2, scene, rotation=90, fontsize=10, fontweight="bold")
        for number, picture in enumerate(panels):
            begin = x + number * (size + gap)
            page[y : y + size, begin : begin + size] = picture
            if index % deep == 0:
                write(begin + size / 2, top - 12, SENSORS[number], fontsize=10, fontweight="bold")
    for number, (name, color, _) in enumerate(KINDS):
        x = left + (number + 0.5) * (width - left) / len(KINDS)
        page[20:28, int(x) - 20 : int(x) + 20] = rgb(color)
        write(x, 10, name, fontsize=8)
    figure.figimage(page, 0, 0, origin="upper")
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dots, facecolor=PAGE_COLOR)
    # A palette: a quarter of the bytes.
    picture = Image.open(drawn).convert("RGB").quantize(colors=32, dither=Image.Dither.NONE)
    picture.save(options.output, optimize=True)


def main():
    parse = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parse.add_argument("--command", default=ROOT / "build" / "flagstone", help="the program flagstone")
    parse.add_argument("--scenes", nargs="+", help="default: all there are")
    parse.add_argument("--seed", type=int, default=1)
    parse.add_argument("--frame", type=int, default=4, help="of the drive, 0 to 9")
    parse.add_argument("--panel", type=int, default=300, help="width of a panel, pixels")
    parse.add_argument("--columns", type=int, default=2, help="scenes beside each other")
    parse.add_argument("--extent", type=float, default=40, help="from the sensor to a panel's edge, metres")
    parse.add_argument("--output", type=pathlib.Path, default=ROOT / "docs" / "images" / "worlds.png")
    options = parse.parse_args()
    rows = []
    for scene in options.scenes or scene_names(options.command):
        scans = [simulated_scan(options.command, scene, sensor, options) for sensor in SENSORS]
        rows.append((scene, [panel(*scan, options.panel, options.extent) for scan in scans]))
        print(f"{scene}: {', '.join(f'{len(points):,}' for points, _ in scans)} points", flush=True)
    draw(rows, options)
    print(f"{options.output}: {options.output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
