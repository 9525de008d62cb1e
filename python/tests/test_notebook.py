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
    """Runs a cell as Jupyter does, and returns the value of its last expression as text."""
    source = "".join(cell["source"])
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, f"cell {cell['id']}", "exec"), names)
    if last is None:
        return ""
    value = eval(compile(ast.Expression(last.value), f"cell {cell['id']}", "eval"), names)
    return "" if value is None or source.rstrip().endswith(";") else repr(value)


def stored_text(cell: Any) -> str:
    """The text that a cell printed and the value of its last expression, as stored by scripts/run-notebook."""
    texts = [output.get("text") or output["data"]["text/plain"] for output in cell["outputs"]]
    return "".join("".join(text) for text in texts).replace("<Figure>", "")


def test_every_cell_prints_its_stored_output_and_writes_only_temporary_files(
    notebook: Any, figures: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            value = run(cell, names)
            assert capsys.readouterr().out + value == stored_text(cell), "run scripts/run-notebook"
    assert list(tmp_path.iterdir()) == []
    assert not Path(names["directory"].name).exists()
    assert len(plt.get_fignums()) == 5
    score = flagstone.score(names["result"].labels, names["classes"], names["points"], protocol="simulation")
    assert (names["result"].ground & names["is_ground"]).sum() == score.true_positives, "the plot uses the protocol"


def test_it_is_stored_with_a_plot_for_each_figure_and_without_metadata(notebook: Any) -> None:
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    outputs = [output for cell in notebook["cells"] for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 5
    assert all(cell["metadata"] == {} and cell.get("execution_count") is None for cell in notebook["cells"])
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)
