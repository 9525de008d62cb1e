# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Common parts of `evaluate` and `simulate`: progress on a terminal, and errors that name Python's arguments."""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager


def listed(values: str | Iterable[object]) -> list[str]:
    """The values as strings; `"a,b"` is `["a", "b"]`."""
    return values.split(",") if isinstance(values, str) else [str(value) for value in values]


@contextmanager
def run() -> Iterator[tuple[Callable[[str], None] | None, int]]:
    """Yields the function that draws a progress line (None if standard error is not a terminal) and its width.

    Raises:
        ValueError: An argument is invalid. The message names the Python argument instead of the command's option.
    """
    on_terminal = sys.stderr is not None and sys.stderr.isatty()
    try:
        yield (_draw if on_terminal else None), shutil.get_terminal_size().columns - 1
    except ValueError as error:
        raise ValueError(_in_terms_of_python(str(error))) from None
    finally:
        if on_terminal:
            _draw("")


def _draw(text: str) -> None:
    sys.stderr.write(f"\r\x1b[K{text}")
    sys.stderr.flush()


def _in_terms_of_python(error: str) -> str:
    # A quoted command line, 'flagstone ...', keeps its options.
    return re.sub(r"'flagstone [^']*'|--([a-z][a-z-]*)", lambda at: at[1].replace("-", "_") if at[1] else at[0], error)
