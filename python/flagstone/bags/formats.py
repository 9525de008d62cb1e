# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The format of a bag, from its content when it is read and from its name when it is written."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from flagstone.bags.container import Bag, BagWriter, Format
from flagstone.bags.reports import one_line

_MAGIC: dict[bytes, Format] = {
    b"#ROSBAG V": "rosbag1",
    b"\x89MCAP": "mcap",
    b"SQLite format 3\x00": "sqlite3",
}
_ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
_EXTENSIONS: dict[str, Format] = {".bag": "rosbag1", ".mcap": "mcap", ".db3": "sqlite3"}


def open_bag(path: Path, report: Callable[[str], None]) -> Bag:
    """Opens a bag with the reader of its format. See `flagstone.bags.open_bag`."""
    try:
        if not path.is_dir() and format_by_magic(path) == "rosbag1":
            from flagstone.bags.rosbag1 import Rosbag1

            return Rosbag1(path, report)
        from flagstone.bags.rosbag2 import Rosbag2

        return Rosbag2(path, report)
    except ValueError as error:
        raise ValueError(one_line(str(error))) from None


def format_by_magic(path: Path) -> Format | None:
    """The format by the first bytes of a file; None if it is unknown."""
    begin = beginning(path)
    return next((name for magic, name in _MAGIC.items() if begin.startswith(magic)), None)


def is_zstd(path: Path) -> bool:
    """Whether a file is compressed as a whole."""
    return beginning(path).startswith(_ZSTD_MAGIC)


def beginning(path: Path) -> bytes:
    """The first bytes of a regular file; b"" for pipes and devices, without waiting for them."""
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    with os.fdopen(descriptor, "rb") as file:
        return file.read(16) if path.is_file() else b""


def create_bag(path: Path, like: Bag, format: Format | None) -> BagWriter:
    """Creates a bag with the writer of its format. See `flagstone.bags.create_bag`."""
    extension = Path(path.stem).suffix if path.suffix == ".zstd" else path.suffix
    of_name = _EXTENSIONS.get(extension)
    if format is not None and of_name is not None and format != of_name:
        raise ValueError(f"{path}: the extension {extension} contradicts the format {format!r} (omit one of them)")
    chosen = format or of_name or like.format
    if (chosen == "rosbag1") != (like.format == "rosbag1"):
        expected = ".bag" if like.format == "rosbag1" else ".mcap, .db3 or a directory"
        raise ValueError(
            f"{path}: a bag of {_ROS[like.format]} cannot be written as a bag of {_ROS[chosen]} "
            f"(expected {expected}; their messages have different bytes)"
        )
    if chosen == "rosbag1" and of_name is None:
        raise ValueError(f"{path}: a bag of ROS 1 needs the extension .bag")
    _check_not_input(path, like)
    if chosen == "rosbag1":
        from flagstone.bags.rosbag1 import Rosbag1
        from flagstone.bags.rosbag1_writer import Rosbag1Writer

        assert isinstance(like, Rosbag1)
        return Rosbag1Writer(path, like)
    from flagstone.bags.rosbag2 import Rosbag2
    from flagstone.bags.rosbag2_writer import Rosbag2Writer

    assert isinstance(like, Rosbag2)
    return Rosbag2Writer(path, like, chosen)


_ROS: dict[Format, str] = {"rosbag1": "ROS 1", "sqlite3": "ROS 2", "mcap": "ROS 2"}


def _check_not_input(path: Path, like: Bag) -> None:
    """Raises ValueError if writing `path` could replace a file of the input."""
    output = Path(os.path.realpath(path))
    for file in (like.path, *like.files):
        source = Path(os.path.realpath(file))
        if output == source or (output.exists() and source.exists() and output.samefile(source)):
            raise ValueError(f"{path}: is the input (choose another output)")
        if like.path.is_dir() and source in output.parents and source.is_dir():
            raise ValueError(f"{path}: is inside the input {like.path} (choose another output)")
        if output in source.parents:
            raise ValueError(f"{path}: contains the input {like.path} (choose another output)")


def is_bag(path: str | os.PathLike[str]) -> bool:
    """Whether a path names a bag: a file .bag, .mcap or .db3, or a directory with metadata.yaml."""
    name = os.fspath(path)
    if Path(name).is_dir():
        return (Path(name) / "metadata.yaml").exists()
    return name.endswith((*_EXTENSIONS, ".mcap.zstd", ".db3.zstd"))
