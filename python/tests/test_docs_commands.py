# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Every command in the docs runs.

Not on what it names: most of that is a data set, or hours of work. The data are one small simulated scan, whatever
a command calls them, and sequences have one frame. So all options, their values and what goes with what are put to the
test, but no figure.
"""

from __future__ import annotations

import re
import shlex
import subprocess
from pathlib import Path

import pytest
from docs_pages import PAGES, blocks_of, name_of

from flagstone import _command

# Words in capitals are the reader's to fill in.
PLACEHOLDERS = {"METRES": "0.6", "PROTOCOL": "simulation", "METHOD": "surface", "NAME": "vlp-16", "SCENE": "flat_street"}
OF_SCANS = ("segment", "info", "doctor", "bench")
OF_DATASETS = ("eval", "sweep")


def commands() -> dict[str, str]:
    """Each different command, with the place it stands at first."""
    found: dict[str, str] = {}
    for page in PAGES:
        for block in blocks_of(page):
            if block.language not in ("", "sh", "bash", "console") or not block.is_run:
                continue
            text = "\n".join(block.lines).replace("\\\n", " ")
            for match in re.finditer(r"^\s*(?:\$ )?(flagstone .*)$", text, re.MULTILINE):
                found.setdefault(match[1], f"{name_of(page)}:{block.first_line}")
    return found


COMMANDS = commands()


@pytest.fixture(scope="module")
def stand_ins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all that a command may be run on."""
    folder = tmp_path_factory.mktemp("stand-ins")
    run(["simulate", "--scene", "flat_street", "--sensor", "vlp-16", "--frames", "1", "--output", "dataset"], folder)
    sequences = folder / "dataset" / "sequences"
    for number in range(1, 11):
        (sequences / f"{number:02}").symlink_to(sequences / "00")
    (folder / "scan.bin").symlink_to(sequences / "00" / "velodyne" / "000000.bin")
    (folder / "scan.label").symlink_to(sequences / "00" / "labels" / "000000.label")
    for method in ("surface", "patchwork"):
        (folder / f"{method}.toml").write_text(run(["config", "--method", method], folder), encoding="utf-8")
    (folder / "sensor.toml").write_text(
        "beams = 16\nelevation_top = 15\nelevation_bottom = -15\nheight = 0.6\n", encoding="utf-8"
    )
    return folder


def run(arguments: list[str], folder: Path) -> str:
    done = subprocess.run(
        [_command.path(), *arguments], cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("command", COMMANDS, ids=[f"{place} {text[:60]}" for text, place in COMMANDS.items()])
def test_command_runs_on_stand_ins(command: str, stand_ins: Path, tmp_path: Path) -> None:
    run(on_stand_ins(command, stand_ins), tmp_path)


def on_stand_ins(command: str, folder: Path) -> list[str]:
    """The arguments of a command, with the data it names replaced."""
    words = shlex.split(re.sub(r"[\[\]](?!\d)|(?<=\w)\.\.\.", "", command), comments=True)[1:]
    for end in (">", "|", "&&"):
        words = words[: words.index(end)] if end in words else words
    subcommand, method = words[0], "surface"
    if "--method" in words:
        method = words[words.index("--method") + 1]
    arguments, option = [subcommand], ""
    for word in words[1:]:
        if word.startswith("-"):
            option, _, value = word.partition("=")
            arguments.append(word if not value else f"{option}={value}")
            continue
        arguments.append(stand_in(subcommand, option, word, method, folder))
        if not (option in ("--over", "--set")):
            option = ""
    return [argument for argument in arguments if argument]


def stand_in(subcommand: str, option: str, word: str, method: str, folder: Path) -> str:
    word = PLACEHOLDERS.get(word, word)
    match option:
        case "--frames":
            return "1"
        case "--reference":
            return str(folder / "scan.label")
        case "--config":
            return str(folder / f"{method}.toml")
        case "--sensor" if word.endswith(".toml"):
            return str(folder / "sensor.toml")
        case "--protocol" if word.endswith(".json"):
            return "simulation"
        case "--output" | "-o":
            return Path(word).name
        case "" if subcommand in OF_SCANS:
            return str(folder / "scan.bin")
        case "" if subcommand in OF_DATASETS:
            return str(folder / "dataset")
    return word
