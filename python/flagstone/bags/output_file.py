# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Files that are written under a temporary name, in large pieces."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import secrets
import shutil
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from flagstone.bags.container import Data

_FLUSH_SIZE = 4 << 20  # bytes per system call: larger ones are not faster
_MAX_PIECES = 1000  # per system call; Linux allows 1024
_MAX_NAME = 200  # bytes of the final name in the temporary name; names have at most 255


class Staging:
    """A temporary file or directory next to a path, which it replaces when the output is complete.

    Its name is `.NAME.XXXXXXXX.part`. It is locked as long as its process runs, so that later runs can delete the
    files of killed processes.
    """

    def __init__(self, target: Path, *, is_directory: bool) -> None:
        """Deletes what killed processes left, and creates the temporary file or directory.

        Raises:
            OSError: The directory does not exist or is not writable, or the target cannot be replaced.
        """
        self.target = Path(os.path.realpath(target))
        self._is_directory = is_directory
        self._check_target()
        prefix = "." + os.fsdecode(os.fsencode(self.target.name)[:_MAX_NAME])
        _delete_leftovers(self.target.parent, prefix)
        self.path = self.target.parent / f"{prefix}.{secrets.token_hex(4)}.part"
        try:
            if is_directory:
                self.path.mkdir()
                self._lock = os.open(self.path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
            else:
                self._lock = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
        except OSError as error:
            raise OSError(error.errno, error.strerror, os.fspath(target)) from None
        with suppress(OSError):  # file systems without locks: leftovers are not deleted there
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def finish(self) -> None:
        """Renames the temporary file or directory."""
        self._check_target()
        self.path.replace(self.target)
        self._close()

    def discard(self) -> None:
        """Deletes the temporary file or directory. Does nothing after `finish`."""
        if self._lock < 0:
            return
        if self._is_directory:
            shutil.rmtree(self.path, ignore_errors=True)
        else:
            self.path.unlink(missing_ok=True)
        self._close()

    def _check_target(self) -> None:
        if self._is_directory:
            if self.target.is_dir() and any(self.target.iterdir()):
                problem = "exists and is not empty (delete it, or choose a new path)"
                raise FileExistsError(errno.EEXIST, problem, os.fspath(self.target))
            if self.target.exists() and not self.target.is_dir():
                problem = "is not a directory (a bag of rosbag2 is a directory; or add the extension .mcap or .db3)"
                raise OSError(errno.ENOTDIR, problem, os.fspath(self.target))
        elif self.target.exists() and not self.target.is_file():
            problem = "is not a regular file (choose a regular file or a new path)"
            raise OSError(errno.EINVAL, problem, os.fspath(self.target))

    def _close(self) -> None:
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def _delete_leftovers(folder: Path, prefix: str) -> None:
    pattern = re.compile(re.escape(prefix) + r"\.[0-9a-f]{8}\.part")
    with suppress(OSError):
        for entry in list(os.scandir(folder)):
            if not pattern.fullmatch(entry.name) or entry.is_symlink():
                continue
            with suppress(OSError):
                lock = os.open(entry.path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW)
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)  # fails while the process runs that writes it
                    if entry.is_dir():
                        shutil.rmtree(entry.path, ignore_errors=True)
                    else:
                        Path(entry.path).unlink()
                finally:
                    os.close(lock)


class OutputFile:
    """A file that is written sequentially. Pieces are not copied and must not change until they are written."""

    def __init__(self, path: Path) -> None:
        """Opens a new or empty file."""
        self._path = path
        # Not with O_TRUNC, because ext4 would then write the file to the disk when it is closed.
        self._descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o666)
        self._pieces: list[Data] = []
        self._pending = 0
        self.position = 0
        """Bytes written so far, including those that are still in memory."""

    def write(self, pieces: Sequence[Data], size: int) -> None:
        """Appends pieces of `size` bytes in total."""
        self._pieces.extend(pieces)
        self._pending += size
        self.position += size
        if self._pending >= _FLUSH_SIZE:
            self.flush()

    def flush(self) -> None:
        """Writes all pieces.

        Raises:
            OSError: The disk is full, or another error of the file system.
        """
        pieces, self._pieces, self._pending = self._pieces, [], 0
        for first in range(0, len(pieces), _MAX_PIECES):
            self._write_all(pieces[first : first + _MAX_PIECES])

    def overwrite(self, position: int, data: bytes) -> None:
        """Replaces bytes that were written before."""
        self.flush()
        if os.pwrite(self._descriptor, data, position) != len(data):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), os.fspath(self._path))

    def close(self) -> None:
        """Closes the file without writing pieces that are still in memory. Does nothing if it is closed."""
        self._pieces, self._pending = [], 0
        if self._descriptor >= 0:
            descriptor, self._descriptor = self._descriptor, -1
            os.close(descriptor)

    def _write_all(self, pieces: list[Data]) -> None:
        while pieces:
            written = os.writev(self._descriptor, pieces)
            done = 0
            while done < len(pieces) and written >= len(pieces[done]):
                written -= len(pieces[done])
                done += 1
            pieces = pieces[done:]
            if pieces and written:
                pieces[0] = memoryview(pieces[0])[written:]
