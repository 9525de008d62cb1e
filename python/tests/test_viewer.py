# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Recordings for the viewer contain the results."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Scan, random_scan
from recordings import Row, packed, rows_of

import flagstone
from flagstone import viewer
from flagstone._palette import LABELS, TINT, VERDICTS

pytest.importorskip("rerun", reason="rerun-sdk writes recordings")
chunks = pytest.importorskip("rerun.chunk", reason="rerun-sdk 0.41 and later reads recordings")


@pytest.fixture(scope="module", params=["surface", "patchwork"])
def result(request: pytest.FixtureRequest, scan: Scan) -> flagstone.Segmentation:
    return flagstone.make_segmenter(request.param).segment(scan)


@pytest.fixture(scope="module")
def recorded(
    scan: Scan, result: flagstone.Segmentation, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, list[Row]]:
    path = tmp_path_factory.mktemp("recorded") / "scan.rrd"
    flagstone.show(scan, result, save=path)
    return rows_of(path)


def test_a_recording_contains_every_point_in_the_colour_of_its_label(
    scan: Scan, result: flagstone.Segmentation, recorded: dict[str, list[Row]]
) -> None:
    total = 0
    for label in (label for label in flagstone.Label if label != flagstone.Label.INVALID):
        (row,) = recorded[f"/points/{label.name.lower()}"]
        positions = np.array(row["Points3D:positions"]).reshape(-1, 3)
        np.testing.assert_array_equal(positions, scan[result.labels == label, :3])
        assert row["Points3D:colors"] == [packed(LABELS[label])]
        total += len(positions)
    assert total == len(scan)


def test_a_recording_contains_the_known_heights(result: flagstone.Segmentation, recorded: dict[str, list[Row]]) -> None:
    (row,) = recorded["/points/ground"]
    assert ("flagstone.Point:height_above_ground" in row) == bool(result.surface)
    if result.surface:
        heights = np.array(row["flagstone.Point:height_above_ground"], np.float32)
        np.testing.assert_array_equal(heights, result.heights[result.ground])


def quads_of(recorded: dict[str, list[Row]]) -> dict[str, Row]:
    return {path: rows[0] for path, rows in recorded.items() if path.startswith("/patches/")}


def test_every_patch_with_a_plane_is_a_quad_in_the_colour_of_its_status(
    result: flagstone.Segmentation, recorded: dict[str, list[Row]]
) -> None:
    patches = result.patches
    with_plane = patches[patches["normal"].any(axis=1)]
    quads = quads_of(recorded)
    assert len(with_plane) > 20
    assert len(quads) == len(with_plane)
    for patch in with_plane:
        verdict = flagstone.Verdict(patch["verdict"])
        path = f"/patches/{verdict.name.lower()}/zone_{patch['zone']}/ring_{patch['ring']}/sector_{patch['sector']}"
        assert quads[path]["Mesh3D:albedo_factor"] == [packed(VERDICTS[verdict], round(255 * TINT))]
        corners = np.array(quads[path]["Mesh3D:vertex_positions"])
        np.testing.assert_allclose(corners @ patch["normal"] + patch["d"], 0, atol=1e-3, err_msg="on its plane")
        around = np.min(corners, axis=0) - 0.1, np.max(corners, axis=0) + 0.1
        if patch["ground_count"] > 10:
            assert (around[0] <= patch["mean"]).all()
            assert (patch["mean"] <= around[1]).all()


def test_quads_fill_their_bins(scan: Scan) -> None:
    result = flagstone.Patchwork().segment(scan)
    from flagstone._geometry import patch_quads

    for patch, quad in zip(result.patches, patch_quads(result), strict=True):
        if patch["zone"] == 1 and abs(patch["normal"][2]) > 0.999:
            a, b = (quad[:, i, :2] - quad[:, 0, :2] for i in (1, 2))
            area = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
            radii = [9.576, 11.393, 13.266, 14.891, 16.963]
            inner, outer = radii[patch["ring"]], radii[patch["ring"] + 1]
            assert area == pytest.approx(np.pi * (outer**2 - inner**2) / 32, rel=0.15)


def test_the_tooltip_of_a_patch_shows_its_values(recorded: dict[str, list[Row]]) -> None:
    for path, row in quads_of(recorded).items():
        components = [name for name in row if ":" in name]
        assert len(components) <= 3, f"{path}: a tip shows no values of an entity that has more"
        (line,) = next(row[name] for name in components if name.startswith("flagstone.Patch:"))
        assert 20 < len(line) <= 75
        assert line.endswith(" ground")


def test_normals_carry_every_number_of_their_patch(
    result: flagstone.Segmentation, recorded: dict[str, list[Row]]
) -> None:
    (row,) = recorded["/normals"]
    patches = result.patches
    with_plane = patches[patches["normal"].any(axis=1)]
    np.testing.assert_array_equal(np.array(row["Arrows3D:origins"], np.float32), with_plane["mean"])
    np.testing.assert_allclose(np.array(row["Arrows3D:vectors"]), with_plane["normal"], atol=1e-6)
    for name in ("zone", "ring", "sector", "point_count", "ground_count", "uprightness", "elevation", "flatness"):
        np.testing.assert_array_equal(np.array(row[f"flagstone.Patches:{name}"], np.float32), with_plane[name])
    names = [flagstone.Verdict(code).name.lower() for code in with_plane["verdict"]]
    assert row["flagstone.Patches:verdict"] == names


def test_the_surface_mesh_has_the_heights_of_the_surface(
    result: flagstone.Segmentation, recorded: dict[str, list[Row]]
) -> None:
    (row,) = recorded["/surface"]
    corners = np.array(row["Mesh3D:vertex_positions"], np.float32).reshape(-1, 3)
    if not result.surface:
        assert not len(corners)
        return
    np.testing.assert_allclose(corners[:, 2], result.surface.height(corners[:, 0], corners[:, 1]), atol=1e-4)
    assert len(corners) > 10_000
    assert len(row["Mesh3D:vertex_colors"]) == len(corners)


def test_surface_mesh_has_no_gaps_where_grids_meet(scan: Scan) -> None:
    from flagstone._geometry import surface_mesh

    mesh = surface_mesh(flagstone.Surface().segment(scan))
    edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, faces = np.unique(edges, axis=0, return_counts=True)
    rim = mesh.corners[edges[faces == 1].ravel(), :2]
    assert faces.max() == 2
    assert (np.abs(rim).max(axis=1) > 30).all(), "no rim near the sensor, where cells of four sizes meet"


def test_quads_and_surface_of_a_tilted_sensor_match_its_points() -> None:
    turn = np.radians(20)
    axes = np.array([[np.cos(turn), 0, -np.sin(turn)], [0, 1, 0], [np.sin(turn), 0, np.cos(turn)]])
    level = random_scan()[:, :3]
    leaning = (level @ axes).astype(np.float32)
    result = flagstone.Surface(tilt=tuple(axes[2])).segment(leaning)
    from flagstone._geometry import patch_quads, surface_mesh

    on_ground = result.patches["verdict"] == flagstone.Verdict.GROUND
    quads = np.concatenate([q for q, ground in zip(patch_quads(result), on_ground, strict=True) if ground])
    for corners in (quads.reshape(-1, 3), surface_mesh(result).corners):
        assert len(corners) > 100
        distances = np.abs(corners @ axes[2] + 1.73)
        # Planes of patches with few points are slightly tilted; their corners show it most.
        assert np.quantile(distances, 0.99) < 0.1 and distances.max() < 0.2


def test_each_scan_of_a_timeline_shows_only_its_own_patches(tmp_path: Path) -> None:
    segmenter = flagstone.Patchwork()
    scans = [random_scan(seed=1), random_scan(seed=2)[:5000], np.empty((0, 4), np.float32)]
    flagstone.show(((scan, segmenter.segment(scan)) for scan in scans), save=tmp_path / "drive.rrd")
    recorded = rows_of(tmp_path / "drive.rrd")
    rows = recorded["/points/ground"]
    assert [row["scan"] for row in rows] == [0, 1, 2]
    assert [len(row["Points3D:positions"]) for row in rows] == [segmenter.segment(s).ground.sum() for s in scans]
    clears = recorded["/patches"]
    assert [row["scan"] for row in clears] == [0, 1, 2]
    assert all(row["Clear:is_recursive"] == [True] for row in clears)


def test_points_without_a_position_are_omitted(tmp_path: Path) -> None:
    points = np.array([[5, 1, 0], [np.nan, 1, 0], [6, np.inf, 0], [0, 0, 0]], np.float32)
    flagstone.show(points, flagstone.Surface().segment(points), save=tmp_path / "scan.rrd")
    recorded = rows_of(tmp_path / "scan.rrd")
    positions = [
        p for path, (row,) in recorded.items() if path.startswith("/points/") for p in row["Points3D:positions"]
    ]
    assert positions == [[5, 1, 0]]


@pytest.mark.parametrize("points", [np.empty((0, 3), np.float32), np.full((3, 3), np.nan, np.float32)])
def test_a_scan_without_points_gives_a_recording_without_points(points: Scan, tmp_path: Path) -> None:
    flagstone.show(points, flagstone.Surface().segment(points), save=tmp_path / "scan.rrd")
    recorded = rows_of(tmp_path / "scan.rrd")
    assert all(not row["Points3D:positions"] for path, (row,) in recorded.items() if path.startswith("/points/"))


def test_a_recording_contains_its_initial_view(scan: Scan, tmp_path: Path) -> None:
    flagstone.show(scan, flagstone.Surface().segment(scan), save=tmp_path / "scan.rrd")
    reader = chunks.RrdReader(tmp_path / "scan.rrd")
    (blueprint,) = reader.blueprints()
    names = [
        row["ViewBlueprint:display_name"]
        for chunk in reader.stream(store=blueprint)
        for row in chunk.to_record_batch().to_pylist()
        if "ViewBlueprint:display_name" in row
    ]
    assert sorted(names) == [["Everything"], ["Patches"], ["Surface"]]


def test_an_interrupted_save_keeps_the_existing_file(scan: Scan, tmp_path: Path) -> None:
    path = tmp_path / "drive.rrd"
    path.write_bytes(b"existing")

    def interrupted() -> Any:
        yield scan, flagstone.Surface().segment(scan)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        flagstone.show(interrupted(), save=path)
    assert path.read_bytes() == b"existing"
    assert list(tmp_path.iterdir()) == [path]


def test_a_recording_in_a_missing_directory_is_an_error(scan: Scan, tmp_path: Path) -> None:
    result = flagstone.Surface().segment(scan)
    with pytest.raises(FileNotFoundError, match="nowhere: directory does not exist"):
        flagstone.show(scan, result, save=tmp_path / "nowhere" / "scan.rrd")


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the viewers that were opened. Nothing is shown."""
    places: list[str] = []
    monkeypatch.setattr(viewer, "_show_in_notebook", lambda recording, scans: places.append("notebook"))
    monkeypatch.setattr(viewer, "_show_in_browser", lambda recording, scans: places.append("browser"))
    return places


def test_the_browser_is_used_outside_a_notebook(scan: Scan, opened: list[str]) -> None:
    flagstone.show(scan, flagstone.Surface().segment(scan))
    assert opened == ["browser"]


SHOWN = """
import re, sys, urllib.request, flagstone
from conftest import random_scan

scan = random_scan()
flagstone.show(scan, flagstone.Surface().segment(scan))
print("continues")
address = re.search("http://localhost:[0-9]+/", open(sys.argv[1]).read())[0]
print(urllib.request.urlopen(address).status)
"""


def test_without_a_browser_the_address_is_printed_and_the_program_continues(tmp_path: Path) -> None:
    log = tmp_path / "log"
    path = os.pathsep.join([str(Path(flagstone.__file__).parents[1]), str(Path(__file__).parent)])
    environment = {"PATH": "", "PYTHONPATH": path}
    with log.open("w") as errors:
        done = subprocess.run(
            [sys.executable, "-c", SHOWN, log],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            timeout=120,
        )
    assert done.stdout == "continues\n200\n", log.read_text()
    assert "no browser found; http://localhost:" in log.read_text()


def test_the_notebook_is_used_in_a_notebook(scan: Scan, opened: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    kernel = type("ZMQInteractiveShell", (), {})()
    monkeypatch.setitem(sys.modules, "IPython", type("IPython", (), {"get_ipython": staticmethod(lambda: kernel)}))
    flagstone.show(scan, flagstone.Surface().segment(scan))
    flagstone.show(scan, flagstone.Surface().segment(scan), where="browser")
    assert opened == ["notebook", "browser"]


def test_the_notebook_widget_receives_the_recording(scan: Scan, monkeypatch: pytest.MonkeyPatch) -> None:
    widgets = pytest.importorskip("rerun_notebook", reason="rerun-notebook shows scans in notebooks")
    sent: list[bytes] = []
    monkeypatch.setattr(widgets.Viewer, "send_rrd", lambda self, data: sent.append(data))
    monkeypatch.setattr(
        importlib.import_module("rerun.notebook").Viewer, "display", lambda self, block_until_ready=False: None
    )
    flagstone.show(scan, flagstone.Surface().segment(scan), where="notebook")
    assert sum(map(len, sent)) > scan[:, :3].nbytes / 2


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"where": "moon"}, ValueError, "where: 'moon' is not a viewer"),
        ({"where": "browser", "save": "scan.rrd"}, ValueError, "cannot be combined with save"),
    ],
)
def test_unknown_viewers_are_rejected(
    scan: Scan, arguments: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        flagstone.show(scan, flagstone.Surface().segment(scan), **arguments)


def test_results_of_other_points_are_rejected(scan: Scan, tmp_path: Path) -> None:
    result = flagstone.Surface().segment(scan)
    with pytest.raises(ValueError, match=f"result: {len(scan)} labels do not match 7 points"):
        flagstone.show(scan[:7], result, save=tmp_path / "scan.rrd")
    with pytest.raises(TypeError, match="is not a pair of points and result"):
        flagstone.show(scan, save=tmp_path / "scan.rrd")
    assert not list(tmp_path.iterdir())


def test_without_rerun_the_error_names_the_extra(scan: Scan, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(ImportError, match=r"pip install 'flagstone\[viewer\]'"):
        flagstone.show(scan, flagstone.Surface().segment(scan))
