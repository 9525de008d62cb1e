# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures the methods in every simulated world with every sensor, and writes the tables of docs/robustness.md.

    python3 bench/worlds_study.py run --work /tmp/worlds                  # all of it
    python3 bench/worlds_study.py run --work /tmp/worlds --only faults
    python3 bench/worlds_study.py page                                    # tables and picture, from docs/results/worlds.json
    python3 bench/worlds_study.py check                                   # are the page's tables those of the results?

`run` wants the command built (build/flagstone). The first time it simulates all worlds in the work folder (some
GB, half an hour on two cores); later runs keep them. `faults` wants NumPy, the picture wants Matplotlib.
"""

import argparse
import json
import pathlib
import sys

import worlds_faults
import worlds_settings
from flagstone_runs import ROOT, Runs, show_progress
from tables import check, filled, rounded

PAGE = ROOT / "docs" / "robustness.md"
RESULTS = ROOT / "docs" / "results" / "worlds.json"
PICTURE = ROOT / "docs" / "images" / "worlds-f1.png"

MEASUREMENTS = {"settings": worlds_settings.measure_settings, "faults": worlds_faults.measure_faults}
TABLES = {"settings": worlds_settings.settings_tables, "faults": worlds_faults.faults_tables}


def tables(results):
    """Every table of what was measured, by name."""
    found = {}
    for name, make in TABLES.items():
        if name in results:
            found |= make(results[name])
    return found


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="measure, write results, page and picture")
    run.add_argument("--work", type=pathlib.Path, required=True, help="folder for what is large")
    run.add_argument("--flagstone", type=pathlib.Path, default=ROOT / "build" / "flagstone")
    run.add_argument("--only", nargs="+", choices=list(MEASUREMENTS), default=list(MEASUREMENTS))
    commands.add_parser("page", help="write the page's tables and draw the picture from the results")
    commands.add_parser("check", help="fail if the page's tables are not those of the results")
    options = parser.parse_args()

    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    if options.command == "run":
        runs = Runs(options.work.resolve(), options.flagstone.resolve())
        for name in options.only:
            results[name] = {**rounded(MEASUREMENTS[name](runs)), "made_by": dict(runs.made_by)}
            RESULTS.write_text(json.dumps(results, indent=1) + "\n")
        show_progress("")
    if options.command == "check":
        check(PAGE, tables(results))
    PAGE.write_text(filled(PAGE.read_text(), tables(results)))
    if "settings" in results:
        # Not above: the page is checked without Matplotlib.
        from worlds_picture import draw

        draw(results["settings"], PICTURE)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
