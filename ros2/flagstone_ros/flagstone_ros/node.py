# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The rclpy node. Run it with `ros2 run flagstone_ros ground_segmentation` or `python -m flagstone_ros`."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_policy_name_from_kind

from flagstone import ros
from flagstone_ros import core, declaration, messages
from flagstone_ros.configuration import Configuration, configure
from flagstone_ros.frames import StaticTransforms, Transform, shortest_rotation_to_z
from flagstone_ros.gravity import Gravity
from flagstone_ros.latest import LatestQueue
from flagstone_ros.monitoring import Level, Monitor
from flagstone_ros.throttle import Throttle

_TOPICS = {topic.name: topic for topic in declaration.TOPICS}


class _Arrival(NamedTuple):
    message: bytes
    time: float
    """Of the monotonic clock, seconds."""


class _CloudSkippedError(Exception):
    """A cloud cannot be segmented now. The message is one line; `problem` identifies it in the log."""

    def __init__(self, problem: str, text: str) -> None:
        super().__init__(text)
        self.problem = problem


class GroundSegmentation(Node):
    """Segments the clouds of the topic points.

    The executor receives messages and sets parameters. A separate thread segments the clouds and publishes the outputs,
    so a slow cloud delays neither. Call `close` before `destroy_node`.
    """

    def __init__(self, **options: Any) -> None:
        """Creates the node.

        Args:
            **options: As for rclpy.node.Node, for example parameter_overrides.

        Raises:
            ValueError, TypeError, OSError: A parameter has an invalid value; the message is one line.
            ImportError: The package of the input type is not installed; the message is one line.
        """
        super().__init__(declaration.NODE_NAME, **options)
        self._throttle = Throttle(declaration.THROTTLE_SECONDS)
        self._lock = threading.Lock()  # guards the transforms, the gravity and the throttle
        self._transforms = StaticTransforms()
        self._gravity: Gravity | None = None
        self._imu: Any = None
        self._warned_about: object = None  # the segmenter whose clouds are mostly out of range
        self._is_refreshing = False
        self._pending: Configuration | None = None
        self._configuration = self._declare_parameters()
        values = self._configuration.values
        self._input_type = str(values["input_type"])
        self._monitor = Monitor(str(values["method"]), time.monotonic())
        self._queue: LatestQueue[_Arrival] = LatestQueue(int(self.get_parameter("queue_depth").value))
        self._outputs = {name: self._create_output(name) for name in core.OUTPUTS}
        self._create_inputs()
        self._diagnostics = self._create_output("/diagnostics")
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # simulated time may be paused
        self.create_timer(
            float(self.get_parameter("diagnostics_period").value), self._publish_diagnostics, clock=steady
        )
        self._worker = threading.Thread(target=self._segment_clouds, name="segmentation", daemon=True)
        self._worker.start()
        self.get_logger().info(
            f"{self.resolve_topic_name('points')}: method {values['method']}, sensor height {values['sensor_height']}, "
            f"tilt {values['tilt']}"
        )

    def close(self) -> None:
        """Ends the thread that segments, after the cloud in progress. May be called again."""
        self._queue.close()
        self._worker.join()

    # Parameters

    def _declare_parameters(self) -> Configuration:
        given = {}
        for parameter in declaration.PARAMETERS:
            given.update(self._declare(parameter))
        for parameter in declaration.setting_parameters(_known_method(given.get("method", declaration.METHODS[0]))):
            given.update(self._declare(parameter))
        configuration = configure(given)
        self._show(configuration)
        for name in self._parameter_overrides:  # rclpy has no public list of them
            if name not in configuration.values and not name.startswith(("qos_overrides.", "use_sim_time")):
                self.get_logger().warning(
                    f"parameters: {name!r} is not a parameter of this node with method {configuration.segmenter.method}"
                )
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._use_parameters)
        return configuration

    def _declare(self, parameter: declaration.Parameter) -> dict[str, Any]:
        """Declares a parameter, and returns its value if the user or the declaration has set it."""
        descriptor = messages.descriptor_of(parameter)
        declared = self.declare_parameter(parameter.name, messages.default_of(parameter), descriptor)
        return {} if declared.value is None else {parameter.name: _plain(declared.value)}

    def _show(self, configuration: Configuration) -> None:
        """Sets the parameters that the user has not set to the values in use."""
        changed = [
            Parameter(name, value=messages.to_ros(value))
            for name, value in configuration.values.items()
            if name not in configuration.given and self._shown(name) != value
        ]
        self._is_refreshing = True
        try:
            for result in self.set_parameters(changed):
                if not result.successful:
                    self.get_logger().error(f"parameters: {result.reason}")
        finally:
            self._is_refreshing = False

    def _shown(self, name: str) -> Any:
        return _plain(self.get_parameter_or(name, Parameter(name)).value)

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        if self._is_refreshing:
            return SetParametersResult(successful=True)
        self._pending = None
        changes = {p.name: _plain(p.value) for p in parameters if p.name in self._configuration.values}
        if not changes:
            return SetParametersResult(successful=True)
        try:
            self._pending = configure({**self._configuration.given, **changes}, self._configuration)
        except (ValueError, TypeError, OSError) as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _use_parameters(self, parameters: Sequence[Parameter]) -> None:
        if self._is_refreshing or self._pending is None:
            return
        self._configuration, self._pending = self._pending, None  # the next cloud uses it
        self._show(self._configuration)
        self._listen_to_imu()

    # Topics

    def _create_output(self, name: str) -> Any:
        topic = _TOPICS[name]
        return self.create_publisher(
            messages.message_class(topic.type),
            name,
            messages.profile_of(topic.quality),
            event_callbacks=PublisherEventCallbacks(incompatible_qos=self._reporter_of_mismatch(name, "subscriber")),
            qos_overriding_options=messages.overriding_of(topic.quality),
        )

    def _create_input(self, name: str, type_name: str, callback: Callable[[Any], None], raw: bool) -> Any:
        topic = _TOPICS[name]
        return self.create_subscription(
            messages.message_class(type_name),
            name,
            callback,
            messages.profile_of(topic.quality),
            raw=raw,
            event_callbacks=SubscriptionEventCallbacks(
                incompatible_qos=self._reporter_of_mismatch(name, "publisher"),
                message_lost=self._lost if name == "points" else None,
            ),
            qos_overriding_options=messages.overriding_of(topic.quality),
        )

    def _create_inputs(self) -> None:
        try:
            self._create_input("/tf_static", _TOPICS["/tf_static"].type, self._add_transforms, raw=False)
        except ImportError as error:
            self.get_logger().warning(f"{error}; clouds and IMU must be in the frame of the sensor")
        self._listen_to_imu()
        self._create_input("points", self._input_type, self._receive, raw=True)

    def _listen_to_imu(self) -> None:
        configuration = self._configuration
        if configuration.uses_imu:
            with self._lock:
                self._gravity = self._gravity or Gravity()
                self._gravity.time_constant = float(configuration.values["imu_time_constant"])  # type: ignore[arg-type]
            self._imu = self._imu or self._create_input("imu", _TOPICS["imu"].type, self._add_acceleration, raw=False)
        elif self._imu is not None:
            self.destroy_subscription(self._imu)
            self._imu = None
            with self._lock:
                self._gravity = None

    def _reporter_of_mismatch(self, name: str, other: str) -> Callable[[Any], None]:
        def report(info: Any) -> None:
            policy = qos_policy_name_from_kind(info.last_policy_kind)
            if other == "publisher":
                kind, expected = "subscription", "a publisher that offers at least the requested quality of service"
            else:
                kind, expected = "publisher", "a subscriber that requests at most the offered quality of service"
            overridable = policy.lower() in declaration.OVERRIDABLE_POLICIES and _TOPICS[name].quality.is_overridable
            resolved = self.resolve_topic_name(name)
            hint = f"set qos_overrides.{resolved}.{kind}.{policy.lower()}" if overridable else f"change the {other}"
            self._warn(
                f"quality of service of {resolved}",
                f"{resolved}: no messages to or from a {other}: its {policy.lower()} is incompatible "
                f"(expected {expected}; {hint})",
            )

        return report

    def _warn(self, problem: str, text: str) -> None:
        with self._lock:
            line = self._throttle.line(problem, text, time.monotonic())
        if line is not None:
            self.get_logger().warning(line)

    # Inputs

    def _receive(self, message: bytes) -> None:
        now = time.monotonic()
        self._monitor.received(now)
        dropped = self._queue.put(_Arrival(message, now))
        if dropped:
            self._drop(dropped, "clouds arrive faster than they are segmented")

    def _lost(self, info: Any) -> None:
        self._drop(info.total_count_change, "the transport lost them")

    def _drop(self, count: int, reason: str) -> None:
        self._monitor.dropped(count)
        self._warn(f"dropped: {reason}", f"points: {count} of the oldest clouds dropped ({reason})")

    def _add_transforms(self, message: Any) -> None:
        for stamped in message.transforms:
            moved, turned = stamped.transform.translation, stamped.transform.rotation
            try:
                transform = Transform.from_quaternion(
                    (moved.x, moved.y, moved.z), (turned.x, turned.y, turned.z, turned.w)
                )
            except ValueError as error:
                self._warn("invalid transform", f"/tf_static: {stamped.child_frame_id}: {error}")
                continue
            with self._lock:
                self._transforms.add(stamped.header.frame_id, stamped.child_frame_id, transform)

    def _add_acceleration(self, message: Any) -> None:
        measured, header = message.linear_acceleration, message.header
        with self._lock:
            if self._gravity is None:
                return
            used = self._gravity.add(
                (measured.x, measured.y, measured.z), header.stamp.sec + 1e-9 * header.stamp.nanosec, header.frame_id
            )
        if not used:
            self._warn(
                "acceleration",
                f"imu: acceleration ({measured.x}, {measured.y}, {measured.z}) at {header.stamp.sec} s is not used "
                "(expected finite numbers, not all zero, in order of time)",
            )

    # Clouds

    def _segment_clouds(self) -> None:
        while (arrival := self._queue.get()) is not None:
            try:
                self._segment(arrival)
            except _CloudSkippedError as error:
                self._skip(error.problem, str(error))
            except Exception as error:  # the node must survive every message
                self._skip(type(error).__name__, f"points: {error}")

    def _skip(self, problem: str, text: str) -> None:
        line = " ".join(text.split())
        self._monitor.skipped(line)
        if rclpy.ok(context=self.context):
            self._warn(problem, f"{line}; the cloud is skipped")

    def _segment(self, arrival: _Arrival) -> None:
        configuration = self._configuration
        cloud = ros.parse(arrival.message, message_type=self._input_type)
        wanted = [name for name, output in self._outputs.items() if output.get_subscription_count() > 0]
        if not wanted and not configuration.estimates_mount:
            self._monitor.unheard()
            return
        to_level, up = self._to_level(cloud.header.frame_id, configuration)
        segmented = core.segment(cloud, configuration.segmenter, wanted, to_level)
        for name, message in segmented.messages.items():
            self._outputs[name].publish(message)
        tilt = core.tilt_of(segmented.mount.up if up is None else up)
        self._monitor.segmented(segmented, tilt, time.monotonic() - arrival.time)
        if segmented.warning is not None and self._warned_about is not configuration.segmenter:
            self._warned_about = configuration.segmenter
            self._warn("flagstone", segmented.warning)

    def _to_level(
        self, cloud_frame: str, configuration: Configuration
    ) -> tuple[Transform | None, npt.NDArray[np.float64] | None]:
        """The transform for the segmentation, and the up direction if it comes from the IMU."""
        sensor_frame = str(configuration.values["sensor_frame"]) or cloud_frame
        with self._lock:
            to_sensor = self._transforms.between(cloud_frame, sensor_frame)
            if to_sensor is None:
                raise self._no_transform(f"the cloud's frame {cloud_frame!r}", sensor_frame)
            up = None
            if configuration.uses_imu:
                up = self._up_in(sensor_frame)
        to_sensor = Transform(to_sensor.rotation, to_sensor.translation / configuration.metres_per_unit)
        if up is None:
            return to_sensor, None
        return Transform(shortest_rotation_to_z(up), np.zeros(3)).after(to_sensor), up

    def _up_in(self, sensor_frame: str) -> npt.NDArray[np.float64]:
        up = self._gravity.up if self._gravity is not None else None
        if self._gravity is None or up is None:
            topic = self.resolve_topic_name("imu")
            raise _CloudSkippedError("gravity", f"imu: no acceleration has arrived on {topic} (expected for tilt imu)")
        imu_frame = self._gravity.frame_id
        to_sensor = self._transforms.between(imu_frame, sensor_frame)
        if to_sensor is None:
            raise self._no_transform(f"the frame {imu_frame!r} of the IMU", sensor_frame)
        rotated: npt.NDArray[np.float64] = to_sensor.rotation @ up
        return rotated

    def _no_transform(self, source: str, target: str) -> _CloudSkippedError:
        known = ", ".join(self._transforms.frames()) or "none"
        return _CloudSkippedError(
            f"transform from {source}",
            f"/tf_static: no transform from {source} to {target!r} "
            f"(expected a chain of static transforms; known frames: {known})",
        )

    # Diagnostics

    def _publish_diagnostics(self) -> None:
        report = self._monitor.report(time.monotonic())
        status = DiagnosticStatus(
            level=_LEVELS[report.level],
            name=f"{self.get_fully_qualified_name().lstrip('/')}: {declaration.DIAGNOSTICS_NAME}",
            message=report.message,
            values=[KeyValue(key=key, value=value) for key, value in report.values.items()],
        )
        message = DiagnosticArray(status=[status])
        message.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(message)


_LEVELS = {Level.OK: DiagnosticStatus.OK, Level.WARN: DiagnosticStatus.WARN, Level.ERROR: DiagnosticStatus.ERROR}


def _plain(value: Any) -> Any:
    """A value of rclpy as the declaration has it."""
    return tuple(value) if isinstance(value, (list, tuple)) or hasattr(value, "typecode") else value


def _known_method(name: Any) -> str:
    if name not in declaration.METHODS:
        raise ValueError(f"method: {name!r} is unknown (expected {' or '.join(declaration.METHODS)})")
    return str(name)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the node until it is interrupted. Returns the exit code."""
    node = None
    try:
        rclpy.init(args=list(sys.argv if arguments is None else arguments))
        try:
            node = GroundSegmentation()
        except Exception as error:  # rclpy's errors about parameters have no common class
            print(f"{declaration.NODE_NAME}: {' '.join(str(error).split())}", file=sys.stderr)
            return 1
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        if node is not None:
            node.close()
            node.destroy_node()
        rclpy.try_shutdown()
    return 0
