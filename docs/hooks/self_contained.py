# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Warns if a page of the site loads anything from another server."""

from __future__ import annotations

import logging
import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mkdocs.structure.pages import Page

log = logging.getLogger("mkdocs.hooks.self_contained")

LOADED = re.compile(r"<(?!a\b)\w+\b[^>]*?\b(?:src|href|srcset|data)=[\"']?(?P<address>(?:https?:)?//[^\"'\s>]+)")


def on_post_page(output: str, *, page: Page, **_: Any) -> None:
    """Warns about resources that load with the page; links are fine."""
    for found in LOADED.finditer(output):
        log.warning("%s loads %s from another server", page.file.src_uri, found["address"])
