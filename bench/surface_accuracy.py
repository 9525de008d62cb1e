# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""How accurate `surface` is beside `patchwork` and the baselines, by range and by area, and how its heights are."""

import statistics

from flagstone_runs import show_progress
from intervals import mean_of, paired
from surface_scans import per_scan
from tables import percent, points_more, table, with_interval

METHODS = ["surface", "patchwork", "ransac", "gpf", "line_fit", "cascaded", "r_gpf", "r_gpf+u"]
BANDS = ["0–10 m", "10–20 m", "20–40 m", "40–80 m"]
HEIGHT_BANDS = [(0, 20), (20, 40), (40, 80)]


def measure_accuracy(study):
    """By set of scans: `methods`, and by how much `surface` exceeds `patchwork`."""
    found = {}
    for name in study.sets:
        show_progress(f"accuracy {len(found) + 1} of {len(study.sets)}: {name}")
        results = study.evaluate(name, METHODS)
        found[name] = {
            "commands": [result["command"] for result in results],
            "methods": [method_row(results, method) for method in METHODS],
            "over_patchwork": over_patchwork(results),
        }
    return found


def method_row(results, method):
    entries = [entry for result in results for entry in result["methods"] if entry["name"] == method]
    scans = per_scan(results, method)["per_scan"]
    return {
        "name": method,
        **{
            figure: mean_of([scan[figure] for scan in scans])
            for figure in ("precision", "recall", "f1", "iou")
        },
        # Pooled over the scans that were evaluated together, then the mean.
        "by_range": [
            mean_if_any([entry["by_range"][band]["f1"] for entry in entries]) for band in range(len(BANDS))
        ],
        "by_area": mean_if_any([entry["by_area"]["f1"] for entry in entries]),
    }


def mean_if_any(values):
    known = [value for value in values if value is not None]
    return statistics.fmean(known) if known else None


def over_patchwork(results):
    ours, theirs = (per_scan(results, method) for method in ("surface", "patchwork"))
    f1 = {scan["scan"]: scan["f1"] for scan in theirs["per_scan"]}
    return {
        **{figure: paired(ours, theirs, figure) for figure in ("precision", "recall", "f1")},
        "better": sum(scan["f1"] > f1[scan["scan"]] for scan in ours["per_scan"]),
    }


def measure_heights(study):
    """By simulated scene: errors of heights, of points of the ground and of all."""
    found = {}
    for name, scans in study.sets.items():
        if not scans.simulated:
            continue
        show_progress(f"heights of {name}")
        result = study.evaluate(name)[0]
        heights = result["methods"][0]["heights"]
        found[name] = {
            "command": result["command"],
            "ground": heights["ground"],
            "everywhere": heights["everywhere"],
        }
    return found


# --- tables ------------------------------------------------------------------------------------------------


def accuracy_tables(results, titles):
    """One table a set of scans, and the differences to `patchwork` over all of them."""
    found = {}
    for name, title in titles.items():
        found[f"accuracy-{name}"] = accuracy_table(results[name], title["title"], results["made_by"])
    found["over-patchwork"] = over_patchwork_table(results, titles)
    return found


def accuracy_table(result, title, made_by):
    best = max(method["f1"]["mean"] for method in result["methods"])
    rows = [
        [
            f"`{method['name']}`",
            percent(method["precision"]["mean"]),
            percent(method["recall"]["mean"]),
            bold_if(method["f1"]["mean"] == best, with_interval(method["f1"])),
            percent(method["iou"]["mean"]),
            *(percent(band) for band in method["by_range"]),
            percent(method["by_area"]),
        ]
        for method in result["methods"]
    ]
    head = [title, "P", "R", "F1 ± 95 %", "IoU", *BANDS, "by area"]
    commands = "\n".join(f"    {command}" for command in result["commands"])
    scans = result["over_patchwork"]["f1"]["scans"]
    return f"{table(head, rows)}\n\n{scans} scans, {made_by['date']}, {made_by['machine']}:\n\n{commands}"


def bold_if(condition, text):
    return f"**{text}**" if condition else text


def over_patchwork_table(results, titles):
    rows = []
    for name, title in titles.items():
        over = results[name]["over_patchwork"]
        rows.append(
            [
                title["title"],
                *(points_more(over[figure]) for figure in ("precision", "recall", "f1")),
                f"{over['better']} of {over['f1']['scans']}",
            ]
        )
    return table(["`surface` less `patchwork`, points", "P", "R", "F1", "F1 better in"], rows)


def heights_table(results, titles, points):
    """Of points of the `ground`, or `everywhere`."""
    rows = []
    for name, title in titles.items():
        if not title["simulated"]:
            continue
        heights = results[name][points]
        bands = {(band["from"], band["to"]): band for band in heights["by_range"]}
        rows.append(
            [
                title["title"],
                *(
                    centimetres(bands[band][figure]["mean"])
                    for band in HEIGHT_BANDS
                    for figure in ("median", "percentile95", "bias")
                ),
                percent(heights["with_height"], 1),
            ]
        )
    head = [
        "cm",
        *(text for low, high in HEIGHT_BANDS for text in (f"{low}–{high} m: median", "95 %", "bias")),
        "with a height, %",
    ]
    return table(head, rows)


def centimetres(metres):
    return "–" if metres is None else f"{100 * metres:.1f}"
