# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The metrics of `flagstone eval` agree with scikit-learn on a real scan.

    python3 scikit_learn_test.py FLAGSTONE DATA    DATA: the directory of real scans, unless FLAGSTONE_DATA is set

Exits with 77, which ctest treats as skipped, if scikit-learn or the scans are not available.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77

try:
    import numpy as np
    from sklearn import metrics
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(SKIPPED)

GROUND = [40, 44, 48, 49, 60, 72]
PROTOCOLS = {
    "patchwork": lambda classes, z: (np.isin(classes, GROUND) | ((classes == 70) & (z < -1.3)), classes >= 0),
    "patchwork++": lambda classes, z: (np.isin(classes, GROUND), ~np.isin(classes, [0, 1, 70])),
}
METRICS = {
    "precision": metrics.precision_score,
    "recall": metrics.recall_score,
    "f1": metrics.f1_score,
    "accuracy": metrics.accuracy_score,
    "iou": metrics.jaccard_score,
}


def run(*command):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)


def area_weights(xy, scored):
    """Weights for which each 0.5 m BEV cell within 80 m counts once."""
    cells = np.floor(xy.astype(np.float64) / 0.5).astype(int)
    weights = scored & (np.abs(xy) < 80).all(axis=1)
    _, cell, count = np.unique(cells[weights], axis=0, return_inverse=True, return_counts=True)
    shares = np.zeros(len(xy))
    shares[weights] = 1 / count[cell.ravel()]
    return shares


def expected(truth, found, scored, points):
    """The metrics of one scan, computed by scikit-learn."""
    values = {name: score(truth[scored], found[scored]) for name, score in METRICS.items()}
    weights = area_weights(points[:, :2], scored)
    counted = weights > 0
    values["by_area"] = metrics.f1_score(truth[counted], found[counted], sample_weight=weights[counted])
    range_ = np.hypot(points[:, 0], points[:, 1])
    for low, high in ((0, 10), (10, 20), (20, 40), (40, 80)):
        band = scored & (range_ >= low) & (range_ < high)
        values[f"{low}-{high}"] = metrics.f1_score(truth[band], found[band])
    return values


def printed(result):
    method = result["methods"][0]
    values = {name: method[name]["mean"] for name in METRICS}
    values["by_area"] = method["by_area"]["f1"]
    for band in method["by_range"]:
        values[f"{band['from']:.0f}-{band['to']:.0f}"] = band["f1"]
    return values


def main(flagstone, data):
    scan, labels = data / "kitti/velodyne/00-000005.bin", data / "kitti/labels/00-000005.label"
    if not scan.exists():
        print(f"skipped: no {scan}")
        return SKIPPED
    points = np.fromfile(scan, np.float32).reshape(-1, 4)
    classes = np.fromfile(labels, np.uint32) & 0xFFFF
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, source in (("velodyne", scan), ("labels", labels)):
            (folder / "set" / name).mkdir(parents=True)
            (folder / "set" / name / source.name).symlink_to(source.resolve())
        run(flagstone, "segment", scan, "--output", folder / "out")
        found = np.fromfile(folder / "out" / labels.name, np.uint32) == 1
        for protocol, classify in PROTOCOLS.items():
            run(flagstone, "eval", folder / "set", "--protocol", protocol, "--json", folder / "r.json")
            truth, scored = classify(classes, points[:, 2])
            ours = printed(json.loads((folder / "r.json").read_text()))
            for name, value in expected(truth, found, scored, points).items():
                agrees = abs(ours[name] - value) < 1e-6
                wrong += not agrees
                print(f"{protocol:<12} {name:<10} {ours[name]:.8f} {value:.8f} {'' if agrees else 'DIFFER'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(os.environ.get("FLAGSTONE_DATA") or sys.argv[2])))
