# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels of one scan against its classes, in memory."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from flagstone import _core
from flagstone._points import PointsLike, columns_of


@dataclass(frozen=True)
class Score:
    """How labels compare with the reference classes: counts of points, and ratios from 0 to 1.

    Without ground in the reference only the accuracy is defined, without points labelled ground the precision is not
    defined either: ratios that are not defined are NaN.

    Attributes:
        true_positives: Ground that was labelled ground.
        false_positives: Other points that were labelled ground.
        false_negatives: Ground that was not.
        true_negatives: Other points that were not.
    """

    true_positives: int
    false_positives: int
    false_negatives: int
    true_negatives: int

    @property
    def precision(self) -> float:
        """Share of ground among what was labelled ground, 0 to 1."""
        return self._of_ground(self.true_positives, self.true_positives + self.false_positives)

    @property
    def recall(self) -> float:
        """Share of the ground that was labelled ground, 0 to 1."""
        return self._of_ground(self.true_positives, self.true_positives + self.false_negatives)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall, 0 to 1."""
        both = 2 * self.true_positives
        return self._of_ground(both, both + self.false_positives + self.false_negatives)

    @property
    def accuracy(self) -> float:
        """Share of the points that are right, 0 to 1."""
        right = self.true_positives + self.true_negatives
        return _share(right, right + self.false_positives + self.false_negatives)

    @property
    def iou(self) -> float:
        """Intersection over union of ground, 0 to 1."""
        return self._of_ground(self.true_positives, self.true_positives + self.false_positives + self.false_negatives)

    def _of_ground(self, part: int, whole: int) -> float:
        return _share(part, whole if self.true_positives + self.false_negatives else 0)


def score(labels: npt.ArrayLike, classes: npt.ArrayLike, points: PointsLike, *, protocol: str = "patchwork") -> Score:
    """Scores the labels of one scan, as `flagstone eval` scores each of its scans.

    Args:
        labels: (N,) codes of `Label`, 0 to 4; all but 1 count as not ground.
        classes: (N,) reference classes, as `flagstone.io.read_labels` gives them.
        points: (N, >=3) x, y, z, metres, or what else `segment` takes; protocol `patchwork` asks for their heights.
        protocol: `"patchwork"`, `"patchwork++"`, `"simulation"` or `"lidarseg"`: which classes are ground, and which
            are not scored.

    Returns:
        Counts of points, with precision, recall, F1, accuracy and IoU; NaN if they are not defined.

    Raises:
        TypeError: Labels or classes are no integers.
        ValueError: Lengths differ, the protocol is not known, or a label or class is none.
    """
    codes = np.ascontiguousarray(_whole("labels", labels, 4), np.uint8)
    truth = np.ascontiguousarray(_whole("classes", classes, 0xFFFF), np.uint32)
    return Score(*map(int, _core.score(codes, truth, *columns_of(points), protocol)))


def _share(part: int, whole: int) -> float:
    return math.nan if whole == 0 else part / whole


def _whole(name: str, values: npt.ArrayLike, most: int) -> npt.NDArray[Any]:
    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: an array of {array.dtype} came; wanted are whole numbers of 0 to {most:,}")
    if array.ndim != 1:
        raise ValueError(f"{name}: shape {array.shape}; wanted is (N,), one a point")
    if array.size and not 0 <= array.min() <= array.max() <= most:
        raise ValueError(
            f"{name}: reach from {array.min()} to {array.max()}; wanted are whole numbers of 0 to {most:,}"
        )
    return array
