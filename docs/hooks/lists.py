# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Warns about a list directly below a paragraph: code hosts show a list, MkDocs makes it part of the paragraph."""

from __future__ import annotations

import logging
import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mkdocs.structure.pages import Page

log = logging.getLogger("mkdocs.hooks.lists")

LIST_IN_PARAGRAPH = re.compile(r"<p>(?:(?!</p>).)*?\n(?P<item>(?:[-*]|1\.) [^\n]*)", re.DOTALL)


def on_page_content(html: str, *, page: Page, **_: Any) -> None:
    """Warns about each such list."""
    for found in LIST_IN_PARAGRAPH.finditer(html):
        log.warning("%s: an empty line is missing before the list at '%s'", page.file.src_uri, found["item"])
