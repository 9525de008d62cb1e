# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone`, which the package includes."""

import os
import sys
from pathlib import Path
from typing import NoReturn

from flagstone import _core

PYTHON_VARIABLE = "FLAGSTONE_PYTHON"
"""Environment variable with the interpreter, which the program starts for commands that need Python."""


def path() -> Path:
    """Path of the program.

    Raises:
        FileNotFoundError: This installation does not include the program.
    """
    # CMake installs it next to the compiled module. In an editable installation, this file is elsewhere.
    program = Path(_core.__file__).parent / "bin" / "flagstone"
    if not program.is_file():
        raise FileNotFoundError(f"{program}: the command is missing from this installation; reinstall flagstone")
    return program


def environment() -> dict[str, str]:
    """The environment variables of this process and the interpreter, for the program."""
    return {**os.environ, PYTHON_VARIABLE: sys.executable}


def main() -> NoReturn:
    """Replaces this process with the command and passes on its arguments."""
    try:
        program = os.fspath(path())
        os.execve(program, [program, *sys.argv[1:]], environment())
    except OSError as error:
        sys.exit(f"flagstone: {error}")
