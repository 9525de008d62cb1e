# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What is to be done: the scans of a folder, less those that are finished."""

from __future__ import annotations

import posixpath
from typing import Any, NamedTuple

from flagstone import io
from flagstone.ray.location import File, Location
from flagstone.ray.statistics import FOLDER, is_part, latest_begin, read_rows

Scans = dict[str, File]  # by name below the source


def find_scans(location: Location) -> tuple[Location, Scans]:
    """The folder that names are below, and the scans in it, sorted by name.

    Raises:
        FileNotFoundError: There is no scan.
    """
    folder, _, name = location.path.rpartition("/")
    single = location.file()
    if single is not None:
        return Location(folder or "/", location.filesystem), {name: single}
    scans = {file.name: file for file in sorted(location.files()) if is_scan(file.name)}
    if not scans:
        raise FileNotFoundError(
            f"{location}: no scan in this folder or below it; scans end in .bin, .pcd.bin, .pcd, .ply or .npy"
        )
    return location, scans


def check_names(source: Location, scans: Scans, format: str) -> None:
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
        if label == name:
            raise ValueError(f"{source.at(name)}: is named as its own labels would be; rename it")
        other = taken.setdefault(label, name)
        if other is not name:
            raise ValueError(
                f"{source.at(other)} and {source.at(name)} would both write to {label}; move one of them elsewhere"
            )


class Finished(NamedTuple):
    """What earlier runs have done."""

    scans: set[str]
    without_row: dict[str, int]
    """Points of those whose row was lost when a run was killed."""


def finished_scans(scans: Scans, destination: Location, format: str, made_with: dict[str, Any]) -> Finished:
    """The scans that need not be done; removes what a killed run had half written.

    A scan is finished if the statistics have its row, without an error and of a scan of as many bytes, and the file of
    its labels has the size that so many labels have. It is also finished if a killed run has lost its row: if its
    labels were written after the latest run began, and after the scan.

    Raises:
        ValueError: The destination holds labels that were made with other settings.
    """
    statistics = destination.below(FOLDER)
    rows, before = read_rows(statistics, ["path", "bytes", "points", "error"])
    check_same(destination, before, made_with)
    if not before:
        return Finished(set(), {})
    outputs = {}
    for file in destination.files():
        if destination.is_left_over(file.name):
            destination.remove(file.name)
        outputs[file.name] = file
    finished, with_row = set(), set()
    for path, size, points, error in zip(*(column.to_pylist() for column in rows.columns), strict=True):
        finished.discard(path)  # of several rows the last counts
        labels = outputs.get(label_name(path, format))
        has_labels = error is None and labels is not None and labels.size == label_bytes(points, format)
        if has_labels and path in scans and scans[path].size == size:
            finished.add(path)
        if error is None:
            with_row.add(path)
    without_row = {}
    begin = latest_begin(statistics)
    for path, scan in scans.items():
        labels = outputs.get(label_name(path, format)) if path not in with_row and begin is not None else None
        if labels is not None and is_newer(labels, begin) and is_newer(labels, scan.modified):
            points = label_count(labels.size, format)
            if points is not None:
                without_row[path] = points
    return Finished(finished | without_row.keys(), without_row)


def is_newer(file: File, than: float | None) -> bool:
    """Whether a file was written no earlier; False if it is not known."""
    return file.modified is not None and than is not None and file.modified >= than


def check_same(destination: Location, before: list[dict[str, Any]], now: dict[str, Any]) -> None:
    """Refuses to mix labels of different settings.

    Raises:
        ValueError: There are labels of other settings.
    """
    for made in before:
        for key in now:
            if made.get(key) != now[key]:
                raise ValueError(
                    f"{destination}: its labels were made with another {difference(key, made.get(key), now[key])}; "
                    "choose another destination, or label all scans again with overwrite=True (--overwrite)"
                )


def difference(key: str, before: Any, now: Any) -> str:
    """The first setting that is another, with its values."""
    if isinstance(before, dict) and isinstance(now, dict):
        inner = next(name for name in [*now, *before] if before.get(name) != now.get(name))
        return difference(f"{key}.{inner}", before.get(inner), now.get(inner))
    return f"{key}, {before} instead of {now}"


def forget(destination: Location) -> None:
    """Removes the statistics, so that no scan is finished."""
    folder = destination.below(FOLDER)
    for file in list(folder.files()):
        if is_part(file.name):
            folder.remove(file.name)


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


def label_count(size: int, format: str) -> int | None:
    """How many labels a file of so many bytes holds; None if it is not whole."""
    points, rest = divmod(size, 4) if format == "label" else (size - NPY_HEADER, 0)
    return points if rest == 0 and points >= 0 else None
