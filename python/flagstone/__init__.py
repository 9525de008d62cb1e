# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Ground segmentation for 3D LiDAR.

A scan goes in; every point comes back labelled ground or not, with its height above the ground below it, every patch
of ground comes back with its plane, and the ground itself as one continuous surface:

    import flagstone

    result = flagstone.Surface(sensor_height=1.73).segment(points)  # (N, >=3) float32: x, y, z, ...
    result.ground  # (N,) bool
    result.heights  # (N,) float32, metres

Coordinates are metres in the sensor's frame: x forward, y left, z up.
"""

from flagstone import io, plot
from flagstone._core import version as __version__
from flagstone._evaluate import Evaluation, evaluate
from flagstone._score import Score, score
from flagstone._simulate import SimulatedScan, simulate
from flagstone.codes import Label, Verdict
from flagstone.ground_surface import Grid, GroundSample, GroundSurface
from flagstone.segmentation import Mount, Segmentation
from flagstone.segmenters import Patchwork, Segmenter, Surface, make_segmenter, method_names
from flagstone.sensors import Sensor, sensors
from flagstone.viewer import show

__all__ = [
    "Evaluation",
    "Grid",
    "GroundSample",
    "GroundSurface",
    "Label",
    "Mount",
    "Patchwork",
    "Score",
    "Segmentation",
    "Segmenter",
    "Sensor",
    "SimulatedScan",
    "Surface",
    "Verdict",
    "__version__",
    "evaluate",
    "io",
    "make_segmenter",
    "method_names",
    "plot",
    "score",
    "sensors",
    "show",
    "simulate",
]
