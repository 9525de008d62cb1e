# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The mounting pose of the sensor of a topic, estimated before any cloud is labelled."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import islice

from flagstone._points import columns_of
from flagstone.bags.container import Message
from flagstone.bags.worker import CloudLabeller
from flagstone.segmenters import Segmenter, segmenter_with

CLOUDS_EXAMINED = 20
"""As for `flagstone segment`."""


def needs_estimate(segmenter: Segmenter) -> bool:
    """Whether the height or tilt must be estimated once, for all clouds."""
    return estimates(segmenter) and not tracks(segmenter)


def estimates(segmenter: Segmenter) -> bool:
    """Whether the height or tilt is estimated from clouds, once or with each cloud."""
    mount = segmenter.settings["mount"]
    return bool(mount["height"] != "fixed" or mount["tilt"] == "estimate")


def tracks(segmenter: Segmenter) -> bool:
    """Whether each cloud updates the mounting pose, so that clouds must be processed one after the other."""
    return bool(segmenter.settings["mount"]["height"] == "track")


def with_estimated_mount(
    segmenter: Segmenter, labeller: CloudLabeller, clouds: Iterable[Message], notify: Callable[[str], None]
) -> Segmenter:
    """A segmenter with the mounting pose that the first cloud determines, of the first 20.

    If no cloud does, the configured pose is used. The labels are those of `flagstone segment`, with any number of
    threads.

    Args:
        segmenter: Estimates the height or the tilt.
        labeller: Returns the points of a message in the frame in which they are segmented.
        clouds: Messages. Those that cannot be read are skipped; they are reported when they are labelled.
        notify: Receives the decision and its reason, on one line.
    """
    found = None
    why = "no cloud could be read to estimate it"
    for index, message in enumerate(islice(clouds, CLOUDS_EXAMINED)):
        try:
            points = labeller.points(message)
        except ValueError:
            continue
        is_accepted, height, up, sentence = segmenter._core.estimate_mount(*columns_of(points))
        if is_accepted:
            found = height, up
            notify(f"mount: {sentence} (estimated from message {index})")
            break
        why = f"the first {index + 1} clouds do not determine it; the last one: {sentence}"
    if found is None:
        notify(f"mount: as configured ({why})")
    return fixed_copy(segmenter, found)


def fixed_copy(segmenter: Segmenter, found: tuple[float, tuple[float, float, float]] | None = None) -> Segmenter:
    """A copy that estimates nothing: with the height and the up direction that were found, otherwise as configured."""
    fixed = segmenter_with(segmenter.method, segmenter.settings)
    fixed._core = segmenter._core.with_fixed_mount(found)
    return fixed
