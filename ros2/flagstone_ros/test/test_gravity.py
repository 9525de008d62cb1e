# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The up direction from accelerations."""

from __future__ import annotations

import math

import numpy as np
import pytest

from flagstone_ros.gravity import Gravity


def test_no_direction_is_known_before_the_first_sample() -> None:
    assert Gravity().up is None


@pytest.mark.parametrize("unit", [1.0, 9.81], ids=["g", "m/s2"])
def test_up_is_the_direction_of_the_measured_acceleration_in_any_unit(unit: float) -> None:
    gravity = Gravity()
    assert gravity.add((0, 0.6 * unit, 0.8 * unit), 1.0, "imu")
    np.testing.assert_allclose(gravity.up, [0, 0.6, 0.8])
    assert gravity.frame_id == "imu"


def test_a_step_decays_with_the_time_constant() -> None:
    gravity = Gravity(time_constant=2.0)
    gravity.add((1, 0, 1), 0.0, "imu")
    for i in range(1, 201):
        gravity.add((0, 0, 1), i / 100, "imu")
    up = gravity.up
    assert up is not None
    assert up[0] / up[2] == pytest.approx(math.exp(-1))


def test_the_direction_does_not_depend_on_the_rate_of_the_samples() -> None:
    slow, fast = Gravity(0.5), Gravity(0.5)
    for gravity, rate in ((slow, 10), (fast, 1000)):
        gravity.add((1, 0, 1), 0.0, "imu")
        for i in range(1, rate + 1):
            gravity.add((0, 0, 1), i / rate, "imu")
    np.testing.assert_allclose(slow.up, fast.up)


def test_without_a_time_constant_the_last_sample_counts() -> None:
    gravity = Gravity(time_constant=0.0)
    gravity.add((1, 0, 0), 0.0, "imu")
    gravity.add((0, 0, 5), 0.01, "imu")
    np.testing.assert_allclose(gravity.up, [0, 0, 1])


@pytest.mark.parametrize("sample", [(0, 0, 0), (math.nan, 0, 9.81), (0, math.inf, 0)])
def test_samples_without_a_direction_are_ignored(sample: tuple[float, float, float]) -> None:
    gravity = Gravity()
    gravity.add((0, 0, 9.81), 0.0, "imu")
    assert not gravity.add(sample, 0.1, "imu")
    np.testing.assert_allclose(gravity.up, [0, 0, 1])


def test_a_sample_that_is_older_than_the_last_one_is_ignored() -> None:
    gravity = Gravity()
    gravity.add((0, 0, 1), 10.0, "imu")
    assert not gravity.add((1, 0, 0), 9.5, "imu")
    np.testing.assert_allclose(gravity.up, [0, 0, 1])


@pytest.mark.parametrize("stamp", [20.0, 1.0], ids=["gap", "clock went back"])
def test_the_filter_starts_again_after_a_gap(stamp: float) -> None:
    gravity = Gravity()
    gravity.add((0, 0, 1), 10.0, "imu")
    assert gravity.add((1, 0, 0), stamp, "imu")
    np.testing.assert_allclose(gravity.up, [1, 0, 0])


def test_the_filter_starts_again_in_another_frame() -> None:
    gravity = Gravity()
    gravity.add((0, 0, 1), 10.0, "imu")
    gravity.add((1, 0, 0), 10.01, "other_imu")
    np.testing.assert_allclose(gravity.up, [1, 0, 0])
    assert gravity.frame_id == "other_imu"
