# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Draws the figures of docs/explanation/surface.md from simulated scans. Needs Matplotlib.

    make surface-figures       # builds surface_stages and writes docs/images/surface-*.png

The program surface_stages (bench/performance) writes the results of all stages.
"""

import argparse
import io
import json
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
from matplotlib import patches as shapes  # after the backend is selected
from matplotlib import pyplot
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from PIL import Image  # a dependency of Matplotlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"

INK, GREY, PALE, ACCEPTED = "#181c22", "#808890", "#d4d8dd", "#e8953c"
GROUND, OBSTACLE, COARSE, REFINED, BOUND = "#d9a400", "#5f6b78", "#c2477f", "#1f6fb4", "#d9601a"
# Low to high ground, light enough for contour lines and shading.
HEIGHTS = ["#a9c8d8", "#cfe3d4", "#e9edc9", "#f0dfb4", "#e2c199", "#cda58a"]
STATUSES = {
    "ground": ("#7db46c", "ground"),
    "mixed": ("#e8953c", "mixed"),
    "not_upright": ("#9b6fb0", "not_upright"),
    "off_surface": ("#d04848", "off_surface"),
    "too_high": ("#8a5a3c", "too_high"),
    "no_plane": ("#9aa3ad", "no_plane"),
    "too_few_points": ("#cfd4da", "too_few_points"),
}

# Columns of points.npy.
X, Y, Z, CLASS, LABEL, HEIGHT = range(6)


class Stages:
    """The results of surface_stages for one scan."""

    def __init__(self, program, scene, seed):
        with tempfile.TemporaryDirectory(prefix="flagstone-stages-") as name:
            done = subprocess.run([program, scene, str(seed), name])
            if done.returncode != 0:
                sys.exit(f"exit code {done.returncode}: {program} {scene} {seed}")
            directory = pathlib.Path(name)
            self.about = json.loads((directory / "stages.json").read_text())
            self.patches = json.loads((directory / "patches.json").read_text())
            self.points = np.load(directory / "points.npy")
            self.truth = np.load(directory / "truth.npy")
            levels = len(self.about["grids"])
            # Heights and confidences of the finest grid, by number of refinement levels.
            self.grids = [np.load(directory / f"grid-{level}.npy") for level in range(levels)]
            # Corrections, weights and numbers of points, by level.
            self.observed = [np.load(directory / f"observed-{level}.npy") for level in range(levels - 1)]

    def cell(self, levels):
        return self.about["grids"][levels]["cell"]

    def half_width(self, levels):
        return self.cell(levels) * self.about["grids"][levels]["width"] / 2

    def height(self, levels, x, y):
        """Height of the surface after `levels` levels: bilinear, from the finest grid that covers (x, y)."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        found = np.full(x.shape, np.nan)
        for level in range(levels + 1):
            extent, cell = self.half_width(level), self.cell(level)
            inside = (np.abs(x) <= extent) & (np.abs(y) <= extent)
            found[inside] = bilinear(self.grids[level][0], extent, cell, x[inside], y[inside])
        return found

    def squares(self, x, y):
        """The squares between four cell centres that contain positions: level, column and row."""
        found = np.zeros((3, len(x)), int)
        for level in range(len(self.grids)):
            extent, cell = self.half_width(level), self.cell(level)
            centres = extent - cell / 2
            inside = (np.abs(x) <= centres) & (np.abs(y) <= centres)
            found[0, inside] = level
            for axis, value in enumerate((x, y), start=1):
                found[axis, inside] = np.floor((value[inside] + extent) / cell - 0.5)
        return found.tolist()


def bilinear(grid, extent, cell, x, y):
    last = len(grid) - 1
    column, row = (np.clip((value + extent) / cell - 0.5, 0, last) for value in (x, y))
    left, low = (np.minimum(value.astype(int), last - 1) for value in (column, row))
    right_weight, high_weight = column - left, row - low
    near = grid[low, left] * (1 - right_weight) + grid[low, left + 1] * right_weight
    far = grid[low + 1, left] * (1 - right_weight) + grid[low + 1, left + 1] * right_weight
    return near * (1 - high_weight) + far * high_weight


# --- drawing -----------------------------------------------------------------------------------------------


def top_view(axes, extent, title):
    """Axes with x (forward) to the right and y (left) up."""
    axes.set(xlim=(-extent, extent), ylim=(-extent, extent), aspect="equal", title=title)
    axes.set(xlabel="x, m", ylabel="y, m")
    axes.plot(0, 0, "+", color=INK, markersize=8)


def draw_patches(stages):
    figure, axes = pyplot.subplots(figsize=(10, 5.2), layout="constrained")
    points = stages.points
    axes.scatter(points[:, X], points[:, Y], s=0.15, color=INK, linewidths=0, rasterized=True)
    counts = dict.fromkeys(STATUSES, 0)
    for patch in stages.patches:
        size, status = patch["size"], patch["verdict"]
        counts[status] += 1
        corner = (patch["x"] - size / 2, patch["y"] - size / 2)
        face = shapes.Rectangle(
            corner,
            size,
            size,
            facecolor=STATUSES[status][0],
            alpha=0.65,
            edgecolor="white",
            linewidth=0.8,
            zorder=0,
        )
        axes.add_patch(face)
    top_view(axes, 48, "Patches of 4 and 8 m, by status")
    axes.set(ylim=(-26, 34))
    handles = [
        shapes.Patch(facecolor=color, alpha=0.65, label=f"{text} ({counts[name]})")
        for name, (color, text) in STATUSES.items()
        if counts[name] > 0
    ]
    axes.legend(
        handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False, title="status (number of patches)"
    )
    return figure


def shaded(grid, cell, exaggeration):
    """Brightness from 0 to 1, with light from the upper left."""
    slope_y, slope_x = np.gradient(grid * exaggeration, cell)
    light = np.array([-1, 1, 1.6]) / np.linalg.norm([-1, 1, 1.6])
    brightness = (light[2] - slope_x * light[0] - slope_y * light[1]) / np.sqrt(1 + slope_x**2 + slope_y**2)
    return np.clip(brightness, 0, 1)


def draw_coarse(stages):
    extent = 56
    figure, axes = pyplot.subplots(1, 2, figsize=(12, 5.4), layout="constrained")
    heights, confidences = stages.grids[0]
    half = stages.half_width(0)
    bounds = (-half, half, -half, half)
    image = axes[0].imshow(
        np.ma.masked_invalid(heights),
        origin="lower",
        extent=bounds,
        cmap=height_colors(),
        **height_limits(heights, half, extent),
    )
    centers = np.linspace(-half + 1, half - 1, len(heights))
    axes[0].contour(centers, centers, heights, levels=np.arange(-12, 12, 0.5), colors=INK, linewidths=0.4)
    top_view(axes[0], extent, "Coarse surface, contour lines every 0.5 m")
    figure.colorbar(image, ax=axes[0], label="height in the sensor frame, m", shrink=0.85)
    image = axes[1].imshow(confidences, origin="lower", extent=bounds, cmap="Blues", vmin=0, vmax=1)
    top_view(axes[1], extent, "Confidence of the coarse surface; dots: accepted patches")
    accepted = [patch["mean"] for patch in stages.patches if patch["verdict"] == "ground"]
    axes[1].plot([mean[0] for mean in accepted], [mean[1] for mean in accepted], ".", color=ACCEPTED, markersize=4)
    figure.colorbar(image, ax=axes[1], shrink=0.85)
    return figure


def height_colors():
    return LinearSegmentedColormap.from_list("heights", HEIGHTS)


def height_limits(heights, half, extent):
    """The 1st and 99th percentile of the heights within the extent."""
    edge = int((half - extent) / (2 * half) * len(heights)) if half > extent else 0
    seen = heights[edge : len(heights) - edge, edge : len(heights) - edge]
    low, high = np.nanpercentile(seen, [1, 99])
    return {"vmin": low, "vmax": high}


def draw_levels(stages):
    levels = len(stages.observed)
    figure, axes = pyplot.subplots(1, levels, figsize=(3.3 * levels, 4.1), layout="constrained")
    weight_of_bound = stages.about["lower_bound_weight"]
    for level, (panel, observed) in enumerate(zip(axes, stages.observed)):
        _, weights, points = observed
        kind = np.where(weights > 0, 2, np.where(points > 0, 1, 0))
        kind[np.isclose(weights, weight_of_bound)] = 3  # observations have weights of at least 0.3
        half = stages.half_width(level + 1)
        colors = ListedColormap(["white", PALE, REFINED, BOUND])
        panel.imshow(
            kind,
            origin="lower",
            extent=(-half, half, -half, half),
            cmap=colors,
            vmin=0,
            vmax=3,
            interpolation="none",
        )
        top_view(panel, min(half, 48), f"cells of {stages.cell(level + 1):g} m")
        if level > 0:
            panel.set_ylabel("")
    handles = [
        shapes.Patch(facecolor=REFINED, label="observation of the ground"),
        shapes.Patch(facecolor=BOUND, label="obstacle: lower bound"),
        shapes.Patch(facecolor=PALE, label="at least three points, no observation"),
    ]
    figure.get_layout_engine().set(rect=(0, 0.09, 1, 0.91))
    figure.legend(handles=handles, loc="lower center", ncols=3, frameon=False)
    return figure


def profile_of(axes, stages, where, across, limits, half_slice):
    """Draws a slice along y at x = `where`: points, surface and true ground."""
    levels = len(stages.grids) - 1
    y = np.arange(*across, 0.02)
    points = stages.points
    near = (np.abs(points[:, X] - where) < half_slice) & (points[:, Y] > across[0]) & (points[:, Y] < across[1])
    cut = points[near]
    refined, coarse = (stages.height(level, where, y) for level in (levels, 0))
    truth_extent, truth_cell = stages.about["truth"]["extent"], stages.about["truth"]["cell"]
    truth = bilinear(stages.truth, truth_extent, truth_cell, np.full_like(y, where), y)

    obstacles = obstacle_squares(stages)
    squares = zip(*stages.squares(np.full_like(y, where), y))
    margin = np.array([stages.about["obstacle_margin" if square in obstacles else "margin"] for square in squares])
    axes.fill_between(
        y, refined, refined + margin, color=GROUND, alpha=0.3, linewidth=0, label="labelled ground: up to the margin"
    )
    axes.plot(y, truth, color=INK, linewidth=0.9, linestyle=(0, (1, 1)), label="true ground")
    axes.plot(y, coarse, color=COARSE, linewidth=1.2, linestyle="--", label="coarse surface")
    axes.plot(y, refined, color=REFINED, linewidth=1.5, label="refined surface")
    ground = cut[:, LABEL] == 1
    axes.scatter(
        cut[ground, Y],
        cut[ground, Z],
        s=7,
        color=GROUND,
        edgecolors=INK,
        linewidths=0.25,
        zorder=3,
        label="labelled ground",
    )
    axes.scatter(
        cut[~ground, Y],
        cut[~ground, Z],
        s=7,
        color=OBSTACLE,
        linewidths=0,
        zorder=3,
        label="labelled non-ground",
    )
    axes.set(xlim=across[::-1], ylim=limits, xlabel="y, m", ylabel="z, m")
    axes.grid(True, color="#e4e7ea", linewidth=0.6)
    axes.set_axisbelow(True)


def obstacle_squares(stages):
    """The squares of the surface that contain an obstacle by the rule for points."""
    height = stages.points[:, HEIGHT]
    obstacles = stages.points[(height > stages.about["obstacle_height"]) & (height < 2.5)]
    return set(zip(*stages.squares(obstacles[:, X], obstacles[:, Y])))


def draw_profile(cars, street):
    figure = pyplot.figure(figsize=(11, 6.6), layout="constrained")
    panels = figure.subplot_mosaic([["whole", "whole"], ["kerb", "fence"]], height_ratios=[1.25, 1])
    whole = panels["whole"]
    profile_of(whole, cars, where=-5.0, across=(-12, 10), limits=(-2.3, 0.5), half_slice=0.25)
    whole.set_title("A street between parked cars; fence, bushes and bank behind the right car")
    whole.legend(loc="upper center", ncols=3, framealpha=0.9, fontsize=9)
    profile_of(panels["kerb"], street, where=5.0, across=(-3.0, -0.8), limits=(-1.92, -1.42), half_slice=0.15)
    panels["kerb"].set_title("A kerb in another street")
    profile_of(panels["fence"], street, where=5.0, across=(-5.0, -2.8), limits=(-2.0, -1.2), half_slice=0.15)
    panels["fence"].set_title("Base of a fence in that street")
    return figure


def draw_relief(stages):
    extent, cell = 30, 0.1
    figure, axes = pyplot.subplots(1, 2, figsize=(12, 5.9), layout="constrained")
    points = stages.points[(np.abs(stages.points[:, :2]) < extent).all(axis=1)]
    ground = points[:, LABEL] == 1
    for chosen, color in ((ground, GROUND), (~ground, OBSTACLE)):
        axes[0].scatter(points[chosen, X], points[chosen, Y], s=0.5, color=color, linewidths=0, rasterized=True)
    top_view(axes[0], extent, "Points: ground (yellow) and non-ground (grey)")
    line = np.arange(-extent + cell / 2, extent, cell)
    x, y = np.meshgrid(line, line)
    heights = stages.height(len(stages.grids) - 1, x, y)
    brightness = shaded(heights, cell, exaggeration=2)
    limits = height_limits(heights, extent, extent)
    known = np.where(np.isnan(heights), limits["vmin"], heights)
    colors = height_colors()((known - limits["vmin"]) / (limits["vmax"] - limits["vmin"]))
    level = shaded(np.zeros((2, 2)), 1, 1)[0, 0]  # brightness of level ground
    colors[..., :3] *= np.clip(brightness / level, 0.4, 1.3)[..., None]
    colors[np.isnan(heights + brightness)] = 1
    bounds = (-extent, extent, -extent, extent)
    axes[1].imshow(np.clip(colors, 0, 1), origin="lower", extent=bounds, interpolation="none")
    contours = axes[1].contour(line, line, heights, levels=np.arange(-12, 12, 0.5), colors=INK, linewidths=0.4)
    axes[1].clabel(contours, fontsize=7, fmt="%.1f")
    top_view(axes[1], extent, "Ground surface, shaded; contour lines every 0.5 m")
    return figure


def save(figure, name):
    """Writes a PNG with a palette, which reduces the file to a third."""
    IMAGES.mkdir(parents=True, exist_ok=True)
    path = IMAGES / f"surface-{name}.png"
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=100, format="png")
    image = Image.open(drawn).convert("RGB").quantize(128, dither=Image.Dither.NONE)
    image.save(path, optimize=True)
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1000} kB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--program", type=pathlib.Path, default=ROOT / "build" / "bench" / "performance" / "surface_stages"
    )
    arguments = parser.parse_args()
    if not arguments.program.exists():
        sys.exit(f"{arguments.program}: no such file (run `make surface-figures`)")
    matplotlib.rcParams.update({"font.size": 10, "axes.titlesize": 11, "axes.edgecolor": GREY})
    street = Stages(arguments.program, "steep_street", 1)
    save(draw_patches(street), "patches")
    save(draw_coarse(street), "coarse")
    save(draw_levels(street), "levels")
    save(draw_profile(Stages(arguments.program, "parked_cars", 1), street), "profile")
    save(draw_relief(street), "relief")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
