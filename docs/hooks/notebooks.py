# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Shows each Jupyter notebook below docs/ as a page, with the outputs that are stored in it.

A link to `NAME.ipynb` leads to the page on the site. On a code host it leads to the notebook.
"""

from __future__ import annotations

import base64
import json
import re
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from mkdocs.structure.files import File

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

LINK = re.compile(r"(?<=\]\()(?P<path>[^()\s:]+)\.ipynb(?=\)(?!\{))")


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Adds a page and its images for each notebook."""
    for notebook in [file for file in files if file.src_uri.endswith(".ipynb")]:
        path = PurePosixPath(notebook.src_uri)
        page = [f"[Download this notebook]({path.name}){{ download }}"]
        images: list[bytes] = []
        for cell in json.loads(notebook.content_string)["cells"]:
            source = "".join(cell["source"])
            page.append(source if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
            for output in cell.get("outputs", []):
                page.append(shown(output, path.stem, images))
        page[:2] = page[1::-1]  # the title comes first
        files.append(File.generated(config, str(path.with_suffix(".md")), content="\n\n".join(page) + "\n"))
        for number, image in enumerate(images, 1):
            files.append(File.generated(config, str(path.with_name(f"{path.stem}-{number}.png")), content=image))
    return files


def shown(output: dict[str, Any], stem: str, images: list[bytes]) -> str:
    """An output as Markdown; appends its image, if any, to `images`."""
    data = output.get("data", {"text/plain": output.get("text", "")})
    if "image/png" in data:
        images.append(base64.b64decode("".join(data["image/png"])))
        return f"![Output of the cell above]({stem}-{len(images)}.png)"
    return f"```text\n{''.join(data['text/plain']).rstrip()}\n```"


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Makes links to a notebook lead to its page. The download link has attributes and stays."""
    return LINK.sub(lambda link: f"{link['path']}.md", markdown)
