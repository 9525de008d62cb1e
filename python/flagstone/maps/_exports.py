# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The files that mapping a run writes on request, in other formats than its own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from flagstone._optional import needs
from flagstone.maps._animation import write_animation
from flagstone.maps._geotiff import system_of, write_geotiff
from flagstone.maps._recording import write_recording
from flagstone.maps._static_cloud import write_static_cloud


class Exports(NamedTuple):
    """Which files to write to the output directory of a run."""

    geotiff: bool = False
    """ground.tif: the map."""
    crs: str | int | None = None
    """Coordinate reference system of the poses, for ground.tif."""
    las: bool = False
    """static.las: the points that do not move."""
    recording: bool = False
    """recording.rrd: the run in the viewer of Rerun."""
    animation: bool = False
    """animation.gif: the ground growing scan by scan."""

    def check(self) -> None:
        """Finds errors before the run is mapped.

        Raises:
            ImportError: A package is not installed.
            ValueError: `crs` is unknown, or given without `geotiff`.
        """
        if self.crs is not None and not self.geotiff:
            raise ValueError("crs: is used only by geotiff (expected both)")
        if self.geotiff:
            rasterio = needs("rasterio", extra="geotiff")
            system_of(rasterio, self.crs)
        if self.las:
            needs("laspy", extra="las")
        if self.recording:
            needs("rerun", extra="viewer")
        if self.animation:
            needs("PIL", extra="plot")

    def write(self, directory: Path, report: Callable[[str], None]) -> list[Path]:
        """Writes the files. Reports one line for each file that cannot be written, because the map is complete.

        Returns:
            The files that were written.
        """
        written = []
        for wanted, name, write in (
            (self.geotiff, "ground.tif", self._write_geotiff),
            (self.las, "static.las", write_static_cloud),
            (self.recording, "recording.rrd", write_recording),
            (self.animation, "animation.gif", write_animation),
        ):
            if not wanted:
                continue
            path = directory / name
            try:
                write(directory, path)
            except (OSError, ValueError) as error:
                report(f"{path}: not written: {error}")
            else:
                written.append(path)
        return written

    def _write_geotiff(self, directory: Path, path: Path) -> None:
        write_geotiff(directory, path, crs=self.crs)
