# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""A list right below a paragraph is a list on code hosts, but a part of the paragraph here: that is a warning."""

from __future__ import annotations

import logging
import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mkdocs.structure.pages import Page

log = logging.getLogger("mkdocs.hooks.lists")

LIST_IN_PARAGRAPH = re.compile(r"<p>(?:(?!</p>).)*?\n(?P<item>(?:[-*]|1\.) [^\n]*)", re.DOTALL)


def on_page_content(html: str, *, page: Page, **_: Any) -> None:
    """Warns of such a list."""
    for found in LIST_IN_PARAGRAPH.finditer(html):
        log.warning("%s: an empty line is missing before the list at '%s'", page.file.src_uri, found["item"])
