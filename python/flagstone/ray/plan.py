# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What is to be done: the scans of a place, less those that are finished."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flagstone.ray.place import Place
from flagstone.ray.scan_names import is_scan, label_bytes, label_name
from flagstone.ray.statistics import FOLDER, is_part, read_rows

if TYPE_CHECKING:
    import pyarrow


@dataclass(frozen=True)
class Plan:
    """The scans to be labelled, `path` and `bytes` of each, by path, and how many need not be."""

    scans: pyarrow.Table
    finished: int


def find_scans(source: Place) -> tuple[Place, list[tuple[str, int]]]:
    """The folder that names are relative to, and name and bytes of each scan, sorted by name.

    Raises:
        FileNotFoundError: There is no scan.
    """
    size = source.size()
    if size is not None:  # a single file
        folder = source.parent()
        return folder, [(source.path.rsplit("/", 1)[-1], size)]
    scans = sorted(found for found in source.files() if is_scan(found[0]))
    if not scans:
        raise FileNotFoundError(
            f"{source}: no scan in this folder or below it; scans end in .bin, .pcd.bin, .pcd, .ply or .npy"
        )
    return source, scans


def check_names(source: Place, scans: list[tuple[str, int]], format: str) -> None:
    """Refuses scans that would write to one file.

    Raises:
        ValueError: Two of them would.
    """
    taken: dict[str, str] = {}
    for name, _ in scans:
        other = taken.setdefault(label_name(name, format), name)
        if other is not name:
            raise ValueError(
                f"{source.at(other)} and {source.at(name)} would both write to {label_name(name, format)}; "
                f"move one of them elsewhere"
            )


def make_plan(
    scans: list[tuple[str, int]], destination: Place, format: str, made_with: dict[str, Any], again: bool
) -> Plan:
    """Leaves out what is finished.

    A scan is finished where the statistics have its row, without an error and of a scan of as many bytes, and the file
    of its labels has the size that so many labels have.

    Raises:
        ValueError: The destination holds labels that were made with other settings.
    """
    import pyarrow as pa

    finished: set[str] = set()
    folder = Place(destination.at(FOLDER), destination.filesystem)
    if again:
        for name, _ in list(folder.files()):
            if is_part(name):
                folder.remove(name)
    else:
        rows, before = read_rows(folder, ["path", "bytes", "points", "error"])
        check_same(destination, before, made_with)
        if rows.num_rows:
            finished = finished_scans(dict(scans), rows, dict(destination.files()), format)
    left = [scan for scan in scans if scan[0] not in finished]
    return Plan(
        pa.table(
            {
                "path": pa.array([name for name, _ in left], pa.string()),
                "bytes": pa.array([size for _, size in left], pa.int64()),
            }
        ),
        len(scans) - len(left),
    )


def check_same(destination: Place, before: list[dict[str, Any]], now: dict[str, Any]) -> None:
    for made in before:
        if made == now:
            continue
        other = next(key for key in [*now, *made] if made.get(key) != now.get(key))
        raise ValueError(
            f"{destination}: its labels were made with another {other} ({shortly(made.get(other))}, "
            f"now {shortly(now.get(other))}); name another destination, or do all of it anew with again=True (--again)"
        )


def shortly(value: Any) -> str:
    text = str(value)
    return text if len(text) <= 60 else text[:57] + "..."


def finished_scans(scans: dict[str, int], rows: pyarrow.Table, outputs: dict[str, int], format: str) -> set[str]:
    finished = set()
    for row in zip(*(column.to_pylist() for column in rows.columns), strict=True):
        path, size, points, error = row
        finished.discard(path)  # of several rows the last counts
        if error is None and scans.get(path) == size:
            if outputs.get(label_name(path, format)) == label_bytes(points, format):
                finished.add(path)
    return finished
