# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Which files are scans, and what their labels are called: as the command `flagstone segment` has it."""

from __future__ import annotations

import posixpath

from flagstone import io

LABEL_ENDINGS = {"label": ".label", "u8": ".label.npy"}
NPY_HEADER = 128  # bytes; what NumPy pads the header of an array of one dimension to


def is_scan(name: str) -> bool:
    """Whether a file is taken for a scan, by its name alone."""
    return io.is_scan_name(name.encode(errors="replace").decode())  # of names that are not UTF-8 the ending says it


def label_name(scan: str, format: str) -> str:
    """The name of a scan's labels, `.label` or `.label.npy` in place of the scan's ending."""
    stem = posixpath.splitext(scan)[0]
    if scan.lower().endswith(".pcd.bin"):
        stem = posixpath.splitext(stem)[0]
    return stem + LABEL_ENDINGS[format]


def label_bytes(points: int, format: str) -> int:
    """The size of a file of so many labels: four bytes each, or one each after a header."""
    return 4 * points if format == "label" else NPY_HEADER + points
