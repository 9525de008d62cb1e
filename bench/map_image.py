# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Draws docs/images/map.png: the ground of a simulated run, its static points and its moving points. Needs Matplotlib.

make map-image         # builds the command, simulates, maps, draws
make map-image IMAGE="--output map.png"
"""

import argparse
import io
import pathlib
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
PAGE, INK = "#ffffff", "#181c22"
LABEL_GROUND = 1
GROUND, LOW, HIGH, MOVING = (232, 226, 206), (92, 108, 140), (28, 34, 48), (226, 38, 38)
STATIC_POINT = np.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("height", "<f4"), ("label", "u1")])
RATE = 2  # scans per second
PER_METRE = 8  # pixels
SCANS = 180  # one lap of 720 m at 8 m/s, the default


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}: {' '.join(map(str, command))}\n{done.stderr.strip()}")
    print(done.stdout, end="", flush=True)


def static_points(path):
    data = path.read_bytes()
    end = b"end_header\n"
    return np.frombuffer(data, STATIC_POINT, offset=data.index(end) + len(end))


def moving_points(sequence, mapped):
    """Positions (N, 2) of the moving points of all scans in the world frame."""
    poses = np.loadtxt(mapped / "poses.txt").reshape(-1, 3, 4)
    found = [np.empty((0, 2))]
    for pose, scan in zip(poses, sorted((sequence / "velodyne").iterdir()), strict=True):
        points = np.fromfile(scan, np.float32).reshape(-1, 4)[:, :3]
        moving = np.load(mapped / "moving" / f"{scan.stem}.moving.npy") > 0
        found.append(points[moving] @ pose[:2, :3].T + pose[:2, 3])
    return np.concatenate(found)


def panel(static, moving, centre, width, height):
    """A bird's-eye view (height, width, 3) around a position, with x to the right and y up, as in ground.png."""
    is_ground = static["label"] == LABEL_GROUND
    image = np.full((height, width, 3), 255, np.uint8)

    def pixels(x, y):
        column = np.floor((x - centre[0]) * PER_METRE + width / 2).astype(int)
        row = np.floor(height / 2 - (y - centre[1]) * PER_METRE).astype(int)
        inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
        return row[inside], column[inside], inside

    ground, standing = static[is_ground], static[~is_ground]
    row, column, _ = pixels(ground["x"], ground["y"])
    for down, right in ((0, 0), (0, 1), (1, 0), (1, 1)):  # a voxel is larger than a pixel
        image[np.minimum(row + down, height - 1), np.minimum(column + right, width - 1)] = GROUND
    standing = standing[np.argsort(np.nan_to_num(standing["height"]), kind="stable")]  # the highest is drawn last
    row, column, inside = pixels(standing["x"], standing["y"])
    part = np.clip(np.nan_to_num(standing["height"][inside]) / 6, 0, 1)[:, np.newaxis]
    image[row, column] = (1 - part) * LOW + part * HIGH
    row, column, _ = pixels(moving[:, 0], moving[:, 1])
    image[row, column] = MOVING
    return image


def draw(mapped, static, moving, output):
    ground = Image.open(mapped / "ground.png").convert("RGB")
    height = 860
    ground = ground.resize((round(ground.width * height / ground.height), height), Image.Resampling.LANCZOS)
    width, top, gap = 760, 64, 20
    centre = np.loadtxt(mapped / "poses.txt")[SCANS // 4, [3, 7]]
    image = panel(static, moving, centre, width, height - top - 34)
    page = np.full((height, ground.width + gap + width, 3), 255, np.uint8)
    page[:, : ground.width] = np.asarray(ground)
    left = ground.width + gap
    page[top : top + image.shape[0], left:] = image
    dots = 100
    figure = pyplot.figure(figsize=(page.shape[1] / dots, height / dots), dpi=dots, facecolor=PAGE)

    def write(x, y, text, color=INK, **style):
        rgb = color if isinstance(color, str) else tuple(part / 255 for part in color)
        figure.text(x / page.shape[1], 1 - y / height, text, color=rgb, va="center", **style)

    write(left, 27, "Static and moving points of a part of the run", fontsize=12, fontweight="bold")
    write(left, 48, "one static point per voxel of 0.2 m; moving points of all scans", fontsize=8)
    for number, (name, color) in enumerate(
        [("static, 0 m", LOW), ("static, 6 m or higher", HIGH), ("ground", GROUND), ("moving", MOVING)]
    ):
        x = left + 165 * number
        page[height - 22 : height - 10, x : x + 24] = color
        write(x + 30, height - 16, name, fontsize=8)
    bar = 20 * PER_METRE
    page[46:49, -bar - 10 : -10] = (24, 28, 34)
    write(page.shape[1] - 10 - bar / 2, 36, "20 m", fontsize=8, ha="center")
    figure.figimage(page, 0, 0, origin="upper", zorder=-1)
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dots, facecolor=PAGE)
    # A palette reduces the file to a third.
    Image.open(drawn).convert("RGB").quantize(colors=256, dither=Image.Dither.NONE).save(output, optimize=True)


def main():
    parse = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parse.add_argument("--command", default=ROOT / "build" / "flagstone", help="path of flagstone")
    parse.add_argument("--output", type=pathlib.Path, default=ROOT / "docs" / "images" / "map.png")
    options = parse.parse_args()
    with tempfile.TemporaryDirectory(prefix="flagstone-map-") as name:
        directory = pathlib.Path(name)
        environment = ["--scene", "urban_street", "--length", 720, "--loop"]
        length = ["--rate", RATE, "--frames", SCANS]
        run(options.command, "simulate", *environment, *length, "--output", directory)
        sequence = directory / "sequences" / "00"
        mapped = directory / "map"
        poses = sequence / "poses.txt"
        run(options.command, "map", sequence, "--poses", poses, "--output", mapped)
        draw(mapped, static_points(mapped / "static.ply"), moving_points(sequence, mapped), options.output)
    print(f"{options.output}: {options.output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
