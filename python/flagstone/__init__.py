# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Ground segmentation for 3D LiDAR.

flagstone labels every point of a scan as ground or non-ground and measures its height above the ground. It also
returns the plane of each ground patch, and the ground as one continuous surface:

    import flagstone

    result = flagstone.Surface(sensor_height=1.73).segment(points)  # (N, >=3) float32: x, y, z, ...
    result.ground  # (N,) bool
    result.heights  # (N,) float32, metres

Coordinates are in metres in the sensor frame: x forward, y left, z up.
"""

from flagstone import io, maps, plot, ros
from flagstone._core import version as __version__
from flagstone._evaluate import Evaluation, evaluate
from flagstone._map_run import MapSummary, map
from flagstone._score import Score, score
from flagstone._simulate import SimulatedScan, simulate
from flagstone.bags.job import bag
from flagstone.bags.summary import BagSummary
from flagstone.codes import Label, Verdict
from flagstone.ground_map import GroundMap, Levelling, MapGrid, MapSample
from flagstone.ground_surface import Grid, GroundSample, GroundSurface
from flagstone.label_vote import LabelVote
from flagstone.moving_points import MovingMask, MovingObject, MovingPoints
from flagstone.segmentation import Mount, Segmentation
from flagstone.segmenters import Patchwork, Segmenter, Surface, make_segmenter, method_names
from flagstone.sensors import Sensor, sensors
from flagstone.viewer import show

__all__ = [
    "BagSummary",
    "Evaluation",
    "Grid",
    "GroundMap",
    "GroundSample",
    "GroundSurface",
    "Label",
    "LabelVote",
    "Levelling",
    "MapGrid",
    "MapSample",
    "MapSummary",
    "Mount",
    "MovingMask",
    "MovingObject",
    "MovingPoints",
    "Patchwork",
    "Score",
    "Segmentation",
    "Segmenter",
    "Sensor",
    "SimulatedScan",
    "Surface",
    "Verdict",
    "__version__",
    "bag",
    "evaluate",
    "io",
    "make_segmenter",
    "map",
    "maps",
    "method_names",
    "plot",
    "ros",
    "score",
    "sensors",
    "show",
    "simulate",
]
