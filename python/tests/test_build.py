# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
import importlib
import json
import sys
from pathlib import Path

import pytest

pytest.importorskip("scikit_build_core")

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture
def backend(monkeypatch):
    monkeypatch.syspath_prepend(str(REPOSITORY / "python"))
    yield importlib.import_module("build_backend")
    sys.modules.pop("build_backend")


def test_a_missing_compiler_is_reported_in_one_line(backend, tmp_path):
    with pytest.raises(SystemExit, match=r"^flagstone: no C\+\+ compiler found \(expected c\+\+, .*GCC") as error:
        backend.check_compiler({"PATH": str(tmp_path)})
    assert "\n" not in str(error.value)


def test_a_compiler_named_by_cxx_must_exist(backend):
    with pytest.raises(SystemExit, match="expected no-such-compiler;"):
        backend.check_compiler({"CXX": "no-such-compiler -O2", "PATH": "/usr/bin"})


@pytest.mark.parametrize("name", ["c++", "clang++"])
def test_a_compiler_in_the_path_is_enough(backend, tmp_path, name):
    compiler = tmp_path / name
    compiler.touch(mode=0o755)
    backend.check_compiler({"PATH": str(tmp_path)})


def test_the_build_announces_its_steps_and_duration(backend, tmp_path):
    terminal = tmp_path / "terminal"
    backend.announce(terminal)
    assert "compiling the library, the command and the Python module takes 2 to 4 minutes" in terminal.read_text()


def test_without_a_terminal_nothing_is_announced(backend, tmp_path):
    backend.announce(tmp_path / "none" / "tty")


def test_all_hooks_of_scikit_build_core_exist(backend):
    build = importlib.import_module("scikit_build_core.build")
    assert all(hasattr(backend, hook) for hook in build.__all__)


def test_warnings_are_errors_for_tests_but_not_for_users():
    presets = json.loads((REPOSITORY / "CMakePresets.json").read_text())["configurePresets"]
    variables = {preset["name"]: preset["cacheVariables"] for preset in presets}
    assert variables["test"]["FLAGSTONE_WARNINGS_AS_ERRORS"] == "ON"
    assert "FLAGSTONE_WARNINGS_AS_ERRORS" not in variables["release"]
    assert "WARNINGS_AS_ERRORS" not in (REPOSITORY / "pyproject.toml").read_text()
