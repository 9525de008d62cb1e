# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""F1 of every world and sensor as a picture: one map a method and setting. Needs Matplotlib."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from worlds_scans import METHODS, SCENES, SENSORS

TITLES = {
    "plain": "plain settings, height known",
    "preset": "preset, height known",
    "estimated": "preset, height and tilt estimated",
}


def draw(results, path):
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
    figure.savefig(path, dpi=90)
