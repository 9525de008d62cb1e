# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.bags` reads and writes bags, the same as independent implementations, and reports damage."""

from __future__ import annotations

import importlib
import os
import random
import shutil
import signal
import sqlite3
import struct
import subprocess
import sys
import tracemalloc
from pathlib import Path
from typing import Any

import pytest
from bag_files import (
    CLOUD,
    IMU,
    KINDS,
    QOS,
    ROS2_KINDS,
    Kind,
    Row,
    added_data,
    changed,
    connections_by_rosbags,
    copied,
    files_in,
    main_file,
    read,
    read_by_rosbags,
    rows_of,
    some_rows,
    write_by_rosbags,
)
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from flagstone.bags import create_bag, open_bag
from flagstone.bags.definitions import POINT_CLOUD2_OF_ROS1, POINT_CLOUD2_OF_ROS2
from flagstone.bags.reports import MAX_LINES

all_kinds = pytest.mark.parametrize("kind", KINDS, ids=str)
ros2_kinds = pytest.mark.parametrize("kind", ROS2_KINDS, ids=str)
plain_kinds = pytest.mark.parametrize("kind", [Kind("rosbag1"), Kind("sqlite3"), Kind("mcap")], ids=str)
property_test = settings(
    deadline=None, max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)


# Reading and copying


@all_kinds
def test_bags_by_rosbags_are_read(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows()
    path = write_by_rosbags(tmp_path, kind, rows)
    with open_bag(path) as bag:
        assert rows_of(bag.messages()) == rows
        assert bag.format == kind.format
        assert bag.message_count == len(rows)
        assert (bag.start_time, bag.end_time) == (rows[0].time, rows[-1].time)
        assert {topic.name: (topic.type, topic.message_count) for topic in bag.topics} == {
            "/imu": (IMU, 12),
            "/points": (CLOUD, 12),
        }
        expected = connections_by_rosbags(path)
        for topic in bag.topics:
            assert topic.definition == expected[topic.name].msgdef.data
            assert topic.type_hash == expected[topic.name].digest
            assert topic.encoding == ("ros1" if kind.format == "rosbag1" else "cdr")


@all_kinds
def test_copies_are_read_by_rosbags(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows()
    source = write_by_rosbags(tmp_path, kind, rows)
    target = copied(source, kind.path(tmp_path, "out"), added="/points/labelled")
    result = read_by_rosbags(target)
    assert [row for row in result if row.topic != "/points/labelled"] == rows
    added = [Row("/points/labelled", row.time, added_data(row.data)) for row in rows if row.topic == "/points"]
    assert [row for row in result if row.topic == "/points/labelled"] == added
    with open_bag(source) as before, open_bag(target) as after:
        assert (before.compression, before.compression_mode) == (after.compression, after.compression_mode)
    assert read(target)[1] == []


@all_kinds
def test_an_added_topic_is_like_its_cloud(tmp_path: Path, kind: Kind) -> None:
    source = write_by_rosbags(tmp_path, kind, some_rows())
    connections = connections_by_rosbags(copied(source, kind.path(tmp_path, "out"), added="/points/labelled"))
    cloud, added = connections["/points"], connections["/points/labelled"]
    assert (added.msgtype, added.msgdef, added.digest, added.ext) == (CLOUD, cloud.msgdef, cloud.digest, cloud.ext)
    assert added.msgcount == 12


@all_kinds
def test_a_copy_keeps_connections(tmp_path: Path, kind: Kind) -> None:
    source = write_by_rosbags(tmp_path, kind, some_rows())
    before = connections_by_rosbags(source)
    after = connections_by_rosbags(copied(source, kind.path(tmp_path, "out")))
    if kind.format == "rosbag1":
        assert (after["/imu"].ext.callerid, after["/imu"].ext.latching) == ("/driver", 1)
    else:
        assert after["/imu"].ext.offered_qos_profiles == [QOS]
    for topic in before:
        assert (before[topic].msgdef, before[topic].digest, before[topic].ext) == (
            after[topic].msgdef,
            after[topic].digest,
            after[topic].ext,
        )


@pytest.mark.parametrize("version", [8, 9])
@ros2_kinds
def test_a_copy_keeps_metadata_yaml_except_counts_and_names(tmp_path: Path, kind: Kind, version: int) -> None:
    source = write_by_rosbags(tmp_path, kind, some_rows(), version=version)
    text = (source / "metadata.yaml").read_text().replace("ros_distro: rosbags", "ros_distro: jazzy\n  unknown: [1, a]")
    (source / "metadata.yaml").write_text(text)
    before, after = (metadata_of(path) for path in (source, copied(source, tmp_path / "out", added="/points/labelled")))
    assert after["message_count"] == 36
    assert [entry["message_count"] for entry in after["topics_with_message_count"]] == [12, 12, 12]
    assert after["topics_with_message_count"][:2] == before["topics_with_message_count"]
    added, cloud = after["topics_with_message_count"][2], before["topics_with_message_count"][1]
    assert added["topic_metadata"] == {**cloud["topic_metadata"], "name": "/points/labelled"}
    assert after["relative_file_paths"] == [main_file(tmp_path / "out").name]
    assert after["files"] == [{**before["files"][0], "path": main_file(tmp_path / "out").name, "message_count": 36}]
    changes = {"message_count", "topics_with_message_count", "relative_file_paths", "files"}
    assert {key: after[key] for key in before if key not in changes} == {
        key: before[key] for key in before if key not in changes
    }
    assert after["custom_data"] == {"vehicle": "12"}
    assert after["unknown"] == [1, "a"]


def metadata_of(path: Path) -> Any:
    """metadata.yaml as Python objects."""
    yaml = importlib.import_module("ruamel.yaml").YAML(typ="safe")
    return yaml.load((path / "metadata.yaml").read_text())["rosbag2_bagfile_information"]


@plain_kinds
def test_messages_are_views_of_the_file_that_outlive_the_bag(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows()
    with open_bag(write_by_rosbags(tmp_path, kind, rows)) as bag:
        messages = list(bag.messages())
    assert rows_of(messages) == rows
    if kind.format != "sqlite3":
        views = [message.data for message in messages if isinstance(message.data, memoryview)]
        assert len(views) == len(rows)
        assert all(view.readonly and type(view.obj).__name__ == "mmap" for view in views)


@all_kinds
def test_messages_can_be_read_repeatedly_and_by_topic(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows()
    with open_bag(write_by_rosbags(tmp_path, kind, rows)) as bag:
        for topics in (["/points"], ["/imu", "/absent"], [], ["/imu", "/points"]):
            assert rows_of(bag.messages(topics)) == [row for row in rows if row.topic in topics]
        first, second = bag.messages(), bag.messages()
        assert rows_of(first) == rows_of(second) == rows


@all_kinds
def test_a_closed_bag_is_an_error(tmp_path: Path, kind: Kind) -> None:
    bag = open_bag(write_by_rosbags(tmp_path, kind, some_rows(2)))
    bag.close()
    bag.close()
    with pytest.raises(ValueError, match="the bag is closed"):
        list(bag.messages())


@all_kinds
def test_a_bag_without_messages_is_copied(tmp_path: Path, kind: Kind) -> None:
    source = write_by_rosbags(tmp_path, kind, [])
    target = copied(source, kind.path(tmp_path, "out"))
    with open_bag(target) as bag:
        assert (bag.message_count, bag.start_time, bag.end_time, list(bag.messages())) == (0, None, None, [])
    assert read_by_rosbags(target) == []


@pytest.mark.parametrize("kind", [Kind("rosbag1"), Kind("rosbag1", "lz4"), Kind("mcap", "storage")], ids=str)
def test_chunks_of_a_copy_end_with_those_of_the_input(tmp_path: Path, kind: Kind) -> None:
    source = write_by_rosbags(tmp_path, kind, some_rows(40, size=100_000))
    target = copied(source, kind.path(tmp_path, "out"), added="/points/labelled")
    assert len(set(chunks_of(source))) > 3
    before = chunks_of(source)
    pairs = zip(chunks_of(target), topics_of(target), strict=True)
    after = [chunk for chunk, topic in pairs if "labelled" not in topic]
    assert len(set(zip(before, after, strict=True))) == len(set(before)) == len(set(after))


def chunks_of(path: Path) -> list[int]:
    with open_bag(path) as bag:
        return [message.chunk for message in bag.messages()]


def topics_of(path: Path) -> list[str]:
    with open_bag(path) as bag:
        return [message.topic.name for message in bag.messages()]


def bytes_of(size: int, seed: int) -> bytes:
    return random.Random(seed).randbytes(size // 2) + bytes(size - size // 2)


random_rows = st.lists(
    st.builds(
        Row,
        st.sampled_from(["/a", "/b/points", "/imu/data", "/ä"]),
        st.integers(0, 4 * 10**18),
        # 8192 is the size from which messages are not joined with their headers.
        st.builds(bytes_of, st.sampled_from([0, 1, 4, 30, 300, 8191, 8192, 9000]), st.integers(0, 999)),
    ),
    max_size=12,
)


@property_test
@given(kind=st.sampled_from(KINDS), rows=random_rows)
def test_a_copy_is_equal_for_any_messages(
    tmp_path_factory: pytest.TempPathFactory, kind: Kind, rows: list[Row]
) -> None:
    folder = tmp_path_factory.mktemp("bags")
    source = write_by_rosbags(folder, kind, rows)
    target = copied(source, kind.path(folder, "out"))
    assert read(target) == read(source) == (rows, [])
    assert sorted(read_by_rosbags(target)) == sorted(rows)
    with open_bag(source) as before, open_bag(target) as after:
        for name in ("name", "type", "encoding", "definition", "type_hash", "qos", "message_count", "metadata"):
            assert [getattr(topic, name) for topic in before.topics] == [getattr(topic, name) for topic in after.topics]
        assert (before.start_time, before.end_time) == (after.start_time, after.end_time)
    shutil.rmtree(folder)


# Formats


@pytest.mark.parametrize(("before", "after"), [("sqlite3", "mcap"), ("mcap", "sqlite3")])
@pytest.mark.parametrize("is_directory", [True, False])
def test_bags_of_ros2_are_converted(tmp_path: Path, before: Any, after: Any, is_directory: bool) -> None:
    rows = some_rows()
    source = write_by_rosbags(tmp_path, Kind(before), rows)
    extension = {"sqlite3": ".db3", "mcap": ".mcap"}[after]
    target = copied(source, tmp_path / ("out" if is_directory else f"out{extension}"), "/points/labelled", format=after)
    assert [row for row in read_by_rosbags(target) if "labelled" not in row.topic] == rows
    connections = connections_by_rosbags(target)
    for name, connection in connections_by_rosbags(source).items():
        assert (connections[name].msgdef, connections[name].ext) == (connection.msgdef, connection.ext)
    with open_bag(target) as bag:
        assert bag.format == after
        assert all(topic.type_hash.startswith("RIHS01_") for topic in bag.topics)


@pytest.mark.parametrize("kind", [Kind("sqlite3"), Kind("mcap"), Kind("mcap", "message")], ids=str)
def test_a_single_file_is_written_for_a_file_extension(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows()
    source = write_by_rosbags(tmp_path, kind, rows)
    for name in ("out.mcap", "out.db3"):
        target = copied(source, tmp_path / name)
        assert target.is_file()
        assert read_by_rosbags(target) == rows
        assert read(copied(target, tmp_path / f"directory-{name[4:]}")) == (rows, [])


@pytest.mark.parametrize("name", ["out.mcap.zstd", "out.db3.zstd"])
def test_a_single_file_can_be_compressed_as_a_whole(tmp_path: Path, name: str) -> None:
    rows = some_rows()
    target = copied(write_by_rosbags(tmp_path, Kind("mcap"), rows), tmp_path / name)
    assert target.read_bytes()[:4] == b"\x28\xb5\x2f\xfd"
    assert read(target) == (rows, [])
    with open_bag(target) as bag:
        assert (bag.compression, bag.compression_mode) == ("zstd", "file")


def test_ros1_and_ros2_are_not_converted(tmp_path: Path) -> None:
    ros1 = write_by_rosbags(tmp_path, Kind("rosbag1"), some_rows(1))
    ros2 = write_by_rosbags(tmp_path, Kind("mcap"), some_rows(1))
    before = files_in(tmp_path)
    for source, target in ((ros1, "out.mcap"), (ros1, "out.db3"), (ros2, "out.bag")):
        with open_bag(source) as bag, pytest.raises(ValueError, match=r"cannot be written as a bag of ROS [12] \(exp"):
            create_bag(tmp_path / target, like=bag)
    with open_bag(ros1) as bag, pytest.raises(ValueError, match=r"needs the extension \.bag"):
        create_bag(tmp_path / "out", like=bag)
    with open_bag(ros2) as bag, pytest.raises(ValueError, match="contradicts the format 'sqlite3'"):
        create_bag(tmp_path / "out.mcap", like=bag, format="sqlite3")
    assert files_in(tmp_path) == before


def test_a_split_bag_is_read_in_order_and_split_at_the_same_messages(tmp_path: Path) -> None:
    for kind in ROS2_KINDS:
        folder = tmp_path / str(kind)
        folder.mkdir()
        source, rows = split_bag(folder, kind)
        target = copied(source, folder / "out", added="/points/labelled")
        assert read(source) == (rows, [])
        assert [row for row in read_by_rosbags(target) if "labelled" not in row.topic] == rows
        files = metadata_of(target)["files"]
        assert [file["message_count"] for file in files] == [18, 18, 18]
        assert [file["path"] for file in files] == metadata_of(target)["relative_file_paths"]
        with open_bag(source) as before, open_bag(target) as after:
            kept = [message.file for message in after.messages() if "labelled" not in message.topic.name]
            assert kept == [message.file for message in before.messages()]


def split_bag(folder: Path, kind: Kind) -> tuple[Path, list[Row]]:
    """A bag of three files with 12 messages each."""
    rows = some_rows(18)
    yaml = importlib.import_module("ruamel.yaml").YAML(typ="safe")
    target = folder / "in"
    target.mkdir()
    merged: Any = None
    for i in range(3):
        part = write_by_rosbags(folder, kind, rows[12 * i : 12 * i + 12], name=f"part{i}")
        metadata = metadata_of(part)
        file = main_file(part)
        file.rename(target / file.name)
        merged = merged or metadata
        if i:
            merged["relative_file_paths"] += metadata["relative_file_paths"]
            merged["files"] += metadata["files"]
            for a, b in zip(merged["topics_with_message_count"], metadata["topics_with_message_count"], strict=True):
                a["message_count"] += b["message_count"]
            merged["message_count"] += metadata["message_count"]
    with (target / "metadata.yaml").open("w") as file:
        yaml.dump({"rosbag2_bagfile_information": merged}, file)
    return target, rows


def test_definitions_of_clouds_are_those_of_ros() -> None:
    for kind, definition in ((Kind("rosbag1"), POINT_CLOUD2_OF_ROS1), (Kind("mcap"), POINT_CLOUD2_OF_ROS2)):
        types = kind.types
        if kind.format == "rosbag1":
            text, digest = types.generate_msgdef(CLOUD)
        else:
            text, digest = types.generate_msgdef(CLOUD, ros_version=2)[0], types.hash_rihs01(CLOUD)
        assert definition.type_hash == digest
        typesys = importlib.import_module("rosbags.typesys")
        assert typesys.get_types_from_msg(definition.text, CLOUD) == typesys.get_types_from_msg(text, CLOUD)


@plain_kinds
def test_a_cloud_topic_can_be_added_to_a_bag_without_clouds(tmp_path: Path, kind: Kind) -> None:
    source = write_by_rosbags(tmp_path, kind, [Row("/imu", 1, b"12345678")])
    target = kind.path(tmp_path, "out")
    with open_bag(source) as bag, create_bag(target, like=bag) as writer:
        added = writer.add_topic("/points", CLOUD)
        writer.write(added, 2, b"cloud")
        with pytest.raises(ValueError, match="topic /imu exists already"):
            writer.add_topic("/imu", CLOUD)
        with pytest.raises(ValueError, match="definition of tf2_msgs/msg/TFMessage is unknown"):
            writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.finish()
    assert read_by_rosbags(target) == [Row("/points", 2, b"cloud")]
    assert connections_by_rosbags(target)["/points"].msgtype == CLOUD


@plain_kinds
def test_wrong_messages_are_errors(tmp_path: Path, kind: Kind) -> None:
    one = write_by_rosbags(tmp_path, kind, some_rows(1), name="one")
    other = write_by_rosbags(tmp_path, kind, some_rows(1), name="other")
    with open_bag(one) as bag, open_bag(other) as stranger, create_bag(kind.path(tmp_path, "out"), like=bag) as writer:
        with pytest.raises(ValueError, match="is not from"):
            writer.copy(next(stranger.messages()))
        with pytest.raises(ValueError, match="is not of this bag"):
            writer.write(stranger.topics[0], 1, b"")
        added = writer.add_topic("/new", CLOUD)
        with pytest.raises(ValueError, match="out of range"):
            writer.write(added, 2**64, b"")
        writer.write(added, 3, b"right")
        writer.finish()
        with pytest.raises(ValueError, match="is finished or discarded"):
            writer.copy(next(bag.messages()))
    assert read_by_rosbags(kind.path(tmp_path, "out")) == [Row("/new", 3, b"right")]


# MCAP files by another implementation


@pytest.fixture(scope="session")
def mcap() -> Any:
    """The MCAP package of PyPI."""
    pytest.importorskip("mcap", reason="mcap is not installed (pip install mcap)")
    return importlib.import_module("mcap.writer")


def write_by_mcap(mcap: Any, path: Path, compression: str = "NONE", **options: Any) -> Path:
    """A file with several encodings, two channels of a topic, a channel without schema, metadata and attachments."""
    with path.open("wb") as file:
        writer = mcap.Writer(file, 2000, mcap.CompressionType[compression], **options)
        writer.start("a profile", "a library")
        schema = writer.register_schema("pkg/Type", "jsonschema", b'{"type": "object"}')
        binary = writer.register_schema("pkg.Binary", "protobuf", bytes(range(256)))
        channels = [
            writer.register_channel("/json", "json", schema, {"key": "value", "": "ü"}),
            writer.register_channel("/json", "json", schema, {"key": "other"}),
            writer.register_channel("/binary", "protobuf", binary, {}),
            writer.register_channel("/raw", "", 0, {}),
            writer.register_channel("/without_messages", "json", schema, {}),
        ]
        writer.add_metadata("calibration", {"fx": "1.5", "": ""})
        for i in range(60):
            writer.add_message(channels[i % 4], 10**18 + i, bytes([i]) * (37 * i), 10**18 - i, 7 * i)
        writer.add_attachment(5, 6, "photo.png", "image/png", bytes(1000))
        writer.add_metadata("calibration", {"fx": "1.6"})
        writer.finish()
    return path


def everything_by_mcap(path: Path) -> Any:
    """All of an MCAP file that a copy keeps, read by the package of PyPI."""
    reader_module = importlib.import_module("mcap.reader")
    with path.open("rb") as file:
        reader = reader_module.make_reader(file, validate_crcs=True)
        header, summary = reader.get_header(), reader.get_summary()
        schemas = {schema.id: (schema.name, schema.encoding, schema.data) for schema in summary.schemas.values()}
        channels = {
            channel.id: (channel.topic, channel.message_encoding, channel.metadata, schemas.get(channel.schema_id))
            for channel in summary.channels.values()
        }
        messages = [
            (channel.id, channel.topic, message.sequence, message.log_time, message.publish_time, message.data)
            for _, channel, message in reader.iter_messages(log_time_order=False)
        ]
        attachments = [tuple(vars(attachment).values()) for attachment in reader.iter_attachments()]
        metadata = [(record.name, record.metadata) for record in reader.iter_metadata()]
        statistics = summary.statistics
        counts = (
            statistics.message_count,
            statistics.channel_count,
            statistics.attachment_count,
            statistics.metadata_count,
            statistics.message_start_time,
            statistics.message_end_time,
            {id: count for id, count in statistics.channel_message_counts.items() if count},
        )
        compressions = {index.compression for index in summary.chunk_indexes}
    return header, channels, messages, attachments, sorted(map(str, metadata)), counts, compressions


@pytest.mark.parametrize(
    ("compression", "options"),
    [
        ("NONE", {}),
        ("LZ4", {}),
        ("ZSTD", {}),
        ("NONE", {"use_chunking": False}),
        ("NONE", {"enable_crcs": False}),
        ("ZSTD", {"use_statistics": False}),
        ("LZ4", {"repeat_channels": False}),
        ("LZ4", {"index_types": 0}),
    ],
)
def test_a_copy_keeps_everything_in_an_mcap_file(
    tmp_path: Path, mcap: Any, compression: str, options: dict[str, Any]
) -> None:
    if "index_types" in options:
        options = {"index_types": mcap.IndexType.NONE}
    source = write_by_mcap(mcap, tmp_path / "in.mcap", compression, **options)
    full = write_by_mcap(mcap, tmp_path / "full.mcap", compression, use_chunking=options.get("use_chunking", True))
    target = copied(source, tmp_path / "out.mcap")
    assert everything_by_mcap(target) == everything_by_mcap(full)


@pytest.mark.parametrize("compression", ["NONE", "LZ4", "ZSTD"])
def test_a_chunk_check_sum_is_written_if_the_input_has_it(tmp_path: Path, mcap: Any, compression: str) -> None:
    for has_crcs in (True, False):
        source = write_by_mcap(mcap, tmp_path / f"in-{has_crcs}.mcap", compression, enable_crcs=has_crcs)
        target = copied(source, tmp_path / f"out-{has_crcs}.mcap")
        stream_reader = importlib.import_module("mcap.stream_reader")
        with target.open("rb") as file:
            records = stream_reader.StreamReader(file, emit_chunks=True).records
            crcs = [record.uncompressed_crc for record in records if type(record).__name__ == "Chunk"]
        assert crcs and all((crc != 0) == has_crcs for crc in crcs)


def test_other_encodings_are_not_converted(tmp_path: Path, mcap: Any) -> None:
    source = write_by_mcap(mcap, tmp_path / "in.mcap")
    with (
        open_bag(source) as bag,
        pytest.raises(ValueError, match="topic /json has the encoding 'json', which cannot be"),
    ):
        create_bag(tmp_path / "out.db3", like=bag)


def test_databases_of_older_versions_are_copied(tmp_path: Path) -> None:
    source = tmp_path / "in"
    source.mkdir()
    connection = sqlite3.connect(source / "in_0.db3")
    connection.executescript(
        """
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
          serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
          data BLOB NOT NULL);
        INSERT INTO topics VALUES(1, '/points', 'sensor_msgs/msg/PointCloud2', 'cdr', ''),
          (2, '/unknown', 'pkg/msg/Type', 'cdr', '');
        INSERT INTO messages VALUES(1, 1, 5, x'0102'), (2, 2, 6, x'03');
        """
    )
    connection.close()
    (source / "metadata.yaml").write_text(
        """
rosbag2_bagfile_information:
  version: 4
  storage_identifier: sqlite3
  relative_file_paths: [in_0.db3]
  duration: {nanoseconds: 1}
  starting_time: {nanoseconds_since_epoch: 5}
  message_count: 2
  topics_with_message_count:
    - topic_metadata: {name: /points, type: sensor_msgs/msg/PointCloud2, serialization_format: cdr,
        offered_qos_profiles: ""}
      message_count: 1
    - topic_metadata: {name: /unknown, type: pkg/msg/Type, serialization_format: cdr, offered_qos_profiles: ""}
      message_count: 1
  compression_format: ""
  compression_mode: ""
"""
    )
    rows = [Row("/points", 5, b"\1\2"), Row("/unknown", 6, b"\3")]
    for options in ({}, {"format": "mcap"}):
        target = copied(source, tmp_path / f"out{len(options)}", added="/points/labelled", **options)
        assert [row for row in read_by_rosbags(target) if "labelled" not in row.topic] == rows
        connections = connections_by_rosbags(target)
        assert connections["/points/labelled"].msgdef.data == POINT_CLOUD2_OF_ROS2.text
        assert connections["/unknown"].msgdef.data == ""
        assert metadata_of(target)["version"] == 4
        assert "files" not in metadata_of(target)


# Damage


def problems(path: Path) -> tuple[list[Row], list[str]]:
    """The messages and the reported problems; every line names the bag and is one line."""
    rows, lines = read(path)
    for line in lines:
        assert line.startswith(str(path)), line
        assert "\n" not in line
    return rows, [line.removeprefix(str(path)).removeprefix("/") for line in lines]


def test_other_files_are_errors(tmp_path: Path) -> None:
    (tmp_path / "empty.bag").touch()
    (tmp_path / "text.bag").write_text("this is not a bag of any kind")
    (tmp_path / "short.mcap").write_bytes(b"\x89MC")
    (tmp_path / "old.bag").write_bytes(b"#ROSBAG V1.2\n" + bytes(100))
    (tmp_path / "newer.mcap").write_bytes(b"\x89MCAP1\r\n" + bytes(100))
    sqlite3.connect(tmp_path / "other.db3").execute("CREATE TABLE t(a)").connection.close()
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe.bag")
    for name, problem in {
        "empty.bag": "is empty",
        "text.bag": "is not a bag",
        "short.mcap": "is not a bag",
        "old.bag": "version 1.2 is not supported (expected 2.0; run 'rosbag fix')",
        "newer.mcap": "is not an MCAP file of version 0",
        "other.db3": "table 'messages' is missing",
        "folder": "contains no .mcap or .db3 file",
        "pipe.bag": "is not a regular file",
    }.items():
        with pytest.raises(ValueError) as error:
            open_bag(tmp_path / name)
        assert str(error.value).startswith(f"{tmp_path / name}: {problem}"), error.value
    with pytest.raises(FileNotFoundError):
        open_bag(tmp_path / "absent.bag")


def test_an_encrypted_bag_is_an_error(tmp_path: Path) -> None:
    header = record1({b"op": b"\x03", b"index_pos": bytes(8), b"encryptor": b"rosbag/AesCbcEncryptor"}, bytes(50))
    (tmp_path / "a.bag").write_bytes(b"#ROSBAG V2.0\n" + header)
    with pytest.raises(ValueError, match="encrypted with 'rosbag/AesCbcEncryptor'"):
        open_bag(tmp_path / "a.bag")


def record1(fields: dict[bytes, bytes], data: bytes) -> bytes:
    """A record of ROS 1."""
    header = b"".join(struct.pack("<I", len(k) + 1 + len(v)) + k + b"=" + v for k, v in fields.items())
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def bag_of_chunks(folder: Path, kind: Kind) -> tuple[Path, list[Row], list[int]]:
    """A bag with about six chunks. Returns their positions too."""
    rows = some_rows(8, size=600_000 if kind.format == "rosbag1" else 500_000)
    path = write_by_rosbags(folder, kind, rows)
    return path, rows, sorted(set(chunks_of(path)))


chunked_kinds = [Kind("rosbag1"), Kind("rosbag1", "lz4"), Kind("rosbag1", "bz2"), Kind("mcap", "storage")]


@pytest.mark.parametrize("kind", chunked_kinds, ids=str)
def test_a_damaged_chunk_is_reported_and_the_others_are_read(tmp_path: Path, kind: Kind) -> None:
    path, rows, chunks = bag_of_chunks(tmp_path, kind)
    with open_bag(path) as bag:
        kept = rows_of(message for message in bag.messages() if message.chunk != chunks[2])
    assert 0 < len(kept) < len(rows)
    # The beginning of the compressed data, or of the header: without check sums, other damage cannot be found.
    magic = {"lz4": b"\x04\x22\x4d\x18", "bz2": b"BZh", "storage": b"\x28\xb5\x2f\xfd", "": b"op=\x05"}[kind.mode]
    file = main_file(path)
    changed(file, file.read_bytes().index(magic, chunks[2]), bytes(len(magic)))
    result, lines = problems(path)
    assert result == kept
    assert len(lines) == 1 + (kind.mode == ""), lines
    assert f"byte {chunks[2]}: " in lines[-1]
    assert "skipped" in lines[-1]


def test_a_damaged_chunk_of_mcap_is_found_by_its_check_sum(tmp_path: Path, mcap: Any) -> None:
    path = write_by_mcap(mcap, tmp_path / "in.mcap")
    chunks = sorted(set(chunks_of(path)))
    with open_bag(path) as bag:
        kept = rows_of(message for message in bag.messages() if message.chunk != chunks[3])
    changed(path, chunks[4] - 400, b"damage")
    assert problems(path) == (
        kept,
        [f": byte {chunks[3]}: chunk: the check sum is wrong (the messages in it are skipped)"],
    )
    target = copied(path, tmp_path / "out.mcap")
    assert read(target) == (kept, [])


def test_damage_is_reported_once(tmp_path: Path, mcap: Any) -> None:
    path = write_by_mcap(mcap, tmp_path / "in.mcap")
    changed(path, sorted(set(chunks_of(path)))[3] + 200, b"damage")
    lines: list[str] = []
    with open_bag(path, report=lines.append) as bag:
        assert rows_of(bag.messages()) == rows_of(bag.messages())
    assert len(lines) == 1


def test_many_problems_are_one_line_at_the_end(tmp_path: Path, mcap: Any) -> None:
    path = tmp_path / "in.mcap"
    with path.open("wb") as file:
        writer = mcap.Writer(file, 1, mcap.CompressionType.NONE)
        writer.start("", "")
        channel = writer.register_channel("/a", "json", 0, {})
        for i in range(300):
            writer.add_message(channel, i, b"content", i)
        writer.finish()
    chunks = chunks_of(path)
    for chunk in chunks:
        changed(path, chunk + 9 + 16 + 8, b"1234")  # the check sum
    rows, lines = problems(path)
    assert rows == []
    assert len(lines) == MAX_LINES + 1
    assert "more than 100 problems" in lines[-1]


@pytest.mark.parametrize("kind", chunked_kinds, ids=str)
def test_a_bag_that_was_not_closed_is_read(tmp_path: Path, kind: Kind) -> None:
    path, rows, _ = bag_of_chunks(tmp_path, kind)
    file = main_file(path)
    if kind.format == "rosbag1":
        changed(file, file.read_bytes().index(b"index_pos=") + 10, bytes(8))
        with file.open("r+b") as opened:  # rosbag writes the index of the chunks at the end
            opened.truncate(file.read_bytes().rindex(b"op=\x04"))
    else:
        with file.open("r+b") as opened:
            opened.truncate(file.stat().st_size - 3000)
        (path / "metadata.yaml").unlink()
    result, lines = problems(path)
    assert result == rows
    assert any("not closed" in line for line in lines)
    with open_bag(path) as bag:
        assert bag.message_count == len(rows)
        assert (bag.start_time, bag.end_time) == (rows[0].time, rows[-1].time)
        assert sorted(topic.name for topic in bag.topics) == ["/imu", "/points"]
    assert read(copied(path, kind.path(tmp_path, "out"))) == (rows, [])


@pytest.mark.parametrize("kind", chunked_kinds, ids=str)
def test_a_bag_truncated_in_a_chunk_is_read_up_to_there(tmp_path: Path, kind: Kind) -> None:
    path, rows, chunks = bag_of_chunks(tmp_path, kind)
    before = [chunk for chunk in chunks_of(path) if chunk < chunks[-2]]
    with main_file(path).open("r+b") as file:
        file.truncate(chunks[-2] + (chunks[-1] - chunks[-2]) // 2)
    result, lines = problems(path)
    assert len(before) <= len(result) < len(rows)
    assert result == rows[: len(result)]
    assert any("truncated" in line for line in lines)


@plain_kinds
def test_a_bag_truncated_anywhere_is_read_up_to_there_or_is_an_error(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows(3, size=60)
    path = write_by_rosbags(tmp_path, kind, rows)
    file = main_file(path)
    content = file.read_bytes()
    counts = []
    for size in range(0, len(content), 997 if kind.format == "sqlite3" else 23):
        file.write_bytes(content[:size])
        try:
            result, lines = read(path)
        except ValueError as error:
            assert "\n" not in str(error)
            counts.append(0)
            continue
        assert lines
        if kind.format == "sqlite3":  # SQLite reads the missing part of the last page as zeros
            assert len([row for row in result if row not in rows]) <= 1
            continue
        assert result == rows[: len(result)]
        counts.append(len(result))
    if kind.format != "sqlite3":
        assert counts == sorted(counts)
        assert counts[-1] == len(rows)


@property_test
@given(
    data=st.data(),
    kind=st.sampled_from(
        [
            Kind("rosbag1"),
            Kind("rosbag1", "lz4"),
            Kind("sqlite3"),
            Kind("mcap"),
            Kind("mcap", "storage"),
            Kind("mcap", "file"),
        ]
    ),
)
def test_damaged_bytes_never_raise_other_errors(
    tmp_path_factory: pytest.TempPathFactory, damage_base: dict[str, tuple[Path, list[Row]]], data: Any, kind: Kind
) -> None:
    base, rows = damage_base[str(kind)]
    folder = tmp_path_factory.mktemp("damaged")
    path = kind.path(folder, "in")
    shutil.copytree(base, path) if base.is_dir() else shutil.copy(base, path)
    file = main_file(path)
    content = bytearray(file.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        position = data.draw(st.integers(0, len(content) - 1))
        content[position : position + 4] = data.draw(
            st.binary(min_size=1, max_size=4) | st.sampled_from([b"\xff" * 4, bytes(4)])
        )
    file.write_bytes(content)
    lines: list[str] = []
    try:
        with open_bag(path, report=lines.append) as bag:
            found = rows_of(bag.messages())
            copied(bag, kind.path(folder, "out"))
    except (ValueError, OSError) as error:
        assert "\n" not in str(error)
    else:
        assert len(found) <= 2 * len(rows)
    assert all("\n" not in line for line in lines)
    shutil.rmtree(folder)


@pytest.fixture(scope="session")
def damage_base(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Path, list[Row]]]:
    """A small bag of each kind."""
    rows = some_rows(6, size=200)
    folders = {str(kind): tmp_path_factory.mktemp(str(kind)) for kind in KINDS}
    return {str(kind): (write_by_rosbags(folders[str(kind)], kind, rows), rows) for kind in KINDS}


def test_unknown_records_of_mcap_are_skipped(tmp_path: Path, mcap: Any) -> None:
    path = write_by_mcap(mcap, tmp_path / "in.mcap", use_chunking=False)
    rows = read(path)[0]
    content = path.read_bytes()
    header = struct.unpack_from("<Q", content, 9)[0]
    begin = 8 + 9 + header
    private = struct.pack("<BQ", 0x91, 12) + bytes(12)
    # Without a summary, whose positions would be wrong.
    end = content.index(struct.pack("<BQ", 0x0F, 4))
    path.write_bytes(content[:begin] + private + content[begin:end])
    result, lines = problems(path)
    assert result == rows
    assert ": records of the unknown kind 0x91 are skipped" in lines


def test_sizes_in_headers_do_not_allocate_memory(tmp_path: Path, mcap: Any) -> None:
    zstd = importlib.import_module("flagstone.bags.compression").zstd()
    bomb = zstd.compress(bytes(600 << 20))
    files = {}
    for size in (len(bomb), 2**31 - 1, 2**62):
        chunk = struct.pack("<QQQII", 0, 1, size, 0, 4) + b"zstd" + struct.pack("<Q", len(bomb)) + bomb
        header = struct.pack("<BQ", 1, 8) + bytes(8)
        files[f"{size}.mcap"] = b"\x89MCAP0\r\n" + header + struct.pack("<BQ", 6, len(chunk)) + chunk
    chunk = record1({b"op": b"\x05", b"compression": b"bz2", b"size": b"\xff" * 4}, b"BZh9" + bytes(100))
    files["a.bag"] = b"#ROSBAG V2.0\n" + record1({b"op": b"\x03", b"index_pos": bytes(8)}, bytes(9)) + chunk
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
        tracemalloc.start()
        with pytest.raises(ValueError, match="no part that can be read"):
            open_bag(tmp_path / name)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 200 << 20, name


def test_a_database_whose_recorder_was_killed_is_read_without_changing_it(tmp_path: Path) -> None:
    rows = some_rows()
    path = write_by_rosbags(tmp_path, Kind("sqlite3"), rows[:6])
    file = main_file(path)
    recorder = sqlite3.connect(file)
    recorder.execute("PRAGMA journal_mode = WAL")
    for row in rows[6:]:
        topic = recorder.execute("SELECT id FROM topics WHERE name = ?", (row.topic,)).fetchone()[0]
        recorder.execute("INSERT INTO messages VALUES(NULL, ?, ?, ?)", (topic, row.time, row.data))
    recorder.commit()
    killed = tmp_path / "killed"
    killed.mkdir()
    for name in (file.name, f"{file.name}-wal"):
        shutil.copy(file.with_name(name), killed)
    recorder.close()
    before = files_in(killed)
    result, lines = problems(killed)
    assert result == rows
    assert any("was not closed" in line for line in lines)
    assert files_in(killed) == before


def test_a_database_with_an_interrupted_transaction_is_read(tmp_path: Path) -> None:
    rows = some_rows()
    path = write_by_rosbags(tmp_path, Kind("sqlite3"), rows)
    file = main_file(path)
    Path(f"{file}-journal").write_bytes(b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + bytes(600))
    before = files_in(path)
    result, lines = problems(path)
    assert result == rows
    assert len(lines) == 1 and "was not closed" in lines[0]
    assert files_in(path) == before


def test_damaged_pages_of_a_database_lose_only_their_messages(tmp_path: Path) -> None:
    rows = some_rows(60, size=20_000)
    path = write_by_rosbags(tmp_path, Kind("sqlite3"), rows)
    file = main_file(path)
    connection = sqlite3.connect(file)
    size = connection.execute("PRAGMA page_size").fetchone()[0]
    connection.close()
    content = file.read_bytes()
    # A page that contains the middle of a cloud: the number of the next page is in front of it.
    page = content.index(rows[41].data[9000:9100]) // size
    changed(file, page * size, b"\xff\xff\xff\xff")
    result, lines = problems(path)
    assert 0 < len(rows) - len(result) < 20
    assert [row for row in rows if row in result] == result
    assert rows[41] not in result
    assert any("are skipped" in line for line in lines)


def test_a_database_whose_pages_form_a_circle_is_read_without_them(tmp_path: Path) -> None:
    rows = [Row("/imu", 10**18 + i, bytes(60)) for i in range(3000)]
    path = write_by_rosbags(tmp_path, Kind("sqlite3"), rows)
    file = main_file(path)
    connection = sqlite3.connect(file)
    size = connection.execute("PRAGMA page_size").fetchone()[0]
    root = connection.execute("SELECT rootpage FROM sqlite_master WHERE name = 'messages'").fetchone()[0]
    connection.close()
    begin = (root - 1) * size
    page = file.read_bytes()[begin : begin + size]
    assert page[0] == 5  # an inner page: its cells are the numbers of other pages
    (cells,) = struct.unpack_from(">H", page, 3)
    positions = struct.unpack_from(f">{cells}H", page, 12)
    for position in positions[10:]:
        changed(file, begin + position, struct.pack(">I", root))
    result, lines = problems(path)
    assert 0 < len(result) < len(rows)
    assert result == sorted(set(result) & set(rows))
    assert lines
    with open_bag(path) as bag:
        assert list(bag.messages(["/points"])) == []


def test_metadata_yaml_can_be_missing_or_damaged(tmp_path: Path) -> None:
    for kind in ROS2_KINDS:
        if kind.mode == "message":  # without metadata.yaml, it is unknown that messages are compressed
            continue
        source, rows = split_bag_in(tmp_path / str(kind), kind)
        for content in (None, "", "a: [", "rosbag2_bagfile_information: 7", "rosbag2_bagfile_information: {}", "\0"):
            file = source / "metadata.yaml"
            file.unlink() if content is None else file.write_text(content)
            result, lines = problems(source)
            assert result == rows
            assert len(lines) == 1 and lines[0].startswith("metadata.yaml: ")
            if content is None:
                file.touch()


def split_bag_in(folder: Path, kind: Kind) -> tuple[Path, list[Row]]:
    folder.mkdir()
    return split_bag(folder, kind)


def test_a_missing_or_damaged_file_of_a_split_bag_costs_its_messages(tmp_path: Path) -> None:
    for kind in (Kind("sqlite3"), Kind("mcap"), Kind("mcap", "file")):
        source, rows = split_bag_in(tmp_path / str(kind), kind)
        names = sorted(file.name for file in source.iterdir() if file.name != "metadata.yaml")
        (source / names[0]).unlink()
        result, lines = problems(source)
        assert result == rows[12:]
        assert lines == [f"{names[0]}: No such file or directory (the file is skipped)"]
        (source / names[0]).write_bytes(b"garbage")
        result, lines = problems(source)
        assert result == rows[12:]
        assert len(lines) == 1 and lines[0].startswith(f"{names[0]}: is not a bag")
        assert read(copied(source, tmp_path / f"out-{kind}")) == (result, [])


@pytest.mark.parametrize("format", ["mcap", "sqlite3"])
def test_a_compressed_file_that_is_truncated_is_read_up_to_there(tmp_path: Path, format: str) -> None:
    rows = some_rows(300, size=4000)
    path = write_by_rosbags(tmp_path, Kind(format, "file"), rows)
    with main_file(path).open("r+b") as file:
        file.truncate(main_file(path).stat().st_size * 3 // 4)
    result, lines = problems(path)
    assert 0 < len(result) < len(rows)
    assert result == rows[: len(result)]
    assert any("truncated" in line for line in lines)


def test_a_damaged_compressed_message_is_skipped(tmp_path: Path) -> None:
    for format in ("mcap", "sqlite3"):
        rows = some_rows(40)
        path = write_by_rosbags(tmp_path, Kind(format, "message"), rows, name=format)
        file = main_file(path)
        changed(file, file.read_bytes().index(b"\x28\xb5\x2f\xfd", 4000), b"\0")
        result, lines = problems(path)
        assert len(result) == len(rows) - 1
        assert len(lines) == 1 and "cannot be decompressed" in lines[0]


@pytest.mark.parametrize("kind", [Kind("rosbag1"), Kind("mcap")], ids=str)
def test_a_file_that_is_truncated_while_it_is_read_is_an_error(tmp_path: Path, kind: Kind) -> None:
    path = write_by_rosbags(tmp_path, kind, some_rows(40, size=200_000))
    with open_bag(path) as bag:
        messages = bag.messages()
        next(messages)
        with main_file(path).open("r+b") as file:
            file.truncate(main_file(path).stat().st_size // 2)
        with pytest.raises(OSError, match="was truncated while it was read"):
            list(messages)


def test_lines_contain_no_line_breaks_of_the_file_name(tmp_path: Path) -> None:
    path = tmp_path / "a\nb.bag"
    path.write_bytes(b"#ROSBAG V2.0\n")
    lines: list[str] = []
    with pytest.raises(ValueError) as error:
        open_bag(path, report=lines.append)
    assert all("\n" not in line for line in (*lines, str(error.value)))


# Output


def test_the_output_is_never_the_input(tmp_path: Path) -> None:
    for kind in KINDS:
        folder = tmp_path / str(kind)
        folder.mkdir()
        source = write_by_rosbags(folder, kind, some_rows(2))
        name = source.name
        (folder / f"link-{name}").symlink_to(source)
        outputs = [source, folder / f"link-{name}", folder / "." / name, folder]
        if source.is_dir():
            outputs += [source / "inside", main_file(source), source / "inside.mcap", source / "metadata.yaml"]
        else:
            (folder / f"hard-{name}").hardlink_to(source)
            outputs.append(folder / f"hard-{name}")
        before = files_in(folder)
        with open_bag(source) as bag:
            for output in outputs:
                with pytest.raises((ValueError, OSError)):
                    create_bag(output, like=bag)
        with open_bag(folder / f"link-{name}") as bag, pytest.raises((ValueError, OSError)):
            create_bag(source, like=bag)
        assert files_in(folder) == before


def test_an_existing_file_is_replaced_and_a_directory_is_not(tmp_path: Path) -> None:
    rows = some_rows(3)
    source = write_by_rosbags(tmp_path, Kind("mcap"), rows)
    (tmp_path / "out.mcap").write_bytes(b"before")
    assert read(copied(source, tmp_path / "out.mcap")) == (rows, [])
    (tmp_path / "empty").mkdir()
    assert read(copied(source, tmp_path / "empty")) == (rows, [])
    with pytest.raises(FileExistsError, match="exists and is not empty"):
        copied(source, tmp_path / "empty")
    (tmp_path / "file").touch()
    with pytest.raises(NotADirectoryError, match=r"add the extension \.mcap or \.db3"):
        copied(source, tmp_path / "file")


@all_kinds
def test_an_output_that_is_not_finished_leaves_nothing(tmp_path: Path, kind: Kind) -> None:
    source = write_by_rosbags(tmp_path, kind, some_rows())
    target = kind.path(tmp_path, "out")
    if kind.format == "rosbag1":
        target.write_bytes(b"before")
    before = files_in(tmp_path)
    with open_bag(source) as bag:
        with pytest.raises(KeyboardInterrupt), create_bag(target, like=bag) as writer:
            writer.copy(next(bag.messages()))
            raise KeyboardInterrupt
        assert files_in(tmp_path) == before
        with create_bag(target, like=bag) as writer:
            writer.copy(next(bag.messages()))
        assert files_in(tmp_path) == before
        assert [entry.name for entry in tmp_path.iterdir() if entry.name.endswith(".part")] == []


@pytest.mark.parametrize("kind", [*KINDS, Kind("bare")], ids=str)
def test_a_full_disk_is_an_error_and_leaves_nothing(tmp_path: Path, kind: Kind) -> None:
    resource = importlib.import_module("resource")
    is_bare = kind.format == "bare"
    source = write_by_rosbags(tmp_path, Kind("mcap") if is_bare else kind, some_rows(60, size=200_000))
    target = tmp_path / "out.db3" if is_bare else kind.path(tmp_path, "out")
    before = files_in(tmp_path)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (3_000_000, limits[1]))
    try:
        with pytest.raises(OSError):
            copied(source, target)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert files_in(tmp_path) == before
    assert not [entry for entry in tmp_path.iterdir() if entry.name.endswith(".part")]


KILLED = """
import os, signal, sys
from pathlib import Path
from flagstone.bags import create_bag, open_bag

bag = open_bag(sys.argv[1])
writer = create_bag(sys.argv[2], like=bag)
for message in bag.messages():
    writer.copy(message)
print("written", flush=True)
signal.pause()
"""


@plain_kinds
def test_a_later_run_deletes_what_a_killed_process_left(tmp_path: Path, kind: Kind) -> None:
    rows = some_rows()
    source = write_by_rosbags(tmp_path, kind, rows)
    target = kind.path(tmp_path, "out")
    process = subprocess.Popen([sys.executable, "-c", KILLED, source, target], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "written\n"
    (left,) = (entry for entry in tmp_path.iterdir() if entry.name.endswith(".part"))
    assert left.name.startswith(f".{target.name}.")
    # Another run of the same output, while the first one is running, leaves its files alone.
    assert read(copied(source, target)) == (rows, [])
    assert left.exists()
    process.send_signal(signal.SIGKILL)
    process.wait()
    shutil.rmtree(target) if target.is_dir() else target.unlink()
    assert left.exists()
    assert read(copied(source, target)) == (rows, [])
    assert not left.exists()
