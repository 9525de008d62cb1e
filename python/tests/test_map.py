# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.map` and `flagstone map`: runs of files and bags, poses of every source, and exports."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flagstone
from flagstone import _command
from flagstone.bags.trajectory import quaternion_of

SCANS = 20
VLP: dict[str, Any] = {"sensor": "vlp-16"}


@pytest.fixture(scope="module")
def street(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A simulated run of 20 scans at 10 Hz, 15 m long, with traffic."""
    folder = tmp_path_factory.mktemp("street")
    flagstone.simulate(folder, scene="crossroads", **VLP, frames=SCANS, rate=10, speed=8)
    return folder / "sequences" / "00"


@pytest.fixture(scope="module")
def mapped(street: Path, tmp_path_factory: pytest.TempPathFactory) -> flagstone.MapSummary:
    """The run, mapped from its files."""
    return flagstone.map(street, street / "poses.txt", tmp_path_factory.mktemp("map") / "out", rate=10, **VLP)


def labels_of(directory: Path) -> list[bytes]:
    return [file.read_bytes() for file in sorted((directory / "labels").iterdir())]


def files_of(directory: Path) -> dict[str, bytes]:
    files = [file for file in directory.rglob("*") if file.is_file()]
    return {os.fspath(file.relative_to(directory)): file.read_bytes() for file in files}


def command(*arguments: str | Path, package: bool = True) -> subprocess.CompletedProcess[str]:
    """Runs the command, as the script of the package does; without `package`, as a separate program."""
    environment = _command.environment() if package else dict(os.environ)
    return subprocess.run([_command.path(), *arguments], capture_output=True, text=True, env=environment)


def agreement(directory: Path, other: Path) -> float:
    """Fraction of points with equal labels."""
    pairs = zip(labels_of(directory), labels_of(other), strict=True)
    equal = [np.frombuffer(a, np.uint32) == np.frombuffer(b, np.uint32) for a, b in pairs]
    return float(np.concatenate(equal).mean())


def problems_of_the_run(done: flagstone.MapSummary) -> list[str]:
    """The problems without the remark that the sensor of these runs has few beams."""
    few_beams = "2.0 degrees between beams"
    assert sum(few_beams in line for line in done.problems) == 1
    return [line for line in done.problems if few_beams not in line]


def test_a_run_is_mapped_in_five_lines(street: Path, tmp_path: Path) -> None:
    done = flagstone.map(street, street / "poses.txt", tmp_path / "out", sensor="vlp-16", rate=10)
    found = [(scan.labels, scan.moving, scan.world) for scan in done.open().scans()]
    ground = flagstone.maps.read_ground_map(done.directory)

    assert (done.scans, done.mapped, done.alone, done.failed) == (SCANS, SCANS, 0, 0)
    assert problems_of_the_run(done) == []
    assert done.moving_points == sum(int(moving.sum()) for _, moving, _ in found) > 0
    assert done.path == pytest.approx(0.8 * (SCANS - 1), abs=0.5)
    assert int(np.isfinite(ground.height).sum()) * ground.cell**2 == pytest.approx(done.area)
    assert all(len(labels) == len(world) for labels, _, world in found)


def test_the_command_writes_the_same_files(street: Path, mapped: flagstone.MapSummary, tmp_path: Path) -> None:
    done = command(
        *("map", street, "--poses", street / "poses.txt", "--output", tmp_path / "out"),
        *("--rate", "10", "--sensor", "vlp-16", "--threads", "2"),
    )

    assert done.returncode == 0, done.stderr
    written = files_of(tmp_path / "out")
    written.pop("ground.png", None)  # the module cannot draw
    assert written == files_of(mapped.directory)


def test_options_have_the_effect_of_the_options_of_the_command(street: Path, tmp_path: Path) -> None:
    options = {"labels": "delayed", "delay": 0.5, "heights": True, "voxel": 0, "map_memory": 1, "threads": 1}
    flagstone.map(street, street / "poses.txt", tmp_path / "a", rate=10, point={"margin": 0.2}, **VLP, **options)
    done = command(
        *("map", street, "--poses", street / "poses.txt", "-o", tmp_path / "b", "--rate", "10", "--sensor", "vlp-16"),
        *("--labels", "delayed", "--delay", "0.5", "--heights", "--voxel", "0", "--map-memory", "1"),
        *("--set", "point.margin=0.2"),
    )

    assert done.returncode == 0, done.stderr
    written = files_of(tmp_path / "b")
    written.pop("ground.png", None)
    assert written == files_of(tmp_path / "a")
    assert "heights/000000.heights.npy" in written
    assert "static.ply" not in written


def test_scans_without_a_usable_pose_are_labelled_alone(street: Path, tmp_path: Path) -> None:
    lines = (street / "poses.txt").read_text().splitlines()
    lines[3] = " ".join(["nan"] * 12)
    (tmp_path / "poses.txt").write_text("\n".join(lines) + "\n")

    with pytest.warns(RuntimeWarning, match="1 of 20 scans labelled alone, see `problems`: "):
        done = flagstone.map(street, tmp_path / "poses.txt", tmp_path / "out", rate=10, **VLP)

    assert (done.mapped, done.alone, done.failed) == (SCANS - 1, 1, 0)
    assert len(problems_of_the_run(done)) == 1
    points = flagstone.io.read(street / "velodyne" / "000003.bin")
    own = flagstone.Surface(**VLP).segment(points).labels
    found = flagstone.io.read_labels(done.directory / "labels" / "000003.label", len(points))
    np.testing.assert_array_equal(found, own)


def test_a_scan_that_cannot_be_read_is_one_line(street: Path, tmp_path: Path) -> None:
    run = tmp_path / "run"
    shutil.copytree(street / "velodyne", run / "velodyne")
    (run / "velodyne" / "000005.bin").write_bytes(b"truncated")

    with pytest.warns(RuntimeWarning, match="1 of 20 scans failed"):
        done = flagstone.map(run, street / "poses.txt", tmp_path / "out", rate=10, **VLP)

    assert (done.mapped, done.failed) == (SCANS - 1, 1)
    (line,) = problems_of_the_run(done)
    assert "000005.bin" in line and "\n" not in line
    assert not (done.directory / "labels" / "000005.label").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"labels": "later"}, "labels: .*offline"),
        ({"delay": 11}, "delay: 11 is out of range"),
        ({"voxel": 0.001}, "voxel: 0.001 is out of range"),
        ({"rate": float("nan")}, "rate: nan is out of range"),
        ({"map_memory": -1}, "map_memory: -1 is out of range"),
        ({"columns": 2}, "columns: 2 is out of range"),
        ({"threads": 0}, "threads: 0 is out of range"),
        ({"sensor_height": "track"}, "sensor_height: track is not supported"),
        ({"point": {"margin": -1}}, "margin"),
        ({"topic": "/points"}, "topic: .* is not a bag"),
        ({"pose_topic": "/odom"}, "pose_topic: .* is not a bag"),
        ({"crs": "EPSG:25832"}, "crs: is used only by geotiff"),
        ({"las": True, "voxel": 0}, "las: needs the static points"),
    ],
)
def test_an_invalid_argument_is_an_error_before_anything_is_written(
    arguments: dict[str, Any], message: str, street: Path, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=message) as error:
        flagstone.map(street, street / "poses.txt", tmp_path / "out", **arguments)
    assert "\n" not in str(error.value)
    assert not (tmp_path / "out").exists()


def test_other_files_in_the_output_directory_are_an_error(street: Path, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    for poses in (os.fspath(street / "poses.txt"), "kiss-icp"):
        if poses == "kiss-icp":
            pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
        with pytest.raises(ValueError, match="contains other files"):
            flagstone.map(street, poses, tmp_path, **VLP)
    assert files_of(tmp_path) == {"notes.txt": b"mine"}


def test_a_missing_run_or_file_of_poses_is_an_error(street: Path, tmp_path: Path) -> None:
    poses = street / "poses.txt"
    for run, file in (("missing", poses), ("missing.mcap", poses), (street, "missing.txt"), (street, "missing.mcap")):
        with pytest.raises(FileNotFoundError, match=r"missing.*: does not exist"):
            flagstone.map(run, file, tmp_path / "out")
    done = command("map", tmp_path / "missing", "--poses", poses, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert "missing: does not exist (expected the directory of a run)" in done.stderr
    assert not (tmp_path / "out").exists()


def test_an_interrupted_map_is_resumed(street: Path, mapped: flagstone.MapSummary, tmp_path: Path) -> None:
    program = (
        "import flagstone, sys\n"
        "flagstone.map(sys.argv[1], sys.argv[1] + '/poses.txt', sys.argv[2], sensor='vlp-16', rate=10, threads=1)"
    )
    started = subprocess.Popen(
        [sys.executable, "-c", program, street, tmp_path / "out"], stderr=subprocess.PIPE, text=True
    )
    while not (tmp_path / "out" / "run.json").exists() and started.poll() is None:
        time.sleep(0.01)
    started.send_signal(signal.SIGINT)
    _, errors = started.communicate(timeout=60)

    assert started.returncode == 0 or "KeyboardInterrupt" in errors
    done = flagstone.map(street, street / "poses.txt", tmp_path / "out", rate=10, **VLP)
    assert done.mapped == SCANS
    assert files_of(done.directory) == files_of(mapped.directory)


# Bags


@pytest.fixture(scope="module", params=("rosbag1", "mcap"))
def bag(request: pytest.FixtureRequest, street: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The run as a bag: clouds of the sensor, and its poses as odometry."""
    pytest.importorskip("rosbags", reason="needs rosbags, of the test dependencies")
    import bag_scenes as scenes

    format: str = request.param
    types = scenes.typestore(format).types
    zero = types["geometry_msgs/msg/Vector3"](x=0.0, y=0.0, z=0.0)
    twist = types["geometry_msgs/msg/TwistWithCovariance"](
        twist=types["geometry_msgs/msg/Twist"](linear=zero, angular=zero), covariance=np.zeros(36)
    )
    poses = np.loadtxt(street / "poses.txt").reshape(-1, 3, 4)
    records = []
    for index, (file, pose) in enumerate(zip(sorted((street / "velodyne").iterdir()), poses, strict=True)):
        stamp = scenes.START + index * scenes.PERIOD
        qx, qy, qz, qw = map(float, quaternion_of(pose[:, :3]))
        x, y, z = map(float, pose[:, 3])
        stamped = types["geometry_msgs/msg/Pose"](
            position=types["geometry_msgs/msg/Point"](x=x, y=y, z=z),
            orientation=types["geometry_msgs/msg/Quaternion"](x=qx, y=qy, z=qz, w=qw),
        )
        message = types["nav_msgs/msg/Odometry"](
            header=scenes.header(format, stamp, "odom"),
            child_frame_id=scenes.FRAME,
            pose=types["geometry_msgs/msg/PoseWithCovariance"](pose=stamped, covariance=np.zeros(36)),
            twist=twist,
        )
        records.append(("/points", stamp + 5, scenes.cloud(format, flagstone.io.read(file), stamp)))
        records.append(("/odom", stamp + 9, scenes.serialized(format, message)))
    path = tmp_path_factory.mktemp("bag") / scenes.bag_name(format)
    return scenes.write_bag(path, format, records)


def test_a_bag_is_a_run_with_poses(bag: Path, mapped: flagstone.MapSummary, tmp_path: Path) -> None:
    done = flagstone.map(bag, bag, tmp_path / "out", **VLP)

    assert (done.scans, done.mapped) == (SCANS, SCANS)
    assert problems_of_the_run(done) == []
    assert agreement(done.directory, mapped.directory) > 0.999
    assert len(list(done.open().scans())) == SCANS


def test_the_command_maps_bags_with_the_same_files(bag: Path, tmp_path: Path) -> None:
    expected = files_of(flagstone.map(bag, bag, tmp_path / "out", **VLP).directory)
    shutil.rmtree(tmp_path / "out")
    done = command("map", bag, "--poses", bag, "-o", tmp_path / "out", "--sensor", "vlp-16", "--topic", "/points")

    assert done.returncode == 0, done.stderr
    written = files_of(tmp_path / "out")
    written.pop("ground.png", None)
    assert written.keys() == expected.keys()
    differing = {name for name in written if written[name] != expected[name]}
    assert differing <= {"input/source.json"}  # contains the topic, an option of the command


def test_scans_of_a_bag_take_the_poses_of_a_file(
    bag: Path, mapped: flagstone.MapSummary, street: Path, tmp_path: Path
) -> None:
    done = flagstone.map(bag, street / "poses.txt", tmp_path / "out", **VLP)
    assert done.mapped == SCANS
    assert agreement(done.directory, mapped.directory) == 1


def test_scans_of_a_directory_take_the_poses_of_a_bag(
    bag: Path, mapped: flagstone.MapSummary, street: Path, tmp_path: Path
) -> None:
    import bag_scenes as scenes

    run = tmp_path / "run"
    run.mkdir()
    (run / "velodyne").symlink_to(street / "velodyne")
    times = [(scenes.START + index * scenes.PERIOD) / 1e9 for index in range(SCANS)]
    (run / "times.txt").write_text("".join(f"{seconds:.9f}\n" for seconds in times))
    done = flagstone.map(run, bag, tmp_path / "out", pose_topic="/odom", **VLP)
    assert done.mapped == SCANS
    assert agreement(done.directory, mapped.directory) > 0.999


def test_the_clouds_of_a_bag_are_read_once(bag: Path, tmp_path: Path) -> None:
    first = flagstone.map(bag, bag, tmp_path / "out", **VLP)
    scan = tmp_path / "out" / "input" / "velodyne" / "000000.bin"
    made = scan.stat().st_mtime_ns
    again = flagstone.map(bag, bag, tmp_path / "out", **VLP)
    assert scan.stat().st_mtime_ns == made
    assert again.mapped == first.mapped


def test_a_directory_with_the_clouds_of_another_bag_is_an_error(bag: Path, tmp_path: Path) -> None:
    flagstone.map(bag, bag, tmp_path / "out", **VLP)
    before = files_of(tmp_path / "out")
    with pytest.raises(ValueError, match="contains the scans or poses of another map"):
        flagstone.map(bag, bag, tmp_path / "out", topic="/points", **VLP)
    assert files_of(tmp_path / "out") == before


def test_an_output_inside_a_bag_is_an_error(bag: Path) -> None:
    if not bag.is_dir():
        pytest.skip("this bag is a file")
    before = files_of(bag)
    with pytest.raises(ValueError, match="is the bag or inside it"):
        flagstone.map(bag, bag, bag / "out", **VLP)
    assert files_of(bag) == before


def test_a_topic_that_a_bag_does_not_have_is_an_error(bag: Path, tmp_path: Path) -> None:
    for arguments in ({"topic": "/lidar"}, {"pose_topic": "/lidar"}):
        with pytest.raises(ValueError, match="/lidar"):
            flagstone.map(bag, bag, tmp_path / "out", **arguments, **VLP)
    assert flagstone.map(bag, bag, tmp_path / "out", **VLP).mapped == SCANS


# Poses that KISS-ICP finds


def test_a_run_without_poses_is_mapped(street: Path, mapped: flagstone.MapSummary, tmp_path: Path) -> None:
    pytest.importorskip("kiss_icp", reason="needs kiss-icp, of the extra odometry")
    done = flagstone.map(street, "kiss-icp", tmp_path / "out", rate=10, **VLP)
    assert done.mapped == SCANS
    assert done.path == pytest.approx(mapped.path, rel=0.1)
    assert agreement(done.directory, mapped.directory) > 0.99

    by_command = command(
        *("map", street, "--poses", "kiss-icp", "-o", tmp_path / "b", "--rate", "10", "--sensor", "vlp-16")
    )
    assert by_command.returncode == 0, by_command.stderr
    assert labels_of(tmp_path / "b") == labels_of(tmp_path / "out")


# Exports


def test_exports_are_written_and_listed(street: Path, tmp_path: Path) -> None:
    for package, extra in (("rasterio", "geotiff"), ("laspy", "las"), ("rerun", "viewer"), ("PIL", "plot")):
        pytest.importorskip(package, reason=f"needs the extra {extra}")
    import PIL.Image
    import rasterio

    done = command(
        *("map", street, "--poses", street / "poses.txt", "-o", tmp_path / "out", "--rate", "10"),
        *("--sensor", "vlp-16", "--geotiff", "--crs", "EPSG:25832", "--las", "--recording", "--animation"),
    )

    assert done.returncode == 0, done.stderr
    names = [tmp_path / "out" / name for name in ("ground.tif", "static.las", "recording.rrd", "animation.gif")]
    assert done.stdout.splitlines()[-4:] == [str(name) for name in names]
    with rasterio.open(names[0]) as file:
        assert file.crs.to_epsg() == 25832
        known = int(np.isfinite(file.read(1)).sum())
    ground = flagstone.maps.read_ground_map(tmp_path / "out")
    assert known == int(np.isfinite(ground.height).sum())
    static = flagstone.io.read(tmp_path / "out" / "static.ply")
    assert (flagstone.io.read(names[1])["classification"] == 1 + static["label"]).all()
    assert names[2].read_bytes()[:3] == b"RRF"
    with PIL.Image.open(names[3]) as animation:
        assert animation.n_frames > SCANS / 2


def test_an_export_that_cannot_be_written_keeps_the_map(street: Path, tmp_path: Path) -> None:
    pytest.importorskip("PIL", reason="needs the extra plot")
    (tmp_path / "poses.txt").write_text("nan nan nan nan nan nan nan nan nan nan nan nan\n" * SCANS)

    with pytest.warns(RuntimeWarning, match="20 of 20 scans labelled alone, 1 exports not written"):
        done = flagstone.map(street, tmp_path / "poses.txt", tmp_path / "out", rate=10, animation=True, **VLP)

    assert done.exports == ()
    assert "animation.gif: not written" in done.problems[-1]
    assert len(labels_of(done.directory)) == SCANS


def test_a_missing_package_is_named_before_the_run_is_mapped(
    street: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for package, argument, extra in (
        ("rasterio", "geotiff", "geotiff"),
        ("laspy", "las", "las"),
        ("rerun", "recording", "viewer"),
        ("PIL", "animation", "plot"),
    ):
        for module in [name for name in sys.modules if name.partition(".")[0] == package]:
            monkeypatch.delitem(sys.modules, module)
        monkeypatch.setitem(sys.modules, package, None)
        with pytest.raises(ImportError, match=rf"pip install 'flagstone\[{extra}\]'"):
            flagstone.map(street, street / "poses.txt", tmp_path / "out", **{argument: True})
    assert not (tmp_path / "out").exists()


# The command


def test_the_command_without_the_package_names_what_to_install(street: Path, tmp_path: Path) -> None:
    for options, extra in (
        (("--poses", "kiss-icp"), "odometry"),
        (("--poses", "poses.mcap"), "bag"),
        (("--poses", street / "poses.txt", "--geotiff"), "geotiff"),
        (("--poses", street / "poses.txt", "--las"), "las"),
    ):
        done = command("map", street, "-o", tmp_path / "out", *options, package=False)
        assert done.returncode == 2
        assert done.stderr.count("\n") == 1
        assert f"pip install 'flagstone[{extra}]'" in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_usage_error_of_the_command_is_one_line(street: Path, tmp_path: Path) -> None:
    for options, message in (
        (("--poses", "kiss-icp", "--topic", "/points"), "--topic: "),
        (("--poses", "kiss-icp", "--pose-topic", "/odom"), "--pose-topic: "),
        (("--poses", "kiss-icp", "--delay", "3", "--voxel", "0.001"), "--voxel: "),
        (("--poses", "missing.mcap"), "missing.mcap: "),
        (("--poses", street / "poses.txt", "--crs", "EPSG:25832"), "--crs"),
        (("--poses", street / "poses.txt", "--las", "--voxel", "0"), "--las: needs the static points"),
    ):
        done = command("map", street, "-o", tmp_path / "out", *options)
        assert done.returncode == 2, done.stderr
        assert done.stderr.count("\n") == 1
        assert message in done.stderr
    assert not (tmp_path / "out").exists()


def test_the_result_as_json_has_the_problems(street: Path, tmp_path: Path) -> None:
    lines = (street / "poses.txt").read_text().splitlines()
    lines[3] = " ".join(["nan"] * 12)
    (tmp_path / "poses.txt").write_text("\n".join(lines) + "\n")
    done = command(
        *("map", street, "--poses", tmp_path / "poses.txt", "-o", tmp_path / "out", "--rate", "10"),
        *("--sensor", "vlp-16", "--json"),
    )
    result = json.loads(done.stdout)
    assert (result["mapped"], result["alone"]) == (SCANS - 1, 1)
    assert "line 4 is not finite" in result["problems"][0]
    assert result["problems"] == json.loads((tmp_path / "out" / "run.json").read_text())["problems"]


def test_the_result_is_the_one_in_run_json(mapped: flagstone.MapSummary) -> None:
    result = json.loads((mapped.directory / "run.json").read_text())["result"]
    for name in ("mapped", "alone", "failed", "moving_points", "static_points", "area"):
        assert result[name] == getattr(mapped, name)
