# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Copies a bag and adds labelled point clouds to it."""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import Literal, TypeVar

from flagstone._progress import Progress
from flagstone.bags.clouds import OUTPUTS, check_outputs, choose_topics
from flagstone.bags.container import Bag, BagWriter, Message, Topic, create_bag, open_bag
from flagstone.bags.frames import looks_like_sensor_frame
from flagstone.bags.mounts import estimates, fixed_copy, needs_estimate, tracks, with_estimated_mount
from flagstone.bags.order import in_order
from flagstone.bags.poses import CloudPoses, read_poses
from flagstone.bags.summary import BagSummary, BagTimes, Failure, FailureLines
from flagstone.bags.worker import CloudLabeller, LabelledCloud, parse
from flagstone.ros import POINT_CLOUD2
from flagstone.segmenters import Segmenter, Surface, segmenter_with

MAX_THREADS = 1024
CloudCallback = Callable[[Message, int, LabelledCloud], None]
"""Receives a message, its index in its topic, and its result."""
Item = TypeVar("Item")


def bag(
    source: str | os.PathLike[str],
    destination: str | os.PathLike[str],
    *,
    segmenter: Segmenter | None = None,
    topics: Sequence[str] | str = (),
    tf: str | None = None,
    imu: str | None = None,
    format: Literal["labelled", "split", "both"] = "labelled",
    threads: int | None = None,
    progress: bool = True,
) -> BagSummary:
    """Copies a bag of ROS 1 or ROS 2 and adds labelled point clouds to it. ROS is not needed.

    Every message of the bag is copied unchanged, with its times. Each added message follows the cloud that it was
    made from, with the same times and header. The labels are those of `flagstone segment` for the same points.

    The destination is written under a temporary name and then renamed. If the run fails or is interrupted, nothing is
    left.

    Args:
        source: Bag to read: a ROS 1 .bag, an .mcap, a .db3, or a directory of rosbag2.
        destination: Bag to create, which must not exist. With the extension .bag, .mcap or .db3, one file; otherwise a
            directory of rosbag2, in the format of the source. Bags of ROS 2 can be converted between MCAP and SQLite.
        segmenter: A `Surface`, a `Patchwork`, or a segmenter from `make_segmenter`. Each thread gets a copy. By
            default `Surface()`. If it estimates the height or tilt, the first cloud that determines it is used for
            all clouds of the topic. If it tracks the height, clouds are processed one after the other.
        topics: Names of the point cloud topics to label. By default the only one in the bag.
        tf: Frame of the sensor, if the clouds are in another frame. The transform comes from the topic /tf_static of
            the bag. The points are transformed for segmentation only.
        imu: Topic of sensor_msgs/Imu whose low-passed linear_acceleration is the up direction of each cloud.
        format: Topics to add: "labelled" adds TOPIC/labelled, all points with added fields label (uint8) and height
            (float32, metres); "split" adds TOPIC/ground and TOPIC/nonground, with an added field height; "both" adds
            all three.
        threads: Number of clouds to label in parallel, 1 to 1,024. By default the number of cores. The output does not
            depend on it.
        progress: Show progress and the time left on standard error, if it is a terminal.

    Returns:
        Numbers of messages, clouds and points, failures with reasons, and times.

    Raises:
        FileNotFoundError: The source does not exist.
        FileExistsError: The destination exists.
        ValueError: An argument is invalid; a topic, transform or point cloud that it needs is missing; or the source is
            not a bag.
        OSError: A file cannot be read or written.
        ImportError: The bag is compressed or a directory, and the extra `bag` is not installed.
    """
    problems: list[str] = []
    with (
        open_bag(source, report=problems.append) as opened,
        Progress(opened.message_count, "messages", shown=progress) as bar,
    ):
        return label_bag(
            opened,
            destination,
            segmenter=segmenter,
            topics=(topics,) if isinstance(topics, str) else tuple(topics),
            tf=tf,
            imu=imu,
            format=format,
            threads=threads,
            bar=bar,
            problems=problems,
        )


def label_bag(
    opened: Bag,
    destination: str | os.PathLike[str],
    *,
    segmenter: Segmenter | None,
    topics: Sequence[str],
    tf: str | None,
    imu: str | None,
    format: str,
    threads: int | None,
    bar: Progress,
    problems: list[str],
    notify: Callable[[str], None] = lambda line: None,
    inform: Callable[[str], None] = lambda line: None,
    on_cloud: CloudCallback = lambda message, index, cloud: None,
) -> BagSummary:
    """`bag`, with an open bag and callbacks.

    `bar` counts messages. `problems` is the list to which the bag reports damaged parts. `notify` receives other
    warnings and errors, `inform` the mounting poses that were estimated, and `on_cloud` each result in the order of the
    bag.
    """
    segmenter = segmenter if segmenter is not None else Surface()
    threads = checked_threads(threads, segmenter)
    if format not in OUTPUTS:
        raise ValueError(f"format: '{format}' is not a format (expected {', '.join(OUTPUTS)})")

    def report(line: str) -> None:
        problems.append(line)
        notify(line)

    chosen = choose_topics(opened, topics)
    if tf is not None and len(chosen) > 1:
        raise ValueError(
            f"{opened.path}: frame '{tf}' belongs to one sensor, but {len(chosen)} topics are chosen (expected one)"
        )
    check_outputs(opened, chosen, format)
    if os.path.lexists(destination):
        raise FileExistsError(f"{os.fspath(destination)}: exists already (remove it, or choose another name)")
    with create_bag(destination, like=opened) as writer:
        poses = read_poses(opened, tf, imu, report)
        labellers = {
            topic: make_labeller(
                opened, topic, segmenter, poses, format, threads, notify, inform, warns_of_frame=tf is None
            )
            for topic in chosen
        }
        run = _Run(opened, writer, labellers, format, notify, on_cloud)
        try:
            run.copy(threads, bar)
            bar.note("writing the index")
            run.finish()
        except KeyboardInterrupt:
            raise KeyboardInterrupt(
                f"interrupted: {run.clouds} clouds were labelled, but {os.fspath(destination)} was not written "
                "(run the command again)"
            ) from None
    return run.summary(problems, threads)


def checked_threads(threads: int | None, segmenter: Segmenter) -> int:
    """The number of threads to use.

    Raises:
        ValueError: The number is out of range, or the segmenter needs clouds in order.
    """
    if threads is not None and not 1 <= threads <= MAX_THREADS:
        raise ValueError(f"threads: {threads} is out of range (expected 1 to {MAX_THREADS})")
    if not tracks(segmenter):
        return threads if threads is not None else len(os.sched_getaffinity(0))
    if threads is not None and threads > 1:
        raise ValueError(f"threads: {threads} is out of range (expected 1, because the sensor height is tracked)")
    return 1


def make_labeller(
    opened: Bag,
    topic: str,
    segmenter: Segmenter,
    poses: CloudPoses,
    format: str,
    threads: int,
    notify: Callable[[str], None],
    inform: Callable[[str], None],
    *,
    warns_of_frame: bool,
) -> CloudLabeller:
    """Prepares the segmenters for a topic, and checks the frame of its first cloud.

    Raises:
        ValueError: The transform of the first cloud is missing. One line.
    """
    labeller = CloudLabeller(
        [segmenter_with(segmenter.method, segmenter.settings) for _ in range(threads)],
        poses,
        format,
        estimates(segmenter),
    )
    for message in opened.messages([topic]):
        try:
            frame = parse(message).header.frame_id
        except ValueError:
            continue  # reported when it is labelled
        try:
            poses.of(frame.removeprefix("/"), message.log_time)
        except ValueError as error:
            raise ValueError(f"{opened.path}: {topic}: {error}") from None
        if warns_of_frame and not looks_like_sensor_frame(frame):
            notify(
                f"{opened.path}: {topic}: the clouds are in frame '{frame}', which is usually not the frame of a "
                "sensor (if its origin is not at the sensor, name the frame of the sensor with --tf)"
            )
        break
    if needs_estimate(segmenter):
        segmenter = with_estimated_mount(
            segmenter, labeller, opened.messages([topic]), lambda line: inform(f"{opened.path}: {topic}: {line}")
        )
        return CloudLabeller([fixed_copy(segmenter) for _ in range(threads)], poses, format, True)
    return labeller


class _Run:
    """Copies the messages, and counts."""

    def __init__(
        self,
        opened: Bag,
        writer: BagWriter,
        labellers: dict[str, CloudLabeller],
        format: str,
        notify: Callable[[str], None],
        on_cloud: CloudCallback,
    ) -> None:
        self._bag = opened
        self._writer = writer
        self._labellers = labellers
        self._added = {
            (name, suffix): self._add_topic(name, suffix) for name in labellers for suffix in OUTPUTS[format]
        }
        self._lines = FailureLines(notify)
        self._on_cloud = on_cloud
        self._seen = Counter[str]()  # messages of each topic
        self._times = BagTimes()
        self._failures: list[Failure] = []
        self._counts = Counter[str]()
        self._messages = self._bytes = self._points = 0
        self.clouds = 0

    def _add_topic(self, name: str, suffix: str) -> Topic:
        source = self._bag.topics_named(name)[0]
        return self._writer.add_topic(f"{name}/{suffix}", POINT_CLOUD2, like=source)

    def copy(self, threads: int, bar: Progress) -> None:
        """Copies all messages and labels the clouds among them."""
        begun = time.perf_counter()
        messages = self._timed(self._bag.messages())
        for message, labelled in in_order(messages, self._labeller_of, threads, self._waited):
            written = time.perf_counter()
            self._writer.copy(message)
            self._messages += 1
            self._bytes += len(message.data)
            if labelled is not None:
                self._take(message, labelled)
            self._times.write += time.perf_counter() - written
            bar.add(1)
        self._times.total = time.perf_counter() - begun

    def finish(self) -> None:
        """Completes the bag."""
        begun = time.perf_counter()
        self._writer.finish()
        self._lines.finish(os.fspath(self._bag.path))
        self._times.write += time.perf_counter() - begun
        self._times.total += time.perf_counter() - begun

    def summary(self, problems: list[str], threads: int) -> BagSummary:
        """The results."""
        added: dict[str, tuple[str, ...]] = {}
        for (name, _), topic in self._added.items():
            added[name] = (*added.get(name, ()), topic.name)
        return BagSummary(
            destination=os.fspath(self._writer.path),
            messages=self._messages,
            topics=added,
            clouds=self.clouds,
            failures=tuple(self._failures),
            problems=tuple(problems),
            points=self._points,
            counts=dict(self._counts),
            bytes=self._bytes,
            threads=threads,
            times=self._times,
        )

    def _labeller_of(self, message: Message) -> CloudLabeller | None:
        return self._labellers.get(message.topic.name)

    def _waited(self, seconds: float) -> None:
        self._times.wait += seconds

    def _timed(self, items: Iterator[Item]) -> Iterator[Item]:
        while True:
            begun = time.perf_counter()
            try:
                item = next(items)
            except StopIteration:
                return
            finally:
                self._times.read += time.perf_counter() - begun
            yield item

    def _take(self, message: Message, labelled: LabelledCloud) -> None:
        topic = message.topic.name
        index = self._seen[topic]
        self._seen[topic] += 1
        if labelled.error:
            self._failures.append(Failure(topic, index, labelled.error))
            self._lines.add(f"{self._bag.path}: {topic}: message {index}", labelled.error)
        else:
            self.clouds += 1
            self._points += labelled.points
            self._counts.update(labelled.counts or {})
            self._times.segment += labelled.segment_ms / 1000
            self._times.encode += labelled.encode_ms / 1000
            for suffix, data in labelled.outputs:
                self._bytes += len(data)
                self._writer.write(
                    self._added[topic, suffix], message.log_time, data, publish_time=message.publish_time
                )
        self._on_cloud(message, index, labelled)
