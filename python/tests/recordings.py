# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reads recordings for the viewer of Rerun."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from flagstone._palette import Color

Row = dict[str, Any]
"""The components of an entity at one time."""


def rows_of(path: Path) -> dict[str, list[Row]]:
    """Logged rows by entity, in the order of the timeline. Skips the test if Rerun cannot read recordings."""
    pytest.importorskip("rerun", reason="rerun-sdk writes recordings")
    chunks = pytest.importorskip("rerun.chunk", reason="rerun-sdk 0.41 and later reads recordings")
    rows: dict[str, list[Row]] = {}
    for chunk in chunks.RrdReader(path).stream():
        for row in chunk.to_record_batch().to_pylist():
            rows.setdefault(chunk.entity_path, []).append(row)
    for logged in rows.values():
        logged.sort(key=lambda row: row.get("scan", 0))
    return rows


def packed(color: Color, alpha: int = 255) -> int:
    red, green, blue = color
    return red << 24 | green << 16 | blue << 8 | alpha
