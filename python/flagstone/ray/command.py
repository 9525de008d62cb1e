# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command `flagstone-ray`."""

from __future__ import annotations

import argparse
import ast
import signal
import sys
from typing import Any

import flagstone
from flagstone.ray.job import segment
from flagstone.ray.summary import Interrupted

SUCCESS, SOME_FAILED, USAGE_ERROR = 0, 1, 2

DESCRIPTION = """\
Label every point of all scans in a directory or bucket, on this machine or on a Ray cluster.

Examples:
  flagstone-ray scans/ --output labels/
  flagstone-ray s3://bucket/scans --output s3://bucket/labels --address auto
  flagstone-ray scans/ --in-place --method patchwork --sensor hdl-32e --set distance_margin=0.1
"""
EPILOG = """\
Run the same command again to resume an interrupted run or to retry failed scans.

Exit codes: 0, success; 1, some scans failed; 2, usage error.
"""


def make_parser() -> argparse.ArgumentParser:
    """Returns a parser whose options have the names and meanings of those of `flagstone segment`."""
    parser = argparse.ArgumentParser(
        prog="flagstone-ray",
        usage="flagstone-ray [OPTIONS] SOURCE (--output DIR | --in-place)",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        add_help=False,
    )
    arguments = parser.add_argument_group("Arguments")
    arguments.add_argument(
        "source", metavar="SOURCE", help="directory of scans, or one scan: a path, or a URL such as s3://bucket/scans"
    )

    reading = parser.add_argument_group("Input")
    reading.add_argument(
        "--columns", type=int, metavar="N", help="floats per point in .bin files (default: 5 for .pcd.bin, otherwise 4)"
    )

    method = parser.add_argument_group("Method and settings")
    method.add_argument("--method", default="surface", metavar="NAME", help="segmentation method (default: surface)")
    method.add_argument("--preset", default="default", metavar="NAME", help="preset for patchwork and czm+...")
    method.add_argument("--sensor", metavar="NAME|FILE", help="derive settings from a sensor")
    method.add_argument("--config", metavar="FILE", help="read settings from a TOML file (see 'flagstone config')")
    method.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="override one setting, e.g. point.margin=0.2 (repeatable)",
    )
    method.add_argument(
        "--sensor-height", type=float, metavar="M", help="height of the sensor above the ground, metres"
    )
    method.add_argument("--tilt", metavar="X,Y,Z", help="up direction of a tilted sensor, in the sensor frame")

    writing = parser.add_argument_group("Output")
    where = writing.add_mutually_exclusive_group(required=True)
    where.add_argument(
        "-o", "--output", metavar="DIR", help="directory or URL for the labels, with the subdirectories of the source"
    )
    where.add_argument("--in-place", action="store_true", help="write the labels next to the scans")
    writing.add_argument(
        "--format",
        default="label",
        metavar="FORMAT",
        help="label: one uint32 per point; u8: one uint8 per point, as a NumPy array (default: label)",
    )
    writing.add_argument(
        "--label-map",
        default="flagstone",
        metavar="NAME",
        help="codes in the label files: flagstone (0 to 4), or semantic-kitti (40 for ground, 0 otherwise)",
    )
    writing.add_argument("--overwrite", action="store_true", help="label all scans again, including finished ones")

    cluster = parser.add_argument_group("Cluster")
    cluster.add_argument(
        "--address",
        metavar="ADDRESS",
        help="Ray cluster to join (default: RAY_ADDRESS, otherwise Ray is started on this machine)",
    )
    cluster.add_argument("--workers", type=int, metavar="N", help="number of cores to use (default: all)")

    other = parser.add_argument_group("Other")
    other.add_argument("--version", action="version", version=flagstone.__version__, help="show the version")
    other.add_argument("-h", "--help", action="help", help="show this help")
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Runs the command.

    Args:
        arguments: Command-line arguments without the program name; by default the arguments of the process.

    Returns:
        Exit code: 0, success; 1, some scans failed; 2, usage error.
    """
    options = make_parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        segmenter = flagstone.make_segmenter(
            options.method,
            sensor=options.sensor,
            sensor_height=options.sensor_height,
            tilt=None if options.tilt is None else up(options.tilt),
            preset=options.preset,
            config=options.config,
            **settings(options.set),
        )
        summary = segment(
            options.source,
            options.output,
            segmenter=segmenter,
            format=options.format,
            label_map=options.label_map,
            columns=options.columns,
            overwrite=options.overwrite,
            address=options.address,
            workers=options.workers,
        )
    except (ValueError, TypeError, FileNotFoundError, ImportError, ConnectionError) as error:
        return fail(error, USAGE_ERROR)
    except (OSError, RuntimeError) as error:
        return fail(error, SOME_FAILED)
    except Interrupted as interrupt:
        print(interrupt.summary)
        return fail(interrupt, SOME_FAILED)
    except KeyboardInterrupt:
        return fail("interrupted before the first scan", SOME_FAILED)
    print(summary)
    return SOME_FAILED if summary.failures else SUCCESS


def fail(error: object, code: int) -> int:
    """Prints an error in one line and returns the exit code."""
    print(f"flagstone-ray: {error}", file=sys.stderr)
    return code


def up(text: str) -> Any:
    """Parses X,Y,Z. A word is returned unchanged, for the segmenter to check.

    Raises:
        ValueError: The text is neither.
    """
    if text.isalpha():
        return text
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f"--tilt: '{text}' is not a direction (expected three numbers X,Y,Z)") from None
    return x, y, z


def settings(assignments: list[str]) -> dict[str, Any]:
    """Converts KEY=VALUE to arguments of `flagstone.make_segmenter`, for example a.b=1 to {"a": {"b": 1}}.

    Raises:
        ValueError: The equals sign is missing.
    """
    found: dict[str, Any] = {}
    for assignment in assignments:
        key, equals, text = assignment.partition("=")
        if not equals:
            raise ValueError(f"--set: '{assignment}' is not an assignment (expected KEY=VALUE)")
        *tables, name = key.strip().split(".")
        table = found
        for part in tables:
            table = table.setdefault(part, {})
        table[name] = value(text.strip())
    return found


def value(text: str) -> Any:
    """Parses a value in TOML syntax: a boolean, number, string or list."""
    if text in ("true", "false"):
        return text == "true"
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return text


if __name__ == "__main__":
    sys.exit(main())
