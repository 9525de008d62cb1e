# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Shared by the tests of flagstone.ray: scans, labels of the command, and files that crash workers."""

from __future__ import annotations

import os
import signal
import subprocess
from pathlib import Path
from typing import Any

import fsspec.implementations.local
import numpy as np
import numpy.typing as npt

import flagstone
from flagstone import _command


def street(seed: int, points: int = 4000) -> npt.NDArray[np.void]:
    """Rough ground 1.73 m below the sensor, with boxes."""
    random = np.random.default_rng(seed)
    scan = np.zeros(points, [(name, "<f4") for name in ("x", "y", "z", "intensity")])
    scan["x"], scan["y"] = random.uniform(-30, 30, (2, points))
    scan["z"] = -1.73 + random.normal(0, 0.02, points)
    in_box = (scan["x"] % 10 < 2) & (scan["y"] % 8 < 3)
    scan["z"][in_box] += random.uniform(0, 2, in_box.sum())
    scan["intensity"] = random.uniform(0, 1, points)
    scan["z"][:3] = np.nan
    return scan


def write_scans(folder: Path, names: list[str]) -> None:
    """Writes one scan per name. The scans differ, also in length."""
    for seed, name in enumerate(names):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        scan = street(seed, 4000 + 10 * seed)
        if name.endswith(".pcd.bin"):
            with_ring = np.zeros(len(scan), [*scan.dtype.descr, ("ring", "<f4")])
            for field in scan.dtype.names or ():
                with_ring[field] = scan[field]
            scan = with_ring
        flagstone.io.write(path, scan)


def label_with_command(source: Path, output: Path, *options: str) -> None:
    """Writes the expected labels with the command."""
    subprocess.run(
        [_command.path(), "segment", source, "--output", output, *options], check=True, stdout=subprocess.DEVNULL
    )


def files(folder: Path) -> dict[str, bytes]:
    """Names and contents of all files in a directory and its subdirectories, except statistics."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.suffix != ".parquet"
    }


class DeadlyFiles(fsspec.implementations.local.LocalFileSystem):
    """Kills the process that opens deadly.bin, like an operating system that is out of memory."""

    protocol = "deadly"

    def _open(self, path: str, *arguments: Any, **options: Any) -> Any:
        if path.endswith("deadly.bin"):
            os.kill(os.getpid(), signal.SIGKILL)
        return super()._open(path, *arguments, **options)
