# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The Python of the docs runs, page by page, and their C++ compiles."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from docs_pages import PAGES, ROOT, blocks_of, name_of

PYTHON = {
    page: [block for block in blocks_of(page) if block.language == "python" and block.is_run] for page in PAGES
}
CPP = [(page, block) for page in PAGES for block in blocks_of(page) if block.language == "cpp" and block.is_run]

# What a C++ snippet may take for granted: the headers, and a scan of the reader's.
CPP_BEFORE = """
#include <flagstone/flagstone.hpp>
#include <flagstone/make_segmenter.hpp>
{includes}
[[maybe_unused]] void snippet([[maybe_unused]] const float* points, [[maybe_unused]] std::size_t count) {{
#line {line} "{page}"
"""


@pytest.mark.parametrize("page", [page for page, blocks in PYTHON.items() if blocks], ids=name_of)
def test_python_of_a_page_runs_from_top_to_bottom(page: Path, tmp_path: Path) -> None:
    lines = [""] * len(page.read_text(encoding="utf-8").splitlines())
    for block in PYTHON[page]:
        lines[block.first_line - 1 : block.first_line - 1 + len(block.lines)] = block.lines
    # With the page's own line numbers in what goes wrong.
    program = f"exec(compile({chr(10).join(lines)!r}, {name_of(page)!r}, 'exec'))"
    run = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    needs = run.stderr.strip().splitlines()[-1:]
    if needs and needs[0].startswith("ImportError:") and "pip install 'flagstone[" in needs[0]:
        pytest.skip(needs[0])
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize(("page", "block"), CPP, ids=[f"{name_of(page)}:{block.first_line}" for page, block in CPP])
def test_cpp_of_a_page_compiles(page: Path, block, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    compiler = shutil.which(os.environ.get("CXX", "c++"))
    if compiler is None:
        pytest.skip("no C++ compiler is there")
    includes = "\n".join(line for line in block.lines if line.startswith("#include"))
    body = "\n".join("" if line.startswith("#include") else line for line in block.lines)
    before = CPP_BEFORE.format(includes=includes, line=block.first_line, page=name_of(page))
    if "int main(" in body:
        before = f'{includes}\n#line {block.first_line} "{name_of(page)}"\n'
        source = before + body
    else:
        source = before + body + "\n}\n"
    file = tmp_path / "snippet.cpp"
    file.write_text(source, encoding="utf-8")
    run = subprocess.run(
        [compiler, "-std=c++20", "-fsyntax-only", f"-I{ROOT / 'include'}", f"-I{ROOT / 'src'}", file],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
