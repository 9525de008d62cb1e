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

ALL_DONE, SOME_FAILED, WRONG_USAGE = 0, 1, 2

EXAMPLES = """\
examples:
  flagstone-ray scans/ --output labels/
  flagstone-ray s3://bucket/scans --output s3://bucket/labels --address auto
  flagstone-ray scans/ --in-place --method patchwork --sensor hdl-32e --set distance_margin=0.1

Run again, it does what is left. Exit codes: 0 all done, 1 some scans failed, 2 wrong usage.
"""


def make_parser() -> argparse.ArgumentParser:
    """The options; names and meanings are those of `flagstone segment`."""
    parser = argparse.ArgumentParser(
        prog="flagstone-ray",
        description="Label every point of all scans of a folder or bucket, on this machine or on a Ray cluster.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("source", help="folder of scans, or one scan: a path, or a URL such as s3://bucket/scans")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("-o", "--output", metavar="DIR", help="folder or URL for the labels, mirrors the source")
    where.add_argument("--in-place", action="store_true", help="write the labels next to the scans")
    parser.add_argument("--method", default="surface", metavar="NAME", help="how to segment; default: surface")
    parser.add_argument("--preset", default="default", metavar="NAME", help="settings patchwork starts from")
    parser.add_argument("--sensor", metavar="NAME|FILE", help="derive settings from this sensor")
    parser.add_argument("--config", metavar="FILE", help="TOML file of settings, as `flagstone config` prints")
    parser.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", help="one setting, e.g. point.margin=0.2; may repeat"
    )
    parser.add_argument("--sensor-height", type=float, metavar="M", help="metres of the sensor above the ground")
    parser.add_argument("--tilt", metavar="X,Y,Z", help="where up is for a sensor that leans")
    parser.add_argument(
        "--format", default="label", metavar="label|u8", help="uint32 each, or uint8 each in a NumPy file"
    )
    parser.add_argument(
        "--label-map", default="flagstone", metavar="flagstone|semantic-kitti", help="codes in the label files"
    )
    parser.add_argument("--columns", type=int, metavar="N", help="floats a point in .bin files")
    parser.add_argument("--overwrite", action="store_true", help="label all scans again, finished ones too")
    parser.add_argument("--address", help="Ray cluster to join; default: RAY_ADDRESS, or Ray started for this run")
    parser.add_argument("--workers", type=int, metavar="N", help="cores to use; default: all")
    parser.add_argument("--version", action="version", version=flagstone.__version__)
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Runs the command.

    Args:
        arguments: What stands behind the command's name; None: as the shell gave it.

    Returns:
        The exit code: 0 all done, 1 some scans failed, 2 wrong usage.
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
        return fail(error, WRONG_USAGE)
    except (OSError, RuntimeError) as error:
        return fail(error, SOME_FAILED)
    except Interrupted as interrupt:
        print(interrupt.summary)
        return fail(interrupt, SOME_FAILED)
    except KeyboardInterrupt:
        return fail("interrupted before the first scan", SOME_FAILED)
    print(summary)
    return SOME_FAILED if summary.failures else ALL_DONE


def fail(error: object, code: int) -> int:
    """Says in one line what is wrong."""
    print(f"flagstone-ray: {error}", file=sys.stderr)
    return code


def up(text: str) -> Any:
    """Where up is, of X,Y,Z; a word as it stands, for the segmenter to judge.

    Raises:
        ValueError: It is neither.
    """
    if text.isalpha():
        return text
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f"--tilt {text}: is not three numbers X,Y,Z") from None
    return x, y, z


def settings(assignments: list[str]) -> dict[str, Any]:
    """KEY=VALUE as arguments of `flagstone.make_segmenter`, a.b=1 as {"a": {"b": 1}}.

    Raises:
        ValueError: There is no equals sign.
    """
    found: dict[str, Any] = {}
    for assignment in assignments:
        key, equals, text = assignment.partition("=")
        if not equals:
            raise ValueError(f"--set {assignment}: is not KEY=VALUE")
        *tables, name = key.strip().split(".")
        table = found
        for part in tables:
            table = table.setdefault(part, {})
        table[name] = value(text.strip())
    return found


def value(text: str) -> Any:
    """A value as TOML writes it: true, a number, a string, a list."""
    if text in ("true", "false"):
        return text == "true"
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return text


if __name__ == "__main__":
    sys.exit(main())
