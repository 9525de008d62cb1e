# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Which files are scans, and what their labels are called: as the command `flagstone segment` has it."""

from __future__ import annotations

import posixpath

SCAN_ENDINGS = (".bin", ".pcd", ".ply", ".npy")
BESIDE_SCANS = ("_lidarseg.bin", ".label.npy", ".heights.npy", ".surface.npy", ".ground.npy", ".echo.npy")
LABEL_ENDINGS = {"label": ".label", "u8": ".label.npy"}


def is_scan(name: str) -> bool:
    """Whether a file is taken for a scan, by its name alone."""
    base = posixpath.basename(name).lower()
    return base.endswith(SCAN_ENDINGS) and not base.startswith(".") and not base.endswith(BESIDE_SCANS)


def label_name(scan: str, format: str) -> str:
    """The name of a scan's labels, `.label` or `.label.npy` in place of the scan's ending."""
    stem = posixpath.splitext(scan)[0]
    if scan.lower().endswith(".pcd.bin"):
        stem = posixpath.splitext(stem)[0]
    return stem + LABEL_ENDINGS[format]


def label_bytes(points: int, format: str) -> int:
    """The size of a file of so many labels: four bytes each, or one each after a header of 128 bytes."""
    return 4 * points if format == "label" else NPY_HEADER + points


NPY_HEADER = 128  # NumPy pads the header of any one-dimensional array to this
