# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone`, which comes with the package."""

import os
import sys
from pathlib import Path
from typing import NoReturn

from flagstone import _core


def path() -> Path:
    """Where the program is.

    Raises:
        FileNotFoundError: The package was put together without it.
    """
    # It is where CMake put the compiled module; in an editable installation that is not where this file is.
    program = Path(_core.__file__).parent / "bin" / "flagstone"
    if not program.is_file():
        raise FileNotFoundError(f"{program}: the command is not part of this installation: install flagstone again")
    return program


def main() -> NoReturn:
    """Becomes the command, with the arguments of this process."""
    try:
        program = os.fspath(path())
        os.execv(program, [program, *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"flagstone: {error}")
