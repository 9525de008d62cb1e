# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Poses of the scans of a run: from bags of every format, and with KISS-ICP."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import flagstone
from flagstone import _poses
from flagstone.bags.frames import rotation_of
from flagstone.bags.messages import parse_pose, parse_timed_transforms
from flagstone.bags.trajectory import Trajectory, interpolated, quaternion_of

Array = npt.NDArray[np.float64]


def table(path: Path) -> Array:
    """The numbers of a TUM file, or of a CSV file with a header."""
    separator = "," if path.read_text().startswith("x,") else None
    return np.loadtxt(path, delimiter=separator, ndmin=2, skiprows=1)


def turn(yaw: float) -> tuple[float, float, float, float]:
    """The quaternion of a turn about z, radians."""
    return 0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2))


def test_quaternions_describe_their_rotations() -> None:
    random = np.random.default_rng(1)
    for quaternion in [*random.normal(size=(200, 4)), *np.eye(4)]:
        unit = quaternion / np.linalg.norm(quaternion)
        found = quaternion_of(rotation_of(quaternion))
        assert abs(float(found @ unit)) == pytest.approx(1, abs=1e-12)
        assert found[3] >= 0


def test_paths_are_interpolated_along_the_shorter_way() -> None:
    quaternions = np.array([turn(0), turn(0.2)])
    quaternions[1] *= -1
    path = Trajectory(np.array([0, 100]), np.array([[0.0, 0, 0], [4, 2, 0]]), quaternions)

    found = interpolated(path, np.array([0, 25, 100]))

    np.testing.assert_allclose(found.positions[:, 0], [0, 1, 4])
    yaw = 2 * np.arctan2(found.quaternions[:, 2], found.quaternions[:, 3])
    np.testing.assert_allclose(yaw[:2], [0, 0.05], atol=1e-4)


def test_a_path_of_one_pose_is_that_pose() -> None:
    path = Trajectory(np.array([5]), np.array([[1.0, 2, 3]]), np.array([turn(1)]))
    np.testing.assert_allclose(interpolated(path, np.array([5])).positions, [[1, 2, 3]])


def test_times_are_written_exactly() -> None:
    assert _poses.seconds_text(1_700_000_000_123_456_789) == "1700000000.123456789"
    assert _poses.seconds_text(-1_500_000_000) == "-1.500000000"


class Bags:
    """Bags of a vehicle that drives along a circle, with a sensor ahead of the centre of the vehicle."""

    def __init__(self, format: str, folder: Path) -> None:
        import bag_scenes

        self.scenes = bag_scenes
        self.format = format
        self.folder = folder
        self.clouds = bag_scenes.scans(6, points=400)
        self.times = [bag_scenes.START + index * bag_scenes.PERIOD for index in range(6)]

    def vehicle(self, time: int) -> tuple[float, float, float]:
        """x, y and yaw of the vehicle."""
        yaw = 0.2 * (time - self.scenes.START) / 1e9
        return 50 * float(np.sin(yaw)), 50 - 50 * float(np.cos(yaw)), yaw

    def sensor(self, time: int) -> Array:
        """Position of the sensor: 1.2 m ahead and 1.7 m above."""
        x, y, yaw = self.vehicle(time)
        return np.array([x + 1.2 * np.cos(yaw), y + 1.2 * np.sin(yaw), 1.7])

    def message(self, kind: str, time: int, **fields: Any) -> bytes:
        return self.scenes.serialized(self.format, self.scenes.typestore(self.format).types[kind](**fields))

    def pose(self, time: int) -> Any:
        types = self.scenes.typestore(self.format).types
        x, y, yaw = self.vehicle(time)
        qx, qy, qz, qw = turn(yaw)
        return types["geometry_msgs/msg/Pose"](
            position=types["geometry_msgs/msg/Point"](x=x, y=y, z=0.0),
            orientation=types["geometry_msgs/msg/Quaternion"](x=qx, y=qy, z=qz, w=qw),
        )

    def odometry(self, time: int, child: str = "base_link") -> bytes:
        types = self.scenes.typestore(self.format).types
        zero = types["geometry_msgs/msg/Vector3"](x=0.0, y=0.0, z=0.0)
        with_covariance = types["geometry_msgs/msg/PoseWithCovariance"](pose=self.pose(time), covariance=np.zeros(36))
        twist = types["geometry_msgs/msg/TwistWithCovariance"](
            twist=types["geometry_msgs/msg/Twist"](linear=zero, angular=zero), covariance=np.zeros(36)
        )
        header = self.scenes.header(self.format, time, "odom")
        return self.message(
            "nav_msgs/msg/Odometry", time, header=header, child_frame_id=child, pose=with_covariance, twist=twist
        )

    def stamped(self, time: int) -> bytes:
        header = self.scenes.header(self.format, time, "map")
        return self.message("geometry_msgs/msg/PoseStamped", time, header=header, pose=self.pose(time))

    def transforms(self, time: int) -> bytes:
        x, y, yaw = self.vehicle(time)
        return self.scenes.transforms(self.format, time, [("odom", "base_link", (x - 7, y, 0.0), turn(yaw))])

    def records(self, *others: tuple[str, Callable[[int], bytes]], every: int = 20_000_000) -> list[Any]:
        """Clouds, the static transform to the sensor, and messages of other topics with 50 per second."""
        mount = ("base_link", self.scenes.FRAME, (1.2, 0.0, 1.7), turn(0.0))
        start = self.scenes.START
        found = [("/tf_static", start, self.scenes.transforms(self.format, start, [mount]))]
        for index, points in enumerate(self.clouds):
            message = self.scenes.cloud(self.format, points, self.times[index])
            found.append(("/points", self.times[index] + 5, message))
        for name, make in others:
            times = range(start - every // 2, self.times[-1] + every, every)
            found += [(name, time + 7, make(time)) for time in times]
        return sorted(found, key=lambda record: record[1])

    def write(self, records: list[Any]) -> Path:
        types = {
            "/tf": "tf2_msgs/msg/TFMessage",
            "/pose": "geometry_msgs/msg/PoseStamped",
            "/odom2": "nav_msgs/msg/Odometry",
        }
        return self.scenes.write_bag(self.folder / self.scenes.bag_name(self.format), self.format, records, types)


@pytest.fixture(params=("rosbag1", "sqlite3", "mcap"))
def bags(request: pytest.FixtureRequest, tmp_path: Path) -> Bags:
    pytest.importorskip("rosbags", reason="needs rosbags, of the test dependencies")
    return Bags(request.param, tmp_path)


def assert_on_path(bags: Bags, poses: Path, offset: float = 0, tolerance: float = 1e-6) -> None:
    rows = table(poses)
    assert len(rows) > 20
    for time, x, y, z, *quaternion in rows:
        nanoseconds = round((time - bags.scenes.START // 10**9) * 1e9) + bags.scenes.START
        expected = bags.sensor(nanoseconds) - [offset, 0, 0]
        np.testing.assert_allclose([x, y, z], expected, atol=tolerance + 1e-5)  # a double has 0.2 us of epoch
        yaw = bags.vehicle(nanoseconds)[2]
        np.testing.assert_allclose(np.abs(np.dot(quaternion, turn(yaw))), 1, atol=1e-9)


def test_odometry_of_a_bag_becomes_poses_of_the_sensor(bags: Bags) -> None:
    bag = bags.write(bags.records(("/odom", bags.odometry)))
    lines: list[str] = []
    done: list[tuple[int, int]] = []

    found = _poses.from_bag(
        bag, None, bags.folder / "out", report=lines.append, progress=lambda n, total: done.append((n, total))
    )

    assert lines == []
    assert found.scans == 6
    assert done == [(index + 1, 6) for index in range(6)]
    assert_on_path(bags, found.poses)
    times = (found.run / "times.txt").read_text().split()
    assert times == [_poses.seconds_text(time) for time in bags.times]
    for index, points in enumerate(bags.clouds):
        scan = flagstone.io.read(found.run / "velodyne" / f"{index:06}.bin")
        np.testing.assert_array_equal(np.stack([scan[name] for name in "xyz"], axis=1), points[:, :3])
        np.testing.assert_array_equal(scan["intensity"], points[:, 3])


def test_transforms_of_a_bag_become_poses_of_the_sensor(bags: Bags) -> None:
    records = bags.records(("/tf", bags.transforms))
    first, last = records[0][1] - 10**9, records[-1][1] + 10**9

    def at(time: int) -> bytes:
        entries = [("map", "odom", (7.0, 0.0, 0.0), turn(0.0))]
        return bags.scenes.transforms(bags.format, time, entries)

    records = [("/tf", first, at(first)), *records, ("/tf", last, at(last))]
    bag = bags.write(records)

    to_map = _poses.from_bag(bag, "/tf", bags.folder / "map")
    to_odom = _poses.from_bag(bag, "/tf:odom", bags.folder / "odom")

    assert_on_path(bags, to_map.poses)
    assert_on_path(bags, to_odom.poses, offset=7)


def test_poses_that_do_not_name_a_body_describe_the_sensor(bags: Bags) -> None:
    bag = bags.write(bags.records(("/pose", bags.stamped)))
    lines: list[str] = []

    found = _poses.from_bag(bag, "/pose", bags.folder / "out", report=lines.append)

    assert len(lines) == 1
    assert "does not name the frame that its poses describe (they are used as poses of 'lidar')" in lines[0]
    rows = table(found.poses)
    x, y, _ = bags.vehicle(bags.scenes.START - 10_000_000)
    np.testing.assert_allclose(rows[0, 1:4], [x, y, 0], atol=1e-6)


def test_a_bag_is_extracted_again_but_never_over_other_scans(bags: Bags) -> None:
    bag = bags.write(bags.records(("/odom", bags.odometry)))
    out = bags.folder / "out"
    first = _poses.from_bag(bag, "/odom", out)
    before = {file: file.read_bytes() for file in first.run.rglob("*") if file.is_file()}

    _poses.from_bag(bag, "/odom", out)
    assert {file: file.read_bytes() for file in first.run.rglob("*") if file.is_file()} == before

    (out / "bag.json").unlink()
    with pytest.raises(ValueError, match="contains scans that are not from this bag"):
        _poses.from_bag(bag, "/odom", out)
    assert (out / "velodyne" / "000000.bin").read_bytes() == before[out / "velodyne" / "000000.bin"]


def test_a_bag_is_not_extracted_into_itself(bags: Bags) -> None:
    bag = bags.write(bags.records(("/odom", bags.odometry)))
    if bag.is_dir():
        with pytest.raises(ValueError, match="is the bag or inside it"):
            _poses.from_bag(bag, "/odom", bag / "out")


def test_messages_that_cannot_be_read_are_one_line_each(bags: Bags) -> None:
    records = bags.records(("/odom", bags.odometry))
    clouds = [index for index, record in enumerate(records) if record[0] == "/points"]
    odometry = [index for index, record in enumerate(records) if record[0] == "/odom"]
    for index in (clouds[2], odometry[4]):
        name, time, data = records[index]
        records[index] = (name, time, data[:60])
    name, time, _ = records[odometry[9]]
    nan = bags.odometry(time).replace(np.float64(bags.vehicle(time)[0]).tobytes(), np.float64(np.nan).tobytes())
    records[odometry[9]] = (name, time, nan)
    bag = bags.write(records)
    lines: list[str] = []

    found = _poses.from_bag(bag, "/odom", bags.folder / "out", report=lines.append)

    assert found.scans == 5
    assert len((found.run / "times.txt").read_text().split()) == 5
    assert [line for line in lines if "/points: message 2: " in line]
    assert [line for line in lines if "/odom: message 4: byte" in line]
    assert [line for line in lines if "/odom: message 9: position" in line and "is not finite" in line]
    assert len(lines) == 3
    assert all("\n" not in line for line in lines)


@pytest.mark.parametrize(
    ("topic", "problem"),
    [
        ("/none", r"/none: is not a topic of this bag \(expected a topic of Odometry.*: /odom, /tf\)"),
        ("/points", r"/points: has type sensor_msgs/.* \(expected a topic of Odometry"),
        ("/tf:mars", r"no transforms lead from 'lidar' to 'mars' \(the frames above it: base_link, odom\)"),
        ("/tf:base_link", r"the transforms from 'lidar' to 'base_link' do not change"),
    ],
)
def test_topics_without_poses_are_errors(bags: Bags, topic: str, problem: str) -> None:
    bag = bags.write(bags.records(("/odom", bags.odometry), ("/tf", bags.transforms)))
    with pytest.raises(ValueError, match=problem):
        _poses.from_bag(bag, topic, bags.folder / "out")
    assert not (bags.folder / "out").exists()


def test_several_topics_of_odometry_are_listed(bags: Bags) -> None:
    bag = bags.write(bags.records(("/odom", bags.odometry), ("/odom2", bags.odometry)))
    with pytest.raises(ValueError, match=r"not unique or missing \(expected a topic of .*: /odom, /odom2\)"):
        _poses.from_bag(bag, None, bags.folder / "out")


def test_a_body_that_is_not_connected_with_the_sensor_is_an_error(bags: Bags) -> None:
    bag = bags.write(bags.records(("/odom", lambda time: bags.odometry(time, child="wheel"))))
    with pytest.raises(ValueError, match="does not connect frame 'lidar' with frame 'wheel'"):
        _poses.from_bag(bag, "/odom", bags.folder / "out")


def test_truncated_messages_of_poses_are_one_line_errors(bags: Bags) -> None:
    encoding = "ros1" if bags.format == "rosbag1" else "cdr"
    whole = bags.odometry(bags.scenes.START)
    assert parse_pose(whole, encoding, names_body=True).body == "base_link"
    for size in range(60):
        with pytest.raises(ValueError, match="byte") as error:
            parse_pose(whole[:size], encoding, names_body=True)
        assert "\n" not in str(error.value)
    (found,) = parse_timed_transforms(bags.transforms(bags.scenes.START), encoding)
    assert found[0] == bags.scenes.START
    assert found[1].child == "base_link"


def test_a_bag_that_was_recorded_again_replaces_scans_that_it_no_longer_has(bags: Bags) -> None:
    out = bags.folder / "out"
    path = bags.write(bags.records(("/odom", bags.odometry)))
    _poses.from_bag(path, "/odom", out)
    shutil.rmtree(path) if path.is_dir() else path.unlink()
    bags.clouds = bags.clouds[:4]
    _poses.from_bag(bags.write(bags.records(("/odom", bags.odometry))), "/odom", out)

    assert sorted(file.name for file in (out / "velodyne").iterdir()) == [f"{index:06}.bin" for index in range(4)]


@pytest.fixture(scope="session")
def street(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A simulated run of 40 scans at 10 Hz, 31 m long."""
    folder = tmp_path_factory.mktemp("street")
    flagstone.simulate(folder, scene="crossroads", sensor="hdl-32e", frames=40, rate=10, speed=8)
    return folder / "sequences" / "00"


def true_poses(run: Path) -> Array:
    """(N, 4, 4): relative to the first pose."""
    poses = np.tile(np.eye(4), (40, 1, 1))
    poses[:, :3] = np.loadtxt(run / "poses.txt").reshape(-1, 3, 4)
    relative: Array = np.linalg.inv(poses[0]) @ poses
    return relative


def test_kiss_icp_finds_the_path_within_one_percent(street: Path, tmp_path: Path) -> None:
    pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
    done: list[tuple[int, int]] = []

    _poses.from_kiss_icp(street, tmp_path / "a.tum", lambda n, total: done.append((n, total)))
    _poses.from_kiss_icp(street, tmp_path / "b.tum")

    assert (tmp_path / "a.tum").read_bytes() == (tmp_path / "b.tum").read_bytes()
    assert done == [(index + 1, 40) for index in range(40)]
    found = table(tmp_path / "a.tum")[:, 1:]  # after the time
    truth = true_poses(street)
    distance = float(np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1).sum())
    errors = np.linalg.norm(found[:, :3] - truth[:, :3, 3], axis=1)
    assert errors.max() < 0.01 * distance
    angles = [
        2 * np.arccos(min(1, abs(float(row[3:] @ quaternion_of(pose[:3, :3])))))
        for row, pose in zip(found, truth, strict=True)
    ]
    assert np.degrees(max(angles)) < 1


def test_scans_that_kiss_icp_cannot_use_have_no_pose(street: Path, tmp_path: Path) -> None:
    pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
    run = tmp_path / "run"
    run.mkdir()
    for index in range(5):
        (run / f"{index}.bin").symlink_to(street / "velodyne" / f"{index:06}.bin")
    (run / "1.bin").unlink()
    (run / "1.bin").write_bytes(b"truncated")
    (run / "3.bin").unlink()
    (run / "3.bin").write_bytes(np.zeros((500, 4), np.float32).tobytes())
    (run / "times.txt").write_text("0.0\n0.1\n0.2\n0.3\n0.4\n")
    lines: list[str] = []

    _poses.from_kiss_icp(run, tmp_path / "poses.tum", report=lines.append)

    rows = table(tmp_path / "poses.tum")
    assert np.isnan(rows[:, 1]).tolist() == [False, True, False, True, False]
    np.testing.assert_allclose(rows[:, 0], [0, 0.1, 0.2, 0.3, 0.4])
    assert len(lines) == 2
    assert "1.bin" in lines[0]
    assert "3.bin: has 0 valid points (expected at least 100)" in lines[1]


def test_kiss_icp_does_not_overwrite_a_scan(street: Path) -> None:
    pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
    scan = street / "velodyne" / "000000.bin"
    before = scan.read_bytes()
    with pytest.raises(ValueError, match="is a scan of the run"):
        _poses.from_kiss_icp(street, scan)
    assert scan.read_bytes() == before


def test_a_directory_without_scans_is_an_error(tmp_path: Path) -> None:
    pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
    with pytest.raises(ValueError, match="contains no scans"):
        _poses.from_kiss_icp(tmp_path, tmp_path / "poses.tum")


def test_without_kiss_icp_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in [name for name in sys.modules if name.partition(".")[0] == "kiss_icp"]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "kiss_icp", None)
    with pytest.raises(ImportError, match=r"pip install 'flagstone\[odometry\]'"):
        _poses.from_kiss_icp(tmp_path, tmp_path / "poses.tum")


def test_real_runs_have_the_poses_that_kiss_icp_finds(tmp_path: Path) -> None:
    pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
    data = Path(os.environ.get("FLAGSTONE_DATA", Path(__file__).parents[3] / "shared" / "data"))
    run = data / "sequences" / "00"
    if not run.is_dir():
        pytest.skip(f"no real run in {run}; set FLAGSTONE_DATA")
    _poses.from_kiss_icp(run, tmp_path / "poses.tum")

    found = table(tmp_path / "poses.tum")
    camera = np.tile(np.eye(4), (len(found), 1, 1))
    camera[:, :3] = np.loadtxt(run / "poses.txt").reshape(-1, 3, 4)
    calibration = next(line for line in (run / "calib.txt").read_text().splitlines() if line.startswith("Tr:"))
    to_camera = np.eye(4)
    to_camera[:3] = np.array([float(word) for word in calibration.split()[1:]]).reshape(3, 4)
    truth = np.linalg.inv(to_camera) @ camera @ to_camera
    distance = float(np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1).sum())
    errors = np.linalg.norm(found[:, 1:4] - truth[:, :3, 3], axis=1)
    assert errors.max() < 0.02 * distance
