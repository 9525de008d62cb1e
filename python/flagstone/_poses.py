# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Poses of the scans of a run: from the messages of a bag, or from the scans themselves with KISS-ICP."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone import io, ros
from flagstone._atomic_file import atomic_write
from flagstone._optional import needs
from flagstone.bags.clouds import choose_topics, cloud_topics
from flagstone.bags.container import Bag, Message, open_bag
from flagstone.bags.reports import one_line
from flagstone.bags.trajectory import Trajectory, quaternion_of, read_trajectory
from flagstone.codes import Label
from flagstone.segmenters import Segmenter, Surface

PathLike = str | os.PathLike[str]
Array = npt.NDArray[np.float64]
Report = Callable[[str], None]
ProgressCallback = Callable[[int, int], None]
"""Receives the number of scans that are done, and of all scans."""

_MARKER = "bag.json"  # marks a directory of clouds from a bag
_FEWEST_POINTS = 100  # fewer cannot be registered
_ENOUGH_OBSTACLES = 1000  # points that are not ground; with fewer, the ground is registered too


class BagRun(NamedTuple):
    """The clouds and poses of a bag as files."""

    run: Path
    """Directory with velodyne/NNNNNN.bin and times.txt."""
    poses: Path
    """File of the poses of the sensor, TUM."""
    scans: int
    """Number of clouds."""


def from_bag(
    bag: PathLike,
    topic: str | None,
    output_dir: PathLike,
    *,
    clouds: str | None = None,
    report: Report | None = None,
    progress: ProgressCallback | None = None,
) -> BagRun:
    """Extracts the clouds of a bag and the poses of their sensor.

    Writes velodyne/NNNNNN.bin (x, y, z, intensity as float32), times.txt (seconds, one line per cloud) and poses.tum
    (one line per pose in the bag). Each file is written atomically; a run of the same bag is written again.

    Args:
        bag: A bag of ROS 1 or ROS 2.
        topic: Topic of the poses, see `flagstone.bags.trajectory.read_trajectory`; None to find it.
        output_dir: Directory, created if it does not exist.
        clouds: Topic of the clouds (default: the only one).
        report: Receives one line for each message that cannot be read, and for each decision.
        progress: Is called after each cloud.

    Returns:
        The files.

    Raises:
        ValueError: The bag has no such topics, no cloud that can be read, or no transform between the frames; or the
            directory contains other scans or is inside the bag. One line.
        OSError: A file cannot be read or written.
    """
    lines = report or (lambda line: None)
    folder = Path(output_dir)
    with open_bag(bag, report=lines) as opened:
        (name,) = choose_topics(opened, [clouds] if clouds is not None else [])
        _check_folder(folder, opened, name)
        frame = _frame_of_clouds(opened, name, lines)
        trajectory = read_trajectory(opened, topic, frame, lines)
        count = _write_clouds(opened, name, frame, folder, lines, progress)
    poses = folder / "poses.tum"
    write_tum(poses, trajectory)
    return BagRun(folder, poses, count)


def clouds_from_bag(
    bag: PathLike,
    output_dir: PathLike,
    *,
    clouds: str | None = None,
    report: Report | None = None,
    progress: ProgressCallback | None = None,
) -> str:
    """Extracts the clouds of a bag without poses: as `from_bag`, but poses.tum is not written.

    Returns:
        The frame of the clouds.
    """
    lines = report or (lambda line: None)
    folder = Path(output_dir)
    with open_bag(bag, report=lines) as opened:
        (name,) = choose_topics(opened, [clouds] if clouds is not None else [])
        _check_folder(folder, opened, name)
        frame = _frame_of_clouds(opened, name, lines)
        _write_clouds(opened, name, frame, folder, lines, progress)
    return frame


def poses_from_bag(
    bag: PathLike,
    topic: str | None,
    output_file: PathLike,
    *,
    frame: str | None = None,
    report: Report | None = None,
) -> None:
    """Extracts the poses of a bag, for scans that are not in it.

    Args:
        bag: A bag of ROS 1 or ROS 2.
        topic: Topic of the poses, as for `from_bag`.
        output_file: File to write, TUM.
        frame: Frame of the sensor (default: the frame of the only topic of clouds in the bag).
        report: Receives one line for each message that cannot be read.

    Raises:
        ValueError: The bag has no such topics, or no transform between the frames. One line.
        OSError: A file cannot be read or written.
    """
    lines = report or (lambda line: None)
    with open_bag(bag, report=lines) as opened:
        if frame is None:
            (name,) = choose_topics(opened, [])
            frame = _frame_of_clouds(opened, name, lines)
        trajectory = read_trajectory(opened, topic, frame, lines)
    write_tum(Path(output_file), trajectory)


def _write_clouds(
    bag: Bag, name: str, frame: str, folder: Path, report: Report, progress: ProgressCallback | None
) -> int:
    """Writes the clouds, their times and the marker. Returns the number of clouds."""
    (folder / "velodyne").mkdir(parents=True, exist_ok=True)
    _write_text(folder / _MARKER, json.dumps(_origin(bag, name)) + "\n")
    times = _extract(bag, name, frame, folder / "velodyne", report, progress)
    _write_text(folder / "times.txt", "".join(f"{seconds_text(time)}\n" for time in times))
    return len(times)


def _origin(bag: Bag, topic: str) -> dict[str, Any]:
    return {"bag": os.path.realpath(bag.path), "clouds": topic}


def _check_folder(folder: Path, bag: Bag, topic: str) -> None:
    output = Path(os.path.realpath(folder))
    source = Path(os.path.realpath(bag.path))
    if output == source or source in output.parents:
        raise ValueError(f"{folder}: is the bag or inside it (choose another directory)")
    scans = folder / "velodyne"
    if not scans.is_dir() or not any(scans.iterdir()):
        return
    try:
        found = json.loads((folder / _MARKER).read_text())
    except (OSError, ValueError):
        found = None
    if found != _origin(bag, topic):
        raise ValueError(f"{scans}: contains scans that are not from this bag (choose another directory)")


def _clouds(bag: Bag, name: str, report: Report) -> Iterable[tuple[Message, ros.PointCloud2]]:
    """The clouds that can be read. Reports one line for each of the others."""
    for index, message in enumerate(bag.messages([name])):
        try:
            encoding: ros.Encoding = "ros1" if message.topic.encoding == "ros1" else "cdr"
            cloud = ros.parse(message.data, encoding=encoding, message_type=message.topic.type)
            _ = cloud.xyz
        except ValueError as error:
            report(one_line(f"{bag.path}: {name}: message {index}: {error}"))
        else:
            yield message, cloud


def _frame_of_clouds(bag: Bag, name: str, report: Report) -> str:
    for _, cloud in _clouds(bag, name, lambda line: None):
        return cloud.header.frame_id.removeprefix("/")
    raise ValueError(f"{bag.path}: {name}: contains no cloud that can be read")


def _extract(
    bag: Bag, name: str, frame: str, folder: Path, report: Report, progress: ProgressCallback | None
) -> list[int]:
    """Writes the clouds. Returns their times in nanoseconds."""
    total = cloud_topics(bag)[name]
    times: list[int] = []
    for message, cloud in _clouds(bag, name, report):
        header = cloud.header
        if header.frame_id.removeprefix("/") != frame:
            report(f"{bag.path}: {name}: a cloud in frame '{header.frame_id}' is skipped (expected '{frame}')")
            continue
        rows = np.zeros((len(cloud), 4), np.float32)
        rows[:, :3] = cloud.xyz
        if cloud.convention.intensity is not None:
            rows[:, 3] = cloud.points[cloud.convention.intensity].reshape(-1)
        with atomic_write(folder / f"{len(times):06}.bin") as file:
            file.write(rows.tobytes())
        times.append(header.sec * 10**9 + header.nanosec or message.log_time)
        if progress is not None:
            progress(len(times), total)
    for left_over in folder.glob("*.bin"):  # of a run of this bag that had more clouds
        if left_over.stem.isdecimal() and int(left_over.stem) >= len(times):
            left_over.unlink()
    return times


def from_kiss_icp(
    run: PathLike,
    output_file: PathLike,
    progress: ProgressCallback | None = None,
    *,
    scans: Sequence[PathLike] | None = None,
    columns: int | None = None,
    segmenter: Segmenter | None = None,
    max_range: float = 100,
    report: Report | None = None,
) -> None:
    """Finds the poses of the scans of a run with KISS-ICP, which must be installed: the extra `odometry`.

    Points on the ground are not used, unless a scan has fewer than 1,000 others: they lie on rings around the sensor,
    which look as if the sensor stood still. The height, pitch and roll of the path are therefore less accurate than its
    position in x and y; levelling to the map corrects them.

    The world frame is the frame of the first scan, whose z axis must point up. Scans are used as they are: points that
    were measured while the sensor moved are not corrected. The same scans give the same file.

    Args:
        run: Directory of the scans. It can contain times.txt, one time in seconds per scan.
        output_file: File to write: TUM if the run has a time per scan, otherwise CSV without times. A scan that cannot
            be read, or has fewer than 100 points in range, has a pose of NaN.
        progress: Is called after each scan.
        scans: The scans, in their order (default: all scans in the directory and below, by name).
        columns: Floats per point in raw files, as for `flagstone.io.read`.
        segmenter: Finds the ground (default: `Surface(sensor_height="estimate")`).
        max_range: Points farther than this are not used, metres.
        report: Receives one line for each scan without a pose.

    Raises:
        ImportError: kiss-icp is not installed.
        ValueError: The directory contains no scans, or the output is one of them. One line.
        OSError: The output cannot be written.
    """
    odometry = _Odometry(segmenter or Surface(sensor_height="estimate"), max_range, columns)
    lines = report or (lambda line: None)
    folder = Path(run)
    files = [Path(scan) for scan in scans] if scans is not None else scans_in(folder)
    if not files:
        raise ValueError(f"{folder}: contains no scans")
    output = os.path.realpath(output_file)
    if any(os.path.realpath(file) == output for file in files):
        raise ValueError(f"{output_file}: is a scan of the run (choose another output)")
    poses = []
    for index, file in enumerate(files):
        try:
            poses.append(odometry.add(file))
        except (OSError, ValueError) as error:
            lines(one_line(f"{error} (this scan has no pose)"))
            poses.append(np.full(7, np.nan))
        if progress is not None:
            progress(index + 1, len(files))
    times = _times_of(folder, len(files))
    header = "# time x y z qx qy qz qw\n" if times is not None else "x,y,z,qx,qy,qz,qw\n"
    rows = []
    for index, pose in enumerate(poses):
        numbers = [f"{value:.12g}" for value in pose]
        rows.append(" ".join([times[index], *numbers]) if times is not None else ",".join(numbers))
    _write_text(Path(output_file), header + "".join(f"{row}\n" for row in rows))


class _Odometry:
    """KISS-ICP with its default settings, in one thread, because the order of its sums changes with threads."""

    def __init__(self, segmenter: Segmenter, max_range: float, columns: int | None) -> None:
        config = needs("kiss_icp.config.parser", "odometry").load_config(None)
        config.data.max_range = max_range
        config.data.deskew = False
        config.mapping.voxel_size = max_range / 100
        config.registration.max_num_threads = 1
        self._segmenter = segmenter
        self._columns = columns
        self._icp = needs("kiss_icp.kiss_icp", "odometry").KissICP(config)

    def add(self, file: Path) -> Array:
        """(7,): the pose of a scan, x, y, z and the quaternion x, y, z, w.

        Raises:
            ValueError: The file is not a scan, or has too few points. One line.
            OSError: The file cannot be read.
        """
        self._icp.register_frame(self._points(file), np.zeros(0))
        pose: Array = self._icp.last_pose
        return np.concatenate([pose[:3, 3], quaternion_of(pose[:3, :3])])

    def _points(self, file: Path) -> Array:
        """(N, 3): the points to register."""
        rows = io.read(file, columns=self._columns)
        points = np.stack([rows[axis].astype(np.float64) for axis in "xyz"], axis=1)
        labels = self._segmenter.segment(points.astype(np.float32)).labels
        valid = labels != Label.INVALID
        if valid.sum() < _FEWEST_POINTS:
            raise ValueError(f"{file}: has {valid.sum()} valid points (expected at least {_FEWEST_POINTS})")
        obstacles = valid & (labels != Label.GROUND)
        chosen = obstacles if obstacles.sum() >= _ENOUGH_OBSTACLES else valid
        return np.ascontiguousarray(points[chosen])


def scans_in(folder: Path) -> list[Path]:
    """All scans in a directory and below, in alphabetical order."""
    return sorted(file for file in folder.rglob("*") if file.is_file() and io.is_scan_name(file))


def _times_of(run: Path, count: int) -> list[str] | None:
    """The lines of times.txt; None without one finite time per scan."""
    try:
        lines = (run / "times.txt").read_text().split()
        return lines if len(lines) == count and np.isfinite([float(line) for line in lines]).all() else None
    except (OSError, ValueError):
        return None


def write_tum(path: Path, trajectory: Trajectory) -> None:
    """Writes poses as a TUM file."""
    rows = ["# time x y z qx qy qz qw\n"]
    for time, position, quaternion in zip(*trajectory, strict=True):
        numbers = " ".join(f"{value:.12g}" for value in (*position, *quaternion))
        rows.append(f"{seconds_text(int(time))} {numbers}\n")
    _write_text(path, "".join(rows))


def seconds_text(nanoseconds: int) -> str:
    """Exact seconds: "1700000000.100000000"."""
    sign, value = ("-", -nanoseconds) if nanoseconds < 0 else ("", nanoseconds)
    return f"{sign}{value // 10**9}.{value % 10**9:09}"


def _write_text(path: Path, text: str) -> None:
    with atomic_write(path) as file:
        file.write(text.encode())
