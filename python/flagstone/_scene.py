# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What of a scan goes into a recording, and how the viewer opens on it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from flagstone._optional import needs
from flagstone._palette import LABELS, PANEL, TINT, VERDICTS
from flagstone._patch_quads import patch_quads
from flagstone._points import PointsLike, columns_of
from flagstone._surface_mesh import surface_mesh
from flagstone.codes import Label, Verdict
from flagstone.segmentation import Segmentation

if TYPE_CHECKING:
    import rerun
    import rerun.blueprint

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
    """The view that a recording opens on: from behind and above, as a driver might from a tall truck."""
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
    """Writes a scan, its labels, its patches and its surface into a recording.

    Args:
        recording: What to write into.
        number: Its place on the time line.
        points: (N, >=3), metres.
        result: What segmenting them gave.
    """
    x, y, z = columns_of(points)
    if len(result) != len(x):
        raise ValueError(f"result: {len(result)} labels for {len(x)} points; pass what segmenting these points gave")
    recording.set_time(TIMELINE, sequence=number)
    _log_points(recording, np.stack([x, y, z], axis=1).astype(np.float32, copy=False), result)
    _log_patches(recording, result)
    _log_surface(recording, result)


def _log_points(recording: rerun.RecordingStream, points: npt.NDArray[np.float32], result: Segmentation) -> None:
    """An entity a label, so that each can be switched off; with each point its height, of methods that know it."""
    rr = needs("rerun", extra="viewer")
    placed = np.isfinite(points).all(axis=1)
    for label in _DRAWN:
        shown = placed & (result.labels == label)
        parts = [rr.Points3D(points[shown], colors=[LABELS[label]], radii=[rr.Radius.ui_points(1.2)])]
        if result.surface:
            heights = {"height_above_ground": result.heights[shown]}
            parts.append(rr.DynamicArchetype("flagstone.Point", components=heights))
        recording.log(f"points/{label.name.lower()}", *parts, strict=True)


def _log_patches(recording: rerun.RecordingStream, result: Segmentation) -> None:
    """An entity a patch, since the viewer tells apart what the mouse is over by entity.

    A tip shows all of an entity if that is no more than three values: here corners, colour and one line of numbers.
    All numbers, each by itself, are with the normals.
    """
    rr = needs("rerun", extra="viewer")
    recording.log("patches", rr.Clear(recursive=True), strict=True)  # those of the scan before
    patches = result.patches
    for patch, quad in zip(patches, patch_quads(result), strict=True):
        if not len(quad):
            continue
        verdict = Verdict(patch["verdict"])
        recording.log(
            f"patches/{verdict.name.lower()}/zone_{patch['zone']}/ring_{patch['ring']}/sector_{patch['sector']}",
            rr.Mesh3D(vertex_positions=quad.reshape(-1, 3), albedo_factor=(*VERDICTS[verdict], round(255 * TINT))),
            rr.DynamicArchetype("flagstone.Patch", components=in_one_line(patch)),
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


def in_one_line(patch: Any) -> dict[str, str]:
    """The numbers that say most of a patch, under a name for them: as many as a tip has room for, 70 characters."""
    points = f"{patch['ground_count']}/{patch['point_count']} ground"
    if patch["uprightness"] or patch["elevation"] or patch["flatness"]:
        terms = " · ".join(f"{name} {patch[name]:.2g}" for name in ("uprightness", "elevation", "flatness"))
        return {"likelihood": f"{patch['likelihood']:.2g} = {terms}; {points}"}
    slope = np.degrees(np.arccos(np.clip(patch["normal"][2], -1, 1)))
    spread = 100 * np.sqrt(max(patch["eigenvalues"][2], 0))
    return {"plane": f"slope {slope:.1f} degrees, spread {spread:.1f} cm; {points}"}


def _log_surface(recording: rerun.RecordingStream, result: Segmentation) -> None:
    rr = needs("rerun", extra="viewer")
    mesh = surface_mesh(result)
    recording.log(
        "surface",
        rr.Mesh3D(vertex_positions=mesh.corners, triangle_indices=mesh.triangles, vertex_colors=mesh.colors),
        strict=True,
    )
