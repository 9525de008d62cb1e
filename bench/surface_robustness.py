# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""What `surface` and `patchwork` lose when the sensor stands otherwise or sees less than they are told.

Every disturbed copy of a scan is scored beside the labels that the same method gave to the same points of the
whole, undisturbed scan: what differs is due to the disturbance, not to which points are left.
"""

import pathlib
import tempfile

from flagstone_runs import show_progress
from intervals import mean_of, paired
from tables import percent, points_more, table

METHODS = ("surface", "patchwork")


def measure_robustness(study):
    # Not above: tables are written and checked without NumPy.
    from surface_disturbances import DISTURBANCES, HEIGHT, write_copies

    with tempfile.TemporaryDirectory(prefix="flagstone-robustness-") as place:
        place = pathlib.Path(place)
        for method in METHODS:
            settings = "".join(f" --set {setting}" for setting in study.settings if method == "surface")
            study.call(
                f"flagstone segment $WORK/kitti/velodyne --method {method} --sensor-height {HEIGHT}{settings}"
                f" --output {place}/before/{method}"
            )
        rows = []
        for number, disturbance in enumerate(DISTURBANCES):
            show_progress(f"robustness {number + 1} of {len(DISTURBANCES)}: {disturbance.name}")
            folder = place / f"disturbed-{number}"
            write_copies(study.work / "kitti", place / "before", METHODS, disturbance.disturb, folder)
            arguments = f"{folder} --protocol patchwork++ --sensor-height {disturbance.sensor_height:g}"
            arguments += "".join(f" --labels before-{method}={folder / method}" for method in METHODS)
            result = study.evaluate_command(study.command(arguments, METHODS))
            rows.append({"disturbance": disturbance.name, **row_of(result)})
    return {"rows": rows}


def row_of(result):
    """By method: F1 and by how much it differs from that of the undisturbed scan."""
    methods = {method["name"]: method for method in result["methods"]}
    row = {}
    for method in METHODS:
        now, before = methods[method], methods[f"before-{method}"]
        differences = {scan["scan"]: scan["f1"] for scan in now["per_scan"]}
        for scan in before["per_scan"]:
            differences[scan["scan"]] -= scan["f1"]
        row[method] = {
            "f1": mean_of([scan["f1"] for scan in now["per_scan"]]),
            "difference": paired(now, before, "f1"),
            "worst": min(differences.values()),
        }
    return row


def robustness_table(results):
    rows = [
        [
            row["disturbance"],
            *(
                text
                for method in METHODS
                for text in (
                    percent(row[method]["f1"]["mean"]),
                    points_more(row[method]["difference"]),
                    f"{round(100 * row[method]['worst'], 2) + 0.0:+.2f}",
                )
            ),
        ]
        for row in results["rows"]
    ]
    head = [
        "disturbed",
        *(text for method in METHODS for text in (f"`{method}`: F1", "change", "worst scan")),
    ]
    return table(head, rows)
