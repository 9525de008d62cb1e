# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The Python program of bench/python_overhead.py has the interface of the C++ program."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import numpy.typing as npt

import flagstone

LOOP = Path(__file__).parents[2] / "bench" / "segment_loop" / "segment_loop.py"


def fnv_1a(data: bytes) -> int:
    number = 0xCBF29CE484222325
    for byte in data:
        number = (number ^ byte) * 0x100000001B3 % 2**64
    return number


def test_it_prints_label_hashes_then_the_time_per_scan_for_each_line(
    scan: npt.NDArray[np.float32], tmp_path: Path
) -> None:
    assert fnv_1a(b"a") == 0xAF63DC4C8601EC8C  # a published value
    files = [tmp_path / "1.bin", tmp_path / "2.bin"]
    for file, points in zip(files, (scan, scan[:1000]), strict=True):
        points.tofile(file)

    printed = subprocess.run(
        [sys.executable, LOOP, "surface", *files],
        input="\n\n",
        env={**os.environ, "PYTHONPATH": str(Path(flagstone.__file__).parents[1])},
        capture_output=True,
        text=True,
        check=True,
    ).stdout.splitlines()

    segmenter = flagstone.Surface()
    assert printed[0].split() == [
        str(fnv_1a(segmenter.segment(points).labels.tobytes())) for points in (scan, scan[:1000])
    ]
    times = [[int(time) for time in line.split()] for line in printed[1:]]
    assert [len(line) for line in times] == [2, 2]
    assert min(min(line) for line in times) > 0
