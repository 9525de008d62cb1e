# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Scans and poses of a run to map that are not files yet: from bags, or poses that KISS-ICP finds."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from flagstone import _poses
from flagstone._atomic_file import atomic_write
from flagstone._optional import needs
from flagstone._progress import Progress
from flagstone.bags.formats import is_bag
from flagstone.segmenters import Segmenter

KISS_ICP = "kiss-icp"
"""Instead of a file of poses: KISS-ICP finds them."""

_FOLDER = "input"  # in the output directory; map_run() in C++ ignores it
_DESCRIPTION = "source.json"


class MapInput(NamedTuple):
    """The files of a run to map."""

    run: Path
    """Directory of the scans."""
    poses: Path
    """File of the poses."""


class InputRequest(NamedTuple):
    """The run and poses to map, as given."""

    run: str
    """Directory of scans, or a bag."""
    poses: str
    """File of poses, a bag, or `KISS_ICP`."""
    output: str
    """Output directory."""
    topic: str | None = None
    """Topic of the clouds in the bag `run`; None: the only one."""
    pose_topic: str | None = None
    """Topic of the poses in the bag `poses`; None: chosen as in `read_trajectory`."""
    columns: int | None = None
    """Floats per point in raw files."""

    @property
    def needs_files(self) -> bool:
        """Whether scans or poses are not files yet."""
        return self.poses == KISS_ICP or is_bag(self.run) or is_bag(self.poses)


def prepare_input(
    request: InputRequest,
    segmenter: Callable[[], Segmenter],
    *,
    report: Callable[[str], None],
    shows_progress: bool = True,
) -> MapInput:
    """Writes scans of a bag, and poses of a bag or of KISS-ICP, to `input` in the output directory.

    They are kept: the map refers to the scans, and the same request uses the files again.

    Args:
        request: What to map.
        segmenter: Creates the segmenter that finds the ground for KISS-ICP.
        report: Receives one line for each message or scan that cannot be read, and for each decision.
        shows_progress: Whether to show progress on a terminal.

    Raises:
        FileNotFoundError: The run or the poses do not exist.
        ImportError: A package for KISS-ICP or for compressed bags is not installed.
        ValueError: The output directory contains other files or is inside a bag, a topic does not exist, or a bag
            contains no clouds or poses. One line.
        OSError: A file cannot be read or written.
    """
    _check_topics(request)
    for path in (request.run, request.poses):
        if path != KISS_ICP and not Path(path).exists():
            raise FileNotFoundError(f"{path}: does not exist")
    if not request.needs_files:
        return MapInput(Path(request.run), Path(request.poses))
    if request.poses == KISS_ICP:
        needs("kiss_icp.kiss_icp", "odometry")
    folder = _checked_folder(request)
    found = MapInput(
        folder if is_bag(request.run) else Path(request.run),
        folder / "poses.txt" if request.poses == KISS_ICP or is_bag(request.poses) else Path(request.poses),
    )
    settings = segmenter().settings if request.poses == KISS_ICP else {}
    source = _source(request, settings)
    if _is_complete(folder, source):
        return found
    folder.mkdir(parents=True, exist_ok=True)
    _write_json(folder / _DESCRIPTION, {**source, "complete": False})
    _write_files(request, found, folder, segmenter, report, shows_progress)
    _write_json(folder / _DESCRIPTION, {**source, "complete": True})
    return found


def _write_files(
    request: InputRequest,
    found: MapInput,
    folder: Path,
    segmenter: Callable[[], Segmenter],
    report: Callable[[str], None],
    shows_progress: bool,
) -> None:
    frame: str | None = None
    if is_bag(request.run):
        with _Bar("clouds read", shows_progress) as bar:
            frame = _poses.clouds_from_bag(request.run, folder, clouds=request.topic, report=report, progress=bar)
    if request.poses == KISS_ICP:
        with _Bar("scans registered", shows_progress) as bar:
            _poses.from_kiss_icp(
                found.run,
                found.poses,
                bar,
                scans=_scans_of(found.run),
                columns=request.columns,
                segmenter=segmenter(),
                report=report,
            )
    elif is_bag(request.poses):
        _poses.poses_from_bag(request.poses, request.pose_topic, found.poses, frame=frame, report=report)


def _check_topics(request: InputRequest) -> None:
    if request.topic is not None and not is_bag(request.run):
        raise ValueError(f"topic: {request.run} is not a bag (expected a bag of clouds as the run)")
    if request.pose_topic is not None and not is_bag(request.poses):
        raise ValueError(f"pose_topic: {request.poses} is not a bag (expected a bag of poses)")


def _checked_folder(request: InputRequest) -> Path:
    """The directory of the files, which `prepare_input` may create or write to."""
    output = Path(request.output)
    for bag in (request.run, request.poses):
        source = Path(os.path.realpath(bag))
        target = Path(os.path.realpath(output))
        if is_bag(bag) and (target == source or source in target.parents):
            raise ValueError(f"{output}: is the bag or inside it (choose another directory)")
    folder = output / _FOLDER
    names = {file.name for file in output.iterdir()} if output.is_dir() else set()
    is_earlier_map = "run.json" in names or names == {_FOLDER}
    if names and (not is_earlier_map or (_FOLDER in names and not (folder / _DESCRIPTION).is_file())):
        raise ValueError(f"{output}: contains other files (expected an empty directory or an earlier map)")
    return folder


def _source(request: InputRequest, settings: dict[str, Any]) -> dict[str, Any]:
    """What the files are made from, as it is in the description."""
    source = {
        "run": _identity(request.run),
        "poses": _identity(request.poses) if is_bag(request.poses) else request.poses,
        "topic": request.topic,
        "pose_topic": request.pose_topic,
        "columns": request.columns,
        "settings": settings,
    }
    parsed: dict[str, Any] = json.loads(json.dumps(source, default=str))
    return parsed


def _identity(path: str) -> dict[str, Any]:
    """Where scans or a bag are, and how large they are."""
    folder = Path(path)
    files = [folder] if folder.is_file() else _scans_of(folder)
    if is_bag(path) and folder.is_dir():
        files = [file for file in folder.rglob("*") if file.is_file()]
    sizes = [file.stat().st_size for file in files]
    return {"path": os.path.realpath(folder), "files": len(sizes), "bytes": sum(sizes)}


def _scans_of(run: Path) -> list[Path]:
    folder = run / "velodyne"
    return _poses.scans_in(folder if folder.is_dir() else run)


def _is_complete(folder: Path, source: dict[str, Any]) -> bool:
    """Whether the files are there. Finished files of another source are an error."""
    path = folder / _DESCRIPTION
    if not path.is_file():
        return False
    try:
        found = json.loads(path.read_text())
        complete = bool(found.pop("complete"))
    except (ValueError, KeyError, AttributeError, TypeError):
        found, complete = None, False
    if not complete and found is not None:
        return False  # nothing was mapped from them
    if found != source:
        raise ValueError(
            f"{folder}: contains the scans or poses of another map (expected an empty output directory, or the same "
            "run and options to resume)"
        )
    return True


def _write_json(path: Path, content: dict[str, Any]) -> None:
    with atomic_write(path) as file:
        file.write((json.dumps(content, indent=1) + "\n").encode())


class _Bar:
    """Progress that learns the number of items with the first call."""

    def __init__(self, what: str, shown: bool) -> None:
        self._what = what
        self._shown = shown
        self._bar: Progress | None = None

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *error: object) -> None:
        if self._bar is not None:
            self._bar.clear()

    def __call__(self, done: int, total: int) -> None:
        if self._bar is None:
            self._bar = Progress(total, self._what, shown=self._shown)
        self._bar.add(1)
