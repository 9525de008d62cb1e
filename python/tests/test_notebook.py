# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The notebook of the documentation runs from top to bottom."""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import flagstone

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
matplotlib.use("Agg")
plt = pytest.importorskip("matplotlib.pyplot")

NOTEBOOK = Path(__file__).parents[2] / "docs" / "tutorials" / "first-scan.ipynb"


@pytest.fixture(scope="module")
def notebook() -> Any:
    return json.loads(NOTEBOOK.read_text(encoding="utf-8"))


@pytest.fixture
def figures() -> Iterator[None]:
    yield
    plt.close("all")


def run(cell: Any, names: dict[str, Any]) -> str:
    """Runs a cell as Jupyter does, and returns the text of the value of its last expression."""
    tree = ast.parse("".join(cell["source"]))
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, f"cell {cell['id']}", "exec"), names)
    if last is None:
        return ""
    return repr(eval(compile(ast.Expression(last.value), f"cell {cell['id']}", "eval"), names))


def test_every_cell_runs_and_writes_only_temporary_files(
    notebook: Any, figures: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    shown = [run(cell, names) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert list(tmp_path.iterdir()) == []
    assert not Path(names["directory"].name).exists()
    assert len(plt.get_fignums()) == 5
    assert any(text.startswith("{'nonground': ") for text in shown)
    assert "F1 9" in capsys.readouterr().out
    score = flagstone.score(names["result"].labels, names["classes"], names["points"], protocol="simulation")
    assert (names["result"].ground & names["is_ground"]).sum() == score.true_positives, "the plot uses the protocol"


def test_it_is_stored_without_outputs(notebook: Any) -> None:
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
        assert cell["metadata"] == {}
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)
