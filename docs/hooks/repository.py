# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Connects the site with the source tree around docs/.

README.md becomes the home page; CHANGELOG.md, CONTRIBUTING.md and RELEASING.md become pages too. Pages link to source files, so that
readers on a code host can follow the links. The site contains no sources, so it shows the path instead. A link to a
missing file is a warning, which fails a strict build.
"""

from __future__ import annotations

import logging
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from mkdocs.structure.files import File

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

log = logging.getLogger("mkdocs.hooks.repository")

ROOT_PAGES = {
    "index.md": "README.md",
    "contributing/changelog.md": "CHANGELOG.md",
    "contributing/contributing.md": "CONTRIBUTING.md",
    "contributing/releasing.md": "RELEASING.md",
}
LINK = re.compile(r"(?P<image>!?)\[(?P<text>[^\[\]]*)\]\((?P<target>[^()\s#]+)(?P<anchor>#[^()\s]*)?\)")

NAMED_PAGE = re.compile(r"\bdocs/(?P<page>[\w/-]+\.md)\b")


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Adds the pages from the root of the repository."""
    for page, source in ROOT_PAGES.items():
        files.append(File.generated(config, page, abs_src_path=str(root(config) / source)))
    return files


def on_page_markdown(markdown: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Replaces links that lead out of docs/."""
    docs = Path(config.docs_dir)
    page_directory = (docs / page.file.src_uri).parent
    pages_of_root = {root(config) / source: docs / name for name, source in ROOT_PAGES.items()}
    link_directory = root(config) if page.file.src_uri in ROOT_PAGES else page_directory

    def replace(link: re.Match[str]) -> str:
        target = link["target"]
        if "://" in target or target.startswith("mailto:"):
            return link[0]
        path = Path(os.path.normpath(link_directory / target))
        path = pages_of_root.get(path, path)
        if path.is_relative_to(docs):  # MkDocs checks that the file exists
            return f"{link['image']}[{link['text']}]({os.path.relpath(path, page_directory)}{link['anchor'] or ''})"
        name = path.relative_to(root(config)).as_posix() if path.is_relative_to(root(config)) else str(path)
        if not path.exists():
            log.warning("%s links to %s, which does not exist", page.file.src_uri, name)
        text = link["text"]
        return f"`{name}`" if text.startswith("`") else f"{text} (`{name}`)"

    return LINK.sub(replace, markdown)


def on_page_content(html: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Turns page names in docstrings and comments, such as `docs/reference/sensors.md`, into links."""

    def replace(named: re.Match[str]) -> str:
        target = files.get_file_from_path(named["page"])
        if target is None:
            log.warning("%s names docs/%s, which does not exist", page.file.src_uri, named["page"])
            return named[0]
        return f'<a href="{target.url_relative_to(page.file)}">{named["page"].removesuffix(".md")}</a>'

    return NAMED_PAGE.sub(replace, html) if page.file.src_uri.startswith("reference/") else html


def root(config: MkDocsConfig) -> Path:
    """The root of the repository."""
    return Path(config.config_file_path).parent
