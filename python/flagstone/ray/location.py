# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Directories of scans and labels, local or on another filesystem."""

from __future__ import annotations

import contextlib
import os
import posixpath
import re
import uuid
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from flagstone._atomic_file import atomic_write

if TYPE_CHECKING:
    import pyarrow.fs

# Object stores write files atomically. On other filesystems a temporary file is written and moved.
OBJECT_STORES = frozenset({"s3", "s3a", "gcs", "gs", "abfs", "abfss", "az", "oss", "oci", "r2"})


class File(NamedTuple):
    """A file found in a directory."""

    name: str  # relative to the directory
    size: int  # bytes
    modified: float | None  # seconds since 1970; None if the filesystem does not provide it


@dataclass(frozen=True)
class Location:
    """A directory: its path and its filesystem, None for the local one."""

    path: str
    filesystem: pyarrow.fs.FileSystem | None = None

    @property
    def is_local(self) -> bool:
        return self.filesystem is None

    def at(self, name: str) -> str:
        """Path of the file `name` in this directory."""
        return posixpath.join(self.path, name)

    def below(self, name: str) -> Location:
        """A subdirectory."""
        return Location(self.at(name), self.filesystem)

    def file(self) -> File | None:
        """The file at this path, with the last component of the path as its name; None if it is not a file."""
        name = posixpath.basename(self.path)
        if self.filesystem is None:
            path = Path(self.path)
            return _local_file(name, path.stat()) if path.is_file() else None
        info = self.filesystem.get_file_info(self.path)
        return _arrow_file(name, info) if info.is_file else None

    def files(self) -> Iterator[File]:
        """All files in this directory and its subdirectories; none if the directory does not exist."""
        if self.filesystem is None:
            yield from _local_files(self.path)
            return
        import pyarrow.fs

        selector = pyarrow.fs.FileSelector(self.path, recursive=True, allow_not_found=True)
        for info in self.filesystem.get_file_info(selector):
            if info.is_file:
                yield _arrow_file(posixpath.relpath(info.path, self.path), info)

    def read(self, name: str) -> bytes:
        if self.filesystem is None:
            return Path(self.at(name)).read_bytes()
        with self.filesystem.open_input_file(self.at(name)) as stream:
            return bytes(stream.read())

    def write(self, name: str, data: bytes) -> None:
        """Writes a file atomically and creates missing directories."""
        path = self.at(name)
        folder, _ = posixpath.split(path)
        if self.filesystem is None:
            Path(folder).mkdir(parents=True, exist_ok=True)
            with atomic_write(path) as file:
                file.write(data)
        elif is_object_store(self.filesystem):
            _put(self.filesystem, path, data)
        else:
            self.filesystem.create_dir(folder, recursive=True)
            beside = posixpath.join(folder, f".flagstone-{uuid.uuid4().hex}.tmp")
            try:
                _put(self.filesystem, beside, data)
                self.filesystem.move(beside, path)
            except BaseException:
                with contextlib.suppress(OSError):
                    self.filesystem.delete_file(beside)
                raise

    def remove(self, name: str) -> None:
        if self.filesystem is None:
            Path(self.at(name)).unlink(missing_ok=True)
        else:
            self.filesystem.delete_file(self.at(name))

    def is_left_over(self, name: str) -> bool:
        """Whether a file is a temporary file of a flagstone process that was killed."""
        left = re.fullmatch(r"\.flagstone-(?:(\d+)-(?:py)?\d+|[0-9a-f]{32})\.tmp", posixpath.basename(name))
        if left is None:
            return False
        return left[1] is None or not (self.is_local and _is_running(int(left[1])))

    def __str__(self) -> str:
        return self.path


def location_of(where: str | os.PathLike[str], filesystem: Any = None) -> Location:
    """The directory for a path or URL.

    Args:
        where: A local path, or a URL that PyArrow or fsspec supports (`s3://`, `gs://`, `hdfs://`, `abfs://`, ...).
        filesystem: PyArrow or fsspec filesystem of `where`; by default the one that `where` names.

    Raises:
        ValueError: No filesystem supports the URL.
    """
    text = os.fspath(where)
    found = None
    if filesystem is not None:
        found = _as_arrow(filesystem)
    elif "://" in text:
        found, text = _from_url(text)
    import pyarrow.fs

    if found is None or isinstance(found, pyarrow.fs.LocalFileSystem):
        return Location(str(Path(text).absolute()))  # workers have other working directories
    return Location(text.rstrip("/"), found)


def is_object_store(filesystem: pyarrow.fs.FileSystem) -> bool:
    """Whether a filesystem is an object store, by its name: `s3`, or for fsspec `py::fsspec+('s3', 's3a')`."""
    name = filesystem.type_name.removeprefix("py::fsspec+")
    return not OBJECT_STORES.isdisjoint(name.translate(str.maketrans("'(),", "    ")).split())


def _from_url(url: str) -> tuple[pyarrow.fs.FileSystem, str]:
    import pyarrow.fs

    with contextlib.suppress(pyarrow.ArrowInvalid):  # filesystems of Arrow take precedence over those of fsspec
        found, path = pyarrow.fs.FileSystem.from_uri(url)
        return found, path
    import fsspec.core

    try:
        found, path = fsspec.core.url_to_fs(url)
    except (ImportError, ValueError) as error:
        raise ValueError(f"{url}: no filesystem supports this URL: {error}") from None
    return _as_arrow(found), path


def _as_arrow(filesystem: Any) -> pyarrow.fs.FileSystem:
    import pyarrow.fs

    if isinstance(filesystem, pyarrow.fs.FileSystem):
        return filesystem
    return pyarrow.fs.PyFileSystem(pyarrow.fs.FSSpecHandler(filesystem))


def _put(filesystem: pyarrow.fs.FileSystem, path: str, data: bytes) -> None:
    with filesystem.open_output_stream(path) as stream:
        stream.write(data)


def _local_file(name: str, status: os.stat_result) -> File:
    return File(name, status.st_size, status.st_mtime_ns / 1e9)


def _arrow_file(name: str, info: pyarrow.fs.FileInfo) -> File:
    return File(name, int(info.size or 0), info.mtime_ns / 1e9 if info.mtime_ns else None)


def _is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True


def _local_files(top: str) -> Iterator[File]:
    """Lists files as `flagstone segment` does: follows links to files, but not links to directories."""
    folders = [""]
    while folders:
        folder = folders.pop()
        try:
            entries = list(os.scandir(posixpath.join(top, folder)))
        except (FileNotFoundError, NotADirectoryError, PermissionError):
            continue
        for entry in entries:
            name = posixpath.join(folder, entry.name)
            if entry.is_dir(follow_symlinks=False):
                folders.append(name)
            elif entry.is_file():
                yield _local_file(name, entry.stat())
