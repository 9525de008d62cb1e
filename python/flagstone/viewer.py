# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Interactive 3D view of scans with Rerun, in a notebook, a browser or a window."""

from __future__ import annotations

import contextlib
import os
import sys
import time
import urllib.parse
import uuid
import webbrowser
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from flagstone._geometry import patch_quads, surface_mesh
from flagstone._optional import needs
from flagstone._palette import LABELS, PANEL, TINT, VERDICTS
from flagstone._points import PointsLike, columns_of
from flagstone.codes import Label, Verdict
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    import rerun
    import rerun.blueprint

Where = Literal["notebook", "browser", "window"]

_SERVER_MEMORY = "25%"  # of the machine's memory; beyond it, the server drops the oldest scans
_served: list[Any] = []  # recordings that browsers may still request


def show(
    points: PointsLike | Iterable[tuple[PointsLike, Segmentation]],
    result: Segmentation | None = None,
    *,
    save: str | os.PathLike[str] | None = None,
    where: Where | None = None,
) -> None:
    """Shows segmented scans in an interactive 3D view.

    Points are coloured by label. Patches are tinted by status (see `Verdict`) and drawn on their planes with their
    normals; patches without a plane are not drawn. The ground is a shaded surface. Several scans become a timeline.

    Hover over a point to see its height above the ground, and over a patch to see the values behind its status. Click a
    normal to list all values of its patch in the selection panel.

    Args:
        points: (N, >=3) in metres, as `Segmenter.segment` accepts them. Without `result`, an iterable of pairs
            (points, result), one per scan; it can be a generator.
        result: Result of segmenting the points.
        save: Path of a recording (`.rrd`) to write instead of showing it. Open it with `rerun FILE.rrd`. The file is
            written atomically.
        where: "notebook": below the cell. "browser": in the default browser, served by this process; the address is
            printed. "window": in a separate window, which stays open after this process ends. The default is
            "notebook" in a notebook, otherwise "browser". A script that shows scans in the browser waits until you
            press Ctrl-C. It does not wait if there is neither a browser nor a terminal.

    Raises:
        ImportError: Rerun is not installed; in notebooks, rerun-notebook is not installed.
        TypeError: The points are not floats in CPU memory, or an element is not a pair (points, result).
        ValueError: A result does not match its points, or both `save` and `where` are set.
        OSError: The recording cannot be written.
    """
    if save is not None and where is not None:
        raise ValueError(f"where: {where!r} cannot be combined with save (call show twice, to show and to save)")
    if where not in (None, "notebook", "browser", "window"):
        raise ValueError(f"where: {where!r} is not a viewer (expected 'notebook', 'browser' or 'window')")
    rr = needs("rerun", extra="viewer")
    scans = [(points, result)] if result is not None else points
    recording = rr.RecordingStream("flagstone", recording_id=str(uuid.uuid4()))
    if save is not None:
        save_recording(recording, Path(save), blueprint(), lambda: _log_all(recording, scans))
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
                f"points: {type(scan).__name__} is not a pair of points and result (expected show(points, result) or "
                "show([(points, result), ...]))"
            )
        log_scan(recording, number, points, result)


def save_recording(
    recording: rerun.RecordingStream, path: Path, view: rerun.blueprint.Blueprint, log: Callable[[], None]
) -> None:
    """Writes what `log` adds to a recording.

    The recording is a temporary file that is renamed, so that an interrupted call keeps an existing one.

    Raises:
        FileNotFoundError: The directory does not exist.
    """
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path.parent}: directory does not exist (create it, or choose another path)")
    try:
        recording.save(part, default_blueprint=view)
        log()
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
    port = _free_port()
    has_browser = _has_browser()
    rr.serve_web_viewer(web_port=port, connect_to=address, open_browser=has_browser)
    _served.append(recording)
    url = f"http://localhost:{port}/?url={urllib.parse.quote(address, safe='')}"
    where = f"shown at {url}" if has_browser else f"no browser found; open {url}"
    if hasattr(sys, "ps1") or sys.flags.interactive or _in_notebook():
        print(f"flagstone: {where}", file=sys.stderr)
    elif has_browser or (sys.stdin is not None and sys.stdin.isatty()):
        print(f"flagstone: {where} (press Ctrl-C to continue)", file=sys.stderr)
        with contextlib.suppress(KeyboardInterrupt):
            while True:
                time.sleep(3600)
    else:
        print(f"flagstone: no browser found; {url} is available while this program runs", file=sys.stderr)


def _has_browser() -> bool:
    """Whether a graphical browser is available. A text browser would take over the terminal."""
    try:
        browser = webbrowser.get()
    except webbrowser.Error:
        return False
    return "BROWSER" in os.environ or type(browser) is not webbrowser.GenericBrowser


def _free_port() -> int:
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def _in_notebook() -> bool:
    """Whether this code runs in the kernel of a notebook. IPython in a terminal does not count."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return type(shell).__name__ == "ZMQInteractiveShell"


TIMELINE = "scan"
_DRAWN = (Label.GROUND, Label.NONGROUND, Label.NOISE, Label.OUT_OF_RANGE)
_ARROW, _ARROW_RADIUS = 1.0, 0.05  # metres
_NUMBERS = (
    "zone",
    "ring",
    "sector",
    "point_count",
    "ground_count",
    "uprightness",
    "elevation",
    "flatness",
    "likelihood",
    "surface_variable",
)


def blueprint() -> rerun.blueprint.Blueprint:
    """The initial view of a recording: from behind and above, as from a tall truck."""
    rrb = needs("rerun.blueprint", extra="viewer")

    def view(name: str, *contents: str) -> Any:
        return rrb.Spatial3DView(
            name=name,
            contents=list(contents),
            background=PANEL,
            line_grid=False,
            eye_controls=rrb.EyeControls3D(position=(-24, 0, 15), look_target=(4, 0, -2), eye_up=(0, 0, 1)),
        )

    made: rerun.blueprint.Blueprint = rrb.Blueprint(
        rrb.Tabs(
            view("Patches", "points/**", "patches/**", "normals/**"),
            view("Surface", "points/nonground", "points/noise", "surface/**"),
            view("Everything", "/**"),
        ),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed"),
    )
    return made


def log_scan(recording: rerun.RecordingStream, number: int, points: PointsLike, result: Segmentation) -> None:
    """Adds a scan with its labels, patches and surface to a recording.

    Args:
        recording: Recording to add to.
        number: Index of the scan on the timeline.
        points: (N, >=3), metres.
        result: Result of segmenting the points.

    Raises:
        ValueError: The result does not match the points.
    """
    x, y, z = columns_of(points)
    if len(result) != len(x):
        raise ValueError(
            f"result: {len(result)} labels do not match {len(x)} points (pass the result of segmenting these points)"
        )
    recording.set_time(TIMELINE, sequence=number)
    _log_points(recording, np.stack([x, y, z], axis=1).astype(np.float32, copy=False), result)
    _log_patches(recording, result)
    _log_surface(recording, result)


def _log_points(recording: rerun.RecordingStream, points: npt.NDArray[np.float32], result: Segmentation) -> None:
    """Logs one entity per label, so that you can hide each label. Points have their height above the ground, if any."""
    rr = needs("rerun", extra="viewer")
    finite = np.isfinite(points).all(axis=1)
    for label in _DRAWN:
        shown = finite & (result.labels == label)
        parts = [rr.Points3D(points[shown], colors=[LABELS[label]], radii=[rr.Radius.ui_points(1.2)])]
        if result.surface:
            heights = {"height_above_ground": result.heights[shown]}
            parts.append(rr.DynamicArchetype("flagstone.Point", components=heights))
        recording.log(f"points/{label.name.lower()}", *parts, strict=True)


def _log_patches(recording: rerun.RecordingStream, result: Segmentation) -> None:
    """Logs one entity per patch, because the viewer shows tooltips per entity.

    A tooltip shows the values of an entity only if there are at most three: corners, colour and one line of text. The
    normals have all values separately.
    """
    rr = needs("rerun", extra="viewer")
    recording.log("patches", rr.Clear(recursive=True), strict=True)  # patches of the previous scan
    patches = result.patches
    for patch, quad in zip(patches, patch_quads(result), strict=True):
        if not len(quad):
            continue
        verdict = Verdict(patch["verdict"])
        recording.log(
            f"patches/{verdict.name.lower()}/zone_{patch['zone']}/ring_{patch['ring']}/sector_{patch['sector']}",
            rr.Mesh3D(vertex_positions=quad.reshape(-1, 3), albedo_factor=(*VERDICTS[verdict], round(255 * TINT))),
            rr.DynamicArchetype("flagstone.Patch", components=tooltip(patch)),
            strict=True,
        )
    with_plane = patches[patches["normal"].any(axis=1)]
    verdicts = [Verdict(code) for code in with_plane["verdict"]]
    numbers: dict[str, Any] = {name: with_plane[name].copy() for name in _NUMBERS}
    recording.log(
        "normals",
        rr.Arrows3D(
            origins=with_plane["mean"],
            vectors=_ARROW / result.mount.scale * with_plane["normal"],
            colors=[VERDICTS[verdict] for verdict in verdicts],
            radii=[_ARROW_RADIUS / result.mount.scale],
        ),
        rr.DynamicArchetype(
            "flagstone.Patches", components={"verdict": [verdict.name.lower() for verdict in verdicts], **numbers}
        ),
        strict=True,
    )


def tooltip(patch: Any) -> dict[str, str]:
    """The main values of a patch, with a name for them. A tooltip has room for about 70 characters."""
    points = f"{patch['ground_count']}/{patch['point_count']} ground"
    if patch["uprightness"] or patch["elevation"] or patch["flatness"]:
        terms = " · ".join(f"{name} {patch[name]:.2g}" for name in ("uprightness", "elevation", "flatness"))
        return {"likelihood": f"{patch['likelihood']:.2g} = {terms}; {points}"}
    slope = np.degrees(np.arccos(np.clip(patch["normal"][2], -1, 1)))
    deviation = 100 * np.sqrt(max(patch["eigenvalues"][2], 0))
    return {"plane": f"slope {slope:.1f} degrees, RMS distance {deviation:.1f} cm; {points}"}


def _log_surface(recording: rerun.RecordingStream, result: Segmentation) -> None:
    rr = needs("rerun", extra="viewer")
    mesh = surface_mesh(result)
    recording.log(
        "surface",
        rr.Mesh3D(vertex_positions=mesh.corners, triangle_indices=mesh.triangles, vertex_colors=mesh.colors),
        strict=True,
    )
