# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""LAS and LAZ files for tests, full of what a file can hold."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

laspy: Any = pytest.importorskip("laspy", reason="laspy is not installed: pip install 'flagstone[las]'")

point_formats = range(11)


def write_random_las(path: Path, point_format: int, count: int = 1000, seed: int = 1) -> None:
    """A file whose points are random bytes, with extra bytes, records of others, and records behind the points."""
    header = laspy.LasHeader(point_format=point_format)
    header.scales, header.offsets = [0.01, 0.01, 0.001], [500_000, 5_000_000, 100]
    header.system_identifier, header.generating_software = "a scanner", "somebody's"
    header.extra_vlr_bytes = b"between records and points"
    header.add_extra_dim(laspy.ExtraBytesParams("amplitude", "f4", scales=None))
    header.add_extra_dim(laspy.ExtraBytesParams("beam", "3u1"))
    header.vlrs.append(laspy.VLR("someone", 7, "a record", b"kept as it is"))
    points = laspy.ScaleAwarePointRecord.zeros(count, header=header)
    points.array.view(np.uint8)[:] = np.random.default_rng(seed).integers(0, 256, points.array.nbytes, np.uint8)
    if point_format >= 9:  # lazrs loses waveforms where scanner channels alternate
        points["scanner_channel"] = np.zeros(count, np.uint8)
    las = laspy.LasData(header, points)
    if str(header.version) == "1.4":
        las.evlrs = laspy.vlrs.vlrlist.VLRList([laspy.VLR("someone", 8, "at the end", b"also kept" * 1000)])
    las.write(path)


def set_classes(path: Path, classes: np.ndarray[Any, Any]) -> None:
    """Writes the file again with these classes."""
    las = laspy.read(path)
    las.classification = classes
    las.write(path)
