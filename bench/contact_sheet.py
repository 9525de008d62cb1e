# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Draws docs/images/worlds.png: bird's-eye views of every scene by three sensors, coloured by class. Needs Matplotlib.

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
    sys.exit("Matplotlib is not installed (Debian: apt-get install python3-matplotlib)")
matplotlib.use("Agg")
from matplotlib import pyplot  # after the backend is selected
from PIL import Image  # a dependency of Matplotlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
SENSORS = ["hdl-64e", "vlp-16", "os0-128"]

PANEL_COLOR, PAGE_COLOR, INK = "#101318", "#ffffff", "#181c22"
# Name, colour and SemanticKITTI classes, in drawing order.
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
    ("vehicle", "#5b8ff0", (10, 13, 18, 20, 252, 257, 258, 259)),
    ("person, rider", "#ff5050", (30, 31, 253, 254)),
    ("ghost point", "#ff30ff", (1,)),
]


def rgb(color):
    return np.array([int(color[i : i + 2], 16) for i in (1, 3, 5)], np.uint8)


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}: {' '.join(map(str, command))}\n{done.stderr.strip()}")
    return done.stdout


def scene_names(command):
    """The scenes that `flagstone simulate --help` lists."""
    listed = run([command, "simulate", "--help"]).split("Scenes:")[1]
    return re.findall(r"^  ([a-z_]+) +\S", listed.split("\n\n")[0], re.MULTILINE)


def simulated_scan(command, scene, sensor, options):
    """Points (N, 4) and classes of one frame."""
    with tempfile.TemporaryDirectory(prefix="flagstone-sheet-") as directory:
        arguments = ["--scene", scene, "--frames", options.frame + 1, "--seed", options.seed, "--output", directory]
        run([command, "simulate", *arguments, "--sensor", sensor])
        sequence = pathlib.Path(directory) / "sequences" / "00"
        points = np.fromfile(sequence / "velodyne" / f"{options.frame:06}.bin", np.float32).reshape(-1, 4)
        classes = np.fromfile(sequence / "labels" / f"{options.frame:06}.label", np.uint32) & 0xFFFF
    return points, classes


def panel(points, classes, size, extent):
    """An image (size, size, 3) with x (forward) up and y (left) to the left, as in `flagstone segment --image`."""
    image = np.empty((size, size, 3), np.uint8)
    image[:] = rgb(PANEL_COLOR)
    column = np.floor((extent - points[:, 1]) / (2 * extent) * size).astype(int)
    row = np.floor((extent - points[:, 0]) / (2 * extent) * size).astype(int)
    inside = (column >= 0) & (column < size) & (row >= 0) & (row < size)
    dot = 1 if len(points) > 40_000 else 2  # pixels; larger in sparse scans
    overhead = (
        points[:, 2] > 1
    )  # higher than 1 m above the sensor; drawn first, because ceilings and crowns would hide the ground
    for layer in (overhead, ~overhead):
        for _, color, ids in KINDS:
            chosen = inside & layer & np.isin(classes, ids)
            for down in range(dot):
                for right in range(dot):
                    at = np.minimum(row[chosen] + down, size - 1), np.minimum(column[chosen] + right, size - 1)
                    image[at] = rgb(color)
    middle = size // 2  # position of the sensor
    image[middle - 1 : middle + 2, middle - 3 : middle + 4] = 255
    image[middle - 3 : middle + 4, middle - 1 : middle + 2] = 255
    return image


def draw(rows, options):
    """Writes the sheet. `rows` are pairs of scene and panels; each column of the sheet has an equal number of rows."""
    size, gap, left, top = options.panel, 4, 26, 62
    columns, deep = options.columns, -(-len(rows) // options.columns)
    across = left + len(SENSORS) * (size + gap) + 10
    width, height = columns * across, top + deep * (size + gap) + 8
    dots = 100
    figure = pyplot.figure(figsize=(width / dots, height / dots), dpi=dots, facecolor=PAGE_COLOR)
    page = np.full((height, width, 3), 255, np.uint8)

    def write(x, y, text, **style):
        figure.text(x / width, 1 - y / height, text, color=style.pop("color", INK), ha="center", va="center", **style)

    for index, (scene, panels) in enumerate(rows):
        x, y = (index // deep) * across + left, top + (index % deep) * (size + gap)
        write(x - 13, y + size / 2, scene, rotation=90, fontsize=10, fontweight="bold")
        for number, image in enumerate(panels):
            begin = x + number * (size + gap)
            page[y : y + size, begin : begin + size] = image
            if index % deep == 0:
                write(begin + size / 2, top - 12, SENSORS[number], fontsize=10, fontweight="bold")
    for number, (name, color, _) in enumerate(KINDS):
        x = left + (number + 0.5) * (width - left) / len(KINDS)
        page[20:28, int(x) - 20 : int(x) + 20] = rgb(color)
        write(x, 10, name, fontsize=8)
    figure.figimage(page, 0, 0, origin="upper")
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dots, facecolor=PAGE_COLOR)
    # A palette reduces the file to a quarter.
    sheet = Image.open(drawn).convert("RGB").quantize(colors=32, dither=Image.Dither.NONE)
    sheet.save(options.output, optimize=True)


def main():
    parse = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parse.add_argument("--command", default=ROOT / "build" / "flagstone", help="path of flagstone")
    parse.add_argument("--scenes", nargs="+", help="default: all")
    parse.add_argument("--seed", type=int, default=1)
    parse.add_argument("--frame", type=int, default=4, help="frame of the simulated run, 0 to 9")
    parse.add_argument("--panel", type=int, default=300, help="width of a panel, pixels")
    parse.add_argument("--columns", type=int, default=2, help="number of columns")
    parse.add_argument(
        "--extent", type=float, default=40, help="distance from the sensor to the edge of a panel, metres"
    )
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
