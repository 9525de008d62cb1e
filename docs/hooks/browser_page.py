# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Adds the page of web/page to the site, as `try/`, if `make web` has built it."""

from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING

from mkdocs.structure.files import File, Files

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig

BUILT = pathlib.Path(__file__).resolve().parents[2] / "web" / "page" / "dist"


def on_config(config: MkDocsConfig) -> None:
    """Adds a tab for the page."""
    if config.nav and (BUILT / "index.html").exists():
        config.nav.insert(1, {"Try it": "try/index.html"})


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Adds the files of the page."""
    for path in sorted(BUILT.rglob("*")):
        if path.is_file():
            name = f"try/{path.relative_to(BUILT).as_posix()}"
            files.append(File.generated(config, name, abs_src_path=str(path)))
    return files
