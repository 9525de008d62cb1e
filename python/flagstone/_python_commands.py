# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The commands that run in Python. The program `flagstone` parses their options and starts this module."""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import signal
import sys
from typing import Any

import flagstone
from flagstone import _command
from flagstone.segmenters import segmenter_with

SUCCESS, SOME_FAILED, USAGE_ERROR = 0, 1, 2
MODULES = {
    "bag": "flagstone.bags.command",
    "doctor": "flagstone.bags.doctor",
    "info": "flagstone.bags.info",
    "map": "flagstone.maps.command",
    "ray": "flagstone.ray.command",
}
"""The module of each command. Its function `run(options, paths)` returns the exit code."""


def main(arguments: list[str]) -> int:
    """Runs a command.

    Args:
        arguments: Version of the program, name of the command, its options as a JSON object, and its paths.

    Returns:
        Exit code: 0, success; 1, some inputs failed; 2, usage error.
    """
    version, command, options, *paths = arguments
    os.environ.pop(_command.PYTHON_VARIABLE, None)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]  # paths may contain any bytes
    if version != flagstone.__version__:
        print_error(
            f"{command}: the command has version {version}, but its Python package has version "
            f"{flagstone.__version__} (reinstall flagstone, or check {_command.PYTHON_VARIABLE})"
        )
        return USAGE_ERROR
    try:
        code: int = importlib.import_module(MODULES[command]).run(json.loads(options), paths)
        print_line("", end="", flush=True)
    except (ValueError, TypeError, FileNotFoundError, FileExistsError, ImportError, ConnectionError) as error:
        code = failed(error, USAGE_ERROR)
    except KeyboardInterrupt as interrupt:
        code = failed(interrupt if interrupt.args else "interrupted: nothing was written", SOME_FAILED)
    except MemoryError:
        code = failed("out of memory", SOME_FAILED)
    except BrokenPipeError:
        code = SOME_FAILED
    except (OSError, RuntimeError) as error:
        code = failed(error, SOME_FAILED)
    try:
        sys.stdout.flush()
    except OSError:  # reported above; the interpreter must not try again
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def print_line(text: object, *, end: str = "\n", flush: bool = False) -> None:
    """Prints a line on standard output.

    Raises:
        BrokenPipeError: The reader has closed it.
        RuntimeError: It cannot be written.
    """
    try:
        print(text, end=end, flush=flush)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise RuntimeError("standard output: cannot be written (is the disk full?)") from error


def failed(error: object, code: int) -> int:
    """Prints an error and returns the exit code."""
    if isinstance(error, OSError) and error.strerror:
        where = f"{error.filename}: " if error.filename is not None else ""
        print_error(f"{where}{error.strerror}")
    else:
        print_error(str(error) or type(error).__name__)
    return code


def print_error(message: str) -> None:
    """Prints an error on one line of standard error: control characters are escaped, as the program does."""
    escaped = "".join(
        f"\\x{ord(letter):02x}" if ord(letter) < 32 or ord(letter) == 127 else letter for letter in message
    )
    with contextlib.suppress(OSError):
        print(f"flagstone: {escaped}", file=sys.stderr, flush=True)


def segmenter_of(options: dict[str, Any]) -> flagstone.Segmenter:
    """The segmenter with the method and all settings of the options."""
    return segmenter_with(options["method"], _with_infinity(options["settings"]))


def _with_infinity(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _with_infinity(entry) for name, entry in value.items()}
    if isinstance(value, list):
        return [_with_infinity(entry) for entry in value]
    return float(value) if value in ("inf", "-inf") else value  # JSON does not have infinity
