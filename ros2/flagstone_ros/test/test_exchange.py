# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Player, node and listener as separate processes of ROS 2 Jazzy and Kilted exchange clouds without a loss.

    pytest ros2/flagstone_ros/test/test_exchange.py --clouds 1000 -s

prints the latencies.
"""

from __future__ import annotations

import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from clouds import large, message, ouster, scans
from ros_processes import DISTRIBUTIONS, PACKAGE, Ros
from rosbags.typesys import Stores, get_typestore

import flagstone

RATE = 20
SOURCES = 5
TYPES = get_typestore(Stores.ROS2_JAZZY)


def profile_of(distribution: str) -> dict[str, str]:
    """The environment variable that selects the profile of Fast DDS for large clouds."""
    variable = "FASTRTPS_DEFAULT_PROFILES_FILE" if distribution == "jazzy" else "FASTDDS_DEFAULT_PROFILES_FILE"
    return {variable: str(PACKAGE / "config" / "fastdds_large_clouds.xml")}


def decoded(message: bytes) -> tuple[str, dict[str, np.ndarray], int]:
    """Frame, fields and point step of a cloud, as an independent implementation reads them."""
    cloud = TYPES.deserialize_cdr(message, "sensor_msgs/msg/PointCloud2")
    types = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
    dtype = np.dtype(
        {
            "names": [field.name for field in cloud.fields],
            "formats": ["<" + types[field.datatype] for field in cloud.fields],
            "offsets": [field.offset for field in cloud.fields],
            "itemsize": cloud.point_step,
        }
    )
    points = cloud.data.view(dtype)
    assert cloud.height * cloud.width == len(points)
    return cloud.header.frame_id, {name: points[name] for name in dtype.names or ()}, cloud.point_step


def labels_of_command(points: np.ndarray, directory: Path) -> np.ndarray:
    """The labels that `flagstone segment` writes."""
    np.ascontiguousarray(points[:, :4], np.float32).tofile(directory / "scan.bin")
    program = Path(flagstone.__file__).parent / "bin" / "flagstone"
    output = directory / "labels"
    subprocess.run([program, "segment", directory / "scan.bin", "--output", output], check=True, capture_output=True)
    return np.fromfile(next(output.glob("*.label")), np.uint32)


@pytest.mark.parametrize(("player", "node", "listener"), [("jazzy", "kilted", "jazzy"), ("kilted", "jazzy", "kilted")])
def test_no_cloud_is_lost_and_every_field_and_label_is_kept(
    ros: Ros, player: str, node: str, listener: str, request: pytest.FixtureRequest, capsys: pytest.CaptureFixture[str]
) -> None:
    count = request.config.getoption("--clouds")
    points = [large(scan) for scan in scans(SOURCES)]
    sources = []
    for i, scan in enumerate(points):
        sources.append(ros.directory / f"source{i}")
        sources[i].write_bytes(message(scan, f"lidar_{i}"))
    running = ros.node(
        node, parameters={"queue_depth": 200, "qos_overrides./labelled.publisher.depth": 200}, **profile_of(node)
    )
    ready = ros.directory / "ready"
    heard = ros.listener(
        listener,
        "labelled",
        *("--count", str(count), "--ready", ready, "--seconds", str(60 + count / RATE)),
        **profile_of(listener),
    )
    played = ros.player(
        player,
        "points",
        *sources,
        *("--count", str(count), "--until", ready, "--rate", str(RATE)),
        **profile_of(player),
    )
    received = heard.finish(120 + count / RATE)
    sent = played.finish()
    running.stop()

    assert len(sent) == count
    sources_by_stamp = {(sec, nanosec): source for source, sec, nanosec in sent}
    assert [(sec, nanosec) for _, sec, nanosec, _, _ in received] == list(sources_by_stamp)
    digests = {(sources_by_stamp[sec, nanosec], digest) for _, sec, nanosec, _, digest in received}
    assert len(digests) == min(SOURCES, count), "clouds of one source differ"
    for source, digest in digests:
        frame, fields, step = decoded((ros.directory / digest).read_bytes())
        original = ouster(points[source])
        assert frame == f"lidar_{source}"
        assert list(fields) == [*(original.dtype.names or ()), "label", "height"]
        for name in original.dtype.names or ():
            assert fields[name].tobytes() == original[name].tobytes(), name
        result = flagstone.Surface().segment(points[source])
        assert fields["label"].dtype == np.uint8
        assert (fields["label"] == result.labels).all()
        assert (fields["label"] == labels_of_command(points[source], ros.directory)).all()
        assert fields["height"].tobytes() == result.heights.tobytes()
        assert step == 56

    latencies = np.array([now - (sec * 10**9 + nanosec) for _, sec, nanosec, now, _ in received]) / 1e6
    segmenter = flagstone.Surface()
    times = []
    for scan in points * 5:
        start = time.perf_counter()
        segmenter.segment(scan)
        times.append(1000 * (time.perf_counter() - start))
    size = sources[0].stat().st_size / 1e6
    median, slow, segmentation = np.median(latencies), np.percentile(latencies, 99), np.median(times)
    with capsys.disabled():
        print(
            f"\n{player} -> {node} -> {listener}: {count} of {count} clouds of {size:.1f} MB at {RATE} Hz; "
            f"from publish to receipt: median {median:.1f} ms, 99th percentile {slow:.1f} ms; "
            f"segmentation: {segmentation:.2f} ms, {100 * segmentation / median:.0f} % of the median"
        )


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_large_clouds_arrive_at_best_effort_with_the_profile(ros: Ros, distribution: str) -> None:
    count = 20
    profile = profile_of(distribution)
    cloud = ros.directory / "cloud"
    cloud.write_bytes(message(large(scans(SOURCES)[0])))
    best_effort = {
        "qos_overrides./points.subscription.reliability": "best_effort",
        "qos_overrides./labelled.publisher.reliability": "best_effort",
    }
    ready = ros.directory / "ready"
    ros.node(distribution, parameters=best_effort, **profile)
    options = ("--best-effort", "--count", str(count))
    listener = ros.listener(distribution, "labelled", "--ready", ready, *options, "--seconds", "15", **profile)
    ros.player(distribution, "points", cloud, "--until", ready, "--rate", "10", *options, **profile).finish()
    assert len(listener.finish()) >= 0.9 * count, "without the profile, at most 6 of 100 clouds arrived"
