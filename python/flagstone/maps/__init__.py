# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Readers of the output directory of `flagstone map`, and images of it.

docs/reference/file-formats.md describes the files.
"""

from flagstone.maps._animation import write_animation
from flagstone.maps._geotiff import write_geotiff
from flagstone.maps._recording import write_recording
from flagstone.maps._run_files import MappedRun, MappedScan, read_run
from flagstone.maps._static_cloud import write_static_cloud
from flagstone.maps._tiles import read_ground_map

__all__ = [
    "MappedRun",
    "MappedScan",
    "read_ground_map",
    "read_run",
    "write_animation",
    "write_geotiff",
    "write_recording",
    "write_static_cloud",
]
