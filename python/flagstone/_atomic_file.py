# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Files that are written atomically."""

from __future__ import annotations

import errno
import itertools
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, cast

_numbers = itertools.count()


@contextmanager
def atomic_write(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Opens a temporary file next to `path`. It replaces `path` if the block succeeds, otherwise it is deleted.

    Symbolic links are followed. Anything other than a regular file is never replaced.

    Raises:
        OSError: The directory does not exist, the disk is full, or `path` is a directory, pipe or device.
    """
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        problem = "is not a regular file (choose a regular file or a new path)"
        raise OSError(errno.EINVAL, problem, os.fspath(path))
    try:
        temporary, opened = _new_file_in(target.parent)
    except OSError as error:
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None
    file = _FirstErrorFile(opened)
    try:
        with opened:
            yield cast(BinaryIO, file)
        temporary.replace(target)
    except BaseException as raised:
        temporary.unlink(missing_ok=True)
        fault = file.fault if file.fault is not None else raised
        if isinstance(fault, OSError) and fault.filename is None:
            raise OSError(fault.errno, fault.strerror, os.fspath(path)) from raised
        raise


class _FirstErrorFile:
    """A file that keeps the first OSError, because compressors report only that writing failed."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self.fault: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        method = getattr(self._file, name)

        def call(*arguments: Any) -> Any:
            try:
                return method(*arguments)
            except OSError as error:
                self.fault = self.fault or error
                raise

        return call


def _new_file_in(folder: Path) -> tuple[Path, BinaryIO]:
    while True:
        path = folder / f".flagstone-{os.getpid()}-py{next(_numbers)}.tmp"
        try:
            return path, path.open("x+b")
        except FileExistsError:  # left by a killed process that had the same process ID
            continue
