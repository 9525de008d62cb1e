# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""scikit-build-core's build backend, which first announces a build of minutes and reports a missing compiler.

pip shows the output of a backend only if it fails, so the announcement goes to the terminal, if there is one.
"""

import contextlib
import os
import shlex
import shutil
from pathlib import Path

from scikit_build_core import build as _backend
from scikit_build_core.build import *  # noqa: F403  the hooks that are not wrapped

ANNOUNCEMENT = (
    "flagstone: compiling the library, the command and the Python module: 2 to 4 minutes on two cores "
    "(pip install -v shows progress)"
)


def check_compiler(environment=os.environ):
    """Ends the build with one line if no C++ compiler is found."""
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
    """Writes how long the build takes to the terminal."""
    with contextlib.suppress(OSError):
        Path(terminal).write_text(f"\r{ANNOUNCEMENT}\n")


def get_requires_for_build_wheel(config_settings=None):
    """What building a wheel requires; the first hook that pip calls."""
    check_compiler()
    return _backend.get_requires_for_build_wheel(config_settings)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds a wheel, as PEP 517 describes it."""
    check_compiler()
    announce()
    return _backend.build_wheel(wheel_directory, config_settings, metadata_directory)
