# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Mean F1 of pypatchworkpp's two methods on KITTI scans, under both protocols of src/eval/protocol.cpp.

    python3 -m pip install numpy pypatchworkpp==1.4.1
    python3 bench/peer_accuracy.py $FLAGSTONE_DATA/kitti/labels $FLAGSTONE_DATA/kitti/velodyne/0[08]-*.bin
"""

import pathlib
import sys

import numpy as np
import pypatchworkpp

SENSOR_HEIGHT = 1.73
GROUND = [40, 44, 48, 49, 60, 72]


def truth(protocol, z, classes):
    """Two masks over the points: which are ground, which are scored."""
    ground = np.isin(classes, GROUND)
    if protocol == "patchwork":
        return ground | ((classes == 70) & (z < -1.3)), np.ones(len(z), bool)
    return ground, ~np.isin(classes, [0, 1, 70])


def ground_mask(method, points):
    if method == "patchwork":
        parameters = pypatchworkpp.PatchworkParams()
        make = pypatchworkpp.patchwork
    else:
        parameters = pypatchworkpp.Parameters()
        make = pypatchworkpp.patchworkpp
    parameters.sensor_height = SENSOR_HEIGHT
    parameters.verbose = False
    segmenter = make(parameters)
    segmenter.estimateGround(points)
    mask = np.zeros(len(points), bool)
    mask[segmenter.getGroundIndices()] = True
    return mask


def scores(found, ground, scored):
    hits = (found & ground & scored).sum()
    precision = hits / (found & scored).sum()
    recall = hits / (ground & scored).sum()
    return 100 * np.array([precision, recall, 2 * precision * recall / (precision + recall)])


def main(labels, scans):
    for method in ["patchwork", "patchworkpp"]:
        rows = {"patchwork": [], "patchwork++": []}
        for scan in map(pathlib.Path, scans):
            points = np.fromfile(scan, np.float32).reshape(-1, 4)
            classes = np.fromfile(pathlib.Path(labels) / f"{scan.stem}.label", np.uint32) & 0xFFFF
            found = ground_mask(method, points)
            for protocol, row in rows.items():
                row.append(scores(found, *truth(protocol, points[:, 2], classes)))
        for protocol, row in rows.items():
            precision, recall, f1 = np.mean(row, axis=0)
            print(
                f"pypatchworkpp {method:<12} protocol {protocol:<12} precision {precision:6.2f}"
                f"  recall {recall:6.2f}  F1 {f1:6.2f}  (mean of {len(row)} scans, %)"
            )


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
