# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Adds the page of web/page to the site, as `try/`, if `make web` has built it.

A tab and a button on the home page lead to it.
"""

from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING

from mkdocs.structure.files import File, Files

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.pages import Page

BUILT = pathlib.Path(__file__).resolve().parents[2] / "web" / "page" / "dist"


BUTTON = """
[Try it in your browser: drop a scan, see its ground](try/index.html){ .md-button .md-button--primary }
"""


def is_built() -> bool:
    """True if `make web` has built the page."""
    return (BUILT / "index.html").exists()


def on_config(config: MkDocsConfig) -> None:
    """Adds a tab for the page."""
    if config.nav and is_built():
        config.nav.insert(1, {"Try it": "try/index.html"})


def on_page_markdown(markdown: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Adds a button to the home page, above the images."""
    if page.file.src_uri != "index.md" or not is_built():
        return markdown
    introduction, table, rest = markdown.partition("\n|")
    return introduction + BUTTON + table + rest


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Adds the files of the page."""
    for path in sorted(BUILT.rglob("*")):
        if path.is_file():
            name = f"try/{path.relative_to(BUILT).as_posix()}"
            files.append(File.generated(config, name, abs_src_path=str(path)))
    return files
