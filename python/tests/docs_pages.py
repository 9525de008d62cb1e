# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The code blocks of README.md and of every page of docs/."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]

# The first line of a block that the tests leave alone; it stays in the block, for the reader to see.
NOT_RUN = re.compile(r"\s*# Not run by the tests: (?P<reason>.+)")


@dataclass(frozen=True)
class Block:
    language: str  # "" where the page names none, or indents the block
    first_line: int  # counted from 1
    lines: tuple[str, ...]

    @property
    def is_run(self) -> bool:
        return not (self.lines and NOT_RUN.match(self.lines[0]))


def name_of(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def blocks_of(page: Path) -> list[Block]:
    """Fenced blocks, and indented ones after an empty line."""
    lines = page.read_text(encoding="utf-8").splitlines()
    blocks: list[Block] = []
    at = 0
    while at < len(lines):
        fence = re.match(r"(?P<indent>\s*)(?P<mark>```+)(?P<language>\w*)", lines[at])
        begin = at + 1
        if fence:
            at = next(end for end in range(begin, len(lines)) if lines[end].strip() == fence["mark"])
            indent = len(fence["indent"])
            body = tuple(line[indent:] for line in lines[begin:at])
            blocks.append(Block(fence["language"], begin + 1, body))
        elif lines[at].startswith("    ") and at > 0 and not lines[at - 1].strip():
            begin = at
            while at + 1 < len(lines) and lines[at + 1].startswith("    "):
                at += 1
            blocks.append(Block("", begin + 1, tuple(line[4:] for line in lines[begin : at + 1])))
        at += 1
    return blocks
