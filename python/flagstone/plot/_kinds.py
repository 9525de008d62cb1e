# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Points that look alike in a picture and share an entry of its legend."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from flagstone._palette import LABELS, Color, in_words
from flagstone.codes import Label
from flagstone.segmentation import Segmentation


class Kind(NamedTuple):
    """Which points look so."""

    name: str
    color: Color
    mask: npt.NDArray[np.bool_]
    """(N,): true for its points."""
    size: float = 1
    """Diameter relative to that of ordinary points."""


def labels_of(result: Segmentation | npt.ArrayLike, points: int) -> npt.NDArray[np.uint8]:
    """(N,): codes of labels, from a result or from what another program says.

    Raises:
        ValueError: They are not as many as the points, or other codes.
    """
    labels = result.labels if isinstance(result, Segmentation) else np.asarray(result)
    if labels.shape != (points,):
        raise ValueError(
            f"result: labels of shape {labels.shape} for {points} points; pass what segmenting these points gave"
        )
    if labels.dtype.kind not in "bui" or not np.isin(labels, list(Label)).all():
        raise ValueError(f"result: {labels.dtype} that are no labels; wanted are codes of 0 to 4, or a mask of ground")
    return labels.astype(np.uint8)


def by_label(labels: npt.NDArray[np.uint8]) -> list[Kind]:
    """Kinds by label, in the order of drawing: what comes later lies on top."""
    order = (Label.OUT_OF_RANGE, Label.GROUND, Label.NONGROUND, Label.NOISE)
    sizes = {Label.NOISE: 1.3}
    return [Kind(in_words(label), LABELS[label], labels == label, sizes.get(label, 1)) for label in order]


def by_truth(labels: npt.NDArray[np.uint8], reference: npt.ArrayLike) -> list[Kind]:
    """Kinds by comparing labels and reference, in the order of drawing.

    Errors are larger, so that they show among many right points and without telling red from green.

    Raises:
        ValueError: The reference is no mask of as many points.
    """
    truth: np.ma.MaskedArray[Any, np.dtype[Any]] = np.ma.asarray(reference)
    if truth.shape != labels.shape or truth.dtype.kind != "b":
        raise ValueError(
            f"reference: {truth.dtype} of shape {truth.shape} for {len(labels)} points; wanted is a mask (N,), "
            "true for ground"
        )
    scored = ~np.ma.getmaskarray(truth)
    is_ground, said = np.ma.getdata(truth), labels == Label.GROUND
    return [
        Kind("not scored", (70, 77, 87), ~scored),
        Kind("true positive", (44, 166, 96), scored & is_ground & said),
        Kind("true negative", (140, 148, 158), scored & ~is_ground & ~said),
        Kind("false negative", (66, 140, 255), scored & is_ground & ~said, 1.5),
        Kind("false positive", (255, 72, 56), scored & ~is_ground & said, 1.5),
    ]
