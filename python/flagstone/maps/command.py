# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The parts of the command `flagstone map` that run in Python, before and after the run is mapped."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from flagstone._map_input import InputRequest, prepare_input
from flagstone._python_commands import SOME_FAILED, SUCCESS, print_error, print_line, segmenter_of
from flagstone.maps._exports import Exports


def run(options: dict[str, Any], paths: list[str]) -> int:
    """Runs a part of the command.

    Args:
        options: The options of the program, by name, and `part`: "prepare" or "export". 0 and "" are unset.
        paths: Run, poses and output directory.

    Returns:
        Exit code: 0, success; 1, an export was not written.
    """
    exports = Exports(
        geotiff=options["geotiff"],
        crs=options["crs"] or None,
        las=options["las"],
        recording=options["recording"],
        animation=options["animation"],
    )
    try:
        if options["part"] == "export":
            return _export(exports, Path(paths[2]), options["json"])
        exports.check()
        scans, poses, output = paths
        topics = (options["topic"] or None, options["pose_topic"] or None)
        request = InputRequest(scans, poses, output, *topics, options["columns"] or None)
        prepare_input(request, lambda: segmenter_of(options), report=print_error)
    except KeyboardInterrupt:
        raise KeyboardInterrupt("interrupted: the map is not finished (run the command again)") from None
    return SUCCESS


def _export(exports: Exports, directory: Path, prints_json: bool) -> int:
    problems: list[str] = []
    for file in exports.write(directory, problems.append):
        if not prints_json:
            print_line(file)
    for problem in problems:
        print_error(problem)
    return SOME_FAILED if problems else SUCCESS
