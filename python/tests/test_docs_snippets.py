# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Every snippet of README.md and of docs/ works.

The Python of a page runs from top to bottom, in an empty folder or after the page's `flagstone demo`. C++ compiles.
Commands run, but not on what they name: most of that is a data set, or hours of work. The data are one small simulated
scan, whatever a command calls them, and what is simulated has one frame. So all options, their values and what goes
with what are tested, but no figure. Commands for Ray, which may ask for a cluster, are only read.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from flagstone import _command

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]

# The first line of a block that the tests leave alone; it stays in the block, for the reader to see.
NOT_RUN = re.compile(r"\s*# Not run by the tests: (?P<reason>.+)")


MISSING_PACKAGE = re.compile(r"ImportError: .*pip install 'flagstone\[.*|ModuleNotFoundError: (?!.*flagstone).*")


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


PYTHON = {page: [block for block in blocks_of(page) if block.language == "python" and block.is_run] for page in PAGES}
CPP = [(page, block) for page in PAGES for block in blocks_of(page) if block.language == "cpp" and block.is_run]

# What a C++ snippet may take for granted: the headers, and a scan of the reader's.
CPP_HEADERS = ["#include <flagstone/flagstone.hpp>", "#include <flagstone/make_segmenter.hpp>"]
CPP_FUNCTION = "[[maybe_unused]] void snippet([[maybe_unused]] const float* points, std::size_t count) {"


@pytest.mark.parametrize("page", [page for page, blocks in PYTHON.items() if blocks], ids=name_of)
def test_python_of_a_page_runs_from_top_to_bottom(page: Path, tmp_path: Path) -> None:
    last = PYTHON[page][-1].first_line
    if any("flagstone demo" in line for block in blocks_of(page) if block.first_line < last for line in block.lines):
        run_command(["demo"], tmp_path)  # what the page begins with
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
    if missing := MISSING_PACKAGE.search(run.stderr):
        pytest.skip(missing[0])
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize(("page", "block"), CPP, ids=[f"{name_of(page)}:{block.first_line}" for page, block in CPP])
def test_cpp_of_a_page_compiles(page: Path, block: Block, tmp_path: Path) -> None:
    compiler = shutil.which(os.environ.get("CXX", "c++"))
    if compiler is None:
        pytest.skip("no C++ compiler is there")
    includes = [line for line in block.lines if line.startswith("#include")]
    body = ["" if line.startswith("#include") else line for line in block.lines]
    line = f'#line {block.first_line} "{name_of(page)}"'  # for what the compiler says
    if any("int main(" in text for text in body):
        source = [*includes, line, *body]
    else:
        source = [*CPP_HEADERS, *includes, CPP_FUNCTION, line, *body, "}"]
    file = tmp_path / "snippet.cpp"
    file.write_text("\n".join(source) + "\n", encoding="utf-8")
    run = subprocess.run(
        [compiler, "-std=c++20", "-fsyntax-only", f"-I{ROOT / 'include'}", f"-I{ROOT / 'src'}", file],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr


# Words in capitals are the reader's to fill in.
PLACEHOLDERS = {"METRES": "1.73", "PROTOCOL": "simulation", "METHOD": "surface", "NAME": "vlp-16", "SCENE": "park"}
FLAGS = ("--json", "--compare", "--image", "--color-patches", "--heights", "--surface", "--speed")
SHORTEST = {"simulate": ("--frames", "1"), "bench": ("--rounds", "1")}


def commands(program: str) -> dict[str, str]:
    """Each different command of a program, with the place it stands at first."""
    found: dict[str, str] = {}
    for page in PAGES:
        for block in blocks_of(page):
            if block.language not in ("", "sh", "bash", "console") or not block.is_run:
                continue
            text = "\n".join(block.lines).replace("\\\n", " ")
            for match in re.finditer(rf"^\s*(?:\$ )?({program} .*)$", text, re.MULTILINE):
                found.setdefault(match[1], f"{name_of(page)}:{block.first_line}")
    return found


COMMANDS = commands("flagstone")
RAY_COMMANDS = commands("flagstone-ray")


@pytest.fixture(scope="module")
def stand_ins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all that a command may be run on."""
    folder = tmp_path_factory.mktemp("stand-ins")
    scan = ["--scene", "flat_street", "--sensor", "vlp-16", "--sensor-height", "1.73", "--frames", "1"]
    run_command(["simulate", *scan, "--output", "dataset"], folder)
    sequences = folder / "dataset" / "sequences"
    (folder / "labels").mkdir()
    (folder / "labels" / "sequences").symlink_to(sequences)
    (sequences / "00" / "predictions").symlink_to(sequences / "00" / "labels")
    (folder / "scan.bin").symlink_to(sequences / "00" / "velodyne" / "000000.bin")
    (folder / "scan.label").symlink_to(sequences / "00" / "labels" / "000000.label")
    for method in ("surface", "patchwork"):
        (folder / f"{method}.toml").write_text(run_command(["config", "--method", method], folder), encoding="utf-8")
    (folder / "sensor.toml").write_text(
        "beams = 16\nelevation_top = 15\nelevation_bottom = -15\nheight = 0.6\n", encoding="utf-8"
    )
    return folder


def run_command(arguments: list[str], folder: Path) -> str:
    done = subprocess.run(
        [_command.path(), *arguments], cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("command", COMMANDS, ids=[f"{place} {text[:60]}" for text, place in COMMANDS.items()])
def test_command_runs_on_stand_ins(command: str, stand_ins: Path, tmp_path: Path) -> None:
    run_command(on_stand_ins(command, stand_ins), tmp_path)


@pytest.mark.parametrize("command", RAY_COMMANDS, ids=[f"{place} {text[:60]}" for text, place in RAY_COMMANDS.items()])
def test_command_for_ray_is_understood(command: str) -> None:
    of_ray = pytest.importorskip("flagstone.ray.command")
    of_ray.make_parser().parse_args(shlex.split(command, comments=True)[1:])


def on_stand_ins(command: str, folder: Path) -> list[str]:
    """The arguments of a command, with the data it names replaced, and as short as it can be."""
    words = shlex.split(re.sub(r"[\[\]]|(?<=\w)\.\.\.", "", command), comments=True)[1:]
    for end in (">", "|", "&&"):
        words = words[: words.index(end)] if end in words else words
    words = [PLACEHOLDERS.get(word, word) for word in words]
    subcommand = words[0]
    method = words[words.index("--method") + 1] if "--method" in words else "surface"
    arguments, inputs, option = [subcommand], [], ""
    for word in words[1:]:
        if word.startswith("-"):
            arguments.append(word)
            option = "" if "=" in word or word in FLAGS else word
        elif option:
            arguments.append(value_on_stand_ins(option, word, method, folder))
            option = ""
        else:
            inputs = [str(folder / ("dataset" if subcommand in ("eval", "sweep") else "scan.bin"))]
    for name, value in [SHORTEST[subcommand]] if subcommand in SHORTEST else []:
        if name in arguments:
            arguments[arguments.index(name) + 1] = value
        else:
            arguments += [name, value]
    return arguments + inputs


def value_on_stand_ins(option: str, value: str, method: str, folder: Path) -> str:
    match option:
        case "--sequences":
            return "00"
        case "--reference":
            return str(folder / "scan.label")
        case "--labels":
            return f"{value.partition('=')[0]}={folder / 'labels'}"
        case "--config":
            return str(folder / f"{method}.toml")
        case "--sensor" if value.endswith(".toml"):
            return str(folder / "sensor.toml")
        case "--protocol" if value.endswith(".json"):
            return "simulation"
        case "--output":
            return Path(value).name
    return value
