# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Scans in three dimensions, in a notebook, a browser or a window, by Rerun."""

from __future__ import annotations

import contextlib
import os
import sys
import time
import uuid
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from flagstone._optional import needs
from flagstone._points import PointsLike
from flagstone._scene import blueprint, log_scan
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    import rerun

Where = Literal["notebook", "browser", "window"]

_SERVER_MEMORY = "25%"  # of the machine's; of what is more, the earliest scans are forgotten
_served: list[Any] = []  # recordings that browsers may still ask for


def show(
    points: PointsLike | Iterable[tuple[PointsLike, Segmentation]],
    result: Segmentation | None = None,
    *,
    save: str | os.PathLike[str] | None = None,
    where: Where | None = None,
) -> None:
    """Shows segmented scans in three dimensions, to turn, to zoom into and to point at.

    Points are coloured by label, patches are tinted by verdict, each on its plane with its normal, and the ground is a
    shaded surface. The mouse over a point says its height above the ground, over a patch why it has its verdict; a
    click on a normal lists all of the patch's numbers in the selection panel. Patches without a plane are not drawn.

    Several scans become a time line.

    Args:
        points: (N, >=3), as `Segmenter.segment` takes them, metres; or, without `result`, pairs of points and result,
            one a scan; a generator may make them one by one.
        result: What segmenting the points gave.
        save: Path of a recording to write, ending in `.rrd`, instead of showing anything: open it later with
            `rerun FILE.rrd`. It appears whole or not at all.
        where: "notebook": below the cell; "browser": in the default browser, served by this process; "window": in a
            window of its own, which outlives this process. Without it, in a notebook there, else in the browser. A
            script that shows in the browser goes on when interrupted with Ctrl-C.

    Raises:
        ImportError: Rerun is not installed, or for notebooks rerun-notebook.
        TypeError: These are no points, or no pairs of points and result.
        ValueError: A result does not belong to its points, or both `save` and `where` are given.
        OSError: The recording cannot be written.
    """
    if save is not None and where is not None:
        raise ValueError(f"where: {where!r} together with save; a recording is either saved or shown: call show twice")
    if where not in (None, "notebook", "browser", "window"):
        raise ValueError(f"where: {where!r}; allowed are 'notebook', 'browser' and 'window'")
    rr = needs("rerun", extra="viewer")
    scans = [(points, result)] if result is not None else points
    recording = rr.RecordingStream("flagstone", recording_id=str(uuid.uuid4()))
    if save is not None:
        _save(recording, Path(save), scans)
        return
    where = where or ("notebook" if _in_notebook() else "browser")
    if where == "notebook":
        _show_in_notebook(recording, scans)
    elif where == "window":
        recording.spawn(default_blueprint=blueprint())
        _log_all(recording, scans)
        recording.flush()
    else:
        _show_in_browser(recording, scans)


def _log_all(recording: rerun.RecordingStream, scans: Any) -> None:
    for number, scan in enumerate(scans):
        try:
            points, result = scan
        except (TypeError, ValueError):
            points = result = None
        if not isinstance(result, Segmentation):
            raise TypeError(
                f"points: {type(scan).__name__} where a pair of points and result is wanted: show(points, result), "
                "or show([(points, result), ...])"
            )
        log_scan(recording, number, points, result)


def _save(recording: rerun.RecordingStream, path: Path, scans: Any) -> None:
    """Writes beside the file and renames, so that who is interrupted leaves what was there before."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path.parent}: no such folder; make it, or save elsewhere")
    try:
        recording.save(part, default_blueprint=blueprint())
        _log_all(recording, scans)
        recording.flush()
        recording.disconnect()
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def _show_in_notebook(recording: rerun.RecordingStream, scans: Any) -> None:
    needs("rerun_notebook", extra="viewer")
    viewer = needs("rerun.notebook", extra="viewer").Viewer(
        width="auto", height=600, recording=recording, blueprint=blueprint()
    )
    _log_all(recording, scans)
    recording.flush()
    viewer.display()


def _show_in_browser(recording: rerun.RecordingStream, scans: Any) -> None:
    rr = needs("rerun", extra="viewer")
    address = recording.serve_grpc(
        grpc_port=_free_port(), default_blueprint=blueprint(), server_memory_limit=_SERVER_MEMORY
    )
    _log_all(recording, scans)
    recording.flush()
    rr.serve_web_viewer(web_port=_free_port(), connect_to=address)
    _served.append(recording)
    if not hasattr(sys, "ps1") and not sys.flags.interactive and not _in_notebook():
        print("flagstone: shown in the browser until interrupted, Ctrl-C", file=sys.stderr)
        with contextlib.suppress(KeyboardInterrupt):
            while True:
                time.sleep(3600)


def _free_port() -> int:
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def _in_notebook() -> bool:
    """Whether a notebook's kernel runs this; a terminal's IPython does not count."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return type(shell).__name__ == "ZMQInteractiveShell"
