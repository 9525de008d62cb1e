# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels one point cloud message."""

from __future__ import annotations

import time
from dataclasses import dataclass
from queue import SimpleQueue

import numpy as np
import numpy.typing as npt

from flagstone import ros
from flagstone.bags.clouds import GROUND, LABELLED, NONGROUND, OUTPUTS
from flagstone.bags.container import Message
from flagstone.bags.poses import CloudPoses
from flagstone.codes import Label
from flagstone.segmentation import Mount
from flagstone.segmenters import Segmenter


@dataclass(frozen=True, slots=True)
class LabelledCloud:
    """Result of one message. If `error` is set, nothing else is."""

    error: str = ""
    """Reason why the cloud has no labels, in one line."""
    outputs: tuple[tuple[str, bytes], ...] = ()
    """Last part of the name of the topic, and message."""
    points: int = 0
    counts: dict[str, int] | None = None
    patches: int = 0
    mount: Mount | None = None
    """The mounting pose, if it is estimated."""
    segment_ms: float = 0
    encode_ms: float = 0


class CloudLabeller:
    """Labels the clouds of one topic. Thread-safe: each call uses one of several segmenters."""

    def __init__(self, segmenters: list[Segmenter], poses: CloudPoses, format: str, estimates: bool) -> None:
        """Takes the segmenters, one per thread.

        Args:
            segmenters: Have the same settings.
            poses: Transforms to the frame in which clouds are segmented.
            format: Key of `OUTPUTS`.
            estimates: Whether results contain the mounting pose.
        """
        self._free: SimpleQueue[Segmenter] = SimpleQueue()
        for segmenter in segmenters:
            self._free.put(segmenter)
        self._scale: float = segmenters[0].settings["mount"]["scale"]
        self._estimates = estimates
        self._poses = poses
        self._outputs = OUTPUTS[format]

    def __call__(self, message: Message) -> LabelledCloud:
        """Labels a message. Errors are part of the result."""
        try:
            return self._label(message)
        except (ValueError, TypeError) as error:
            return LabelledCloud(error=str(error))
        except MemoryError:
            return LabelledCloud(error="out of memory")

    def points(self, message: Message) -> npt.NDArray[np.float32]:
        """(N, 3): the points in the frame in which they are segmented.

        Raises:
            ValueError: The message cannot be read, or a transform is missing.
        """
        return self._points(parse(message), message.log_time)

    def _points(self, cloud: ros.PointCloud2, log_time: int) -> npt.NDArray[np.float32]:
        pose = self._poses.of(cloud.header.frame_id.removeprefix("/"), log_time)
        if pose is None:
            return cloud.xyz
        return cloud.transformed(pose.rotation, pose.translation / self._scale)

    def _label(self, message: Message) -> LabelledCloud:
        begun = time.perf_counter()
        cloud = parse(message)
        points = self._points(cloud, message.log_time)
        segmenter = self._free.get()
        try:
            result = segmenter.segment(points)
        finally:
            self._free.put(segmenter)
        segmented = time.perf_counter()
        labels, heights = result.labels, result.heights
        outputs = []
        for name in self._outputs:
            if name == LABELLED:
                outputs.append((name, cloud.append({"label": labels, "height": heights})))
            elif name == GROUND:
                outputs.append((name, cloud.select(result.ground, {"height": heights})))
            elif name == NONGROUND:
                outputs.append((name, cloud.select(labels == Label.NONGROUND, {"height": heights})))
        return LabelledCloud(
            outputs=tuple(outputs),
            points=len(result),
            counts=result.counts,
            patches=len(result.patches),
            mount=result.mount if self._estimates else None,
            segment_ms=1000 * (segmented - begun),
            encode_ms=1000 * (time.perf_counter() - segmented),
        )


def parse(message: Message) -> ros.PointCloud2:
    """Reads a point cloud message.

    Raises:
        ValueError: The message cannot be read. One line with the byte.
    """
    encoding: ros.Encoding = "ros1" if message.topic.encoding == "ros1" else "cdr"
    return ros.parse(message.data, encoding=encoding, message_type=message.topic.type)
