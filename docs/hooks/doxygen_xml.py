# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs doxygen over the public headers and turns the descriptions in its XML into Markdown."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from mkdocs.exceptions import PluginError

if TYPE_CHECKING:
    from collections.abc import Callable
    from xml.etree.ElementTree import Element

DOXYFILE = """
QUIET = YES
INPUT = "{include}/flagstone"
FILE_PATTERNS = *.hpp *.h
RECURSIVE = YES
STRIP_FROM_PATH = "{include}"
OUTPUT_DIRECTORY = "{output}"
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
SORT_MEMBER_DOCS = NO
WARN_FORMAT = "$file:$line: $text"
"""

# Members that need no comment: moves, copies, destructors and default constructors.
SPECIAL_MEMBER = re.compile(
    r"Member (~\w+\(\)|operator=\((const )?\w+ &&?\)|(?P<name>\w+)\((const )?((?P=name) &&?)?\).*::(?P=name) is not)"
)


def run_doxygen(include: Path) -> tuple[list[Element], list[str]]:
    """All compounds that the headers declare, and the complaints of doxygen, one line each."""
    doxygen = shutil.which("doxygen")
    if doxygen is None:
        raise PluginError("doxygen is not installed, and the C++ reference needs it (run apt-get install doxygen)")
    with tempfile.TemporaryDirectory() as output:
        doxyfile = DOXYFILE.format(include=include, output=output)
        run = subprocess.run([doxygen, "-"], input=doxyfile, text=True, capture_output=True, check=False)
        if run.returncode != 0:
            raise PluginError(f"doxygen failed: {run.stderr.strip()}")
        complaints = [line for line in sorted(set(run.stderr.splitlines())) if not SPECIAL_MEMBER.search(line)]
        files = sorted(Path(output, "xml").glob("*.xml"))
        compounds = [compound for path in files for compound in ElementTree.parse(path).iter("compounddef")]
    return compounds, [line.replace(f"{include}/", "include/") for line in complaints]


def plain(element: Element | None) -> str:
    """The text of an element on one line, without markup."""
    return "" if element is None else " ".join("".join(element.itertext()).split())


def description(element: Element, link: Callable[[str], str | None]) -> str:
    """A whole comment as Markdown. `link` returns the address that belongs to an id of doxygen."""
    parts = [element.find("briefdescription"), element.find("detaileddescription")]
    blocks = [block for part in parts if part is not None for para in part for block in paragraph(para, link)]
    return "\n\n".join(blocks)


def paragraph(para: Element, link: Callable[[str], str | None]) -> list[str]:
    """A paragraph and the lists in it."""
    blocks = [escape(para.text or "")]
    for child in para:
        if child.tag in ("itemizedlist", "orderedlist"):
            mark = "- " if child.tag == "itemizedlist" else "1. "
            entries = ["\n\n".join(b for p in entry for b in paragraph(p, link)) for entry in child]
            blocks += ["\n".join(mark + entry.replace("\n", "\n    ") for entry in entries), ""]
        elif child.tag in ("verbatim", "programlisting", "preformatted"):
            text = "".join(child.itertext()).strip("\n")
            blocks += [f"```cpp\n{text}\n```", ""]
        elif child.tag == "simplesect":
            blocks += [
                f"*{child.get('kind', '').capitalize()}*: " + " ".join(b for p in child for b in paragraph(p, link)),
                "",
            ]
        else:
            blocks[-1] += inline(child, link)
        blocks[-1] += escape(child.tail or "")
    return [block.strip() for block in blocks if block.strip()]


def inline(element: Element, link: Callable[[str], str | None]) -> str:
    """Code, emphasis, or a name with a link to its declaration."""
    refs = [element] if element.tag == "ref" else list(element.iter("ref"))
    address = link(refs[0].get("refid", "")) if refs else None
    if element.tag in ("ref", "computeroutput"):
        # A class's name in a sentence may also be just a word: that becomes a quiet link.
        is_code = element.tag == "computeroutput" or re.search(r"::|\(", plain(element))
        text = f"`{plain(element)}`" if is_code else escape(plain(element))
        return f"[{text}]({address})" if address else text
    mark = {"emphasis": "*", "bold": "**"}.get(element.tag, "")
    return f"{mark}{escape(plain(element))}{mark}"


def escape(text: str) -> str:
    """Text as Markdown, with special characters escaped."""
    text = re.sub(r"([\\`*\[\]])", r"\\\1", re.sub(r"\s+", " ", text))
    return text.replace("&", "&amp;").replace("<", "&lt;").replace("|", "&#124;")
