# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone bag` and `flagstone.bag`: labelled clouds in bags of every format."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import flagstone
import flagstone.bags

pytest.importorskip("rosbags", reason="needs rosbags, of the test dependencies")

from bag_scenes import (
    FORMATS,
    PERIOD,
    START,
    Points,
    Record,
    bag_name,
    cloud,
    of_topic,
    parse,
    read_bag,
    run,
    scans,
    scene,
    serialized,
    typestore,
    write_bag,
)
from conftest import run_command

Columns = tuple[npt.NDArray[np.uint8], npt.NDArray[np.float32]]


def labels_of_command(folder: Path, clouds: list[Points], *options: str) -> list[Columns]:
    """Labels and heights that `flagstone segment` writes for scans."""
    folder.mkdir(exist_ok=True)
    for index, points in enumerate(clouds):
        flagstone.io.write(folder / f"{index:03}.bin", points)
    run_command("segment", folder, "--output", folder / "out", "--format", "u8", "--heights", *options)
    outputs = [folder / "out" / f"{index:03}" for index in range(len(clouds))]
    return [(np.load(f"{path}.label.npy"), np.load(f"{path}.heights.npy")) for path in outputs]


def labels_in(format: str, records: list[Record], topic: str = "/points/labelled") -> list[Columns]:
    """Labels and heights in the messages of a topic."""
    clouds = [parse(format, data) for _, _, data in of_topic(records, topic)]
    return [(cloud.points["label"].copy(), cloud.points["height"].copy()) for cloud in clouds]


def assert_equal(found: list[Columns], expected: list[Columns]) -> None:
    assert len(found) == len(expected)
    for (labels, heights), (expected_labels, expected_heights) in zip(found, expected, strict=True):
        np.testing.assert_array_equal(labels, expected_labels)
        np.testing.assert_array_equal(heights, expected_heights)


@pytest.mark.parametrize("format", FORMATS)
def test_all_messages_are_copied_and_labels_are_those_of_segment(format: str, tmp_path: Path) -> None:
    clouds = scans(6)
    source = write_bag(tmp_path / bag_name(format), format, scene(format, clouds))

    done = run("bag", source, tmp_path / bag_name(format, "out"))

    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    before, after = read_bag(source), read_bag(tmp_path / bag_name(format, "out"))
    assert [record for record in after if record[0] != "/points/labelled"] == before
    assert len(after) == len(before) + len(clouds)
    assert_equal(labels_in(format, after), labels_of_command(tmp_path / "scans", clouds))


@pytest.mark.parametrize("format", FORMATS)
def test_an_added_message_follows_its_cloud_with_its_times_and_header_and_all_fields(
    format: str, tmp_path: Path
) -> None:
    source = write_bag(tmp_path / bag_name(format), format, scene(format, scans(3)))

    flagstone.bag(source, tmp_path / bag_name(format, "out"))

    after = read_bag(tmp_path / bag_name(format, "out"))
    pairs = [(a, b) for a, b in itertools.pairwise(after) if b[0] == "/points/labelled"]
    assert len(pairs) == 3
    for (topic, time, data), (_, added_time, added) in pairs:
        assert topic == "/points"
        assert added_time == time
        original, labelled = parse(format, data), parse(format, added)
        assert labelled.header == original.header
        assert [field.name for field in labelled.fields] == ["x", "y", "z", "intensity", "label", "height"]
        for name in ("x", "y", "z", "intensity"):
            assert labelled.points[name].tobytes() == original.points[name].tobytes()


@pytest.mark.parametrize("format", FORMATS)
def test_split_adds_a_topic_per_label(format: str, tmp_path: Path) -> None:
    clouds = scans(2)
    source = write_bag(tmp_path / bag_name(format), format, scene(format, clouds))

    done = run("bag", source, tmp_path / bag_name(format, "out"), "--format", "split")

    assert done.returncode == 0, done.stderr
    after = read_bag(tmp_path / bag_name(format, "out"))
    expected = labels_of_command(tmp_path / "scans", clouds)
    for topic, label in (("/points/ground", 1), ("/points/nonground", 0)):
        for (_, _, data), points, (labels, heights) in zip(of_topic(after, topic), clouds, expected, strict=True):
            selected = parse(format, data)
            np.testing.assert_array_equal(selected.xyz, points[labels == label, :3])
            np.testing.assert_array_equal(selected.points["height"], heights[labels == label])
    assert not of_topic(after, "/points/labelled")


@pytest.mark.parametrize("word", ["estimate", "track"])
def test_heights_are_estimated_and_tracked_as_by_segment(word: str, tmp_path: Path) -> None:
    clouds = [points + np.float32([0, 0, -0.02 * index, 0]) for index, points in enumerate(scans(6, 6000))]
    source = write_bag(tmp_path / "drive", "mcap", scene("mcap", clouds))

    done = run("bag", source, tmp_path / "out", "--sensor-height", word)

    assert done.returncode == 0, done.stderr
    expected = labels_of_command(tmp_path / "scans", clouds, "--sensor-height", word)
    assert_equal(labels_in("mcap", read_bag(tmp_path / "out")), expected)
    assert ("mount: sensor 1.7" in done.stdout) == (word == "estimate")
    assert done.stderr == ""


def test_settings_are_those_of_segment(tmp_path: Path) -> None:
    clouds = scans(2)
    source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", clouds))
    options = [
        "--method",
        "patchwork",
        "--sensor",
        "hdl-32e",
        "--sensor-height",
        "1.7",
        "--set",
        "uprightness.angle=50",
    ]

    done = run("bag", source, tmp_path / "out.bag", *options)

    assert done.returncode == 0, done.stderr
    folder = tmp_path / "scans"
    folder.mkdir()
    for index, points in enumerate(clouds):
        flagstone.io.write(folder / f"{index}.bin", points)
    run_command("segment", folder, "--output", folder / "out", "--format", "u8", *options)
    found = labels_in("rosbag1", read_bag(tmp_path / "out.bag"))
    for index, (labels, heights) in enumerate(found):
        np.testing.assert_array_equal(labels, np.load(folder / "out" / f"{index}.label.npy"))
        assert np.isnan(heights).all()  # patchwork does not compute heights


def test_the_number_of_threads_does_not_affect_the_output(tmp_path: Path) -> None:
    source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(8)))
    for threads in (1, 3):
        flagstone.bag(source, tmp_path / f"{threads}.bag", threads=threads)
    assert (tmp_path / "1.bag").read_bytes() == (tmp_path / "3.bag").read_bytes()


def quarter_turn(points: Points) -> Points:
    """The points in a frame that is turned by 90 degrees about x and moved: x, y, z become x, -z, y and then shift."""
    turned = points.copy()
    turned[:, 1], turned[:, 2] = -points[:, 2], points[:, 1]
    turned[:, :3] += np.float32([1, 0, 2])
    return turned


def test_tf_segments_in_the_frame_of_the_sensor(tmp_path: Path) -> None:
    clouds = scans(3)
    root = math.sqrt(0.5)
    static = [
        ("map", "base_link", (5.0, 5.0, 5.0), (0.0, 0.0, 0.0, 1.0)),
        ("base_link", "mast", (1.0, 0.0, 2.0), (0.0, 0.0, 0.0, 1.0)),
        ("mast", "lidar", (0.0, 0.0, 0.0), (root, 0.0, 0.0, root)),  # 90 degrees about x
    ]
    in_vehicle = [quarter_turn(points) for points in clouds]
    records = scene("mcap", in_vehicle, frame="base_link", static=static)
    source = write_bag(tmp_path / "drive", "mcap", records)

    done = run("bag", source, tmp_path / "out", "--tf", "lidar")

    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    after = read_bag(tmp_path / "out")
    expected = labels_of_command(tmp_path / "scans", clouds)
    for (labels, heights), (expected_labels, expected_heights) in zip(labels_in("mcap", after), expected, strict=True):
        assert (labels == expected_labels).mean() > 0.999  # the coordinates were rounded in another frame
        both = np.isfinite(heights) & np.isfinite(expected_heights)
        assert np.abs(heights - expected_heights)[both].max() < 0.01
    for (_, _, data), points in zip(of_topic(after, "/points/labelled"), in_vehicle, strict=True):
        np.testing.assert_array_equal(parse("mcap", data).xyz, points[:, :3])


def test_imu_determines_the_up_direction(tmp_path: Path) -> None:
    clouds = scans(3)
    angle = math.radians(25)
    sine, cosine = math.sin(angle), math.cos(angle)
    pitch = np.float32([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]])  # from the level frame to the sensor
    tilted = [np.concatenate([points[:, :3] @ pitch.T, points[:, 3:]], axis=1) for points in clouds]
    # The IMU is mounted upside down on the sensor: y and z are negated.
    up = pitch @ np.float32([0, 0, 9.81]) * np.float32([1, -1, -1])
    static = [("lidar", "imu", (0.1, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))]
    records = scene("mcap", tilted, static=static, imu_frame="imu", acceleration=up)
    source = write_bag(tmp_path / "drive", "mcap", records)

    done = run("bag", source, tmp_path / "out", "--imu", "/imu")

    assert done.returncode == 0, done.stderr
    expected = labels_of_command(tmp_path / "scans", tilted, "--tilt", f"{-sine},0,{cosine}")
    found = labels_in("mcap", read_bag(tmp_path / "out"))
    for (labels, _), (expected_labels, _) in zip(found, expected, strict=True):
        assert (labels == expected_labels).mean() > 0.999
        assert (labels == 1).mean() > 0.7
    without = labels_of_command(tmp_path / "without", tilted)
    level = labels_of_command(tmp_path / "level", clouds)
    for (labels, _), (worse, _), (true, _) in zip(found, without, level, strict=True):
        assert (labels == true).mean() > 0.98
        assert (worse == true).mean() < 0.95


@pytest.mark.parametrize("frame", ["base_link", "/robot/odom", "map"])
def test_clouds_in_another_frame_are_one_warning(frame: str, tmp_path: Path) -> None:
    source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(2), frame=frame))
    done = run("bag", source, tmp_path / "out.bag")
    assert done.returncode == 0
    (line,) = done.stderr.splitlines()
    assert f"the clouds are in frame '{frame}'" in line
    assert "--tf" in line


def test_json_describes_each_cloud_and_the_run(tmp_path: Path) -> None:
    source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(3)))
    done = run("bag", source, tmp_path / "out.bag", "--json", "--sensor-height", "estimate")
    *clouds, last = [json.loads(line) for line in done.stdout.splitlines()]
    assert [record["message"] for record in clouds] == [0, 1, 2]
    assert [record["log_time"] for record in clouds] == [START + index * PERIOD for index in range(3)]
    for record in clouds:
        assert sum(record["counts"].values()) == record["points"] == 3000
        assert record["outputs"] == ["/points/labelled"]
        assert record["mount"]["sensor_height"] == pytest.approx(1.73, abs=0.05)
    assert last["messages"] == len(read_bag(source))
    assert (last["clouds"], last["failed"], last["problems"]) == (3, 0, [])
    assert last["bottleneck"] in ("reading", "writing", "segmenting")


def test_the_result_counts_messages_clouds_and_points(tmp_path: Path) -> None:
    source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(4)))
    summary = flagstone.bag(source, tmp_path / "out.bag", segmenter=flagstone.Surface(), format="both")
    assert summary.ok
    assert summary.messages == len(read_bag(source))
    assert (summary.clouds, summary.points, sum(summary.counts.values())) == (4, 12_000, 12_000)
    assert summary.topics == {"/points": ("/points/labelled", "/points/ground", "/points/nonground")}
    sizes = sum(len(data) for _, _, data in read_bag(tmp_path / "out.bag"))
    assert summary.bytes == sizes
    assert "4 of 4 clouds labelled, 12000 points" in str(summary)


def test_several_topics_can_be_labelled(tmp_path: Path) -> None:
    records = scene("mcap", scans(2), topic="/front/points")
    records += [
        ("/rear/points", START + 7 + i, cloud("mcap", points, START + 7 + i)) for i, points in enumerate(scans(3))
    ]
    source = write_bag(tmp_path / "drive", "mcap", sorted(records, key=lambda record: record[1]))
    summary = flagstone.bag(source, tmp_path / "out", topics=["/front/points", "/rear/points"])
    after = read_bag(tmp_path / "out")
    assert summary.clouds == 5
    assert len(of_topic(after, "/front/points/labelled")) == 2
    assert_equal(labels_in("mcap", after, "/rear/points/labelled"), labels_of_command(tmp_path / "scans", scans(3)))


def test_the_extension_selects_the_format_of_a_bag_of_ros_2(tmp_path: Path) -> None:
    source = write_bag(tmp_path / "drive", "sqlite3", scene("sqlite3", scans(2)))
    run("bag", source, tmp_path / "same")
    for name, format in (("out.mcap", "mcap"), ("out.db3", "sqlite3")):
        done = run("bag", source, tmp_path / name)
        assert done.returncode == 0, done.stderr
        with flagstone.bags.open_bag(tmp_path / name) as bag:
            assert bag.format == format
            found = [(message.topic.name, message.log_time, bytes(message.data)) for message in bag.messages()]
        assert found == read_bag(tmp_path / "same")


def test_bags_of_ros_1_are_not_converted(tmp_path: Path) -> None:
    source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(1)))
    done = run("bag", source, tmp_path / "out.mcap")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "out.mcap").exists()


@pytest.mark.parametrize("format", ["rosbag1", "mcap"])
def test_custom_messages_of_livox_are_labelled(format: str, tmp_path: Path) -> None:
    from rosbags.typesys import get_types_from_msg

    package = "livox_ros_driver2"
    point = "uint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 reflectivity\nuint8 tag\nuint8 line\n"
    message = "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\n"
    message += "CustomPoint[] points\n"
    store = typestore(format)
    if f"{package}/msg/CustomMsg" not in store.types:
        store.register(
            {
                **get_types_from_msg(point, f"{package}/msg/CustomPoint"),
                **get_types_from_msg(message, f"{package}/msg/CustomMsg"),
            }
        )
    from bag_scenes import header

    (points,) = scans(1, 2000)
    custom = store.types[f"{package}/msg/CustomMsg"](
        header=header(format, START, "livox_frame"),
        timebase=START,
        point_num=len(points),
        lidar_id=1,
        rsvd=np.zeros(3, np.uint8),
        points=[
            store.types[f"{package}/msg/CustomPoint"](
                offset_time=i, x=float(x), y=float(y), z=float(z), reflectivity=1, tag=0, line=0
            )
            for i, (x, y, z, _) in enumerate(points)
        ],
    )
    records = [("/livox/lidar", START, serialized(format, custom))]
    source = write_bag(tmp_path / bag_name(format), format, records, {"/livox/lidar": f"{package}/msg/CustomMsg"})

    done = run("bag", source, tmp_path / bag_name(format, "out"))

    assert done.returncode == 0, done.stderr
    found = labels_in(format, read_bag(tmp_path / bag_name(format, "out")), "/livox/lidar/labelled")
    assert_equal(found, labels_of_command(tmp_path / "scans", [points]))


class TestInfo:
    """`flagstone info BAG`."""

    @pytest.mark.parametrize("format", FORMATS)
    def test_topics_fields_and_frames_are_listed(self, format: str, tmp_path: Path) -> None:
        source = write_bag(tmp_path / bag_name(format), format, scene(format, scans(2)))
        done = run("info", source)
        assert done.returncode == 0, done.stderr
        words = [line.split() for line in done.stdout.splitlines()]
        assert ["/points", "2", "sensor_msgs/msg/PointCloud2"] in words
        assert ["/imu", "10", "sensor_msgs/msg/Imu"] in words
        assert ["/telemetry", "2", "acme_msgs/msg/Telemetry"] in words
        assert ["frame", "lidar"] in words
        assert ["intensity", "float32", "12"] in words
        assert ["frames", "in", "/tf_static", "base_link,", "lidar"] in words

    def test_bags_and_scans_cannot_be_mixed(self, tmp_path: Path) -> None:
        done = run("info", tmp_path / "a.bag", tmp_path / "b.bin")
        assert done.returncode == 2
        assert "a.bag: is a bag, and" in done.stderr

    def test_a_missing_bag_is_one_line_and_the_others_are_described(self, tmp_path: Path) -> None:
        source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(1)))
        done = run("info", tmp_path / "missing.mcap", source)
        assert done.returncode == 1
        (line,) = done.stderr.splitlines()
        assert line.startswith(f"flagstone: {tmp_path}/missing.mcap: ")
        assert "/points" in done.stdout


class TestDoctor:
    """`flagstone doctor BAG`."""

    def test_findings_are_equal_for_a_bag_and_its_scans(self, tmp_path: Path) -> None:
        frames = flagstone.simulate(tmp_path / "simulated", scene="urban_street", sensor="vlp-16", frames=2)
        clouds = [flagstone.io.read(frame.scan) for frame in frames]
        records = [("/points", START + i, cloud("mcap", points, START + i)) for i, points in enumerate(clouds)]
        source = write_bag(tmp_path / "drive", "mcap", records)

        of_bag = run("doctor", source, "--json")
        of_scans = run("doctor", *(frame.scan for frame in frames), "--json")

        assert of_bag.returncode == of_scans.returncode, of_bag.stderr
        found, expected = json.loads(of_bag.stdout), json.loads(of_scans.stdout)
        assert found["findings"] == expected["findings"]
        assert found["toml"] == expected["toml"]
        assert found["scans"] == [f"{source}: /points: message {index}" for index in range(2)]

    def test_clouds_are_spread_over_the_bag(self, tmp_path: Path) -> None:
        source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(9)))
        done = run("doctor", source, "--max-scans", "3", "--json")
        names = [name.rpartition(" ")[2] for name in json.loads(done.stdout)["scans"]]
        assert names == ["0", "3", "6"]

    def test_settings_are_written_and_an_input_is_not_overwritten(self, tmp_path: Path) -> None:
        source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(1)))
        before = source.read_bytes()
        assert run("doctor", source, "--output", source).returncode == 2
        assert source.read_bytes() == before
        run("doctor", source, "--output", tmp_path / "doctor.toml")
        assert (tmp_path / "doctor.toml").read_text().endswith("\n")

    def test_a_cloud_that_cannot_be_read_is_one_line(self, tmp_path: Path) -> None:
        records = [("/points", START, cloud("mcap", scans(1)[0], START)[:200])]
        source = write_bag(tmp_path / "drive", "mcap", records)
        done = run("doctor", source)
        assert done.returncode == 1
        (line,) = done.stderr.splitlines()
        assert line.startswith(f"flagstone: {source}: /points: message 0: byte ")
