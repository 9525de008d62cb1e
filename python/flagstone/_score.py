# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Comparison of the labels of one scan with ground truth, in memory."""

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
    """Labels compared with ground truth: numbers of points, and ratios from 0 to 1.

    Undefined ratios are NaN. If the ground truth contains no ground, only the accuracy is defined. If no point is
    labelled ground, the precision is undefined.

    Attributes:
        true_positives: Ground points labelled ground.
        false_positives: Other points labelled ground.
        false_negatives: Ground points not labelled ground.
        true_negatives: Other points not labelled ground.
    """

    true_positives: int
    false_positives: int
    false_negatives: int
    true_negatives: int

    @property
    def precision(self) -> float:
        """Fraction of the points labelled ground that are ground, 0 to 1."""
        return self._of_ground(self.true_positives, self.true_positives + self.false_positives)

    @property
    def recall(self) -> float:
        """Fraction of the ground points that are labelled ground, 0 to 1."""
        return self._of_ground(self.true_positives, self.true_positives + self.false_negatives)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall, 0 to 1."""
        both = 2 * self.true_positives
        return self._of_ground(both, both + self.false_positives + self.false_negatives)

    @property
    def accuracy(self) -> float:
        """Fraction of the points that are labelled correctly, 0 to 1."""
        correct = self.true_positives + self.true_negatives
        return _ratio(correct, correct + self.false_positives + self.false_negatives)

    @property
    def iou(self) -> float:
        """Intersection over union of the ground class, 0 to 1."""
        return self._of_ground(self.true_positives, self.true_positives + self.false_positives + self.false_negatives)

    def _of_ground(self, part: int, whole: int) -> float:
        return _ratio(part, whole if self.true_positives + self.false_negatives else 0)


def score(labels: npt.ArrayLike, classes: npt.ArrayLike, points: PointsLike, *, protocol: str = "patchwork") -> Score:
    """Scores the labels of one scan, as `flagstone eval` scores each of its scans.

    Args:
        labels: (N,) codes of `Label`, integers 0 to 4. All codes except 1 count as not ground.
        classes: (N,) ground-truth classes, integers 0 to 65,535, as `flagstone.io.read_labels` returns them.
        points: (N, >=3) x, y, z in metres, or any other points that `segment` accepts. Protocol `patchwork` uses z.
        protocol: `"patchwork"`, `"patchwork++"`, `"simulation"` or `"lidarseg"`. The protocol defines the ground
            classes and the classes that are not scored.

    Returns:
        Numbers of points, with precision, recall, F1, accuracy and IoU; undefined ratios are NaN.

    Raises:
        TypeError: Labels or classes are not integers.
        ValueError: The lengths differ, the protocol is unknown, or a label or class is out of range.
    """
    codes = np.ascontiguousarray(_integers("labels", labels, 4), np.uint8)
    truth = np.ascontiguousarray(_integers("classes", classes, 0xFFFF), np.uint32)
    return Score(*map(int, _core.score(codes, truth, *columns_of(points), protocol)))


def _ratio(part: int, whole: int) -> float:
    return math.nan if whole == 0 else part / whole


def _integers(name: str, values: npt.ArrayLike, maximum: int) -> npt.NDArray[Any]:
    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: dtype {array.dtype} is not supported (expected integers from 0 to {maximum:,})")
    if array.ndim != 1:
        raise ValueError(f"{name}: shape {array.shape} is not supported (expected (N,), one per point)")
    if array.size and not 0 <= array.min() <= array.max() <= maximum:
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"{name}: {wrong} is out of range (expected integers from 0 to {maximum:,})")
    return array
