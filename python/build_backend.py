# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Build backend of scikit-build-core. It also checks for a compiler and announces the duration of the build.

pip shows the output of a backend only if it fails, so the announcement is written to the terminal.
"""

import contextlib
import os
import shlex
import shutil
from pathlib import Path

from scikit_build_core import build as _backend
from scikit_build_core.build import *  # noqa: F403  hooks without changes

ANNOUNCEMENT = (
    "flagstone: compiling the library, the command and the Python module takes 2 to 4 minutes on two cores "
    "(use pip install -v to see the progress)"
)


def check_compiler(environment=os.environ):
    """Stops the build with a one-line message if there is no C++ compiler."""
    named = shlex.split(environment.get("CXX", ""))[:1]
    if "CMAKE_CXX_COMPILER" in environment.get("CMAKE_ARGS", "") or "CMAKE_TOOLCHAIN_FILE" in environment:
        return
    names = named or ["c++", "g++", "clang++"]
    if not any(shutil.which(name, path=environment.get("PATH")) for name in names):
        raise SystemExit(
            f"flagstone: no C++ compiler found (expected {', '.join(names)}; "
            "install GCC 12 or Clang 15, Debian: apt-get install g++, or set CXX)"
        )


def announce(terminal="/dev/tty"):
    """Writes the announcement to the terminal, if there is one."""
    with contextlib.suppress(OSError):
        Path(terminal).write_text(f"\r{ANNOUNCEMENT}\n")


def get_requires_for_build_wheel(config_settings=None):
    """Requirements for building a wheel. This is the first hook that pip calls."""
    check_compiler()
    return _backend.get_requires_for_build_wheel(config_settings)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds a wheel (PEP 517)."""
    check_compiler()
    announce()
    return _backend.build_wheel(wheel_directory, config_settings, metadata_directory)
