# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The YAML of rosbag2, with unknown members and the order kept."""

from __future__ import annotations

from io import StringIO
from typing import Any

from flagstone._optional import needs
from flagstone.bags.reports import DamagedError

_MAX_SIZE = 16 << 20  # characters; metadata of thousands of topics have fewer


def load(text: str) -> Any:
    """The content of a document.

    Raises:
        DamagedError: The document is not YAML.
    """
    if len(text) > _MAX_SIZE:
        raise DamagedError(f"{len(text)} characters are too many (expected at most {_MAX_SIZE})")
    parser = _yaml()
    try:
        return parser.load(text)
    except Exception as error:  # the parser raises exceptions of many types
        reason = str(error).strip().splitlines()
        raise DamagedError(f"is not YAML: {reason[0] if reason else type(error).__name__}") from None


def dump(content: Any) -> str:
    """A document with this content."""
    stream = StringIO()
    _yaml().dump(content, stream)
    return stream.getvalue()


def _yaml() -> Any:
    parser = needs("ruamel.yaml", "bag").YAML(typ="rt", pure=True)
    parser.preserve_quotes = True
    parser.width = 2**30  # long strings stay on one line
    return parser
