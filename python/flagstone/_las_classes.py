# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The classes of the ASPRS LAS specification, and which of them a segmentation sets."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

NEVER_CLASSIFIED = 0
UNCLASSIFIED = 1
GROUND = 2
LOW_POINT = 7

default_may_change = (NEVER_CLASSIFIED, UNCLASSIFIED, GROUND, LOW_POINT)
"""All that says nothing but ground, noise or neither: what others found (plants, buildings, water) stays."""

_nonground, _ground, _noise = 0, 1, 2  # codes of flagstone.Label that judge a point
_label_count = 5


def class_table(may_change: Iterable[int]) -> npt.NDArray[np.uint8]:
    """Which class a point gets by its label and the class it has: a table of shape (5, 256).

    Raises:
        ValueError: A class is not 0 to 255.
    """
    table = np.tile(np.arange(256, dtype=np.uint8), (_label_count, 1))
    for changeable in may_change:
        code = _class_code(changeable)
        table[_ground, code] = GROUND
        table[_noise, code] = LOW_POINT
        if code in (NEVER_CLASSIFIED, GROUND, LOW_POINT):
            table[_nonground, code] = UNCLASSIFIED
    return table


def classes_from_labels(
    classes: npt.NDArray[Any], labels: npt.NDArray[Any], may_change: Iterable[int] = default_may_change
) -> npt.NDArray[np.uint8]:
    """The classes of points after a segmentation; both arrays of shape (N,)."""
    wrong = (classes < 0) | (classes > 255) | (classes != np.rint(classes))
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(f"classification of point {first} is {classes[first]}; LAS holds whole numbers of 0 to 255")
    after: npt.NDArray[np.uint8] = class_table(may_change)[checked_labels(labels), classes.astype(np.uint8)]
    return after


def checked_labels(labels: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """Codes of `flagstone.Label` as uint8.

    Raises:
        TypeError: They are no integers.
        ValueError: One is not 0 to 4, or they are not in one row.
    """
    array = np.asarray(labels)
    if array.dtype.kind not in "iu":
        raise TypeError(f"labels: an array of {array.dtype} came; wanted codes of flagstone.Label, integers of 0 to 4")
    if array.ndim != 1:
        raise ValueError(f"labels: an array of shape {array.shape} came; wanted (N,), one code a point")
    wrong = (array < 0) | (array >= _label_count)
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(f"labels: that of point {first} is {array[first]}; wanted codes of flagstone.Label, 0 to 4")
    return array.astype(np.uint8, copy=False)


def _class_code(value: int) -> int:
    try:
        code = operator.index(value)
    except TypeError:
        code = -1
    if not 0 <= code <= 255:
        raise ValueError(f"may_change: {value!r} is no class of LAS; wanted whole numbers of 0 to 255")
    return code
