# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""MovingPoints finds the points of a run that move; maps, votes and moving points can be saved."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pytest

import flagstone

SCANS = 20
RATE = 10


class Scan(NamedTuple):
    points: npt.NDArray[Any]
    result: flagstone.Segmentation
    pose: npt.NDArray[np.float64]
    time: float


@pytest.fixture(scope="module")
def street(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A simulated run of 20 scans at 10 Hz with traffic."""
    folder = tmp_path_factory.mktemp("street")
    flagstone.simulate(folder, scene="crossroads", sensor="vlp-16", frames=SCANS, rate=RATE, speed=8)
    return folder / "sequences" / "00"


@pytest.fixture(scope="module")
def scans(street: Path) -> list[Scan]:
    segmenter = flagstone.Surface(sensor="vlp-16")
    poses = np.loadtxt(street / "poses.txt").reshape(-1, 3, 4)
    clouds = [flagstone.io.read(file) for file in sorted((street / "velodyne").iterdir())]
    return [
        Scan(points, segmenter.segment(points), pose, number / RATE)
        for number, (points, pose) in enumerate(zip(clouds, poses, strict=True))
    ]


class Robot:
    """The state of a robot: a map, votes and moving points."""

    def __init__(self, **settings: Any) -> None:
        self.ground, self.vote = flagstone.GroundMap(), flagstone.LabelVote()
        self.moving = flagstone.MovingPoints(**settings)
        self.levellings: list[flagstone.Levelling] = []

    def add(self, scan: Scan) -> tuple[npt.NDArray[np.uint8], flagstone.MovingMask]:
        levelling = self.ground.add(scan.points, scan.result, scan.pose)
        self.levellings.append(levelling)
        mask = self.moving.add(scan.points, scan.result, scan.pose, levelling, scan.time)
        arguments = (scan.points, scan.result, scan.pose, levelling)
        self.vote.add(*arguments, mask.moving)
        labels = self.vote.relabel(*arguments, mask.moving)
        return self.ground.relabel(*arguments, labels), mask


def test_a_robot_has_the_live_labels_and_moving_points_of_a_mapped_run(
    street: Path, scans: list[Scan], tmp_path: Path
) -> None:
    mapped = flagstone.map(street, street / "poses.txt", tmp_path / "out", labels="live", rate=RATE, sensor="vlp-16")
    robot = Robot(delay=0)
    found = 0
    for scan, expected in zip(scans, mapped.open().scans(), strict=True):
        labels, mask = robot.add(scan)
        np.testing.assert_array_equal(labels, expected.labels)
        np.testing.assert_array_equal(mask.moving, expected.moving)
        found += int(mask.moving.sum())
    assert found == mapped.moving_points > 0


def test_later_scans_show_more_moving_points(scans: list[Scan]) -> None:
    robot = Robot(delay=5)
    masks = [robot.add(scan)[1] for scan in scans]
    again = [
        robot.moving.find(scan.points, scan.result, scan.pose, levelling, scan.time)
        for scan, levelling in zip(scans, robot.levellings, strict=True)
    ]
    assert not masks[0].moving.any()
    assert sum(int(mask.moving.sum()) for mask in again) > sum(int(mask.moving.sum()) for mask in masks)


def test_an_object_has_points_a_box_and_a_confidence(scans: list[Scan]) -> None:
    robot = Robot()
    points, mask = scans[-1].points, [robot.add(scan)[1] for scan in scans][-1]
    assert mask.objects_of_points.shape == (len(points),)
    assert mask.objects_of_points.dtype == np.uint32
    assert int(mask.objects_of_points.max()) == len(mask.objects) > 0
    xyz = np.stack([points["x"], points["y"], points["z"]], axis=1)
    for number, found in enumerate(mask.objects, start=1):
        of_object = xyz[mask.objects_of_points == number]
        assert found.points == len(of_object)
        assert 0 < found.confidence <= 1
        np.testing.assert_allclose(found.min, of_object.min(axis=0), atol=1e-4)
        np.testing.assert_allclose(found.max, of_object.max(axis=0), atol=1e-4)


def test_objects_describe_themselves(scans: list[Scan]) -> None:
    moving = flagstone.MovingPoints()
    assert moving.beam_spacing is None
    mask = moving.add(*scans[0][:3], flagstone.Levelling(), 0)
    assert repr(mask) == "MovingMask(0 moving points, 0 objects)"
    assert repr(moving) == "MovingPoints(1 scans)"
    assert moving.beam_spacing == pytest.approx(2, abs=0.1)
    assert moving.nbytes > 10_000


def test_the_memory_is_bounded_by_the_delay(scans: list[Scan]) -> None:
    moving = flagstone.MovingPoints(delay=0)
    for seconds in range(40):
        moving.add(*scans[0][:3], flagstone.Levelling(), seconds)
    assert moving.scans == 9


def test_an_error_changes_nothing(scans: list[Scan]) -> None:
    moving = flagstone.MovingPoints()
    points, result, pose, _ = scans[0]
    moving.add(points, result, pose, flagstone.Levelling(), 1)
    for arguments, message in (
        ((points, result, pose, flagstone.Levelling(), 1), "not later"),
        ((points, result, pose, flagstone.Levelling(), float("nan")), "not later"),
        ((points, result, np.zeros((3, 4)), flagstone.Levelling(), 2), "pose"),
        ((points[:5], result, pose, flagstone.Levelling(), 2), "no heights of this cloud"),
    ):
        with pytest.raises(ValueError, match=message):
            moving.add(*arguments)
    with pytest.raises(ValueError, match="no scan of this time"):
        moving.find(points, result, pose, flagstone.Levelling(), 2)
    assert moving.scans == 1


def test_flags_of_moving_points_of_another_scan_are_an_error(scans: list[Scan]) -> None:
    vote = flagstone.LabelVote()
    points, result, pose, _ = scans[0]
    for flags in (np.zeros(3, bool), np.zeros(len(points), np.uint8), np.zeros((len(points), 1), bool)):
        with pytest.raises(ValueError, match=r"moving: .* booleans, one per point"):
            vote.add(points, result, pose, flagstone.Levelling(), flags)
        with pytest.raises(ValueError, match=r"moving: .* booleans, one per point"):
            vote.relabel(points, result, pose, flagstone.Levelling(), flags)
    assert vote.voxels == 0


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"beam_spacing": 0.01}, "beam_spacing"),
        ({"beam_spacing": 0}, "beam_spacing: 0 is out of range .*None to measure it"),
        ({"max_range": 1000}, "max_range"),
        ({"delay": 11}, "delay"),
        ({"window": 20}, "window"),
    ],
)
def test_an_invalid_setting_is_an_error(settings: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        flagstone.MovingPoints(**settings)


# Saved states


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda state: pickle.loads(pickle.dumps(state))])
def test_a_robot_continues_from_a_copy(duplicate: Callable[[Any], Any], scans: list[Scan]) -> None:
    robot = Robot(delay=1, window=200, beam_spacing=2.0)
    for scan in scans[:12]:
        robot.add(scan)
    other = duplicate(robot)
    for scan in scans[12:]:
        labels, mask = robot.add(scan)
        other_labels, other_mask = other.add(scan)
        np.testing.assert_array_equal(other_labels, labels)
        np.testing.assert_array_equal(other_mask.objects_of_points, mask.objects_of_points)
        assert other_mask.objects == mask.objects
    for name in ("ground", "vote", "moving"):
        assert getattr(other, name).to_bytes() == getattr(robot, name).to_bytes()


@pytest.mark.parametrize("kind", [flagstone.GroundMap, flagstone.LabelVote, flagstone.MovingPoints])
def test_damaged_bytes_are_an_error_and_change_nothing(kind: Any, scans: list[Scan]) -> None:
    robot = Robot()
    robot.add(scans[0])
    (state,) = (part for part in (robot.ground, robot.vote, robot.moving) if isinstance(part, kind))
    good = state.to_bytes()
    empty = kind()
    for bad in (b"", good[:-1], good[:100] + b"x" + good[101:], b"something else"):
        with pytest.raises(ValueError, match=r"byte \d+: .* \(expected .*\)"):
            empty.from_bytes(bad)
    assert empty.to_bytes() == kind().to_bytes() != good
    empty.from_bytes(good)
    assert empty.to_bytes() == good


def test_a_map_with_a_memory_limit_is_the_same(scans: list[Scan], tmp_path: Path) -> None:
    limited = flagstone.GroundMap(max_memory=400_000, directory=tmp_path / "tiles")
    everything = flagstone.GroundMap()
    for scan in scans:
        assert limited.add(*scan[:3]) == everything.add(*scan[:3])
    assert limited.to_bytes() == everything.to_bytes()
    assert limited.nbytes < everything.nbytes
    assert any((tmp_path / "tiles").iterdir())
    np.testing.assert_array_equal(limited.grid().height, everything.grid().height)
    with pytest.raises(TypeError, match="memory limit cannot be pickled"):
        pickle.dumps(limited)


def test_a_memory_limit_needs_a_directory(tmp_path: Path) -> None:
    for settings in ({"max_memory": 1_000_000}, {"directory": tmp_path / "tiles"}):
        with pytest.raises(ValueError, match="max_memory: needs a directory"):
            flagstone.GroundMap(**settings)
    for limit in (0, -1):
        with pytest.raises(ValueError, match=r"max_memory: .* is out of range"):
            flagstone.GroundMap(max_memory=limit, directory=tmp_path / "tiles")
    with pytest.raises(ValueError, match="window and max_memory exclude each other"):
        flagstone.GroundMap(max_memory=1_000_000, directory=tmp_path / "tiles", window=100)
    assert not (tmp_path / "tiles").exists()
