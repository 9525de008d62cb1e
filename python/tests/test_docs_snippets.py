# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Every snippet of README.md and docs/ works.

The Python code of a page runs from top to bottom, in an empty directory or after the page's `flagstone demo`. C and
C++ code is compiled. Commands run on one small simulated scan instead of the data that they name, and simulate one
frame: the data sets are large, and some commands take hours. So options, their values and their combinations are
tested, but not the printed results. Of commands for Ray, only the options are checked, because they may need a cluster.
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

# The first line of a block that is not tested. Readers see it too.
NOT_RUN = re.compile(r"\s*# Not run by the tests: (?P<reason>.+)")


MISSING_PACKAGE = re.compile(r"ImportError: .*pip install 'flagstone\[.*|ModuleNotFoundError: (?!.*flagstone).*")


@dataclass(frozen=True)
class Block:
    language: str  # "" if the page names none, or indents the block
    first_line: int  # counted from 1
    lines: tuple[str, ...]

    @property
    def is_run(self) -> bool:
        return not (self.lines and NOT_RUN.match(self.lines[0]))


def name_of(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def blocks_of(page: Path) -> list[Block]:
    """Fenced blocks, and indented blocks after an empty line."""
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
C = [(page, block) for page in PAGES for block in blocks_of(page) if block.language == "c" and block.is_run]
CPP = [(page, block) for page in PAGES for block in blocks_of(page) if block.language == "cpp" and block.is_run]

C_HEADERS = ["#include <flagstone/flagstone.h>", "#include <stdio.h>"]

# A C++ snippet may use the headers and the points of a scan without declaring them.
CPP_HEADERS = ["#include <flagstone/flagstone.hpp>", "#include <flagstone/make_segmenter.hpp>"]
CPP_FUNCTION = "[[maybe_unused]] void snippet([[maybe_unused]] const float* points, std::size_t count) {"


@pytest.mark.parametrize("page", [page for page, blocks in PYTHON.items() if blocks], ids=name_of)
def test_python_of_a_page_runs_from_top_to_bottom(page: Path, tmp_path: Path) -> None:
    last = PYTHON[page][-1].first_line
    if any("flagstone demo" in line for block in blocks_of(page) if block.first_line < last for line in block.lines):
        run_command(["demo"], tmp_path)  # the first step of the page
    lines = [""] * len(page.read_text(encoding="utf-8").splitlines())
    for block in PYTHON[page]:
        lines[block.first_line - 1 : block.first_line - 1 + len(block.lines)] = block.lines
    # Error messages contain the line numbers of the page.
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
        pytest.skip("no C++ compiler is installed")
    includes = [line for line in block.lines if line.startswith("#include")]
    body = ["" if line.startswith("#include") else line for line in block.lines]
    line = f'#line {block.first_line} "{name_of(page)}"'  # for the messages of the compiler
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


@pytest.mark.parametrize(("page", "block"), C, ids=[f"{name_of(page)}:{block.first_line}" for page, block in C])
def test_c_of_a_page_compiles(page: Path, block: Block, tmp_path: Path) -> None:
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if compiler is None:
        pytest.skip("no C compiler is installed")
    line = f'#line {block.first_line} "{name_of(page)}"'  # for the messages of the compiler
    if any("int main(" in text for text in block.lines):
        source = [line, *block.lines]
    else:
        source = [*C_HEADERS, "void snippet(void);", "void snippet(void) {", line, *block.lines, "}"]
    file = tmp_path / "snippet.c"
    file.write_text("\n".join(source) + "\n", encoding="utf-8")
    run = subprocess.run(
        [compiler, "-std=c99", "-pedantic", "-Wall", "-Werror", "-fsyntax-only", f"-I{ROOT / 'include'}", file],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr


def test_numbers_of_the_readme_are_on_a_page_that_the_same_paragraph_links_to() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    measured = 0
    for paragraph in re.split(r"\n(?=- |\n)", text):
        numbers = re.findall(r"(?<![\w.])\d+\.\d+(?= ?(?:%|ms)| and )", re.sub(r"\s+", " ", paragraph))
        pages = [ROOT / page for page in re.findall(r"\]\((docs/benchmarks/[^)#]+)", paragraph)]
        known = "".join(page.read_text(encoding="utf-8") for page in pages)
        assert [number for number in numbers if number not in known] == []
        measured += len(numbers)
    assert measured >= 6


# Readers replace words in capitals.
PLACEHOLDERS = {"METRES": "1.73", "PROTOCOL": "simulation", "METHOD": "surface", "NAME": "vlp-16", "SCENE": "park"}
FLAGS = ("--json", "--compare", "--image", "--color-patches", "--heights", "--surface", "--speed")
SHORTEST = {"simulate": ("--frames", "1"), "bench": ("--rounds", "1")}
INPUTS = {"eval": "dataset", "sweep": "dataset", "map": "run"}  # the others read a scan


def commands(program: str) -> dict[str, str]:
    """Each different command of a program, with its first position."""
    found: dict[str, str] = {}
    for page in PAGES:
        for block in blocks_of(page):
            if block.language not in ("", "sh", "bash", "console") or not block.is_run:
                continue
            text = "\n".join(block.lines).replace("\\\n", " ")
            for match in re.finditer(rf"^\s*(?:\$ )?({program} .*)$", text, re.MULTILINE):
                found.setdefault(match[1], f"{name_of(page)}:{block.first_line}")
    return found


ALL_COMMANDS = commands("flagstone")
RAY_COMMANDS = {text: place for text, place in ALL_COMMANDS.items() if text.startswith("flagstone ray ")}
BAG_COMMANDS = {text: place for text, place in ALL_COMMANDS.items() if text.startswith("flagstone bag ")}
COMMANDS = {text: place for text, place in ALL_COMMANDS.items() if text not in RAY_COMMANDS | BAG_COMMANDS}


@pytest.fixture(scope="module")
def stand_ins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory with the inputs of all commands."""
    directory = tmp_path_factory.mktemp("stand-ins")
    scan = ["--scene", "flat_street", "--sensor", "vlp-16", "--sensor-height", "1.73", "--frames", "1"]
    run_command(["simulate", *scan, "--output", "dataset"], directory)
    sequences = directory / "dataset" / "sequences"
    (directory / "labels").mkdir()
    (directory / "labels" / "sequences").symlink_to(sequences)
    (sequences / "00" / "predictions").symlink_to(sequences / "00" / "labels")
    (directory / "run").symlink_to(sequences / "00")
    (directory / "scan.bin").symlink_to(sequences / "00" / "velodyne" / "000000.bin")
    (directory / "scan.label").symlink_to(sequences / "00" / "labels" / "000000.label")
    for method in ("surface", "patchwork"):
        (directory / f"{method}.toml").write_text(
            run_command(["config", "--method", method], directory), encoding="utf-8"
        )
    (directory / "sensor.toml").write_text(
        "beams = 16\nelevation_top = 15\nelevation_bottom = -15\nheight = 0.6\n", encoding="utf-8"
    )
    return directory


def run_command(arguments: list[str], directory: Path, environment: dict[str, str] | None = None) -> str:
    done = subprocess.run(
        [_command.path(), *arguments],
        cwd=directory,
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("command", COMMANDS, ids=[f"{place} {text[:60]}" for text, place in COMMANDS.items()])
def test_command_runs_on_stand_ins(command: str, stand_ins: Path, tmp_path: Path) -> None:
    run_command(on_stand_ins(command, stand_ins), tmp_path)


@pytest.mark.parametrize("command", RAY_COMMANDS, ids=[f"{place} {text[:60]}" for text, place in RAY_COMMANDS.items()])
def test_command_for_ray_is_understood(command: str, tmp_path: Path) -> None:
    nothing = shutil.which("true")
    assert nothing is not None
    environment = {**_command.environment(), _command.PYTHON_VARIABLE: nothing}  # instead of Python
    run_command(shlex.split(command, comments=True)[1:], tmp_path, environment)


@pytest.mark.parametrize("command", BAG_COMMANDS, ids=[f"{place} {text[:60]}" for text, place in BAG_COMMANDS.items()])
def test_command_for_bags_runs_on_a_stand_in(command: str, stand_ins: Path, tmp_path: Path) -> None:
    pytest.importorskip("rosbags", reason="needs rosbags, of the test dependencies")
    from bag_scenes import scans, scene, write_bag

    source = write_bag(tmp_path / "in.bag", "rosbag1", scene("rosbag1", scans(2)))
    names = {"--topic": "/points", "--tf": "base_link", "--imu": "/imu", "--config": str(stand_ins / "surface.toml")}
    words = shlex.split(command, comments=True)[1:]
    options = words[3:]
    for option in words[3:]:
        if option in names:
            options[options.index(option) + 1] = names[option]
    assert not any(word.startswith("-") for word in words[1:3]), "IN and OUT come first"
    run_command(["bag", str(source), str(tmp_path / "out.bag"), *options], tmp_path, _command.environment())


def on_stand_ins(command: str, directory: Path) -> list[str]:
    """The arguments of a command, with its data replaced and its work as short as possible."""
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
            arguments.append(value_on_stand_ins(option, word, method, directory))
            option = ""
        else:
            inputs = [str(directory / INPUTS.get(subcommand, "scan.bin"))]
    for name, value in [SHORTEST[subcommand]] if subcommand in SHORTEST else []:
        if name in arguments:
            arguments[arguments.index(name) + 1] = value
        else:
            arguments += [name, value]
    return arguments + inputs


def value_on_stand_ins(option: str, value: str, method: str, directory: Path) -> str:
    match option:
        case "--sequences":
            return "00"
        case "--reference":
            return str(directory / "scan.label")
        case "--labels" | "--moving" if "=" in value:
            return f"{value.partition('=')[0]}={directory / 'labels'}"
        case "--poses":
            return str(directory / "run" / "poses.txt")
        case "--config":
            return str(directory / f"{method}.toml")
        case "--sensor" if value.endswith(".toml"):
            return str(directory / "sensor.toml")
        case "--protocol" if value.endswith(".json"):
            return "simulation"
        case "--output":
            return Path(value).name
    return value
