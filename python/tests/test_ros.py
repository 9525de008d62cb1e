# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.ros` reads and writes serialized point clouds, the same as an independent implementation (rosbags)."""

from __future__ import annotations

import importlib
import threading
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from conftest import Scan

import flagstone
from flagstone import ros

NUMBERS = ("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8", "i8", "u8")
ENCODINGS: tuple[ros.Encoding, ...] = ("cdr", "ros1")


@pytest.fixture(scope="module")
def rosbags() -> Any:
    """The type store of rosbags with the messages of Livox, an independent implementation in Python."""
    pytest.importorskip("rosbags", reason="rosbags is not installed (pip install rosbags)")
    typesys = importlib.import_module("rosbags.typesys")
    store = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
    point = "uint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 reflectivity\nuint8 tag\nuint8 line\n"
    message = (
        "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\n"
        "livox_ros_driver2/CustomPoint[] points\n"
    )
    types = typesys.get_types_from_msg(point, "livox_ros_driver2/msg/CustomPoint")
    types |= typesys.get_types_from_msg(message, "livox_ros_driver2/msg/CustomMsg")
    store.register(types)
    return Rosbags(store, typesys.get_typestore(typesys.Stores.ROS1_NOETIC), types)


class Rosbags:
    """Messages by name and their bytes in either encoding."""

    def __init__(self, ros2: Any, ros1: Any, types: Any) -> None:
        ros1.register(types)
        self._stores = {"cdr": ros2, "ros1": ros1}

    def types(self, encoding: str) -> Any:
        return self._stores[encoding].types

    def header(self, encoding: str) -> Any:
        types = self.types(encoding)
        stamp = types["builtin_interfaces/msg/Time"](sec=12, nanosec=345)
        seq = {"seq": 7} if encoding == "ros1" else {}
        return types["std_msgs/msg/Header"](stamp=stamp, frame_id="lidar", **seq)

    def cloud(self, encoding: str, rows: npt.NDArray[np.void], **changes: Any) -> Any:
        """A PointCloud2 of a structured array of shape (N,) or (H, W)."""
        types = self.types(encoding)
        codes = {np.dtype(kind): i + 1 for i, kind in enumerate(("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8"))}
        codes |= {np.dtype("i8"): 9, np.dtype("u8"): 10, np.dtype("?"): 11}
        fields = []
        for name in rows.dtype.names or ():
            kind, offset = rows.dtype.fields[name][:2]  # type: ignore[index]
            code = codes[kind.base.newbyteorder("=")]
            count = int(np.prod(kind.shape, dtype=int))
            field = types["sensor_msgs/msg/PointField"]
            fields.append(field(name=name, offset=offset, datatype=code, count=count))
        height, width = rows.shape if rows.ndim == 2 else (1, rows.shape[0])
        step = rows.dtype.itemsize
        members = {
            "header": self.header(encoding),
            "height": height,
            "width": width,
            "fields": fields,
            "is_bigendian": False,
            "point_step": step,
            "row_step": width * step,
            "data": np.ascontiguousarray(rows).reshape(-1).view(np.uint8),
            "is_dense": True,
        }
        return types["sensor_msgs/msg/PointCloud2"](**(members | changes))

    def serialize(self, encoding: str, message: Any, little_endian: bool = True) -> bytes:
        store = self._stores[encoding]
        if encoding == "ros1":
            return bytes(store.serialize_ros1(message, message.__msgtype__))
        return bytes(store.serialize_cdr(message, message.__msgtype__, little_endian=little_endian))

    def deserialize(self, encoding: str, message: bytes, name: str = ros.POINT_CLOUD2) -> Any:
        store = self._stores[encoding]
        return (store.deserialize_ros1 if encoding == "ros1" else store.deserialize_cdr)(message, name)


def varied_rows(shape: tuple[int, ...] = (50,), order: str = "<") -> npt.NDArray[np.void]:
    """Records with a field of every type, a field of three numbers and padding."""
    names = ["x", "y", "z", *(f"f_{kind}" for kind in NUMBERS), "normal"]
    kinds = ["f4", "f4", "f4", *NUMBERS, "(3,)f4"]
    formats = [np.dtype(kind).newbyteorder(order) for kind in kinds]
    offsets = np.cumsum([0, *(kind.itemsize for kind in formats)])[:-1] + 3  # unaligned
    size = int(offsets[-1]) + formats[-1].itemsize + 5
    dtype = np.dtype({"names": names, "formats": formats, "offsets": offsets.tolist(), "itemsize": size})
    random = np.random.default_rng(3)
    count = int(np.prod(shape))
    rows: npt.NDArray[np.void] = random.integers(0, 256, (count, size), np.uint8).view(dtype).reshape(-1)
    for name in "xyz":
        rows[name] = random.uniform(-50, 50, count)
    return rows.reshape(shape)


def same(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
    return np.ascontiguousarray(a).tobytes() == np.ascontiguousarray(b).tobytes()


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("shape", [(50,), (5, 10), (0,)])
def test_a_message_survives_a_round_trip(encoding: ros.Encoding, shape: tuple[int, ...]) -> None:
    rows = varied_rows(shape)
    message = ros.serialize(rows, frame_id="lidar", stamp=(12, 345), seq=7, is_dense=True, encoding=encoding)

    cloud = ros.parse(message, encoding=encoding)

    assert cloud.header == (7 if encoding == "ros1" else 0, 12, 345, "lidar")
    assert (cloud.height, cloud.width) == (shape if len(shape) == 2 else (1, shape[0]))
    assert cloud.is_dense and not cloud.is_bigendian and cloud.encoding == encoding
    assert [field.name for field in cloud.fields] == list(rows.dtype.names or ())
    assert cloud.points.shape == shape
    for name in rows.dtype.names or ():
        assert same(cloud.points[name], rows[name]), name


def test_points_are_zero_copy() -> None:
    message = ros.serialize(varied_rows())
    cloud = ros.parse(message)
    start = np.frombuffer(message, np.uint8).ctypes.data
    for array in (cloud.points, cloud.xyz):
        assert start <= array.ctypes.data < start + len(message)
        assert not array.flags.writeable
    assert flagstone._core.address_of(*cloud.xyz.T) == cloud.xyz.ctypes.data


@pytest.mark.parametrize("kind", NUMBERS)
@pytest.mark.parametrize("is_organized", [False, True])
def test_coordinates_of_every_type_are_converted(kind: str, is_organized: bool) -> None:
    rows = np.zeros((4, 5) if is_organized else 20, [("z", kind), ("x", kind), ("y", kind)])
    for i, name in enumerate("xyz"):
        rows[name] = np.arange(i, 20 + i).reshape(rows.shape)
    cloud = ros.parse(ros.serialize(rows))
    assert np.array_equal(cloud.xyz, np.stack([rows[name].reshape(-1) for name in "xyz"], 1))
    assert np.array_equal(np.asarray(cloud), cloud.xyz)
    assert np.asarray(cloud, np.float64).dtype == np.float64


def test_a_segmenter_accepts_a_cloud(scan: Scan) -> None:
    segmenter = flagstone.Surface()
    expected = segmenter.segment(scan)
    for encoding in ENCODINGS:
        cloud = ros.parse(ros.serialize(scan, encoding=encoding), encoding=encoding)
        result = segmenter.segment(cloud)
        assert np.array_equal(result.labels, expected.labels)
        labelled = ros.parse(cloud.append({"label": result.labels, "height": result.heights}), encoding=encoding).points
        assert labelled.dtype.names == ("x", "y", "z", "intensity", "label", "height")
        assert same(labelled["label"], result.labels)
        assert same(labelled["height"], result.heights)
        ground = ros.parse(cloud.select(result.ground), encoding=encoding)
        assert same(ground.points, cloud.points[result.ground])
        others = ros.parse(cloud.select(~result.ground, {"height": result.heights}), encoding=encoding)
        assert same(others.points["height"], result.heights[~result.ground])
        assert len(ground) + len(others) == len(scan)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("shape", [(50,), (5, 10), (0,)])
def test_messages_of_rosbags_are_parsed(rosbags: Rosbags, encoding: ros.Encoding, shape: tuple[int, ...]) -> None:
    rows = varied_rows(shape)
    for little_endian in (True, False) if encoding == "cdr" else (True,):
        message = rosbags.serialize(encoding, rosbags.cloud(encoding, rows), little_endian)
        cloud = ros.parse(message, encoding=encoding)
        assert cloud.header[1:] == (12, 345, "lidar")
        assert cloud.points.shape == shape
        assert all(same(cloud.points[name], rows[name]) for name in rows.dtype.names or ())
        assert same(cloud.xyz, np.stack([rows[name].reshape(-1) for name in "xyz"], 1))


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_serialized_messages_are_equal_to_those_by_rosbags(rosbags: Rosbags, encoding: ros.Encoding) -> None:
    rows = varied_rows()
    message = ros.serialize(rows, frame_id="lidar", stamp=(12, 345), seq=7, is_dense=True, encoding=encoding)
    assert message == rosbags.serialize(encoding, rosbags.cloud(encoding, rows))


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("shape", [(50,), (5, 10), (0,)])
def test_rosbags_reads_appended_and_selected_clouds(
    rosbags: Rosbags, encoding: ros.Encoding, shape: tuple[int, ...]
) -> None:
    rows = varied_rows(shape)
    labels = np.arange(rows.size, dtype=np.uint8) % 5
    heights = np.linspace(-1, 2, rows.size, dtype=np.float32)
    for little_endian in (True, False) if encoding == "cdr" else (True,):
        source = rosbags.serialize(encoding, rosbags.cloud(encoding, rows), little_endian)
        cloud = ros.parse(source, encoding=encoding)

        appended = cloud.append({"label": labels, "height": heights})
        selected = cloud.select(labels == 1)

        read = rosbags.deserialize(encoding, appended)
        assert appended == rosbags.serialize(encoding, read, little_endian)
        assert (read.header.frame_id, read.header.stamp.sec, read.header.stamp.nanosec) == ("lidar", 12, 345)
        assert (read.height, read.width) == (cloud.height, cloud.width)
        assert [(field.name, field.datatype) for field in read.fields[-2:]] == [("label", 2), ("height", 7)]
        table = read.data.reshape(rows.size, read.point_step)
        assert same(table[:, : rows.dtype.itemsize], rows.reshape(-1).view(np.uint8))
        for field, values in zip(read.fields[-2:], (labels, heights), strict=True):
            columns = table[:, field.offset : field.offset + values.itemsize]
            assert same(columns, values)
        read = rosbags.deserialize(encoding, selected)
        assert selected == rosbags.serialize(encoding, read, little_endian)
        assert (read.height, read.width) == (1, np.count_nonzero(labels == 1))
        assert same(read.data, table[labels == 1, : rows.dtype.itemsize])


def test_big_endian_points_and_padded_rows_of_rosbags_are_read(rosbags: Rosbags) -> None:
    rows = varied_rows((5, 10), ">")
    step = rows.dtype.itemsize
    padded = np.zeros((5, 10 * step + 7), np.uint8)
    padded[:, : 10 * step] = rows.view(np.uint8).reshape(5, -1)
    members = {"is_bigendian": True, "row_step": 10 * step + 7, "data": padded.reshape(-1)}
    cloud = ros.parse(rosbags.serialize("cdr", rosbags.cloud("cdr", rows, **members)))
    heights = np.arange(50, dtype=np.float32)

    result = ros.parse(cloud.append({"height": heights.reshape(5, 10)}))

    assert cloud.is_bigendian and result.is_bigendian
    assert cloud.points.shape == result.points.shape == (5, 10)
    for name in rows.dtype.names or ():
        assert same(cloud.points[name], rows[name]) and same(result.points[name], rows[name])
    assert np.array_equal(result.points["height"].reshape(-1), heights)
    assert np.allclose(cloud.xyz[:, 0], rows["x"].reshape(-1))


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_messages_of_livox_become_clouds(rosbags: Rosbags, encoding: ros.Encoding) -> None:
    types = rosbags.types(encoding)
    points = [
        types["livox_ros_driver2/msg/CustomPoint"](
            offset_time=1000 * i, x=i + 0.5, y=-1.0, z=2.0, reflectivity=i, tag=16, line=i % 4
        )
        for i in range(7)
    ]
    message = types["livox_ros_driver2/msg/CustomMsg"](
        header=rosbags.header(encoding),
        timebase=12_000_000_345,
        point_num=7,
        lidar_id=192,
        rsvd=np.zeros(3, np.uint8),
        points=points,
    )
    for little_endian in (True, False) if encoding == "cdr" else (True,):
        data = rosbags.serialize(encoding, message, little_endian)
        clouds = [ros.parse(data, encoding=encoding, message_type=name) for name in ros.POINT_CLOUD_TYPES[1:]]
        assert len(clouds) == 3
        cloud = ros.parse(data, encoding=encoding, message_type="livox_ros_driver2/CustomMsg")
        assert all(same(cloud.points, other.points) for other in clouds)
        assert (cloud.timebase, cloud.lidar_id, len(cloud)) == (12_000_000_345, 192, 7)
        assert np.array_equal(cloud.xyz[:, 0], np.arange(7) + 0.5)
        assert np.array_equal(cloud.points["offset_time"], 1000 * np.arange(7))
        assert cloud.convention[:4] == ("livox", "offset_time", 1e-9, "header_stamp")
        read = rosbags.deserialize(encoding, cloud.append({"label": np.ones(7, np.uint8)}))
        assert [field.name for field in read.fields][-3:] == ["tag", "line", "label"]
        assert (read.width, read.point_step) == (7, 20)


def test_conventions_have_names_and_units() -> None:
    kinds = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("ring", "u2"), ("time", "f4")]
    convention = ros.parse(ros.serialize(np.zeros(3, kinds))).convention
    assert convention == ("velodyne", "time", 1.0, "header_stamp", "ring", "intensity")
    assert ros.parse(ros.serialize(np.zeros((3, 3), np.float32))).convention.name == "xyz"


def test_fields_that_numpy_cannot_have_are_omitted() -> None:
    message = bytearray(ros.serialize(np.zeros(3, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("later", "u1")])))
    message[message.index(b"later\0") + 12] = 12  # the datatype
    cloud = ros.parse(message)
    assert [field.datatype for field in cloud.fields] == [7, 7, 7, 12]
    assert cloud.points.dtype.names == ("x", "y", "z")
    assert len(ros.parse(cloud.append({"label": np.zeros(3, np.uint8)})).fields) == 5


def test_names_with_any_bytes_are_readable() -> None:
    message = bytearray(ros.serialize(np.zeros((2, 3), np.float32), frame_id="lidar"))
    message[message.index(b"lidar")] = 0xFF
    assert ros.parse(message).header.frame_id == "\ufffdidar"


@pytest.mark.parametrize(
    ("message", "error"),
    [
        (b"", r"byte 0: the message ends within encapsulation header"),
        (b"\0\7\0\0", r"byte 0: CDR encapsulation 0x0007 is not supported"),
        (b"\0\1\0\0" + b"\xff" * 40, r"byte 16: the message ends within header.frame_id"),
    ],
)
def test_errors_name_the_byte(message: bytes, error: str) -> None:
    with pytest.raises(ValueError, match=error):
        ros.parse(message)


def test_a_truncated_message_is_an_error_anywhere() -> None:
    message = ros.serialize(np.zeros((2, 4), np.float32))
    for size in range(len(message)):
        with pytest.raises(ValueError, match=r"^byte \d+: "):
            ros.parse(message[:size])


def test_wrong_arguments_are_errors() -> None:
    message = ros.serialize(np.zeros((4, 3), np.float32))
    cloud = ros.parse(message)
    with pytest.raises(ValueError, match="encoding: 'xml' is not an encoding"):
        ros.parse(message, encoding="xml")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="message_type: 'sensor_msgs/msg/Image' is not a point cloud"):
        ros.parse(message, message_type="sensor_msgs/msg/Image")
    with pytest.raises(TypeError):
        ros.parse("text")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"label: shape \(3,\) does not match 1 x 4 points"):
        cloud.append({"label": np.zeros(3, np.uint8)})
    with pytest.raises(TypeError, match="label: dtype complex128 is not supported"):
        cloud.append({"label": np.zeros(4, complex)})
    with pytest.raises(TypeError, match="mask: dtype uint8 is not supported"):
        cloud.select(np.zeros(4, np.uint8))
    with pytest.raises(ValueError, match=r"mask: shape \(5,\)"):
        cloud.select(np.zeros(5, bool))
    with pytest.raises(ValueError, match="no field 'x'"):
        _ = ros.parse(ros.serialize(np.zeros(4, [("a", "f4")]))).xyz
    with pytest.raises(ValueError, match="no field 'x'"):
        flagstone.Surface().segment(ros.parse(ros.serialize(np.zeros(4, [("a", "f4")]))))
    with pytest.raises(ValueError, match="stamp: -1 is out of range"):
        ros.serialize(np.zeros((4, 3)), stamp=(0, -1))
    with pytest.raises(ValueError, match="points: shape"):
        ros.serialize(np.zeros((4, 2)))


def test_threads_may_share_a_cloud(scan: Scan) -> None:
    cloud = ros.parse(ros.serialize(scan))
    labels = np.arange(len(scan), dtype=np.uint8) % 5
    expected = cloud.append({"label": labels})
    results: list[bytes] = []
    threads = [threading.Thread(target=lambda: results.append(cloud.append({"label": labels}))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == [expected] * 8
