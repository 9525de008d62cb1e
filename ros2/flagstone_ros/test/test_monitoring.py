# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The diagnostics that follow from the events of the node."""

from __future__ import annotations

import pytest

import flagstone
from flagstone_ros import declaration
from flagstone_ros.core import Segmented
from flagstone_ros.monitoring import Level, Monitor

MOUNT = flagstone.Mount(1.5, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 1.0, "fixed")


def segmented(monitor: Monitor, now: float, latency: float = 0.004, out_of_range: float = 0.02) -> None:
    monitor.received(now)
    monitor.segmented(Segmented({}, 1000, out_of_range, MOUNT, 0.001, None), 3.0, latency)


def test_rate_and_latency_are_measured_per_period() -> None:
    monitor = Monitor("surface", 0.0)
    for i, latency in enumerate((0.001, 0.009, 0.002, 0.003)):
        segmented(monitor, 0.1 * i, latency)
    report = monitor.report(2.0)
    assert report.level == Level.OK
    assert report.values == {
        "method": "surface",
        "clouds": "4",
        "rate (Hz)": "2.0",
        "latency, median (ms)": "2.50",
        "latency, worst (ms)": "9.00",
        "dropped": "0",
        "skipped": "0",
        "out of range (%)": "2.0",
        "sensor height (m)": "1.500",
        "tilt (degrees)": "3.00",
        "mount": "fixed",
    }
    segmented(monitor, 2.5, 0.005)
    later = monitor.report(3.0).values
    assert (later["clouds"], later["rate (Hz)"], later["latency, worst (ms)"]) == ("5", "1.0", "5.00")


def test_values_have_the_keys_and_the_order_of_the_declaration() -> None:
    monitor = Monitor("surface", 0.0)
    segmented(monitor, 0.5)
    assert list(monitor.report(1.0).values) == [value.key for value in declaration.DIAGNOSTICS]


def test_values_that_are_not_known_yet_are_omitted() -> None:
    report = Monitor("patchwork", 0.0).report(1.0)
    assert report.level == Level.OK
    assert list(report.values) == ["method", "clouds", "rate (Hz)", "dropped", "skipped"]


def test_silence_is_a_warning_before_and_after_the_first_cloud() -> None:
    monitor = Monitor("surface", 0.0)
    assert monitor.report(1.0)[:2] == (Level.OK, "waiting for the first cloud")
    assert monitor.report(3.0)[:2] == (Level.WARN, "no cloud has arrived yet")
    segmented(monitor, 4.0)
    assert monitor.report(4.5).level == Level.OK
    assert monitor.report(8.0)[:2] == (Level.WARN, "no cloud for 4.0 s")


def test_dropped_clouds_are_a_warning_in_their_period_and_counted_for_ever() -> None:
    monitor = Monitor("surface", 0.0)
    segmented(monitor, 0.5)
    monitor.dropped(2)
    report = monitor.report(1.0)
    assert report.level == Level.WARN
    assert "falls behind" in report.message
    segmented(monitor, 1.5)
    report = monitor.report(2.0)
    assert (report.level, report.values["dropped"]) == (Level.OK, "2")


@pytest.mark.parametrize(("good", "level"), [(0, Level.ERROR), (1, Level.WARN)])
def test_skipped_clouds_are_an_error_if_no_other_was_segmented(good: int, level: Level) -> None:
    monitor = Monitor("surface", 0.0)
    for _ in range(good):
        segmented(monitor, 0.5)
    monitor.received(0.6)
    monitor.skipped("byte 24: the data has 3 bytes")
    report = monitor.report(1.0)
    assert report.level == level
    assert report.message.endswith("byte 24: the data has 3 bytes")
    assert report.values["skipped"] == "1"


def test_a_cloud_in_another_unit_is_a_warning() -> None:
    monitor = Monitor("surface", 0.0)
    segmented(monitor, 0.5, out_of_range=0.95)
    report = monitor.report(1.0)
    assert report.level == Level.WARN
    assert "expected metres" in report.message


def test_no_subscriber_is_not_a_problem_but_is_reported() -> None:
    monitor = Monitor("surface", 0.0)
    monitor.received(0.5)
    monitor.unheard()
    assert monitor.report(1.0)[:2] == (Level.OK, "no output has a subscriber")
