# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Counts, rates and latencies of the node, as its diagnostics report them."""

from __future__ import annotations

import statistics
import threading
from dataclasses import dataclass, field
from enum import IntEnum
from typing import NamedTuple

from flagstone_ros import declaration
from flagstone_ros.core import Segmented


class Level(IntEnum):
    """Levels of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


class Report(NamedTuple):
    """The state of the node since the previous report."""

    level: Level
    message: str
    """One line."""
    values: dict[str, str]
    """Known values by the keys of `declaration.DIAGNOSTICS`, in their order."""


@dataclass
class _Period:
    """Events since the last report."""

    start: float
    received: int = 0
    dropped: int = 0
    skipped: int = 0
    unheard: int = 0
    latencies: list[float] = field(default_factory=list)


class Monitor:
    """Counts the events of the node. Thread-safe. All times are in seconds of one monotonic clock."""

    def __init__(self, method: str, now: float) -> None:
        """Creates a monitor without events. `method`: name of the method."""
        self._lock = threading.Lock()
        self._method = method
        self._period = _Period(now)
        self._last_arrival = now
        self._has_input = False
        self._clouds = self._dropped = self._skipped = 0
        self._reason = ""
        self._out_of_range: float | None = None
        self._mount: tuple[float, float, str] | None = None

    def received(self, now: float) -> None:
        """A cloud has arrived."""
        with self._lock:
            self._period.received += 1
            self._last_arrival = now
            self._has_input = True

    def dropped(self, count: int) -> None:
        """Clouds were dropped because the node fell behind."""
        with self._lock:
            self._period.dropped += count
            self._dropped += count

    def skipped(self, reason: str) -> None:
        """A cloud could not be segmented. `reason`: one line."""
        with self._lock:
            self._period.skipped += 1
            self._skipped += 1
            self._reason = reason

    def unheard(self) -> None:
        """A cloud was not segmented because no output has a subscriber."""
        with self._lock:
            self._period.unheard += 1

    def segmented(self, cloud: Segmented, tilt: float, latency: float) -> None:
        """The outputs of a cloud have been published.

        Args:
            cloud: The result.
            tilt: Angle in degrees between the up direction in use and the z axis of the sensor.
            latency: Seconds from the receipt of the cloud to the end of publishing.
        """
        with self._lock:
            self._clouds += 1
            self._period.latencies.append(latency)
            self._out_of_range = cloud.out_of_range
            self._mount = (cloud.mount.sensor_height, tilt, cloud.mount.decision)

    def report(self, now: float) -> Report:
        """The state since the previous report, which begins a new period."""
        with self._lock:
            period, self._period = self._period, _Period(now)
            level, message = self._state(period, now)
            values: dict[str, str | float] = {"method": self._method, "clouds": self._clouds}
            if now > period.start:
                values["rate (Hz)"] = len(period.latencies) / (now - period.start)
            if period.latencies:
                values["latency, median (ms)"] = 1000 * statistics.median(period.latencies)
                values["latency, worst (ms)"] = 1000 * max(period.latencies)
            values["dropped"] = self._dropped
            values["skipped"] = self._skipped
            if self._out_of_range is not None:
                values["out of range (%)"] = 100 * self._out_of_range
            if self._mount is not None:
                values["sensor height (m)"], values["tilt (degrees)"], values["mount"] = self._mount
        texts = {
            value.key: f"{values[value.key]:.{value.decimals}f}" if value.decimals else str(values[value.key])
            for value in declaration.DIAGNOSTICS
            if value.key in values
        }
        return Report(level, message, texts)

    def _state(self, period: _Period, now: float) -> tuple[Level, str]:
        silence = now - self._last_arrival
        if not self._has_input:
            if silence > declaration.SILENCE_SECONDS:
                return Level.WARN, "no cloud has arrived yet"
            return Level.OK, "waiting for the first cloud"
        if silence > declaration.SILENCE_SECONDS:
            return Level.WARN, f"no cloud for {silence:.1f} s"
        if period.skipped and not period.latencies:
            return Level.ERROR, f"no cloud could be segmented: {self._reason}"
        if period.skipped:
            return Level.WARN, f"{period.skipped} of {period.received} clouds skipped: {self._reason}"
        if period.dropped:
            return Level.WARN, f"{period.dropped} of {period.received} clouds dropped: the node falls behind"
        if self._out_of_range is not None and self._out_of_range > declaration.MOSTLY_OUT_OF_RANGE:
            return Level.WARN, "most points are out of range (expected metres, origin at the sensor)"
        if period.unheard and not period.latencies:
            return Level.OK, "no output has a subscriber"
        return Level.OK, "clouds are segmented"
