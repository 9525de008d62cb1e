# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone ray`."""

from __future__ import annotations

from typing import Any

from flagstone._python_commands import SOME_FAILED, SUCCESS, failed, print_line, segmenter_of
from flagstone.ray.job import segment
from flagstone.ray.summary import Interrupted


def run(options: dict[str, Any], paths: list[str]) -> int:
    """Runs the command.

    Args:
        options: The options of the program, by name. 0 and "" are unset.
        paths: Source and destination. An empty destination is the source.

    Returns:
        Exit code: 0, success; 1, some scans failed.
    """
    source, destination = paths
    try:
        summary = segment(
            source,
            destination or None,
            segmenter=segmenter_of(options),
            format=options["format"],
            label_map=options["label_map"],
            columns=options["columns"] or None,
            overwrite=options["overwrite"],
            address=options["address"] or None,
            workers=options["workers"] or None,
        )
    except Interrupted as interrupt:
        print_line(interrupt.summary)
        return failed(interrupt, SOME_FAILED)
    except KeyboardInterrupt:
        return failed("interrupted before the first scan", SOME_FAILED)
    print_line(summary)
    return SOME_FAILED if summary.failures else SUCCESS
