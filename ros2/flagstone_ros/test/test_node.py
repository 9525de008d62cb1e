# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The node in a process of ROS 2: parameters, topics, quality of service, faults and diagnostics."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from clouds import message, scans
from ros_processes import DISTRIBUTIONS, Ros
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import flagstone
from flagstone import ros as codec
from flagstone_ros import declaration
from flagstone_ros.frames import Transform, shortest_rotation_to_z

TYPES = get_typestore(Stores.ROS2_JAZZY)
TYPES.register(
    {
        **get_types_from_msg(
            "uint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 reflectivity\nuint8 tag\nuint8 line",
            "livox_ros_driver2/msg/CustomPoint",
        ),
        **get_types_from_msg(
            "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\n"
            "livox_ros_driver2/CustomPoint[] points",
            "livox_ros_driver2/msg/CustomMsg",
        ),
    }
)
TYPE = TYPES.types
LATEST, OLDEST = "kilted", "jazzy"


def written(directory: Path, name: str, content: bytes) -> Path:
    (directory / name).write_bytes(content)
    return directory / name


def header(frame_id: str) -> Any:
    return TYPE["std_msgs/msg/Header"](TYPE["builtin_interfaces/msg/Time"](1, 0), frame_id)


def tf_message(parent: str, child: str, to_parent: Transform, quaternion: tuple[float, ...]) -> bytes:
    vector, rotation = TYPE["geometry_msgs/msg/Vector3"], TYPE["geometry_msgs/msg/Quaternion"]
    transform = TYPE["geometry_msgs/msg/Transform"](vector(*map(float, to_parent.translation)), rotation(*quaternion))
    stamped = TYPE["geometry_msgs/msg/TransformStamped"](header(parent), child, transform)
    return bytes(TYPES.serialize_cdr(TYPE["tf2_msgs/msg/TFMessage"]([stamped]), "tf2_msgs/msg/TFMessage"))


def imu_message(frame_id: str, acceleration: tuple[float, ...]) -> bytes:
    vector, covariance = TYPE["geometry_msgs/msg/Vector3"], np.zeros(9)
    imu = TYPE["sensor_msgs/msg/Imu"](
        header(frame_id),
        TYPE["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0),
        covariance,
        vector(0.0, 0.0, 0.0),
        covariance,
        vector(*map(float, acceleration)),
        covariance,
    )
    return bytes(TYPES.serialize_cdr(imu, "sensor_msgs/msg/Imu"))


def livox_message(points: np.ndarray) -> bytes:
    point = TYPE["livox_ros_driver2/msg/CustomPoint"]
    records = [point(i, *map(float, xyz), 7, 16, 2) for i, xyz in enumerate(points[:, :3])]
    custom = TYPE["livox_ros_driver2/msg/CustomMsg"](
        header("livox_frame"), 5, len(records), 1, np.zeros(3, np.uint8), records
    )
    return bytes(TYPES.serialize_cdr(custom, "livox_ros_driver2/msg/CustomMsg"))


def received_cloud(ros: Ros, line: list[Any]) -> codec.PointCloud2:
    return codec.parse((ros.directory / line[4]).read_bytes())


def exchange(ros: Ros, *files: Path, topic: str = "labelled", arguments: tuple[str, ...] = ()) -> codec.PointCloud2:
    """The last cloud that a listener receives for the messages of a player."""
    ready = ros.directory / f"ready{len(list(ros.directory.iterdir()))}"
    listener = ros.listener(OLDEST, topic, "--ready", ready)
    ros.player(LATEST, "points", *files, "--until", ready, *arguments).finish()
    return received_cloud(ros, listener.finish()[-1])


# Messages


def corrupted(cloud: bytes, step: int) -> bytes:
    """The message with another point_step."""
    at = cloud.index(struct.pack("<I", 48), 100)
    return cloud[:at] + struct.pack("<I", step) + cloud[at + 4 :]


def malformed() -> dict[str, bytes]:
    """Messages that a node must survive."""
    (points,) = scans()
    good = message(points)
    infinite = points.copy()
    infinite[:, :3] = np.inf
    return {
        "only the encapsulation": b"\0\1\0\0",
        "truncated in the header": good[:11],
        "truncated in the points": good[: len(good) // 2],
        "random bytes": b"\0\1\0\0" + np.random.default_rng(1).bytes(5000),
        "ones": b"\0\1\0\0" + 5000 * b"\xff",
        "no fields": codec.serialize(np.zeros(0, np.dtype([]))),
        "no z": codec.serialize(np.zeros(10, [("x", "f4"), ("y", "f4")])),
        "point_step 0": corrupted(good, 0),
        "point_step too large": corrupted(good, 2**31),
        "no points": message(points[:0]),
        "NaN": message(points * np.float32(np.nan)),
        "infinite": message(infinite),
        "big-endian": big_endian(points),
        "10 million points": codec.serialize(np.zeros((10_000_000, 3), np.float32)),
    }


def big_endian(points: np.ndarray) -> bytes:
    """A cloud whose numbers are big-endian, in a little-endian message."""
    cloud = TYPES.deserialize_cdr(codec.serialize(points[:, :3].copy()), "sensor_msgs/msg/PointCloud2")
    data = np.frombuffer(points[:, :3].astype(">f4").tobytes(), np.uint8)
    members = {name: getattr(cloud, name) for name in cloud.__dataclass_fields__ if not name.startswith("_")}
    changed = type(cloud)(**{**members, "is_bigendian": True, "data": data})
    return bytes(TYPES.serialize_cdr(changed, "sensor_msgs/msg/PointCloud2"))


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_the_node_survives_malformed_messages_and_segments_the_next_one(ros: Ros, distribution: str) -> None:
    (points,) = scans()
    bad = [written(ros.directory, f"bad{i}", content) for i, content in enumerate(malformed().values())]
    node = ros.node(distribution, parameters={"queue_depth": 100})
    first = written(ros.directory, "first", message(points))
    good = written(ros.directory, "good", message(points, "survivor"))
    ready = ros.directory / "ready"
    # Only the clouds without points, of invalid points and with another byte order can be labelled, and the good one.
    listener = ros.listener(OLDEST, "labelled", "--ready", ready, "--count", "7", "--seconds", "40")
    ros.player(LATEST, "points", first, *bad, good, "--until", ready, "--rate", "10", "--linger", "3").finish()
    received = listener.finish()
    clouds = [received_cloud(ros, line) for line in received]
    sizes = [len(points), 0, *[len(points)] * 3, 10_000_000, len(points)]
    assert [len(cloud) for cloud in clouds] == sizes
    assert clouds[-1].header.frame_id == "survivor"
    expected = flagstone.Surface().segment(points).labels
    assert (clouds[4].points["label"] == expected).all(), "big-endian"
    lines = node.matching("the cloud is skipped")
    assert 1 <= len(lines) <= 3, "\n".join(node.lines)
    assert not node.matching("Traceback")
    assert node.process.poll() is None


def test_a_cloud_in_millimetres_is_reported_once(ros: Ros) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points * np.float32([1000, 1000, 1000, 1])))
    node = ros.node(LATEST)
    exchange(ros, cloud, cloud, cloud)
    assert len(node.matching("points are out of range .*mount.scale")) == 1


def test_livox_messages_are_labelled(ros: Ros) -> None:
    (points,) = scans()
    points = points[:5000]
    cloud = written(ros.directory, "livox", livox_message(points))
    ros.node(LATEST, parameters={"input_type": "livox_ros_driver2/msg/CustomMsg"})
    output = exchange(ros, cloud, arguments=("--type", "livox_ros_driver2/msg/CustomMsg"))
    assert output.header.frame_id == "livox_frame"
    assert (output.points["label"] == flagstone.Surface().segment(points).labels).all()
    assert (output.points["line"] == 2).all()


# Parameters


def test_parameters_have_the_descriptions_and_ranges_of_flagstone(ros: Ros) -> None:
    ros.node(LATEST)
    described = {line["name"]: line for line in ros.client(LATEST, "describe", "point.margin", "queue_depth", "method")}
    (setting,) = (p for p in declaration.setting_parameters("surface") if p.name == "point.margin")
    assert described["point.margin"]["description"] == setting.description
    assert described["point.margin"]["range"] == [0, 10]
    assert described["queue_depth"]["range"] == [1, 1000]
    assert described["method"]["read_only"]


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_invalid_values_are_rejected_with_the_reason_and_change_nothing(ros: Ros, distribution: str) -> None:
    ros.node(distribution)
    names = ("sensor_height", "refinement.gate", "sensor", "tilt")
    before = ros.client(LATEST, "get", *names)
    rejected = {
        "refinement.gate=0.0": "refinement.gate = 0 is out of range (expected above 0, up to 10 m)",
        'sensor="nope"': "no sensor is named 'nope'",
        'sensor_height="high"': "sensor_height",
        'tilt="sideways"': "tilt",
        "point.margin=50.0": "point.margin",
        'method="patchwork"': "read-only",
    }
    groups = " / ".join(f"max_range=50.0 {change}" for change in rejected).split(" ")
    results = ros.client(LATEST, "set", *groups)
    for result, reason in zip(results, rejected.values(), strict=True):
        assert not result["successful"]
        assert reason in result["reason"]
        assert "\n" not in result["reason"]
    assert ros.client(LATEST, "get", *names) == before
    assert ros.client(LATEST, "get", "max_range") == [["max_range", 100.0]]


def test_changes_apply_to_the_next_cloud_and_all_values_are_those_in_use(ros: Ros) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points))
    ros.node(LATEST, parameters={"method": "patchwork", "sensor": "vlp-16", "distance_margin": 0.2})
    names = [p.name for p in declaration.setting_parameters("patchwork")]

    def expected(**arguments: Any) -> dict[str, Any]:
        settings = flagstone.Patchwork(distance_margin=0.2, **arguments).settings
        values: dict[str, Any] = {}
        for name in names:
            value: Any = settings
            for key in name.split("."):
                value = value[key]
            values[name] = value
        return values

    assert dict(ros.client(LATEST, "get", *names)) == expected(sensor="vlp-16")
    (result,) = ros.client(LATEST, "set", "sensor_height=2.4", 'sensor="os0-128"')
    assert result == {"successful": True, "reason": ""}
    assert dict(ros.client(LATEST, "get", *names)) == expected(sensor="os0-128", sensor_height=2.4)
    assert ros.client(LATEST, "get", "sensor_height") == [["sensor_height", 2.4]]
    labels = exchange(ros, cloud).points["label"]
    segmenter = flagstone.Patchwork(sensor="os0-128", sensor_height=2.4, distance_margin=0.2)
    assert (labels == segmenter.segment(points).labels).all()


def test_an_unknown_parameter_is_reported(ros: Ros) -> None:
    node = ros.node(LATEST, parameters={"point.margins": 0.3})
    node.wait_for("'point.margins' is not a parameter of this node")


@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ({"point.margin": -1.0}, "point.margin"),
        ({"refinement.gate": 0.0}, "expected above 0, up to 10 m"),
        ({"sensor": "nope"}, "no sensor is named 'nope'"),
        ({"method": "other"}, "expected surface or patchwork"),
        ({"input_type": "livox_interfaces/msg/CustomMsg"}, "livox_interfaces is not installed"),
    ],
)
def test_the_node_ends_with_one_line_if_it_cannot_start(ros: Ros, parameters: dict[str, Any], reason: str) -> None:
    node = ros.node(LATEST, parameters=parameters, wait=False)
    line = node.wait_for("^ground_segmentation: ")
    assert reason in line
    assert node.process.wait(10) == 1
    assert not node.matching("Traceback")


# Topics


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_topics_are_relative_and_can_be_remapped(ros: Ros, distribution: str) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points))
    remappings = ("__ns:=/front", "points:=/driver/points", "ground:=/ground_segmentation/ground_points")
    ros.node(distribution, *remappings, points="/driver/points")
    ready = ros.directory / "ready"
    listener = ros.listener(OLDEST, "/ground_segmentation/ground_points", "/front/nonground", "--ready", ready)
    ros.player(LATEST, "/driver/points", cloud, "--until", ready).finish()
    sizes = {line[0]: len(received_cloud(ros, line)) for line in listener.finish()}
    result = flagstone.Surface().segment(points)
    assert sizes["/ground_segmentation/ground_points"] == result.counts["ground"]
    assert sizes["/front/nonground"] == result.counts["nonground"]


def test_nothing_is_segmented_without_a_subscriber(ros: Ros) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points))
    ros.node(LATEST)
    ros.player(LATEST, "points", cloud, "--count", "100").wait_for(r"^\[0, ")
    for status in ros.client(LATEST, "diagnostics", "2"):
        assert status["values"]["clouds"] == "0"
    assert status["message"] == "no output has a subscriber"


def test_a_tracked_height_is_updated_without_a_subscriber(ros: Ros) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points))
    ros.node(LATEST, parameters={"sensor_height": "track"})
    ros.player(LATEST, "points", cloud, "--count", "60")
    status = ros.client(LATEST, "diagnostics", "4")[-1]
    assert int(status["values"]["clouds"]) > 0
    segmenter = flagstone.Surface(sensor_height="track")
    assert float(status["values"]["sensor height (m)"]) == pytest.approx(
        segmenter.segment(points).mount.sensor_height, abs=0.02
    )


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_an_incompatible_quality_of_service_is_reported(ros: Ros, distribution: str) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points))
    node = ros.node(
        distribution,
        parameters={"qos_overrides./labelled.publisher.reliability": "best_effort"},
    )
    ros.player(LATEST, "points", cloud, "--best-effort", "--count", "40")
    ros.listener(LATEST, "labelled", "--seconds", "5")
    line = node.wait_for("/points: .*reliability is incompatible")
    assert "set qos_overrides./points.subscription.reliability" in line
    node.wait_for("/labelled: .*set qos_overrides./labelled.publisher.reliability")


def test_a_node_that_falls_behind_drops_the_oldest_clouds_and_reports_it(ros: Ros) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points, "old"))
    last = written(ros.directory, "last", message(points, "last"))
    node = ros.node(LATEST, parameters={"queue_depth": 1})
    ready = ros.directory / "ready"
    listener = ros.listener(
        OLDEST, "labelled", "ground", "nonground", "--ready", ready, "--count", "100", "--seconds", "15"
    )
    ros.player(LATEST, "points", *[cloud] * 80, last, "--until", ready, "--rate", "2000").finish()
    node.wait_for("points: .*oldest clouds dropped")
    (status,) = ros.client(LATEST, "diagnostics", "1")
    assert int(status["values"]["dropped"]) > 0
    received = [line for line in listener.finish() if line[0] == "labelled"]
    assert len(received) < 81
    assert received_cloud(ros, received[-1]).header.frame_id == "last"
    assert [line[1:3] for line in received] == sorted(line[1:3] for line in received)


# Frames


def publish_transform(ros: Ros, transform: Path) -> None:
    options = ("--type", "tf2_msgs/msg/TFMessage", "--transient-local", "--keep-stamps", "--linger", "40")
    ros.player(LATEST, "/tf_static", transform, *options)


def test_a_cloud_in_another_frame_is_skipped_until_its_transform_arrives(ros: Ros) -> None:
    (points,) = scans()
    quaternion = (0.0, 0.0, float(np.sin(0.4)), float(np.cos(0.4)))
    to_base = Transform.from_quaternion((1.2, 0.3, 1.73), quaternion)
    in_base = points.copy()
    in_base[:, :3] = to_base.apply(points[:, :3])
    cloud = written(ros.directory, "cloud", message(in_base, "base_link"))
    node = ros.node(LATEST, parameters={"sensor_frame": "lidar"})
    ready = ros.directory / "ready"
    listener = ros.listener(OLDEST, "labelled", "--ready", ready)
    player = ros.player(LATEST, "points", cloud, "--until", ready)
    line = node.wait_for("no transform from the cloud's frame 'base_link' to 'lidar'")
    assert "the cloud is skipped" in line
    transform = written(ros.directory, "tf", tf_message("base_link", "lidar", to_base, quaternion))
    publish_transform(ros, transform)
    player.finish()
    output = received_cloud(ros, listener.finish()[-1])
    expected = flagstone.Surface().segment(points).labels
    assert (output.points["label"] == expected).mean() > 0.999
    assert output.header.frame_id == "base_link"
    assert output.xyz.tobytes() == np.ascontiguousarray(in_base[:, :3]).tobytes()


def test_gravity_of_an_imu_in_another_frame_levels_the_cloud(ros: Ros) -> None:
    (points,) = scans()
    up = np.array([np.sin(0.6), 0.0, np.cos(0.6)])
    tilted = points.copy()
    tilted[:, :3] = points[:, :3] @ shortest_rotation_to_z(up).astype(np.float32)
    quaternion = (0.0, 0.0, float(np.sqrt(0.5)), float(np.sqrt(0.5)))  # the IMU is rotated by 90 degrees about z
    to_lidar = Transform.from_quaternion((0, 0, 0), quaternion)
    acceleration = to_lidar.rotation.T @ (9.81 * up)
    cloud = written(ros.directory, "cloud", message(tilted, "lidar"))
    imu = written(ros.directory, "imu", imu_message("imu", tuple(acceleration)))
    transform = written(ros.directory, "tf", tf_message("lidar", "imu", to_lidar, quaternion))
    node = ros.node(LATEST, parameters={"tilt": "imu"})
    publish_transform(ros, transform)
    ready = ros.directory / "ready"
    listener = ros.listener(OLDEST, "labelled", "--ready", ready)
    player = ros.player(LATEST, "points", cloud, "--until", ready, "--linger", "3")
    node.wait_for("imu: no acceleration has arrived")
    ros.player(LATEST, "imu", imu, "--type", "sensor_msgs/msg/Imu", "--count", "3000", "--rate", "100")
    player.process.wait(40)
    output = received_cloud(ros, listener.finish()[-1])
    expected = flagstone.Surface().segment(points).labels
    assert (output.points["label"] == expected).mean() > 0.999


# Diagnostics


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_diagnostics_report_rate_latency_and_mount(ros: Ros, distribution: str) -> None:
    (points,) = scans()
    cloud = written(ros.directory, "cloud", message(points))
    ros.node(distribution, parameters={"queue_depth": 200})
    silent = ros.client(LATEST, "diagnostics", "3")[-1]
    assert silent["name"] == "ground_segmentation: ground segmentation"
    assert (silent["level"], silent["message"]) == (1, "no cloud has arrived yet")
    ready = ros.directory / "ready"
    ros.listener(OLDEST, "labelled", "--count", "1000", "--ready", ready, "--seconds", "15")
    player = ros.player(LATEST, "points", cloud, "--count", "400", "--rate", "20", "--until", ready)
    player.wait_for(r"^\[0, ")
    busy = ros.client(LATEST, "diagnostics", "3")[-1]
    assert (busy["level"], busy["message"]) == (0, "clouds are segmented")
    assert list(busy["values"]) == [value.key for value in declaration.DIAGNOSTICS]
    assert float(busy["values"]["rate (Hz)"]) == pytest.approx(20, abs=8)
    assert 0 < float(busy["values"]["latency, median (ms)"]) <= float(busy["values"]["latency, worst (ms)"])
    assert float(busy["values"]["sensor height (m)"]) == pytest.approx(1.73)


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_the_node_ends_quietly_when_interrupted(ros: Ros, distribution: str) -> None:
    node = ros.node(distribution)
    ros.client(LATEST, "diagnostics", "1")  # the executor runs
    assert node.stop() == 0
    assert not node.matching("Traceback|rror")
