#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Draws the images of docs/how-to/plot-results.md: docs/images/birds-eye.png and docs/images/viewer.png.

Needs the package with its extras (pip install 'flagstone[all]'), playwright (pip install playwright) and Chromium
(apt-get install chromium). Chromium renders the viewer in software, without a GPU. This takes about a minute.

    python3 bench/python_images.py [--only birds-eye|viewer]
"""

from __future__ import annotations

import argparse
import io
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import flagstone

IMAGES = Path(__file__).parents[1] / "docs" / "images"
SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]
WIDTH, HEIGHT = 900, 640
BAR, TIME_LINE = 36, 30  # pixels of the viewer's controls, which are cropped
SURFACE_TAB = (132, 50)  # position in pixels
OVER_A_PATCH = (90, 440)


def scan(directory: Path) -> Any:
    flagstone.simulate(directory / "run", scene="steep_street", frames=1)
    return flagstone.io.read(directory / "run/sequences/00/velodyne/000000.bin")


def draw_birds_eye(points: Any) -> None:
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(13, 7.2), layout="constrained")
    result = flagstone.Surface(sensor="hdl-64e").segment(points)
    flagstone.plot.birds_eye(points, result, axes=left, range=40, patches=True)
    flagstone.plot.surface(result, axes=right, range=40)
    figure.savefig(IMAGES / "birds-eye.png", dpi=92, pil_kwargs={"optimize": True})
    report(IMAGES / "birds-eye.png")


def draw_viewer(points: Any, directory: Path) -> None:
    from PIL import Image

    patchwork, surface = directory / "patchwork.rrd", directory / "surface.rrd"
    flagstone.show(points, flagstone.Patchwork(sensor="hdl-64e").segment(points), save=patchwork)
    flagstone.show(points, flagstone.Surface(sensor="hdl-64e").segment(points), save=surface)
    halves = [seen(patchwork, point_at=OVER_A_PATCH), seen(surface, click_on=SURFACE_TAB)]
    both = Image.new("RGB", (2 * WIDTH + 10, halves[0].height), "white")
    both.paste(halves[0], (0, 0))
    both.paste(halves[1], (WIDTH + 10, 0))
    both.quantize(256).save(IMAGES / "viewer.png", optimize=True)
    report(IMAGES / "viewer.png")


def seen(recording: Path, *, click_on: Any = None, point_at: Any = None) -> Any:
    """A screenshot of a recording in a browser."""
    from PIL import Image
    from playwright.sync_api import sync_playwright

    command = [sys.executable, "-m", "rerun", "--serve-web", "--web-viewer-port", "9393", "--port", "9394", recording]
    # In a separate session, so that the program started by this script can be stopped too.
    server = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE)
            page = browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
            page.set_default_timeout(180_000)  # on a busy machine, a frame can take many seconds
            time.sleep(5)
            page.goto("http://localhost:9393/?url=rerun%2Bhttp://localhost:9394/proxy&hide_welcome_screen=1")
            wait_until_still(page)
            if click_on is not None:
                page.mouse.click(*click_on)
                page.mouse.move(WIDTH - 5, HEIGHT - 5)
                wait_until_still(page)
            if point_at is not None:
                page.mouse.move(point_at[0] - 3, point_at[1])
                page.mouse.move(*point_at)
                wait_until_still(page)
            image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
            browser.close()
            return image.crop((0, BAR, WIDTH, HEIGHT - TIME_LINE))
    finally:
        os.killpg(server.pid, signal.SIGTERM)
        server.wait()


def wait_until_still(page: Any) -> None:
    """Waits until the page stops changing. Software rendering is slow, and meshes appear one after another."""
    before, still = b"", 0
    for _ in range(100):
        time.sleep(4)
        now = page.screenshot(clip={"x": 0, "y": BAR + 40, "width": WIDTH, "height": HEIGHT - BAR - TIME_LINE - 40})
        still = still + 1 if now == before else 0
        if still == 4:
            return
        before = now
    raise TimeoutError("the viewer is still changing after 400 s")


def report(path: Path) -> None:
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=("birds-eye", "viewer"))
    only = parser.parse_args().only
    with tempfile.TemporaryDirectory() as name:
        points = scan(Path(name))
        if only != "viewer":
            draw_birds_eye(points)
        if only != "birds-eye":
            draw_viewer(points, Path(name))


if __name__ == "__main__":
    main()
