# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Where scans lie and labels go: a local folder, or a folder of any other filesystem."""

from __future__ import annotations

import os
import posixpath
import uuid
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pyarrow.fs

# A put of an object store is whole or not there. Elsewhere a file is written under another name and moved.
OBJECT_STORES = frozenset({"s3", "s3a", "gcs", "gs", "abfs", "abfss", "az", "oss", "oci", "r2", "memory"})


@dataclass(frozen=True)
class Place:
    """A folder, by its path and the filesystem it is in: None for the local one."""

    path: str
    filesystem: pyarrow.fs.FileSystem | None = None

    @property
    def is_local(self) -> bool:
        return self.filesystem is None

    def at(self, name: str) -> str:
        """The path of the file that is `name` here."""
        return posixpath.join(self.path, name)

    def parent(self) -> Place:
        return Place(posixpath.dirname(self.path.rstrip("/")) or ("." if self.is_local else ""), self.filesystem)

    def size(self, name: str = "") -> int | None:
        """The bytes of a file, or None where it is none."""
        path = self.at(name) if name else self.path
        if self.filesystem is None:
            return os.path.getsize(path) if os.path.isfile(path) else None
        info = self.filesystem.get_file_info(path)
        return int(info.size) if info.is_file else None

    def files(self) -> Iterator[tuple[str, int]]:
        """Name and bytes of every file in this folder and below it; nothing where there is no such folder."""
        if self.filesystem is None:
            yield from _local_files(self.path)
            return
        import pyarrow.fs

        selector = pyarrow.fs.FileSelector(self.path, recursive=True, allow_not_found=True)
        for info in self.filesystem.get_file_info(selector):
            if info.is_file:
                yield posixpath.relpath(info.path, self.path), int(info.size or 0)

    def read(self, name: str) -> bytes:
        path = self.at(name)
        if self.filesystem is None:
            with open(path, "rb") as file:
                return file.read()
        with self.filesystem.open_input_file(path) as stream:
            return bytes(stream.read())

    def write(self, name: str, data: bytes) -> None:
        """Writes a file whole or not at all, and the folders it needs."""
        path = self.at(name)
        if self.filesystem is None:
            os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
            _write_and_move_local(path, data)
        elif _is_object_store(self.filesystem):
            _put(self.filesystem, path, data)
        else:
            self.filesystem.create_dir(posixpath.dirname(path), recursive=True)
            beside = posixpath.join(posixpath.dirname(path), f".flagstone-{uuid.uuid4().hex}.tmp")
            _put(self.filesystem, beside, data)
            self.filesystem.move(beside, path)

    def remove(self, name: str) -> None:
        if self.filesystem is None:
            os.unlink(self.at(name))
        else:
            self.filesystem.delete_file(self.at(name))

    def __str__(self) -> str:
        return self.path


def place(location: str | os.PathLike[str], filesystem: Any = None) -> Place:
    """The place that a path or URL names.

    Args:
        location: A local path, or a URL that PyArrow or fsspec knows (`s3://`, `gs://`, `hdfs://`, `abfs://`, ...).
        filesystem: A PyArrow or fsspec filesystem that `location` is a path of; None: the one the URL names.

    Raises:
        ValueError: No filesystem is known for the URL.
    """
    text = os.fspath(location)
    if filesystem is not None:
        return Place(text.rstrip("/"), _as_arrow(filesystem))
    if "://" not in text:
        return Place(text.rstrip("/") or "/")
    import pyarrow
    import pyarrow.fs

    try:
        found, path = pyarrow.fs.FileSystem.from_uri(text)
    except pyarrow.ArrowInvalid:  # not one of Arrow's own
        found, path = _from_fsspec(text)
    if isinstance(found, pyarrow.fs.LocalFileSystem):
        return Place(path.rstrip("/") or "/")
    return Place(path.rstrip("/"), found)


def _from_fsspec(url: str) -> tuple[pyarrow.fs.FileSystem, str]:
    import fsspec.core

    try:
        found, path = fsspec.core.url_to_fs(url)
    except (ImportError, ValueError) as error:
        raise ValueError(f"{url}: no filesystem for this URL: {error}") from None
    return _as_arrow(found), path


def _as_arrow(filesystem: Any) -> pyarrow.fs.FileSystem:
    import pyarrow.fs

    if isinstance(filesystem, pyarrow.fs.FileSystem):
        return filesystem
    return pyarrow.fs.PyFileSystem(pyarrow.fs.FSSpecHandler(filesystem))


def _is_object_store(filesystem: pyarrow.fs.FileSystem) -> bool:
    """By the names that filesystems have: `s3`, or `py::fsspec+('s3', 's3a')` of one that fsspec has."""
    name = filesystem.type_name.removeprefix("py::fsspec+")
    return any(word in OBJECT_STORES for word in name.replace("'", " ").replace("(", " ").replace(",", " ").split())


def _put(filesystem: pyarrow.fs.FileSystem, path: str, data: bytes) -> None:
    with filesystem.open_output_stream(path) as stream:
        stream.write(data)


def _write_and_move_local(path: str, data: bytes) -> None:
    beside = os.path.join(os.path.dirname(path), f".flagstone-{uuid.uuid4().hex}.tmp")
    try:
        with open(beside, "xb") as file:
            file.write(data)
        os.replace(beside, path)
    except BaseException:
        if os.path.exists(beside):
            os.unlink(beside)
        raise


def _local_files(top: str) -> Iterator[tuple[str, int]]:
    """As the command `flagstone segment` walks: links to files are followed, links to folders are not."""
    folders = [""]
    while folders:
        folder = folders.pop()
        try:
            entries = list(os.scandir(os.path.join(top, folder) if folder else top))
        except (FileNotFoundError, PermissionError):
            continue
        for entry in entries:
            name = posixpath.join(folder, entry.name) if folder else entry.name
            if entry.is_dir(follow_symlinks=False):
                folders.append(name)
            elif entry.is_file():
                yield name, entry.stat().st_size
