# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Measures the method `surface` and writes the tables of docs/surface.md. Wants Python 3.11 and NumPy.

    python3 bench/surface_study.py run --work /tmp/study               # all of it, some ten minutes
    python3 bench/surface_study.py run --work /tmp/study --only robustness
    python3 bench/surface_study.py try --work /tmp/study --only ablation --set point.margin=0.15
    python3 bench/surface_study.py page                                # the tables, from docs/results/surface.json
    python3 bench/surface_study.py check                               # are the page's tables those of the results?

`run` wants the command built (build/flagstone) and the real scans in FLAGSTONE_DATA. The first time it simulates
six sequences of 200 scans in the work folder (4 GB, some minutes); later runs keep them. `try` prints tables and
writes nothing: the settings of --set hold throughout, for the rows with nothing changed too. Tables stand in the
page between <!-- table NAME --> and <!-- end -->.
"""

import argparse
import json
import pathlib
import sys

import surface_ablation
import surface_accuracy
import surface_errors
import surface_robustness
from flagstone_runs import ROOT, show_progress
from surface_scans import Study
from tables import check, filled, rounded

PAGE = ROOT / "docs" / "surface.md"
RESULTS = ROOT / "docs" / "results" / "surface.json"

# What is measured, by name: makes results that JSON can hold.
MEASUREMENTS = {
    "ablation": surface_ablation.measure_ablation,
    "settings": surface_ablation.measure_settings,
    "accuracy": surface_accuracy.measure_accuracy,
    "heights": surface_accuracy.measure_heights,
    "errors": surface_errors.measure_errors,
    "true_heights": surface_errors.measure_true_heights,
    "robustness": surface_robustness.measure_robustness,
}
ON_REAL_SCANS_ALONE = {"errors", "robustness"}


def tables(results):
    """Every table of what was measured, by name."""
    sets = results["sets"]
    found = {}
    if "ablation" in results:
        found["ablation-real"] = surface_ablation.ablation_table(results["ablation"], sets, simulated=False)
        found["ablation-simulated"] = surface_ablation.ablation_table(
            results["ablation"], sets, simulated=True
        )
    if "settings" in results:
        found["settings"] = surface_ablation.settings_table(results["settings"])
        found["settings-effect"] = surface_ablation.effects_table(results["settings"], sets)
    if "accuracy" in results:
        found |= surface_accuracy.accuracy_tables(results["accuracy"], sets)
    if "heights" in results:
        for points in ("ground", "everywhere"):
            found[f"heights-{points}"] = surface_accuracy.heights_table(results["heights"], sets, points)
    if "errors" in results:
        titles = {"kitti": "KITTI `patchwork++`", "nuscenes": "nuScenes", "livox": "Livox"}
        found["errors"] = surface_errors.errors_table(results["errors"], titles)
    if "true_heights" in results:
        found["true-heights"] = surface_errors.true_heights_table(results["true_heights"])
    if "robustness" in results:
        found["robustness"] = surface_robustness.robustness_table(results["robustness"])
    return found


def measure(study, names):
    """Results by name, and of which sets of scans."""
    if set(names) - ON_REAL_SCANS_ALONE:
        study.simulate()
    results = {
        "sets": {
            name: {"title": scans.title, "simulated": scans.simulated, "arguments": list(scans.arguments)}
            for name, scans in study.sets.items()
        }
    }
    for name in names:
        results[name] = {**rounded(MEASUREMENTS[name](study)), "made_by": dict(study.made_by)}
    show_progress("")
    return results


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    measured = argparse.ArgumentParser(add_help=False)
    measured.add_argument("--work", type=pathlib.Path, required=True, help="folder for what is large")
    measured.add_argument("--flagstone", type=pathlib.Path, default=ROOT / "build" / "flagstone")
    measured.add_argument(
        "--only", nargs="+", choices=list(MEASUREMENTS), default=list(MEASUREMENTS), help="default: all"
    )
    commands.add_parser("run", parents=[measured], help="measure, write results and page")
    try_command = commands.add_parser("try", parents=[measured], help="measure, print the tables")
    try_command.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="of surface")
    commands.add_parser("page", help="write the page's tables from the results")
    commands.add_parser("check", help="fail if the page's tables are not those of the results")
    options = parser.parse_args()

    if options.command == "try":
        study = Study(options.work.resolve(), options.flagstone.resolve(), options.set)
        for name, text in tables(measure(study, options.only)).items():
            print(f"{name}\n\n{text}\n")
        return
    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    if options.command == "run":
        results |= measure(Study(options.work.resolve(), options.flagstone.resolve()), options.only)
        RESULTS.write_text(json.dumps(results, indent=1) + "\n")
    if options.command == "check":
        check(PAGE, tables(results))
    PAGE.write_text(filled(PAGE.read_text(), tables(results)))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("\ninterrupted")
