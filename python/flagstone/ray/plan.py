# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Selection of scans: those in a directory that are not finished yet."""

from __future__ import annotations

import posixpath
from typing import Any, NamedTuple

from flagstone import io
from flagstone.ray.location import File, Location
from flagstone.ray.statistics import FOLDER, is_part, latest_begin, read_rows

Scans = dict[str, File]  # by path relative to the source


def find_scans(location: Location) -> tuple[Location, Scans]:
    """The directory that names are relative to, and its scans, sorted by name.

    Raises:
        FileNotFoundError: There are no scans.
    """
    folder, _, name = location.path.rpartition("/")
    single = location.file()
    if single is not None:
        return Location(folder or "/", location.filesystem), {name: single}
    scans = {file.name: file for file in sorted(location.files()) if is_scan(file.name)}
    if not scans:
        raise FileNotFoundError(
            f"{location}: no scans in this directory or its subdirectories (expected .bin, .pcd.bin, .pcd, .ply or "
            ".npy)"
        )
    return location, scans


def check_names(source: Location, scans: Scans, format: str) -> None:
    """Checks the names of scans.

    Raises:
        ValueError: Two scans have the same label file, or the statistics cannot store a name.
    """
    taken: dict[str, str] = {}
    for name in scans:
        try:
            name.encode()
        except UnicodeEncodeError:
            raise ValueError(f"{source}: the file name {name!r} is not UTF-8 (rename the file)") from None
        label = label_name(name, format)
        if label == name:
            raise ValueError(f"{source.at(name)}: has the name of its label file (rename the scan)")
        other = taken.setdefault(label, name)
        if other is not name:
            raise ValueError(
                f"{source.at(other)} and {source.at(name)} would both write to {label} (rename one of them)"
            )


class Finished(NamedTuple):
    """Scans that earlier runs have finished."""

    scans: set[str]
    without_row: dict[str, int]
    """Number of points of the finished scans whose row was lost when a run was killed."""


def finished_scans(scans: Scans, destination: Location, format: str, made_with: dict[str, Any]) -> Finished:
    """The finished scans. Also removes temporary files of killed runs.

    Scans are finished if the statistics contain their row and their label file has the size for their number of points.
    The row must have no error and the current size of the scan. Scans are also finished if a killed run lost their row:
    then their labels were written after the latest run started, and after the scan.

    Raises:
        ValueError: The labels in the destination were written with other settings.
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
        finished.discard(path)  # the last row of a scan counts
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
    """Whether a file was written at or after a time; False if either is unknown."""
    return file.modified is not None and than is not None and file.modified >= than


def check_same(destination: Location, before: list[dict[str, Any]], now: dict[str, Any]) -> None:
    """Checks that existing labels were written with the same settings.

    Raises:
        ValueError: They were written with other settings.
    """
    for made in before:
        for key in now:
            if made.get(key) != now[key]:
                raise ValueError(
                    f"{destination}: existing labels were written with {difference(key, made.get(key), now[key])} "
                    "(choose another destination, or label all scans again with overwrite=True or --overwrite)"
                )


def difference(key: str, before: Any, now: Any) -> str:
    """The first setting that differs, with both values."""
    if isinstance(before, dict) and isinstance(now, dict):
        inner = next(name for name in [*now, *before] if before.get(name) != now.get(name))
        return difference(f"{key}.{inner}", before.get(inner), now.get(inner))
    return f"{key} = {before}, not {now}"


def forget(destination: Location) -> None:
    """Removes the statistics, so that all scans are labelled again."""
    folder = destination.below(FOLDER)
    for file in list(folder.files()):
        if is_part(file.name):
            folder.remove(file.name)


LABEL_ENDINGS = {"label": ".label", "u8": ".label.npy"}
NPY_HEADER = 128  # bytes; size of the padded header that NumPy writes for one-dimensional arrays


def is_scan(name: str) -> bool:
    """Whether a file is treated as a scan, by its name."""
    return io.is_scan_name(name.encode(errors="replace").decode())  # the extension is valid even if the rest is not


def label_name(scan: str, format: str) -> str:
    """Name of the label file of a scan: its extension is replaced by `.label` or `.label.npy`."""
    stem = posixpath.splitext(scan)[0]
    if scan.lower().endswith(".pcd.bin"):
        stem = posixpath.splitext(stem)[0]
    return stem + LABEL_ENDINGS[format]


def label_bytes(points: int, format: str) -> int:
    """Size of a label file: four bytes per label, or a header and one byte per label."""
    return 4 * points if format == "label" else NPY_HEADER + points


def label_count(size: int, format: str) -> int | None:
    """Number of labels in a file of `size` bytes; None if the size is invalid."""
    points, rest = divmod(size, 4) if format == "label" else (size - NPY_HEADER, 0)
    return points if rest == 0 and points >= 0 else None
