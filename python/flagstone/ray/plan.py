# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What is to be done: the scans of a place, less those that are finished."""

from __future__ import annotations

from typing import Any

from flagstone.ray.place import Place
from flagstone.ray.scan_names import is_scan, label_bytes, label_name
from flagstone.ray.statistics import FOLDER, is_part, read_rows

Scans = dict[str, int]  # bytes, by name below the source


def find_scans(location: Place) -> tuple[Place, Scans]:
    """The folder that names are below, and the scans in it, sorted by name.

    Raises:
        FileNotFoundError: There is no scan.
    """
    folder, _, name = location.path.rpartition("/")
    size = location.size("")
    if size is not None:
        return Place(folder or "/", location.filesystem), {name: size}
    scans = dict(sorted(found for found in location.files() if is_scan(found[0])))
    if not scans:
        raise FileNotFoundError(
            f"{location}: no scan in this folder or below it; scans end in .bin, .pcd.bin, .pcd, .ply or .npy"
        )
    return location, scans


def check_names(source: Place, scans: Scans, format: str) -> None:
    """Refuses scans whose labels would be one file, and names that the statistics cannot hold.

    Raises:
        ValueError: There are such.
    """
    taken: dict[str, str] = {}
    for name in scans:
        try:
            name.encode()
        except UnicodeEncodeError:
            raise ValueError(f"{source}: the name {name!r} is not UTF-8; rename it") from None
        label = label_name(name, format)
        other = taken.setdefault(label, name)
        if other is not name:
            raise ValueError(
                f"{source.at(other)} and {source.at(name)} would both write to {label}; move one of them elsewhere"
            )


def finished_scans(scans: Scans, destination: Place, format: str, made_with: dict[str, Any]) -> set[str]:
    """The scans that need not be done.

    A scan is finished where the statistics have its row, without an error and of a scan of as many bytes, and the file
    of its labels has the size that so many labels have.

    Raises:
        ValueError: The destination holds labels that were made with other settings.
    """
    rows, before = read_rows(destination.below(FOLDER), ["path", "bytes", "points", "error"])
    check_same(destination, before, made_with)
    if rows.num_rows == 0:
        return set()
    outputs = dict(destination.files())
    finished = set()
    for path, size, points, error in zip(*(column.to_pylist() for column in rows.columns), strict=True):
        finished.discard(path)  # of several rows the last counts
        has_labels = error is None and outputs.get(label_name(path, format)) == label_bytes(points, format)
        if has_labels and scans.get(path) == size:
            finished.add(path)
    return finished


def check_same(destination: Place, before: list[dict[str, Any]], now: dict[str, Any]) -> None:
    """Refuses to mix labels of different settings.

    Raises:
        ValueError: There are labels of other settings.
    """
    for made in before:
        for key in now:
            if made.get(key) != now[key]:
                raise ValueError(
                    f"{destination}: its labels were made with another {difference(key, made.get(key), now[key])}; "
                    "name another destination, or do them all anew with again=True (--again)"
                )


def difference(key: str, before: Any, now: Any) -> str:
    """The first setting that is another, with its values."""
    if isinstance(before, dict) and isinstance(now, dict):
        inner = next(name for name in [*now, *before] if before.get(name) != now.get(name))
        return difference(f"{key}.{inner}", before.get(inner), now.get(inner))
    return f"{key}, {before} instead of {now}"


def forget(destination: Place) -> None:
    """Takes the statistics away, so that no scan is finished."""
    folder = destination.below(FOLDER)
    for name, _ in list(folder.files()):
        if is_part(name):
            folder.remove(name)
