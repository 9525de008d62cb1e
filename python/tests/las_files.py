# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""LAS and LAZ files for tests, with all kinds of contents."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

laspy: Any = pytest.importorskip("laspy", reason="laspy is not installed: pip install 'flagstone[las]'")

point_formats = range(11)


def write_random_las(path: Path, point_format: int, count: int = 1000, seed: int = 1) -> None:
    """Writes points of random bytes, with extra bytes, unknown records, and records after the points."""
    header = laspy.LasHeader(point_format=point_format)
    header.scales, header.offsets = [0.01, 0.01, 0.001], [500_000, 5_000_000, 100]
    header.system_identifier, header.generating_software = "a scanner", "somebody's"
    header.extra_vlr_bytes = b"between records and points"
    header.add_extra_dim(laspy.ExtraBytesParams("amplitude", "f4", scales=None))
    header.add_extra_dim(laspy.ExtraBytesParams("beam", "3u1"))
    header.vlrs.append(laspy.VLR("someone", 7, "a record", b"kept as it is"))
    points = laspy.ScaleAwarePointRecord.zeros(count, header=header)
    points.array.view(np.uint8)[:] = np.random.default_rng(seed).integers(0, 256, points.array.nbytes, np.uint8)
    if point_format >= 9:  # lazrs loses waveforms if scanner channels alternate
        points["scanner_channel"] = np.zeros(count, np.uint8)
    las = laspy.LasData(header, points)
    if str(header.version) == "1.4":
        las.evlrs = laspy.vlrs.vlrlist.VLRList([laspy.VLR("someone", 8, "at the end", b"also kept" * 1000)])
    las.write(path)


def write_copc(path: Path) -> None:
    """Writes a COPC file of four nodes. The last node is in a separate page, and unknown records surround the index."""
    import lazrs

    random = np.random.default_rng(3)
    voxels = {(0, 0, 0, 0): (-100, 100), (1, 0, 0, 0): (-100, 0), (1, 1, 1, 1): (0, 100), (2, 3, 3, 3): (50, 100)}
    header = laspy.LasHeader(point_format=6)
    nodes = []
    for low, high in voxels.values():
        points = laspy.ScaleAwarePointRecord.zeros(int(random.integers(100, 2000)), header=header)
        points.array.view(np.uint8)[:] = random.integers(0, 256, points.array.nbytes, np.uint8)
        for axis in ("x", "y", "z"):
            points[axis] = random.uniform(low, high, len(points))
        points["gps_time"] = header.point_count + np.arange(len(points))  # the index in the file
        nodes.append(points)
        header.grow(points)

    kind = lazrs.LazVlr.new_for_compression(6, 0, True)
    header.vlrs.append(laspy.VLR("copc", 1, "", struct.pack("<5d2Q13Q", 0, 0, 0, 100, 10, *[0] * 15)))
    header.vlrs.append(laspy.vlrs.known.LasZipVlr(kind.record_data()))
    header.are_points_compressed, header.number_of_evlrs = True, 2
    with path.open("w+b") as file:
        header.write_to(file)
        begin = file.tell()
        compressor = lazrs.LasZipCompressor(file, kind)
        for i, points in enumerate(nodes):
            if i > 0:
                compressor.finish_current_chunk()
            compressor.compress_many(np.frombuffer(points.array.tobytes(), np.uint8))
        compressor.done()
        file.seek(begin)
        sizes = [size for _, size in lazrs.read_chunk_table(file, kind)]
        places = [begin + 8 + sum(sizes[:i]) for i in range(len(sizes))]

        header.start_of_first_evlr = file.seek(0, 2)
        other = laspy.vlrs.vlrlist.VLRList([laspy.VLR("someone", 8, "", b"kept")])
        other.write_to(file, as_extended=True)
        root = file.tell() + 60
        entries = [(*voxel, places[i], sizes[i], len(nodes[i])) for i, voxel in enumerate(voxels)]
        pages = [*entries[:3], (*list(voxels)[3], root + 5 * 32, 32, -1), (1, 0, 0, 1, 0, 0, 0), entries[3]]
        index = b"".join(struct.pack("<4iQii", *entry) for entry in pages)
        laspy.vlrs.vlrlist.VLRList([laspy.VLR("copc", 1000, "", index)]).write_to(file, as_extended=True)
        info = struct.pack("<5d2Q2d11Q", 0, 0, 0, 100, 10, root, 5 * 32, *[0] * 13)
        header.vlrs[0] = laspy.VLR("copc", 1, "", info)
        file.seek(0)
        header.write_to(file)


def set_classes(path: Path, classes: np.ndarray[Any, Any]) -> None:
    """Rewrites the file with the given classes."""
    las = laspy.read(path)
    las.classification = classes
    las.write(path)
