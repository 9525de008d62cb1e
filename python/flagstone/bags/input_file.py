# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A file that is mapped into memory."""

from __future__ import annotations

import errno
import mmap
import os
import re
import stat
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path


class InputFile:
    """The bytes of a regular file, read-only and without copying them.

    Slices of `view` keep the mapping alive after `close`.
    """

    def __init__(self, path: Path) -> None:
        """Opens a file.

        Raises:
            OSError: The file cannot be opened.
            ValueError: It is not a regular file, or is empty.
        """
        self.path = path
        self._descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        try:
            status = os.fstat(self._descriptor)
            if not stat.S_ISREG(status.st_mode):
                raise ValueError(f"{path}: is not a regular file (expected a bag)")
            if status.st_size == 0:
                raise ValueError(f"{path}: is empty (expected a bag)")
            self.size = status.st_size
            self._map = mmap.mmap(self._descriptor, self.size, prot=mmap.PROT_READ)
        except BaseException:
            os.close(self._descriptor)
            raise
        self._map.madvise(mmap.MADV_SEQUENTIAL)
        self.view = memoryview(self._map)

    def check(self) -> None:
        """Raises OSError if the file has become shorter, because reading the missing bytes would end the process."""
        if self._descriptor < 0:
            raise ValueError(f"{self.path}: the bag is closed")
        if os.fstat(self._descriptor).st_size < self.size:
            raise OSError(errno.EIO, "was truncated while it was read", os.fspath(self.path))

    def find(self, pattern: bytes, begin: int) -> int:
        """Position of the first occurrence from `begin`; -1 if the file does not contain it."""
        return self._map.find(pattern, begin)

    def finditer(self, pattern: re.Pattern[bytes], begin: int) -> Iterator[int]:
        """Positions of all matches from `begin`."""
        return (match.start() for match in pattern.finditer(self._map, begin))

    def close(self) -> None:
        """Closes the file. Does nothing if it is closed."""
        if self._descriptor < 0:
            return
        os.close(self._descriptor)
        self._descriptor = -1
        self.view.release()
        with suppress(BufferError):  # messages still use it; it is unmapped with the last of them
            self._map.close()
