# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The notebook of the documentation runs from top to bottom and stores its present output."""

from __future__ import annotations

import json
import runpy
from pathlib import Path
from typing import Any

import pytest

import flagstone

pytest.importorskip("matplotlib", reason="matplotlib is not installed")
pytest.importorskip("PIL", reason="Pillow is not installed")

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def notebook() -> Any:
    return json.loads((ROOT / "docs" / "tutorials" / "first-scan.ipynb").read_text(encoding="utf-8"))


def without_images(outputs: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The outputs of a cell with the presence of each image instead of its bytes, which depend on Matplotlib."""
    return [
        output | {"data": output["data"] | {"image/png": ""}} if "image/png" in output.get("data", {}) else output
        for output in outputs
    ]


def test_every_cell_has_its_stored_output_and_writes_only_temporary_files(
    notebook: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = runpy.run_path(str(ROOT / "scripts" / "run-notebook"))["run"]
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    images = 0
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            outputs = without_images(run("".join(cell["source"]), names))
            assert outputs == without_images(cell["outputs"]), "run scripts/run-notebook"
            images += sum("image/png" in output.get("data", {}) for output in outputs)
    assert images == 5
    assert list(tmp_path.iterdir()) == []
    assert not Path(names["directory"].name).exists()
    score = flagstone.score(names["result"].labels, names["classes"], names["points"], protocol="simulation")
    assert (names["result"].ground & names["is_ground"]).sum() == score.true_positives, "the plot uses the protocol"


def test_cells_are_stored_without_metadata_and_with_different_ids(notebook: Any) -> None:
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert all(cell["metadata"] == {} and cell.get("execution_count") is None for cell in notebook["cells"])
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)
